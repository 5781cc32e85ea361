//! The options for the body rate of a toss. It is given by its components, or by what can be seen of a toss: how fast the
//! coin's normal n turns, and its angle ψ to the angular momentum S.

use clap::Args;
use dynamics::rate_of_precession;
use toss::{Coin, Dimension, Vector3};

use crate::failure::Failure;
use crate::quantity;

/// Options for the rate at which the normal turns, and its angle to the angular momentum.
#[derive(Debug, Args)]
pub(crate) struct TurnArgs {
    /// Rate |S|/I1 at which the normal n turns about the angular momentum S; with --wobble in place of the body rate. It
    /// stands for ωx = RATE sin ψ, ωy = 0 and ωz = RATE cos ψ I1/I3
    #[arg(long, value_name = "RATE", allow_hyphen_values = true, requires = "wobble",
          value_parser = quantity::of(Dimension::TurnRate))]
    turn: Option<f64>,
    /// Angle ψ between n and S, from 0 to 180deg; with --turn
    #[arg(long, value_name = "PSI", allow_hyphen_values = true, requires = "turn",
          value_parser = quantity::of(Dimension::Angle))]
    wobble: Option<f64>,
}

impl TurnArgs {
    /// The body rate (rad/s) of `coin`, if these options were given.
    pub(crate) fn rate(&self, coin: &Coin) -> Result<Option<Vector3<f64>>, Failure> {
        let (Some(turn), Some(wobble)) = (self.turn, self.wobble) else { return Ok(None) };
        Ok(Some(rate_of_precession(coin, turn, wobble)?))
    }
}

/// Options for the body rate of a toss.
#[derive(Debug, Args)]
pub(crate) struct RateArgs {
    /// Body rate at launch, in the body frame, with z along the normal of the heads side
    #[arg(long, value_name = "WX,WY,WZ", allow_hyphen_values = true, conflicts_with_all = ["turn", "wobble"])]
    rate: Option<String>,
    #[command(flatten)]
    turn: TurnArgs,
}

impl RateArgs {
    /// The body rate (rad/s) of `coin`.
    pub(crate) fn rate(&self, coin: &Coin) -> Result<Vector3<f64>, Failure> {
        if let Some(rate) = self.turn.rate(coin)? {
            return Ok(rate);
        }
        let missing = || Failure::usage("rate", "--rate WX,WY,WZ is needed, or --turn RATE with --wobble PSI");
        Ok(quantity::rates(self.rate.as_deref().ok_or_else(missing)?)?.into())
    }
}
