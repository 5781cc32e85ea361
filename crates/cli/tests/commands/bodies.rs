//! Rigid bodies with I1 ≠ I2: how they are given, what answers them, and that no command takes one for a coin.

use crate::common::{json, run, stderr, stdout};

#[test]
fn a_body_with_two_equal_moments_is_the_coin_that_it_always_was() {
    let coin = "--rate 20,3,1 --speed 3 --tilt 0.2";
    for (one, other) in [
        ("--moments 2,3", "--moments 2,2,3"),
        ("--moments 2,3", "--inertia 2,2,3,0,0,0"),
        ("--moments 5e-7,2.5e-7", "--coin paper"),
    ] {
        let [one, other] = [one, other].map(|body| stdout(&run(&format!("toss {body} {coin}"))));
        assert_eq!(one, other);
        assert!(one.contains("margin       ") && one.contains("k = "));
    }
}

#[test]
fn a_proof_does_not_outlive_the_rounding_of_a_unit() {
    let toss = "toss --moments 2,3,4 --rate 0.5,-1.25,2";
    assert_eq!(json(&format!("{toss} --time 250ms"), 0)["certified"], true);
    let rounded = run(&format!("{toss} --time 0.1ms"));
    assert!(stdout(&rounded).contains("heads, not proven: the conversion of a unit"), "{}", stdout(&rounded));
    assert_eq!(json("toss --moments 2kg·m²,3g·cm²,2g·mm² --rate 1,1,1 --time 1", 2)["error"]["field"], "I1 [kg m²]");
}

#[test]
fn plates_rods_and_moments_of_any_size_are_bodies() {
    let toss = "--rate 1,2,3 --speed 3";
    for body in ["1,2,3", "0,1,1", "1,1,0", "1e300,1.5e300,2e300", "1e-300,1.5e-300,2e-300", "0.1,0.7,0.8"] {
        assert_eq!(json(&format!("toss --moments {body} {toss}"), 0)["certified"], true, "{body}");
    }
}

#[test]
fn solvers_for_coins_refuse_a_body_by_a_sentence() {
    let refused = json("toss --coin book --rate 1,2,3 --speed 3 --solver gamma", 1);
    assert_eq!(refused["error"]["kind"], "not_symmetric");
    assert!(
        refused["error"]["message"].as_str().unwrap().starts_with("solver 'gamma' is for bodies with I1 = I2 only")
    );
    let rows = json("compare --coin book --rate 1,2,3 --speed 3 --repeats 0", 0)["rows"].clone();
    let of = |solver: &str| rows.as_array().unwrap().iter().find(|row| row["solver"] == solver).unwrap().clone();
    assert_eq!((&of("exact")["failure"], &of("gamma")["failure"]["kind"]), (&().into(), &"not_symmetric".into()));
}

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
        ("toss --turn 20 --wobble 1 --speed 3".to_owned(), false),
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
