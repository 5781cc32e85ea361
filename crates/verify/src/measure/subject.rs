//! A subject is what the suite verifies: a solver of the registry with one of its schemes, its tolerance or step, and a
//! formulation. Its name is the key of its limits and of its baseline, so every combination is judged on its own.

use dynamics::{Phases, Toss};
use toss::{
    ExactSolver, Formulation, InputError, Landing, Launch, QuaternionSolver, Scheme, Settings, SolveError, Solver,
    SolverEntry, StepControl, Stepping,
};

/// Tolerance of the adaptive schemes under verification.
const TIGHT_TOLERANCE: f64 = 1e-12;

/// Step of the schemes without a tolerance under verification (s).
const TIGHT_STEP: f64 = 1e-4;

/// A solver with its settings.
pub struct Subject {
    /// `solver`, `solver/scheme` or, in a formulation that is not the default, `solver/scheme/formulation`; the key of
    /// its limits.
    pub name: String,
    /// Its entry in the registry.
    pub entry: SolverEntry,
    /// Its scheme and step control, if it is an integrator.
    pub stepping: Option<Stepping>,
    /// The formulation of its kinematics.
    pub formulation: Formulation,
    /// The solver.
    pub solver: Box<dyn Solver>,
}

impl Subject {
    /// The solver of `entry` with `stepping` (`None` for a closed form) in `formulation`. If the solver cannot be made,
    /// the subject fails on every toss, so it appears in the report instead of ending the run.
    pub fn new(entry: &SolverEntry, stepping: Option<Stepping>, formulation: Formulation) -> Self {
        let scheme = stepping.map(|stepping| format!("/{}", stepping.scheme().name())).unwrap_or_default();
        let suffix =
            if formulation == Formulation::default() { String::new() } else { format!("/{}", formulation.name()) };
        let settings = Settings { stepping: stepping.unwrap_or(Stepping::DEFAULT), formulation };
        let not_made = |reason| Box::new(NotMade { name: entry.name().to_owned(), reason }) as Box<dyn Solver>;
        Self {
            name: format!("{}{scheme}{suffix}", entry.name()),
            solver: entry.solver(&settings).unwrap_or_else(not_made),
            entry: entry.clone(),
            stepping,
            formulation,
        }
    }

    /// The solver of the exact motion.
    pub fn exact() -> Self {
        Self::new(&ExactSolver::entry(), None, Formulation::default())
    }

    /// Its scheme, if it is an integrator.
    pub fn scheme(&self) -> Option<Scheme> {
        self.stepping.map(|stepping| stepping.scheme())
    }

    /// Whether its settings promise an accurate landing of `toss`: a closed form, a tolerance of at most 1e-8 or steps
    /// of at most 0.02/|ω|, and a phase of at most 1000 rad.
    pub fn is_tight(&self, toss: &Toss) -> bool {
        self.is_fine(&toss.launch) && Phases::new(toss).is_ok_and(|phases| phases.largest <= 1e3)
    }

    fn is_fine(&self, launch: &Launch) -> bool {
        match self.stepping.map(|stepping| stepping.control()) {
            None => true,
            Some(StepControl::Tolerance(tolerance)) => tolerance <= 1e-8,
            Some(StepControl::Step(step)) => step * launch.turn_rate() <= 0.02,
        }
    }
}

/// Takes the place of a solver that cannot be made, and fails on every toss with the reason.
struct NotMade {
    name: String,
    reason: InputError,
}

impl Solver for NotMade {
    fn name(&self) -> &str {
        &self.name
    }
    /// It is judged by coins, which every solver has to solve.
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        toss.of_coin(&self.name, "it could not be made")?;
        Err(SolveError::failed(&self.name, self.reason.clone()))
    }
}

/// `scheme` with the tight tolerance or step of the verification.
pub fn tight(scheme: Scheme) -> Result<Stepping, InputError> {
    by_kind(scheme, TIGHT_TOLERANCE, TIGHT_STEP)
}

/// `scheme` with the library's default tolerance or step.
pub fn usual(scheme: Scheme) -> Result<Stepping, InputError> {
    by_kind(scheme, Stepping::DEFAULT_TOLERANCE, Stepping::DEFAULT_STEP)
}

/// `scheme` with the tolerance or, if it takes none, with steps of this length (s).
pub(super) fn by_kind(scheme: Scheme, tolerance: f64, step: f64) -> Result<Stepping, InputError> {
    if scheme.is_adaptive() { Stepping::adaptive(scheme, tolerance) } else { Stepping::fixed(scheme, step) }
}

/// The solver of `entry` with each of its schemes, or once without if it is a closed form.
pub(crate) fn by_scheme(entry: &SolverEntry) -> impl Iterator<Item = (&SolverEntry, Option<Scheme>)> {
    let schemes = if entry.integrates() { entry.schemes() } else { &[] };
    let closed_form = (!entry.integrates()).then_some(None);
    schemes.iter().copied().map(Some).chain(closed_form).map(move |scheme| (entry, scheme))
}

/// Every solver of `registry`, each integrator with every one of its schemes, set up by `stepping`.
pub fn subjects(
    registry: &[SolverEntry],
    stepping: fn(Scheme) -> Result<Stepping, InputError>,
) -> Result<Vec<Subject>, InputError> {
    let subject = |(entry, scheme): (&SolverEntry, Option<Scheme>)| {
        Ok(Subject::new(entry, scheme.map(stepping).transpose()?, Formulation::default()))
    };
    registry.iter().flat_map(by_scheme).map(subject).collect()
}

pub(crate) fn taylor(tolerance: f64) -> Result<QuaternionSolver, SolveError> {
    let stepping = Stepping::adaptive(Scheme::TAYLOR, tolerance);
    let stepping = stepping.map_err(|error| SolveError::failed(QuaternionSolver::NAME, error))?;
    Ok(QuaternionSolver::new(stepping, Formulation::default()))
}
