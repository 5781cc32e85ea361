//! This file makes the exact motion a [`Solver`], so that it can be named, compared and used like the integrators. It
//! takes no steps, and its outcomes are proven.

use dynamics::{Outcome, Propagation, Settings, SolveError, Solver, SolverEntry, Toss, Work};

use crate::certified::{certify, cos_tilt};
use crate::motion::{COS_TILT_ERROR, ExactMotion};

/// The solver that evaluates [`ExactMotion`]. It takes no steps, and its outcomes are those of [`certify`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactSolver;

impl ExactSolver {
    /// Name of the solver in the registry.
    pub const NAME: &'static str = "exact";

    /// Entry of the solver in the registry.
    pub fn entry() -> SolverEntry {
        let summary = "closed form of the motion: precession about S, spin about n";
        SolverEntry::new(Self::NAME, summary, |_: &Settings| Box::new(Self)).with_color([0, 0, 0])
    }
}

impl Solver for ExactSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        let (motion, time) = (ExactMotion::new(toss), toss.launch.time_of_flight());
        Ok(Propagation::new(motion.state(time)?, Work::default()).with_cos_tilt(cos_tilt(toss)?))
    }

    fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
        Ok(Some(COS_TILT_ERROR))
    }

    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        cos_tilt(toss)
    }

    fn outcome_at(&self, toss: &Toss, _: f64) -> Result<Outcome, SolveError> {
        self.outcome(toss)
    }

    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        Ok(certify(toss)?.outcome())
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Vector3};

    use super::*;

    #[test]
    fn outcomes_are_proven_and_ignore_the_given_cos_theta() {
        let launch = Launch::new(Vector3::new(20.0, 3.0, 1.0), TimeOfFlight::Given(0.6)).unwrap();
        let toss = Toss { coin: Coin::PAPER, launch };
        assert_eq!(ExactSolver.outcome(&toss), Ok(Outcome::Heads));
        assert_eq!(ExactSolver.outcome_at(&toss, -1.0), Ok(Outcome::Heads));
        assert_eq!((ExactSolver.error_estimate(&toss), ExactSolver.name()), (Ok(Some(COS_TILT_ERROR)), "exact"));
        let landing = ExactSolver.propagate(&toss).unwrap();
        assert_eq!(Ok(landing.cos_tilt), ExactSolver.cos_tilt(&toss));
        assert!((landing.state.attitude.cos_tilt() - landing.cos_tilt).abs() < 1e-15);
    }
}
