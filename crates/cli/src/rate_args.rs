//! The options for the body rate of a toss. It is given by its components, or by what can be seen of a toss: how fast the
//! coin's normal n turns, and its angle ψ to the angular momentum S.

use clap::Args;
use dynamics::quantity::{Given, common_unit};
use dynamics::rate_of_precession;
use toss::{Body, Dimension, InputError, Launch, TimeOfFlight, Vector3};

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
    /// The body rate (rad/s) of `body`, if these options were given.
    pub(crate) fn rate(&self, body: &Body) -> Result<Option<Vector3<f64>>, Failure> {
        let (Some(turn), Some(wobble)) = (self.turn, self.wobble) else { return Ok(None) };
        let uneven =
            || Failure::usage("turn", "--turn: n of a body with I1 ≠ I2 turns unevenly; use the body rate instead");
        let coin = body.coin().ok_or_else(uneven)?;
        Ok(Some(rate_of_precession(&coin, turn, wobble)?))
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
    /// The body rate (rad/s) of `body`.
    pub(crate) fn rate(&self, body: &Body) -> Result<Vector3<f64>, Failure> {
        if let Some(rate) = self.turn.rate(body)? {
            return Ok(rate);
        }
        Ok(Vector3::from(self.components()?.map(Given::si)))
    }

    /// The launch of `body` with this body rate. Components in one unit are not converted, so that proofs start from them.
    pub(crate) fn launch(&self, body: &Body, time_of_flight: TimeOfFlight) -> Result<Launch, Failure> {
        let unit = if self.rate.is_some() { common_unit(&self.components()?) } else { None };
        let Some(unit) = unit else { return Ok(Launch::new(self.rate(body)?, time_of_flight)?) };
        let rate = Vector3::from(self.components()?.map(Given::value));
        Ok(Launch::in_unit(rate, unit.angle_unit(), time_of_flight)?)
    }

    /// Whether the rate of [`RateArgs::launch`] is rounded from what was given.
    pub(crate) fn is_rounded(&self) -> Result<bool, Failure> {
        if self.rate.is_none() {
            return Ok(true);
        }
        let components = self.components()?;
        Ok(common_unit(&components).is_none() && !components.into_iter().all(Given::is_exact_in_si))
    }

    fn components(&self) -> Result<[Given; 3], Failure> {
        let missing = || Failure::usage("rate", "--rate WX,WY,WZ is needed, or --turn RATE with --wobble PSI");
        let read = |text: &String| quantity::rates(text).map_err(|error: InputError| Failure::from(error));
        self.rate.as_ref().ok_or_else(missing).and_then(read)
    }
}
