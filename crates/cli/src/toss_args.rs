//! The options that describe one toss: the coin and the launch, and for a flight also the solver. The commands about
//! single tosses share them.

use clap::Args;
use dynamics::data::{NO_BOUNCE, NO_DRAG};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use toss::catalogue::named_coin;
use toss::{Backend, Coin, Dimension, InputError, Launch, TimeOfFlight, Toss};

use crate::failure::Failure;
use crate::quantity;
use crate::rate_args::RateArgs;
use crate::solver_args::SolverArgs;

/// Options for a coin.
#[derive(Debug, Args)]
#[group(multiple = false)]
pub(crate) struct CoinArgs {
    /// A coin of the catalogue [default: paper]
    #[arg(long, value_name = "NAME")]
    coin: Option<String>,
    /// A homogeneous cylinder as a coin: kg, m and m, or each with a unit
    #[arg(long, value_name = "MASS,RADIUS,THICKNESS", allow_hyphen_values = true)]
    cylinder: Option<String>,
    /// Moments of inertia about a diameter and about the normal: kg m², or each with a unit such as g·cm²; I1,I2,I3 with
    /// I2 = I1 is accepted too
    #[arg(long, value_name = "I1,I3", allow_hyphen_values = true)]
    moments: Option<String>,
}

impl CoinArgs {
    /// The coin, if one of the options was given.
    pub(crate) fn given(&self) -> Result<Option<Coin>, InputError> {
        if let Some(text) = &self.cylinder {
            let [mass, radius, thickness] = quantity::cylinder(text)?;
            return Coin::from_cylinder(mass, radius, thickness).map(Some);
        }
        if let Some(text) = &self.moments {
            return Coin::from_listed_moments(&quantity::moments(text)?).map(Some);
        }
        self.coin.as_deref().map(named_coin).transpose()
    }
}

/// Options for a coin and its launch.
#[derive(Debug, Args)]
pub(crate) struct TossArgs {
    #[command(flatten)]
    pub(crate) coin: CoinArgs,
    #[command(flatten)]
    rate: RateArgs,
    /// Upward speed v0 at launch
    #[arg(long, value_name = "V0", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Speed))]
    speed: Option<f64>,
    /// Time of flight, instead of a speed
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["speed", "gravity", "drop"],
          value_parser = quantity::of(Dimension::Time))]
    time: Option<f64>,
    /// Gravity [default: 9.81]
    #[arg(long, value_name = "G", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Acceleration))]
    gravity: Option<f64>,
    /// Height of the launch above the landing, negative if the coin lands higher [default: 0]
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Length))]
    drop: Option<f64>,
    /// Tilt at launch, from horizontal with heads up: a turn about the lab's x axis. A positive one leans the normal
    /// towards -y [default: 0]
    #[arg(long, value_name = "B", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Angle))]
    tilt: Option<f64>,
    /// Air drag is outside the model; the option is refused with the reason
    #[arg(long, value_name = "C", allow_hyphen_values = true)]
    drag: Option<String>,
    /// Bouncing is outside the model; the option is refused with the reason
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    bounce: Option<String>,
}

impl TossArgs {
    pub(crate) fn toss(&self) -> Result<Toss, Failure> {
        if self.drag.is_some() {
            return Err(NO_DRAG.into());
        }
        if self.bounce.is_some() {
            return Err(NO_BOUNCE.into());
        }
        let coin = self.coin.given()?.unwrap_or(Coin::PAPER);
        let rate = self.rate.rate(&coin)?;
        let time_of_flight = match (self.speed, self.time) {
            (_, Some(time)) => TimeOfFlight::Given(time),
            (Some(speed), None) => TimeOfFlight::thrown(speed, self.gravity.unwrap_or(DEFAULT_GRAVITY), self.drop),
            (None, None) => return Err(Failure::usage("speed", "one of --speed and --time is needed")),
        };
        let launch = Launch::new(rate, time_of_flight)?.with_tilt(self.tilt())?;
        Ok(Toss { coin, launch })
    }

    /// The tilt at launch (rad).
    pub(crate) fn tilt(&self) -> f64 {
        self.tilt.unwrap_or(0.0)
    }
}

/// Options for one toss and the solver that flies it.
#[derive(Debug, Args)]
#[command(mut_arg("scheme", |scheme| scheme.alias("method")))]
pub(crate) struct FlightArgs {
    #[command(flatten)]
    toss: TossArgs,
    #[command(flatten)]
    solver: SolverArgs,
}

impl FlightArgs {
    pub(crate) fn parts(&self) -> Result<(Toss, Backend), Failure> {
        Ok((self.toss.toss()?, self.solver.backend()?))
    }
}
