//! [`Solver`], the trait of everything that computes where a toss lands: a pure map from a toss to the state at
//! landing, with an estimate of its error. All tests, checks and programs use solvers through it, so that any two can
//! be compared.
//!
//! The toss of a coin is a [`Toss`], that of any rigid body a [`RigidToss`]. A solver has to solve the first and may
//! solve the second: without methods of its own for it, it solves bodies with I1 = I2 as the coins that they are, and
//! refuses the rest.
//!
//! A solver is chosen at compile time by its type, or at run time by its [`SolverEntry`](crate::SolverEntry). A solver
//! cannot prove an outcome. It states an error estimate, and the outcome is undecided where cos θ is not larger. Only
//! the crate `exact`, by the closed form, and `kinematics-quat`, by a bound of its integrations, make proofs, as types
//! that nothing else can make.

use std::ops::Add;
use std::sync::Arc;

use crate::columns::Tosses;
use crate::error::SolveError;
use crate::failure::Error;
use crate::launch::Toss;
use crate::outcome::Outcome;
use crate::rigid_toss::RigidToss;
use crate::state::State;
use crate::stepping::Stepping;

/// The cost of a propagation, as counts that are the same in every run and on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Evaluations of the right-hand side. For Taylor series, the number of coefficients of the state: one for each
    /// order of each step. A proof of a Runge-Kutta scheme adds those of the series that it compares steps with.
    pub rhs_calls: u64,
    /// Steps that were accepted.
    pub accepted_steps: u64,
    /// Steps that were tried and rejected.
    pub rejected_steps: u64,
}

/// The cost of both, one after the other.
impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            rhs_calls: self.rhs_calls + other.rhs_calls,
            accepted_steps: self.accepted_steps + other.accepted_steps,
            rejected_steps: self.rejected_steps + other.rejected_steps,
        }
    }
}

/// The result of a flight: the state at landing, cos θ, and the cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Propagation {
    /// The state at landing.
    pub state: State,
    /// cos θ at landing. It is that of the state's attitude, unless the solver can compute it more accurately.
    pub cos_tilt: f64,
    /// Norm error ||Q| - 1| of an integrated quaternion before it was normalised; 0 for other solvers.
    pub norm_error: f64,
    /// The cost of the propagation.
    pub work: Work,
}

impl Propagation {
    /// A landing whose cos θ is that of its attitude, without a norm error.
    pub fn new(state: State, work: Work) -> Self {
        Self { state, cos_tilt: state.attitude.cos_tilt(), norm_error: 0.0, work }
    }

    /// The same landing with this cos θ instead of that of its attitude.
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

/// Computes the flight of a toss from launch to landing.
pub trait Solver: Send + Sync {
    /// The solver's name in the registry.
    fn name(&self) -> &str;

    /// How the solver steps through time; `None` for a closed form.
    fn stepping(&self) -> Option<Stepping> {
        None
    }

    /// The state at landing, `toss.launch.flight_time()` seconds after launch.
    ///
    /// # Errors
    /// [`SolveError`] where the solver cannot go on; never a partial result.
    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError>;

    /// An estimate of the error of the solver's cos θ at the landing of `toss`, finite and ≥ 0. Without one, `None`,
    /// every outcome is undecided. Integrators return [`Stepping::error_estimate`].
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] if the coin turns by more than 2^53 rad.
    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError>;

    /// cos θ at landing. Override it if cos θ can be computed more cheaply than the attitude.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.propagate(toss).map(|landing| landing.cos_tilt)
    }

    /// cos θ at landing of each of many tosses. Override it if many tosses can be solved more cheaply than one by one.
    ///
    /// # Errors
    /// [`Error`] for the first toss without an answer; the numbers in `out` then mean nothing.
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

    /// Heads or tails by `cos_tilt`, which this solver has computed, or undecided if |`cos_tilt`| is at most the error
    /// estimate.
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

    /// The state at landing of any rigid body. Override it if the solver integrates three body rates.
    ///
    /// # Errors
    /// [`SolveError::NotSymmetric`] for a body with I1 ≠ I2 where the solver does not solve it; else as
    /// [`Solver::propagate`].
    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        self.propagate(&toss.require_symmetric(self.name(), COINS_ALONE)?)
    }

    /// An estimate of the error of cos θ for any rigid body, as [`Solver::error_estimate`] is one for a coin.
    ///
    /// # Errors
    /// As [`Solver::error_estimate`]; [`SolveError::NotSymmetric`] as for [`Solver::propagate_rigid`].
    fn error_estimate_rigid(&self, toss: &RigidToss) -> Result<Option<f64>, SolveError> {
        self.error_estimate(&toss.require_symmetric(self.name(), COINS_ALONE)?)
    }

    /// cos θ at landing of any rigid body. Override it if cos θ can be computed more cheaply than the attitude.
    ///
    /// # Errors
    /// As [`Solver::propagate_rigid`].
    fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
        match toss.symmetric() {
            Some(toss) => self.cos_tilt(&toss),
            None => self.propagate_rigid(toss).map(|landing| landing.cos_tilt),
        }
    }

    /// cos θ at landing of each of many tosses of rigid bodies. Override it if many tosses can be solved more cheaply than
    /// one by one.
    ///
    /// # Errors
    /// [`Error::Launch`] for the first toss without an answer; the numbers in `out` then mean nothing.
    ///
    /// # Panics
    /// If `out` has another length than `tosses`.
    fn cos_tilts_rigid(&self, tosses: &[RigidToss], out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        tosses.iter().zip(out).enumerate().try_for_each(|(index, (toss, out))| {
            *out = self.cos_tilt_rigid(toss).map_err(|source| Error::of_launch(index, toss, source))?;
            Ok(())
        })
    }

    /// The outcome of any rigid body by `cos_tilt`, as [`Solver::outcome_at`] is that of a coin.
    ///
    /// # Errors
    /// As [`Solver::error_estimate_rigid`].
    fn outcome_at_rigid(&self, toss: &RigidToss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        match toss.symmetric() {
            Some(toss) => self.outcome_at(&toss, cos_tilt),
            None => {
                Ok(self.error_estimate_rigid(toss)?.map_or(Outcome::Undecided, |error| Outcome::of(cos_tilt, error)))
            }
        }
    }

    /// How any rigid body lands.
    ///
    /// # Errors
    /// As [`Solver::propagate_rigid`].
    fn outcome_rigid(&self, toss: &RigidToss) -> Result<Outcome, SolveError> {
        self.outcome_at_rigid(toss, self.cos_tilt_rigid(toss)?)
    }
}

/// Why a solver without methods for rigid bodies refuses one.
const COINS_ALONE: &str = "it has no method for other rigid bodies";

/// Implements [`Solver`] for a pointer to a solver.
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
            fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
                (**self).propagate_rigid(toss)
            }
            fn error_estimate_rigid(&self, toss: &RigidToss) -> Result<Option<f64>, SolveError> {
                (**self).error_estimate_rigid(toss)
            }
            fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
                (**self).cos_tilt_rigid(toss)
            }
            fn cos_tilts_rigid(&self, tosses: &[RigidToss], out: &mut [f64]) -> Result<(), Error> {
                (**self).cos_tilts_rigid(tosses, out)
            }
            fn outcome_at_rigid(&self, toss: &RigidToss, cos_tilt: f64) -> Result<Outcome, SolveError> {
                (**self).outcome_at_rigid(toss, cos_tilt)
            }
            fn outcome_rigid(&self, toss: &RigidToss) -> Result<Outcome, SolveError> {
                (**self).outcome_rigid(toss)
            }
        }
    };
}

by_pointer!(&S);
by_pointer!(Box<S>);
by_pointer!(Arc<S>);

#[cfg(test)]
mod tests;
