//! Runs `unfair-toss plan` as a user does, and checks which model it chooses, which it passes over, and what it
//! refuses. Refusals matter here because an option without effect would mislead.

use crate::common::{assert_near, assert_refused, json, run, stderr};

/// Asserts that the options are refused because they conflict.
#[track_caller]
fn refused(arguments: &str) {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments}");
    assert!(stderr(&output).contains("cannot be used with"), "{arguments}: {}", stderr(&output));
}

#[test]
fn a_plan_names_its_model_and_those_that_it_passed_over() {
    let thrown = "--rate 1,1,2.5 --speed 3 --accuracy 1e-9";
    let model = |answer: &serde_json::Value| answer["model"].as_str().unwrap_or_default().to_owned();
    for (options, expected) in [
        (format!("{thrown} --want outcome").as_str(), "outcome"),
        (&format!("{thrown} --want tilt"), "tilt"),
        (&format!("{thrown} --want attitude"), "attitude"),
        (&format!("{thrown} --want trace --points 7"), "trace"),
        (&format!("{thrown} --want tilt --drop 0.4"), "tilt"),
        ("--space cheated --want probability --accuracy 1e-6", "share"),
        ("--space paper-fig4 --want probability --accuracy 1e-2", "share-sobol"),
        ("--space paper-fig4 --want probability --accuracy 1e-7", "share-sobol"),
    ] {
        let answer = json(&format!("plan {options}"), 0);
        assert_eq!(model(&answer), expected, "{options}: {answer}");
        assert_eq!(answer["solver"], "exact");
        assert!(answer["expected_cost_ns"].as_f64().is_some_and(|cost| cost > 0.0));
    }
    let asked = json(&format!("plan {thrown} --want attitude --solver gamma --scheme dopri5"), 0);
    assert_eq!((&asked["solver"], &asked["scheme"]), (&"gamma".into(), &"dopri5".into()));
    assert!(asked["tolerance"].as_f64().is_some_and(|tolerance| (1e-14..1e-3).contains(&tolerance)));
    let tilt = json(&format!("plan {thrown} --want tilt"), 0);
    assert_near(&tilt["expected_error"], 0.0, 1e-9);
    let passed_over = tilt["passed_over"].as_array().unwrap();
    assert_eq!(passed_over[0], serde_json::json!({"model": "outcome", "why": "gives only the outcome"}));
}

#[test]
fn only_an_integrator_has_a_scheme_and_only_a_sample_a_method() {
    let toss = "plan --rate 1,1,2.5 --speed 3 --want tilt --accuracy 1e-9 --solver gamma";
    let answer = json(&format!("{toss} --method dopri5"), 0);
    assert_eq!(answer, json(&format!("{toss} --scheme dopri5"), 0));
    assert_eq!((&answer["scheme"], &answer["method"]), (&"dopri5".into(), &serde_json::Value::Null));
    let sample = json("plan --space cheated --want probability --accuracy 1e-6", 0);
    assert_eq!((&sample["scheme"], &sample["method"]), (&serde_json::Value::Null, &"exact-speed".into()));
}

#[test]
fn a_scene_is_read_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let toss = "coin = 'us-quarter'\nlaunch = { rate = [20, 0, 5], speed = 3 }\n";
    for (scene, model) in [("[want.tilt]", "tilt"), ("[want.outcome]", "outcome")] {
        std::fs::write(&path, format!("accuracy = 1e-9\n{scene}\n{toss}")).unwrap();
        assert_eq!(json(&format!("plan --scene {}", path.display()), 0)["model"], model);
    }
    let json_path = folder.path().join("scene.json");
    let text =
        r#"{"accuracy": 1e-3, "want": {"probability": {"rate_x": "0:9", "rate_y": "x", "rate_z": 5, "speed": "3:5"}}}"#;
    std::fs::write(&json_path, text).unwrap();
    assert_eq!(json(&format!("plan --scene {}", json_path.display()), 0)["model"], "share-sobol");
    std::fs::write(&path, format!("accuracy = 1e-9\n[want.tilt]\n{}", toss.replace(" }", ", drag = 1 }"))).unwrap();
    let error = json(&format!("plan --scene {}", path.display()), 2);
    assert!(error["error"]["message"].as_str().unwrap().contains("drag is outside the model"), "{error}");
}

#[test]
fn input_outside_the_model_is_refused_with_the_reason() {
    for (options, kind, words) in [
        ("--drag 0.4", "outside_model", "free of torque and drag"),
        ("--bounce 0.5", "outside_model", "ends at the first landing"),
        ("--moments 1,1.2,2.3", "input", "larger than I1 + I2"),
        ("--drop -9", "input", "drop [m] = -9.0"),
        ("--drop nan", "input", "drop [m] = NaN"),
    ] {
        for command in ["toss", "plan --want tilt --accuracy 1e-9"] {
            let error = &json(&format!("{command} --rate 1,1,2.5 --speed 3 {options}"), 2)["error"];
            assert_eq!(error["kind"], kind, "{options}");
            assert!(error["message"].as_str().unwrap().contains(words), "{error}");
        }
    }
    for (accuracy, shown) in [("0", "0.0"), ("nan", "NaN"), ("1e-17", "1e-17")] {
        let arguments = format!("plan --rate 1,1,2.5 --speed 3 --want tilt --accuracy {accuracy}");
        assert_refused(&[(&arguments, ["accuracy", shown])]);
    }
    json("plan --rate 1,1,2.5 --speed 3 --want tilt --accuracy 1e-9 --solver exact", 2);
    json("plan --rate 1,1,2.5 --speed 3 --want trace --points 1 --accuracy 1e-9", 2);
    json("plan --want tilt --accuracy 1e-9", 2);
    json("plan --want probability --accuracy 1e-9", 2);
    json("plan --space cheated --want tilt --accuracy 1e-9", 2);
    // An option that would have no effect is refused and not ignored.
    for option in ["--tilt 1", "--drag 0.4", "--rate 1,1,1", "--gravity 3"] {
        refused(&format!("plan --space cheated --want probability --accuracy 1e-9 {option}"));
    }
    for option in ["--tilt 1", "--drop 1", "--coin disc", "--gravity 3", "--bounce 1"] {
        refused(&format!("plan --scene scene.toml {option}"));
    }
}
