//! The questions of the page, asked natively. What is proven in the browser is proven by the same code; the tests of the page
//! compare the two.

#![expect(clippy::unwrap_used, reason = "helpers of tests, which clippy does not take for tests")]

use serde_json::{Value, json};
use web::Page;

fn ask(question: &Value) -> Value {
    serde_json::from_str(&Page::default().ask(&question.to_string())).unwrap()
}

fn cells(question: &Value) -> Vec<u8> {
    let mut page = Page::default();
    let answer: Value = serde_json::from_str(&page.ask(&question.to_string())).unwrap();
    assert_eq!(answer["cells"], page.cells().len(), "{answer}");
    page.cells().to_vec()
}

/// A map of 12 × 9 cells over ωx from -30 to 60 rad/s.
fn grid(up: &str, over: [f64; 2], spread: Option<&str>) -> Value {
    json!({ "up": up, "across": [-30.0, 60.0], "over": over, "columns": 12, "rows": 9, "part": [0, 9], "spread": spread })
}

/// ωx and the second input of each cell.
fn places([lo, hi]: [f64; 2]) -> impl Iterator<Item = (f64, f64)> {
    (0..9).flat_map(move |row| {
        (0..12).map(move |column| (-30.0 + 90.0 * f64::from(column) / 11.0, lo + (hi - lo) * f64::from(row) / 8.0))
    })
}

#[test]
fn a_question_that_is_not_understood_has_an_error_and_not_a_panic() {
    for question in [
        "",
        "7",
        "{}",
        "{\"ask\":\"known\"}x",
        "{\"ask\":\"toss\"}",
        "{\"ask\":\"known\",\"magic\":1}",
        "{\"ask\":\"magic\"}",
        "\u{0}",
    ] {
        let answer: Value = serde_json::from_str(&Page::default().ask(question)).unwrap();
        assert_eq!(answer["error"]["kind"], "input", "{question}: {answer}");
    }
    assert!(ask(&json!({ "ask": "known" }))["solvers"].as_array().is_some_and(|solvers| solvers.len() >= 4));
}

#[test]
fn margins_of_a_body_are_asked_for_alone_and_flip_it() {
    let scene = |x: f64| json!({ "moments": "1,2,2.9", "rate": [x.to_string(), "20", "0.1"], "speed": "3" });
    let outcome = |x: f64| ask(&json!({ "ask": "toss", "scene": scene(x) }));
    let tails = outcome(1.0);
    assert_eq!((&tails["outcome"], &tails["margin"]), (&json!("tails"), &Value::Null));
    let margins = ask(&json!({ "ask": "margins", "scene": scene(1.0) }));
    let change = margins["rate"][0].as_f64().unwrap();
    assert_eq!(outcome(1.0 + change * (1.0 - 1e-9))["outcome"], "tails");
    assert_eq!(outcome(1.0 + change * (1.0 + 1e-9))["outcome"], "heads");
    assert!(margins["time_range"][1].as_f64().is_some_and(|later| later > 0.0));
    // Those of a coin come with its answer.
    let coin = json!({ "rate": ["1", "1", "2.5"], "speed": "3" });
    let answer = ask(&json!({ "ask": "toss", "scene": coin }));
    assert_eq!(answer["margin"], ask(&json!({ "ask": "margins", "scene": coin })));
    assert_eq!(answer["margin"]["time_range"], Value::Null);
}

#[test]
fn bad_input_names_its_field_in_the_words_of_the_library() {
    for (scene, field) in [
        (json!({ "rate": ["1", "2", "3x"], "speed": "3" }), "rate z [rad/s]"),
        (json!({ "rate": ["1", "2", "3"], "speed": "-3" }), "speed [m/s]"),
        (json!({ "rate": ["1", "2", "3"] }), "speed"),
        (json!({ "rate": ["1", "2", "3"], "speed": "3", "time": "1" }), "time"),
        (json!({ "rate": ["1", "2", "3"], "speed": "3", "turn": "1" }), "rate"),
        (json!({ "speed": "3" }), "rate"),
        (json!({ "coin": "doubloon", "rate": ["1", "2", "3"], "speed": "3" }), "coin"),
        (json!({ "coin": "paper", "moments": "1,1", "rate": ["1", "2", "3"], "speed": "3" }), "coin"),
        (json!({ "moments": "1,2,9", "rate": ["1", "2", "3"], "speed": "3" }), "I3 [kg m²]"),
        (json!({ "moments": "1", "rate": ["1", "2", "3"], "speed": "3" }), "moments [kg m²]"),
        (json!({ "moments": "1g·cm²,2", "rate": ["1", "2", "3"], "speed": "3" }), "moments"),
        (json!({ "moments": "1,2,2.5", "turn": "1", "psi": "1", "speed": "3" }), "turn"),
        (json!({ "attitude": "0,0,1,0", "rate": ["1", "2", "3"], "speed": "3" }), "attitude"),
        (json!({ "spin": "1", "rate": ["1", "2", "3"], "speed": "3" }), "field"),
    ] {
        let answer = ask(&json!({ "ask": "toss", "scene": scene }));
        assert_eq!(answer["error"]["field"], field, "{answer}");
    }
}

#[test]
fn each_cell_of_a_map_is_the_outcome_of_its_launch() {
    let bodies = [json!({ "coin": "us-quarter" }), json!({ "moments": "2e-7,3e-7,4e-7" })];
    for (body, up, over, drop) in [
        (0, "rate_z", [-40.0, 40.0], "0"),
        (0, "speed", [0.0, 4.0], "20cm"),
        (1, "rate_z", [-40.0, 40.0], "0.1"),
        (1, "speed", [0.0, 4.0], "0"),
    ] {
        let scene = |x: f64, z: f64, speed: f64| {
            let mut scene = bodies[body].clone();
            scene["rate"] = json!([x.to_string(), "4", z.to_string()]);
            scene["speed"] = json!(speed.to_string());
            scene["drop"] = json!(drop);
            scene["tilt"] = json!("10deg");
            scene
        };
        let found = cells(&json!({ "ask": "map", "scene": scene(1.0, 7.0, 2.5), "grid": grid(up, over, None) }));
        let mut heads = 0;
        for ((x, up_value), cell) in places(over).zip(found) {
            let here = if up == "speed" { scene(x, 7.0, up_value) } else { scene(x, up_value, 2.5) };
            let outcome = ask(&json!({ "ask": "toss", "scene": here }))["outcome"].clone();
            assert_eq!(outcome, if cell == 254 { "heads" } else { "tails" }, "{here}");
            heads += u32::from(cell == 254);
        }
        assert!((5..104).contains(&heads), "{heads}");
    }
}

#[test]
fn a_map_of_probabilities_is_certain_where_the_outcome_is_and_even_beside_it() {
    let scene = json!({ "coin": "us-quarter", "rate": ["20", "0", "7"], "speed": "2.5" });
    let found = cells(&json!({ "ask": "map", "scene": scene, "grid": grid("rate_z", [0.0, 40.0], Some("10%")) }));
    let k = 1.986;
    for ((x, z), cell) in places([0.0, 40.0]).zip(&found) {
        assert!(k * z < 1.01 * x.abs() || *cell == 254, "{x}, {z}: {cell}");
    }
    assert!(found.iter().any(|cell| (1..254).contains(cell)));
    let none = cells(&json!({ "ask": "map", "scene": scene, "grid": grid("rate_z", [0.0, 40.0], Some("0")) }));
    let proven = cells(&json!({ "ask": "map", "scene": scene, "grid": grid("rate_z", [0.0, 40.0], None) }));
    assert_eq!(none, proven);
}

/// On the line the least cos θ of the motion is 0; the library computes it without this formula.
#[test]
fn the_line_of_certainty_is_where_the_least_cos_tilt_is_0() {
    for tilt in ["0", "20deg", "-1.2"] {
        let scene = |x: f64, z: f64| json!({ "coin": "us-dime", "rate": [x.to_string(), "6", z.to_string()], "speed": "3", "tilt": tilt });
        for (up, over) in [("rate_z", [-300.0, 300.0]), ("speed", [0.0, 6.0])] {
            let lines = ask(&json!({ "ask": "lines", "scene": scene(3.0, 25.0), "grid": grid(up, over, None) }));
            let points: Vec<[f64; 2]> = lines["certain"]
                .as_array()
                .unwrap()
                .iter()
                .filter_map(|point| serde_json::from_value(point.clone()).ok())
                .collect();
            assert!(points.len() > 1, "{tilt}, {up}: {lines}");
            for [x, value] in points {
                let here = scene(x, if up == "speed" { 25.0 } else { value });
                let least = ask(&json!({ "ask": "toss", "scene": here }))["motion"]["least_cos_tilt"].as_f64().unwrap();
                assert!(least.abs() < 1e-12, "{here}: {least}");
            }
        }
    }
}

#[test]
fn the_dashed_line_is_where_the_coin_is_caught_at_its_first_flip() {
    for drop in ["0", "0.002"] {
        let scene =
            |x: f64, speed: f64| json!({ "rate": [x.to_string(), "6", "5"], "speed": speed.to_string(), "drop": drop });
        let lines = ask(&json!({ "ask": "lines", "scene": scene(3.0, 2.0), "grid": grid("speed", [0.0, 6.0], None) }));
        let points: Vec<[f64; 2]> = lines["first_flip"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|point| serde_json::from_value(point.clone()).ok())
            .collect();
        assert!(points.len() > 20, "{lines}");
        for [x, speed] in points.into_iter().step_by(7) {
            for (factor, outcome) in [(1.0 - 1e-9, "heads"), (1.0 + 1e-9, "tails")] {
                assert_eq!(ask(&json!({ "ask": "toss", "scene": scene(x, speed * factor) }))["outcome"], outcome);
            }
        }
    }
}

#[test]
fn a_launch_that_is_aimed_has_its_momentum_there_and_as_large() {
    let scene = |rate: [String; 3]| json!({ "moments": "2e-7,3e-7,4e-7", "rate": rate, "speed": "3", "tilt": "0.4" });
    let first = scene(["5", "6", "-7"].map(str::to_owned));
    let aimed = ask(&json!({ "ask": "aim", "scene": first, "direction": [0.0, 3.0, 4.0] }));
    let rate: [f64; 3] = serde_json::from_value(aimed["rate"].clone()).unwrap();
    let size = |rate: [f64; 3]| (2.0 * rate[0]).hypot(3.0 * rate[1]).hypot(4.0 * rate[2]);
    assert!((size(rate) / size([5.0, 6.0, -7.0]) - 1.0).abs() < 1e-14);
    let flight = ask(&json!({ "ask": "fly", "scene": scene(rate.map(|part| part.to_string())), "points": 2 }));
    let momentum: [f64; 3] = serde_json::from_value(flight["momentum"].clone()).unwrap();
    assert!(momentum.iter().zip([0.0, 0.6, 0.8]).all(|(a, b)| (a - b).abs() < 1e-14), "{momentum:?}");
    let refused = ask(&json!({ "ask": "aim", "scene": first, "direction": [0, 0, 0] }));
    assert_eq!(refused["error"]["field"], "direction of S");
}

#[test]
fn frames_follow_the_trace_from_the_launch_to_the_landing() {
    for scene in [
        json!({ "rate": ["9", "4", "3"], "speed": "3", "drop": "0.2" }),
        json!({ "moments": "1,2,2.5", "rate": ["9", "4", "3"], "time": "1.5" }),
    ] {
        let mut page = Page::default();
        let question = json!({ "ask": "fly", "scene": scene, "points": 50 }).to_string();
        let flight: Value = serde_json::from_str(&page.ask(&question)).unwrap();
        let numbers = page.numbers().to_vec();
        assert_eq!(numbers.len(), 50 * 12);
        for point in numbers.chunks(12) {
            let frame = page.frame(point[0]);
            assert_eq!((&frame[4..10], frame[13], frame[14]), (&point[3..9], point[1], point[2]));
            assert!((frame[6] - frame[13]).abs() < 1e-14, "cos θ is the height of n");
        }
        let landing = &numbers[49 * 12..];
        let answer = ask(&json!({ "ask": "toss", "scene": scene }));
        let [time, cos_tilt] = ["flight_time", "cos_tilt"].map(|name| answer[name].as_f64().unwrap());
        // The answer is that of the exact time 2 v0/g, and the last point that of its nearest f64.
        assert!(landing[0] == time && (landing[1] - cos_tilt).abs() < 1e-14, "{answer}");
        assert!((landing[2] + flight["drop"].as_f64().unwrap()).abs() < 1e-12);
    }
}

#[test]
fn an_error_grows_to_that_of_the_landing_and_raw_equations_fail_in_words() {
    let scene = json!({ "coin": "us-quarter", "turn": "38rev/s", "psi": "60deg", "speed": "2.45m/s" });
    let by = json!({ "solver": "quaternion", "scheme": "dopri5", "tolerance": "1e-6" });
    let growth = ask(&json!({ "ask": "growth", "scene": scene, "by": by, "points": 20 }));
    let landing = ask(&json!({ "ask": "landing", "scene": scene, "by": by }));
    let errors: Vec<f64> = serde_json::from_value(growth["attitude_error"].clone()).unwrap();
    assert_eq!((errors.len(), growth["failure"].is_null()), (20, true), "{growth}");
    assert_eq!(errors[19], landing["attitude_error"].as_f64().unwrap());
    assert!(errors[0] < 0.2 * errors.iter().copied().fold(0.0, f64::max), "{errors:?}");
    let by = json!({ "solver": "euler", "scheme": "dopri5", "formulation": "raw" });
    let failing = ask(&json!({ "ask": "growth", "scene": scene, "by": by, "points": 20 }));
    assert!(failing["failure"].as_str().is_some_and(|words| !words.is_empty()), "{failing}");
    let by = json!({ "solver": "exact", "tolerance": "1e-6" });
    assert_eq!(ask(&json!({ "ask": "landing", "scene": scene, "by": by }))["error"]["field"], "tolerance");
}
