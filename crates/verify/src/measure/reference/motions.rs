//! This file reads `validation/reference/motion.toml`: motions that were computed outside this workspace, in more
//! digits than f64 has. They test the solvers and the 256-bit reference independently of all our code.

use std::path::Path;

use anyhow::{Context, bail};
use serde::Deserialize;
use toss::{Attitude, Coin, Launch, TimeOfFlight, Toss, Vector3};

use crate::files;
use crate::measure::case::Case;

/// All reference numbers of motions.
pub struct ReferenceData {
    /// Flights with their landings.
    pub flights: Vec<ReferenceFlight>,
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
    tilt: f64,
    cos_tilt: String,
    attitude: [String; 4],
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
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If the file can't be read or holds something else.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        let file: File = files::read_toml(path)?;
        Ok(Self {
            flights: file.flight.into_iter().map(ReferenceFlight::new).collect::<anyhow::Result<_>>()?,
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
        let time_of_flight = match (entry.time, entry.speed, entry.gravity) {
            (Some(time), None, None) => TimeOfFlight::Given(time),
            (None, Some(speed), Some(gravity)) => TimeOfFlight::Ballistic { speed, gravity },
            _ => bail!("{}: a time, or a speed and gravity, is needed", entry.name),
        };
        let launch = Launch::new(Vector3::from(entry.rate), time_of_flight)?.with_tilt(entry.tilt)?;
        let toss = Toss { coin: Coin::from_moments(entry.i1, entry.i3)?, launch };
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
