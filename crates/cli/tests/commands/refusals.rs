//! What is refused: bad input, by a message that names the field, the value and the valid range; what would have no effect, for
//! nothing that is asked for is ignored; and what would never end.

use std::process::Command;

use serde_json::Value;

use crate::common::{assert_refused, json, run, stderr, stdout};

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
        // What is only refused is not offered.
        assert!(!message.contains("drag") && !message.contains("wobble"), "{message}");
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
    assert_eq!(json(&format!("plan --scene {}", json_path.display()), 0)["model"], "share-enclosure");
    std::fs::write(&path, format!("accuracy = 1e-9\n[want.tilt]\n{}", toss.replace(" }", ", drag = 1 }"))).unwrap();
    let error = json(&format!("plan --scene {}", path.display()), 2);
    assert!(error["error"]["message"].as_str().unwrap().contains("drag is outside the model"), "{error}");
}

/// The program with arguments that may hold blanks, and its message.
fn said(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    stderr(&output)
}

#[test]
fn what_others_wrote_is_printed_and_does_nothing_to_the_terminal() {
    let hostile = "\u{1b}[31mred\u{7}\nerror: fake\u{202e}";
    let shown = r"\u{1b}[31mred\u{7}\nerror: fake\u{202e}";
    let folder = tempfile::tempdir().unwrap();
    let path = |ending: &str| folder.path().join(format!("{hostile}{ending}")).display().to_string();
    let [csv, toml, json] = [".csv", ".toml", ".json"].map(path);
    std::fs::write(&csv, "person,same,tosses\n\"a\u{1b}[31m\",1,2\nb,x,2\n").unwrap();
    std::fs::write(&toml, "x").unwrap();
    std::fs::write(&json, "{}").unwrap();
    for arguments in [
        &["toss", "--coin", hostile, "--rate", "1,1,2", "--speed", "3"][..],
        &["toss", "--rate", "1,1,2", "--time", hostile],
        &["toss", &format!("--{hostile}")],
        &["sample", &format!("--{hostile}")],
        &[hostile],
        &["inverse", "--counts", &csv],
        &["probability", "--space", &toml],
        &["plan", "--scene", &toml],
        &["merge", &json],
        &["merge", &path("none")],
    ] {
        let said = said(arguments);
        assert!(said.contains(shown), "{arguments:?}: {said}");
        assert!(!said.contains(['\u{1b}', '\u{7}', '\u{202e}']), "{arguments:?}: {said}");
        assert!(said.starts_with("error: ") && !said.contains("\nerror:"), "{arguments:?}: {said}");
    }
    // Answers and charts, too.
    std::fs::write(&csv, "person,same,tosses\n\"a\u{1b}[31m\nc\",1,2\nb,1,2\n").unwrap();
    std::fs::write(&toml, "rate_x = '1:2:3'\nrate_y = 1\nrate_z = '1:2:3'\nspeed = 3").unwrap();
    let out = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        stdout(&output)
    };
    let table = out(&["inverse", "--counts", &csv]);
    assert!(table.contains("\na\\u{1b}[31m\\nc  1 "), "{table}");
    let hidden = |text: &str| text.chars().any(|letter| letter != '\n' && whole_file::is_hidden(letter));
    for text in [
        out(&["inverse", "--counts", &csv, "--format", "json"]),
        out(&["map", "--space", &toml, "--method", "random", "--points", "9", "--svg", "-"]),
        out(&["probability", "--space", &toml, "--method", "grid", "--shard", "1/1", "--out", &path("part")]),
    ] {
        assert!(!hidden(&text), "{text:?}");
    }
    let answer: Value = serde_json::from_str(&out(&["inverse", "--counts", &csv, "--format", "json"])).unwrap();
    assert_eq!((&answer["people"][0]["person"], &answer["input"]["counts"]), (&"a\u{1b}[31m\nc".into(), &csv.into()));
}

/// A mark of UTF-8, an ending in capitals, UTF-16, and the one form of a place.
#[test]
fn files_are_read_as_editors_write_them_and_their_mistakes_have_a_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &[u8]| {
        let path = folder.path().join(name).display().to_string();
        std::fs::write(&path, text).unwrap();
        path
    };
    let scene = r#"{"accuracy": 1e-9, "want": {"tilt": {"launch": {"rate": [1, 1, 2], "speed": 3}}}}"#;
    let space = "rate_x = '1:2'\nrate_y = 1\nrate_z = 1\nspeed = 3\n";
    let part = stdout(&run("probability --space tails --method random --points 9 --shard 1/1 --out -"));
    let commands = [
        ("plan --scene", "x.JSON", scene),
        ("plan --scene", "x.Toml", "accuracy = 1e-9\n[want.tilt]\nlaunch = { rate = [1, 1, 2], speed = 3 }\n"),
        ("probability --method random --points 9 --space", "S.TOML", space),
        ("plan --want probability --accuracy 1e-2 --space", "S.TOML", space),
        ("inverse --counts", "c.CSV", "same,tosses\n3,4\n"),
        ("merge", "part.json", &part),
    ];
    for (command, name, text) in commands {
        let path = file(name, format!("\u{feff}{text}").as_bytes());
        let output = run(&format!("{command} {path}"));
        assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
        for (bytes, place, words) in [
            (&b"\xff\xfex\0"[..], "line 1, column 1", "the text is not UTF-8 but looks like UTF-16; save it as UTF-8"),
            (b"\xe9", "line 1, column 1", "the text is not UTF-8"),
        ] {
            let message = stderr(&run(&format!("{command} {}", file(name, bytes))));
            assert_eq!(message, format!("error: {path}, {place}: {words}\n"), "{command}");
        }
    }
    for (command, name, text, words) in [
        (
            "plan --scene",
            "a.json",
            "{\r\"accuracy\": \"x\"}",
            "line 2, column 15: invalid type: string \"x\", expected a number",
        ),
        ("plan --scene", "a.json", "", "line 1, column 1: the text ends within a value"),
        (
            "plan --scene",
            "a.json",
            r#"{"want": "tilt"}"#,
            "line 1, column 15: invalid type: string \"tilt\", expected a table",
        ),
        (
            "plan --scene",
            "a.toml",
            "accuracy = 1\r\nwant = 'tilt'",
            "line 2, column 8: invalid type: string \"tilt\", expected a table",
        ),
        (
            "plan --scene",
            "a.toml",
            "accuracy = true",
            "line 1, column 12: invalid type: boolean `true`, expected a number",
        ),
        ("probability --space", "a.toml", "rate_x = 1\n", "line 1, column 11: rate y [rad/s] is missing"),
        ("merge", "a.json", r#"{"range": 5}"#, "line 1, column 11: invalid type: number `5`, expected a list of 2"),
        ("merge", "a.json", r#"{"range": [0, 1], "range": [0, 1]}"#, "line 1, column 25: duplicate field `range`"),
        ("inverse --counts", "a.csv", "same;tosses\r\n3;4\r\n5;x\r\n", "line 3, column 2: tosses = 'x' can't be used"),
        ("inverse --counts", "a.csv", "same,tosses\n3\n", "line 2, column 1: 1 cell, but the heading has 2"),
    ] {
        let path = file(name, text.as_bytes());
        let error = json(&format!("{command} {path}"), 2)["error"].clone();
        let message = error["message"].as_str().unwrap();
        assert!(message.starts_with(&format!("{path}, {words}")), "{command} {text}: {message}");
        assert_eq!(error["path"], path.as_str());
    }
}

/// Where no thread can be started, one is enough for one, more are refused with the way out, and a command that has no threads
/// needs none.
#[cfg(target_os = "linux")]
#[test]
fn threads_that_cannot_start_are_no_bad_input_and_one_needs_none() {
    let program = env!("CARGO_BIN_EXE_unfair-toss");
    let limited = |arguments: &str| {
        // Root has no limit.
        let words = format!("setpriv --reuid=65534 --clear-groups prlimit --nproc=1 -- {program} {arguments}");
        let words: Vec<&str> = words.split(' ').collect();
        Command::new(words[0]).args(&words[1..]).output()
    };
    let estimate = "probability --space paper-fig4 --method random --points 100000 --format json --threads";
    let Ok(one) = limited(&format!("{estimate} 1")) else { return };
    if stderr(&one).contains("setpriv") || stderr(&one).contains("prlimit") {
        return;
    }
    assert_eq!(one.status.code(), Some(0), "{}", stderr(&one));
    let two = limited(&format!("{estimate} 2")).unwrap();
    assert_eq!(two.status.code(), Some(1));
    let said = stderr(&two);
    assert!(said.starts_with("error: cannot start 2 threads: ") && said.ends_with("; try --threads 1\n"), "{said}");
    let error: Value = serde_json::from_str(&stdout(&two)).unwrap();
    assert_eq!(error["error"]["kind"], "threads");
    for arguments in [
        "plan --space tails --want probability --accuracy 1e-2",
        "intervals --rate 1,1,2 --speed 2:3",
        "toss --rate 1,2,3 --moments 1,2,2.5 --time 0.1 --margin",
    ] {
        let alone = limited(arguments).unwrap();
        assert_eq!(
            (alone.status.code(), &alone.stdout),
            (Some(0), &run(arguments).stdout),
            "{arguments}: {}",
            stderr(&alone)
        );
    }
}
