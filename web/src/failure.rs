//! The reasons for which a question has no answer, as JSON. They have the words and the kinds of the command line.

use serde_json::{Value, json};
use toss::{Error, InputError, SolveError};

/// The reason why a question has no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Invalid input, or a solver that failed.
    #[error(transparent)]
    Unanswered(#[from] Error),
    /// A question that is not understood.
    #[error("the question can't be read: {0}")]
    Question(#[from] serde_json::Error),
}

impl From<InputError> for Failure {
    fn from(source: InputError) -> Self {
        Error::from(source).into()
    }
}

impl From<SolveError> for Failure {
    fn from(source: SolveError) -> Self {
        Error::from(source).into()
    }
}

impl Failure {
    /// `{"error":{"kind","message","field"?}}`.
    pub(crate) fn to_json(&self) -> Value {
        let (kind, field) = match self {
            Self::Unanswered(error) => (error.kind(), error.field()),
            Self::Question(_) => ("input", None),
        };
        let mut error = json!({ "kind": kind, "message": self.to_string() });
        if let Some(field) = field {
            error["field"] = json!(field);
        }
        json!({ "error": error })
    }
}
