//! The options that describe one toss: the coin and the launch, and for a flight also the solver. The commands about
//! single tosses share them.

use clap::Args;
use dynamics::data::{NO_BOUNCE, NO_DRAG};
use dynamics::quantity::Given;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use exact::certified::holds_within;
use toss::catalogue::named_coin;
use toss::{Backend, Coin, Dimension, InputError, TimeOfFlight, Toss};

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
            let [mass, radius, thickness] = quantity::cylinder(text)?.map(Given::quantity);
            return Coin::from_cylinder(mass, radius, thickness).map(Some);
        }
        if let Some(text) = &self.moments {
            let moments: Vec<f64> = quantity::moments(text)?.into_iter().map(Given::si).collect();
            return Coin::from_listed_moments(&moments).map(Some);
        }
        self.coin.as_deref().map(named_coin).transpose()
    }

    /// Whether the coin is rounded from what was given.
    fn is_rounded(&self) -> Result<bool, InputError> {
        let moments = self.moments.as_deref().map_or(Ok(Vec::new()), quantity::moments)?;
        Ok(!moments.into_iter().all(Given::is_exact_in_si))
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
    #[arg(long, value_name = "V0", allow_hyphen_values = true, value_parser = quantity::given(Dimension::Speed))]
    speed: Option<Given>,
    /// Time of flight, instead of a speed
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["speed", "gravity", "drop"],
          value_parser = quantity::given(Dimension::Time))]
    time: Option<Given>,
    /// Gravity [default: 9.81]
    #[arg(long, value_name = "G", allow_hyphen_values = true, value_parser = quantity::given(Dimension::Acceleration))]
    gravity: Option<Given>,
    /// Height of the launch above the landing, negative if the coin lands higher [default: 0]
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::given(Dimension::Length))]
    drop: Option<Given>,
    /// Tilt at launch, from horizontal with heads up: a turn about the lab's x axis. A positive one leans the normal
    /// towards -y [default: 0]
    #[arg(long, value_name = "B", allow_hyphen_values = true, value_parser = quantity::given(Dimension::Angle))]
    tilt: Option<Given>,
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
        let gravity = self.gravity.map_or(DEFAULT_GRAVITY, Given::si);
        let time_of_flight = match (self.speed, self.time) {
            (_, Some(time)) => TimeOfFlight::Given(time.si()),
            (Some(speed), None) => TimeOfFlight::thrown(speed.si(), gravity, self.drop.map(Given::si)),
            (None, None) => return Err(Failure::usage("speed", "one of --speed and --time is needed")),
        };
        let mut launch = self.rate.launch(&coin, time_of_flight)?;
        if let Some(tilt) = self.tilt {
            launch = launch.with_tilt(tilt.angle())?;
        }
        Ok(Toss { coin, launch })
    }

    /// The tilt at launch (rad).
    pub(crate) fn tilt(&self) -> f64 {
        self.tilt.map_or(0.0, Given::si)
    }

    /// Whether the outcome of `toss` is the same for the numbers as they were typed: `false` if numbers were rounded when
    /// their units were converted, and cos θ is so near to 0 that this could have changed it.
    pub(crate) fn is_beyond_rounding(&self, toss: &Toss) -> Result<bool, Failure> {
        let times = [self.speed, self.time, self.gravity, self.drop];
        let is_time_rounded = !times.into_iter().flatten().all(Given::is_exact_in_si);
        if !is_time_rounded && !self.coin.is_rounded()? && !self.rate.is_rounded()? {
            return Ok(true);
        }
        // A landing above the launch may end the flight near its top, where the time depends on the speed without a bound.
        if is_time_rounded && self.drop.is_some_and(|drop| drop.si() < 0.0) {
            return Ok(false);
        }
        // With u = 2^-53, conversions change the rates by up to 8 u of themselves, k by 3 u and T by 4 u.
        Ok(holds_within(toss, 4.0 * f64::EPSILON)?)
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
    /// The options of the toss.
    pub(crate) fn toss(&self) -> &TossArgs {
        &self.toss
    }

    pub(crate) fn parts(&self) -> Result<(Toss, Backend), Failure> {
        Ok((self.toss.toss()?, self.solver.backend()?))
    }
}
