//! A trial is one toss that was tried: by how much it deviates from what a check claims. A fold makes one measurement of the
//! trials of a subject, which is a solver with its settings, or a named set of tosses of which the library is measured. Every
//! check returns measurements, so that one judge can compare all of them with their limits.

use std::cmp::Ordering;

use dynamics::Toss;
use serde::{Deserialize, Serialize};
use toss::SolveError;

use super::case;
use super::replay::Replay;
use super::subject::Subject;

/// What a row judges. A row about a solver stands or falls with the entry of the registry; a row about the library does
/// not, even if an entry has the same name as the library's own part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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

/// A deviation, or why the solver failed.
pub type Deviation = Result<f64, SolveError>;

/// A toss that was tried.
pub struct Trial<'a> {
    /// The toss.
    pub toss: Toss,
    /// Who flew it; `None` for the library.
    pub by: Option<&'a Subject>,
    /// By how much it deviates. A NaN or a failure counts as infinite.
    pub deviation: Deviation,
    /// The deviation that the solver's own error estimate allows; `None` if it has no estimate.
    pub allowed: Option<f64>,
    /// What a report says behind the text of the toss; empty for nothing.
    pub remark: String,
}

impl<'a> Trial<'a> {
    /// A toss of which the library is measured.
    pub fn of_library(toss: &Toss, deviation: Deviation) -> Self {
        Self { toss: *toss, by: None, deviation, allowed: None, remark: String::new() }
    }

    /// A toss that `subject` flew, with the deviation and what its error estimate allows.
    pub fn by(subject: &'a Subject, toss: &Toss, found: Result<(f64, Option<f64>), SolveError>) -> Self {
        let allowed = found.as_ref().ok().and_then(|(_, allowed)| *allowed);
        let deviation = found.map(|(deviation, _)| deviation);
        Self { by: Some(subject), allowed, ..Self::of_library(toss, deviation) }
    }

    /// The size of the deviation, and why it is infinite if the solver failed.
    fn size(&self) -> (f64, Option<String>) {
        match &self.deviation {
            Ok(size) if size.is_nan() => (f64::INFINITY, Some("not a number".to_owned())),
            Ok(size) => (*size, None),
            Err(error) => (f64::INFINITY, Some(error.to_string())),
        }
    }

    fn worst(&self, failure: Option<String>) -> Worst {
        let (text, settings) = (case::text(&self.toss), self.by.map(case::settings).unwrap_or_default());
        let input = if self.remark.is_empty() { text.clone() } else { format!("{text} # {}", self.remark) };
        Worst { input, failure, replay: Some(Replay { input: text, settings, row: None }) }
    }
}

/// How the deviations of trials become what is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// The largest.
    Largest,
    /// The number of tosses with any; the first of them is the worst case. With a failure it is infinite.
    Count,
    /// The same, divided by the number of tosses.
    Share,
    /// The median.
    Median,
}

impl Fold {
    /// What is measured of `subject` in its `trials`. The largest deviation has the claim of the solver that flew them.
    pub fn of(self, subject: &str, trials: &[Trial<'_>]) -> Measurement {
        let each = trials.iter().map(Trial::size);
        let mut sizes: Vec<(f64, Option<String>)> = match self {
            Self::Count | Self::Share => each.map(|(size, why)| (counted(size, why.as_ref()), why)).collect(),
            _ => each.collect(),
        };
        let (cases, number) = (trials.len() as u64, trials.len() as f64);
        let sum: f64 = sizes.iter().map(|(size, _)| size).sum();
        let worst = largest(&sizes);
        let (measured, claim) = match self {
            Self::Largest => (worst.map_or(f64::INFINITY, |worst| sizes[worst].0), Claim::of(trials)),
            Self::Count => (sum, Claim::NoSolver),
            Self::Share => (sum / number, Claim::NoSolver),
            Self::Median => {
                sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
                let at = |part: usize| sizes.get(sizes.len() * part / 100).map_or(f64::NAN, |(size, _)| *size);
                let input = format!("95 % are below {:.0}", at(95));
                return Measurement::figure(subject, at(50), cases, input);
            }
        };
        let worst = worst.map(|worst| trials[worst].worst(sizes[worst].1.clone()));
        let without_answer = trials.iter().filter(|trial| trial.deviation.is_err()).count() as u64;
        Measurement {
            measured,
            cases,
            without_answer,
            worst,
            claim,
            ..Measurement::figure(subject, 0.0, 0, String::new())
        }
    }
}

/// 1 for any deviation; infinite for a failure.
fn counted(size: f64, failure: Option<&String>) -> f64 {
    if failure.is_some() { size } else { f64::from(size != 0.0) }
}

/// Where the largest size is, the first of several.
fn largest(sizes: &[(f64, Option<String>)]) -> Option<usize> {
    let larger = |worst: Option<usize>, index: usize| match worst {
        Some(worst) if sizes[index].0.total_cmp(&sizes[worst].0) != Ordering::Greater => Some(worst),
        _ => Some(index),
    };
    (0..sizes.len()).fold(None, larger)
}

/// The result of one subject under one check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// The subject's name.
    pub subject: String,
    /// The deviation found; infinite if the subject failed or gave a NaN.
    pub measured: f64,
    /// Number of cases that were tried and judged.
    pub cases: u64,
    /// Number of further cases, which were not judged because there is no reference of them.
    pub without_reference: u64,
    /// Number of cases in which the subject failed.
    pub without_answer: u64,
    /// The case with the largest deviation.
    pub worst: Option<Worst>,
    /// What the solver's own error estimate allows.
    pub claim: Claim,
    /// What this measurement judges; `None` for what its check judges.
    pub judges: Option<Judges>,
}

/// The worst case of a measurement.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Worst {
    /// The case's toss as text, or what was measured in words.
    pub input: String,
    /// The error, if the subject failed.
    pub failure: Option<String>,
    /// What repeats the case; `None` if only the whole check does.
    pub replay: Option<Replay>,
}

/// What a solver's own error estimate allows for a measurement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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

impl Measurement {
    /// A single number that belongs to no toss.
    pub fn figure(subject: &str, measured: f64, cases: u64, input: String) -> Self {
        let measured = if measured.is_nan() { f64::INFINITY } else { measured };
        let (subject, worst) = (subject.to_owned(), Some(Worst { input, failure: None, replay: None }));
        Self {
            subject,
            measured,
            cases,
            without_reference: 0,
            without_answer: 0,
            worst,
            claim: Claim::NoSolver,
            judges: None,
        }
    }

    /// The largest of several measurements of one subject, with the claim of theirs that has the largest ratio of
    /// measured to allowed deviation.
    pub fn worst_of(all: Vec<Self>) -> Option<Self> {
        let claim = all.iter().map(|one| &one.claim).max_by(|a, b| a.part().total_cmp(&b.part()))?.clone();
        let worst = all.into_iter().max_by(|a, b| a.measured.total_cmp(&b.measured))?;
        Some(Self { claim, ..worst })
    }

    /// The same measurement, beside so many cases without a reference.
    #[must_use]
    pub fn beside_unjudged(self, without_reference: usize) -> Self {
        Self { without_reference: without_reference as u64, ..self }
    }

    /// The same measurement with the deviation that the solver's estimate allows; `None` if the solver has no estimate.
    #[must_use]
    pub fn claiming(self, allowed: Option<f64>) -> Self {
        let (measured, worst) = (self.measured, self.worst.clone());
        let claim = allowed.map_or(Claim::NoEstimate, |allowed| Claim::Allows { measured, allowed, worst });
        Self { claim, ..self }
    }

    /// The same measurement, of a quantity to which no error estimate applies.
    #[must_use]
    pub fn without_claim(self) -> Self {
        Self { claim: Claim::Silent, ..self }
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

    /// The claim of the solver that flew `trials`.
    fn of(trials: &[Trial<'_>]) -> Self {
        if trials.iter().all(|trial| trial.by.is_none()) {
            return Self::NoSolver;
        }
        // A failure has no estimate either, but it is the failure that counts.
        let is_open = |trial: &&Trial<'_>| trial.deviation.is_err() || trial.allowed.is_none();
        if trials.iter().find(is_open).is_some_and(|first| first.deviation.is_ok()) {
            return Self::NoEstimate;
        }
        let part = |trial: &Trial<'_>| {
            let (size, failure) = trial.size();
            (part(size, trial.allowed.unwrap_or(0.0)), failure)
        };
        let parts: Vec<_> = trials.iter().map(part).collect();
        let worst = largest(&parts).unwrap_or(0);
        let (measured, failure) = trials[worst].size();
        let (allowed, worst) = (trials[worst].allowed.unwrap_or(0.0), Some(trials[worst].worst(failure)));
        Self::Allows { measured, allowed, worst }
    }
}

/// `measured` divided by `allowed`; 0 if `measured` is 0, also where nothing is allowed.
fn part(measured: f64, allowed: f64) -> f64 {
    if measured == 0.0 { 0.0 } else { measured / allowed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::adversary;

    fn trials(by: &Subject, found: impl IntoIterator<Item = (Deviation, Option<f64>)>) -> Vec<Trial<'_>> {
        let trial = |(index, (deviation, allowed)): (usize, (Deviation, _))| {
            Trial::by(by, &adversary::launch(3, index), deviation.map(|deviation| (deviation, allowed)))
        };
        found.into_iter().enumerate().map(trial).collect()
    }

    #[test]
    fn a_fold_takes_the_worst_of_its_trials_and_a_failure_is_worse_than_any_number() {
        let (by, failure) = (Subject::exact(), || Err(SolveError::NotFinite { time: 0.0 }));
        let text = |index| case::text(&adversary::launch(3, index));
        let measured = |fold: Fold, all: &[Deviation]| {
            let found = fold.of("s", &trials(&by, all.iter().map(|one| (one.clone(), Some(1.0)))));
            let worst = found.worst.clone().expect("a worst case");
            (found.measured, worst.input, worst.failure.is_some())
        };
        let some = [Ok(0.0), Ok(3.0), Ok(-4.0), Ok(3.0)];
        assert_eq!(measured(Fold::Largest, &some), (3.0, text(1), false), "the first of the largest");
        assert_eq!(measured(Fold::Count, &some), (3.0, text(1), false));
        assert_eq!(measured(Fold::Share, &some), (0.75, text(1), false));
        assert_eq!(measured(Fold::Median, &some).0, 3.0);
        for fold in [Fold::Largest, Fold::Count, Fold::Share] {
            assert_eq!(measured(fold, &[Ok(1.0), failure(), Ok(2.0)]), (f64::INFINITY, text(1), true), "{fold:?}");
        }
        assert_eq!(measured(Fold::Largest, &[Ok(1.0), Ok(f64::NAN)]), (f64::INFINITY, text(1), true));
        assert_eq!(Fold::Largest.of("s", &[]).measured, f64::INFINITY, "nothing was tried");
    }

    #[test]
    fn a_claim_is_that_of_the_trial_which_is_largest_beside_it() {
        let by = Subject::exact();
        let claim = |all: &[(Deviation, Option<f64>)]| match Fold::Largest.of("s", &trials(&by, all.to_vec())).claim {
            Claim::Allows { measured, allowed, .. } => Some((measured, allowed)),
            other => {
                assert_eq!(other, Claim::NoEstimate);
                None
            }
        };
        assert_eq!(claim(&[(Ok(1.0), Some(1e3)), (Ok(1e-3), Some(1e-2))]), Some((1e-3, 1e-2)));
        assert_eq!(claim(&[(Ok(1.0), Some(1e3)), (Ok(0.0), None)]), None);
        let failed = (Err(SolveError::NotFinite { time: 0.0 }), None);
        assert_eq!(claim(&[(Ok(1.0), Some(1e3)), failed]), Some((f64::INFINITY, 0.0)));
        let library = Trial::of_library(&adversary::launch(3, 0), Ok(1.0));
        assert_eq!(Fold::Largest.of("s", &[library]).claim, Claim::NoSolver);
    }
}
