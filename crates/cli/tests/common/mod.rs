//! Functions that the tests of the command line share: they run the program and check its output. Each test runs the
//! real program, so that options, exit codes and standard output are tested together.

use std::process::{Command, Output};

use serde_json::Value;

pub(crate) fn run(arguments: &str) -> Output {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().expect("the program starts")
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// Runs a command with `--format json`, asserts that it ends with `code`, and returns the JSON value that it prints.
#[track_caller]
pub(crate) fn json(arguments: &str, code: i32) -> Value {
    let output = run(&format!("{arguments} --format json"));
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments}: {error}: {}", stdout(&output)))
}

#[allow(dead_code, reason = "not every file of tests has numbers")]
#[track_caller]
pub(crate) fn assert_near(value: &Value, expected: f64, within: f64) {
    let found = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((found - expected).abs() <= within, "{found}, not {expected}");
}

/// Asserts that each command ends with 2, prints nothing on standard output, and that its message contains both texts.
/// With `--format json` the message has to contain the first.
#[allow(dead_code, reason = "not every file of tests has refusals")]
#[track_caller]
pub(crate) fn assert_refused(cases: &[(&str, [&str; 2])]) {
    for (arguments, words) in cases {
        let output = run(arguments);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        assert!(output.stdout.is_empty(), "{arguments} printed {}", stdout(&output));
        for word in words {
            assert!(message.contains(word), "{arguments}: '{message}' lacks '{word}'");
        }
        let error = json(arguments, 2);
        assert!(error["error"]["message"].as_str().unwrap_or_default().contains(words[0]), "{arguments}: {error}");
    }
}
