//! What is refused: bad input, by a message that names the field, the value and the valid range; what would have no effect, for
//! nothing that is asked for is ignored; and what would never end.

use crate::common::{assert_refused, json, run};

#[test]
fn bad_input_ends_with_2_and_names_field_value_and_range() {
    let lines = include_str!("../refusals.txt").lines().filter(|line| !line.starts_with('#'));
    let case = |line: &'static str| {
        let parts: Vec<&str> = line.split(" | ").collect();
        let [arguments, one, other] = parts[..] else { panic!("{line}") };
        (arguments, [one, other])
    };
    let cases: Vec<(&str, [&str; 2])> = lines.map(case).collect();
    assert!(cases.len() > 150, "{}", cases.len());
    assert_refused(&cases);
}

#[test]
fn options_without_effect_with_the_solver_are_refused_and_say_whom_they_are_for() {
    let integrators = "it is for gamma, euler or quaternion";
    for command in [
        "toss --rate 1,1,1 --time 1",
        "trace --rate 1,1,1 --time 1 --points 3",
        "probability --space tails --method grid",
        "convergence --space tails",
        "limit",
        "map --rate-x 0:9:3 --rate-y 0 --rate-z 1:9:3 --speed 3:5",
    ] {
        for (option, words) in [
            ("--scheme dop853", ["scheme = 'dop853' has no effect with solver 'exact'", integrators]),
            ("--tolerance 1e-9", ["tolerance = '1e-9' has no effect with solver 'exact'", integrators]),
            ("--step 1e-3", ["step [s] = '0.001' has no effect with solver 'exact'", integrators]),
            (
                "--formulation vertical",
                ["formulation = 'vertical' has no effect with solver 'exact'", "it is for gamma or euler"],
            ),
        ] {
            assert_refused(&[(&format!("{command} {option}"), words)]);
        }
    }
    let quaternion = "toss --rate 1,1,1 --time 1 --solver quaternion --formulation";
    for formulation in ["momentum", "raw"] {
        assert_eq!(run(&format!("{quaternion} {formulation}")).status.code(), Some(0), "{formulation}");
    }
}

#[test]
fn what_proves_nothing_refuses_to_prove_and_says_why() {
    for command in [
        "toss --rate 1,1,1 --time 1",
        "trace --rate 1,1,1 --time 1 --points 3",
        "probability --space tails --method grid",
    ] {
        for (options, words) in [
            ("", ["--prove has no effect with --solver exact", "it is for quaternion"]),
            ("--solver gamma", ["gamma proves nothing", "no bound of its own error; quaternion has one"]),
            ("--solver euler", ["euler proves nothing", "no bound of its own error; quaternion has one"]),
            ("--solver quaternion --formulation raw", ["proves nothing", "division by the norm"]),
            ("--solver quaternion --scheme dop853", ["proves nothing", "only the scheme taylor"]),
            ("--solver quaternion --scheme rk4 --step 1e-3", ["proves nothing", "only the scheme taylor"]),
        ] {
            assert_refused(&[(&format!("{command} {options} --prove"), words)]);
        }
    }
}

#[test]
fn points_have_an_effect_where_they_are_taken() {
    let free = "--rate-y x --rate-z 1 --speed 3:5";
    for (options, points) in [("--method sobol --points 64 --seed 2", 64), ("--method exact-speed --points 64", 64)] {
        assert_eq!(json(&format!("probability --rate-x 0:9 {free} {options}"), 0)["points"], points);
    }
    assert_eq!(
        json("probability --space tails --method random --points 9", 0)["points"],
        9,
        "names have points for grids"
    );
}

#[test]
fn scenes_and_spaces_are_refused_by_key_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let launch = "launch = { rate = [1, 1, 2], speed = 3 }";
    let json_of = |toss: &str| format!("{{\"accuracy\": 1,\n\"want\": {{\"tilt\":\n{toss}}}}}");
    for (file, text, words) in [
        ("a.toml", format!("accuracy = 1\n[want.tilt]\n{launch}\nspin = 1"), "line 4, column 1: unknown field `spin`"),
        (
            "a.toml",
            "accuracy = 1\n[want.tilt]\nlaunch = { rate = [1, 1, 2, 3], speed = 3 }".to_owned(),
            "line 3, column 19: rate",
        ),
        (
            "a.toml",
            format!("accuracy = 1\n[want.tilt]\n{launch}\ncoin = {{ moments = [1, 1], cylinder = [1, 1, 1] }}"),
            "line 4, column 8: cylinder = 'given twice'",
        ),
        (
            "a.toml",
            format!("accuracy = 1\n[want.tilt]\n{launch}\ncoin = {{ moments = [1, 1], mass = 1 }}"),
            "line 4, column 28: unknown field `mass`",
        ),
        (
            "a.toml",
            "accuracy = 1\n[want.probability]\nrate_x = 1\nrate_y = 1\nrate_z = 1\nspin = 1\nspeed = 3".to_owned(),
            "line 6, column 1: unknown field `spin`",
        ),
        ("a.json", json_of(r#"{"launch": {"rate": [1, 1, 2, 3], "speed": 3}}"#), "line 3, column 32: rate"),
        ("a.json", json_of(r#"{"launch": {"rate": [1, 1, 2], "speed": 3, "spin": 1}}"#), "unknown field `spin`"),
        ("a.json", json_of(r#"{"spin": 1, "launch": {"rate": [1, 1, 2], "speed": 3}}"#), "unknown field `spin`"),
        (
            "a.json",
            json_of(r#"{"coin": {"moments": [1, 1], "cylinder": [1, 1, 1]}}"#),
            "line 3, column 51: cylinder = 'given twice'",
        ),
        (
            "a.json",
            "{\"accuracy\": 1, \"want\": {\"trace\": {\"points\": 3,\n\"spin\": 1}}}".to_owned(),
            "line 2, column 6: unknown field `spin`",
        ),
    ] {
        let path = folder.path().join(file);
        std::fs::write(&path, &text).unwrap();
        let error = json(&format!("plan --scene {}", path.display()), 2)["error"].clone();
        let message = error["message"].as_str().unwrap();
        assert!(message.contains(&format!("{file}, line ")) && message.contains(words), "{text}: {message}");
        assert!(error["line"].as_u64() > Some(0) && error["column"].as_u64() > Some(0), "{error}");
    }
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
