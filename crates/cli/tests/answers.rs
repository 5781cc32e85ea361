//! This test repeats some four hundred command lines and compares what they answer with what is recorded in
//! `answers.jsonl`, to the last bit of each number. The lines cover all commands, coins and other bodies, solvers, methods, and
//! bad input. The test fails if a change that was only to rebuild code changes an answer.
//!
//! With the environment variable `RECORD_ANSWERS` the test writes the file anew. Each line that then differs needs a reason.
//! `ANSWERS_OF` names another program: see `common`. Of one for another processor, the lines are left out whose answers
//! depend on the sine and cosine of the system's library, which rounds differently there (integrations of angles, and
//! traces, which print angles), and those that find there no more than others do: see `is_left_out`.

mod common;

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use common::{run, stderr, stdout};
use serde_json::{Value, json};

/// What the program answers: its exit status, its JSON if there is one, and its message.
fn answer(line: &str) -> Value {
    let output = run(line);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| stdout(&output).into());
    json!({ "line": line, "status": output.status.code(), "answer": answer, "message": stderr(&output) })
}

/// What the program answers to the lines of `recorded`, by all processors.
fn answers(recorded: &[Value]) -> Vec<Value> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let ask = |before: &Value| answer(before["line"].as_str().expect("a command line"));
    std::thread::scope(|scope| {
        let shares = recorded.chunks(recorded.len().div_ceil(threads).max(1));
        let running: Vec<_> = shares.map(|share| scope.spawn(|| share.iter().map(ask).collect::<Vec<_>>())).collect();
        running.into_iter().flat_map(|share| share.join().expect("its lines are answered")).collect()
    })
}

/// Searches of many launches, which take half of the time under an emulator. The other searches are shorter.
const LONG: [&str; 4] = [
    "spread --rate 1,1,2.5 --speed 3 --heads 0.9999999999",
    "spread --rate 20,3,4",
    "spread --coin us-quarter --turn 38rev/s --psi 60deg",
    "intervals --coin book --rate 1,2,30 --speed 0.1:8",
];

/// Whether another processor is not asked a line: its answer depends on the system's library, or it is refused before
/// anything is computed, or it is asked as JSON as well, or long.
fn is_left_out(recorded: &Value, lines: &HashSet<String>) -> bool {
    let line = recorded["line"].as_str().expect("a command line");
    let is_of_the_system = ["gamma", "euler"].iter().any(|solver| line.contains(solver))
        || ["compare", "trace"].iter().any(|command| line.starts_with(command));
    let is_refused = recorded["status"] == 2;
    is_of_the_system
        || is_refused
        || lines.contains(&format!("{line} --format json"))
        || LONG.iter().any(|long| line.starts_with(long))
}

#[test]
fn recorded_command_lines_answer_what_they_answered() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/answers.jsonl");
    let text = fs::read_to_string(&file).expect("the recorded answers");
    let mut recorded: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert!(recorded.len() > 300, "{} answers", recorded.len());
    if std::env::var_os("ANSWERS_OF").is_some() {
        let lines = recorded.iter().filter_map(|answer| answer["line"].as_str().map(str::to_owned)).collect();
        recorded.retain(|answer| !is_left_out(answer, &lines));
        assert!(recorded.len() > 280, "{} answers", recorded.len());
    }
    let found = answers(&recorded);
    if std::env::var_os("RECORD_ANSWERS").is_some() {
        fs::write(&file, found.iter().map(|now| format!("{now}\n")).collect::<String>()).expect("a file to write");
        return;
    }
    let moved: Vec<String> = recorded
        .iter()
        .zip(&found)
        .filter(|(before, now)| before != now)
        .map(|(before, now)| format!("{before}\n{now}\n"))
        .collect();
    assert!(moved.is_empty(), "{} of {} moved, before and now:\n{}", moved.len(), recorded.len(), moved.concat());
}
