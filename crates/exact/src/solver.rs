//! This file makes the exact motion a [`Solver`], so that it can be named, compared and used like the integrators. It
//! takes no steps, and its outcomes are proven.

use dynamics::{Outcome, Propagation, RigidToss, Settings, SolveError, Solver, SolverEntry, Toss, Work};

use crate::certified::{certify, cos_tilt};
use crate::motion::{COS_TILT_ERROR, ExactMotion};
use crate::rigid::{RigidMotion, certify_rigid};

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

    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        if let Some(toss) = toss.symmetric() {
            return self.propagate(&toss);
        }
        let (motion, time) = (RigidMotion::new(toss), toss.launch.time_of_flight());
        Ok(Propagation::new(motion.state(time)?, Work::default()).with_cos_tilt(motion.cos_tilt(time)?))
    }

    fn error_estimate_rigid(&self, _: &RigidToss) -> Result<Option<f64>, SolveError> {
        Ok(Some(COS_TILT_ERROR))
    }

    fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
        match toss.symmetric() {
            Some(toss) => cos_tilt(&toss),
            None => RigidMotion::new(toss).cos_tilt(toss.launch.time_of_flight()),
        }
    }

    fn outcome_at_rigid(&self, toss: &RigidToss, _: f64) -> Result<Outcome, SolveError> {
        self.outcome_rigid(toss)
    }

    fn outcome_rigid(&self, toss: &RigidToss) -> Result<Outcome, SolveError> {
        Ok(certify_rigid(toss)?.outcome())
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, Coin, Launch, TimeOfFlight, Vector3};

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

    #[test]
    fn a_body_of_three_moments_has_proven_outcomes_and_a_coin_keeps_its_bits() {
        let launch = Launch::new(Vector3::new(20.0, 3.0, 1.0), TimeOfFlight::Given(0.6)).unwrap();
        let coin = Toss { coin: Coin::PAPER, launch };
        assert_eq!(ExactSolver.propagate_rigid(&coin.into()), ExactSolver.propagate(&coin));
        assert_eq!(ExactSolver.cos_tilt_rigid(&coin.into()), ExactSolver.cos_tilt(&coin));
        let brick = RigidToss { body: Body::from_moments([1.0, 1.5, 2.0]).unwrap(), launch };
        let landing = ExactSolver.propagate_rigid(&brick).unwrap();
        assert_eq!(ExactSolver.cos_tilt_rigid(&brick), Ok(landing.cos_tilt));
        assert!((landing.cos_tilt - landing.state.attitude.cos_tilt()).abs() < 4.0 * f64::EPSILON);
        let outcome = certify_rigid(&brick).unwrap().outcome();
        assert_eq!(ExactSolver.outcome_at_rigid(&brick, -landing.cos_tilt), Ok(outcome));
        assert_eq!(outcome, Outcome::of(landing.cos_tilt, COS_TILT_ERROR));
    }
}
