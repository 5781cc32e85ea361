//! Runs the commands about how a launch changes its outcome as a user does: the margins of `toss`, `intervals` and
//! `inverse`.

use crate::common::{assert_near, json, run, stdout};
use serde_json::{Value, json as value};

#[test]
fn a_speed_changed_by_the_margin_flips_the_outcome() {
    let answer = json("toss --rate 2,2,0.5 --speed 3", 0);
    let change = answer["margin"]["speed"].as_f64().unwrap();
    assert!(change < 0.0, "{answer}");
    for (part, outcome) in [(0.999_999, "tails"), (1.000_001, "heads")] {
        assert_eq!(json(&format!("toss --rate 2,2,0.5 --speed {}", 3.0 + part * change), 0)["outcome"], outcome);
    }
    assert_near(&answer["margin"]["time"], 2.0 * change / 9.81, 1e-15);
    let forever = json("toss --rate 1,1,2.5 --speed 3 --coin disc", 0);
    assert_eq!((&forever["margin"]["speed"], &forever["margin"]["time"]), (&Value::Null, &Value::Null));
    assert!(stdout(&run("toss --rate 1,1,2.5 --speed 3 --coin disc")).contains("none in v0, none in g, "));
    let cheated = json("toss --rate 1,1,2.5 --speed 3", 0);
    assert_eq!((&cheated["margin"]["rate"][2], &cheated["margin"]["rate_range"][2]), (&Value::Null, &value!(1000.0)));
    for (option, input) in [("--gravity", "gravity"), ("--tilt", "tilt")] {
        let start = if option == "--tilt" { 0.0 } else { 9.81 };
        let change = cheated["margin"][input].as_f64().unwrap();
        for (part, outcome) in [(0.999_999, "heads"), (1.000_001, "tails")] {
            let command = format!("toss --rate 1,1,2.5 --speed 3 {option} {}", start + part * change);
            assert_eq!(json(&command, 0)["outcome"], outcome, "{command}");
        }
    }
}

#[test]
fn speeds_of_heads_are_found_and_add_up_to_the_probability() {
    let command = "--rate 20,5,3 --speed 3:9 --tilt 0.4";
    let answer = json(&format!("intervals {command}"), 0);
    let intervals = answer["heads"].as_array().unwrap();
    assert!(intervals.len() > 2);
    for interval in intervals {
        let [slow, fast] = [0, 1].map(|end| interval[end].as_f64().unwrap());
        for (speed, outcome) in [(slow + 1e-9, "heads"), (fast - 1e-9, "heads"), (fast + 1e-9, "tails")] {
            let toss = json(&format!("toss --rate 20,5,3 --tilt 0.4 --speed {speed}"), 0);
            assert!(toss["outcome"] == outcome || fast == 9.0, "{speed}");
        }
    }
    let exact = json("probability --rate-x 20 --rate-y 5 --rate-z 3 --tilt 0.4 --speed 3:9 --method exact-speed", 0);
    assert_near(&answer["probability"], exact["probability"].as_f64().unwrap(), 1e-13);
    assert!(stdout(&run("intervals --rate 2,2,0.5 --speed 3:5")).ends_with("share of the range  0.000000000000\n"));
}

#[test]
fn the_inverse_launch_has_the_wanted_probability() {
    // p(60°) from the reference numbers; there cot²ψ = 1/3.
    let answer = json("inverse --probability 0.6081734479693927 --coin disc", 0);
    assert_near(&answer["cone_angle"], std::f64::consts::FRAC_PI_3, 1e-14);
    assert_near(&answer["rate_ratio"], 2.0 * 3f64.sqrt(), 1e-13);
}
