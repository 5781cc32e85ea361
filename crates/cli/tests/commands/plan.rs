//! Runs `unfair-toss plan` as a user does, and checks which model it chooses, which it passes over, and what it
//! refuses. Refusals matter here because an option without effect would mislead.

use crate::common::json;

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
