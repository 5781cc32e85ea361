//! The registry: every solver that can be named.

use dynamics::error::find_named;
use dynamics::{ExactSolver, InputError, SolverEntry};
use kinematics_euler::{EulerAnglesSolver, GammaSolver};
use kinematics_quat::QuaternionSolver;

/// All solvers, a line each. Tests and checks iterate this slice.
pub const SOLVERS: &[SolverEntry] =
    &[ExactSolver::ENTRY, GammaSolver::ENTRY, EulerAnglesSolver::ENTRY, QuaternionSolver::ENTRY];

/// The solver called `name`.
///
/// # Errors
/// [`InputError::UnknownName`] with the list of known names.
pub fn named_solver(name: &str) -> Result<&'static SolverEntry, InputError> {
    find_named("solver", name, SOLVERS, |entry| entry.name)
}
