//! Nothing that is asked for is ignored: what would have no effect is refused, and so is what would never end.

mod common;

use common::{assert_refused, json, run};

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
            ("--scheme dop853", "--scheme has no effect with --solver exact"),
            ("--tolerance 1e-9", "--tolerance has no effect with --solver exact"),
            ("--step 1e-3", "--step has no effect with --solver exact"),
        ] {
            assert_refused(&[(&format!("{command} {option}"), [words, integrators])]);
        }
        let formulation = format!("{command} --formulation vertical");
        assert_refused(&[(
            &formulation,
            ["--formulation vertical has no effect with --solver exact", "it is for gamma or euler"],
        )]);
    }
    let quaternion = "toss --rate 1,1,1 --time 1 --solver quaternion --formulation";
    assert_refused(&[(
        &format!("{quaternion} vertical"),
        ["--formulation vertical has no effect with --solver quaternion", "it is for gamma or euler"],
    )]);
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
    assert_refused(&[
        ("probability --space tails --solver quaternion --prove", ["--prove needs --method", "exact motion"]),
        (
            "probability --space tails --method random --shard 1/2 --out x --solver quaternion --prove",
            ["--shard has no effect with --prove", "exact motion"],
        ),
    ]);
}

#[test]
fn points_and_seeds_without_effect_are_refused() {
    let free = "--rate-y x --rate-z 1 --speed 3:5";
    assert_refused(&[
        ("probability --space tails --method grid --seed 2", ["--seed: no launch is drawn at random", "a grid"]),
        ("probability --space tails --method exact-speed --points 64", ["--points: exact-speed", "at most the speed"]),
        ("probability --space tails --method exact-speed --seed 2", ["--seed: no launch", "at most the speed"]),
        ("probability --space paper-fig4 --method exact-speed --seed 2", ["--seed: no launch", "a grid"]),
        ("probability --space tails --method enclosure --points 64", ["--points: enclosure", "all launches"]),
        ("probability --space tails --method enclosure --seed 2", ["--seed: no launch", "enclosure"]),
        ("probability --space tails --method sobol --accuracy 1e-3", ["--accuracy can't be used", "enclosure"]),
        (&format!("probability --rate-x 0:9:5 {free} --method random"), ["rate x [rad/s] = '0:9:5'", "no grid"]),
        (&format!("probability --rate-x 0:9:5 {free}:7 --method exact-speed"), ["speed [m/s] = '3:5:7'", "no grid"]),
        ("errors --rate-x 0:9:5 --rate-y x --rate-z 1 --speed 3:5", ["rate x [rad/s] = '0:9:5'", "no grid"]),
        ("map --rate-x 0:9:3 --rate-y 0 --rate-z 1:9:3 --speed 3:5 --points 8", ["--points: exact-speed", "speed"]),
        ("map --rate-x 0:9:3 --rate-y 0 --rate-z 1:9:3 --speed 3:5:9", ["speed [m/s] = '3:5:9'", "no grid"]),
        ("intervals --rate 1,1,2 --speed 2:3:4", ["--speed '2:3:4': a number of points has no effect", "whole"]),
        (
            "intervals --rate 1,1,2 --speed normal:2.5:0.1",
            ["--speed 'normal:2.5:0.1': a range LO:HI is needed", "probability --method exact-speed"],
        ),
        (
            "plan --rate 1,1,1 --speed 3 --want tilt --accuracy 1e-6 --points 7",
            ["--points is for --want trace", "plan"],
        ),
        ("plan --space tails --want probability --accuracy 1e-2 --points 7", ["--points is for --want trace", "plan"]),
        ("inverse --probability 0.7 --moments 1,0", ["inertia ratio I3/I1 = 0.0", "P(heads) is 1/2"]),
    ]);
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
fn what_would_never_end_or_fit_is_refused() {
    let large = "18446744073709551615";
    assert_refused(&[
        ("probability --space tails --method random --points 10000000000001", ["10000000000001 launches", "at most"]),
        (
            "probability --space tails --method random --points 1000000001 --solver gamma",
            ["1000000001 launches", "at most 1000000000 by an integrator"],
        ),
        (&format!("limit --points {large}"), ["launches would take too long", "10000000000000 by the exact motion"]),
        (
            &format!("convergence --rate-x 0:1:{large} --rate-y 0 --rate-z 1 --speed 1"),
            ["launches would take too long", "10000000000000"],
        ),
        (
            "convergence --rate-x 0:1:2000000 --rate-y 0 --rate-z 1 --speed 1 --steps 1000001",
            ["'1000001' for '--steps", "from 1 to 1000000"],
        ),
        ("map --rate-x 0:9:10000 --rate-y 0 --rate-z 1:9:10000 --speed 3:5", ["10000 × 10000 points", "1000000 nodes"]),
        (&format!("map --rate-x 0:9:{large} --rate-y 0 --rate-z 1:9:{large} --speed 3:5"), ["rate x", "2 to 10000"]),
        (
            "map --rate-x 0:9:100 --rate-y 0 --rate-z 1:9:100 --speed 3:5 --method random --points 10000000000",
            ["100000000000000 launches", "at most"],
        ),
    ]);
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
            "line 4, column 8: coin = 'given twice'",
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
            "line 3, column 51: coin = 'given twice'",
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
