//! One entry of a registry: all that is said about a solver, and how it is made at run time.

use std::borrow::Cow;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use crate::checked::Checked;
use crate::error::{InputError, find_named};
use crate::formulation::Formulation;
use crate::scheme::Scheme;
use crate::solver::Solver;
use crate::stepping::Stepping;

/// Settings that a solver is made with at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How it steps, if it integrates.
    pub stepping: Stepping,
    /// How its kinematics are set up.
    pub formulation: Formulation,
}

impl Default for Settings {
    fn default() -> Self {
        Self { stepping: Stepping::DEFAULT, formulation: Formulation::default() }
    }
}

/// Makes a solver; may capture a configuration of its own.
type Build = dyn Fn(&Settings) -> Box<dyn Solver> + Send + Sync;

/// A solver by name: what it solves, what it offers, how it is drawn, how it is made.
#[derive(Clone)]
pub struct SolverEntry {
    name: Cow<'static, str>,
    summary: Cow<'static, str>,
    color: Option<[u8; 3]>,
    formulations: Vec<Formulation>,
    schemes: Vec<Scheme>,
    build: Arc<Build>,
}

impl SolverEntry {
    /// The solver that `build` makes, which is called `name` and takes no steps; `summary` says in a line what it solves.
    pub fn new(
        name: impl Into<Cow<'static, str>>,
        summary: impl Into<Cow<'static, str>>,
        build: impl Fn(&Settings) -> Box<dyn Solver> + Send + Sync + 'static,
    ) -> Self {
        let (name, summary, build) = (name.into(), summary.into(), Arc::new(build));
        Self { name, summary, color: None, formulations: Vec::new(), schemes: Vec::new(), build }
    }

    /// The same solver, which integrates by any of `schemes`.
    #[must_use]
    pub fn with_schemes(self, schemes: &[Scheme]) -> Self {
        Self { schemes: schemes.to_vec(), ..self }
    }

    /// The same solver, for which these formulations differ.
    #[must_use]
    pub fn with_formulations(self, formulations: &[Formulation]) -> Self {
        Self { formulations: formulations.to_vec(), ..self }
    }

    /// The same solver, drawn in this colour (red, green, blue).
    #[must_use]
    pub fn with_color(self, color: [u8; 3]) -> Self {
        Self { color: Some(color), ..self }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it solves, in a line.
    pub fn summary(&self) -> &str {
        &self.summary
    }

    /// Its colour on charts; grey where it has none of its own.
    pub fn color(&self) -> [u8; 3] {
        self.color.unwrap_or([110, 110, 110])
    }

    /// The formulations that differ for it; none for a closed form.
    pub fn formulations(&self) -> &[Formulation] {
        &self.formulations
    }

    /// The schemes that it can step by; none for a closed form.
    pub fn schemes(&self) -> &[Scheme] {
        &self.schemes
    }

    /// Whether it steps through time.
    pub fn integrates(&self) -> bool {
        !self.schemes.is_empty()
    }

    /// The scheme called `name` among those that it offers.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] with the names of those that it offers.
    pub fn scheme(&self, name: &str) -> Result<Scheme, InputError> {
        find_named("scheme of this solver", name, &self.schemes, |offered| offered.name()).copied()
    }

    /// The solver with `settings`, [checked](Checked). A closed form has no use for a stepping, and takes any.
    ///
    /// # Errors
    /// [`InputError`] for a scheme that it does not offer, and for a solver that cannot be made or has another name than
    /// its entry.
    pub fn solver(&self, settings: &Settings) -> Result<Box<dyn Solver>, InputError> {
        if self.integrates() {
            self.scheme(settings.stepping.scheme().name())?;
        }
        let refused = |expected| InputError::Malformed { field: "solver", value: self.name.to_string(), expected };
        let solver = catch_unwind(AssertUnwindSafe(|| (self.build)(settings)))
            .map_err(|_| refused("a solver that can be made with these settings, but making it panicked"))?;
        let solver = Checked::new(solver);
        if solver.name() == self.name {
            return Ok(Box::new(solver));
        }
        Err(refused("a solver with the name of its entry, but it calls itself otherwise"))
    }
}

impl fmt::Debug for SolverEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SolverEntry").field("name", &self.name).field("schemes", &self.schemes).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::SolveError;
    use crate::launch::Toss;
    use crate::solver::{Propagation, Work};
    use crate::state::State;

    /// Stands still, and is called whatever it is told.
    struct Still(&'static str, Stepping);

    impl Solver for Still {
        fn name(&self) -> &str {
            self.0
        }
        fn stepping(&self) -> Option<Stepping> {
            Some(self.1)
        }
        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            Ok(Propagation::new(State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }, Work::default()))
        }
        fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
            Ok(None)
        }
    }

    #[test]
    fn an_entry_makes_the_solvers_that_it_offers() {
        let entry = SolverEntry::new("still", "", |settings| Box::new(Still("still", settings.stepping)));
        assert!(!entry.integrates());
        let entry = entry.with_schemes(&Scheme::RUNGE_KUTTA).with_formulations(&Formulation::ALL);
        assert!(entry.integrates());
        assert_eq!(entry.solver(&Settings::default()).unwrap().stepping(), Some(Stepping::DEFAULT));
        let own = Scheme::new("own", None).adaptive();
        let by_own = Settings { stepping: Stepping::adaptive(own, 1e-9).unwrap(), ..Settings::default() };
        assert_eq!(entry.solver(&by_own).err().map(|error| error.field()), Some("scheme of this solver"));
    }

    #[test]
    fn a_captured_name_has_to_be_that_of_the_entry_and_a_panic_is_an_error() {
        let called = |name| SolverEntry::new("still", "", move |settings| Box::new(Still(name, settings.stepping)));
        assert!(called("still").solver(&Settings::default()).is_ok());
        let error = called("exact").solver(&Settings::default()).err().unwrap();
        assert!(error.to_string().contains("solver = 'still'"), "{error}");
        let panics = SolverEntry::new("broken", "", |_| panic!("out of order"));
        assert!(panics.solver(&Settings::default()).err().unwrap().to_string().contains("making it panicked"));
    }
}
