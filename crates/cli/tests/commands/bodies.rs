//! Rigid bodies with I1 ≠ I2: how they are given, what answers them, and that no command takes one for a coin.

use crate::common::{json, run, stderr, stdout};

/// Every command that takes a coin either answers for a body, differently than for a coin, or refuses it.
#[test]
fn no_command_takes_a_body_for_a_coin() {
    let toss = "--rate 20,5,3 --speed 3";
    let space = "--rate-x 20:30:3 --rate-y 5 --rate-z 3:9:3 --speed 3:4:3";
    let mapped = "--rate-x 20:30:3 --rate-y 5 --rate-z 3:9:3 --speed 3:4";
    let drawn = "--rate-x 20:30 --rate-y 5 --rate-z 3 --speed 3:4";
    for (command, answers) in [
        (format!("toss {toss}"), true),
        (format!("trace {toss} --points 3"), true),
        (format!("compare {toss} --repeats 0"), true),
        (format!("spread {toss} --heads 0.6 --points 64"), true),
        (format!("plan {toss} --want tilt --accuracy 1e-3"), true),
        (format!("plan {toss} --want tilt --accuracy 1e-3 --solver quaternion"), true),
        ("toss --turn 20 --psi 1 --speed 3".to_owned(), false),
        ("intervals --rate 20,5,3 --speed 3:4".to_owned(), true),
        ("inverse --probability 0.7".to_owned(), false),
        ("limit --points 9".to_owned(), false),
        (format!("probability {space} --method grid"), true),
        (format!("probability {drawn} --method random --points 999"), true),
        (format!("probability {drawn} --method exact-speed"), false),
        (format!("probability {drawn} --accuracy 0.1"), true),
        (format!("sample {space} --method grid"), true),
        (format!("map {mapped}"), false),
        (format!("map {mapped} --method sobol --points 64"), true),
        (format!("convergence {space}"), true),
        (format!("errors {drawn} --up-to 8 --replicates 1"), false),
        ("plan --space tails --want probability --accuracy 0.1".to_owned(), true),
        ("probability --space paper-fig4 --method random --points 999".to_owned(), true),
    ] {
        for body in ["--coin us-quarter-engraved", "--moments 1,1.5,2", "--inertia 2,2,3,0.1,0,0"] {
            let output = run(&format!("{command} {body}"));
            let coin = run(&format!("{command} --coin us-quarter"));
            assert_eq!(coin.status.code(), Some(0), "{command}: {}", stderr(&coin));
            if answers {
                assert_eq!(output.status.code(), Some(0), "{command} {body}: {}", stderr(&output));
                // Counts of a few launches may be the same for a body that is nearly a coin.
                assert!(body != "--moments 1,1.5,2" || stdout(&output) != stdout(&coin), "{command} {body}");
            } else {
                let said = stderr(&output);
                assert_eq!(output.status.code(), Some(2), "{command} {body}: {said}");
                assert!(said.contains("I1 ≠ I2"), "{command} {body}: {said}");
            }
        }
    }
}

#[test]
fn a_body_at_rest_and_flat_has_angles_of_0_as_a_coin_has() {
    for body in ["us-quarter", "racket"] {
        let points = json(&format!("trace --coin {body} --rate 0,0,0 --time 1 --points 2"), 0)["points"].clone();
        for point in points.as_array().expect("points") {
            assert!(["alpha", "beta", "gamma"].iter().all(|angle| point[*angle] == 0.0), "{body}: {point}");
        }
    }
}
