//! The options that describe one toss: the coin and the launch, and for a flight also the solver. The commands about
//! single tosses share them.

use clap::Args;
use dynamics::data::{NO_BOUNCE, NO_DRAG};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use toss::catalogue::named_coin;
use toss::{Backend, Coin, InputError, Launch, TimeOfFlight, Toss, Vector3};

use crate::failure::Failure;
use crate::solver_args::SolverArgs;

/// Parses numbers that are separated by commas.
fn list(field: &'static str, text: &str, expected: &'static str) -> Result<Vec<f64>, InputError> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    parts.map_err(|_| InputError::Malformed { field, value: text.to_owned(), expected })
}

/// Parses exactly N numbers that are separated by commas.
pub(crate) fn numbers<const N: usize>(
    field: &'static str,
    text: &str,
    expected: &'static str,
) -> Result<[f64; N], InputError> {
    let malformed = |_| InputError::Malformed { field, value: text.to_owned(), expected };
    list(field, text, expected)?.try_into().map_err(malformed)
}

#[derive(Debug, Args)]
#[group(multiple = false)]
pub(crate) struct CoinArgs {
    /// A coin of the catalogue [default: paper]
    #[arg(long, value_name = "NAME")]
    coin: Option<String>,
    /// A homogeneous cylinder as a coin (kg, m, m)
    #[arg(long, value_name = "MASS,RADIUS,THICKNESS", allow_hyphen_values = true)]
    cylinder: Option<String>,
    /// Moments of inertia about a diameter and about the normal (kg m²); I1,I2,I3 with I2 = I1 is accepted too
    #[arg(long, value_name = "I1,I3", allow_hyphen_values = true)]
    moments: Option<String>,
}

impl CoinArgs {
    /// The coin, if one of the options was given.
    pub(crate) fn given(&self) -> Result<Option<Coin>, InputError> {
        if let Some(text) = &self.cylinder {
            let [mass, radius, thickness] = numbers("cylinder", text, "MASS,RADIUS,THICKNESS [kg, m, m]")?;
            return Coin::from_cylinder(mass, radius, thickness).map(Some);
        }
        if let Some(text) = &self.moments {
            return Coin::from_listed_moments(&list("moments", text, "I1,I3 [kg m²]")?).map(Some);
        }
        self.coin.as_deref().map(named_coin).transpose()
    }
}

/// Options for a coin and its launch.
#[derive(Debug, Args)]
pub(crate) struct TossArgs {
    #[command(flatten)]
    pub(crate) coin: CoinArgs,
    /// Body rate at launch, in the body frame (rad/s)
    #[arg(long, value_name = "WX,WY,WZ", allow_hyphen_values = true)]
    rate: Option<String>,
    /// Launch speed v0 (m/s)
    #[arg(long, value_name = "V0", allow_hyphen_values = true)]
    speed: Option<f64>,
    /// Time of flight (s), instead of a speed
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["speed", "gravity", "drop"])]
    time: Option<f64>,
    /// Gravity (m/s²) [default: 9.81]
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    gravity: Option<f64>,
    /// Height of the launch above the landing (m), negative if the coin lands higher [default: 0]
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    drop: Option<f64>,
    /// Tilt at launch: a turn about the lab's x axis (rad) [default: 0]
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
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
        let rate = self.rate.as_deref().ok_or_else(|| Failure::usage("rate", "--rate WX,WY,WZ is needed"))?;
        let rate = Vector3::from(numbers("rate", rate, "WX,WY,WZ [rad/s]")?);
        let time_of_flight = match (self.speed, self.time) {
            (_, Some(time)) => TimeOfFlight::Given(time),
            (Some(speed), None) => TimeOfFlight::thrown(speed, self.gravity.unwrap_or(DEFAULT_GRAVITY), self.drop),
            (None, None) => return Err(Failure::usage("speed", "one of --speed and --time is needed")),
        };
        let launch = Launch::new(rate, time_of_flight)?.with_tilt(self.tilt.unwrap_or(0.0))?;
        Ok(Toss { coin, launch })
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
