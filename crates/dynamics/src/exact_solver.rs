//! The exact motion as a solver, beside the numerical ones.

use crate::error::SolveError;
use crate::exact::{ExactMotion, resolution};
use crate::launch::Toss;
use crate::solver::{Outcome, Propagation, Settings, Solver, SolverEntry, Work};

/// The solver by [`ExactMotion`]; it makes no steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactSolver;

impl ExactSolver {
    /// The registry's line.
    pub const ENTRY: SolverEntry = SolverEntry {
        name: "exact",
        summary: "closed form of the motion: precession about S, spin about n",
        integrates: false,
        build: |_: &Settings| Box::new(Self),
    };
}

impl Solver for ExactSolver {
    fn name(&self) -> &'static str {
        Self::ENTRY.name
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        let state = ExactMotion::new(toss).state(toss.launch.flight_time())?;
        Ok(Propagation { state, defect: 0.0, work: Work::default() })
    }

    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        ExactMotion::new(toss).cos_tilt(toss.launch.flight_time())
    }

    fn resolution(&self, phase: f64) -> f64 {
        resolution(phase)
    }

    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        let (motion, time) = (ExactMotion::new(toss), toss.launch.flight_time());
        Ok(Outcome::of(motion.cos_tilt(time)?, resolution(motion.phase(time)?)))
    }
}
