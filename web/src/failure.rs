//! Errors as JSON. They have the words and the kinds of the command line.

use serde::Serialize;
use toss::Error;

/// An error as an answer.
#[derive(Debug, Serialize)]
pub(crate) struct Refusal {
    error: Reason,
}

#[derive(Debug, Serialize)]
struct Reason {
    kind: &'static str,
    message: String,
    field: Option<String>,
}

impl Refusal {
    pub(crate) fn new(failure: &Error) -> Self {
        let field = failure.field().map(ToString::to_string);
        Self { error: Reason { kind: failure.kind(), message: failure.to_string(), field } }
    }
}

/// The error of a question that is not understood.
pub(crate) fn not_understood(error: &serde_json::Error) -> Error {
    Error::Text { line: error.line(), column: error.column(), message: format!("the question can't be read: {error}") }
}
