//! What a check measures: the largest deviation of a subject, and the case that shows it.

use std::cmp::Ordering;

use toss::SolveError;

use crate::case::Case;
use crate::subject::Subject;

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
