//! Why a solver cannot finish a flight.

use std::fmt;
use std::sync::Arc;

use thiserror::Error;

/// A point where the equations of a formulation have no derivative, although the motion itself is regular there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Singularity {
    /// sin β = 0: the normal n is along the frame's z axis. There α and γ turn about the same axis and can't be told
    /// apart.
    NormalAlongAxis,
    /// α' = 0 with sin β ≠ 0: the precession turns back. There D = ωx sin γ + ωy cos γ and u = ωz - γ' are both 0, and
    /// the γ-ODE (10) reads 0/0. Also reported where α' is so small against the rates that D and u are lost in
    /// rounding.
    PrecessionTooSlow,
}

impl fmt::Display for Singularity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NormalAlongAxis => "sin β = 0",
            Self::PrecessionTooSlow => "α' = 0",
        })
    }
}

/// The reason why a solver gave no answer. Times are in seconds after launch.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The coin turns so far that neighbouring f64 inputs land a radian or more apart.
    #[error("outcome not determined: the phase of the motion, {phase:e} rad, is above 2^53")]
    PhaseTooLarge {
        /// The larger one of ωL T and |q| T (rad).
        phase: f64,
    },
    /// The formulation reached a point where its equations have no derivative.
    #[error("the equations of motion are singular ({point}) at t = {time} s")]
    Singular {
        /// The kind of point.
        point: Singularity,
        /// The end of the step that met it (s).
        time: f64,
    },
    /// The solver was made with a scheme that it does not have. [`SolverEntry::solver`](crate::SolverEntry::solver)
    /// refuses such a scheme already when it makes the solver.
    #[error("the solver does not offer the scheme {scheme}")]
    NotOffered {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// The solver is for bodies that are symmetric about their normal n, and this one has I1 ≠ I2.
    #[error("solver '{solver}' is for bodies with I1 = I2 only: {why}")]
    NotSymmetric {
        /// The solver's name.
        solver: String,
        /// What in its equations assumes the symmetry.
        why: &'static str,
    },
    /// A proof was asked of a solver, or of a scheme or a formulation of it, that has no bound of its own error.
    #[error("solver '{solver}' proves nothing: {why}")]
    NotProven {
        /// The solver's name.
        solver: String,
        /// Why it has no bound.
        why: &'static str,
    },
    /// The flight needs more steps than the limit.
    #[error("more than {limit} steps needed{}", stopped(*time))]
    StepLimit {
        /// The time at which the integration stopped (s); 0 if it never began.
        time: f64,
        /// The largest number of steps.
        limit: u32,
    },
    /// The step size fell so low that adding a step no longer changes the time.
    #[error("the step size fell below the resolution of the time at t = {time} s")]
    StepSizeUnderflow {
        /// The time at which the integration stopped (s).
        time: f64,
    },
    /// The integrated state holds a NaN or an infinity.
    #[error("the integrated state is not finite at t = {time} s")]
    NotFinite {
        /// The end of the integration (s).
        time: f64,
    },
    /// The solver panicked, or returned an impossible number; see [`Checked`](crate::Checked).
    #[error("solver '{solver}' {fault}")]
    Misbehaved {
        /// The solver's name.
        solver: String,
        /// What the solver did.
        fault: Fault,
    },
    /// The solver failed for a reason that is special to it.
    #[error("solver '{solver}' failed: {source}")]
    Failed {
        /// The solver's name.
        solver: String,
        /// The reason.
        source: Reason,
    },
}

/// Where a flight stopped, unless it never began.
fn stopped(time: f64) -> String {
    if time == 0.0 { String::new() } else { format!(", stopped at t = {time} s") }
}

/// What a faulty solver did.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// It returned a number that is NaN, infinite or impossible.
    #[error("answered {field} = {value}")]
    Answer {
        /// What the number stands for.
        field: &'static str,
        /// The number.
        value: f64,
    },
    /// It returned an error estimate that is NaN, infinite or negative.
    #[error("claims an error of {0}")]
    Claim(f64),
    /// It panicked.
    #[error("panicked: {0}")]
    Panic(String),
}

/// An error of code outside this workspace, kept as the source of a [`SolveError`]. Two values are equal if they share
/// the same error object, because a foreign error need not be comparable.
#[derive(Debug, Clone)]
pub struct Reason(Arc<dyn std::error::Error + Send + Sync>);

impl Reason {
    /// Wraps `error`.
    pub fn new(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self(Arc::new(error))
    }
}

impl From<Box<dyn std::error::Error + Send + Sync>> for Reason {
    fn from(error: Box<dyn std::error::Error + Send + Sync>) -> Self {
        Self(error.into())
    }
}

impl PartialEq for Reason {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Reason {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.source()
    }
}

impl SolveError {
    /// The failure of the solver called `solver` because of `reason`.
    pub fn failed(solver: &str, reason: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Failed { solver: solver.to_owned(), source: Reason::new(reason) }
    }

    /// The same error with its time counted from launch, for a flight that began `seconds` after launch.
    #[must_use]
    pub fn later(mut self, seconds: f64) -> Self {
        if let Self::Singular { time, .. }
        | Self::StepLimit { time, .. }
        | Self::StepSizeUnderflow { time }
        | Self::NotFinite { time } = &mut self
        {
            *time += seconds;
        }
        self
    }

    /// A short name of the kind of error, for machine-readable output.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::PhaseTooLarge { .. } => "phase_too_large",
            Self::Singular { .. } => "singular",
            Self::NotOffered { .. } => "not_offered",
            Self::StepLimit { .. } => "step_limit",
            Self::StepSizeUnderflow { .. } => "step_size_underflow",
            Self::NotFinite { .. } => "not_finite",
            Self::Misbehaved { .. } => "misbehaved",
            Self::Failed { .. } => "failed",
            Self::NotSymmetric { .. } => "not_symmetric",
            Self::NotProven { .. } => "not_proven",
        }
    }
}
