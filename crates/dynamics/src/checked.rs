//! [`Checked`], a wrapper that checks what a solver returns. Anyone can implement [`Solver`], so a panic, a NaN or an
//! impossible number must become an error that names the solver, before it reaches counts or a report.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::columns::Tosses;
use crate::error::{Fault, SolveError};
use crate::failure::Error;
use crate::launch::Toss;
use crate::outcome::Outcome;
use crate::rigid_toss::RigidToss;
use crate::solver::{Propagation, Solver};
use crate::stepping::Stepping;

/// A solver whose panics, and whose results that are NaN, infinite or impossible, are returned as
/// [`SolveError::Misbehaved`] with the solver's name. All code that accepts a solver from outside wraps it in this
/// type.
#[derive(Debug, Clone)]
pub struct Checked<S> {
    solver: S,
    name: String,
}

/// Largest |cos θ| that is accepted. It is above 1 because the cos θ of an integrated quaternion that is not projected
/// onto unit norm may exceed 1.
const LARGEST_COSINE: f64 = 2.0;

impl<S: Solver> Checked<S> {
    /// Wraps `solver`. Its name is read once, here.
    pub fn new(solver: S) -> Self {
        let name = catch_unwind(AssertUnwindSafe(|| solver.name().to_owned()));
        Self { name: name.unwrap_or_else(|_| "a solver whose name panics".to_owned()), solver }
    }

    /// The result of `ask`, or the error of a solver that panicked in it.
    fn guarded<T, E: From<SolveError>>(&self, ask: impl FnOnce(&S) -> Result<T, E>) -> Result<T, E> {
        catch_unwind(AssertUnwindSafe(|| ask(&self.solver))).unwrap_or_else(|payload| {
            let text = payload.downcast_ref::<String>().cloned();
            let text = text.or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            Err(self.misbehaved(Fault::Panic(text.unwrap_or_else(|| "without a message".to_owned()))).into())
        })
    }

    fn misbehaved(&self, fault: Fault) -> SolveError {
        SolveError::Misbehaved { solver: self.name.clone(), fault }
    }

    /// Returns `value` if `holds` is true, else the error that names the solver and the field.
    fn require(&self, field: &'static str, value: f64, holds: bool) -> Result<f64, SolveError> {
        if holds { Ok(value) } else { Err(self.misbehaved(Fault::Answer { field, value })) }
    }

    fn require_cosine(&self, cos_tilt: f64) -> Result<f64, SolveError> {
        self.require("cos θ", cos_tilt, cos_tilt.abs() <= LARGEST_COSINE)
    }

    fn checked_landing(&self, landing: Propagation) -> Result<Propagation, SolveError> {
        self.require_cosine(landing.cos_tilt)?;
        for part in landing.state.attitude.components() {
            self.require("a component of the attitude", part, part.is_finite())?;
        }
        for part in landing.state.rate.iter() {
            self.require("a component of the body rate", *part, part.is_finite())?;
        }
        self.require("the norm error", landing.norm_error, landing.norm_error.is_finite())?;
        Ok(landing)
    }

    fn checked_claim(&self, claim: Option<f64>) -> Result<Option<f64>, SolveError> {
        match claim {
            Some(error) if !(error.is_finite() && error >= 0.0) => Err(self.misbehaved(Fault::Claim(error))),
            estimate => Ok(estimate),
        }
    }
}

impl<S: Solver> Solver for Checked<S> {
    fn name(&self) -> &str {
        &self.name
    }

    fn stepping(&self) -> Option<Stepping> {
        catch_unwind(AssertUnwindSafe(|| self.solver.stepping())).ok().flatten()
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        self.checked_landing(self.guarded(|solver| solver.propagate(toss))?)
    }

    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        self.checked_claim(self.guarded(|solver| solver.error_estimate(toss))?)
    }

    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.require_cosine(self.guarded(|solver| solver.cos_tilt(toss))?)
    }

    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        // A result that the solver does not write stays NaN, and is refused below.
        out.fill(f64::NAN);
        self.guarded(|solver| solver.cos_tilts(tosses, out))?;
        out.iter().enumerate().try_for_each(|(index, cos_tilt)| {
            if cos_tilt.abs() <= LARGEST_COSINE {
                return Ok(());
            }
            tosses.solve(index, |_| self.require_cosine(*cos_tilt).map(|_| ()))
        })
    }

    fn outcome_at(&self, toss: &Toss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        self.require_cosine(cos_tilt)?;
        self.error_estimate(toss)?;
        self.guarded(|solver| solver.outcome_at(toss, cos_tilt))
    }

    /// The outcome is decided from the checked cos θ, not by the solver's own `outcome`.
    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.outcome_at(toss, self.cos_tilt(toss)?)
    }

    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        self.checked_landing(self.guarded(|solver| solver.propagate_rigid(toss))?)
    }

    fn error_estimate_rigid(&self, toss: &RigidToss) -> Result<Option<f64>, SolveError> {
        self.checked_claim(self.guarded(|solver| solver.error_estimate_rigid(toss))?)
    }

    fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
        self.require_cosine(self.guarded(|solver| solver.cos_tilt_rigid(toss))?)
    }

    fn cos_tilts_rigid(&self, tosses: &[RigidToss], out: &mut [f64]) -> Result<(), Error> {
        out.fill(f64::NAN);
        self.guarded(|solver| solver.cos_tilts_rigid(tosses, out))?;
        tosses.iter().zip(out).enumerate().try_for_each(|(index, (toss, cos_tilt))| {
            self.require_cosine(*cos_tilt).map(drop).map_err(|source| Error::of_launch(index, toss, source))
        })
    }

    fn outcome_at_rigid(&self, toss: &RigidToss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        self.require_cosine(cos_tilt)?;
        self.error_estimate_rigid(toss)?;
        self.guarded(|solver| solver.outcome_at_rigid(toss, cos_tilt))
    }

    fn outcome_rigid(&self, toss: &RigidToss) -> Result<Outcome, SolveError> {
        self.outcome_at_rigid(toss, self.cos_tilt_rigid(toss)?)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::attitude::Attitude;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::solver::Work;
    use crate::state::State;
    use crate::time_of_flight::TimeOfFlight;

    /// A solver with this cos θ and this error estimate for every toss; it panics if cos θ is 9.
    struct Foreign {
        cos_tilt: f64,
        claim: Option<f64>,
    }

    impl Solver for Foreign {
        fn name(&self) -> &str {
            "foreign"
        }

        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            assert!(self.cos_tilt != 9.0, "nine is not for me");
            let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
            Ok(Propagation::new(state, Work::default()).with_cos_tilt(self.cos_tilt))
        }

        fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
            Ok(self.claim)
        }
    }

    fn toss() -> Toss {
        let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
        Toss { coin: Coin::DISC, launch }
    }

    /// The results of `propagate`, `cos_tilt`, `cos_tilts`, `cos_tilts_rigid` and `outcome`, as text.
    fn answers(cos_tilt: f64, claim: Option<f64>) -> [Result<String, String>; 5] {
        let solver = Checked::new(Foreign { cos_tilt, claim });
        let rates = [[0.1], [0.0], [0.0]];
        let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 2.0, rates.each_ref().map(|rate| &rate[..]), &[0.1]);
        let (mut out, mut of_bodies) = ([0.0], [0.0]);
        [
            solver.propagate(&toss()).map(|landing| landing.cos_tilt.to_string()).map_err(|error| error.to_string()),
            solver.cos_tilt(&toss()).map(|cos_tilt| cos_tilt.to_string()).map_err(|error| error.to_string()),
            solver
                .cos_tilts(&tosses.unwrap(), &mut out)
                .map(|()| out[0].to_string())
                .map_err(|error| error.to_string()),
            solver
                .cos_tilts_rigid(&[toss().into()], &mut of_bodies)
                .map(|()| of_bodies[0].to_string())
                .map_err(|error| error.to_string()),
            solver.outcome(&toss()).map(|outcome| outcome.name().to_owned()).map_err(|error| error.to_string()),
        ]
    }

    #[test]
    fn valid_answers_are_returned_unchanged() {
        for answer in &answers(-0.5, Some(1e-9))[..4] {
            assert_eq!(answer.as_deref(), Ok("-0.5"));
        }
        assert_eq!(answers(-0.5, Some(1e-9))[4].as_deref(), Ok("tails"));
    }

    #[test]
    fn impossible_numbers_and_panics_are_errors_that_name_the_solver() {
        for (cos_tilt, says) in [(f64::NAN, "cos θ = NaN"), (f64::INFINITY, "cos θ = inf"), (7.0, "cos θ = 7")] {
            for answer in &answers(cos_tilt, Some(1e-9))[..4] {
                let error = answer.as_ref().unwrap_err();
                assert!(error.contains(&format!("solver 'foreign' answered {says}")), "{error}");
            }
        }
        for answer in answers(9.0, Some(1e-9)) {
            assert!(answer.unwrap_err().contains("solver 'foreign' panicked: nine is not for me"));
        }
        for claim in [-1e-9, f64::NAN, f64::INFINITY] {
            let error = answers(-0.5, Some(claim))[4].clone().unwrap_err();
            assert_eq!(error, format!("solver 'foreign' claims an error of {claim}"));
        }
    }
}
