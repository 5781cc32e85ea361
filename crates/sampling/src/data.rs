//! Plans as plain data, for configuration files and records. What is read is checked like what a program makes.
//!
//! ```toml
//! method = "sobol"        # or grid; random; exact-speed, which without points takes the grid of the other coordinates
//! points = 262144
//! scrambles = 8           # this and the seed are the defaults
//! seed = 1
//! ```
//! An enclosure has an `accuracy` instead of these numbers.

use dynamics::InputError;
use dynamics::error::require;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::coordinate::Coordinate;
use crate::enclosure::require_accuracy;
use crate::plan::{Method, Plan, Rest, SCRAMBLES, SEED, Scrambled};

/// Seeds as plain data: a number or its digits as a text. A seed above 2^53 is written as a text, because many readers of JSON
/// round such numbers, and TOML has none above 2^63.
mod seed {
    use dynamics::quantity::read_count;

    use super::{Deserialize, Deserializer, Error, Serializer};

    const LARGEST_NUMBER: u64 = 1 << 53;

    #[derive(serde::Deserialize)]
    #[serde(untagged, expecting = "expected a seed: a whole number from 0 to 2^64 - 1, or its digits as a text")]
    enum Seed {
        Number(u64),
        Text(String),
    }

    pub(super) fn serialize<S: Serializer>(seed: &Option<u64>, to: S) -> Result<S::Ok, S::Error> {
        match seed {
            None => to.serialize_none(),
            Some(seed) if *seed <= LARGEST_NUMBER => to.serialize_some(seed),
            Some(seed) => to.serialize_some(&seed.to_string()),
        }
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u64>, D::Error> {
        match Seed::deserialize(from)? {
            Seed::Number(seed) => Ok(Some(seed)),
            Seed::Text(text) => read_count(&text).map(Some).ok_or_else(|| {
                D::Error::custom(format!("seed = '{text}' can't be used: expected a whole number from 0 to 2^64 - 1"))
            }),
        }
    }
}

/// Reads and writes values by their names.
macro_rules! by_name {
    ($($named:ty),*) => {$(
        impl<'de> Deserialize<'de> for $named {
            fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                String::deserialize(from)?.parse().map_err(D::Error::custom)
            }
        }

        impl Serialize for $named {
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                to.serialize_str(self.name())
            }
        }
    )*};
}

by_name!(Coordinate, Method);

/// A plan as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlanData {
    method: Method,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scrambles: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none", with = "seed")]
    seed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accuracy: Option<f64>,
}

impl PlanData {
    /// Refuses what the method has no use for.
    fn require_none(&self, given: &[(&'static str, Option<u64>)]) -> Result<(), InputError> {
        let unused = given.iter().find_map(|(field, value)| value.map(|value| (*field, value.to_string())));
        let expected =
            "none with this method: a grid takes its points from the axes, and only Sobol points are scrambled";
        unused.map_or(Ok(()), |(field, value)| Err(InputError::Malformed { field, value, expected }))
    }

    /// The accuracy of an enclosure.
    fn accuracy(&self) -> Result<f64, InputError> {
        let accuracy = self.accuracy.ok_or(InputError::Missing { field: "accuracy", expected: "the largest error" })?;
        require_accuracy(accuracy)
    }

    /// Refuses an accuracy if the method is not enclosure, which alone has a use for it.
    fn require_method_of_accuracy(&self) -> Result<(), InputError> {
        let expected = "none with this method: only enclosure has an accuracy";
        let refused = |value: f64| InputError::Malformed { field: "accuracy", value: value.to_string(), expected };
        self.accuracy.filter(|_| self.method != Method::Enclosure).map_or(Ok(()), |value| Err(refused(value)))
    }

    fn points(&self) -> Result<u64, InputError> {
        let missing = InputError::Missing { field: "points", expected: "the number of launches" };
        let points = self.points.ok_or(missing)?;
        #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
        require("points", points as f64, "at least 1", points >= 1)?;
        Ok(points)
    }

    fn scrambled(&self) -> Result<Scrambled, InputError> {
        let scrambles = self.scrambles.unwrap_or(SCRAMBLES);
        #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
        require("scrambles", scrambles as f64, "at least 1", scrambles >= 1)?;
        let scrambled = Scrambled { points: self.points()?, scrambles, seed: self.seed.unwrap_or(SEED) };
        scrambled.points_each()?;
        Ok(scrambled)
    }
}

impl TryFrom<PlanData> for Plan {
    type Error = InputError;

    fn try_from(data: PlanData) -> Result<Self, InputError> {
        let [points, scrambles, seed] = [("points", data.points), ("scrambles", data.scrambles), ("seed", data.seed)];
        data.require_method_of_accuracy()?;
        match (data.method, data.points) {
            (Method::Enclosure, _) => {
                data.require_none(&[points, scrambles, seed])?;
                Ok(Self::Enclosure { accuracy: data.accuracy()? })
            }
            (Method::Grid, _) => data.require_none(&[points, scrambles, seed]).map(|()| Self::Grid),
            (Method::Random, _) => {
                data.require_none(&[scrambles])?;
                Ok(Self::Random { points: data.points()?, seed: data.seed.unwrap_or(SEED) })
            }
            (Method::Sobol, _) => Ok(Self::Sobol(data.scrambled()?)),
            (Method::ExactSpeed, Some(_)) => Ok(Self::ExactSpeed(Rest::Sobol(data.scrambled()?))),
            (Method::ExactSpeed, None) => data.require_none(&[scrambles, seed]).map(|()| Self::ExactSpeed(Rest::Grid)),
        }
    }
}

impl From<Plan> for PlanData {
    fn from(plan: Plan) -> Self {
        let none = Self { method: plan.method(), points: None, scrambles: None, seed: None, accuracy: None };
        match plan {
            Plan::Grid | Plan::ExactSpeed(Rest::Grid) => none,
            Plan::Enclosure { accuracy } => Self { accuracy: Some(accuracy), ..none },
            Plan::Random { points, seed } => Self { points: Some(points), seed: Some(seed), ..none },
            Plan::Sobol(Scrambled { points, scrambles, seed })
            | Plan::ExactSpeed(Rest::Sobol(Scrambled { points, scrambles, seed })) => {
                Self { points: Some(points), scrambles: Some(scrambles), seed: Some(seed), ..none }
            }
        }
    }
}

#[cfg(test)]
mod tests;
