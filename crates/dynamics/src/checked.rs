//! [`Checked`], a wrapper that checks what a solver returns. Anyone can implement [`Solver`], so a panic, a NaN or an
//! impossible number must become an error that names the solver, before it reaches counts or a report.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::error::{Fault, SolveError};
use crate::failure::Error;
use crate::solver::{Landing, Solver, Tilt};
use crate::stepping::Stepping;
use crate::toss::Toss;

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

    fn checked_tilt(&self, tilt: Tilt) -> Result<Tilt, SolveError> {
        self.require("cos θ", tilt.cos_tilt, tilt.cos_tilt.abs() <= LARGEST_COSINE)?;
        match tilt.error {
            Some(error) if !(error.is_finite() && error >= 0.0) => Err(self.misbehaved(Fault::Claim(error))),
            _ => Ok(tilt),
        }
    }

    fn checked_landing(&self, landing: Landing) -> Result<Landing, SolveError> {
        self.checked_tilt(landing.tilt())?;
        for part in landing.state.attitude.components() {
            self.require("a component of the attitude", part, part.is_finite())?;
        }
        for part in landing.state.rate.iter() {
            self.require("a component of the body rate", *part, part.is_finite())?;
        }
        self.require("the norm error", landing.norm_error, landing.norm_error.is_finite())?;
        Ok(landing)
    }
}

/// What a solver that writes no result leaves, which is refused.
const UNWRITTEN: Tilt = Tilt { cos_tilt: f64::NAN, error: None };

impl<S: Solver> Solver for Checked<S> {
    fn name(&self) -> &str {
        &self.name
    }

    fn stepping(&self) -> Option<Stepping> {
        catch_unwind(AssertUnwindSafe(|| self.solver.stepping())).ok().flatten()
    }

    fn estimates_its_error(&self) -> bool {
        catch_unwind(AssertUnwindSafe(|| self.solver.estimates_its_error())).unwrap_or(true)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        self.checked_landing(self.guarded(|solver| solver.land(toss))?)
    }

    fn tilt(&self, toss: &Toss) -> Result<Tilt, SolveError> {
        self.checked_tilt(self.guarded(|solver| solver.tilt(toss))?)
    }

    fn tilts(&self, tosses: &[Toss], out: &mut [Tilt]) -> Result<(), Error> {
        out.fill(UNWRITTEN);
        self.guarded(|solver| solver.tilts(tosses, out))?;
        tosses.iter().zip(out).enumerate().try_for_each(|(index, (toss, tilt))| {
            self.checked_tilt(*tilt).map(drop).map_err(|source| Error::of_launch(index, toss, source))
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
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

        fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
            assert!(self.cos_tilt != 9.0, "nine is not for me");
            let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
            Ok(Landing::new(state, Work::default()).with_cos_tilt(self.cos_tilt).with_error(self.claim))
        }
    }

    fn toss() -> Toss {
        let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
        Toss::new(Coin::DISC, launch)
    }

    /// cos θ by `land`, `tilt` and `tilts`, or the error as text.
    fn answers(cos_tilt: f64, claim: Option<f64>) -> [Result<f64, String>; 3] {
        let solver = Checked::new(Foreign { cos_tilt, claim });
        let mut out = [UNWRITTEN];
        [
            solver.land(&toss()).map(|landing| landing.cos_tilt).map_err(|error| error.to_string()),
            solver.tilt(&toss()).map(|tilt| tilt.cos_tilt).map_err(|error| error.to_string()),
            solver.tilts(&[toss()], &mut out).map(|()| out[0].cos_tilt).map_err(|error| error.to_string()),
        ]
    }

    #[test]
    fn valid_answers_are_returned_unchanged() {
        for claim in [None, Some(0.0), Some(1e-9)] {
            assert_eq!(answers(-0.5, claim), [Ok(-0.5), Ok(-0.5), Ok(-0.5)]);
        }
    }

    #[test]
    fn impossible_numbers_and_panics_are_errors_that_name_the_solver() {
        for (cos_tilt, says) in [(f64::NAN, "cos θ = NaN"), (f64::INFINITY, "cos θ = inf"), (7.0, "cos θ = 7")] {
            for answer in answers(cos_tilt, Some(1e-9)) {
                let error = answer.unwrap_err();
                assert!(error.contains(&format!("solver 'foreign' answered {says}")), "{error}");
            }
        }
        for answer in answers(9.0, Some(1e-9)) {
            assert!(answer.unwrap_err().contains("solver 'foreign' panicked: nine is not for me"));
        }
        for claim in [-1e-9, f64::NAN, f64::INFINITY] {
            for answer in answers(-0.5, Some(claim)) {
                let error = answer.unwrap_err();
                assert!(error.contains(&format!("solver 'foreign' claims an error of {claim}")), "{error}");
            }
        }
    }

    #[test]
    fn a_solver_that_writes_no_results_is_refused() {
        struct Idle;
        impl Solver for Idle {
            fn name(&self) -> &str {
                "idle"
            }
            fn land(&self, _: &Toss) -> Result<Landing, SolveError> {
                Err(SolveError::NotFinite { time: 0.0 })
            }
            fn tilts(&self, _: &[Toss], _: &mut [Tilt]) -> Result<(), Error> {
                Ok(())
            }
        }
        let mut out = [Tilt { cos_tilt: 0.5, error: Some(0.1) }];
        let error = Checked::new(Idle).tilts(&[toss()], &mut out).unwrap_err();
        assert!(error.to_string().contains("solver 'idle' answered cos θ = NaN"), "{error}");
    }
}
