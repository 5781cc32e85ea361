//! The numbers from outside the workspace: motions, probabilities of heads and the moments of real coins, in more digits
//! than f64 has. They test the solvers, the 256-bit reference, the sampling methods and the catalogue independently of all
//! our code.

use anyhow::Context;
use dynamics::Toss;
use sampling::Space;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toss::{Attitude, State, TimeOfFlight, Vector3};

fn file<T: DeserializeOwned>(text: &str, name: &'static str) -> anyhow::Result<T> {
    toml::from_str(text).with_context(|| format!("in {name}"))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceData {
    #[serde(rename = "flight")]
    pub(crate) flights: Vec<ReferenceFlight>,
    #[serde(rename = "body")]
    pub(crate) bodies: Vec<ReferenceBody>,
    /// Tosses up to the time at which their outcome first changes.
    #[serde(rename = "first_flip")]
    pub(crate) first_flips: Vec<FirstFlip>,
    #[serde(rename = "long_flight")]
    pub(crate) long_flights: Vec<ReferenceLongFlight>,
}

#[derive(Deserialize)]
pub(crate) struct ReferenceFlight {
    pub(crate) toss: Toss,
    /// cos θ at landing as printed, with all digits.
    pub(crate) cos_tilt: String,
    pub(crate) attitude: Attitude,
}

impl ReferenceFlight {
    pub(crate) fn cos_tilt(&self) -> f64 {
        self.cos_tilt.parse().unwrap_or(f64::NAN)
    }
}

/// A flight of a body that is no coin, from the identity.
#[derive(Deserialize)]
pub(crate) struct ReferenceBody {
    pub(crate) toss: Toss,
    landing: BodyLanding,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum BodyLanding {
    Attitude(Attitude),
    /// The body rate (BF, °/s).
    RateDeg([f64; 3]),
}

impl ReferenceBody {
    /// The error of a landing: of the attitude (rad), or of the rate, relative to its size at launch.
    pub(crate) fn error(&self, landed: &State) -> f64 {
        match &self.landing {
            BodyLanding::Attitude(attitude) => attitude.angle_to(&landed.attitude),
            BodyLanding::RateDeg(rate) => {
                (landed.rate - Vector3::from(rate.map(f64::to_radians))).norm() / self.toss.launch.turn_rate()
            }
        }
    }
}

/// A toss up to the time at which its outcome first changes.
#[derive(Deserialize)]
pub(crate) struct FirstFlip {
    pub(crate) toss: Toss,
}

impl FirstFlip {
    /// The same launch for another time (s).
    pub(crate) fn until(&self, time: f64) -> anyhow::Result<Toss> {
        let launch = self.toss.launch.with_time_of_flight(TimeOfFlight::Given(time))?;
        Ok(Toss { launch, ..self.toss })
    }
}

/// A cone angle ψ (°) with the long-flight probability of heads p(ψ).
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceLongFlight {
    pub(crate) cone_deg: f64,
    pub(crate) probability: f64,
}

impl ReferenceData {
    pub(crate) fn inside() -> anyhow::Result<Self> {
        file(include_str!("../../data/motion.toml"), "motion.toml")
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceProbabilities {
    /// Shares of heads over a range of speeds, with all other inputs fixed.
    #[serde(rename = "share")]
    pub(crate) shares: Vec<ReferenceShare>,
    /// Probabilities over more inputs than the speed.
    #[serde(rename = "figure")]
    figures: Vec<ReferenceFigure>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceFigure {
    name: String,
    probability: f64,
}

/// A space in which only the speed is free, and its share of heads.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceShare {
    pub(crate) name: String,
    pub(crate) space: Space,
    pub(crate) probability: f64,
}

impl ReferenceProbabilities {
    pub(crate) fn inside() -> anyhow::Result<Self> {
        file(include_str!("../../data/probability.toml"), "probability.toml")
    }
    pub(crate) fn figure(&self, name: &str) -> anyhow::Result<f64> {
        let found = self.figures.iter().find(|figure| figure.name == name);
        Ok(found.with_context(|| format!("no figure '{name}' in the reference numbers"))?.probability)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Coins {
    coin: Vec<ReferenceCoin>,
}

/// A coin of the catalogue with its moments (kg m²), from what mints publish. A wrong figure in the catalogue shows here
/// alone.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceCoin {
    pub(crate) name: String,
    pub(crate) i1: f64,
    pub(crate) i3: f64,
}

impl ReferenceCoin {
    pub(crate) fn inside() -> anyhow::Result<Vec<Self>> {
        Ok(file::<Coins>(include_str!("../../data/coins.toml"), "coins.toml")?.coin)
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use dashu_float::{DBig, FBig};
    use numerics::DoubleDouble;
    use numerics::double_double::two_sum;

    use super::*;
    use crate::measure::case::{self, is_horizontal};
    use crate::measure::reference::Reference;

    /// A number in decimal digits, to 32 of them.
    fn decimal(text: &str) -> DoubleDouble {
        let value = DBig::from_str(text).expect("a number").with_base_and_precision::<2>(256).value();
        let hi = value.to_f64().value();
        let rest = value - FBig::try_from(hi).expect("a finite number");
        two_sum(hi, rest.to_f64().value())
    }

    /// Flights whose inputs are exact in f64 agree with the reference numbers in every printed digit, the others to
    /// within the rounding of their inputs.
    #[test]
    fn the_256_bit_motion_agrees_with_the_independent_numbers() {
        let mut exact_inputs = 0;
        for flight in ReferenceData::inside().unwrap().flights {
            let reference = Reference::of(&flight.toss).unwrap();
            let error = reference.unrounded_cos_tilt_error(decimal(&flight.cos_tilt));
            let time = flight.toss.launch.time_of_flight();
            let exact = is_horizontal(&flight.toss.launch)
                && matches!(time, TimeOfFlight::Given(_) | TimeOfFlight::BallisticTo { gravity: 1.625, .. });
            exact_inputs += usize::from(exact);
            let within = if exact { 1e-31 } else { 3e-16 };
            assert!(error < within, "{}: {error:e}", case::text(&flight.toss));
            let attitude_error = reference.attitude_error(&flight.attitude);
            assert!(attitude_error < 3e-16, "{}: {attitude_error:e}", case::text(&flight.toss));
        }
        assert!(exact_inputs >= 5);
    }
}
