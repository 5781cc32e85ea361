//! Errors as JSON. They have the words and the kinds of the command line.

use serde_json::{Value, json};
use toss::Error;

/// `{"error":{"kind","message","field"?}}`.
pub(crate) fn to_json(failure: &Error) -> Value {
    let mut error = json!({ "kind": failure.kind(), "message": failure.to_string() });
    if let Some(field) = failure.field() {
        error["field"] = json!(field);
    }
    json!({ "error": error })
}

/// The error of a question that is not understood.
pub(crate) fn not_understood(error: &serde_json::Error) -> Error {
    Error::Text { line: error.line(), column: error.column(), message: format!("the question can't be read: {error}") }
}
