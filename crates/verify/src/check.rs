//! What a check is: a claim, its basis, and a function that measures it for every subject.

use std::cmp::Ordering;

use serde::Serialize;
use toss::SolveError;

use crate::case::Case;
use crate::context::Context;
use crate::subject::Subject;

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

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// Within a minute on two cores.
    Quick,
    /// Within five minutes.
    Standard,
    /// As long as it takes.
    Deep,
}

impl Effort {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Standard => "standard",
            Self::Deep => "deep",
        }
    }

    /// Number of random launches.
    pub fn launches(self) -> u64 {
        match self {
            Self::Quick => 1000,
            Self::Standard => 5000,
            Self::Deep => 50_000,
        }
    }
}

impl Effort {
    /// Number of adversarial launches.
    pub fn adversarial_launches(self) -> u64 {
        match self {
            Self::Quick => 2000,
            Self::Standard => 10_000,
            Self::Deep => 200_000,
        }
    }
}

/// A claim and how it is measured.
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

/// What one subject showed under one check.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The subject's name.
    pub subject: String,
    /// The largest deviation found; infinite if the subject failed where it should not.
    pub measured: f64,
    /// How many cases were tried.
    pub cases: u64,
    /// The case with the largest deviation.
    pub worst: Option<Worst>,
}

/// The worst case of a measurement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Worst {
    /// Its input in words, or as hex floats.
    pub input: String,
    /// The error, if the subject failed.
    pub failure: Option<String>,
    /// A command that repeats it.
    pub replay: String,
}

impl Measurement {
    /// The largest of the deviations of `subject`, which are in the order of their cases. A NaN is the largest of all.
    pub fn largest(
        subject: &Subject,
        deviations: impl IntoIterator<Item = Result<f64, SolveError>>,
        case: impl Fn(usize) -> Case,
    ) -> Self {
        let mut cases = 0;
        let mut worst: Option<(usize, f64, Option<String>)> = None;
        for (index, deviation) in deviations.into_iter().enumerate() {
            cases += 1;
            let (size, failure) = match deviation {
                Ok(size) if size.is_nan() => (f64::INFINITY, Some("not a number".to_owned())),
                Ok(size) => (size, None),
                Err(error) => (f64::INFINITY, Some(error.to_string())),
            };
            if worst.as_ref().is_none_or(|(_, largest, _)| size.total_cmp(largest) == Ordering::Greater) {
                worst = Some((index, size, failure));
            }
        }
        let measured = worst.as_ref().map_or(f64::INFINITY, |(_, size, _)| *size);
        let worst = worst.map(|(index, _, failure)| {
            let case = case(index);
            Worst { input: case.hex(), failure, replay: case.replay(subject) }
        });
        Self { subject: subject.name.clone(), measured, cases, worst }
    }

    /// A single figure without an input of its own.
    pub fn figure(check: &str, subject: &str, measured: f64, cases: u64, input: String) -> Self {
        let replay = format!("cargo xtask verify --only {check}");
        let measured = if measured.is_nan() { f64::INFINITY } else { measured };
        Self { subject: subject.to_owned(), measured, cases, worst: Some(Worst { input, failure: None, replay }) }
    }
}
