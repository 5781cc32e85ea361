//! A measurement is the largest deviation of one subject under one check, with the case that shows it and the deviation
//! that the subject's own error estimate allows. Every check returns its results in this form, so that one judge can
//! compare all of them with their limits.
//!
//! A subject is a solver with its settings, or a named set of cases of the exact motion.

use std::cmp::Ordering;

use dynamics::Toss;
use serde::Serialize;
use toss::SolveError;

use super::case;
use super::replay::Replay;
use super::subject::Subject;

/// What a row judges. A row about a solver stands or falls with the entry of the registry; a row about the library does
/// not, even if an entry has the same name as the library's own part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Judges {
    /// A solver of the registry.
    Solver,
    /// The library itself: its exact motion, proofs, batches, sampling methods, planner or numbers.
    Library,
}

impl Judges {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solver => "solver",
            Self::Library => "library",
        }
    }
}

/// The result of one subject under one check.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The subject's name.
    pub subject: String,
    /// The largest deviation found; infinite if the subject failed or gave a NaN.
    pub measured: f64,
    /// Number of cases that were tried and judged.
    pub cases: u64,
    /// Number of further cases, which were not judged because there is no reference of them.
    pub without_reference: u64,
    /// The case with the largest deviation.
    pub worst: Option<Worst>,
    /// What the solver's own error estimate allows.
    pub claim: Claim,
    /// What this measurement judges; `None` for what its check judges.
    pub judges: Option<Judges>,
}

/// What a solver's own error estimate allows for a measurement.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// The measurement is not of a solver, so there is no estimate.
    NoSolver,
    /// The measured quantity is not an error (but an order, a slope or an amount of work), so no estimate applies to
    /// it.
    Silent,
    /// The solver has no error estimate.
    NoEstimate,
    /// The estimate allows a deviation. Of several cases this is the one with the largest ratio of deviation to allowed
    /// deviation, which need not be the one with the largest deviation.
    Allows {
        /// The deviation of that case.
        measured: f64,
        /// The deviation that the estimate allows for it.
        allowed: f64,
        /// The case.
        worst: Option<Worst>,
    },
}

/// The worst case of a measurement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Worst {
    /// The case's toss as text, or what was measured in words.
    pub input: String,
    /// The error, if the subject failed.
    pub failure: Option<String>,
    /// What repeats the case; `None` if only the whole check does.
    pub replay: Option<Replay>,
}

/// A deviation, or why the solver failed.
pub type Deviation = Result<f64, SolveError>;

impl Measurement {
    /// Nothing measured yet of what is called `name`.
    pub(super) fn of(name: &str) -> Self {
        let (subject, claim) = (name.to_owned(), Claim::NoSolver);
        Self { subject, measured: f64::INFINITY, cases: 0, without_reference: 0, worst: None, claim, judges: None }
    }

    /// The same measurement, beside so many cases without a reference.
    #[must_use]
    pub fn beside_unjudged(self, without_reference: usize) -> Self {
        Self { without_reference: without_reference as u64, ..self }
    }

    /// The largest of the deviations of `subject`, which are in the order of their tosses; `allowed` returns the deviation
    /// that its estimate allows for a toss, `None` if it has no estimate. A NaN or a failure counts as infinite.
    pub fn largest(
        subject: &Subject,
        deviations: &[Deviation],
        toss: impl Fn(usize) -> Toss,
        allowed: impl Fn(usize) -> Result<Option<f64>, SolveError>,
    ) -> Self {
        let worst = |index, failure| Worst::by(&toss(index), subject, failure);
        let claim = Claim::of(deviations, allowed, worst);
        Self { claim, ..Self::without_estimate(&subject.name, deviations, worst) }
    }

    /// The largest of the deviations of what is called `name`, without a claim.
    pub fn without_estimate(
        name: &str,
        deviations: &[Deviation],
        worst: impl Fn(usize, Option<String>) -> Worst,
    ) -> Self {
        let (measured, worst) = match largest(deviations) {
            Some((index, size, failure)) => (size, Some(worst(index, failure))),
            None => (f64::INFINITY, None),
        };
        let cases = deviations.len() as u64;
        Self { measured, cases, worst, ..Self::of(name) }
    }

    /// The number of cases with a deviation; the first one becomes the worst case. With a failure it is infinite.
    pub fn count(name: &str, deviations: &[Deviation], worst: impl Fn(usize, Option<String>) -> Worst) -> Self {
        let each: Vec<Deviation> =
            deviations.iter().map(|found| found.clone().map(|size| f64::from(size != 0.0))).collect();
        let sum: Deviation = each.iter().cloned().sum();
        Self { measured: sum.unwrap_or(f64::INFINITY), ..Self::without_estimate(name, &each, worst) }
    }

    /// A single number that belongs to no toss.
    pub fn figure(subject: &str, measured: f64, cases: u64, input: String) -> Self {
        let measured = if measured.is_nan() { f64::INFINITY } else { measured };
        let worst = Some(Worst { input, failure: None, replay: None });
        Self { measured, cases, worst, ..Self::of(subject) }
    }

    /// The largest of several measurements of one subject, with the claim of theirs that has the largest ratio of
    /// measured to allowed deviation.
    pub fn worst_of(all: Vec<Self>) -> Option<Self> {
        let claim = all.iter().map(|one| &one.claim).max_by(|a, b| a.part().total_cmp(&b.part()))?.clone();
        let worst = all.into_iter().max_by(|a, b| a.measured.total_cmp(&b.measured))?;
        Some(Self { claim, ..worst })
    }

    /// The same measurement with the deviation that the solver's estimate allows; `None` if the solver has no estimate.
    #[must_use]
    pub fn claiming(self, allowed: Option<f64>) -> Self {
        let claim = allowed.map_or(Claim::NoEstimate, |allowed| Claim::Allows {
            measured: self.measured,
            allowed,
            worst: self.worst.clone(),
        });
        Self { claim, ..self }
    }

    /// The same measurement as a judgement of the library, under a check that otherwise judges solvers.
    #[must_use]
    pub fn of_the_library(self) -> Self {
        Self { judges: Some(Judges::Library), ..self }
    }

    /// The same measurement, whose worst cases are changed by `change`.
    #[must_use]
    pub fn with_worst(mut self, change: impl Fn(Worst) -> Worst) -> Self {
        self.worst = self.worst.map(&change);
        if let Claim::Allows { worst, .. } = &mut self.claim {
            *worst = worst.take().map(change);
        }
        self
    }

    /// The same measurement, of a quantity to which no error estimate applies.
    #[must_use]
    pub fn without_claim(self) -> Self {
        Self { claim: Claim::Silent, ..self }
    }
}

impl Claim {
    /// The deviation divided by what is allowed; infinite for a solver without an estimate.
    fn part(&self) -> f64 {
        match self {
            Self::NoSolver | Self::Silent => 0.0,
            Self::NoEstimate => f64::INFINITY,
            Self::Allows { measured, allowed, .. } => part(*measured, *allowed),
        }
    }

    fn of(
        deviations: &[Deviation],
        allowed: impl Fn(usize) -> Result<Option<f64>, SolveError>,
        worst: impl Fn(usize, Option<String>) -> Worst,
    ) -> Self {
        let allowed: Result<Option<Vec<f64>>, (usize, SolveError)> =
            (0..deviations.len()).map(|index| allowed(index).map_err(|error| (index, error))).collect();
        let allowed = match allowed {
            Ok(Some(allowed)) => allowed,
            Ok(None) => return Self::NoEstimate,
            Err((index, error)) => {
                let worst = Some(worst(index, Some(error.to_string())));
                return Self::Allows { measured: f64::INFINITY, allowed: 0.0, worst };
            }
        };
        let parts = deviations.iter().zip(&allowed).map(|(deviation, allowed)| match deviation {
            Ok(size) => Ok(part(*size, *allowed)),
            Err(error) => Err(error.clone()),
        });
        let Some((index, _, failure)) = largest(&parts.collect::<Vec<_>>()) else {
            return Self::Allows { measured: f64::INFINITY, allowed: 0.0, worst: None };
        };
        let measured = deviations[index].as_ref().map_or(f64::INFINITY, |size| *size);
        Self::Allows { measured, allowed: allowed[index], worst: Some(worst(index, failure)) }
    }
}

/// `measured` divided by `allowed`; 0 if `measured` is 0, also where nothing is allowed.
fn part(measured: f64, allowed: f64) -> f64 {
    if measured == 0.0 { 0.0 } else { measured / allowed }
}

/// The index and the size of the largest deviation, and why the solver failed there if it did.
fn largest(deviations: &[Deviation]) -> Option<(usize, f64, Option<String>)> {
    let mut worst: Option<(usize, f64, Option<String>)> = None;
    for (index, deviation) in deviations.iter().enumerate() {
        let (size, failure) = match deviation {
            Ok(size) if size.is_nan() => (f64::INFINITY, Some("not a number".to_owned())),
            Ok(size) => (*size, None),
            Err(error) => (f64::INFINITY, Some(error.to_string())),
        };
        if worst.as_ref().is_none_or(|(_, largest, _)| size.total_cmp(largest) == Ordering::Greater) {
            worst = Some((index, size, failure));
        }
    }
    worst
}

impl Worst {
    /// The toss, which the solver of `subject` repeats.
    pub fn by(toss: &Toss, subject: &Subject, failure: Option<String>) -> Self {
        Self { input: case::text(toss), failure, replay: Some(Replay::new(toss, subject)) }
    }

    /// The toss, of which the library is measured.
    pub fn of_library(toss: &Toss, failure: Option<String>) -> Self {
        let input = case::text(toss);
        let replay = Replay { input: input.clone(), settings: String::new(), row: None };
        Self { input, failure, replay: Some(replay) }
    }

    /// The same case with a remark behind it, which is no part of its text.
    #[must_use]
    pub fn remarking(self, remark: &str) -> Self {
        let input = if remark.is_empty() { self.input } else { format!("{} # {remark}", self.input) };
        Self { input, ..self }
    }
}
