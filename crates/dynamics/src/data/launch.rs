//! Launches and times of flight as plain data.

use numerics::{Angle, AngleUnit};
use serde::de::{Error, IgnoredAny};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number::{Number, exactly, twice};
use super::{NO_BOUNCE, NO_DRAG};
use crate::attitude::Attitude;
use crate::error::InputError;
use crate::launch::Launch;
use crate::quantity::Dimension;
use crate::time_of_flight::{DEFAULT_GRAVITY, TimeOfFlight};

/// A launch as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LaunchData {
    rate: Rate,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gravity: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drop: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    attitude: Option<Attitude>,
    #[serde(skip_serializing)]
    drag: Option<IgnoredAny>,
    #[serde(skip_serializing)]
    bounce: Option<IgnoredAny>,
}

/// The part of a launch that gives the time of flight.
struct TimeData {
    speed: Option<Number>,
    gravity: Option<Number>,
    drop: Option<Number>,
    time: Option<Number>,
}

impl TryFrom<LaunchData> for Launch {
    type Error = InputError;

    fn try_from(data: LaunchData) -> Result<Self, InputError> {
        if data.drag.is_some() {
            return Err(NO_DRAG);
        }
        if data.bounce.is_some() {
            return Err(NO_BOUNCE);
        }
        let LaunchData { rate, speed, gravity, drop, time, .. } = data;
        let launch =
            Self::in_unit(rate.components, rate.unit, TimeData { speed, gravity, drop, time }.time_of_flight()?)?;
        match (data.tilt, data.attitude) {
            (None, None) => Ok(launch),
            (Some(tilt), None) => launch.with_tilt(tilt.given("tilt [rad]", Dimension::Angle)?.angle()),
            (None, Some(attitude)) => Ok(launch.with_attitude(attitude)),
            (Some(_), Some(_)) => Err(twice("tilt", "either tilt or attitude")),
        }
    }
}

/// A rate, whose components share a unit of angle per second. A 0 needs no unit.
struct Rate {
    components: [f64; 3],
    unit: AngleUnit,
}

/// The rate is checked as it is read, so that an error has its place in the file.
impl<'de> Deserialize<'de> for Rate {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        rate(Vec::deserialize(from)?).map_err(D::Error::custom)
    }
}

impl Serialize for Rate {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.components.map(|part| Number::in_angle_unit(part, self.unit, Dimension::TurnRate)).serialize(to)
    }
}

fn rate(numbers: Vec<Number>) -> Result<Rate, InputError> {
    const FIELD: &str = "rate [rad/s]";
    let numbers: [Number; 3] = exactly(FIELD, numbers, "three numbers")?;
    let mut unit = None;
    let mut components = [0.0; 3];
    for (component, number) in components.iter_mut().zip(&numbers) {
        let given = number.given(FIELD, Dimension::TurnRate)?;
        *component = given.value();
        let own = given.unit().angle_unit();
        if given.value() != 0.0 && *unit.get_or_insert(own) != own {
            let expected = "three numbers in one unit";
            return Err(InputError::Malformed { field: FIELD, value: format!("{numbers:?}"), expected });
        }
    }
    Ok(Rate { components, unit: unit.unwrap_or(AngleUnit::RADIAN) })
}

impl TimeData {
    fn time_of_flight(&self) -> Result<TimeOfFlight, InputError> {
        let read = |number: &Option<Number>, field, dimension: Dimension| {
            number.as_ref().map(|number| number.si(field, dimension)).transpose()
        };
        let speed = read(&self.speed, "speed [m/s]", Dimension::Speed)?;
        let gravity = read(&self.gravity, "gravity [m/s²]", Dimension::Acceleration)?;
        let drop = read(&self.drop, "drop [m]", Dimension::Length)?;
        match (speed, read(&self.time, "time [s]", Dimension::Time)?) {
            (None, None) => Err(InputError::Missing { field: "speed [m/s]", expected: "a speed, or a time of flight" }),
            (_, Some(_)) if speed.or(gravity).or(drop).is_some() => {
                Err(twice("time [s]", "a time alone, without speed, gravity and drop"))
            }
            (_, Some(time)) => Ok(TimeOfFlight::Given(time)),
            (Some(speed), None) => Ok(TimeOfFlight::thrown(speed, gravity.unwrap_or(DEFAULT_GRAVITY), drop)),
        }
    }
}

impl From<TimeOfFlight> for TimeData {
    fn from(time: TimeOfFlight) -> Self {
        let (speed, gravity, drop, time) = match time {
            TimeOfFlight::Ballistic { speed, gravity } => (Some(speed), Some(gravity), None, None),
            TimeOfFlight::BallisticTo { speed, gravity, drop } => (Some(speed), Some(gravity), Some(drop), None),
            TimeOfFlight::Given(time) => (None, None, None, Some(time)),
        };
        let [speed, gravity, drop, time] = [speed, gravity, drop, time].map(|number| number.map(Number::Si));
        Self { speed, gravity, drop, time }
    }
}

impl From<Launch> for LaunchData {
    fn from(launch: Launch) -> Self {
        let TimeData { speed, gravity, drop, time } = launch.time_of_flight().into();
        let (given, unit) = launch.given_rate();
        let has_name = Number::in_angle_unit(0.0, unit, Dimension::TurnRate).is_some();
        let (components, unit) = if has_name { (given, unit) } else { (launch.rate(), AngleUnit::RADIAN) };
        let rate = Rate { components: components.into(), unit };
        let tilt = launch.attitude().tilt().and_then(tilt);
        let attitude = if tilt.is_some() { None } else { Some(launch.attitude()) };
        Self { rate, speed, gravity, drop, time, tilt, attitude, drag: None, bounce: None }
    }
}

/// A tilt in its own unit; `None` if the unit has no name.
pub(super) fn tilt(angle: Angle) -> Option<Number> {
    let (size, unit) = match angle {
        Angle::Radians(size) => (size, AngleUnit::Radians(size.unit())),
        Angle::Turns(size) => (size, AngleUnit::Turns(size.unit())),
    };
    Number::in_angle_unit(size.value(), unit, Dimension::Angle)
}
