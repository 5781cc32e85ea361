//! This file reads `data/atlas.toml`, the table of what every contestant is known to do at every hazard. The
//! check `atlas-answers` compares it with what contestants really do, so a change for the worse or the better shows.

use std::collections::BTreeMap;

use anyhow::Context;
use serde::Deserialize;

use crate::data;
use crate::measure::run::Answer;

/// What the worst answer over all distances from a hazard must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Expectation {
    /// It is right.
    Right,
    /// It is an error.
    TypedError,
    /// It is wrong without an error.
    SilentlyWrong,
    /// It is right or an error. Which one depends on rounding next to a singular point, which differs between
    /// platforms.
    RightOrTypedError,
}

impl Expectation {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::TypedError => "typed error",
            Self::SilentlyWrong => "silently wrong",
            Self::RightOrTypedError => "right or typed error",
        }
    }

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

/// The expected worst answers, by contestant and hazard.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Expected(BTreeMap<String, BTreeMap<String, Expectation>>);

impl Expected {
    /// What the solvers of this workspace are known to do.
    ///
    /// # Errors
    /// Never: tests read it.
    pub fn of_this_workspace() -> anyhow::Result<Self> {
        toml::from_str(data::ATLAS).context("in atlas.toml")
    }

    /// The expectation for `subject` at `hazard`, if the table has one.
    pub fn get(&self, subject: &str, hazard: &str) -> Option<Expectation> {
        self.0.get(subject)?.get(hazard).copied()
    }

    /// Whether the table lists `subject`.
    pub fn knows(&self, subject: &str) -> bool {
        self.0.contains_key(subject)
    }
}
