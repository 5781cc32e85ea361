//! A scene: the body and its launch as texts, with or without units, which is how a person types them and how the address
//! of the page holds them. Its keys are the options of the command line.

use dynamics::quantity::{Given, common_unit, read_quantities};
use dynamics::rate_of_precession;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use sampling::Space;
use serde::Deserialize;
use toss::catalogue::named_coin;
use toss::quantity::{BodyRounding, Dimension, Rounding};
use toss::{Body, Coin, CoinToss, Error, InputError, Launch, TimeOfFlight, Toss, Vector3};

/// A body and its launch as texts. Numbers without a unit are in SI units and radians.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    coin: Option<String>,
    cylinder: Option<String>,
    moments: Option<String>,
    rate: Option<[String; 3]>,
    turn: Option<String>,
    wobble: Option<String>,
    speed: Option<String>,
    time: Option<String>,
    gravity: Option<String>,
    drop: Option<String>,
    tilt: Option<String>,
}

/// The toss that a scene describes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Thrown {
    pub(crate) toss: Toss,
    /// A turn of the launch about the x axis of LF (rad).
    pub(crate) tilt: f64,
    /// What the conversion of units has rounded.
    pub(crate) rounding: Rounding,
}

const RATES: [&str; 3] = ["rate x [rad/s]", "rate y [rad/s]", "rate z [rad/s]"];
const MOMENTS: &str = "I1,I3 or I1,I2,I3 [kg m²], or each with a unit: kg·m², g·cm² or g·mm²";
const CYLINDER: &str = "MASS,RADIUS,THICKNESS [kg, m, m], or each with a unit: kg, g or mg, and m, cm, mm, in or ft";

impl Scene {
    /// Reads the texts.
    pub(crate) fn thrown(&self) -> Result<Thrown, Error> {
        let (body, body_rounding) = self.body()?;
        let times = Times::read(self)?;
        let time = times.time_of_flight()?;
        let (launch, is_rate_rounded) = self.launch(&body, time)?;
        let tilt = self.tilt.as_deref().map(|text| Dimension::Angle.given("tilt [rad]", text)).transpose()?;
        let launch = tilt.map_or(Ok(launch), |tilt| launch.with_tilt(tilt.angle()))?;
        let rounding = Rounding { flight: times.are_rounded(), rate: is_rate_rounded, body: body_rounding };
        Ok(Thrown { toss: Toss { body, launch }, tilt: tilt.map_or(0.0, Given::si), rounding })
    }

    /// The body, and how it is rounded from what was given.
    fn body(&self) -> Result<(Body, BodyRounding), InputError> {
        let exact = |coin: Coin| (coin.into(), BodyRounding::Exact);
        match (&self.coin, &self.cylinder, &self.moments) {
            (None, Some(text), None) => cylinder(text).map(exact),
            (None, None, Some(text)) => moments(text),
            (name, None, None) => named_coin(name.as_deref().unwrap_or("paper")).map(exact),
            _ => Err(twice("coin", "one of coin, cylinder and moments")),
        }
    }

    /// The launch from horizontal, and whether its rate is rounded from what was given.
    fn launch(&self, body: &Body, time: TimeOfFlight) -> Result<(Launch, bool), InputError> {
        let texts = match (&self.rate, &self.turn, &self.wobble) {
            (Some(texts), None, None) => texts,
            (None, Some(turn), Some(wobble)) => {
                return Ok((Launch::new(precessing(body, turn, wobble)?, time)?, true));
            }
            (None, None, None) => return Err(missing("rate", "a rate, or turn with wobble")),
            _ => return Err(twice("rate", "either a rate, or turn with wobble")),
        };
        let [x, y, z] = [0, 1, 2].map(|axis| Dimension::TurnRate.given(RATES[axis], &texts[axis]));
        let given = [x?, y?, z?];
        match common_unit(&given) {
            Some(unit) => Ok((Launch::in_unit(given.map(Given::value), unit.angle_unit(), time)?, false)),
            None => Ok((Launch::new(given.map(Given::si), time)?, !given.into_iter().all(Given::is_exact_in_si))),
        }
    }
}

impl Thrown {
    /// The toss of a coin; `None` of a body with I1 ≠ I2.
    pub(crate) fn coin(&self) -> Option<CoinToss> {
        self.toss.coin()
    }

    /// The speed (m/s), gravity (m/s²) and drop (m) of a coin that is thrown up; `None` if the time of flight was given.
    pub(crate) fn thrown_up(&self) -> Option<(f64, f64, Option<f64>)> {
        match self.toss.launch.time_of_flight() {
            TimeOfFlight::Ballistic { speed, gravity } => Some((speed, gravity, None)),
            TimeOfFlight::BallisticTo { speed, gravity, drop } => Some((speed, gravity, Some(drop))),
            TimeOfFlight::Given(_) => None,
        }
    }

    /// The space that consists of this toss alone.
    ///
    /// # Errors
    /// [`InputError`] for a time of flight that does not come from a speed.
    pub(crate) fn space(&self) -> Result<Space, InputError> {
        let Toss { body, launch } = self.toss;
        let missing = missing("speed [m/s]", "a speed in place of the time of flight: a hand varies in its speed");
        let (speed, gravity, drop) = self.thrown_up().ok_or(missing)?;
        let rate = launch.rate();
        let space = Space::builder(body).rate_x(rate.x).rate_y(rate.y).rate_z(rate.z).speed(speed).gravity(gravity);
        space.tilt(self.tilt).build()?.with_drop(drop)
    }
}

/// What the time of flight follows from.
struct Times {
    speed: Option<Given>,
    time: Option<Given>,
    gravity: Option<Given>,
    drop: Option<Given>,
}

impl Times {
    fn read(scene: &Scene) -> Result<Self, InputError> {
        let read = |text: &Option<String>, field, dimension: Dimension| {
            text.as_deref().map(|text| dimension.given(field, text)).transpose()
        };
        Ok(Self {
            speed: read(&scene.speed, "speed [m/s]", Dimension::Speed)?,
            time: read(&scene.time, "time [s]", Dimension::Time)?,
            gravity: read(&scene.gravity, "gravity [m/s²]", Dimension::Acceleration)?,
            drop: read(&scene.drop, "drop [m]", Dimension::Length)?,
        })
    }

    fn time_of_flight(&self) -> Result<TimeOfFlight, InputError> {
        let gravity = self.gravity.map_or(DEFAULT_GRAVITY, Given::si);
        match (self.speed, self.time) {
            (None, None) => Err(missing("speed [m/s]", "a speed, or a time of flight")),
            (_, Some(_)) if self.speed.or(self.gravity).or(self.drop).is_some() => {
                Err(twice("time [s]", "a time alone, without speed, gravity and drop"))
            }
            (_, Some(time)) => Ok(TimeOfFlight::Given(time.si())),
            (Some(speed), None) => Ok(TimeOfFlight::thrown(speed.si(), gravity, self.drop.map(Given::si))),
        }
    }

    fn are_rounded(&self) -> bool {
        let all = [self.speed, self.time, self.gravity, self.drop];
        !all.into_iter().flatten().all(Given::is_exact_in_si)
    }
}

/// The rate (BF, rad/s) of a body with I1 = I2 that precesses like this.
fn precessing(body: &Body, turn: &str, wobble: &str) -> Result<Vector3<f64>, InputError> {
    const WHY: &str = "a body with I1 ≠ I2 does not precess evenly: give it a rate instead";
    let turn = Dimension::TurnRate.read("turn [rad/s]", turn)?;
    let wobble = Dimension::Angle.read("wobble [rad]", wobble)?;
    let coin = body.coin().ok_or(InputError::OutsideModel { field: "wobble [rad]", why: WHY })?;
    rate_of_precession(&coin, turn, wobble)
}

fn cylinder(text: &str) -> Result<Coin, InputError> {
    let given = quantities("cylinder", text, CYLINDER, &[Dimension::Mass, Dimension::Length, Dimension::Length])?;
    let [mass, radius, thickness] = [0, 1, 2].map(|index| given[index].quantity());
    Coin::from_cylinder(mass, radius, thickness)
}

/// The body with these moments, and how it is rounded from what was given.
fn moments(text: &str) -> Result<(Body, BodyRounding), InputError> {
    let number = text.split(',').count().clamp(2, 3);
    let given = quantities("moments", text, MOMENTS, &[Dimension::Inertia; 3][..number])?;
    let body = |moments: Vec<f64>| Body::from_listed_moments(&moments);
    Ok((body(given.iter().map(|given| given.si()).collect())?, BodyRounding::of(&given, body)))
}

/// Quantities of these kinds, separated by commas.
fn quantities(
    field: &'static str,
    text: &str,
    expected: &'static str,
    dimensions: &[Dimension],
) -> Result<Vec<Given>, InputError> {
    let parts: Vec<_> = dimensions.iter().copied().zip(text.split(',')).collect();
    if text.split(',').count() != dimensions.len() {
        return Err(malformed(field, text, expected));
    }
    read_quantities(field, text, expected, &parts)
}

pub(crate) fn malformed(field: &'static str, text: &str, expected: &'static str) -> InputError {
    InputError::Malformed { field, value: text.to_owned(), expected }
}

fn missing(field: &'static str, expected: &'static str) -> InputError {
    InputError::Missing { field, expected }
}

fn twice(field: &'static str, expected: &'static str) -> InputError {
    malformed(field, "given twice", expected)
}
