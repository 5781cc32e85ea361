//! [`Toss`], a rigid body and its launch: all that a flight depends on, and all that a solver takes. [`CoinToss`] is the
//! same of a coin, for formulas that rest on I1 = I2.

use crate::body::Body;
use crate::coin::Coin;
use crate::error::SolveError;
use crate::launch::Launch;

/// A body and its launch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Toss {
    /// The body. As plain data it is called `coin`; `body` is read too. Without it, it is [`Coin::PAPER`].
    #[cfg_attr(feature = "serde", serde(rename = "coin"))]
    pub body: Body,
    /// The launch of the body.
    pub launch: Launch,
}

impl Toss {
    /// The toss of a coin or of another body.
    #[inline]
    pub fn new(body: impl Into<Body>, launch: Launch) -> Self {
        Self { body: body.into(), launch }
    }

    /// The toss of the coin that the body is, if it is one.
    #[inline]
    pub fn coin(&self) -> Option<CoinToss> {
        match self.body {
            Body::Coin(coin) => Some(CoinToss { coin, launch: self.launch }),
            Body::Rigid(_) => None,
        }
    }

    /// The toss of the coin that the body is, for the solver called `solver`, which solves no other bodies.
    pub fn of_coin(&self, solver: &str, why: &'static str) -> Result<CoinToss, SolveError> {
        self.coin().ok_or_else(|| SolveError::NotSymmetric { solver: solver.to_owned(), why })
    }
}

/// A coin and its launch, for formulas that rest on I1 = I2. Functions for any body take a [`Toss`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoinToss {
    /// The coin.
    pub coin: Coin,
    /// The launch of the coin.
    pub launch: Launch,
}

/// The toss of a coin.
impl From<CoinToss> for Toss {
    fn from(CoinToss { coin, launch }: CoinToss) -> Self {
        Self { body: Body::Coin(coin), launch }
    }
}
