//! What a solver is: a pure map from a toss to the state at its landing.
//!
//! A solver is chosen at compile time by its type or at run time by its [`SolverEntry`]. Each lives in one file and
//! has one entry; every test and every check runs over the registry of entries.

use crate::error::{InputError, SolveError, find_named};
use crate::exact::ExactMotion;
use crate::launch::Toss;
use crate::method::Method;
use crate::outcome::{Outcome, Verdict};
use crate::state::State;

/// What a propagation cost, as counts that repeat exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Evaluations of the right-hand side.
    pub rhs_calls: u64,
    /// Steps that were kept.
    pub accepted_steps: u64,
    /// Steps that were tried and thrown away.
    pub rejected_steps: u64,
}

/// The state at landing and what it cost to get there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Propagation {
    /// State at landing.
    pub state: State,
    /// Loss of norm of an integrated quaternion, ||Q| - 1|, before it was normalised; 0 where attitudes need no norm.
    pub defect: f64,
    /// Its cost.
    pub work: Work,
}

/// Solves the flight of a toss.
pub trait Solver: Send + Sync {
    /// Its name in the registry.
    fn name(&self) -> &'static str;

    /// Its Runge-Kutta method; `None` for a closed form.
    fn method(&self) -> Option<Method> {
        None
    }

    /// State at landing, `toss.launch.flight_time()` seconds after launch.
    ///
    /// # Errors
    /// [`SolveError`] where the solver cannot go on; never a partial result.
    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError>;

    /// cos θ at landing; cheaper than the attitude where the solver knows how.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        Ok(self.propagate(toss)?.state.attitude.cos_tilt())
    }

    /// Error of cos θ that this solver answers for after a [`phase`](ExactMotion::phase) (rad), by its method; 0 if it
    /// gives no estimate.
    fn resolution(&self, phase: f64) -> f64 {
        self.method().map_or(0.0, |method| method.resolution(phase))
    }

    /// Heads or tails by a `cos_tilt` of this solver, or undecided where it is within [`Solver::resolution`] of 0.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    fn verdict_at(&self, toss: &Toss, cos_tilt: f64) -> Result<Verdict, SolveError> {
        let phase = ExactMotion::new(toss).phase(toss.launch.time_of_flight())?;
        Ok(Verdict { outcome: Outcome::of(cos_tilt, self.resolution(phase)), proof: None })
    }

    /// How the toss lands, and whether that is proven.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn verdict(&self, toss: &Toss) -> Result<Verdict, SolveError> {
        self.verdict_at(toss, self.cos_tilt(toss)?)
    }

    /// How the toss lands.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.verdict(toss).map(|verdict| verdict.outcome)
    }
}

/// The transport frame in which the γ-ODE and the Euler angles are taken. The motion is the same in each; what
/// differs is where sin β = 0 lies. Other solvers have no use for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Frame {
    /// z along ±S, the angular momentum, on the side of n: S is fixed in TF, so β is constant and at most π/2.
    #[default]
    Momentum,
    /// z up, as the paper has it: singular whenever n is vertical, as at every horizontal launch and at each return.
    Vertical,
}

impl Frame {
    /// All frames.
    pub const ALL: [Self; 2] = [Self::Momentum, Self::Vertical];

    /// The frame called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`].
    pub fn named(name: &str) -> Result<Self, InputError> {
        find_named("frame", name, &Self::ALL, |frame| frame.name()).copied()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Momentum => "momentum",
            Self::Vertical => "vertical",
        }
    }
}

/// What a solver can be told at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Runge-Kutta method and step control.
    pub method: Method,
    /// Frame of the Euler angles.
    pub frame: Frame,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::DEFAULT, frame: Frame::default() }
    }
}

/// One line of the registry: how a solver is named and made at run time.
#[derive(Debug, Clone, Copy)]
pub struct SolverEntry {
    /// Name.
    pub name: &'static str,
    /// What it solves, in a line.
    pub summary: &'static str,
    /// Whether it steps through time with a Runge-Kutta method.
    pub integrates: bool,
    /// Makes the solver.
    pub build: fn(&Settings) -> Box<dyn Solver>,
}
