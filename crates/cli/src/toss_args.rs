//! The options that describe one toss: the body, its rate and its launch, and for a flight also the solver. The rate is given by
//! its components, or by what can be seen of a toss: how fast the coin's normal n turns, and its angle ψ to the angular momentum
//! S. The commands about single tosses share these options.

use clap::Args;
use dynamics::data::{NO_BOUNCE, NO_DRAG};
use dynamics::quantity::{Given, common_unit};
use dynamics::rate_of_precession;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use toss::quantity::{BodyRounding, Dimension, Rounding};
use toss::{Backend, Body, Coin, InputError, Launch, Registry, TimeOfFlight, Toss, Vector3};

use crate::failure::Failure;
use crate::quantity;
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
    /// The body; the paper's coin if none of the options was given.
    pub(crate) fn body(&self) -> Result<Body, Failure> {
        Ok(self.given()?.unwrap_or(Coin::PAPER.into()))
    }

    /// The body, if one of the options was given.
    pub(crate) fn given(&self) -> Result<Option<Body>, Failure> {
        let named = |source: InputError| Failure::value(self.option(), source);
        if let Some(text) = &self.cylinder {
            let [mass, radius, thickness] = quantity::listed("cylinder", text)?.map(Given::quantity);
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

    /// The coin, for what is a formula of long flights. A body with I1 ≠ I2 is refused.
    pub(crate) fn coin(&self) -> Result<Coin, Failure> {
        let why = "the limit of long flights is a formula for coins; probability estimates P(heads)";
        let option = self.option();
        let refused = || Failure::usage(option, format!("--{option}: this body has I1 ≠ I2, and {why}"));
        self.body()?.coin().ok_or_else(refused)
    }

    /// The moments or the elements of the tensor as they were given.
    fn elements(&self) -> Result<Option<Vec<Given>>, InputError> {
        let given = self.moments.as_ref().or(self.inertia.as_ref());
        given.and_then(|text| quantity::list(self.option(), text)).transpose()
    }

    /// The body with these moments or elements of the tensor, in any unit: they decide its motion by their ratios.
    fn of_elements(&self, elements: Vec<f64>) -> Result<Body, InputError> {
        match <[f64; 6]>::try_from(elements) {
            Ok(elements) if self.inertia.is_some() => Body::from_inertia(elements),
            Ok(elements) => Body::from_listed_moments(&elements),
            Err(elements) => Body::from_listed_moments(&elements),
        }
    }

    /// How the body is rounded from what was given.
    fn rounding(&self) -> Result<BodyRounding, InputError> {
        Ok(BodyRounding::of(&self.elements()?.unwrap_or_default(), |elements| self.of_elements(elements)))
    }
}

/// Options for the rate at which the normal turns, and its angle to the angular momentum.
#[derive(Debug, Args)]
pub(crate) struct TurnArgs {
    /// Rate |S|/I1 at which the normal n turns about the angular momentum S; with --wobble in place of the body rate. It
    /// stands for ωx = RATE sin ψ, ωy = 0 and ωz = RATE cos ψ I1/I3
    #[arg(long, value_name = "RATE", allow_hyphen_values = true, requires = "wobble",
          value_parser = quantity::given(Dimension::TurnRate))]
    turn: Option<Given>,
    /// Angle ψ between n and S, from 0 to 180deg; with --turn
    #[arg(long, value_name = "PSI", allow_hyphen_values = true, requires = "turn",
          value_parser = quantity::given(Dimension::Angle))]
    wobble: Option<Given>,
}

impl TurnArgs {
    /// The body rate (rad/s) of `body`, if these options were given.
    pub(crate) fn rate(&self, body: &Body) -> Result<Option<Vector3<f64>>, Failure> {
        let (Some(turn), Some(wobble)) = (self.turn, self.wobble) else { return Ok(None) };
        let uneven =
            || Failure::usage("turn", "--turn: n of a body with I1 ≠ I2 turns unevenly; use the body rate instead");
        let coin = body.coin().ok_or_else(uneven)?;
        Ok(Some(rate_of_precession(&coin, turn.si(), wobble.si())?))
    }

    /// Whether the rates are given by these options.
    pub(crate) fn is_given(&self) -> bool {
        self.turn.is_some()
    }

    /// What was typed, for the title of a chart.
    pub(crate) fn words(&self) -> Option<String> {
        Some(format!("n turns at {}, ψ = {}", shown(self.turn?), shown(self.wobble?)))
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
    /// The launch of `body` with this body rate. Components in one unit are not converted, so that proofs start from them.
    pub(crate) fn launch(&self, body: &Body, time_of_flight: TimeOfFlight) -> Result<Launch, Failure> {
        if let Some(rate) = self.turn.rate(body)? {
            return Ok(Launch::new(rate, time_of_flight)?);
        }
        let components = self.components()?;
        let launch = match common_unit(&components) {
            Some(unit) => Launch::in_unit(components.map(Given::value), unit.angle_unit(), time_of_flight),
            None => Launch::new(components.map(Given::si), time_of_flight),
        };
        Ok(launch?)
    }

    /// Whether the rate of [`RateArgs::launch`] is rounded from what was given.
    fn is_rounded(&self) -> Result<bool, Failure> {
        if self.rate.is_none() {
            return Ok(true);
        }
        let components = self.components()?;
        Ok(common_unit(&components).is_none() && !components.into_iter().all(Given::is_exact_in_si))
    }

    /// What was typed, for the title of a chart.
    fn words(&self) -> Option<String> {
        let components = self.components().ok()?;
        let list = |number: fn(Given) -> String| components.map(number).join(", ");
        Some(match common_unit(&components) {
            Some(unit) => format!("ω = ({}) {}", list(|given| given.value().to_string()), unit.name()),
            None => format!("ω = ({})", list(shown)),
        })
    }

    fn components(&self) -> Result<[Given; 3], Failure> {
        let missing = || Failure::usage("rate", "--rate WX,WY,WZ is needed, or --turn RATE with --wobble PSI");
        Ok(quantity::listed("rate", self.rate.as_ref().ok_or_else(missing)?)?)
    }
}

/// Options for a coin and its launch.
#[derive(Debug, Args)]
pub(crate) struct TossArgs {
    #[command(flatten)]
    pub(crate) coin: CoinArgs,
    #[command(flatten)]
    pub(crate) rate: RateArgs,
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
    pub(crate) tilt: Option<Given>,
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
        let body = self.coin.body()?;
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

    /// The launch in the units in which it was typed, for the title of a chart.
    pub(crate) fn words(&self) -> String {
        let tilted = self.tilt.filter(|tilt| tilt.si() != 0.0);
        let tilt = tilted.map_or_else(|| "horizontally".to_owned(), |tilt| format!("at a tilt of {}", shown(tilt)));
        let rate = self.rate.turn.words().or_else(|| self.rate.words()).unwrap_or_default();
        format!("launched {tilt}, {rate}")
    }

    /// What the conversion of units has rounded.
    pub(crate) fn rounding(&self) -> Result<Rounding, Failure> {
        let times = [self.speed, self.time, self.gravity, self.drop];
        let flight = !times.into_iter().flatten().all(Given::is_exact_in_si);
        Ok(Rounding { flight, rate: self.rate.is_rounded()?, body: self.coin.rounding()? })
    }
}

/// A quantity in the unit in which it was typed.
fn shown(given: Given) -> String {
    format!("{} {}", given.value(), given.unit().name())
}

/// Options for one toss and the solver that flies it.
#[derive(Debug, Args)]
#[command(mut_arg("scheme", |scheme| scheme.alias("method")))]
pub(crate) struct FlightArgs {
    #[command(flatten)]
    pub(crate) toss: TossArgs,
    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

impl FlightArgs {
    pub(crate) fn parts(&self, registry: &Registry) -> Result<(Toss, Backend), Failure> {
        Ok((self.toss.toss()?, self.solver.backend(registry)?))
    }
}
