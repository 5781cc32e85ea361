//! Runs the commands about many launches as a user does, and checks their numbers, their refusals and their charts. The
//! libraries have tests of their own; these show that options reach them and answers come back unchanged.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{assert_near, json, run, stderr, stdout};
use serde_json::Value;

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
    assert_eq!((&answer["interval_kind"], &answer["seed"]), (&Value::from("clopper-pearson 95 %"), &Value::from(7)));

    let grid = json("probability --space cheated --method grid --solver quaternion", 0);
    assert_eq!((&grid["heads"], &grid["points"], &grid["interval"]), (&500.into(), &500.into(), &Value::Null));
    let box_of_axes = "probability --rate-x 0:40:20 --rate-y x --rate-z 30 --speed 3:5:20 --method grid";
    assert_eq!(json(box_of_axes, 0)["points"], 400);
    // A disc never flips as long as Ω < k ωz, and here Ω ≤ 56.6 rad/s and k ωz = 60 rad/s.
    assert_eq!(json(&format!("{box_of_axes} --coin disc"), 0)["heads"], 400);
}

#[test]
fn enclosure_reports_a_probability_within_the_accuracy() {
    let found =
        json("probability --rate-x 0:50 --rate-y x --rate-z 30 --speed 3:5 --method enclosure --accuracy 1e-9", 0);
    assert!((found["probability"].as_f64().unwrap() - 0.661_452_104_190_6).abs() < 1e-9, "{found}");
    let [lo, hi] = [0, 1].map(|end| found["interval"][end].as_f64().unwrap());
    assert!(0.0 < hi - lo && hi - lo <= 2e-9 && found["points"].as_u64().unwrap() < 1100, "{found}");
    assert!(lo < 0.661_452_104_190_6 && 0.661_452_104_190_6 < hi && found["proven"] == true, "{found}");
    assert_eq!((&found["method"], &found["seed"]), (&"enclosure".into(), &serde_json::Value::Null));
    for (line, parts) in [
        (
            "--rate-x 0:9 --rate-y x --rate-z 3 --speed normal:3:0.1",
            ["speed [m/s]", "a range of speeds or a single one"],
        ),
        ("--rate-x 0:9 --rate-y x --rate-z 3 --speed 3:5 --drop 1", ["drop [m]", "enclosure"]),
        ("--rate-x 0:9 --rate-y 0:9 --rate-z 0:9 --tilt 0.1:0.2 --speed 3:5", ["method", "at most three coordinates"]),
        ("--space tails --shard 1/2 --out part.json", ["method", "none to number"]),
        ("--space tails --solver gamma", ["solver = 'gamma'", "enclosure"]),
    ] {
        let text = stderr(&run(&format!("probability {line} --method enclosure")));
        assert!(parts.iter().all(|part| text.contains(part)), "{line}: {text}");
    }
}

#[test]
fn exact_speed_reports_a_probability_and_an_error_bound() {
    let exact = json("probability --space tails --method exact-speed", 0);
    assert_eq!((&exact["probability"], &exact["heads"], &exact["seed"]), (&0.0.into(), &Value::Null, &Value::Null));
    assert!(exact["error_bound"].as_f64() < Some(1e-15) && exact["interval_kind"] == "rounding error");
    // The first flip is at t = 0.555955 s, which belongs to v0 = 2.726959 m/s. The next one is beyond 5 m/s.
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
fn a_space_is_read_from_a_file_and_its_errors_have_line_and_column() {
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
fn bad_spaces_and_plans_end_with_2_and_name_field_value_and_range() {}

#[test]
fn the_last_step_of_a_convergence_is_the_result_of_probability() {
    let series = json("convergence --space paper-fig4 --steps 50", 0);
    let last = &series["series"].as_array().unwrap()[49];
    assert_eq!(last["launches"], 250_000);
    for method in ["grid", "random"] {
        let whole = json(&format!("probability --space paper-fig4 --method {method}"), 0);
        assert_eq!(last[method], whole["probability"]);
    }
    let csv = stdout(&run("convergence --space tails --steps 4"));
    assert_eq!(csv.lines().next(), Some("launches,grid,random,random_lo,random_hi"));
    assert_eq!(csv.lines().count(), 5);
}

#[test]
fn errors_are_measured_from_an_accurate_reference_and_smaller_by_exact_speed() {
    let space = "--rate-x 1:60 --rate-y 1:60 --rate-z 1:60 --speed 3:5";
    let lines = json(&format!("errors {space} --up-to 10 --replicates 4"), 0);
    let lines = lines["series"].as_array().unwrap();
    assert_eq!(lines.len(), 5 * 3);
    for line in lines {
        // The probability over this box, from enclosure.
        assert_near(&line["reference"], 0.580_665_055_2, line["reference_error"].as_f64().unwrap());
        assert!(line["rms_error"].as_f64() > Some(0.0), "{line}");
    }
    let error = |method: &str| {
        lines.iter().rfind(|line| line["method"] == method).and_then(|line| line["rms_error"].as_f64()).unwrap()
    };
    assert!(4.0 * error("exact-speed") < error("random"));
    let from_zero = json(&format!("errors {space} --up-to 8 --reference 0"), 0);
    assert!(from_zero["series"][0]["rms_error"].as_f64() > Some(0.5));
}

#[test]
fn a_map_has_a_probability_for_each_node() {
    let command = "map --rate-x 0:40:5 --rate-y 0 --rate-z 20:60:3 --speed 3:5";
    let map = json(command, 0);
    assert_eq!((&map["across"], &map["up"]), (&"rate_x".into(), &"rate_z".into()));
    assert_eq!(map["across_values"], serde_json::json!([0.0, 10.0, 20.0, 30.0, 40.0]));
    // Heads is certain as long as ωx ≤ k ωz.
    assert_eq!((&map["probability"][1][1], &map["probability"][2][2]), (&1.0.into(), &1.0.into()));
    let node = json("probability --rate-x 30 --rate-y 0 --rate-z 40 --speed 3:5 --method exact-speed", 0);
    assert_eq!(map["probability"][1][3], node["probability"]);
    let csv = stdout(&run(command));
    assert!(csv.starts_with("rate_x,rate_z,probability\n0,20,1\n10,20,"));
    assert_eq!(csv.lines().count(), 16);
}

#[test]
fn limit_prints_the_share_of_long_flights_and_its_limit() {
    let lines = json("limit --points 400 --coin us-quarter", 0);
    let lines = lines["series"].as_array().unwrap();
    assert_eq!(lines.len(), 25);
    let at_60 = &lines[12];
    assert_near(&at_60["cone_angle"], std::f64::consts::FRAC_PI_3, 1e-15);
    assert_near(&at_60["limit"], 0.608_173_447_969_392_7, 1e-15);
    assert_near(&at_60["share"], 0.608, 0.1);
    assert_eq!(at_60["launches"], 400);
}

#[cfg(unix)]
#[test]
fn a_command_that_is_killed_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chart.svg");
    let mut child = Command::new(env!("CARGO_BIN_EXE_unfair-toss"))
        .args("errors --space paper-fig4 --up-to 24 --replicates 10000 --svg".split(' '))
        .arg(&path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.try_wait().unwrap(), None, "it is still at work");
    // SIGTERM instead of the SIGINT of Ctrl-C: both end the program, but a test that runs in the background ignores
    // SIGINT.
    let stopped = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(stopped.success());
    let output = child.wait_with_output().unwrap();
    assert!(!output.status.success() && output.stdout.is_empty());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
