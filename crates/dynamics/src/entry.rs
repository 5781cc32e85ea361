//! [`SolverEntry`], the entry of a registry: a solver's name, summary, colour, schemes and formulations, and the
//! function that makes it. Programs find everything about a solver here, so that a new solver needs no change
//! elsewhere.

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

/// The settings with which an entry makes its solver at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How the solver steps; a closed form ignores it.
    pub stepping: Stepping,
    /// How the solver's kinematics are set up; a solver without a choice ignores it.
    pub formulation: Formulation,
}

impl Default for Settings {
    fn default() -> Self {
        Self { stepping: Stepping::DEFAULT, formulation: Formulation::default() }
    }
}

/// A function that makes a solver. It may capture a configuration of its own.
type Build = dyn Fn(&Settings) -> Box<dyn Solver> + Send + Sync;

/// A solver by name, with what programs have to know of it: a summary, its colour on charts, the schemes and
/// formulations that it offers, and how it is made.
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
    /// An entry called `name` for the solver that `build` makes. `summary` says in one line what the solver solves.
    /// Without [schemes](Self::with_schemes) the solver counts as a closed form.
    pub fn new(
        name: impl Into<Cow<'static, str>>,
        summary: impl Into<Cow<'static, str>>,
        build: impl Fn(&Settings) -> Box<dyn Solver> + Send + Sync + 'static,
    ) -> Self {
        let (name, summary, build) = (name.into(), summary.into(), Arc::new(build));
        Self { name, summary, color: None, formulations: Vec::new(), schemes: Vec::new(), build }
    }

    /// The same entry, for a solver that can integrate by each of `schemes`.
    #[must_use]
    pub fn with_schemes(self, schemes: &[Scheme]) -> Self {
        Self { schemes: schemes.to_vec(), ..self }
    }

    /// The same entry, for a solver whose results differ among these formulations.
    #[must_use]
    pub fn with_formulations(self, formulations: &[Formulation]) -> Self {
        Self { formulations: formulations.to_vec(), ..self }
    }

    /// The same entry, for a solver drawn in this colour (red, green, blue) on charts.
    #[must_use]
    pub fn with_color(self, color: [u8; 3]) -> Self {
        Self { color: Some(color), ..self }
    }

    /// The solver's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What the solver solves, in one line.
    pub fn summary(&self) -> &str {
        &self.summary
    }

    /// The solver's colour on charts (red, green, blue); `None` leaves it to the chart.
    pub fn color(&self) -> Option<[u8; 3]> {
        self.color
    }

    /// The formulations among which the solver's results differ; none for a closed form.
    pub fn formulations(&self) -> &[Formulation] {
        &self.formulations
    }

    /// The schemes by which the solver can integrate; none for a closed form.
    pub fn schemes(&self) -> &[Scheme] {
        &self.schemes
    }

    /// Whether the solver is an integrator, that is, has schemes.
    pub fn integrates(&self) -> bool {
        !self.schemes.is_empty()
    }

    /// The scheme called `name` among those of the solver.
    pub fn scheme(&self, name: &str) -> Result<Scheme, InputError> {
        find_named("scheme of this solver", name, &self.schemes, |offered| offered.name()).copied()
    }

    /// The scheme that the solver integrates by if none is chosen: that of [`Stepping::DEFAULT`] if the solver offers it,
    /// else its first one. `None` for a closed form.
    pub fn default_scheme(&self) -> Option<Scheme> {
        let default = self.schemes.iter().find(|scheme| **scheme == Stepping::DEFAULT.scheme());
        default.or(self.schemes.first()).copied()
    }

    /// Makes the solver with `settings` and wraps it in [`Checked`]. A closed form accepts any stepping and ignores it.
    /// Fails for a scheme that the solver does not offer, if making the solver panics, and if its name is not that of
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
        Err(refused("a solver with the name of its entry, but its own name is different"))
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
    use crate::solver::{Landing, Work};
    use crate::state::State;
    use crate::toss::Toss;

    /// A solver with this name and stepping, whose coins land as they were launched.
    struct Still(&'static str, Stepping);

    impl Solver for Still {
        fn name(&self) -> &str {
            self.0
        }
        fn stepping(&self) -> Option<Stepping> {
            Some(self.1)
        }
        fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
            Ok(Landing::new(State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }, Work::default()))
        }
    }

    #[test]
    fn makes_a_solver_by_an_offered_scheme_and_refuses_other_schemes() {
        let entry = SolverEntry::new("still", "", |settings| Box::new(Still("still", settings.stepping)));
        assert!(!entry.integrates());
        assert_eq!((entry.color(), entry.clone().with_color([1, 2, 3]).color()), (None, Some([1, 2, 3])));
        let entry = entry.with_schemes(&Scheme::RUNGE_KUTTA).with_formulations(&Formulation::ALL);
        assert!(entry.integrates());
        assert_eq!(entry.solver(&Settings::default()).unwrap().stepping(), Some(Stepping::DEFAULT));
        let own = Scheme::new("own", None).adaptive();
        let by_own = Settings { stepping: Stepping::adaptive(own, 1e-9).unwrap(), ..Settings::default() };
        assert_eq!(entry.solver(&by_own).err().map(|error| error.field()), Some("scheme of this solver"));
    }

    #[test]
    fn a_solver_without_the_default_scheme_uses_its_first_scheme() {
        let offers = |schemes: &[Scheme]| {
            let still = SolverEntry::new("still", "", |settings| Box::new(Still("still", settings.stepping)));
            still.with_schemes(schemes).default_scheme()
        };
        assert_eq!(offers(&[Scheme::RK4, Scheme::DOP853]), Some(Scheme::DOP853));
        assert_eq!(offers(&[Scheme::RK4, Scheme::DOPRI5]), Some(Scheme::RK4));
        assert_eq!(offers(&[]), None);
    }

    #[test]
    fn refuses_a_solver_with_another_name_or_one_whose_making_panics() {
        let called = |name| SolverEntry::new("still", "", move |settings| Box::new(Still(name, settings.stepping)));
        assert!(called("still").solver(&Settings::default()).is_ok());
        let error = called("exact").solver(&Settings::default()).err().unwrap();
        assert!(error.to_string().contains("solver = 'still'"), "{error}");
        let panics = SolverEntry::new("broken", "", |_| panic!("out of order"));
        assert!(panics.solver(&Settings::default()).err().unwrap().to_string().contains("making it panicked"));
    }
}
