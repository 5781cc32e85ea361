//! The types of an answer to a scene. An outcome says whether it is proven or estimated, so that an estimate is never
//! taken for a proof.

use dynamics::{Outcome, Stage, State};
use exact::Certificate;
use kinematics_quat::IntegratedCertificate;
use sampling::Estimate;

use crate::trace::TracePoint;

/// The answer to a [`Want`](crate::Want), of the same kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Heads or tails, proven or estimated.
    Outcome(Verdict),
    /// cos θ at landing.
    Tilt(f64),
    /// Attitude and body rate at landing.
    Attitude(State),
    /// The flight at equally spaced times.
    Trace(Vec<TracePoint>),
    /// cos θ and the attitude at landing by an integration, with proven bounds of their errors.
    Enclosed(Box<IntegratedCertificate>),
    /// The probability of heads.
    Probability(Box<Estimate>),
}

/// An outcome, proven or estimated. Only the crate `exact` can make a [`Certificate`], so only it can prove one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The outcome is proven, for exactly the f64 inputs given; see [`Certificate::is_proven`] for bodies with I1 ≠ I2.
    Proven(Certificate),
    /// A solver decided it by its own error estimate, which may be wrong.
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

    /// The stage of the proof that decided it; `None` for an estimate.
    pub fn stage(self) -> Option<Stage> {
        match self {
            Self::Proven(certificate) => Some(certificate.stage()),
            Self::Estimated(_) => None,
        }
    }

    /// Whether the outcome is proven.
    pub fn is_proven(self) -> bool {
        matches!(self, Self::Proven(certificate) if certificate.is_proven())
    }
}
