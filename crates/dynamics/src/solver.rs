//! What a solver is: a pure map from a toss to the state at its landing, with an estimate of its error.
//!
//! A solver is chosen at compile time by its type or at run time by its [`SolverEntry`](crate::SolverEntry). It states
//! no proof: a solver says how far it may be off, and the outcome follows from that. Proofs are made by the crate
//! `exact` alone.

use std::sync::Arc;

use crate::columns::Tosses;
use crate::error::SolveError;
use crate::failure::Error;
use crate::launch::Toss;
use crate::outcome::Outcome;
use crate::state::State;
use crate::stepping::Stepping;

/// What a propagation cost, as counts that repeat exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Evaluations of the right-hand side; of Taylor series, a coefficient of the whole state for each order of each step.
    pub rhs_calls: u64,
    /// Steps that were kept.
    pub accepted_steps: u64,
    /// Steps that were tried and thrown away.
    pub rejected_steps: u64,
}

/// The state at landing and what it cost to get there.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Propagation {
    /// State at landing.
    pub state: State,
    /// cos θ at landing, as the solver finds it: that of the state's attitude, or better.
    pub cos_tilt: f64,
    /// Norm error of an integrated quaternion, ||Q| - 1|; 0 where attitudes need no norm.
    pub norm_error: f64,
    /// Its cost.
    pub work: Work,
}

impl Propagation {
    /// A landing whose cos θ is that of its attitude.
    pub fn new(state: State, work: Work) -> Self {
        Self { state, cos_tilt: state.attitude.cos_tilt(), norm_error: 0.0, work }
    }

    /// The same landing with a better cos θ than that of its attitude.
    #[must_use]
    pub fn with_cos_tilt(self, cos_tilt: f64) -> Self {
        Self { cos_tilt, ..self }
    }

    /// The same landing of a quaternion whose norm was off by `norm_error`.
    #[must_use]
    pub fn with_norm_error(self, norm_error: f64) -> Self {
        Self { norm_error, ..self }
    }
}

/// Solves the flight of a toss.
pub trait Solver: Send + Sync {
    /// Its name in the registry.
    fn name(&self) -> &str;

    /// How it steps through time; `None` for a closed form.
    fn stepping(&self) -> Option<Stepping> {
        None
    }

    /// State at landing, `toss.launch.flight_time()` seconds after launch.
    ///
    /// # Errors
    /// [`SolveError`] where the solver cannot go on; never a partial result.
    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError>;

    /// Estimate of the error of its cos θ at the landing of `toss`, finite and ≥ 0; `None` if it has none, and then it
    /// decides no outcome. Integrators answer with [`Stepping::error_estimate`].
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError>;

    /// cos θ at landing; a solver may know a cheaper way than by the attitude.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.propagate(toss).map(|landing| landing.cos_tilt)
    }

    /// cos θ at landing of each of many tosses; a solver may know a cheaper way than one by one.
    ///
    /// # Errors
    /// [`Error`] for the first toss that has no answer; the numbers in `out` then mean nothing.
    ///
    /// # Panics
    /// If `out` has another length than `tosses`.
    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        out.iter_mut().enumerate().try_for_each(|(index, out)| {
            *out = tosses.solve(index, |toss| self.cos_tilt(toss))?;
            Ok(())
        })
    }

    /// Heads or tails by `cos_tilt` (of this solver), or undecided where it is within the error estimate of 0.
    ///
    /// # Errors
    /// As [`Solver::error_estimate`].
    fn outcome_at(&self, toss: &Toss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        Ok(self.error_estimate(toss)?.map_or(Outcome::Undecided, |error| Outcome::of(cos_tilt, error)))
    }

    /// How the toss lands.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.outcome_at(toss, self.cos_tilt(toss)?)
    }
}

/// A pointer to a solver is a solver.
macro_rules! by_pointer {
    ($pointer:ty) => {
        impl<S: Solver + ?Sized> Solver for $pointer {
            fn name(&self) -> &str {
                (**self).name()
            }
            fn stepping(&self) -> Option<Stepping> {
                (**self).stepping()
            }
            fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
                (**self).propagate(toss)
            }
            fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
                (**self).error_estimate(toss)
            }
            fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
                (**self).cos_tilt(toss)
            }
            fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
                (**self).cos_tilts(tosses, out)
            }
            fn outcome_at(&self, toss: &Toss, cos_tilt: f64) -> Result<Outcome, SolveError> {
                (**self).outcome_at(toss, cos_tilt)
            }
            fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
                (**self).outcome(toss)
            }
        }
    };
}

by_pointer!(&S);
by_pointer!(Box<S>);
by_pointer!(Arc<S>);

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::attitude::Attitude;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    /// Lands where it was launched, with this estimate of its error.
    struct Still(Option<f64>);

    impl Solver for Still {
        fn name(&self) -> &str {
            "still"
        }

        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
            Ok(Propagation::new(state, Work::default()))
        }

        fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
            Ok(self.0)
        }
    }

    fn toss(tilt: f64) -> Toss {
        let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
        Toss { coin: Coin::DISC, launch: launch.with_tilt(tilt).unwrap() }
    }

    #[test]
    fn an_outcome_is_decided_as_far_as_the_error_estimate_goes() {
        let quarter = std::f64::consts::FRAC_PI_2;
        for error in [0.0, 1e-3] {
            let solver = Still(Some(error));
            for (tilt, outcome) in
                [(0.3, Outcome::Heads), (3.0, Outcome::Tails), (quarter - 2.0 * error, Outcome::Heads)]
            {
                assert_eq!(solver.cos_tilt(&toss(tilt)), Ok(Attitude::about_x(tilt).cos_tilt()));
                assert_eq!(solver.outcome(&toss(tilt)), Ok(outcome));
            }
            let near = solver.outcome(&toss(quarter - 0.5 * error)).unwrap();
            assert_eq!(near == Outcome::Heads, error == 0.0);
        }
        assert_eq!(Still(None).outcome(&toss(0.3)), Ok(Outcome::Undecided));
    }

    #[test]
    fn many_tosses_are_solved_one_by_one_also_through_pointers() {
        let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, 3.0], [1.0, 1.5]];
        let tosses = Tosses::new(Coin::DISC, Attitude::about_x(0.3), 9.81, [&x, &y, &z], &speed).unwrap();
        let expected = [Attitude::about_x(0.3).cos_tilt(); 2];
        let still: Arc<dyn Solver> = Arc::new(Still(Some(0.5)));
        let solvers: [Box<dyn Solver>; 3] = [Box::new(Still(Some(0.5))), Box::new(&Still(Some(0.5))), Box::new(still)];
        for solver in solvers {
            let mut found = [f64::NAN; 2];
            solver.cos_tilts(&tosses, &mut found).unwrap();
            assert_eq!(found, expected);
            assert_eq!((solver.name(), solver.stepping()), ("still", None));
            assert_eq!(solver.error_estimate(&toss(0.3)), Ok(Some(0.5)));
            assert_eq!(solver.outcome(&toss(0.3)), Ok(Outcome::Heads));
        }
    }

    #[test]
    fn a_toss_that_is_none_is_named_by_its_index() {
        let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, f64::NAN], [1.0, 1.5]];
        let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
        let error = Still(None).cos_tilts(&tosses, &mut [0.0; 2]).unwrap_err();
        assert_eq!((error.kind(), error.field()), ("input", Some("rate z [rad/s]")));
        assert!(error.to_string().starts_with("launch 1: rate z"), "{error}");
    }
}
