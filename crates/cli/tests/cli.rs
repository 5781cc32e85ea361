//! The command line from outside: answers, exit codes, and what goes to standard output.

use std::process::{Command, Output};

use serde_json::Value;

fn run(arguments: &str) -> Output {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().expect("the program starts")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// The one JSON value on standard output of a command that ends with `code`.
#[track_caller]
fn json(arguments: &str, code: i32) -> Value {
    let output = run(&format!("{arguments} --format json"));
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments}: {error}: {}", stdout(&output)))
}

#[track_caller]
fn assert_near(value: &Value, expected: f64, within: f64) {
    let found = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((found - expected).abs() <= within, "{found}, not {expected}");
}

#[test]
fn a_toss_by_every_solver_has_the_reference_digits() {
    let command = "toss --rate 1,1,2.5 --speed 3";
    assert_near(&json(command, 0)["cos_tilt"], 0.665_661_286_601_930_7, 1e-15);
    for solver in ["gamma", "euler", "quaternion"] {
        for method in ["--method dop853", "--method dopri5 --tolerance 1e-11", "--method rk4 --step 1e-4"] {
            let answer = json(&format!("{command} --solver {solver} {method}"), 0);
            assert_near(&answer["cos_tilt"], 0.665_661_286_601_930_7, 1e-9);
            assert_eq!(answer["outcome"], "heads");
            assert_eq!(answer["solver"], solver);
            assert!(answer["work"]["rhs_calls"].as_u64() > Some(20));
        }
    }
}

#[test]
fn the_answer_has_the_fields_of_the_contract() {
    let answer = json("toss --moments 0.04,0.02 --rate 2,4,6 --time 1", 0);
    let fields: Vec<&str> = answer.as_object().unwrap().keys().map(String::as_str).collect();
    for field in ["coin", "flight_time", "cos_tilt", "outcome", "certified", "attitude", "solver", "method", "work"] {
        assert!(fields.contains(&field), "{field}");
    }
    assert_eq!(fields.len(), 9);
    // Kane's body.
    assert_near(&answer["cos_tilt"], 0.740_109_893_087_048_3, 1e-15);
    for (part, expected) in
        [-0.304_936_388_530_335_6, 0.333_018_098_445_657_3, -0.137_999_998_420_704_2, -0.881_515_028_512_617_2]
            .iter()
            .enumerate()
    {
        let sign = -answer["attitude"][0].as_f64().unwrap().signum();
        assert_near(&answer["attitude"][part], sign * expected, 1e-15);
    }
    assert_eq!(answer["coin"]["i3"], 0.02);
    assert_eq!(answer["method"], Value::Null);
    assert_eq!(answer["certified"], false);
    assert_eq!(json("toss --rate 1,1,1 --time 1 --solver euler --method rk4", 0)["method"], "rk4");
}

#[test]
fn coins_launches_and_tilts_reach_the_solver() {
    assert_near(&json("toss --rate 1,1,2.5 --speed 5 --coin disc", 0)["cos_tilt"], 0.966_792_675_866_465, 1e-15);
    assert_near(&json("toss --rate 0,0,3 --time 1 --tilt 0.5", 0)["cos_tilt"], 0.5_f64.cos(), 1e-15);
    assert_near(&json("toss --rate 1,2,3 --speed 3 --gravity 1.62", 0)["flight_time"], 6.0 / 1.62, 0.0);
    let cylinder = json("toss --cylinder 0.00567,0.01213,0.00175 --rate 1,1,1 --time 1", 0);
    assert_eq!(cylinder["coin"], json("toss --coin us-quarter --rate 1,1,1 --time 1", 0)["coin"]);
    assert_eq!(json("toss --rate 2,2,0.5 --speed 4", 0)["outcome"], "tails");
    assert_eq!(json("toss --rate -0,0,0 --time 0", 0)["outcome"], "heads");
}

#[test]
fn bad_input_ends_with_2_and_names_field_value_and_range() {
    for (arguments, words) in [
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
        ("toss --rate 1,1,1 --time 1 --solver gamma --method euler", ["method = 'euler'", "dopri5"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --frame sideways", ["frame = 'sideways'", "momentum, vertical"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --tolerance 0", ["tolerance = 0.0", "2.220446049250313e-16"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --tolerance 1e-17", ["tolerance = 1e-17", "<= tolerance < 1"]),
        ("toss --rate 1,1,1 --time 1 --solver gamma --method rk4 --step 0", ["step [s] = 0.0", "> 0"]),
        (
            "toss --rate 1,1,1 --time 1 --solver gamma --method rk4 --tolerance 1e-9",
            ["--tolerance", "rk4 takes --step"],
        ),
        ("toss --rate 1,1,1 --time 1 --solver gamma --step 1e-3", ["--step is for rk4", "dop853"]),
        ("trace --rate 1,1,1 --time 1 --points 1", ["points = '1'", "2 to 1000000"]),
        (
            "trace --rate 1,1,1 --time 1 --points 3 --svg /no/such/folder/x.svg",
            ["/no/such/folder/x.svg", "cannot write"],
        ),
        ("probability --space moon --method grid", ["space = 'moon'", "paper-fig4"]),
        ("probability --space tails --method random --points 0", ["points = 0.0", "at least 1"]),
        ("probability --space tails --method grid --points 9", ["--points: a grid", "axes"]),
        ("probability --space tails --method sobol --points 9", ["points = '9'", "a multiple of"]),
        ("probability --space tails --method exact-speed --solver gamma", ["exact-speed", "leave --solver out"]),
        ("probability --space tails.toml --method grid", ["cannot read tails.toml", "No such file"]),
        ("probability --rate-x 1 --rate-y 1 --rate-z 1 --method grid", ["speed [m/s] is missing", "a range"]),
        ("probability --rate-y x --rate-z 1 --speed 3:5:9 --method grid", ["rate y [rad/s] = 'x'", "a tie"]),
        (
            "probability --rate-x 1 --rate-y 1 --rate-z 1 --speed normal:4:1 --method random",
            ["speed [m/s] = -4.3", ">= 0"],
        ),
        (
            "probability --rate-x 1 --rate-y 1 --rate-z 1 --speed 4 --gravity 0:9 --method random",
            ["gravity [m/s²] = 0.0", "> 0"],
        ),
        ("probability --method grid", ["--space", "--rate-x"]),
        ("probability --space tails --method grid --threads 0", ["threads = 0", "1 to 1024"]),
        (
            "probability --rate-x 5:3 --rate-y x --rate-z 1 --speed 3:5:9 --method grid",
            ["rate x [rad/s] = 3.0", "at or above the lower bound"],
        ),
        (
            "probability --rate-x 0:3 --rate-y x --rate-z 1 --speed 3:5:9 --method grid",
            ["rate x [rad/s] = '0:3'", "LO:HI:POINTS"],
        ),
        (
            "probability --rate-x 0:3:0 --rate-y x --rate-z 1 --speed 3:5:9 --method grid",
            ["rate x [rad/s] = 0.0", "at least 2 grid points"],
        ),
        ("probability --rate-x 1 --rate-y x --rate-z 1 --speed -1:5:9 --method grid", ["speed [m/s] = -1.0", ">= 0"]),
    ] {
        let output = run(arguments);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        assert!(output.stdout.is_empty(), "{arguments} printed {}", stdout(&output));
        for word in words {
            assert!(message.contains(word), "{arguments}: '{message}' lacks '{word}'");
        }
        if !arguments.starts_with("trace") {
            let error = json(arguments, 2);
            assert!(error["error"]["message"].as_str().unwrap().contains(words[0]), "{arguments}: {error}");
        }
    }
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
        "probability --space tails",
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments}");
    }
}

#[test]
fn a_solver_that_fails_ends_with_1_and_a_typed_error() {
    let phase = json("toss --rate 1,1,1e300 --time 1", 1);
    assert_eq!(phase["error"]["kind"], "phase_too_large");
    assert!(phase["error"]["phase"].as_f64() > Some(9e15));
    assert!(phase["error"]["message"].as_str().unwrap().starts_with("outcome not determined"));

    let stops = json("toss --rate 0.3,0.3,5 --time 5 --tilt 1 --solver gamma --frame vertical", 1);
    assert_eq!(stops["error"]["kind"], "singular");
    assert_eq!(stops["error"]["point"], "α' = 0");
    assert!(stops["error"]["time"].as_f64().unwrap() > 0.0);

    let steps = json("toss --rate 1,1,1 --time 1 --solver quaternion --method rk4 --step 1e-9", 1);
    assert_eq!(steps["error"]["kind"], "step_limit");
    assert_eq!(steps["error"]["limit"], 1_000_000);

    let space = "probability --rate-x 9 --rate-y x --rate-z 0 --speed 3:5:9 --method grid";
    let launch = json(&format!("{space} --solver gamma --frame vertical"), 1);
    assert_eq!(launch["error"]["launch"]["index"], 0);
    assert_eq!(launch["error"]["launch"]["rate"][0], 9.0);
}

#[test]
fn a_trace_starts_at_launch_and_ends_at_landing() {
    let trace = json("trace --rate 2,2,0.5 --speed 3 --points 5", 0);
    let points = trace["points"].as_array().unwrap();
    assert_eq!(points.len(), 5);
    assert_eq!(points[0]["time"], 0.0);
    assert_eq!(points[0]["attitude"][0], 1.0);
    assert_near(&points[4]["time"], 6.0 / 9.81, 0.0);
    assert_near(&points[4]["cos_tilt"], -0.156_081_419_013_723_6, 1e-15);
    assert_near(&points[4]["normal"][2], -0.156_081_419_013_723_6, 1e-15);

    let csv = stdout(&run("trace --rate 2,2,0.5 --speed 3 --points 5 --solver euler"));
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 6);
    assert_eq!(lines[0].split(',').count(), 15);
    assert!(lines[0].starts_with("time,w,x,y,z,alpha,beta,gamma,normal_x"));
    let landing: Vec<f64> = lines[5].split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!((landing[14] + 0.156_081_419_013_723_6).abs() < 1e-8);
}

#[test]
fn a_chart_is_written_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight.svg");
    let output = run(&format!("trace --rate 9,4,30 --speed 4 --points 200 --svg {}", path.display()));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let svg = std::fs::read_to_string(&path).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(svg.contains("cos θ") && svg.contains("time [s]"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no half-written neighbour stays behind");
}

#[test]
fn probabilities_are_counts_that_do_not_depend_on_threads() {
    let answers = [1, 2, 8].map(|threads| {
        json(&format!("probability --space paper-fig4 --method random --points 20000 --seed 7 --threads {threads}"), 0)
    });
    assert!(answers.iter().all(|answer| *answer == answers[0]));
    let answer = &answers[0];
    let [heads, tails, undecided] = ["heads", "tails", "undecided"].map(|key| answer[key].as_u64().unwrap());
    assert_eq!((heads + tails + undecided, answer["points"].as_u64()), (20_000, Some(20_000)));
    assert_near(&answer["probability"], heads as f64 / 20_000.0, 0.0);
    let [lo, hi] = [0, 1].map(|end| answer["interval"][end].as_f64().unwrap());
    assert!(lo < 0.66 && 0.66 < hi && hi - lo < 0.014);
    assert_eq!((&answer["interval_kind"], &answer["seed"]), (&Value::from("wilson 95 %"), &Value::from(7)));

    let grid = json("probability --space cheated --method grid --solver quaternion", 0);
    assert_eq!((&grid["heads"], &grid["points"], &grid["interval"]), (&500.into(), &500.into(), &Value::Null));
    let box_of_axes = "probability --rate-x 0:40:20 --rate-y x --rate-z 30 --speed 3:5:20 --method grid";
    assert_eq!(json(box_of_axes, 0)["points"], 400);
    // A disc with Ω ≤ 56.6 rad/s < k ωz = 60 rad/s never flips.
    assert_eq!(json(&format!("{box_of_axes} --coin disc"), 0)["heads"], 400);
}

#[test]
fn exact_speed_reports_a_probability_and_an_error_bound() {
    let exact = json("probability --space tails --method exact-speed", 0);
    assert_eq!((&exact["probability"], &exact["heads"], &exact["seed"]), (&0.0.into(), &Value::Null, &Value::Null));
    assert!(exact["error_bound"].as_f64() < Some(1e-15) && exact["interval_kind"] == "rounding error");
    // A flip within the range: the first at t = 0.555955 s, v0 = 2.726959 m/s (and the next after 5 m/s).
    let flips = json("probability --rate-x 2 --rate-y 2 --rate-z 0.5 --speed 2:4 --method exact-speed", 0);
    assert_near(&flips["probability"], (9.81 * 0.555_955 / 2.0 - 2.0) / 2.0, 2e-6);

    let sampled = json("probability --space paper-fig4 --method exact-speed --points 16384 --threads 2", 0);
    assert_eq!((&sampled["points"], &sampled["seed"]), (&16_384.into(), &1.into()));
    let (p, bound) = (sampled["probability"].as_f64().unwrap(), sampled["error_bound"].as_f64().unwrap());
    assert!((p - 0.661_452_1).abs() < bound && bound < 1e-4, "{sampled}");
    let grid = json("probability --space paper-fig4 --method exact-speed", 0);
    assert_eq!((&grid["points"], &grid["interval"], &grid["error_bound"]), (&500.into(), &Value::Null, &Value::Null));
}

#[test]
fn sobol_points_are_counted_with_an_interval_from_scrambles() {
    let answer = json("probability --space paper-fig4 --method sobol --points 65536 --seed 4", 0);
    let [heads, tails] = ["heads", "tails"].map(|key| answer[key].as_u64().unwrap());
    assert_eq!((heads + tails, &answer["seed"]), (65_536, &4.into()));
    assert_eq!(answer["interval_kind"], "student 95 % of 8 scrambles");
    assert!(answer["interval"][1].as_f64().unwrap() - answer["interval"][0].as_f64().unwrap() < 5e-3);
}

#[test]
fn a_space_is_read_from_a_file_and_its_faults_are_found_by_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let command = format!("probability --space {} --method grid", path.display());
    std::fs::write(&path, "coin = 'disc'\nrate_x = '0:40:20'\nrate_y = 'x'\nrate_z = 30\nspeed = '3:5:20'\n").unwrap();
    assert_eq!(json(&command, 0)["heads"], 400);
    assert!(json(&format!("{command} --coin paper"), 0)["tails"].as_u64() > Some(0));
    std::fs::write(&path, "rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = '5:3'\n").unwrap();
    let error = json(&command, 2);
    assert_eq!((&error["error"]["line"], &error["error"]["column"]), (&4.into(), &9.into()));
    let message = stderr(&run(&command));
    assert!(message.contains("mine.toml, line 4, column 9: speed [m/s] = 3.0 is outside"), "{message}");
}

#[test]
fn lists_name_everything() {
    let coins = json("coins", 0);
    assert!(coins.as_array().unwrap().len() >= 14);
    assert!(coins.as_array().unwrap().iter().all(|coin| coin["source"].as_str().is_some_and(|text| !text.is_empty())));
    let names = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|line| line["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names(&json("solvers", 0)), ["exact", "gamma", "euler", "quaternion"]);
    assert_eq!(names(&json("spaces", 0)), ["paper-fig4", "cheated", "tails"]);
    for list in ["coins", "solvers", "spaces"] {
        let text = stdout(&run(list));
        assert!(names(&json(list, 0)).iter().all(|name| text.contains(name.as_str())), "{list}");
    }
}

#[test]
fn a_closed_pipe_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_unfair-toss"))
        .args(["trace", "--rate", "9,4,3", "--speed", "4", "--points", "20000"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
