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
fn a_plan_with_a_drop_takes_no_exact_speed() {
    let planned = json("probability --space tails --drop 1 --accuracy 1e-2", 0);
    assert_ne!(planned["method"], "exact-speed");
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
