//! Answers to scenes, and what they rest on.

use dynamics::{Outcome, State};
use exact::{Certificate, Stage};
use sampling::Estimate;

use crate::trace::TracePoint;

/// What was wanted.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Heads or tails, and what it rests on.
    Outcome(Verdict),
    /// cos θ at landing.
    Tilt(f64),
    /// Attitude and body rate at landing.
    Attitude(State),
    /// The flight.
    Trace(Vec<TracePoint>),
    /// The probability of heads.
    Probability(Box<Estimate>),
}

/// An outcome, and what it rests on. Only the proving code can make one that is proven.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// By a proof.
    Proven(Certificate),
    /// By a solver, as far as its error estimate goes.
    Estimated(Outcome),
}

impl Verdict {
    /// How the toss lands.
    pub fn outcome(self) -> Outcome {
        match self {
            Self::Proven(certificate) => certificate.outcome(),
            Self::Estimated(outcome) => outcome,
        }
    }

    /// The stage that proved it; `None` for an estimate.
    pub fn stage(self) -> Option<Stage> {
        match self {
            Self::Proven(certificate) => Some(certificate.stage()),
            Self::Estimated(_) => None,
        }
    }

    /// Whether it is proven.
    pub fn is_proven(self) -> bool {
        matches!(self, Self::Proven(_))
    }
}
