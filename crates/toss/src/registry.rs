//! The registry lists the solvers that can be chosen by name while the program runs. Tests, checks and the command line
//! go through this list, so that a new solver needs one line here and nothing else.

use std::sync::LazyLock;

use dynamics::error::find_named;
use dynamics::{Checked, InputError, Outcome, Settings, SolveError, Solver, SolverEntry, Toss};
use exact::{ExactSolver, certify};
use kinematics_euler::{EulerAnglesSolver, GammaSolver};
use kinematics_quat::QuaternionSolver;
use sampling::Sampler;

use crate::answer::Verdict;

/// The solvers of this workspace, one line for each.
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
#[derive(Debug, Clone)]
pub struct Registry {
    entries: Vec<SolverEntry>,
}

impl Registry {
    /// The solvers of this workspace.
    pub fn standard() -> &'static Self {
        static STANDARD: LazyLock<Registry> = LazyLock::new(|| Registry { entries: standard() });
        &STANDARD
    }

    /// A registry with the same solvers and one more.
    ///
    /// # Errors
    /// [`InputError::Malformed`] if a solver of the registry already has this name.
    pub fn with(&self, entry: SolverEntry) -> Result<Self, InputError> {
        if self.entries.iter().any(|other| other.name() == entry.name()) {
            let expected = "a name that no other solver of the registry has";
            return Err(InputError::Malformed { field: "solver", value: entry.name().to_owned(), expected });
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

    /// How the toss lands. The exact motion proves it; another solver decides by its own `cos_tilt` (cos θ at landing)
    /// and its error estimate.
    ///
    /// # Errors
    /// As for [`Solver::outcome_at`].
    pub fn verdict(&self, toss: &Toss, cos_tilt: f64) -> Result<Verdict, SolveError> {
        match self {
            Self::Exact(_) => certify(toss).map(Verdict::Proven),
            Self::Solver(solver) => solver.outcome_at(toss, cos_tilt).map(Verdict::Estimated),
        }
    }

    /// The outcome without its proof or estimate.
    ///
    /// # Errors
    /// As for [`Solver::outcome`].
    pub fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.solver().outcome(toss)
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
        let impostor = SolverEntry::new("exact", "not what it says", |_| Box::new(ExactSolver));
        let error = registry.with(impostor).unwrap_err();
        assert!(error.to_string().starts_with("solver = 'exact'"), "{error}");
        assert_eq!(registry.named("magic").unwrap_err().field(), "solver");
    }
}
