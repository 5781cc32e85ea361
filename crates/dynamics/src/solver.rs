//! [`Solver`], the trait of everything that computes where a toss lands: a pure map from a toss to the state at
//! landing, with an estimate of its error. All tests, checks and programs use solvers through it, so that any two can
//! be compared.
//!
//! A [`Toss`] is that of any rigid body. A solver that solves coins alone says so in one line, [`Toss::of_coin`].
//!
//! A solver is chosen at compile time by its type, or at run time by its [`SolverEntry`](crate::SolverEntry). A solver
//! cannot prove an outcome. It states an error estimate, and the outcome is undecided where cos θ is not larger. Only
//! the crate `exact`, by the closed form, and `kinematics-quat`, by a bound of its integrations, make proofs, as types
//! that nothing else can make.

use std::ops::{Add, Deref};

use crate::error::SolveError;
use crate::failure::Error;
use crate::outcome::Outcome;
use crate::state::State;
use crate::stepping::Stepping;
use crate::toss::Toss;

/// The cost of a flight, as counts that are the same in every run and on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Work {
    /// Evaluations of the right-hand side. For Taylor series, the number of coefficients of the state: one for each
    /// order of each step.
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

/// cos θ at landing, with the solver's estimate of its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tilt {
    /// cos θ.
    pub cos_tilt: f64,
    /// The solver's estimate of the error of cos θ, finite and ≥ 0. Without one, `None`, the outcome is undecided.
    pub error: Option<f64>,
}

impl Tilt {
    /// Heads or tails by cos θ, or undecided if |cos θ| is at most the error estimate.
    pub fn outcome(self) -> Outcome {
        self.error.map_or(Outcome::Undecided, |error| Outcome::of(self.cos_tilt, error))
    }
}

/// The result of a flight: the state at landing, cos θ with its error estimate, and the cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Landing {
    /// The state at landing.
    pub state: State,
    /// cos θ at landing. It is that of the state's attitude, unless the solver can compute it more accurately.
    pub cos_tilt: f64,
    /// The solver's estimate of the error of cos θ, finite and ≥ 0. Without one, `None`, the outcome is undecided.
    pub error: Option<f64>,
    /// Norm error ||Q| - 1| of an integrated quaternion before it was normalised; 0 for other solvers.
    pub norm_error: f64,
    /// The cost of the flight.
    pub work: Work,
}

impl Landing {
    /// A landing whose cos θ is that of its attitude, without a norm error and without an error estimate.
    pub fn new(state: State, work: Work) -> Self {
        Self { state, cos_tilt: state.attitude.cos_tilt(), error: None, norm_error: 0.0, work }
    }

    /// The same landing with this estimate of the error of cos θ. Integrators give [`Stepping::error_estimate`].
    #[must_use]
    pub fn with_error(self, error: impl Into<Option<f64>>) -> Self {
        Self { error: error.into(), ..self }
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

    /// cos θ with its error estimate.
    pub fn tilt(&self) -> Tilt {
        Tilt { cos_tilt: self.cos_tilt, error: self.error }
    }

    /// The [outcome](Tilt::outcome) by cos θ and its error estimate.
    pub fn outcome(&self) -> Outcome {
        self.tilt().outcome()
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

    /// Whether the errors of its landings are estimates of its own, so that it is a fault if they are far larger than its
    /// errors. A solver whose author states nothing, and which is judged by what its tolerance permits, says no.
    fn estimates_its_error(&self) -> bool {
        true
    }

    /// The state at landing, `toss.launch.flight_time()` seconds after launch, with the error estimate of its cos θ.
    /// Fails with an error where the solver cannot go on; never a partial result. [`SolveError::NotSymmetric`] for a
    /// body with I1 ≠ I2 where the solver does not solve it; [`SolveError::PhaseTooLarge`] if the body turns by more
    /// than 2^53 rad.
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError>;

    /// cos θ at landing. Override it if cos θ can be computed more cheaply than the attitude.
    fn tilt(&self, toss: &Toss) -> Result<Tilt, SolveError> {
        self.land(toss).map(|landing| landing.tilt())
    }

    /// cos θ at landing of each of many tosses. Override it if many tosses can be solved more cheaply than one by one.
    /// Fails with [`Error::Launch`] for the first toss without an answer; the numbers in `out` then mean nothing.
    /// Panics if `out` has another length than `tosses`.
    fn tilts(&self, tosses: &[Toss], out: &mut [Tilt]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        tosses.iter().zip(out).enumerate().try_for_each(|(index, (toss, out))| {
            *out = self.tilt(toss).map_err(|source| Error::of_launch(index, toss, source))?;
            Ok(())
        })
    }
}

/// A pointer to a solver, such as a reference, a box or an `Arc`, is a solver.
impl<P> Solver for P
where
    P: Deref + Send + Sync,
    P::Target: Solver,
{
    fn name(&self) -> &str {
        (**self).name()
    }

    fn stepping(&self) -> Option<Stepping> {
        (**self).stepping()
    }

    fn estimates_its_error(&self) -> bool {
        (**self).estimates_its_error()
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        (**self).land(toss)
    }

    fn tilt(&self, toss: &Toss) -> Result<Tilt, SolveError> {
        (**self).tilt(toss)
    }

    fn tilts(&self, tosses: &[Toss], out: &mut [Tilt]) -> Result<(), Error> {
        (**self).tilts(tosses, out)
    }
}

#[cfg(test)]
mod tests;
