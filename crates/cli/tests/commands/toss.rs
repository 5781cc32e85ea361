//! Runs the commands about single tosses and the lists as a user does, and checks their answers, exit codes and
//! standard output. Other programs rely on these, so they are part of the interface.

use crate::common::{assert_near, json, run, stderr, stdout};
use serde_json::Value;
use toss::{Registry, SolverEntry};

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
