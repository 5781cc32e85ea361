//! A landing below or above the launch, in every command that flies; traces by a step of time; methods that are chosen.

use crate::common::{assert_near, json, run, stderr, stdout};

const SPACE: &str = "--rate-x 1:60:30 --rate-y 4 --rate-z 7 --speed 3:5:20";

#[test]
fn every_command_over_a_space_takes_a_drop() {
    // The same flights: with a drop of h = 1 m the time is (v0 + √(v0² + 2 g h))/g.
    let heads = |options: &str| json(&format!("probability {SPACE} --method grid {options}"), 0)["heads"].as_u64();
    let sampled = stdout(&run(&format!("sample {SPACE} --method grid --drop 1m")));
    let rows: Vec<Vec<&str>> = sampled.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 600);
    for row in &rows {
        let [speed, time] = [row[3], row[8]].map(|cell| cell.parse::<f64>().unwrap());
        assert!((time - (speed + (speed * speed + 2.0 * 9.81).sqrt()) / 9.81).abs() < 1e-15, "{row:?}");
        assert_eq!((row[6], row[11]), ("1.0", "true"));
    }
    let counted = rows.iter().filter(|row| row[10] == "heads").count() as u64;
    assert_eq!(heads("--drop 1m"), Some(counted));
    assert_ne!(heads("--drop 0.5m"), Some(counted));
    assert_eq!(heads("--drop 1 --solver quaternion"), Some(counted));
    for command in [
        &format!("convergence {SPACE} --steps 3 --drop 0.2"),
        "probability --rate-x 1:60 --rate-y 4 --rate-z 7 --speed 3:5 --method sobol --points 64 --drop -0.2",
        "probability --space paper-fig4 --drop 1m --accuracy 1e-2",
        "map --rate-x 1:9:2 --rate-y 4 --rate-z 7:9:2 --speed 3:5 --method random --points 64 --drop 1",
    ] {
        let output = run(command);
        assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
    }
}

#[test]
fn integrating_over_the_speed_is_refused_with_a_drop() {
    // Without a drop exact-speed would be chosen.
    let planned = json("probability --space tails --drop 1 --accuracy 1e-2", 0);
    assert_ne!(planned["method"], "exact-speed");
}

#[test]
fn the_intervals_of_speed_with_a_drop_are_those_of_the_tosses() {
    let command = "--rate 20,5,3 --tilt 0.4 --drop 1.2";
    let answer = json(&format!("intervals --speed 3:9 {command}"), 0);
    let intervals = answer["heads"].as_array().unwrap();
    assert!(intervals.len() > 3);
    let outcome = |speed: f64| json(&format!("toss {command} --speed {speed}"), 0)["outcome"].clone();
    let mut length = 0.0;
    for interval in intervals {
        let [slow, fast] = [0, 1].map(|end| interval[end].as_f64().unwrap());
        length += fast - slow;
        assert_eq!((outcome(slow + 1e-9), outcome(fast - 1e-9)), ("heads".into(), "heads".into()));
        assert!(slow == 3.0 || outcome(slow - 1e-9) == "tails", "{slow}");
        assert!(fast == 9.0 || outcome(fast + 1e-9) == "tails", "{fast}");
    }
    assert_near(&answer["probability"], length / 6.0, 1e-15);
    let level = json("intervals --speed 3:9 --rate 20,5,3 --tilt 0.4 --drop 0", 0);
    assert_eq!(level["heads"], json("intervals --speed 3:9 --rate 20,5,3 --tilt 0.4", 0)["heads"]);
}

#[test]
fn a_trace_by_steps_of_time_ends_at_the_landing() {
    let times = |options: &str| -> Vec<f64> {
        let answer = json(&format!("trace --rate 2,2,0.5 --time 1 {options}"), 0);
        answer["points"].as_array().unwrap().iter().map(|point| point["time"].as_f64().unwrap()).collect()
    };
    assert_eq!(times("--dt 300ms"), [0.0, 0.3, 0.6, 0.3 * 3.0, 1.0]);
    assert_eq!(times("--dt 0.25"), times("--points 5"));
    assert_eq!(times("--dt 0.25 --solver euler"), times("--points 5"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("still.svg");
    let output = run(&format!("trace --rate 1,1,1 --time 0 --dt 1 --svg {}", path.display()));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stdout(&output).lines().count(), 2);
}

#[test]
fn a_probability_without_a_method_is_as_accurate_as_was_asked_for() {
    // The box's probability, known from enclosure.
    let known = 0.580_665_055_2;
    let space = "probability --rate-x 1:60 --rate-y 1:60 --rate-z 1:60 --speed 3:5";
    for accuracy in [1e-2, 1e-3, 1e-4, 1e-5] {
        let found = json(&format!("{space} --accuracy {accuracy}"), 0);
        assert_eq!(found["method"], "exact-speed");
        assert_near(&found["probability"], known, accuracy);
        assert!(found["error_bound"].as_f64() <= Some(accuracy));
    }
    assert_near(&json(space, 0)["probability"], known, 1e-4);
    let text = stdout(&run(space));
    assert!(text.ends_with("method       exact-speed, chosen for an error of 1e-4\n"), "{text}");
}

#[test]
fn a_convergence_has_as_many_steps_as_the_grid_allows() {
    let small = json("convergence --rate-x 0:50:5 --rate-y x --rate-z 30 --speed 3:5:4", 0);
    assert_eq!(small["series"].as_array().unwrap().len(), 20);
    assert_eq!(json("convergence --space paper-fig4", 0)["series"].as_array().unwrap().len(), 500);
}
