//! What is verified: each solver of the registry with each method that it offers.

use toss::{Formulation, InputError, Method, Scheme, Settings, Solver, SolverEntry, StepControl};

/// Tolerance of the adaptive methods under verification.
const TIGHT_TOLERANCE: f64 = 1e-12;

/// Step of RK4 under verification (s).
const TIGHT_STEP: f64 = 1e-4;

/// A solver with its settings.
pub struct Subject {
    /// `solver`, `solver/method` or, if not by default, `solver/method/formulation`; the key of its bounds.
    pub name: String,
    /// Its line of the registry.
    pub entry: SolverEntry,
    /// Its method, if it integrates.
    pub method: Option<Method>,
    /// How its kinematics are set up.
    pub formulation: Formulation,
    /// The solver.
    pub solver: Box<dyn Solver>,
}

impl Subject {
    /// `entry` with `method`, which a closed form has none of, in `formulation`.
    pub fn new(entry: SolverEntry, method: Option<Method>, formulation: Formulation) -> Self {
        let scheme = method.map(|method| format!("/{}", method.scheme().name())).unwrap_or_default();
        let suffix =
            if formulation == Formulation::default() { String::new() } else { format!("/{}", formulation.name()) };
        let settings = Settings { method: method.unwrap_or(Method::DEFAULT), formulation };
        Self {
            name: format!("{}{scheme}{suffix}", entry.name),
            solver: (entry.build)(&settings),
            entry,
            method,
            formulation,
        }
    }

    /// Its scheme, if it integrates.
    pub fn scheme(&self) -> Option<Scheme> {
        self.method.map(|method| method.scheme())
    }

    /// The options of the command line that make the same solver.
    pub fn options(&self) -> String {
        let Some(method) = self.method else { return format!("--solver {}", self.entry.name) };
        let control = match method.control() {
            StepControl::Tolerance(tolerance) => format!("--tolerance {tolerance:?}"),
            StepControl::Step(step) => format!("--step {step:?}"),
        };
        let formulation = match self.formulation {
            Formulation::Momentum => String::new(),
            other => format!(" --formulation {}", other.name()),
        };
        format!("--solver {} --method {} {control}{formulation}", self.entry.name, method.scheme().name())
    }
}

/// `scheme` with the tight settings.
///
/// # Errors
/// Never for a scheme of the library.
pub fn tight(scheme: Scheme) -> Result<Method, InputError> {
    if scheme.is_adaptive() { Method::adaptive(scheme, TIGHT_TOLERANCE) } else { Method::fixed(scheme, TIGHT_STEP) }
}

/// `scheme` with the settings that a user gets without asking.
///
/// # Errors
/// Never for a scheme of the library.
pub fn usual(scheme: Scheme) -> Result<Method, InputError> {
    if scheme.is_adaptive() {
        Method::adaptive(scheme, Method::DEFAULT_TOLERANCE)
    } else {
        Method::fixed(scheme, Method::DEFAULT_STEP)
    }
}

/// Every solver of `registry`, each integrator by every scheme with its `method`.
///
/// # Errors
/// As `method`'s.
pub fn subjects(
    registry: &[SolverEntry],
    method: fn(Scheme) -> Result<Method, InputError>,
) -> Result<Vec<Subject>, InputError> {
    let of_entry = |entry: &SolverEntry| by_every_scheme(*entry, Formulation::default(), method);
    registry.iter().map(of_entry).collect::<Result<Vec<_>, _>>().map(|all| all.into_iter().flatten().collect())
}

/// `entry` by every scheme in `formulation`, or once if it is a closed form.
///
/// # Errors
/// As `method`'s.
pub fn by_every_scheme(
    entry: SolverEntry,
    formulation: Formulation,
    method: fn(Scheme) -> Result<Method, InputError>,
) -> Result<Vec<Subject>, InputError> {
    if !entry.integrates() {
        return Ok(vec![Subject::new(entry, None, formulation)]);
    }
    let subject = |scheme: &Scheme| Ok(Subject::new(entry, Some(method(*scheme)?), formulation));
    entry.schemes.iter().map(subject).collect()
}
