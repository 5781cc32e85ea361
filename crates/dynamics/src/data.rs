//! Reading and writing of coins and launches with serde. Input is first read into plain structs and then converted by
//! the constructors of [`Coin`] and [`Launch`], so that a file cannot make an invalid value.
//!
//! ```toml
//! coin = "us-quarter"              # or { moments = [I1, I3] } or { cylinder = [mass, radius, thickness] };
//!                                  # the paper's coin if not given
//! [launch]
//! rate = [1.0, 1.0, 2.5]           # rad/s, BF
//! speed = 3.0                      # m/s; or time = 0.6, s
//! gravity = 9.81                   # m/s²; this and the next two are the defaults
//! drop = 0.0                       # m, how far below its launch the coin lands
//! tilt = 0.0                       # rad; or attitude = [w, x, y, z]
//! ```
//!
//! Drag and bounce are outside the model. They are fields of a launch nevertheless, so that they are refused with the
//! reason instead of as an "unknown field".

use std::fmt;

use nalgebra::Vector3;
use numerics::{Angle, Quantity};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::attitude::Attitude;
use crate::catalogue::named_coin;
use crate::coin::Coin;
use crate::error::InputError;
use crate::launch::Launch;
use crate::time_of_flight::{DEFAULT_GRAVITY, TimeOfFlight};

/// Why drag is refused.
pub const NO_DRAG: InputError = InputError::OutsideModel {
    field: "drag",
    why: "the flight is free of torque and drag, and does not approximate a flight through air",
};

/// Why bouncing is refused.
pub const NO_BOUNCE: InputError = InputError::OutsideModel {
    field: "bounce",
    why: "the flight ends at the first landing, and what the coin does on the floor is not solved",
};

/// A coin as it stands in a file, unless it is given by its name.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct CoinData {
    #[serde(skip_serializing_if = "Option::is_none")]
    moments: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder: Option<Vec<f64>>,
}

impl TryFrom<CoinData> for Coin {
    type Error = InputError;

    fn try_from(data: CoinData) -> Result<Self, InputError> {
        match (data.moments, data.cylinder) {
            (Some(moments), None) => Self::from_listed_moments(&moments),
            (None, Some(cylinder)) => {
                let [mass, radius, thickness] = exactly("cylinder [kg, m, m]", cylinder, "[mass, radius, thickness]")?;
                Self::from_cylinder(mass, radius, thickness)
            }
            (None, None) => Err(InputError::Missing { field: "coin", expected: COIN }),
            (Some(_), Some(_)) => Err(twice("coin", "either moments or cylinder")),
        }
    }
}

/// What a coin may be written as.
const COIN: &str = "a name, { moments = [I1, I3] } or { cylinder = [mass, radius, thickness] }";

/// Reads a coin by its name or from its table.
struct CoinVisitor;

impl<'de> Visitor<'de> for CoinVisitor {
    type Value = Coin;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(COIN)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Coin, E> {
        named_coin(name).map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Coin, A::Error> {
        CoinData::deserialize(MapAccessDeserializer::new(table))?.try_into().map_err(A::Error::custom)
    }
}

impl<'de> Deserialize<'de> for Coin {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(CoinVisitor)
    }
}

impl Serialize for Coin {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let cylinder = self.cylinder().map(|given| given.map(Quantity::to_f64).to_vec());
        let moments = if cylinder.is_some() { None } else { Some(vec![self.i1(), self.i3()]) };
        CoinData { moments, cylinder }.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Launch {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        LaunchData::deserialize(from)?.try_into().map_err(D::Error::custom)
    }
}

impl Serialize for Launch {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        LaunchData::from(*self).serialize(to)
    }
}

/// A launch as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LaunchData {
    #[serde(deserialize_with = "rate")]
    rate: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gravity: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drop: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<f64>,
    #[serde(default, deserialize_with = "attitude", skip_serializing_if = "Option::is_none")]
    attitude: Option<[f64; 4]>,
    #[serde(skip_serializing)]
    drag: Option<IgnoredAny>,
    #[serde(skip_serializing)]
    bounce: Option<IgnoredAny>,
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
        let launch = Self::new(Vector3::from(data.rate), data.time_of_flight()?)?;
        match (data.tilt, data.attitude) {
            (tilt, None) => launch.with_tilt(tilt.unwrap_or(0.0)),
            (None, Some(attitude)) => Ok(launch.with_attitude(Attitude::from_components(attitude)?)),
            (Some(_), Some(_)) => Err(twice("tilt", "either tilt or attitude")),
        }
    }
}

impl LaunchData {
    fn time_of_flight(&self) -> Result<TimeOfFlight, InputError> {
        let thrown = self.speed.or(self.gravity).or(self.drop);
        match (self.speed, self.time) {
            (None, None) => Err(InputError::Missing { field: "speed [m/s]", expected: "a speed, or a time of flight" }),
            (_, Some(_)) if thrown.is_some() => Err(twice("time [s]", "a time alone, without speed, gravity and drop")),
            (_, Some(time)) => Ok(TimeOfFlight::Given(time)),
            (Some(speed), None) => Ok(TimeOfFlight::thrown(speed, self.gravity.unwrap_or(DEFAULT_GRAVITY), self.drop)),
        }
    }
}

fn rate<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 3], D::Error> {
    exactly("rate [rad/s]", Vec::deserialize(from)?, "three numbers").map_err(D::Error::custom)
}

fn attitude<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 4]>, D::Error> {
    let given = Option::<Vec<f64>>::deserialize(from)?;
    given.map(|numbers| exactly("attitude", numbers, "four numbers")).transpose().map_err(D::Error::custom)
}

/// `numbers` if there are N of them. An array of N would be read from a longer list, the rest of which is ignored.
fn exactly<const N: usize>(
    field: &'static str,
    numbers: Vec<f64>,
    expected: &'static str,
) -> Result<[f64; N], InputError> {
    let malformed = |numbers| InputError::Malformed { field, value: format!("{numbers:?}"), expected };
    numbers.try_into().map_err(malformed)
}

/// The error of a quantity that is given by two fields.
fn twice(field: &'static str, expected: &'static str) -> InputError {
    InputError::Malformed { field, value: "given twice".to_owned(), expected }
}

impl From<Launch> for LaunchData {
    fn from(launch: Launch) -> Self {
        let (mut speed, mut gravity, mut drop, mut time) = (None, None, None, None);
        match launch.time_of_flight() {
            TimeOfFlight::Ballistic { speed: v, gravity: g } => (speed, gravity) = (Some(v), Some(g)),
            TimeOfFlight::BallisticTo { speed: v, gravity: g, drop: h } => {
                (speed, gravity, drop) = (Some(v), Some(g), Some(h));
            }
            TimeOfFlight::Given(t) => time = Some(t),
        }
        let tilt = launch.attitude().tilt().map(Angle::radians);
        let attitude = if tilt.is_some() { None } else { Some(launch.attitude().given_components()) };
        Self { rate: launch.rate().into(), speed, gravity, drop, time, tilt, attitude, drag: None, bounce: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::launch::Toss;

    fn read(text: &str) -> Result<Toss, String> {
        toml::from_str(text).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn a_toss_is_read_with_its_defaults() {
        let toss = read("[launch]\nrate = [1.0, 1.0, 2.5]\nspeed = 3").unwrap();
        assert_eq!(toss.coin, Coin::PAPER);
        assert_eq!(toss.launch.time_of_flight(), TimeOfFlight::Ballistic { speed: 3.0, gravity: DEFAULT_GRAVITY });
        assert_eq!(toss.launch.attitude(), Attitude::IDENTITY);
        let toss = read("coin = 'disc'\n[launch]\nrate = [1, 1, 2.5]\ntime = 3\ntilt = 0.5").unwrap();
        assert_eq!((toss.coin, toss.launch.flight_time()), (Coin::DISC, 3.0));
        assert_eq!(toss.launch.attitude(), Attitude::about_x(0.5));
    }

    #[test]
    fn a_toss_that_was_written_is_read_back() {
        let thrown = [
            TimeOfFlight::Given(0.3),
            TimeOfFlight::thrown(3.1, 9.78, None),
            TimeOfFlight::thrown(3.1, 9.78, Some(-0.2)),
        ];
        for time in thrown {
            let launch = Launch::new(Vector3::new(0.1, -7.0, 1e-300), time).unwrap().with_tilt(1.1).unwrap();
            let attitude = Attitude::from_components([0.3, -7.0, 0.5, 4e-5]).unwrap();
            let coins = [Coin::from_moments(0.3, 0.1), Coin::from_cylinder(0.003, 0.01874, 0.00114)];
            for (coin, launch) in coins.into_iter().zip([launch, launch.with_attitude(attitude)]) {
                let toss = Toss { coin: coin.unwrap(), launch };
                assert_eq!(read(&toml::to_string(&toss).unwrap()), Ok(toss));
            }
        }
    }

    #[test]
    fn invalid_input_is_refused_with_the_field_at_fault() {
        let launch = "[launch]\nrate = [1, 1, 2]\nspeed = 3\n";
        for (text, message) in [
            (format!("coin = {{ moments = [1, 1.1, 2] }}\n{launch}"), "moments [kg m²] is outside the model: "),
            (format!("coin = {{ moments = [1, 1, 3] }}\n{launch}"), "I3 [kg m²] = 3.0 is outside its valid range"),
            (format!("coin = {{ moments = [1] }}\n{launch}"), "moments [kg m²] = '[1.0]' can't be used"),
            (format!("{launch}drag = 0.4"), "drag is outside the model: the flight is free of torque and drag"),
            (format!("{launch}bounce = true"), "bounce is outside the model: the flight ends at the first landing"),
            (format!("{launch}time = 3"), "time [s] = 'given twice' can't be used"),
            (format!("{launch}tilt = 1\nattitude = [1, 0, 0, 0]"), "tilt = 'given twice' can't be used"),
            (format!("{launch}attitude = [0, 0, 0, 0]"), "attitude (largest component) = 0.0"),
            (format!("{launch}drop = -1"), "drop [m] = -1.0 is outside its valid range"),
            (format!("{launch}wind = 3"), "unknown field `wind`"),
            (
                format!("coin = {{ moments = [1, 1], cylinder = [1, 1, 1] }}\n{launch}"),
                "coin = 'given twice' can't be used: expected either moments or cylinder",
            ),
            (format!("coin = {{ moments = [1, 1], mass = 1 }}\n{launch}"), "unknown field `mass`"),
            (format!("coin = {{ cylinder = [1, 1, 1, 1] }}\n{launch}"), "cylinder [kg, m, m] = '[1.0, 1.0, 1.0, 1.0]'"),
            (format!("coin = {{ }}\n{launch}"), "coin is missing: expected a name, { moments = [I1, I3] }"),
            (format!("coin = 3\n{launch}"), "invalid type: integer `3`, expected a name, { moments"),
            (format!("{launch}attitude = [1, 0, 0, 0, 0]"), "attitude = '[1.0, 0.0, 0.0, 0.0, 0.0]'"),
            ("[launch]\nrate = [1, 1, 2, 9]\nspeed = 3".to_owned(), "rate [rad/s] = '[1.0, 1.0, 2.0, 9.0]'"),
            ("[launch]\nrate = [1, 1]\nspeed = 3".to_owned(), "rate [rad/s] = '[1.0, 1.0]'"),
            ("[launch]\nrate = [1, 1, 2]".to_owned(), "speed [m/s] is missing"),
        ] {
            let found = read(&text).unwrap_err();
            assert!(found.starts_with(message), "'{found}' for '{text}'");
        }
        assert!(read(&format!("coin = {{ moments = [1, 1, 2] }}\n{launch}")).is_ok());
    }
}
