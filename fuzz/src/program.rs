//! The command line within this process.

use std::ffi::OsString;

use serde_json::Value;
use unfair_toss::Streams;

/// What a run of the program left.
#[derive(Debug)]
pub struct Ran {
    /// The exit code.
    pub code: u8,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

/// Runs the program with `arguments` and the bytes of its standard input.
///
/// # Panics
/// If a failure has no message, an answer comes with one, or an exit code is none of the documented ones.
pub fn run(arguments: &[&str], mut input: &[u8]) -> Ran {
    let arguments: Vec<OsString> = std::iter::once(&"unfair-toss").chain(arguments).map(OsString::from).collect();
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = unfair_toss::run(&arguments, Streams { input: &mut input, out: &mut out, err: &mut err });
    let [out, err] = [out, err].map(|bytes| String::from_utf8(bytes).expect("it prints UTF-8"));
    assert!(code <= 2, "ended with {code}: {err}");
    assert_eq!(code == 0, err.trim().is_empty(), "ended with {code}: {err}");
    Ran { code, out, err }
}

/// Checks that no number of an answer is -0; JSON has none that is not finite.
pub fn assert_finite(value: &Value) {
    match value {
        Value::Number(number) => {
            let number = number.as_f64().expect("an f64");
            assert!(number.is_finite() && (number != 0.0 || number.is_sign_positive()), "{number}");
        }
        Value::Array(items) => items.iter().for_each(assert_finite),
        Value::Object(fields) => fields.values().for_each(assert_finite),
        _ => {}
    }
}

/// The name of the outcome that a cos θ of the exact motion shows.
pub fn name_by_sign(cos_tilt: f64) -> &'static str {
    match cos_tilt {
        positive if positive > 0.0 => "heads",
        negative if negative < 0.0 => "tails",
        _ => "undecided",
    }
}
