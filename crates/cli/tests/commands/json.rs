//! JSON as a contract: every field of every command is the one that `docs/json.md` lists, and bad input is JSON too.

use std::collections::BTreeSet;

use crate::common::{json, run, stderr, stdout};
use crate::fields::{Fields, collect, documented};

/// Every field that was found is documented with its type, and every documented one was found.
#[track_caller]
fn assert_documented(found: &Fields, documented: &Fields) {
    for (path, types) in found {
        let known = documented.get(path).unwrap_or_else(|| panic!("{path} is not documented"));
        assert!(types.is_subset(known), "{path}: {types:?}, documented {known:?}");
    }
    for (path, types) in documented {
        let seen = found.get(path).unwrap_or_else(|| panic!("{path} is documented and was not found"));
        assert!(types.iter().all(|of| seen.contains(of)), "{path}: documented {types:?}, found {seen:?}");
    }
}

/// Runs of each command that together show all of its fields with all of their types.
const ANSWERS: &[(&str, &[&str])] = &[
    (
        "toss",
        &[
            "--rate 1,1,2.5 --speed 3 --gravity 9.8 --drop 0.1 --tilt 0.1 --coin disc",
            "--turn 38rev/s --psi 60deg --speed 3 --drop 10cm",
            "--rate 2,2,0.5 --speed 3 --moments 1,1",
            "--rate 1,1,2.5 --time 1 --cylinder 1,1,1 --solver gamma --scheme rk4 --step 1e-3 --formulation vertical",
            "--rate 1,1,2.5 --time 1 --solver quaternion --tolerance 1e-9",
            "--rate 1,1,2.5 --time 1 --inertia 2,3,4,0.1,0.2,0.3 --attitude 1,0,0.5,0",
            "--coin racket --rate 1,12,3 --speed 3 --margin",
            "--rate 1,1,2.5 --time 1 --solver quaternion --prove",
            "--rate 1,1,2.5 --speed 240cm/s",
            "--rate 1,1,2.5 --time 500ms --solver quaternion --scheme rk4 --step 1ms",
            "--coin book --rate 1rpm,1deg/s,2rpm --time 1",
        ],
    ),
    (
        "trace",
        &[
            "--rate 1,1,2.5 --speed 3 --points 3",
            "--turn 3 --psi 1 --speed 3 --dt 0.3 --solver quaternion --prove",
            "--rate 1,1,2.5 --time 1 --dt 300ms",
        ],
    ),
    (
        "probability",
        &[
            "--space tails --method grid",
            "--space tails --method grid --solver quaternion --prove",
            "--space tails --method exact-speed",
            "--space paper-fig4 --method exact-speed",
            "--rate-x 1:9 --rate-y x --rate-z 3 --speed 3:4 --method enclosure --accuracy 1e-6",
            "--rate-x 1:2 --rate-y x --rate-z 3 --speed 3:4 --gravity 9:10 --tilt 0.1 --method random --points 99 --seed 2",
            "--space tails --method random --points 9 --seed 18446744073709551615",
            "--space tails --method random --points 1e12 --seconds 50ms",
            "--rate-x 1:60 --rate-y 1:60 --rate-z 1:60 --speed 3:5 --tilt 0.1 --method enclosure --seconds 0.1",
            "--turn 30 --psi 1 --speed 3 --spread 0.05 --drop 0.5 --accuracy 1e-2",
            "--turn 30 --psi 1 --speed 3 --spread 5% --accuracy 1e-2",
            "--rate-x 9 --rate-y 5 --rate-z 3 --speed 3:5 --method random --points 9 --solver quaternion --scheme rk4 --step 0.1",
        ],
    ),
    ("merge", &["PART-OF-RANDOM", "PART-OF-GRID", "PART-OF-EXACT-SPEED", "PART-OF-SOBOL"]),
    (
        "compare",
        &[
            "--rate 0.3,0.3,5 --time 5 --tilt 1 --formulation vertical --repeats 1",
            "--rate 1,1,1 --speed 3 --repeats 0",
        ],
    ),
    (
        "spread",
        &[
            "--rate 20,0,5 --speed 3.5 --heads 90% --points 512",
            "--rate 0.3,0,0.1 --speed 3 --heads 0.9 --points 512",
            "--rate 2,2,0.5 --speed 3 --heads 0.9",
            "--rate 1,1,9 --speed 3 --heads 0.9 --points 512",
        ],
    ),
    (
        "convergence",
        &[
            "--space tails --steps 3",
            "--rate-x 40 --rate-y 5 --rate-z 9:20:3 --speed 3:5:3 --solver quaternion --scheme rk4 --step 0.1 --steps 3",
        ],
    ),
    (
        "errors",
        &[
            "--space paper-fig4 --up-to 8 --replicates 1 --reference 0.5",
            "--space paper-fig4 --up-to 8 --replicates 1 --reference 50%",
        ],
    ),
    (
        "map",
        &[
            "--rate-x 0:9:2 --rate-y 0 --rate-z 1:9:2 --speed 3:5",
            "--rate-x 8:9:2 --rate-y 5 --rate-z 8:9:2 --speed 3:5 --method random --points 9 --solver quaternion --scheme rk4 --step 0.1",
        ],
    ),
    ("intervals", &["--rate 1,1,2 --speed 2:3", "--rate 2,2,0.5 --speed 3:5"]),
    (
        "inverse",
        &[
            "--probability 0.7",
            "--probability 70%",
            "--counts 50/100",
            "--counts 9/100",
            "--counts PEOPLE",
            "--counts ORDER",
        ],
    ),
    (
        "power",
        &[
            "--people 25 --flips 200",
            "--people 30",
            "--people 60",
            "--share 70% --sd 0.4 --power 0.9 --people 2 --flips 9",
        ],
    ),
    ("limit", &["--points 9", "--points 2 --solver quaternion --scheme rk4 --step 0.01"]),
    (
        "plan",
        &[
            "--rate 1,1,1 --speed 3 --want attitude --accuracy 1e-6 --solver gamma",
            "--space cheated --want probability --accuracy 1e-3",
            "--scene SCENE",
        ],
    ),
    ("coins", &[""]),
    ("solvers", &[""]),
    ("models", &[""]),
    ("spaces", &[""]),
];

#[test]
fn every_field_of_every_command_is_documented_and_every_documented_field_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, "accuracy = 1e-9\n[want.tilt]\nlaunch = { rate = [1, 1, 2], speed = 3 }\n").unwrap();
    let people = folder.path().join("people.csv");
    std::fs::write(&people, "same,tosses\n56,100\n60,100\n30,100\n").unwrap();
    let order = folder.path().join("order.csv");
    std::fs::write(&order, "person,start,lands,rule\nA,H,HTHHT,last\nB,H,HTTHH,last\n").unwrap();
    let parts = ["RANDOM", "GRID", "EXACT-SPEED", "SOBOL"].map(|method| {
        let path = folder.path().join(format!("{method}.json")).display().to_string();
        let space = if method == "EXACT-SPEED" { "tails" } else { "paper-fig4" };
        let seed = if method == "SOBOL" { "--seed 18446744073709551615" } else { "" };
        let options = format!("--space {space} --method {} {seed} --shard 1/1 --out {path}", method.to_lowercase());
        assert_eq!(run(&format!("probability {options}")).status.code(), Some(0));
        (format!("PART-OF-{method}"), path)
    });
    let (mut every, mut inputs) = (Fields::new(), Fields::new());
    for (command, runs) in ANSWERS {
        let mut found = Fields::new();
        for options in *runs {
            let options = options.replace("SCENE", &scene.display().to_string());
            let options = options.replace("PEOPLE", &people.display().to_string());
            let options = options.replace("ORDER", &order.display().to_string());
            let options = parts.iter().fold(options, |options, (name, path)| options.replace(name, path));
            let answer = json(&format!("{command} {options}"), 0);
            assert_eq!((&answer["schema"], &answer["input"]["command"]), (&1.into(), &(*command).into()));
            collect(&answer, "", &mut found);
        }
        let (input, own): (Fields, Fields) = found.into_iter().partition(|(path, _)| path.starts_with("input."));
        let (general, own): (Fields, Fields) =
            own.into_iter().partition(|(path, _)| path == "schema" || path == "ended");
        every.extend(general);
        for (path, types) in input {
            let to = if path == "input.command" { &mut every } else { &mut inputs };
            to.entry(path).or_default().extend(types);
        }
        assert_documented(&own, &documented(&format!("`{command}`")));
    }
    assert_documented(&every, &documented("Every answer"));
    assert_documented(&inputs, &documented("`input`"));
}

#[test]
fn bad_input_of_every_kind_is_json_with_the_message_of_standard_error() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, "accuracy = true").unwrap();
    let scene = format!("plan --scene {}", scene.display());
    let mut found = Fields::new();
    for (arguments, code) in [
        ("toss --rate 1,1,1 --speed 3 --nonsense", 2),
        ("toss --rate 1,1,1 --speed x", 2),
        ("toss --rate 1,1,1 --speed nan", 2),
        ("toss --rate 1,1,1 --speed -3", 2),
        ("toss --rate 1,1,1 --speed 3 --time 1", 2),
        ("toss --speed 3", 2),
        ("toss --rate 1,1 --speed 3", 2),
        ("toss --rate 1,1,1 --speed 3 --drag 1", 2),
        ("toss --rate 1,1,1 --speed 3 --step 1", 2),
        ("plan", 2),
        ("nonsense", 2),
        ("", 2),
        ("probability --space no.toml --method grid", 2),
        (&scene, 2),
        ("trace --rate 1,1,1 --time 1 --points 3 --svg /no/such/folder/x.svg", 2),
        ("errors --space paper-fig4 --seconds 1e-9", 1),
        ("toss --rate 1,1,1e300 --time 1", 1),
        ("toss --rate 1e308,0,1 --time 4", 1),
        ("toss --rate 0.3,0.3,5 --time 5 --tilt 1 --solver gamma --formulation vertical", 1),
        ("toss --rate 1,1,1 --time 1 --solver quaternion --scheme rk4 --step 1e-9", 1),
        (
            "probability --rate-x 9 --rate-y x --rate-z 0 --speed 3:5:9 --method grid --solver gamma --formulation vertical",
            1,
        ),
    ] {
        let answer = json(arguments, code);
        let mut words = answer["error"]["message"].as_str().unwrap().split_whitespace();
        let said = stderr(&run(&format!("{arguments} --format=json"))).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(words.next().unwrap()) && said.starts_with("error: "), "{arguments}: {said}");
        collect(&answer, "", &mut found);
    }
    assert_eq!(found.remove("schema"), Some(BTreeSet::from(["integer".to_owned()])));
    assert_documented(&found, &documented("`error`"));
    let field = |arguments: &str| json(arguments, 2)["error"]["field"].clone();
    assert_eq!(field("toss --rate 1,1,1 --speed x"), "speed");
    assert_eq!(field("plan"), "want");
    assert_eq!(field("probability --space tails --method dice"), "method");
}

#[test]
fn the_version_is_that_of_the_program() {
    assert_eq!(stdout(&run("--version")), format!("unfair-toss {}\n", env!("CARGO_PKG_VERSION")));
    assert_eq!(run("toss --version").status.code(), Some(2));
}
