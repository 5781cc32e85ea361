//! This file reads `data/motion.toml`: motions that were computed outside this workspace, in more
//! digits than f64 has. They test the solvers and the 256-bit reference independently of all our code.

use anyhow::{Context, bail};
use serde::Deserialize;
use toss::{Attitude, Coin, CoinToss, Launch, State, TimeOfFlight, Vector3};

use crate::data;
use crate::measure::any_case::RigidCase;
use crate::measure::case::Case;

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
    pub case: Case,
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
    pub case: RigidCase,
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
            BodyLanding::Rate(rate) => (landed.rate - rate).norm() / self.case.toss.launch.turn_rate(),
        }
    }

    fn new(entry: BodyEntry) -> anyhow::Result<Self> {
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
        Ok(Self { case: RigidCase::new(entry.moments, rate, 0.0, entry.time)?, landing, name: entry.name })
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
struct File {
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
        let file: File = toml::from_str(data::MOTIONS).context("in motion.toml")?;
        Ok(Self {
            flights: file.flight.into_iter().map(ReferenceFlight::new).collect::<anyhow::Result<_>>()?,
            bodies: file.body.into_iter().map(ReferenceBody::new).collect::<anyhow::Result<_>>()?,
            first_flips: file.first_flip.into_iter().map(FirstFlip::new).collect::<anyhow::Result<_>>()?,
            long_flights: file
                .long_flight
                .iter()
                .map(|entry| Ok((entry.cone_deg.to_radians(), entry.probability.parse()?)))
                .collect::<anyhow::Result<_>>()?,
            detest_b5: (file.detest_b5.time, numbers(&file.detest_b5.state)?),
        })
    }
}

fn numbers<const N: usize>(digits: &[String; N]) -> anyhow::Result<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, digits) in numbers.iter_mut().zip(digits) {
        *number = digits.parse().with_context(|| format!("'{digits}' is no number"))?;
    }
    Ok(numbers)
}

impl ReferenceFlight {
    fn new(entry: FlightEntry) -> anyhow::Result<Self> {
        let time_of_flight = match (entry.time, entry.speed, entry.gravity, entry.drop) {
            (Some(time), None, None, None) => TimeOfFlight::Given(time),
            (None, Some(speed), Some(gravity), drop) => TimeOfFlight::thrown(speed, gravity, drop),
            _ => bail!("{}: a time, or a speed and gravity, is needed", entry.name),
        };
        let launch = Launch::new(entry.rate, time_of_flight)?.with_tilt(entry.tilt)?;
        let toss = CoinToss { coin: Coin::from_moments(entry.i1, entry.i3)?, launch };
        Ok(Self {
            case: Case { toss, tilt: entry.tilt },
            cos_tilt: entry.cos_tilt.parse()?,
            cos_tilt_digits: entry.cos_tilt,
            attitude: Attitude::from_components(numbers(&entry.attitude)?)?,
            name: entry.name,
        })
    }
}

impl FirstFlip {
    fn new(entry: FlipEntry) -> anyhow::Result<Self> {
        Ok(Self {
            coin: Coin::from_moments(entry.i1, entry.i3)?,
            rate: Vector3::from(entry.rate),
            time: entry.time.parse()?,
            name: entry.name,
        })
    }
}
