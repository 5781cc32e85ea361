//! The options that describe one toss: the coin and the launch, and for a flight also the solver. The commands about
//! single tosses share them.

use clap::Args;
use dynamics::data::{NO_BOUNCE, NO_DRAG};
use dynamics::quantity::Given;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use toss::{
    Backend, Body, BodyRounding, Coin, Dimension, InputError, QuaternionSolver, Registry, Rounding, TimeOfFlight, Toss,
};

use crate::failure::Failure;
use crate::quantity;
use crate::rate_args::RateArgs;
use crate::solver_args::SolverArgs;

/// Options for a coin or another rigid body.
#[derive(Debug, Args)]
#[group(multiple = false)]
pub(crate) struct CoinArgs {
    /// A coin or another body of the catalogue, which `coins` lists [default: paper]
    #[arg(long, value_name = "NAME")]
    coin: Option<String>,
    /// A homogeneous cylinder as a coin: kg, m and m, or each with a unit
    #[arg(long, value_name = "MASS,RADIUS,THICKNESS", allow_hyphen_values = true)]
    cylinder: Option<String>,
    /// Moments of inertia about a diameter and about the normal, or I1,I2,I3 about the axes x, y and z = n of any body:
    /// kg m², or each with a unit such as g·cm²
    #[arg(long, value_name = "I1,I3", allow_hyphen_values = true)]
    moments: Option<String>,
    /// Inertia tensor of any body about its centre of mass, in axes of which z is the normal n: kg m², or each with a
    /// unit; Jxy is -∫ x y dm
    #[arg(long, value_name = "JXX,JYY,JZZ,JXY,JXZ,JYZ", allow_hyphen_values = true)]
    inertia: Option<String>,
}

impl CoinArgs {
    /// The body, if one of the options was given.
    pub(crate) fn given(&self) -> Result<Option<Body>, Failure> {
        let named = |source: InputError| Failure::value(self.option(), source);
        if let Some(text) = &self.cylinder {
            let [mass, radius, thickness] = quantity::cylinder(text)?.map(Given::quantity);
            return Coin::from_cylinder(mass, radius, thickness).map(|coin| Some(coin.into())).map_err(named);
        }
        match self.elements()? {
            Some(elements) => self.of_elements(elements.into_iter().map(Given::si).collect()).map(Some).map_err(named),
            None => Ok(self.coin.as_deref().map(str::parse).transpose()?),
        }
    }

    /// The option that gives the body.
    fn option(&self) -> &'static str {
        match (&self.cylinder, &self.moments, &self.inertia) {
            (Some(_), ..) => "cylinder",
            (_, Some(_), _) => "moments",
            (.., Some(_)) => "inertia",
            _ => "coin",
        }
    }

    /// The coin, or the paper's if none of the options was given. A body with I1 ≠ I2 is refused because of what `why`
    /// says.
    pub(crate) fn coin(&self, why: &str) -> Result<Coin, Failure> {
        let Some(body) = self.given()? else { return Ok(Coin::PAPER) };
        body.coin().ok_or_else(|| self.refused(why))
    }

    /// The error of a body with I1 ≠ I2 where a coin is needed.
    pub(crate) fn refused(&self, why: &str) -> Failure {
        let option = self.option();
        Failure::usage(option, format!("--{option}: this body has I1 ≠ I2, and {why}"))
    }

    /// The moments or the elements of the tensor as they were given.
    fn elements(&self) -> Result<Option<Vec<Given>>, InputError> {
        match (&self.moments, &self.inertia) {
            (Some(text), _) => quantity::moments(text).map(Some),
            (_, Some(text)) => quantity::inertia(text).map(|elements| Some(elements.into())),
            (None, None) => Ok(None),
        }
    }

    /// The body with these moments or elements of the tensor, in any unit: they decide its motion by their ratios.
    fn of_elements(&self, elements: Vec<f64>) -> Result<Body, InputError> {
        match (<[f64; 6]>::try_from(elements), self.inertia.is_some()) {
            (Ok(elements), true) => Body::from_inertia(elements),
            (Ok(elements), false) => Body::from_listed_moments(&elements),
            (Err(elements), _) => Body::from_listed_moments(&elements),
        }
    }

    /// How the body is rounded from what was given.
    fn rounding(&self) -> Result<BodyRounding, InputError> {
        Ok(BodyRounding::of(&self.elements()?.unwrap_or_default(), |elements| self.of_elements(elements)))
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
        let body = self.coin.given()?.unwrap_or(Coin::PAPER.into());
        let gravity = self.gravity.map_or(DEFAULT_GRAVITY, Given::si);
        let time_of_flight = match (self.speed, self.time) {
            (_, Some(time)) => TimeOfFlight::Given(time.si()),
            (Some(speed), None) => TimeOfFlight::thrown(speed.si(), gravity, self.drop.map(Given::si)),
            (None, None) => return Err(Failure::usage("speed", "one of --speed and --time is needed")),
        };
        let mut launch = self.rate.launch(&body, time_of_flight)?;
        if let Some(tilt) = self.tilt {
            launch = launch.with_tilt(tilt.angle())?;
        }
        Ok(Toss { body, launch })
    }

    /// The tilt at launch (rad).
    pub(crate) fn tilt(&self) -> f64 {
        self.tilt.map_or(0.0, Given::si)
    }

    /// What the conversion of units has rounded.
    pub(crate) fn rounding(&self) -> Result<Rounding, Failure> {
        let times = [self.speed, self.time, self.gravity, self.drop];
        let flight = !times.into_iter().flatten().all(Given::is_exact_in_si);
        Ok(Rounding { flight, rate: self.rate.is_rounded()?, body: self.coin.rounding()? })
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

    /// The solver that proves by integration.
    pub(crate) fn prover(&self, registry: &Registry) -> Result<QuaternionSolver, Failure> {
        self.solver.prover(registry)
    }

    pub(crate) fn parts(&self, registry: &Registry) -> Result<(Toss, Backend), Failure> {
        Ok((self.toss.toss()?, self.solver.backend(registry)?))
    }
}
