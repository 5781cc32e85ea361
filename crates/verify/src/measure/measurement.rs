//! What a check measures: the largest deviation of a subject, the case that shows it, and what the subject itself claims.

use std::cmp::Ordering;

use toss::SolveError;

use super::case::Case;
use super::run::Allowance;
use super::subject::Subject;

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
    /// What the solver's own error estimate says of it.
    pub claim: Claim,
}

/// What a solver's own error estimate says of a measurement.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// The measurement is not one of a solver.
    NoSolver,
    /// An error estimate says nothing of what is measured: an order, a slope, an amount of work.
    Silent,
    /// The solver has no error estimate.
    NoEstimate,
    /// The estimate allows a deviation. Of several cases this is the one whose deviation, divided by what is allowed, is the
    /// largest; its deviation itself need not be.
    Allows {
        /// The deviation.
        measured: f64,
        /// What the estimate allows.
        allowed: f64,
        /// The case.
        worst: Option<Worst>,
    },
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

/// A deviation, or why there is none.
pub type Deviation = Result<f64, SolveError>;

impl Measurement {
    /// The largest of the deviations of `subject`, which are in the order of their cases. `allowed` is what of the subject's
    /// own allowance applies to them. A NaN is the largest of all.
    pub fn largest(
        subject: &Subject,
        deviations: impl IntoIterator<Item = Deviation>,
        case: impl Fn(usize) -> Case,
        allowed: fn(&Allowance) -> f64,
    ) -> Self {
        Self::largest_within(subject, deviations, &case, |index| {
            Ok(Allowance::new(subject, &case(index).toss)?.map(|allowance| allowed(&allowance)))
        })
    }

    /// The largest of the deviations of `subject`; `allowed` is what it claims for each of them, `None` for no claim.
    pub fn largest_within(
        subject: &Subject,
        deviations: impl IntoIterator<Item = Deviation>,
        case: impl Fn(usize) -> Case,
        allowed: impl Fn(usize) -> Result<Option<f64>, SolveError>,
    ) -> Self {
        let deviations: Vec<Deviation> = deviations.into_iter().collect();
        let worst = |index, failure| worst(&case(index), subject, failure);
        let claim = Claim::of(&deviations, allowed, worst);
        Self { claim, ..Self::without_estimate(&subject.name, &deviations, worst) }
    }

    /// The largest of the deviations of the exact motion in a set of cases.
    pub fn of_set(name: &str, deviations: &[Deviation], case: impl Fn(usize) -> Case) -> Self {
        let exact = Subject::exact();
        Self::without_estimate(name, deviations, |index, failure| worst(&case(index), &exact, failure))
    }

    /// How many cases of `subject` are `found`; the first one is the worst.
    pub fn count(subject: &Subject, found: &[Result<bool, SolveError>], case: impl Fn(usize) -> Case) -> Self {
        Self::counted(&subject.name, found, |index, failure| worst(&case(index), subject, failure))
    }

    /// How many cases of a set are `found` of the exact motion; the first one is the worst.
    pub fn count_of_set(name: &str, found: &[Result<bool, SolveError>], case: impl Fn(usize) -> Case) -> Self {
        let exact = Subject::exact();
        Self::counted(name, found, |index, failure| worst(&case(index), &exact, failure))
    }

    fn counted(name: &str, found: &[Result<bool, SolveError>], worst: impl Fn(usize, Option<String>) -> Worst) -> Self {
        let each: Vec<Deviation> = found.iter().map(|found| found.clone().map(f64::from)).collect();
        let sum: Deviation = each.iter().cloned().sum();
        Self { measured: sum.unwrap_or(f64::INFINITY), ..Self::without_estimate(name, &each, worst) }
    }

    fn without_estimate(name: &str, deviations: &[Deviation], worst: impl Fn(usize, Option<String>) -> Worst) -> Self {
        let (measured, worst) = match largest(deviations) {
            Some((index, size, failure)) => (size, Some(worst(index, failure))),
            None => (f64::INFINITY, None),
        };
        let cases = deviations.len() as u64;
        Self { subject: name.to_owned(), measured, cases, worst, claim: Claim::NoSolver }
    }

    /// A single figure without an input of its own.
    pub fn figure(check: &str, subject: &str, measured: f64, cases: u64, input: String) -> Self {
        let replay = format!("cargo xtask verify --only {check}");
        let measured = if measured.is_nan() { f64::INFINITY } else { measured };
        let worst = Some(Worst { input, failure: None, replay });
        Self { subject: subject.to_owned(), measured, cases, worst, claim: Claim::NoSolver }
    }

    /// The largest of several measurements of one subject, with the one of their claims that is furthest exceeded.
    pub fn worst_of(all: Vec<Self>) -> Option<Self> {
        let claim = all.iter().map(|one| &one.claim).max_by(|a, b| a.part().total_cmp(&b.part()))?.clone();
        let worst = all.into_iter().max_by(|a, b| a.measured.total_cmp(&b.measured))?;
        Some(Self { claim, ..worst })
    }

    /// The same measurement, of a solver that allows itself `allowed`; `None` if it has no error estimate.
    #[must_use]
    pub fn claiming(self, allowed: Option<f64>) -> Self {
        let claim = allowed.map_or(Claim::NoEstimate, |allowed| Claim::Allows {
            measured: self.measured,
            allowed,
            worst: self.worst.clone(),
        });
        Self { claim, ..self }
    }

    /// The same measurement, of a solver whose error estimate says nothing of it.
    #[must_use]
    pub fn without_claim(self) -> Self {
        Self { claim: Claim::Silent, ..self }
    }
}

impl Claim {
    /// The deviation, divided by what is allowed; infinite without an estimate.
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

/// `measured` divided by `allowed`, of which both may be 0.
fn part(measured: f64, allowed: f64) -> f64 {
    if measured == 0.0 { 0.0 } else { measured / allowed }
}

/// The place and the size of the largest deviation, and why it failed if it did.
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

fn worst(case: &Case, subject: &Subject, failure: Option<String>) -> Worst {
    Worst { input: case.hex(), failure, replay: case.replay(subject) }
}
