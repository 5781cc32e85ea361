//! A [`Context`] holds what all checks of a run share: the subjects, the reference data, and results that several
//! checks read. Each result is computed when the first check asks for it, so a run of one check computes only what
//! that check needs.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use anyhow::{Context as _, ensure};
use sampling::RunningStep;
use serde::Serialize;
use toss::{Error, InputError, SolverEntry};

use crate::measure::atlas::Atlas;
use crate::measure::atlas::expected::Expected;
use crate::measure::bodies::{self, BodyFindings, Family};
use crate::measure::convergence::{Convergence, convergence};
use crate::measure::effort::Effort;
use crate::measure::long_flights::LongFlights;
use crate::measure::planner::Trial;
use crate::measure::planner::summary::PlannerSummary;
use crate::measure::reference::coins::{self, ReferenceCoin};
use crate::measure::reference::motions::ReferenceData;
use crate::measure::reference::probabilities::ReferenceProbabilities;
use crate::measure::rigid_errors::{self, Judged};
use crate::measure::search::{Findings, search};
use crate::measure::subject::{Subject, subjects, tight};
use crate::measure::survey::Survey;
use crate::measure::tables::{Probability, fig4, probabilities};
use crate::measure::work_precision::Sweep;
use crate::measure::work_precision::problems::{self, Problem};

/// The subjects, the reference data and the shared results of a run.
pub struct Context {
    /// How many cases are tried.
    pub effort: Effort,
    /// The solvers under verification.
    pub registry: Vec<SolverEntry>,
    /// These solvers with each of their schemes at tight settings.
    pub subjects: Vec<Subject>,
    /// Reference motions from outside the workspace.
    pub data: ReferenceData,
    /// Reference probabilities from outside the workspace.
    pub reference_probabilities: ReferenceProbabilities,
    /// Moments of the catalogue's coins from outside the workspace.
    pub coins: Vec<ReferenceCoin>,
    /// The problems on which speed is compared with accuracy.
    pub problems: Vec<Problem>,
    /// What contestants are known to do near the places where methods fail.
    pub expected: Expected,
    survey: OnceLock<Survey>,
    atlas: OnceLock<Atlas>,
    long_flights: OnceLock<LongFlights>,
    search: OnceLock<Vec<Findings>>,
    bodies: OnceLock<Vec<BodyFindings>>,
    rigid_errors: OnceLock<Vec<(&'static Family, Vec<Judged>)>>,
    sweep: OnceLock<Sweep>,
    convergence: OnceLock<Vec<Convergence>>,
    trial: OnceLock<Trial>,
    probabilities: OnceLock<Vec<Probability>>,
    fig4: OnceLock<Vec<RunningStep>>,
}

impl Context {
    /// A context for the solvers of `registry`, and the data inside this crate.
    ///
    /// # Errors
    /// If two solvers have the same name, or a scheme takes neither a tolerance
    /// nor steps.
    pub fn new(registry: &[SolverEntry], effort: Effort) -> anyhow::Result<Self> {
        require_own_names(registry)?;
        Ok(Self {
            effort,
            registry: registry.to_vec(),
            subjects: subjects(registry, tight).context("the registry's solvers can't be made")?,
            data: ReferenceData::inside()?,
            reference_probabilities: ReferenceProbabilities::inside()?,
            coins: coins::inside()?,
            problems: problems::all()?,
            expected: Expected::of_this_workspace()?,
            survey: OnceLock::new(),
            atlas: OnceLock::new(),
            long_flights: OnceLock::new(),
            search: OnceLock::new(),
            bodies: OnceLock::new(),
            rigid_errors: OnceLock::new(),
            sweep: OnceLock::new(),
            convergence: OnceLock::new(),
            trial: OnceLock::new(),
            probabilities: OnceLock::new(),
            fig4: OnceLock::new(),
        })
    }

    /// The landings of every subject from random launches; computed on the first call.
    ///
    /// # Errors
    /// Never: the space of launches is fixed and valid.
    pub fn survey(&self) -> Result<&Survey, InputError> {
        once(&self.survey, || Survey::new(&self.subjects, self.effort.launches()))
    }

    /// The atlas of failures; computed on the first call.
    ///
    /// # Errors
    /// As [`Atlas::new`].
    pub fn atlas(&self) -> anyhow::Result<&Atlas> {
        once(&self.atlas, || Atlas::new(&self.registry))
    }

    /// The long flights; computed on the first call.
    ///
    /// # Errors
    /// As [`LongFlights::new`].
    pub fn long_flights(&self) -> anyhow::Result<&LongFlights> {
        once(&self.long_flights, || LongFlights::new(&self.registry))
    }

    /// What the search by adversarial launches found; computed on the first call.
    ///
    /// # Errors
    /// As [`search`].
    pub fn search(&self) -> Result<&Vec<Findings>, InputError> {
        once(&self.search, || search(&self.registry, self.effort.adversarial_launches()))
    }

    /// The landings of bodies by every subject that solves them; computed on the first call.
    pub fn bodies(&self) -> &[BodyFindings] {
        self.bodies.get_or_init(|| bodies::survey(&self.subjects, self.effort))
    }

    /// The errors of the exact motion of bodies in each family; computed on the first call.
    pub(crate) fn rigid_errors(&self) -> &[(&'static Family, Vec<Judged>)] {
        self.rigid_errors.get_or_init(|| rigid_errors::of_families(self.effort))
    }

    /// The sweep of tolerances and steps; computed on the first call.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn sweep(&self) -> Result<&Sweep, Error> {
        once(&self.sweep, || Sweep::new(&self.registry, &self.problems, self.effort))
    }

    /// The errors by fixed step; computed on the first call.
    ///
    /// # Errors
    /// As [`convergence`].
    pub fn convergence(&self) -> anyhow::Result<&Vec<Convergence>> {
        once(&self.convergence, || convergence(&self.registry))
    }

    /// Random scenes, solved as planned and by every other model; computed on the first call.
    ///
    /// # Errors
    /// As [`Trial::new`].
    pub fn trial(&self) -> anyhow::Result<&Trial> {
        once(&self.trial, || Trial::new(self.effort))
    }

    /// P(heads) of every named space by every method; computed on the first call.
    ///
    /// # Errors
    /// As [`probabilities`].
    pub fn probabilities(&self) -> anyhow::Result<&Vec<Probability>> {
        once(&self.probabilities, probabilities)
    }

    /// The running shares of heads in Fig. 4's space; computed on the first call.
    ///
    /// # Errors
    /// As [`fig4`].
    pub fn fig4(&self) -> anyhow::Result<&Vec<RunningStep>> {
        once(&self.fig4, fig4)
    }

    /// The shared results that have been computed so far, for the reports.
    pub fn records(&self) -> Records<'_> {
        Records {
            atlas: self.atlas.get(),
            long_flights: self.long_flights.get(),
            sweep: self.sweep.get(),
            convergence: self.convergence.get(),
            planner: self.trial.get().map(Trial::summary),
            probabilities: self.probabilities.get(),
            fig4: self.fig4.get(),
        }
    }
}

/// The shared results of a run; `None` for those that no check needed.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Records<'a> {
    /// The atlas of failures.
    pub atlas: Option<&'a Atlas>,
    /// Error and drift by time of flight.
    pub long_flights: Option<&'a LongFlights>,
    /// Error and work by tolerance or step.
    pub sweep: Option<&'a Sweep>,
    /// Planner accuracy and cost.
    pub planner: Option<PlannerSummary>,
    /// Error by fixed step.
    pub convergence: Option<&'a Vec<Convergence>>,
    /// P(heads) of the named spaces.
    pub probabilities: Option<&'a Vec<Probability>>,
    /// The running shares of heads in Fig. 4's space.
    pub fig4: Option<&'a Vec<RunningStep>>,
}

/// Checks that no two solvers share a name, because their rows could not be told apart.
///
/// # Errors
/// If two solvers have the same name.
fn require_own_names(registry: &[SolverEntry]) -> anyhow::Result<()> {
    let mut names = BTreeSet::new();
    for entry in registry {
        ensure!(names.insert(entry.name()), "the registry has two solvers called '{}'", entry.name());
    }
    Ok(())
}

/// The content of `cell`, which is computed by `make` if the cell is empty.
fn once<T, E>(cell: &OnceLock<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if cell.get().is_none() {
        let _ = cell.set(make()?);
    }
    Ok(cell.get().expect("it was just set"))
}
