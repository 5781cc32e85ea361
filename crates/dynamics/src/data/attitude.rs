//! Attitudes as plain data. An attitude is written by what it was made from, so that it is read
//! back as the same one.

use std::fmt;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::launch::tilt;
use super::number::{Number, exactly, twice};
use crate::attitude::Attitude;
use crate::error::{InputError, require};
use crate::quantity::Dimension;

/// An attitude as it stands in a file, unless it is a list of components.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct AttitudeData {
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit_quaternion: Option<Vec<f64>>,
}

/// What an attitude may be written as.
const ATTITUDE: &str = "[w, x, y, z], { tilt = ANGLE } or { unit_quaternion = [w, x, y, z] }";

impl TryFrom<AttitudeData> for Attitude {
    type Error = InputError;

    fn try_from(data: AttitudeData) -> Result<Self, InputError> {
        match (data.tilt, data.unit_quaternion) {
            (Some(tilt), None) => {
                let angle = tilt.given("tilt [rad]", Dimension::Angle)?.angle();
                require("tilt [rad]", angle.radians(), "finite", true)?;
                Ok(Self::about_x(angle))
            }
            (None, Some(components)) => {
                Self::from_unit_components(exactly("unit_quaternion", components, "four numbers")?)
            }
            (None, None) => Err(InputError::Missing { field: "attitude", expected: ATTITUDE }),
            (Some(_), Some(_)) => Err(twice("attitude", "either tilt or unit_quaternion")),
        }
    }
}

/// Reads an attitude from its list or from its table.
struct AttitudeVisitor;

impl<'de> Visitor<'de> for AttitudeVisitor {
    type Value = Attitude;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(ATTITUDE)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Attitude, A::Error> {
        let components = Vec::deserialize(SeqAccessDeserializer::new(list))?;
        let components = exactly("attitude", components, "four numbers");
        components.and_then(Attitude::from_components).map_err(A::Error::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Attitude, A::Error> {
        AttitudeData::deserialize(MapAccessDeserializer::new(table))?.try_into().map_err(A::Error::custom)
    }
}

impl<'de> Deserialize<'de> for Attitude {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AttitudeVisitor)
    }
}

impl Serialize for Attitude {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let tilt = self.tilt().and_then(tilt);
        let given = self.given_components();
        if tilt.is_none() && Self::from_components(given).is_ok_and(|same| same == *self) {
            return given.serialize(to);
        }
        // Dividing by a norm that is 1 to rounding can change the last bits.
        let unit_quaternion = if tilt.is_some() { None } else { Some(self.components().to_vec()) };
        AttitudeData { tilt, unit_quaternion }.serialize(to)
    }
}
