//! Runs the commands about single tosses and the lists as a user does, and checks their answers, exit codes and
//! standard output. Other programs rely on these, so they are part of the interface.

use std::process::Command;

use crate::common::{assert_near, json, run, stderr, stdout};
use serde_json::Value;
use toss::{Registry, SolverEntry};

#[test]
fn every_solver_and_scheme_reproduces_the_reference_value_of_cos_tilt() {
    let command = "toss --rate 1,1,2.5 --speed 3";
    assert_near(&json(command, 0)["cos_tilt"], 0.665_661_286_601_930_7, 1e-15);
    for solver in ["gamma", "euler", "quaternion"] {
        for scheme in ["--scheme dop853", "--scheme dopri5 --tolerance 1e-11", "--scheme rk4 --step 1e-4"] {
            let answer = json(&format!("{command} --solver {solver} {scheme}"), 0);
            assert_near(&answer["cos_tilt"], 0.665_661_286_601_930_7, 1e-9);
            assert_eq!(answer["outcome"], "heads");
            assert_eq!(answer["solver"], solver);
            assert!(answer["work"]["rhs_calls"].as_u64() > Some(20));
        }
    }
}

#[test]
fn the_answer_has_the_fields_of_the_contract() {
    let answer = json("toss --moments 0.04,0.02 --rate 2,4,6 --time 1", 0);
    let fields: Vec<&str> = answer.as_object().unwrap().keys().map(String::as_str).collect();
    let toss =
        ["schema", "input", "coin", "flight_time", "cos_tilt", "outcome", "certified", "proof", "margin", "attitude"];
    for field in toss.into_iter().chain(["rate", "norm_error", "solver", "scheme", "work"]) {
        assert!(fields.contains(&field), "{field}");
    }
    assert_eq!(fields.len(), 17);
    // Kane's body, with its reference values.
    assert_near(&answer["cos_tilt"], 0.740_109_893_087_048_3, 1e-15);
    for (part, expected) in
        [-0.304_936_388_530_335_6, 0.333_018_098_445_657_3, -0.137_999_998_420_704_2, -0.881_515_028_512_617_2]
            .iter()
            .enumerate()
    {
        let sign = -answer["attitude"][0].as_f64().unwrap().signum();
        assert_near(&answer["attitude"][part], sign * expected, 1e-15);
    }
    assert_eq!(answer["coin"], serde_json::json!({"i1": 0.04, "i2": 0.04, "i3": 0.02}));
    // Euler's equations turn (ωx, ωy) by -(k - 1) ωz T = 3 rad and leave ωz unchanged.
    let (sin, cos) = 3f64.sin_cos();
    for (part, expected) in [2.0 * cos + 4.0 * sin, 4.0 * cos - 2.0 * sin, 6.0].into_iter().enumerate() {
        assert_near(&answer["rate"][part], expected, 1e-14);
    }
    assert_eq!(answer["scheme"], Value::Null);
    assert_eq!(answer["certified"], true);
    assert_eq!((&answer["proof"], &answer["error_bound"]), (&"exact".into(), &Value::Null));
    let euler = json("toss --rate 1,1,1 --time 1 --solver euler", 0);
    assert_eq!((&euler["certified"], &euler["proof"]), (&false.into(), &Value::Null));
    assert_eq!(json("toss --rate 1,1,1 --time 1 --solver euler --scheme rk4", 0)["scheme"], "rk4");
    assert_eq!(json("toss --rate 1,1,1 --time 1 --solver quaternion --scheme taylor", 0)["scheme"], "taylor");
}

#[test]
fn an_integrated_outcome_is_proven_with_bounds_that_hold() {
    let toss = "--moments 0.04,0.02 --rate 2,4,6 --time 1";
    let answer = json(&format!("toss {toss} --solver quaternion --prove"), 0);
    assert_eq!((&answer["certified"], &answer["proof"]), (&true.into(), &"integrated".into()));
    assert_eq!((&answer["outcome"], &answer["scheme"]), (&"heads".into(), &"taylor".into()));
    let bound = answer["error_bound"].as_f64().unwrap();
    assert!(bound < 1e-10 && answer["attitude_error_bound"].as_f64().unwrap() < bound);
    assert_near(&answer["cos_tilt"], 0.740_109_893_087_048_3, bound);
    let text = stdout(&run(&format!("toss {toss} --solver quaternion --prove")));
    assert!(text.contains("heads, proven by integration in f64") && text.contains("\nerror bound  "), "{text}");
    let csv = stdout(&run(&format!("trace {toss} --solver quaternion --prove --points 3")));
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].ends_with(",cos_tilt,error_bound,attitude_error_bound") && lines.len() == 4, "{csv}");
    assert!(!stdout(&run(&format!("trace {toss} --points 3"))).contains("error_bound"));
    let body = json("toss --moments 2,3,4 --rate 0.5,-1.25,2 --time 25 --solver quaternion --prove", 0);
    assert_eq!((&body["certified"], &body["proof"]), (&true.into(), &"integrated".into()));
    let exact = json("toss --moments 2,3,4 --rate 0.5,-1.25,2 --time 25", 0);
    assert_near(&body["cos_tilt"], exact["cos_tilt"].as_f64().unwrap(), body["error_bound"].as_f64().unwrap());
    let middle = run("toss --moments 2,3,4 --rate 1e-12,1,1e-12 --time 1e4 --solver quaternion --prove");
    assert!(stderr(&middle).contains("have no bound"), "{}", stderr(&middle));
    let near = json("toss --rate 1,0,0 --time 1.5707963267948966 --solver quaternion --prove", 0);
    assert_eq!((&near["outcome"], &near["certified"]), (&"heads".into(), &true.into()));
}

/// Both land some 1e-17 from the edge: on the other side of it for the rounded quaternion, or the rounded moments.
#[test]
fn an_outcome_is_proven_for_the_tilt_and_the_cylinder_as_typed() {
    for (command, outcome, cos_tilt) in [
        (
            "toss --rate=-24.064598567199237,-26.566903895330363,49.56448355104628 --speed 2.4107905225673436 \
             --tilt 2.5150841041292824",
            "heads",
            1.083_048_700_603_535_2e-17,
        ),
        (
            "toss --cylinder=0.003,0.01874,0.00114 --rate=-3.2179007895838936,169.2146405840661,-44.3313807416256 \
             --speed 2.050038069869439",
            "heads",
            5.367_562_989_044_33e-16,
        ),
    ] {
        let answer = json(command, 0);
        assert_eq!((answer["outcome"].as_str(), answer["certified"].as_bool()), (Some(outcome), Some(true)));
        assert_near(&answer["cos_tilt"], cos_tilt, 1e-30);
    }
}

#[test]
fn method_is_an_alias_of_scheme() {
    for command in ["toss --rate 2,5,1 --time 0.4", "trace --rate 2,5,1 --time 0.4 --points 3"] {
        let by = |option: &str| json(&format!("{command} --solver quaternion {option} rk4"), 0);
        assert_eq!(by("--scheme"), by("--method"));
    }
    let answer = json("toss --rate 2,5,1 --time 0.4 --solver quaternion --tolerance 1e-4", 0);
    assert_eq!(answer["scheme"], "dop853");
    assert!(answer["norm_error"].as_f64() > Some(0.0));
    assert_eq!(json("toss --rate 2,5,1 --time 0.4", 0)["scheme"], Value::Null);
}

#[test]
fn the_raw_formulation_is_wrong_without_an_error_where_the_default_is_right() {
    let error = |toss: &str, solver: &str| {
        let cos_tilt = |options: &str| json(&format!("toss {toss} {options}"), 0)["cos_tilt"].as_f64().unwrap();
        (cos_tilt(solver) - cos_tilt("")).abs()
    };
    let precession_stops = "--rate 0.3,0.3,5 --time 5 --tilt 1";
    assert!(error(precession_stops, "--solver gamma --formulation raw") > 1e-5);
    assert!(error(precession_stops, "--solver gamma") < 1e-8);
    let level = "--rate 2,5,1 --time 0.4 --tilt 1.2";
    assert!(error(level, "--solver gamma --formulation raw") > 0.1);
    assert!(error(level, "--solver gamma") < 1e-8);
    let quaternion = "--solver quaternion --tolerance 1e-4";
    let unprojected = error(level, &format!("{quaternion} --formulation raw"));
    assert!(unprojected != error(level, quaternion));
    assert!(json(&format!("toss {level} {quaternion}"), 0)["norm_error"].as_f64().unwrap() > 1e-9);
}

#[test]
fn coins_launches_and_tilts_reach_the_solver() {
    assert_near(&json("toss --rate 1,1,2.5 --speed 5 --coin disc", 0)["cos_tilt"], 0.966_792_675_866_465, 1e-15);
    assert_near(&json("toss --rate 0,0,3 --time 1 --tilt 0.5", 0)["cos_tilt"], 0.5_f64.cos(), 1e-15);
    assert_near(&json("toss --rate 1,2,3 --speed 3 --gravity 1.62", 0)["flight_time"], 6.0 / 1.62, 0.0);
    let cylinder = json("toss --cylinder 0.00567,0.01213,0.00175 --rate 1,1,1 --time 1", 0);
    assert_eq!(cylinder["coin"], json("toss --coin us-quarter --rate 1,1,1 --time 1", 0)["coin"]);
    assert_eq!(json("toss --rate 2,2,0.5 --speed 4", 0)["outcome"], "tails");
    assert_eq!(json("toss --rate -0,0,0 --time 0", 0)["outcome"], "heads");
}

#[test]
fn a_solver_that_fails_ends_with_1_and_a_typed_error() {
    let phase = json("toss --rate 1,1,1e300 --time 1", 1);
    assert_eq!(phase["error"]["kind"], "phase_too_large");
    assert!(phase["error"]["phase"].as_f64() > Some(9e15));
    assert!(phase["error"]["message"].as_str().unwrap().starts_with("outcome not determined"));

    let stops = json("toss --rate 0.3,0.3,5 --time 5 --tilt 1 --solver gamma --formulation vertical", 1);
    assert_eq!(stops["error"]["kind"], "singular");
    assert_eq!(stops["error"]["point"], "α' = 0");
    assert!(stops["error"]["time"].as_f64().unwrap() > 0.0);

    let steps = json("toss --rate 1,1,1 --time 1 --solver quaternion --scheme rk4 --step 1e-9", 1);
    assert_eq!(steps["error"]["kind"], "step_limit");
    assert_eq!(steps["error"]["limit"], 1_000_000);

    let space = "probability --rate-x 9 --rate-y x --rate-z 0 --speed 3:5:9 --method grid";
    let launch = json(&format!("{space} --solver gamma --formulation vertical"), 1);
    assert_eq!(launch["error"]["launch"]["index"], 0);
    assert_eq!(launch["error"]["launch"]["rate"][0], 9.0);
}

#[test]
fn a_trace_starts_at_launch_and_ends_at_landing() {
    let trace = json("trace --rate 2,2,0.5 --speed 3 --points 5", 0);
    let points = trace["points"].as_array().unwrap();
    assert_eq!(points.len(), 5);
    assert_eq!(points[0]["time"], 0.0);
    assert_eq!(points[0]["attitude"][0], 1.0);
    assert_near(&points[4]["time"], 6.0 / 9.81, 0.0);
    assert_near(&points[4]["cos_tilt"], -0.156_081_419_013_723_6, 1e-15);
    assert_near(&points[4]["normal"][2], -0.156_081_419_013_723_6, 1e-15);

    let csv = stdout(&run("trace --rate 2,2,0.5 --speed 3 --points 5 --solver euler"));
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 6);
    assert_eq!(lines[0].split(',').count(), 15);
    assert!(lines[0].starts_with("time,w,x,y,z,alpha,beta,gamma,normal_x"));
    let landing: Vec<f64> = lines[5].split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!((landing[14] + 0.156_081_419_013_723_6).abs() < 1e-8);
}

#[test]
fn lists_name_every_coin_solver_model_and_space() {
    let list = |name: &str| json(name, 0)[name].clone();
    let coins = list("coins");
    assert!(coins.as_array().unwrap().len() >= 14);
    assert!(coins.as_array().unwrap().iter().all(|coin| coin["source"].as_str().is_some_and(|text| !text.is_empty())));
    let names = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|line| line["name"].as_str().unwrap().to_owned()).collect()
    };
    let solvers = list("solvers");
    let registered: Vec<&str> = Registry::standard().entries().iter().map(SolverEntry::name).collect();
    assert_eq!(names(&solvers), registered);
    let quaternion = &solvers[3];
    assert_eq!(quaternion["schemes"], serde_json::json!(["dop853", "dopri5", "rk4", "taylor"]));
    assert_eq!(quaternion["formulations"], serde_json::json!(["momentum", "raw"]));
    let models = list("models");
    assert_eq!(names(&models)[..3], ["outcome", "tilt", "attitude"]);
    assert!(models[0]["cost_ns"].as_f64() > Some(0.0) && models[5]["cost_ns"].is_null());
    assert_eq!(names(&list("spaces")), ["paper-fig4", "cheated", "tails"]);
    for kind in ["coins", "solvers", "models", "spaces"] {
        let text = stdout(&run(kind));
        assert!(names(&list(kind)).iter().all(|name| text.contains(name.as_str())), "{kind}");
    }
}

#[test]
fn help_names_every_solver_and_scheme_of_the_registry() {
    let help = stdout(&run("toss --help"));
    for entry in Registry::standard().entries() {
        assert!(help.contains(entry.name()), "{}", entry.name());
        assert!(entry.schemes().iter().all(|scheme| help.contains(scheme.name())), "{:?}", entry.schemes());
    }
    for words in
        ["Step of rk4", "momentum (no flight is singular)", "raw (as the paper prints it: an answer may be wrong"]
    {
        assert!(help.contains(words), "{words}");
    }
}

#[test]
fn a_reader_that_closes_the_pipe_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_unfair-toss"))
        .args(["trace", "--rate", "9,4,3", "--speed", "4", "--points", "20000"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
