//! What the tests of the commands assert of the program's output.

use serde_json::Value;

#[path = "../common/mod.rs"]
mod program;

pub(crate) use program::{run, stderr, stdout};

/// Runs a command with `--format json`, asserts that it ends with `code`, and returns the JSON value that it prints.
#[track_caller]
pub(crate) fn json(arguments: &str, code: i32) -> Value {
    let output = run(&format!("{arguments} --format json"));
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments}: {error}: {}", stdout(&output)))
}

#[track_caller]
pub(crate) fn assert_near(value: &Value, expected: f64, within: f64) {
    let found = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((found - expected).abs() <= within, "{found}, not {expected}");
}

/// Asserts that each command ends with 2, prints nothing on standard output, and that its message contains both texts.
/// With `--format json` the message has to contain the first.
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
