//! The numbers from outside the workspace: motions, probabilities of heads and the moments of real coins, in more digits
//! than f64 has. They test the solvers, the 256-bit reference, the sampling methods and the catalogue independently of all
//! our code.

use anyhow::{Context, bail};
use dynamics::{Body, Toss};
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toss::{Attitude, Coin, Launch, State, TimeOfFlight, Vector3};

fn file<T: DeserializeOwned>(text: &str, name: &'static str) -> anyhow::Result<T> {
    toml::from_str(text).with_context(|| format!("in {name}"))
}

/// A number that a file has as a text of more digits.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct Decimal(pub(crate) f64);

impl TryFrom<String> for Decimal {
    type Error = String;

    fn try_from(digits: String) -> Result<Self, String> {
        digits.parse().map(Self).map_err(|_| format!("'{digits}' is no number"))
    }
}

/// All reference numbers of motions.
pub(crate) struct ReferenceData {
    pub(crate) flights: Vec<ReferenceFlight>,
    /// Flights of bodies that are no coins.
    pub(crate) bodies: Vec<ReferenceBody>,
    /// Tosses with the time at which their outcome first changes.
    pub(crate) first_flips: Vec<FirstFlip>,
    pub(crate) long_flights: Vec<ReferenceLongFlight>,
    pub(crate) detest_b5: Detest,
}

/// A flight with its landing.
pub(crate) struct ReferenceFlight {
    pub(crate) toss: Toss,
    pub(crate) cos_tilt: f64,
    /// cos θ at landing as printed, with all digits.
    #[cfg(test)]
    pub(crate) cos_tilt_digits: String,
    pub(crate) attitude: Attitude,
}

/// A flight of a body that is no coin, from the identity.
pub(crate) struct ReferenceBody {
    pub(crate) toss: Toss,
    landing: BodyLanding,
}

/// What is published of a landing.
enum BodyLanding {
    Attitude(Attitude),
    /// The body rate (BF, rad/s).
    Rate(Vector3<f64>),
}

impl ReferenceBody {
    /// The error of a landing: of the attitude (rad), or of the rate, relative to its size at launch.
    pub(crate) fn error(&self, landed: &State) -> f64 {
        match &self.landing {
            BodyLanding::Attitude(attitude) => attitude.angle_to(&landed.attitude),
            BodyLanding::Rate(rate) => (landed.rate - rate).norm() / self.toss.launch.turn_rate(),
        }
    }
}

/// A toss with the time at which its outcome first changes.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FirstFlip {
    name: String,
    i1: f64,
    i3: f64,
    rate: [f64; 3],
    /// Time of flight (s) at which the outcome first changes.
    pub(crate) time: Decimal,
}

impl FirstFlip {
    pub(crate) fn toss(&self, time: f64) -> anyhow::Result<Toss> {
        let launch = Launch::new(self.rate, TimeOfFlight::Given(time)).with_context(|| self.name.clone())?;
        Ok(Toss::new(Coin::from_moments(self.i1, self.i3)?, launch))
    }
}

/// A cone angle ψ (°) with the long-flight probability of heads p(ψ).
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceLongFlight {
    pub(crate) cone_deg: f64,
    pub(crate) probability: Decimal,
}

/// The problem DETEST B5: a time, and the state at that time.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Detest {
    pub(crate) time: f64,
    pub(crate) state: [Decimal; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Motions {
    flight: Vec<FlightEntry>,
    body: Vec<BodyEntry>,
    first_flip: Vec<FirstFlip>,
    long_flight: Vec<ReferenceLongFlight>,
    detest_b5: Detest,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FlightEntry {
    name: String,
    i1: f64,
    i3: f64,
    rate: [f64; 3],
    time: Option<f64>,
    speed: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    tilt: f64,
    cos_tilt: String,
    attitude: [Decimal; 4],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BodyEntry {
    name: String,
    moments: [f64; 3],
    rate: Option<[f64; 3]>,
    rate_deg: Option<[f64; 3]>,
    time: f64,
    attitude: Option<[Decimal; 4]>,
    landed_rate_deg: Option<[Decimal; 3]>,
}

impl ReferenceData {
    pub(crate) fn inside() -> anyhow::Result<Self> {
        let file: Motions = file(include_str!("../../../data/motion.toml"), "motion.toml")?;
        Ok(Self {
            flights: file.flight.iter().map(flight).collect::<anyhow::Result<_>>()?,
            bodies: file.body.iter().map(body).collect::<anyhow::Result<_>>()?,
            first_flips: file.first_flip,
            long_flights: file.long_flight,
            detest_b5: file.detest_b5,
        })
    }
}

fn flight(entry: &FlightEntry) -> anyhow::Result<ReferenceFlight> {
    let time_of_flight = match (entry.time, entry.speed, entry.gravity, entry.drop) {
        (Some(time), None, None, None) => TimeOfFlight::Given(time),
        (None, Some(speed), Some(gravity), drop) => TimeOfFlight::thrown(speed, gravity, drop),
        _ => bail!("{}: a time, or a speed and gravity, is needed", entry.name),
    };
    let launch = Launch::new(entry.rate, time_of_flight)?.with_tilt(entry.tilt)?;
    Ok(ReferenceFlight {
        toss: Toss::new(Coin::from_moments(entry.i1, entry.i3)?, launch),
        cos_tilt: entry.cos_tilt.parse()?,
        #[cfg(test)]
        cos_tilt_digits: entry.cos_tilt.clone(),
        attitude: Attitude::from_components(entry.attitude.map(|Decimal(part)| part))?,
    })
}

fn body(entry: &BodyEntry) -> anyhow::Result<ReferenceBody> {
    let rate = match (entry.rate, entry.rate_deg) {
        (Some(rate), None) => rate,
        (None, Some(rate)) => rate.map(f64::to_radians),
        _ => bail!("{}: either rate or rate_deg is needed", entry.name),
    };
    let landing = match (entry.attitude, entry.landed_rate_deg) {
        (Some(digits), None) => BodyLanding::Attitude(Attitude::from_components(digits.map(|Decimal(part)| part))?),
        (None, Some(digits)) => BodyLanding::Rate(digits.map(|Decimal(part)| part.to_radians()).into()),
        _ => bail!("{}: either attitude or landed_rate_deg is needed", entry.name),
    };
    let launch = Launch::new(rate, TimeOfFlight::Given(entry.time))?;
    Ok(ReferenceBody { toss: Toss { body: Body::from_moments(entry.moments)?, launch }, landing })
}

/// All reference probabilities.
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
    probability: Decimal,
}

/// A space in which only the speed is free, and its share of heads.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReferenceShare {
    pub(crate) name: String,
    i1: f64,
    i3: f64,
    rate: [f64; 3],
    tilt: f64,
    speed: [f64; 2],
    pub(crate) probability: Decimal,
}

impl ReferenceShare {
    pub(crate) fn space(&self) -> anyhow::Result<Space> {
        let [x, y, z] = self.rate.map(|rate| rate.to_string());
        let (tilt, speed) = (self.tilt.to_string(), format!("{}:{}", self.speed[0], self.speed[1]));
        let texts = [(RateX, &*x), (RateY, &y), (RateZ, &z), (Tilt, &tilt), (Speed, &speed)];
        Ok(Space::parse(Coin::from_moments(self.i1, self.i3)?, &texts)?)
    }
}

impl ReferenceProbabilities {
    pub(crate) fn inside() -> anyhow::Result<Self> {
        file(include_str!("../../../data/probability.toml"), "probability.toml")
    }
    pub(crate) fn figure(&self, name: &str) -> anyhow::Result<f64> {
        let found = self.figures.iter().find(|figure| figure.name == name);
        Ok(found.with_context(|| format!("no figure '{name}' in the reference numbers"))?.probability.0)
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
    pub(crate) i1: Decimal,
    pub(crate) i3: Decimal,
}

impl ReferenceCoin {
    pub(crate) fn inside() -> anyhow::Result<Vec<Self>> {
        Ok(file::<Coins>(include_str!("../../../data/coins.toml"), "coins.toml")?.coin)
    }
}
