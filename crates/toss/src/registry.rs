//! The registry lists the solvers that can be chosen by name while the program runs. Tests, checks and the command line
//! go through this list, so that a new solver needs one line here and nothing else.

use std::fmt;
use std::sync::LazyLock;

use dynamics::error::find_named;
use dynamics::{Checked, InputError, Outcome, Settings, SolveError, Solver, SolverConfig, SolverEntry, Tilt, Toss};
use exact::{ExactSolver, certify};
use kinematics_euler::{EulerAnglesSolver, GammaSolver};
use kinematics_quat::QuaternionSolver;
use sampling::Sampler;

use crate::answer::Verdict;

/// The solvers of this workspace, one entry for each.
fn standard() -> Vec<SolverEntry> {
    vec![ExactSolver::entry(), GammaSolver::entry(), EulerAnglesSolver::entry(), QuaternionSolver::entry()]
}

/// A list of solvers with unique names.
///
/// ```
/// use toss::{Registry, Settings, Solver};
///
/// let quaternion = Registry::standard().named("quaternion")?.solver(&Settings::default())?;
/// assert_eq!(quaternion.name(), "quaternion");
/// # Ok::<(), toss::InputError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Registry {
    entries: Vec<SolverEntry>,
}

impl Registry {
    /// The solvers of this workspace.
    pub fn standard() -> &'static Self {
        static STANDARD: LazyLock<Registry> = LazyLock::new(|| Registry { entries: standard() });
        &STANDARD
    }

    /// A registry without solvers, to which yours can be added by [`Registry::with`].
    pub fn empty() -> Self {
        Self::default()
    }

    /// The registry with those of its solvers that are called so, in its own order.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] for a name that no solver has.
    pub fn only(&self, names: &[&str]) -> Result<Self, InputError> {
        names.iter().try_for_each(|name| self.named(name).map(|_| ()))?;
        let entries = self.entries.iter().filter(|entry| names.contains(&entry.name())).cloned().collect();
        Ok(Self { entries })
    }

    /// A registry with the same solvers and one more.
    ///
    /// # Errors
    /// [`InputError::Malformed`] if a solver of the registry already has this name, or if it is `exact`: outcomes by
    /// that name are proven, and only the library's own solver can prove them.
    pub fn with(&self, entry: SolverEntry) -> Result<Self, InputError> {
        let refused =
            |expected| Err(InputError::Malformed { field: "solver", value: entry.name().to_owned(), expected });
        if self.entries.iter().any(|other| other.name() == entry.name()) {
            return refused("a name that no other solver of the registry has");
        }
        if entry.name() == ExactSolver::NAME {
            return refused("a name other than that of the exact motion, whose outcomes are proven");
        }
        Ok(Self { entries: self.entries.iter().cloned().chain([entry]).collect() })
    }

    /// All solvers, in the order in which they were added.
    pub fn entries(&self) -> &[SolverEntry] {
        &self.entries
    }

    /// The solver called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] with the list of known names.
    pub fn named(&self, name: &str) -> Result<&SolverEntry, InputError> {
        find_named("solver", name, &self.entries, |entry| entry.name())
    }

    /// The solver called `name` with `settings`. Only the backend of the exact motion proves its outcomes.
    ///
    /// # Errors
    /// As for [`Registry::named`] and [`SolverEntry::solver`].
    pub fn backend(&self, name: &str, settings: &Settings) -> Result<Backend, InputError> {
        let solver = self.named(name)?.solver(settings)?;
        Ok(if name == ExactSolver::NAME { Backend::Exact(Checked::new(ExactSolver)) } else { Backend::Solver(solver) })
    }

    /// The solver that `config` chooses, with its settings. A program reads the configuration from a file, as the
    /// [crate's front page](crate#choose-a-solver) shows.
    ///
    /// # Errors
    /// [`InputError`] for an unknown name, and for a setting that the solver does not take.
    pub fn configured(&self, config: &SolverConfig) -> Result<Backend, InputError> {
        self.backend(config.name(), &config.settings(&self.entries)?)
    }
}

/// Writes the name of the solver.
impl fmt::Debug for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Backend").field(&self.solver().name()).finish()
    }
}

/// A solver that was chosen by name: the exact motion, which proves outcomes, or another solver, which estimates them.
pub enum Backend {
    /// The exact motion.
    Exact(Checked<ExactSolver>),
    /// Another solver.
    Solver(Box<dyn Solver>),
}

impl Backend {
    /// The solver.
    pub fn solver(&self) -> &dyn Solver {
        match self {
            Self::Exact(exact) => exact,
            Self::Solver(solver) => solver,
        }
    }

    /// How the toss lands. The exact motion proves it; another solver decides by its own `tilt`, cos θ at landing with its
    /// error estimate.
    ///
    /// # Errors
    /// As for [`certify`].
    pub fn verdict(&self, toss: &Toss, tilt: Tilt) -> Result<Verdict, SolveError> {
        match self {
            Self::Exact(_) => certify(toss).map(Verdict::Proven),
            Self::Solver(_) => Ok(Verdict::Estimated(tilt.outcome())),
        }
    }

    /// cos θ at landing with its error estimate, and the verdict.
    ///
    /// # Errors
    /// As for [`Solver::tilt`] and [`Self::verdict`].
    pub fn landed(&self, toss: &Toss) -> Result<(Tilt, Verdict), SolveError> {
        let tilt = self.solver().tilt(toss)?;
        Ok((tilt, self.verdict(toss, tilt)?))
    }

    /// The outcome without its proof or estimate.
    ///
    /// # Errors
    /// As for [`Solver::tilt`].
    pub fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.solver().tilt(toss).map(Tilt::outcome)
    }

    /// A sampler that solves its launches by this backend.
    pub fn sampler(&self) -> Sampler<'_> {
        match self {
            Self::Exact(_) => Sampler::exact(),
            Self::Solver(solver) => Sampler::by(solver.as_ref()),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn solver_names_are_unique() {
        let registry = Registry::standard();
        let names: BTreeSet<&str> = registry.entries().iter().map(SolverEntry::name).collect();
        assert_eq!(names.len(), registry.entries().len());
        assert_eq!(registry.named("magic").unwrap_err().field(), "solver");
    }

    #[test]
    fn a_registry_may_be_a_part_of_ours_and_nobody_elses_solver_is_called_exact() {
        let part = Registry::standard().only(&["quaternion", "gamma"]).unwrap();
        assert_eq!(part.entries().iter().map(SolverEntry::name).collect::<Vec<_>>(), ["gamma", "quaternion"]);
        assert_eq!(Registry::standard().only(&["magic"]).unwrap_err().field(), "solver");
        let impostor = |name: &'static str| SolverEntry::new(name, "", |_| Box::new(ExactSolver));
        // Without this refusal its outcomes would be those of the exact motion, and be called proven.
        let error = Registry::empty().with(impostor("exact")).unwrap_err();
        assert!(error.to_string().starts_with("solver = 'exact'"), "{error}");
        assert_eq!(Registry::empty().with(impostor("mine")).unwrap().entries().len(), 1);
    }
}
