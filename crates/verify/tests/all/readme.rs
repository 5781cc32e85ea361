//! This test compares the README's table of speed and accuracy with the newest record. Otherwise the table would become
//! outdated with the next record.

use std::path::Path;

use serde_json::Value;

const README: &str = include_str!("../../../../README.md");

#[test]
fn the_readmes_table_of_accuracy_is_that_of_the_newest_record() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/record");
    let records = verify::judge::record::read(&folder).unwrap();
    let date = &records.last().unwrap().host.date;
    assert!(README.contains(&format!("record of {date}")), "{date}");
    let text = std::fs::read_to_string(folder.join(date).join("work-precision.jsonl")).unwrap();
    let runs: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let contestants = [
        ("exact", None),
        ("quaternion", Some("taylor")),
        ("quaternion", Some("dop853")),
        ("euler", Some("dop853")),
        ("gamma", Some("dop853")),
    ];
    for (solver, method) in contestants {
        let is_meant = |run: &&Value| {
            let tolerance = run["tol"].as_f64();
            run["problem"] == "ensemble"
                && run["solver"] == solver
                && run["method"].as_str() == method
                && tolerance == method.map(|_| 1e-9)
        };
        let run = runs.iter().find(is_meant).unwrap();
        let number = |field: &str| run[field].as_f64().unwrap();
        let (calls, time) = (number("n_rhs") / 256.0, number("t_min_ns") / 256e3);
        let name = method.map_or_else(|| format!("`{solver}`"), |method| format!("`{solver}`, {method}"));
        let setting = method.map_or("", |_| "1e-9");
        let time = if time < 1.0 { format!("{time:.1}") } else { format!("{time:.0}") };
        let line = format!("| {name} | {setting} | {:.1e} rad | {calls:.0} | {time} µs |", number("err_attitude_rad"));
        assert!(README.contains(&line.replace("|  |", "| |")), "not in the README: {line}");
    }
}
