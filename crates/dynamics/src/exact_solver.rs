//! The exact motion as a solver, beside the numerical ones: Q(T) = Q0 ⊗ exp(½ ωL T ŝ) ⊗ exp(-½ q T ẑ), see
//! [`exact`](crate::exact). Its outcomes are proven.

use crate::batch::{BatchError, Filtered, Tosses};
use crate::certified::{Certificate, certify};
use crate::error::SolveError;
use crate::exact::{COS_TILT_ERROR, ExactMotion};
use crate::launch::Toss;
use crate::outcome::Verdict;
use crate::solver::{Propagation, Settings, Solver, SolverEntry, Work};

/// The solver by [`ExactMotion`]; it makes no steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactSolver;

impl ExactSolver {
    /// The registry's line.
    pub const ENTRY: SolverEntry = SolverEntry {
        name: "exact",
        summary: "closed form of the motion: precession about S, spin about n",
        formulations: &[],
        schemes: &[],
        build: |_: &Settings| Box::new(Self),
    };
}

impl Solver for ExactSolver {
    fn name(&self) -> &'static str {
        Self::ENTRY.name
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        let (motion, time) = (ExactMotion::new(toss), toss.launch.time_of_flight());
        let (state, cos_tilt) = (motion.state(time)?, motion.cos_tilt(time)?);
        Ok(Propagation { state, cos_tilt, defect: 0.0, work: Work::default() })
    }

    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())
    }

    fn resolution(&self, _: &Toss) -> Result<f64, SolveError> {
        Ok(COS_TILT_ERROR)
    }

    fn verdict(&self, toss: &Toss) -> Result<Verdict, SolveError> {
        let Certificate { outcome, stage } = certify(toss)?;
        Ok(Verdict { outcome, proof: Some(stage) })
    }

    fn count(&self, tosses: &Tosses<'_>, rest: &mut dyn FnMut(Verdict)) -> Result<Filtered, BatchError> {
        tosses.count(|Certificate { outcome, stage }| rest(Verdict { outcome, proof: Some(stage) }))
    }

    fn verdict_at(&self, toss: &Toss, _: f64) -> Result<Verdict, SolveError> {
        self.verdict(toss)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::attitude::Attitude;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::outcome::{Outcome, Stage};
    use crate::time_of_flight::TimeOfFlight;

    #[test]
    fn its_outcomes_are_proven_whatever_cos_theta_it_is_told() {
        let launch = Launch::new(Vector3::new(20.0, 3.0, 1.0), TimeOfFlight::Given(0.6)).unwrap();
        let toss = Toss { coin: Coin::PAPER, launch };
        let proven = Verdict { outcome: Outcome::Heads, proof: Some(Stage::F64) };
        assert_eq!((ExactSolver.verdict(&toss), ExactSolver.verdict_at(&toss, -1.0)), (Ok(proven), Ok(proven)));
        assert_eq!((ExactSolver.resolution(&toss), ExactSolver.name()), (Ok(COS_TILT_ERROR), "exact"));
        let landing = ExactSolver.propagate(&toss).unwrap();
        assert_eq!(Ok(landing.cos_tilt), ExactSolver.cos_tilt(&toss));
        assert!((landing.state.attitude.cos_tilt() - landing.cos_tilt).abs() < 1e-15);
    }

    #[test]
    fn it_counts_a_batch() {
        let [x, y, z, speed] = [[20.0, 2.0], [3.0, 2.0], [1.0, 0.5], [3.0, 4.0]];
        let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
        let mut rest = 0;
        let filtered = ExactSolver.count(&tosses, &mut |verdict| rest += u64::from(verdict.proof.is_some())).unwrap();
        assert_eq!(filtered.heads + filtered.tails + rest, 2);
    }
}
