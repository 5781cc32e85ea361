//! Options that several commands share: the coin, the toss, the solver.

use clap::Args;
use sampling::Space;
use toss::catalogue::named_coin;
use toss::data::{NO_BOUNCE, NO_DRAG};
use toss::time_of_flight::DEFAULT_GRAVITY;
use toss::{
    Coin, Formulation, InputError, Launch, Method, Scheme, Settings, Solver, TimeOfFlight, Toss, Vector3, named_solver,
};

use crate::failure::Failure;

/// Reads numbers separated by commas.
fn list(field: &'static str, text: &str, expected: &'static str) -> Result<Vec<f64>, InputError> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    parts.map_err(|_| InputError::Malformed { field, value: text.to_owned(), expected })
}

/// Reads N numbers separated by commas.
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
    /// A homogeneous cylinder (kg, m, m)
    #[arg(long, value_name = "MASS,RADIUS,THICKNESS", allow_hyphen_values = true)]
    cylinder: Option<String>,
    /// Principal moments of inertia (kg m²); I1,I2,I3 with I2 = I1 is understood too
    #[arg(long, value_name = "I1,I3", allow_hyphen_values = true)]
    moments: Option<String>,
}

impl CoinArgs {
    /// The coin, if one was asked for.
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

/// A coin and its launch.
#[derive(Debug, Args)]
pub(crate) struct TossArgs {
    #[command(flatten)]
    coin: CoinArgs,
    /// Body rate at launch, body frame (rad/s)
    #[arg(long, value_name = "WX,WY,WZ", allow_hyphen_values = true)]
    rate: Option<String>,
    /// Launch speed v0 (m/s)
    #[arg(long, value_name = "V0", allow_hyphen_values = true)]
    speed: Option<f64>,
    /// Time of flight, instead of a speed (s)
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with_all = ["speed", "gravity", "drop"])]
    time: Option<f64>,
    /// Gravity (m/s²) [default: 9.81]
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    gravity: Option<f64>,
    /// How far below the launch the coin lands; negative: above it (m) [default: 0]
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    drop: Option<f64>,
    /// Attitude at launch: a turn about the lab's x axis (rad)
    #[arg(long, value_name = "B", allow_hyphen_values = true, default_value_t = 0.0)]
    tilt: f64,
    /// Outside the model, and refused with the reason
    #[arg(long, value_name = "C", allow_hyphen_values = true)]
    drag: Option<String>,
    /// Outside the model, and refused with the reason
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    bounce: Option<String>,
}

impl TossArgs {
    /// `space` for the coin that was given, if one was.
    pub(crate) fn with_coin(&self, space: Space) -> Result<Space, Failure> {
        Ok(self.coin.given()?.map_or(space, |coin| space.with_coin(coin)))
    }

    pub(crate) fn toss(&self) -> Result<Toss, Failure> {
        if self.drag.is_some() {
            return Err(NO_DRAG.into());
        }
        if self.bounce.is_some() {
            return Err(NO_BOUNCE.into());
        }
        let coin = self.coin.given()?.unwrap_or(Coin::PAPER);
        let rate = self.rate.as_deref().ok_or_else(|| Failure::Usage("--rate WX,WY,WZ is needed".to_owned()))?;
        let rate = Vector3::from(numbers("rate", rate, "WX,WY,WZ [rad/s]")?);
        let time_of_flight = match (self.speed, self.time) {
            (_, Some(time)) => TimeOfFlight::Given(time),
            (Some(speed), None) => TimeOfFlight::thrown(speed, self.gravity.unwrap_or(DEFAULT_GRAVITY), self.drop),
            (None, None) => return Err(Failure::Usage("one of --speed and --time is needed".to_owned())),
        };
        let launch = Launch::new(rate, time_of_flight)?.with_tilt(self.tilt)?;
        Ok(Toss { coin, launch })
    }
}

/// One toss, and the solver with its method of integration.
#[derive(Debug, Args)]
pub(crate) struct FlightArgs {
    #[command(flatten)]
    toss: TossArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Method of integration: dop853, dopri5, rk4 or, by the quaternion, taylor
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    method: String,
}

impl FlightArgs {
    pub(crate) fn parts(&self) -> Result<(Toss, Box<dyn Solver>), Failure> {
        Ok((self.toss.toss()?, self.solver.solver(&self.method)?))
    }
}

/// The solver of many launches, where `--method` is how they are sampled.
#[derive(Debug, Args)]
pub(crate) struct SamplingSolverArgs {
    #[command(flatten)]
    solver: SolverArgs,
    /// Method of integration of the solver: dop853, dopri5, rk4 or, by the quaternion, taylor
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    scheme: String,
}

impl SamplingSolverArgs {
    pub(crate) fn solver(&self) -> Result<Box<dyn Solver>, Failure> {
        self.solver.solver(&self.scheme)
    }
}

#[derive(Debug, Args)]
struct SolverArgs {
    /// The solver: exact, gamma, euler or quaternion
    #[arg(long, value_name = "NAME", default_value = "exact")]
    solver: String,
    /// Local error per step, absolute and relative (dop853, dopri5, taylor) [default: 1e-10]
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Step of rk4 (s) [default: 0.001]
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// Set-up of the kinematics: momentum, where no flight is singular; vertical, as the paper has it, with typed errors; or
    /// raw, as the paper prints it, where an answer may be wrong
    #[arg(long, value_name = "NAME", alias = "frame", default_value = "momentum")]
    formulation: String,
}

impl SolverArgs {
    /// The solver, with the scheme called `scheme`.
    fn solver(&self, scheme: &str) -> Result<Box<dyn Solver>, Failure> {
        let entry = named_solver(&self.solver)?;
        let scheme = Scheme::named(scheme)?;
        entry.require_scheme(scheme)?;
        let formulation = Formulation::named(&self.formulation)?;
        Ok(entry.solver(&Settings { method: self.method(scheme)?, formulation })?)
    }

    fn method(&self, scheme: Scheme) -> Result<Method, Failure> {
        match (scheme.is_adaptive(), self.tolerance, self.step) {
            (true, tolerance, None) => Ok(Method::adaptive(scheme, tolerance.unwrap_or(Method::DEFAULT_TOLERANCE))?),
            (false, None, step) => Ok(Method::fixed(scheme, step.unwrap_or(Method::DEFAULT_STEP))?),
            (true, _, Some(_)) => {
                Err(Failure::Usage(format!("--step is for rk4; {} takes --tolerance", scheme.name())))
            }
            (false, Some(_), _) => Err(Failure::Usage(format!("--tolerance: {} takes --step", scheme.name()))),
        }
    }
}
