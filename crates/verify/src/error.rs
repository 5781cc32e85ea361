//! The error of a run that could not be done. A solver that fails is no such error: it becomes a row that fails.

use std::fmt;

/// What could not be done, and why, in words: a file that cannot be read, an unknown check, two solvers of one name.
#[derive(Debug)]
pub struct Error(anyhow::Error);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#}", self.0)
    }
}

impl std::error::Error for Error {}

impl From<anyhow::Error> for Error {
    fn from(error: anyhow::Error) -> Self {
        Self(error)
    }
}
