//! Plans and estimates as plain data, for configuration files and records. What is read is checked like what is
//! computed, and what was proven is written as proven, but never read as such: a file proves nothing.
//!
//! ```toml
//! method = "sobol"        # or grid; random; exact-speed, which without points takes the grid of the other coordinates
//! points = 262144
//! scrambles = 8           # this and the seed are the defaults
//! seed = 1
//! ```
//! An enclosure has an `accuracy` instead of these numbers. The interval that it proves is written as proven and read as claimed.

use dynamics::InputError;
use dynamics::error::require;
use exact::ProvenCounts;
use serde::de::{Error, IgnoredAny};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::coordinate::Coordinate;
use crate::counts::Counts;
use crate::enclosure::require_accuracy;
use crate::estimate::{Estimate, Found, IntervalKind};
use crate::interval::Interval;
use crate::plan::{Method, Plan, Rest, SCRAMBLES, Scrambled};

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
        let scrambled = Scrambled { points: self.points()?, scrambles, seed: self.seed.unwrap_or(1) };
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
                Ok(Self::Random { points: data.points()?, seed: data.seed.unwrap_or(1) })
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

/// An interval as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntervalData {
    lo: f64,
    hi: f64,
}

impl TryFrom<IntervalData> for Interval {
    type Error = InputError;

    fn try_from(IntervalData { lo, hi }: IntervalData) -> Result<Self, InputError> {
        require("hi", hi, "from 0 to 1", (0.0..=1.0).contains(&hi))?;
        require("lo", lo, "from 0 to hi", (0.0..=hi).contains(&lo))?;
        Ok(Self { lo, hi })
    }
}

impl From<Interval> for IntervalData {
    fn from(Interval { lo, hi }: Interval) -> Self {
        Self { lo, hi }
    }
}

/// Numbers of launches by their outcome, as they stand in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CountsData {
    heads: u64,
    tails: u64,
    undecided: u64,
    /// Written, and not believed when it is read.
    #[serde(default, deserialize_with = "none", skip_serializing_if = "Option::is_none")]
    proven: Option<ProvenCounts>,
}

fn none<'de, D: Deserializer<'de>>(from: D) -> Result<Option<ProvenCounts>, D::Error> {
    IgnoredAny::deserialize(from).map(|_| None)
}

/// An estimate as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EstimateData {
    probability: f64,
    points: u64,
    interval_kind: IntervalKind,
    #[serde(skip_serializing_if = "Option::is_none")]
    interval: Option<Interval>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rounding_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<CountsData>,
}

impl TryFrom<EstimateData> for Estimate {
    type Error = InputError;

    fn try_from(data: EstimateData) -> Result<Self, InputError> {
        let EstimateData { probability, points, interval_kind, interval, rounding_error, counts } = data;
        require("probability", probability, "from 0 to 1", (0.0..=1.0).contains(&probability))?;
        let has_interval = !matches!(interval_kind, IntervalKind::Grid | IntervalKind::OneScramble);
        if has_interval != interval.is_some() {
            let expected = "an interval, unless the kind is grid or one-scramble";
            return Err(InputError::Malformed { field: "interval", value: format!("{interval:?}"), expected });
        }
        let found = match (counts, rounding_error) {
            (Some(counts), None) => Found::Counts(counted(&counts, points, probability)?),
            (None, Some(rounding_error)) => {
                require("rounding_error", rounding_error, "finite and >= 0", rounding_error >= 0.0)?;
                Found::Shares { rounding_error }
            }
            _ => return Err(InputError::Missing { field: "counts", expected: "either counts or a rounding_error" }),
        };
        Ok(Self { probability, interval, interval_kind, points, found })
    }
}

/// The counts, as estimated ones, if they belong to these `points` and this `probability`.
fn counted(data: &CountsData, points: u64, probability: f64) -> Result<Counts, InputError> {
    let counts = Counts::estimated(data.heads, data.tails, data.undecided);
    let sum = [data.tails, data.undecided].into_iter().try_fold(data.heads, u64::checked_add);
    if sum != Some(points) || points == 0 {
        let expected = "the sum of heads, tails and undecided, at least 1";
        return Err(InputError::Malformed { field: "points", value: points.to_string(), expected });
    }
    require("probability", probability, "heads/points", probability == counts.probability())?;
    Ok(counts)
}

impl From<Estimate> for EstimateData {
    fn from(Estimate { probability, points, interval, interval_kind, found }: Estimate) -> Self {
        let (counts, rounding_error) = match found {
            Found::Counts(counts) => (Some(counts.into()), None),
            Found::Shares { rounding_error } => (None, Some(rounding_error)),
        };
        Self { probability, points, interval_kind, interval, rounding_error, counts }
    }
}

impl From<Counts> for CountsData {
    fn from(counts: Counts) -> Self {
        let proven = Some(counts.proven()).filter(|proven| proven.total() > 0);
        Self { heads: counts.heads(), tails: counts.tails(), undecided: counts.undecided(), proven }
    }
}

#[cfg(test)]
mod tests;
