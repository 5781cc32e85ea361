//! How precise a hand must be, the solvers side by side, and what helps at the shell.

use crate::common::{assert_near, json, run, stderr, stdout};
use serde_json::Value;

#[test]
fn tosses_that_are_always_or_never_heads_say_so() {
    let answer = |options: &str| json(&format!("spread {options} --heads 0.95"), 0);
    let always = answer("--coin us-quarter --turn 38rev/s --wobble 15deg --speed 2.4");
    assert_eq!(
        (&always["answer"], &always["spread"], &always["probability"]),
        (&"any".into(), &0.12.into(), &1.0.into())
    );
    let never = answer("--rate 2,2,0.5 --speed 4");
    assert_eq!((&never["answer"], &never["spread"]), (&"toss_is_not_heads".into(), &Value::Null));
    let text = stdout(&run("spread --rate 2,2,0.5 --speed 4 --heads 0.95"));
    assert_eq!(
        text,
        "spread       none is small enough: the toss itself lands tails, and P(heads) goes to 0 with the spread\n"
    );
    let drop = answer("--rate 20,3,4 --speed 3 --drop 1.55");
    assert!(drop["answer"] == "up_to" || drop["answer"] == "toss_is_not_heads", "{drop}");
}

#[test]
fn a_hand_spreads_what_has_a_single_value() {
    let by_spread =
        "probability --rate-x 20 --rate-y x --rate-z 0 --speed 3:4 --spread 5% --method random --points 999";
    let by_axes = "probability --rate-x normal:20:1 --rate-y x --rate-z 0 --speed 3:4 --method random --points 999";
    assert_eq!(json(by_spread, 0)["heads"], json(by_axes, 0)["heads"]);
}

#[test]
fn every_solver_and_scheme_has_a_row_with_its_error_and_work() {
    let toss = "--rate 20,5,3 --speed 3";
    let answer = json(&format!("compare {toss} --formulation all --repeats 1"), 0);
    let rows = answer["rows"].as_array().unwrap();
    // The exact motion; γ and the Euler angles by 3 schemes in 3 formulations; the quaternion by 4 in 2.
    assert_eq!(rows.len(), 1 + 2 * 3 * 3 + 4 * 2);
    let exact = json(&format!("toss {toss}"), 0);
    for row in rows {
        assert!(row["time_ns"].as_f64() > Some(0.0) || row["failure"].is_object(), "{row}");
        if row["solver"] == "exact" {
            assert_eq!((&row["cos_tilt"], &row["cos_tilt_error"]), (&exact["cos_tilt"], &Value::Null));
            continue;
        }
        let word = |key: &str| row[key].as_str().unwrap().to_owned();
        let settings =
            format!("--solver {} --scheme {} --formulation {}", word("solver"), word("scheme"), word("formulation"));
        if row["failure"].is_object() {
            let failed = json(&format!("toss {toss} {settings}"), 1);
            assert_eq!(failed["error"]["kind"], row["failure"]["kind"]);
            continue;
        }
        let alone = json(&format!("toss {toss} {settings}"), 0);
        assert_eq!(
            (&alone["cos_tilt"], &alone["work"]["rhs_calls"]),
            (&row["cos_tilt"], &row["rhs_calls"]),
            "{settings}"
        );
        let error = (alone["cos_tilt"].as_f64().unwrap() - exact["cos_tilt"].as_f64().unwrap()).abs();
        // JSON is read to an ulp.
        assert_near(&row["cos_tilt_error"], error, 3e-16);
        let dot = |of: &Value| -> Vec<f64> {
            of["attitude"].as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect()
        };
        let cos_half: f64 = dot(&alone).iter().zip(dot(&exact)).map(|(a, b)| a * b).sum();
        let angle = 2.0 * cos_half.abs().min(1.0).acos();
        assert_near(&row["attitude_error"], angle, 1e-7);
    }
}

#[test]
fn a_solver_that_fails_says_why_in_its_row() {
    let toss = "compare --rate 0.3,0.3,5 --time 5 --tilt 1 --formulation vertical --repeats 0";
    let answer = json(toss, 0);
    let gamma = answer["rows"].as_array().unwrap().iter().find(|row| row["solver"] == "gamma").unwrap();
    assert_eq!((&gamma["failure"]["kind"], &gamma["cos_tilt"]), (&"singular".into(), &Value::Null));
    let text = stdout(&run(toss));
    let line = text.lines().find(|line| line.starts_with("gamma   dop853")).unwrap();
    assert!(line.contains("the equations of motion are singular (α' = 0)"), "{text}");
    assert!(!text.contains("time\n") && text == stdout(&run(toss)), "without times it is the same in every run");
    let loose = json("compare --rate 20,5,3 --speed 3 --tolerance 1e-5 --repeats 0", 0);
    let tight = json("compare --rate 20,5,3 --speed 3 --tolerance 1e-11 --repeats 0", 0);
    assert!(loose["rows"][1]["rhs_calls"].as_u64() < tight["rows"][1]["rhs_calls"].as_u64());
    assert_eq!(json("compare --rate 1,1,1e300 --time 1", 1)["error"]["kind"], "phase_too_large");
}

const COMMANDS: [&str; 20] = [
    "toss",
    "trace",
    "probability",
    "sample",
    "compare",
    "spread",
    "convergence",
    "errors",
    "map",
    "merge",
    "intervals",
    "inverse",
    "limit",
    "plan",
    "coins",
    "solvers",
    "models",
    "spaces",
    "completions",
    "man",
];

#[test]
fn the_example_of_every_help_text_runs() {
    // The parts that the example of `merge` names.
    let folder = tempfile::tempdir().unwrap();
    for part in 1..=2 {
        let path = folder.path().join(format!("part-{part}.json"));
        let output =
            run(&format!("probability --space paper-fig4 --method random --shard {part}/2 --out {}", path.display()));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    for command in COMMANDS {
        let help = stdout(&run(&format!("{command} --help")));
        let (_, after) = help.split_once("\nExample:\n  unfair-toss ").unwrap_or_else(|| panic!("{command}: {help}"));
        let example = after.lines().next().unwrap();
        assert!(example.starts_with(command), "{example}");
        let output = run(&example.replace("part-", &format!("{}/part-", folder.path().display())));
        assert_eq!(output.status.code(), Some(0), "{example}: {}", stderr(&output));
        assert!(!output.stdout.is_empty(), "{example}");
    }
    let listed = stdout(&run("--help"));
    let listed =
        listed.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).filter(|name| !name.is_empty());
    let listed: Vec<&str> = listed.filter(|name| !name.starts_with('-') && *name != "help").collect();
    assert_eq!(listed, COMMANDS);
}

#[test]
fn help_groups_its_options_and_shows_what_is_required() {
    for command in COMMANDS {
        let help = stdout(&run(&format!("{command} --help")));
        let options =
            help.split_once("\nOptions:\n").map_or("", |(_, rest)| rest.split("\n\n").next().unwrap_or_default());
        let ungrouped: Vec<&str> = options.lines().filter(|line| line.trim_start().starts_with("--")).collect();
        assert!(ungrouped.is_empty(), "{command}: {ungrouped:?}");
    }
    let toss = stdout(&run("toss --help"));
    for words in ["\nCoin (", "\nLaunch (", "\nSolver:", "\nOutput:", "Heads: ", "towards -y", "15deg"] {
        assert_eq!(toss.matches(words).count(), 1, "{words}");
    }
    assert!(
        toss.contains("Usage: unfair-toss toss (--rate WX,WY,WZ | --turn RATE --wobble PSI) (--speed V0 | --time T)")
    );
    // Every column that a table of data has is explained.
    for (command, run_of_it) in [
        ("trace", "trace --rate 1,1,1 --speed 3 --points 2"),
        ("sample", "sample --space tails --points 1"),
        ("convergence", "convergence --space tails --steps 1"),
        ("errors", "errors --space paper-fig4 --up-to 8 --replicates 1"),
        ("limit", "limit --points 1"),
    ] {
        let help = stdout(&run(&format!("{command} --help"))).split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, columns) = help.split_once("Columns: ").unwrap_or_else(|| panic!("{command}"));
        let csv = stdout(&run(run_of_it));
        for column in csv.lines().next().unwrap().split(',').filter(|column| !column.ends_with("_y")) {
            assert!(columns.contains(column), "{command}: {column}");
        }
    }
}

#[test]
fn completions_and_manual_pages_name_the_options() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&run(&format!("completions {shell}")));
        assert!(script.contains("wobble") && script.contains("spread"), "{shell}");
    }
    assert!(stdout(&run("man")).contains(".TH unfair-toss 1"));
    let page = stdout(&run("man toss"));
    assert!(page.contains("wobble") && page.contains("Heads: "), "{page}");
    for (arguments, words) in [
        ("man dance", ["command = 'dance'", "toss, trace"]),
        ("completions tcsh", ["invalid value 'tcsh'", "bash"]),
        ("completions", ["SHELL", "required"]),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(words.iter().all(|word| stderr(&output).contains(word)), "{}", stderr(&output));
    }
}
