//! What a check is: a claim, its basis, and a function that measures it for every subject.

use std::cmp::Ordering;
use std::path::Path;
use std::sync::OnceLock;

use anyhow::Context as _;
use serde::Serialize;
use toss::{InputError, SolveError, SolverEntry};

use crate::atlas::Atlas;
use crate::atlas::expected::Expected;
use crate::case::Case;
use crate::convergence::{Convergence, convergence};
use crate::long_flights::LongFlights;
use crate::reference_data::ReferenceData;
use crate::reference_probability::ReferenceProbabilities;
use crate::search::{Findings, search};
use crate::subject::{Subject, subjects};
use crate::survey::Survey;
use crate::work_precision::Sweep;
use crate::work_precision::problems::{self, Problem};

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

/// What checks share: the subjects, the data, and what is computed once for several of them.
pub struct Context {
    /// How much is tried.
    pub effort: Effort,
    /// The registry under verification.
    pub registry: Vec<SolverEntry>,
    /// Its subjects.
    pub subjects: Vec<Subject>,
    /// Motions from outside.
    pub data: ReferenceData,
    /// Probabilities from outside.
    pub probabilities: ReferenceProbabilities,
    /// The flights over which speed is compared with accuracy.
    pub problems: Vec<Problem>,
    /// What contestants are known to do at hazards.
    pub expected: Expected,
    survey: OnceLock<Survey>,
    atlas: OnceLock<Atlas>,
    long_flights: OnceLock<LongFlights>,
    search: OnceLock<Vec<Findings>>,
    sweep: OnceLock<Sweep>,
    convergence: OnceLock<Vec<Convergence>>,
}

impl Context {
    /// A context over `registry`, with the reference numbers under `validation`.
    ///
    /// # Errors
    /// If the reference numbers can't be read.
    pub fn new(registry: &[SolverEntry], effort: Effort, validation: &Path) -> anyhow::Result<Self> {
        Ok(Self {
            effort,
            registry: registry.to_vec(),
            subjects: subjects(registry).context("the registry's solvers can't be made")?,
            data: ReferenceData::read(&validation.join("reference/motion.toml"))?,
            probabilities: ReferenceProbabilities::read(&validation.join("reference/probability.toml"))?,
            problems: problems::read(&validation.join("problems.toml"))?,
            expected: Expected::read(&validation.join("atlas.toml"))?,
            survey: OnceLock::new(),
            atlas: OnceLock::new(),
            long_flights: OnceLock::new(),
            search: OnceLock::new(),
            sweep: OnceLock::new(),
            convergence: OnceLock::new(),
        })
    }

    /// The landings of every subject from random launches; computed when first asked for.
    ///
    /// # Errors
    /// Never for the survey's own space.
    pub fn survey(&self) -> Result<&Survey, InputError> {
        once(&self.survey, || Survey::new(&self.subjects, self.effort.launches()))
    }

    /// The atlas of failures; computed when first asked for.
    ///
    /// # Errors
    /// As [`Atlas::new`].
    pub fn atlas(&self) -> anyhow::Result<&Atlas> {
        once(&self.atlas, || Atlas::new(&self.registry))
    }

    /// The long flights; computed when first asked for.
    ///
    /// # Errors
    /// As [`LongFlights::new`].
    pub fn long_flights(&self) -> anyhow::Result<&LongFlights> {
        once(&self.long_flights, || LongFlights::new(&self.registry))
    }

    /// What the search by adversarial launches found; done when first asked for.
    ///
    /// # Errors
    /// As [`search`].
    pub fn search(&self) -> Result<&Vec<Findings>, InputError> {
        once(&self.search, || search(&self.registry, self.effort.adversarial_launches()))
    }

    /// The sweep of tolerances and steps; done when first asked for.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn sweep(&self) -> Result<&Sweep, InputError> {
        once(&self.sweep, || Sweep::new(&self.registry, &self.problems, self.effort))
    }

    /// Errors by fixed step; measured when first asked for.
    ///
    /// # Errors
    /// As [`convergence`].
    pub fn convergence(&self) -> anyhow::Result<&Vec<Convergence>> {
        once(&self.convergence, || convergence(&self.registry))
    }

    /// What was asked for so far, for the reports.
    pub fn records(&self) -> Records<'_> {
        Records {
            atlas: self.atlas.get(),
            long_flights: self.long_flights.get(),
            sweep: self.sweep.get(),
            convergence: self.convergence.get(),
        }
    }
}

/// Runs behind the rows, where a check asked for them.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Records<'a> {
    /// The atlas of failures.
    pub atlas: Option<&'a Atlas>,
    /// Error and drift by time.
    pub long_flights: Option<&'a LongFlights>,
    /// Error and work by tolerance or step.
    pub sweep: Option<&'a Sweep>,
    /// Error by fixed step.
    pub convergence: Option<&'a Vec<Convergence>>,
}

/// What is in `cell`, made first if it is empty.
fn once<T, E>(cell: &OnceLock<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if cell.get().is_none() {
        let _ = cell.set(make()?);
    }
    Ok(cell.get().expect("it was just set"))
}
