//! This file reads `data/atlas.toml`, the table of what every contestant is known to do at every hazard. The
//! check `atlas-answers` compares it with what contestants really do, so a change for the worse or the better shows.

use std::collections::BTreeMap;

use anyhow::Context;
use serde::Deserialize;

use crate::measure::run::Answer;

/// What the worst answer over all distances from a hazard must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Expectation {
    /// It is right or an error. Which one depends on rounding next to a singular point, which differs between
    /// platforms.
    RightOrTypedError,
    /// It is this one.
    #[serde(untagged)]
    Answer(Answer),
}

impl Expectation {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::RightOrTypedError => "right or typed error",
            Self::Answer(answer) => answer.name(),
        }
    }

    /// Whether `answer` is as expected.
    pub fn allows(self, answer: Answer) -> bool {
        match self {
            Self::RightOrTypedError => matches!(answer, Answer::Right | Answer::TypedError),
            Self::Answer(expected) => answer == expected,
        }
    }
}

/// The expected worst answers, by contestant and hazard.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Expected(BTreeMap<String, BTreeMap<String, Expectation>>);

impl Expected {
    /// What the solvers of this workspace are known to do.
    pub fn of_this_workspace() -> anyhow::Result<Self> {
        toml::from_str(include_str!("../../../data/atlas.toml")).context("in atlas.toml")
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
