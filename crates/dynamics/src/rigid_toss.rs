//! [`RigidToss`], the toss of any rigid body. It stands beside [`Toss`], so that the toss of a coin keeps its size, its
//! formulas and its bits.

use crate::body::Body;
use crate::error::SolveError;
use crate::launch::{Launch, Toss};

/// A rigid body and its launch: all that a flight depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct RigidToss {
    /// The body. As plain data it is called `coin`, so that the toss of a coin reads as one of these; `body` is read
    /// too. Without it, it is [`Coin::PAPER`](crate::Coin::PAPER).
    #[cfg_attr(feature = "serde", serde(rename = "coin", alias = "body", default = "Body::paper"))]
    pub body: Body,
    /// The launch of the body.
    pub launch: Launch,
}

impl RigidToss {
    /// The toss of the coin that the body is, if it is symmetric about its normal.
    pub fn symmetric(&self) -> Option<Toss> {
        self.body.symmetric().map(|coin| Toss { coin, launch: self.launch })
    }

    /// The toss of the coin that the body is, for the solver called `solver`, which solves no other bodies.
    ///
    /// # Errors
    /// [`SolveError::NotSymmetric`] with the reason `why`.
    pub fn require_symmetric(&self, solver: &str, why: &'static str) -> Result<Toss, SolveError> {
        self.symmetric().ok_or_else(|| SolveError::NotSymmetric { solver: solver.to_owned(), why })
    }
}

/// The toss of a coin.
impl From<Toss> for RigidToss {
    fn from(Toss { coin, launch }: Toss) -> Self {
        Self { body: coin.into(), launch }
    }
}

/// The toss of a coin.
impl From<&Toss> for RigidToss {
    fn from(toss: &Toss) -> Self {
        (*toss).into()
    }
}

/// The same toss, for functions that take the toss of a coin as well.
impl From<&Self> for RigidToss {
    fn from(toss: &Self) -> Self {
        *toss
    }
}
