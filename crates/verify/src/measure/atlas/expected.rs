//! Reads `validation/atlas.toml`: what every contestant is known to do at every hazard.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::files;
use crate::measure::run::Answer;

/// What the worst answer may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Expectation {
    /// It is right.
    Right,
    /// It is an error.
    TypedError,
    /// It is wrong without an error.
    SilentlyWrong,
    /// It is right or an error: which of them depends on roundings next to a singular point, which differ by platform.
    RightOrTypedError,
}

impl Expectation {
    /// Whether `answer` is as expected.
    pub fn allows(self, answer: Answer) -> bool {
        match self {
            Self::Right => answer == Answer::Right,
            Self::TypedError => answer == Answer::TypedError,
            Self::SilentlyWrong => answer == Answer::SilentlyWrong,
            Self::RightOrTypedError => matches!(answer, Answer::Right | Answer::TypedError),
        }
    }
}

/// The worst answer, by contestant and hazard.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Expected(BTreeMap<String, BTreeMap<String, Expectation>>);

impl Expected {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If it can't be read.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        files::read_toml(path)
    }

    /// What `subject` is known to do at `hazard`.
    pub fn get(&self, subject: &str, hazard: &str) -> Option<Expectation> {
        self.0.get(subject)?.get(hazard).copied()
    }

    /// Whether it is known what `subject` does.
    pub fn knows(&self, subject: &str) -> bool {
        self.0.contains_key(subject)
    }
}
