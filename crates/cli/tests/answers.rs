//! This test repeats some four hundred command lines and compares what they answer with what is recorded in
//! `answers.jsonl`, to the last bit of each number. The lines cover all commands, coins and other bodies, solvers, methods, and
//! bad input. The test fails if a change that was only to rebuild code changes an answer.
//!
//! With the environment variable `RECORD_ANSWERS` the test writes the file anew. Each line that then differs needs a reason.
//! `ANSWERS_OF` names another program: see `common`. Of one for another processor, the lines are left out whose answers
//! depend on the sine and cosine of the system's library, which rounds differently there (integrations of angles, and
//! traces, which print angles), and those that find there no more than shorter ones do: see `is_left_out`.

mod common;

use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

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
    let left = Mutex::new(recorded.iter().enumerate());
    let take = || left.lock().expect("no thread panics here").next();
    let ask = |(index, before): (usize, &Value)| (index, answer(before["line"].as_str().expect("a command line")));
    let mut found: Vec<(usize, Value)> = std::thread::scope(|scope| {
        let work = || std::iter::from_fn(take).map(ask).collect::<Vec<_>>();
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().flat_map(|share| share.join().expect("its lines are answered")).collect()
    });
    found.sort_by_key(|(index, _)| *index);
    found.into_iter().map(|(_, answer)| answer).collect()
}

/// What takes most of the time under an emulator. Others ask the same commands and methods for less.
const LONG: [&str; 8] = [
    "spread --rate 1,1,2.5 --speed 3 --heads 0.9999999999",
    "spread --rate 20,3,4",
    "spread --coin us-quarter --turn 38rev/s --psi 60deg",
    "intervals --coin book --rate 1,2,30 --speed 0.1:8",
    "intervals --inertia 1,1.2,1.9,0.05,-0.02,0.1 --rate 5,0,0",
    "limit --points 9 --solver quaternion",
    "probability --rate-x 1:60 --rate-y 1:60 --rate-z 1:60 --speed 3:5 --accuracy 1e-5",
    "probability --rate-x normal:38:1 --rate-y 0 --rate-z 20 --speed normal:3:0.1 --method exact-speed",
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
