//! Quantities may be typed with a unit, and a toss may be described by what can be seen of it.

use std::f64::consts::TAU;

use crate::common::{assert_near, json, run, stderr, stdout};
use serde_json::json as value;

/// The input of a toss as its answer repeats it: with the units that were typed.
fn input(options: &str) -> serde_json::Value {
    json(&format!("toss {options}"), 0)["input"].clone()
}

#[test]
fn a_toss_is_the_same_in_any_units() {
    let with_units = "--cylinder 5.67g,12.13mm,1.75mm --rate 10rev/s,0,-300rpm --speed 240cm/s --gravity 981cm/s² --drop 50cm \
                      --tilt 15deg";
    let found = input(with_units);
    assert_eq!(found["cylinder"], value!(["5.67g", "12.13mm", "1.75mm"]));
    assert_eq!(found["rate"], value!(["10rev/s", 0.0, "-300rpm"]));
    for (name, expected) in [("speed", "240cm/s"), ("gravity", "981cm/s²"), ("drop", "50cm"), ("tilt", "15deg")] {
        assert_eq!(found[name], value!(expected), "{name}");
    }
    let moments = "--moments 5g·cm²,1e-7kg·m² --rate 1,1,1 --time 500ms";
    assert_eq!(input(moments)["moments"], value!(["5g·cm²", "1e-7kg·m²"]));
    let coin = json(&format!("toss {moments}"), 0)["coin"].clone();
    assert_eq!((&coin["i1"], &coin["i3"]), (&value!(5e-7), &value!(1e-7)));
    let si = "--cylinder 0.00567,0.01213,0.00175 --rate 62.83185307179586,0,-31.41592653589793 --speed 2.4 --gravity 9.81 \
              --drop 0.5 --tilt 0.26179938779914946";
    let landing = |options: &str| json(&format!("toss {options}"), 0)["cos_tilt"].clone();
    // With units fewer numbers are rounded, so that the last digits may differ, by up to u for each of 70 rad.
    assert_near(&landing(with_units), landing(si).as_f64().unwrap(), 1e-14);
}

#[test]
fn turn_and_psi_stand_for_the_rate_that_they_give() {
    // ωL = 2π, ψ = 60°, k = 0.5: Ω = 2π sin 60° and ωz = 2π cos 60°/0.5 = 2π.
    let seen = json("toss --turn 1rev/s --psi 60deg --speed 3", 0);
    let rate = format!("toss --rate {},0,{} --speed 3", TAU * 0.75_f64.sqrt(), TAU);
    assert_near(&seen["cos_tilt"], json(&rate, 0)["cos_tilt"].as_f64().unwrap(), 1e-14);
    // cos θ = cos²ψ + sin²ψ cos(ωL T).
    let expected = 0.25 + 0.75 * (TAU * 6.0 / 9.81).cos();
    assert_near(&seen["cos_tilt"], expected, 1e-14);
    assert_eq!((&seen["input"]["turn"], &seen["input"]["psi"]), (&value!("1rev/s"), &value!("60deg")));
    let commands = [
        "trace --points 3 --speed 3",
        "plan --want tilt --accuracy 1e-9 --speed 3",
        "compare --repeats 0 --speed 3",
        "spread --heads 0.9 --speed 3 --points 64",
        "intervals --speed 3:4",
        "probability --speed 3:4",
        "sample --speed 3:4 --points 2",
        "map --speed 1:2:2 --tilt 0:1:2 --across speed --up tilt --method random --points 64",
    ];
    for command in commands {
        let output = run(&format!("{command} --turn 1rev/s --psi 60deg"));
        assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
    }
}

/// Who writes 38 may mean turns.
#[test]
fn a_turn_is_said_as_it_was_understood() {
    for command in [
        "toss --speed 2.4",
        "spread --heads 0.9 --speed 2.4 --points 64",
        "intervals --speed 2:3",
        "probability --speed 2:3 --accuracy 1e-2",
        "probability --speed 2:3 --method random --points 9 --solver quaternion --prove",
    ] {
        for (turn, words) in [("38", "6.05 rev/s = 38 rad/s"), ("38rev/s", "38 rev/s = 238.76 rad/s")] {
            let text = stdout(&run(&format!("{command} --turn {turn} --psi 60deg")));
            assert!(text.contains(&format!("\nturn         {words}\n")), "{command}: {text}");
        }
    }
    assert!(!stdout(&run("toss --rate 1,1,2.5 --speed 3")).contains("turn"));
    assert!(stdout(&run("toss --rate 1,0,1 --time 1e-307")).contains("\nflight time  1e-307 s\n"));
}

/// A coin that is flipped at a quarter of a turn a second stands on its edge after one second. Rounded to rad/s, or with a
/// rounded time, it would be heads or tails by 1e-17.
#[test]
fn an_outcome_is_proven_for_the_numbers_in_their_units_or_not_called_proven() {
    let outcome = |options: &str| {
        let answer = json(&format!("toss {options}"), 0);
        (answer["outcome"].as_str().unwrap().to_owned(), answer["certified"].as_bool().unwrap())
    };
    for tie in ["--rate 0.25rev/s,0,0 --time 1", "--rate 90deg/s,0,0 --time 1s", "--rate 0,0,1 --tilt 90deg --time 1"] {
        assert_eq!(outcome(tie), ("undecided".to_owned(), true), "{tie}");
    }
    // 0.05 ft/s and 0.1 ft/s² make a flight of 1 s, but are rounded to SI units one by one.
    for rounded in [
        "--rate 0.25rev/s,0,0 --speed 0.05ft/s --gravity 0.1ft/s²",
        "--rate 0.25rev/s,0,0 --time 1000.0000000000001ms",
        "--rate 0.25rev/s,0rpm,1e-20rpm --time 1",
        "--turn 0.25rev/s --psi 90deg --time 1",
    ] {
        assert!(!outcome(rounded).1, "{rounded}");
    }
    for clear in
        ["--rate 1,1,2.5 --speed 240cm/s", "--turn 38rev/s --psi 60deg --speed 2.4", "--rate 10rev/s,3rpm,0 --speed 3"]
    {
        assert!(outcome(clear).1, "{clear}");
    }
}
