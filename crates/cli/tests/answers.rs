//! This test repeats some four hundred command lines and compares what they answer with what is recorded in
//! `answers.jsonl`, to the last bit of each number. The lines cover all commands, coins and other bodies, solvers, methods, and
//! bad input. The test fails if a change that was only to rebuild code changes an answer.
//!
//! With the environment variable `RECORD_ANSWERS` the test writes the file anew. Each line that then differs needs a reason.
//! `ANSWERS_OF` names another program: see `common`. Of one for another processor, the lines are left out whose answers
//! depend on the sine and cosine of the system's library, which rounds differently there: integrations of angles, and
//! traces, which print angles.

mod common;

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

/// Whether the answer to a line depends on the system's library.
fn is_of_the_system(recorded: &Value) -> bool {
    let line = recorded["line"].as_str().expect("a command line");
    line.contains("gamma") || line.contains("euler") || line.starts_with("compare") || line.starts_with("trace")
}

#[test]
fn recorded_command_lines_answer_what_they_answered() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/answers.jsonl");
    let text = fs::read_to_string(&file).expect("the recorded answers");
    let mut recorded: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    if std::env::var_os("ANSWERS_OF").is_some() {
        recorded.retain(|answer| !is_of_the_system(answer));
    }
    let found = answers(&recorded);
    if std::env::var_os("RECORD_ANSWERS").is_some() {
        fs::write(&file, found.iter().map(|now| format!("{now}\n")).collect::<String>()).expect("a file to write");
        return;
    }
    assert!(recorded.len() > 300, "{} answers", recorded.len());
    let moved: Vec<String> = recorded
        .iter()
        .zip(&found)
        .filter(|(before, now)| before != now)
        .map(|(before, now)| format!("{before}\n{now}\n"))
        .collect();
    assert!(moved.is_empty(), "{} of {} moved, before and now:\n{}", moved.len(), recorded.len(), moved.concat());
}
