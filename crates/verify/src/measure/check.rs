//! What a check is: a claim, its basis, and a function that measures it for every subject.

use serde::Serialize;

use crate::measure::context::Context;
use crate::measure::measurement::Measurement;

/// What a claim rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// The exact motion in more digits.
    ClosedForm,
    /// A conserved quantity.
    Invariant,
    /// A figure that somebody published.
    PublishedFigure,
    /// Different ways to the same answer agree.
    CrossMethod,
}

impl Basis {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Invariant => "invariant",
            Self::PublishedFigure => "published figure",
            Self::CrossMethod => "cross-method",
        }
    }
}

/// A claim and how it is measured.
#[derive(Debug)]
pub struct Check {
    /// Short name, unique.
    pub id: &'static str,
    /// The claim, in a sentence.
    pub claim: &'static str,
    /// What it rests on.
    pub basis: Basis,
    /// Unit of what is measured; "1" for a pure number.
    pub unit: &'static str,
    /// Measures the claim for every subject.
    pub measure: fn(&Context) -> anyhow::Result<Vec<Measurement>>,
}
