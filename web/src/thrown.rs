//! A scene: the body and its launch as texts, with or without units, which is how a person types them and how the address
//! of the page holds them. Its keys are the options of the command line.

use dynamics::quantity::{Given, NamedUnit};
use dynamics::rate_of_precession;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use exact::certified::holds_within;
use sampling::Space;
use serde::Deserialize;
use toss::catalogue::named_coin;
use toss::{AngleUnit, Body, Coin, Dimension, InputError, Launch, RigidToss, TimeOfFlight, Toss, Vector3};

use crate::failure::Failure;

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
    pub(crate) toss: RigidToss,
    /// A turn of the launch about the x axis of LF (rad).
    pub(crate) tilt: f64,
    rounding: Rounding,
}

/// What the conversion of units has rounded.
#[derive(Debug, Clone, Copy)]
struct Rounding {
    is_time: bool,
    is_other: bool,
}

const RATES: [&str; 3] = ["rate x [rad/s]", "rate y [rad/s]", "rate z [rad/s]"];
const MOMENTS: &str = "I1,I3 or I1,I2,I3 [kg m²], or each with a unit: kg·m², g·cm² or g·mm²";
const CYLINDER: &str = "MASS,RADIUS,THICKNESS [kg, m, m], or each with a unit: kg, g or mg, and m, cm, mm, in or ft";

impl Scene {
    /// Reads the texts.
    pub(crate) fn thrown(&self) -> Result<Thrown, Failure> {
        let (body, is_body_rounded) = self.body()?;
        let times = Times::read(self)?;
        let time = times.time_of_flight()?;
        let (launch, is_rate_rounded) = self.launch(&body, time)?;
        let tilt = self.tilt.as_deref().map(|text| Dimension::Angle.given("tilt [rad]", text)).transpose()?;
        let launch = tilt.map_or(Ok(launch), |tilt| launch.with_tilt(tilt.angle()))?;
        let rounding = Rounding { is_time: times.are_rounded(), is_other: is_body_rounded || is_rate_rounded };
        Ok(Thrown { toss: RigidToss { body, launch }, tilt: tilt.map_or(0.0, Given::si), rounding })
    }

    /// The body, and whether it is rounded from what was given.
    fn body(&self) -> Result<(Body, bool), InputError> {
        match (&self.coin, &self.cylinder, &self.moments) {
            (None, Some(text), None) => cylinder(text).map(|coin| (coin.into(), false)),
            (None, None, Some(text)) => moments(text),
            (name, None, None) => named_coin(name.as_deref().unwrap_or("paper")).map(|coin| (coin.into(), false)),
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
            Some(unit) => Ok((Launch::in_unit(given.map(Given::value), unit, time)?, false)),
            None => Ok((Launch::new(given.map(Given::si), time)?, !given.into_iter().all(Given::is_exact_in_si))),
        }
    }
}

impl Thrown {
    /// The toss of a coin; `None` of a body with I1 ≠ I2.
    pub(crate) fn coin(&self) -> Option<Toss> {
        self.toss.symmetric()
    }

    /// The toss of a coin.
    ///
    /// # Errors
    /// [`InputError::OutsideModel`] that says `why` a body with I1 ≠ I2 has none.
    pub(crate) fn require_coin(&self, why: &'static str) -> Result<Toss, InputError> {
        self.coin().ok_or(InputError::OutsideModel { field: "moments", why })
    }

    /// Whether the outcome is the same for the numbers as they were typed: `false` if units were converted and cos θ is
    /// so near to 0 that a rounding could have changed it. The rule is that of the command line.
    pub(crate) fn is_beyond_rounding(&self) -> Result<bool, Failure> {
        let Rounding { is_time, is_other } = self.rounding;
        if !is_time && !is_other {
            return Ok(true);
        }
        let is_caught_higher =
            matches!(self.toss.launch.time_of_flight(), TimeOfFlight::BallisticTo { drop, .. } if drop < 0.0);
        match self.coin() {
            // With u = 2^-53, conversions change the rates by up to 8 u of themselves, k by 3 u and T by 4 u; but that of
            // a landing near the top of the flight without a bound.
            Some(toss) if !(is_time && is_caught_higher) => Ok(holds_within(&toss, 4.0 * f64::EPSILON)?),
            _ => Ok(false),
        }
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
    /// [`InputError`] for a body with I1 ≠ I2, and for a time of flight that does not come from a speed.
    pub(crate) fn space(&self) -> Result<Space, InputError> {
        const WHY: &str = "probabilities are computed for bodies with I1 = I2";
        let Toss { coin, launch } = self.require_coin(WHY)?;
        let missing = missing("speed [m/s]", "a speed in place of the time of flight: a hand varies in its speed");
        let (speed, gravity, drop) = self.thrown_up().ok_or(missing)?;
        let rate = launch.rate();
        let space = Space::builder(coin).rate_x(rate.x).rate_y(rate.y).rate_z(rate.z).speed(speed).gravity(gravity);
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
    let coin = body.symmetric().ok_or(InputError::OutsideModel { field: "wobble [rad]", why: WHY })?;
    rate_of_precession(&coin, turn, wobble)
}

/// The unit of all components; one that is 0 may have any. `None` if they differ.
fn common_unit(components: &[Given; 3]) -> Option<AngleUnit> {
    let mut units = components.iter().filter(|given| given.value() != 0.0).map(|given| given.unit());
    let Some(first) = units.next() else { return Some(AngleUnit::RADIAN) };
    units.all(|unit: NamedUnit| unit == first).then(|| first.angle_unit())
}

fn cylinder(text: &str) -> Result<Coin, InputError> {
    let malformed = || malformed("cylinder", text, CYLINDER);
    let of = [Dimension::Mass, Dimension::Length, Dimension::Length];
    let parts: Vec<&str> = text.split(',').collect();
    let parts: [&str; 3] = parts.try_into().map_err(|_| malformed())?;
    let [mass, radius, thickness] = [0, 1, 2].map(|index| of[index].given("cylinder", parts[index]));
    let quantity = |given: Result<Given, InputError>| given.map(Given::quantity).map_err(|_| malformed());
    Coin::from_cylinder(quantity(mass)?, quantity(radius)?, quantity(thickness)?)
}

/// The body with these moments, and whether it is rounded from what was given.
fn moments(text: &str) -> Result<(Body, bool), InputError> {
    let malformed = || malformed("moments", text, MOMENTS);
    let read = |part: &str| Dimension::Inertia.given("moments", part).map_err(|_| malformed());
    let given: Vec<Given> = text.split(',').map(read).collect::<Result<_, _>>()?;
    let is_rounded = !given.iter().all(|given| given.is_exact_in_si());
    let moments: Vec<f64> = given.into_iter().map(Given::si).collect();
    let body = match moments[..] {
        [i1, i3] => Coin::from_moments(i1, i3)?.into(),
        [i1, i2, i3] => Body::from_moments([i1, i2, i3])?,
        _ => return Err(malformed()),
    };
    Ok((body, is_rounded))
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
