//! Bad input ends with the code 2 and a message that names the field, the value and the valid range.

mod common;

use common::{assert_refused, run};

#[test]
fn bad_input_ends_with_2_and_names_field_value_and_range() {
    assert_refused(&[
        ("toss --rate 1,nan,2 --speed 3", ["rate y [rad/s] = NaN", "finite"]),
        ("toss --rate 1,1,inf --speed 3", ["rate z [rad/s] = inf", "finite"]),
        ("toss --rate 1,1 --speed 3", ["rate = '1,1'", "WX,WY,WZ"]),
        ("toss --rate 1,x,2 --speed 3", ["rate = '1,x,2'", "WX,WY,WZ"]),
        ("toss --rate 1,1,1 --speed -3", ["speed [m/s] = -3.0", ">= 0"]),
        ("toss --rate 1,1,1 --speed nan", ["speed [m/s] = NaN", ">= 0"]),
        ("toss --rate 1,1,1 --speed 3 --gravity 0", ["gravity [m/s²] = 0.0", "> 0"]),
        ("toss --rate 1,1,1 --time -1", ["time [s] = -1.0", ">= 0"]),
        ("toss --rate 1,1,1 --time 1 --tilt inf", ["tilt [rad] = inf", "finite"]),
        ("toss --rate 1,1,1 --time 1 --moments 1,3", ["I3 [kg m²] = 3.0", "0 <= I3 <= 2 I1"]),
        ("toss --rate 1,1,1 --time 1 --moments 0,0", ["I1 [kg m²] = 0.0", "> 0"]),
        ("toss --rate 1,1,1 --time 1 --moments 1,-1", ["I3 [kg m²] = -1.0", "0 <= I3 <= 2 I1"]),
        ("toss --rate 1,1,1 --time 1 --cylinder 0,1,1", ["mass [kg] = 0.0", "> 0"]),
        ("toss --rate 1,1,1 --time 1 --cylinder 1,-1,1", ["radius [m] = -1.0", "> 0"]),
        ("toss --rate 1,1,1 --time 1 --cylinder 1,1,-1", ["thickness [m] = -1.0", ">= 0"]),
        ("toss --rate 1,1,1 --time 1 --coin groat", ["coin = 'groat'", "us-quarter"]),
        ("toss --rate 1,1,1 --time 1 --solver newton", ["solver = 'newton'", "quaternion"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --scheme euler", ["scheme of this solver = 'euler'", "dopri5"]),
        ("toss --rate 1,1,1 --time 1 --scheme euler", ["scheme = 'euler'", "taylor"]),
        (
            "toss --rate 1,1,1 --time 1 --solver gamma --formulation sideways",
            ["formulation = 'sideways'", "momentum, vertical, raw"],
        ),
        ("toss --rate 1,1,1 --time 1 --solver gamma --tolerance 0", ["tolerance = 0.0", "2.220446049250313e-16"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --tolerance 1e-17", ["tolerance = 1e-17", "<= tolerance < 1"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --scheme rk4 --step 0", ["step [s] = 0.0", "> 0"]),
        (
            "toss --rate 1,1,1 --time 1 --solver gamma --scheme rk4 --tolerance 1e-9",
            ["--tolerance", "rk4 takes --step"],
        ),
        ("toss --rate 1,1,1 --time 1 --solver gamma --step 1e-3", ["--step is for rk4", "dop853"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --scheme taylor", ["scheme of this solver", "dop853, dopri5, rk4"]),
        (
            "trace --rate 1,1,1 --time 1 --points 3 --solver euler --scheme taylor",
            ["scheme of this solver", "dop853, dopri5, rk4"],
        ),
        (
            "probability --space paper-fig4 --method grid --solver euler --scheme taylor",
            ["scheme of this solver", "dop853, dopri5, rk4"],
        ),
        (
            "plan --rate 1,1,1 --time 1 --want tilt --accuracy 1e-6 --solver gamma --scheme taylor",
            ["scheme of this solver", "dop853, dopri5, rk4"],
        ),
        (
            "toss --rate 1,1,1 --time 1 --solver quaternion --scheme taylor --step 1e-3",
            ["--step is for rk4", "taylor takes --tolerance"],
        ),
        ("trace --rate 1,1,1 --time 1 --points 1", ["'1' for '--points", "from 2 to 1000000"]),
        (
            "trace --rate 1,1,1 --time 1 --points 3 --svg /no/such/folder/x.svg",
            ["/no/such/folder/x.svg", "cannot write"],
        ),
    ]);
}

#[test]
fn missing_and_conflicting_options_end_with_2() {
    for arguments in [
        "",
        "flip",
        "toss --speed 3",
        "toss --rate 1,1,1",
        "toss --rate 1,1,1 --speed 3 --time 1",
        "toss --rate 1,1,1 --time 1 --gravity 9.8",
        "toss --rate 1,1,1 --time 1 --coin disc --moments 1,1",
        "probability --space tails --rate-x 1 --method grid",
        "probability --space tails --method grid --accuracy 1e-3",
        "trace --rate 1,1,1 --time 1 --points 3 --dt 0.1",
        "trace --rate 1,1,1 --time 1",
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments}");
    }
}
