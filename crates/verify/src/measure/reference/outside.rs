//! The numbers from outside the workspace: motions, probabilities of heads and the moments of real coins, in more digits
//! than f64 has. They test the solvers, the 256-bit reference, the sampling methods and the catalogue independently of all
//! our code.

use std::collections::BTreeMap;

use anyhow::{Context, bail};
use dynamics::{Body, Toss};
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toss::{Attitude, Coin, CoinToss, Launch, State, TimeOfFlight, Vector3};

use crate::data;

/// Reads the entries of a table, each by `read`.
fn all<E, T>(entries: Vec<E>, read: fn(E) -> anyhow::Result<T>) -> anyhow::Result<Vec<T>> {
    entries.into_iter().map(read).collect()
}

fn file<T: DeserializeOwned>(text: &str, name: &'static str) -> anyhow::Result<T> {
    toml::from_str(text).with_context(|| format!("in {name}"))
}

fn numbers<const N: usize>(digits: &[String; N]) -> anyhow::Result<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, digits) in numbers.iter_mut().zip(digits) {
        *number = digits.parse().with_context(|| format!("'{digits}' is no number"))?;
    }
    Ok(numbers)
}

/// All reference numbers of motions.
pub struct ReferenceData {
    /// Flights with their landings.
    pub flights: Vec<ReferenceFlight>,
    /// Flights of bodies that are no coins.
    pub bodies: Vec<ReferenceBody>,
    /// Tosses with the time at which their outcome first changes.
    pub first_flips: Vec<FirstFlip>,
    /// Cone angles ψ (rad) with the long-flight probability of heads p(ψ).
    pub long_flights: Vec<(f64, f64)>,
    /// The problem DETEST B5: a time, and the state at that time.
    pub detest_b5: (f64, [f64; 3]),
}

/// A flight with its landing.
pub struct ReferenceFlight {
    /// Its name.
    pub name: String,
    /// The toss.
    pub toss: Toss,
    /// cos θ at landing.
    pub cos_tilt: f64,
    /// cos θ at landing as printed, with all digits.
    pub cos_tilt_digits: String,
    /// Attitude at landing.
    pub attitude: Attitude,
}

/// A flight of a body that is no coin, from the identity.
pub struct ReferenceBody {
    /// Its name.
    pub name: String,
    /// The toss.
    pub toss: Toss,
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
    pub fn error(&self, landed: &State) -> f64 {
        match &self.landing {
            BodyLanding::Attitude(attitude) => attitude.angle_to(&landed.attitude),
            BodyLanding::Rate(rate) => (landed.rate - rate).norm() / self.toss.launch.turn_rate(),
        }
    }
}

/// A toss with the time at which its outcome first changes.
pub struct FirstFlip {
    /// Its name.
    pub name: String,
    /// The coin.
    pub coin: Coin,
    /// ω at launch (rad/s).
    pub rate: Vector3<f64>,
    /// Time of flight (s) at which the outcome first changes.
    pub time: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Motions {
    flight: Vec<FlightEntry>,
    body: Vec<BodyEntry>,
    first_flip: Vec<FlipEntry>,
    long_flight: Vec<LongFlightEntry>,
    detest_b5: DetestEntry,
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
    attitude: [String; 4],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BodyEntry {
    name: String,
    moments: [f64; 3],
    rate: Option<[f64; 3]>,
    rate_deg: Option<[f64; 3]>,
    time: f64,
    attitude: Option<[String; 4]>,
    landed_rate_deg: Option<[String; 3]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FlipEntry {
    name: String,
    i1: f64,
    i3: f64,
    rate: [f64; 3],
    time: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LongFlightEntry {
    cone_deg: f64,
    probability: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DetestEntry {
    time: f64,
    state: [String; 3],
}

impl ReferenceData {
    /// The data inside this crate.
    ///
    /// # Errors
    /// Never: tests read it.
    pub fn inside() -> anyhow::Result<Self> {
        let file: Motions = file(data::MOTIONS, "motion.toml")?;
        Ok(Self {
            flights: all(file.flight, flight)?,
            bodies: all(file.body, body)?,
            first_flips: all(file.first_flip, |FlipEntry { name, i1, i3, rate, time }| {
                Ok(FirstFlip { coin: Coin::from_moments(i1, i3)?, rate: rate.into(), time: time.parse()?, name })
            })?,
            long_flights: all(file.long_flight, |entry| Ok((entry.cone_deg.to_radians(), entry.probability.parse()?)))?,
            detest_b5: (file.detest_b5.time, numbers(&file.detest_b5.state)?),
        })
    }
}

fn flight(entry: FlightEntry) -> anyhow::Result<ReferenceFlight> {
    let time_of_flight = match (entry.time, entry.speed, entry.gravity, entry.drop) {
        (Some(time), None, None, None) => TimeOfFlight::Given(time),
        (None, Some(speed), Some(gravity), drop) => TimeOfFlight::thrown(speed, gravity, drop),
        _ => bail!("{}: a time, or a speed and gravity, is needed", entry.name),
    };
    let launch = Launch::new(entry.rate, time_of_flight)?.with_tilt(entry.tilt)?;
    Ok(ReferenceFlight {
        toss: CoinToss { coin: Coin::from_moments(entry.i1, entry.i3)?, launch }.into(),
        cos_tilt: entry.cos_tilt.parse()?,
        cos_tilt_digits: entry.cos_tilt,
        attitude: Attitude::from_components(numbers(&entry.attitude)?)?,
        name: entry.name,
    })
}

fn body(entry: BodyEntry) -> anyhow::Result<ReferenceBody> {
    let rate = match (entry.rate, entry.rate_deg) {
        (Some(rate), None) => rate,
        (None, Some(rate)) => rate.map(f64::to_radians),
        _ => bail!("{}: either rate or rate_deg is needed", entry.name),
    };
    let landing = match (entry.attitude, entry.landed_rate_deg) {
        (Some(digits), None) => BodyLanding::Attitude(Attitude::from_components(numbers(&digits)?)?),
        (None, Some(digits)) => BodyLanding::Rate(Vector3::from(numbers(&digits)?.map(f64::to_radians))),
        _ => bail!("{}: either attitude or landed_rate_deg is needed", entry.name),
    };
    let launch = Launch::new(rate, TimeOfFlight::Given(entry.time))?;
    Ok(ReferenceBody { toss: Toss { body: Body::from_moments(entry.moments)?, launch }, landing, name: entry.name })
}

/// All reference probabilities.
pub struct ReferenceProbabilities {
    /// Shares of heads over a range of speeds, with all other inputs fixed.
    pub shares: Vec<ReferenceShare>,
    /// Probabilities over more inputs than the speed, by name.
    pub figures: BTreeMap<String, f64>,
}

/// A space in which only the speed is free, and its share of heads.
pub struct ReferenceShare {
    /// Its name.
    pub name: String,
    /// The space.
    pub space: Space,
    /// P(heads).
    pub probability: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Probabilities {
    share: Vec<ShareEntry>,
    figure: Vec<FigureEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ShareEntry {
    name: String,
    i1: f64,
    i3: f64,
    rate: [f64; 3],
    tilt: f64,
    speed: [f64; 2],
    probability: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FigureEntry {
    name: String,
    probability: String,
}

impl ReferenceProbabilities {
    /// The data inside this crate.
    ///
    /// # Errors
    /// Never: tests read it.
    pub fn inside() -> anyhow::Result<Self> {
        let file: Probabilities = file(data::PROBABILITIES, "probability.toml")?;
        let figures = all(file.figure, |entry| Ok((entry.name, entry.probability.parse()?)))?;
        Ok(Self { shares: all(file.share, share)?, figures: figures.into_iter().collect() })
    }

    /// The probability called `name`.
    ///
    /// # Errors
    /// If there is none.
    pub fn figure(&self, name: &str) -> anyhow::Result<f64> {
        self.figures.get(name).copied().with_context(|| format!("no figure '{name}' in the reference numbers"))
    }
}

fn share(entry: ShareEntry) -> anyhow::Result<ReferenceShare> {
    let [x, y, z] = entry.rate.map(|rate| rate.to_string());
    let (tilt, speed) = (entry.tilt.to_string(), format!("{}:{}", entry.speed[0], entry.speed[1]));
    let texts = [(RateX, &*x), (RateY, &y), (RateZ, &z), (Tilt, &tilt), (Speed, &speed)];
    let space = Space::parse(Coin::from_moments(entry.i1, entry.i3)?, &texts)?;
    Ok(ReferenceShare { space, probability: entry.probability.parse()?, name: entry.name })
}

/// A coin of the catalogue with its moments, from what mints publish. A wrong figure in the catalogue shows here alone.
pub struct ReferenceCoin {
    /// Its name in the catalogue.
    pub name: String,
    /// I1 and I3 (kg m²).
    pub moments: [f64; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Coins {
    coin: Vec<CoinEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CoinEntry {
    name: String,
    i1: String,
    i3: String,
}

impl ReferenceCoin {
    /// The data inside this crate.
    ///
    /// # Errors
    /// Never: tests read it.
    pub fn inside() -> anyhow::Result<Vec<Self>> {
        let file: Coins = file(data::COINS, "coins.toml")?;
        all(file.coin, |entry| Ok(Self { moments: [entry.i1.parse()?, entry.i3.parse()?], name: entry.name }))
    }
}
