//! This file reads `validation/problems.toml`, the problems on which speed is compared with accuracy. Each problem is
//! one flight or an ensemble of random ones, and stresses something that some method is bad at.

use std::path::Path;

use anyhow::{Context, bail, ensure};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::{Space, random_tosses};
use serde::Deserialize;
use toss::catalogue::named_coin;
use toss::{Coin, Launch, TimeOfFlight, Toss, Vector3};

use crate::files;
use crate::measure::case::Case;

/// One flight, or an ensemble of random flights.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Its name.
    pub name: String,
    /// What it stresses, in words.
    pub stresses: String,
    /// Its tosses.
    pub cases: Vec<Case>,
}

impl Problem {
    /// The largest |ω| at launch of its tosses (rad/s).
    pub fn fastest(&self) -> f64 {
        self.cases.iter().map(|case| case.toss.launch.turn_rate()).fold(0.0, f64::max)
    }

    /// The toss as hex floats, or the number of launches.
    pub fn inputs(&self) -> String {
        if let [case] = self.cases.as_slice() { case.hex() } else { format!("{} launches", self.cases.len()) }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    problem: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    stresses: String,
    coin: String,
    rate: Option<[f64; 3]>,
    speed: Option<f64>,
    time: Option<f64>,
    #[serde(default)]
    tilt: f64,
    launches: Option<u64>,
    rate_range: Option<[f64; 2]>,
    speed_range: Option<[f64; 2]>,
    tilt_range: Option<[f64; 2]>,
}

/// Reads the problems from the file at `path`.
///
/// # Errors
/// If the file can't be read, or a problem in it is not valid.
pub fn read(path: &Path) -> anyhow::Result<Vec<Problem>> {
    let file: File = files::read_toml(path)?;
    file.problem.into_iter().map(|entry| entry.problem().with_context(|| path.display().to_string())).collect()
}

impl Entry {
    fn problem(self) -> anyhow::Result<Problem> {
        let coin = named_coin(&self.coin)?;
        let cases = match (self.rate, self.rate_range) {
            (Some(rate), None) => vec![self.flight(coin, rate)?],
            (None, Some(rates)) => self.ensemble(coin, rates)?,
            _ => bail!("{}: either rate or rate_range is needed", self.name),
        };
        ensure!(!cases.is_empty(), "{}: no launches", self.name);
        Ok(Problem { name: self.name, stresses: self.stresses, cases })
    }

    fn flight(&self, coin: Coin, rate: [f64; 3]) -> anyhow::Result<Case> {
        let time = match (self.speed, self.time) {
            (Some(speed), None) => TimeOfFlight::Ballistic { speed, gravity: DEFAULT_GRAVITY },
            (None, Some(time)) => TimeOfFlight::Given(time),
            _ => bail!("{}: either speed or time is needed", self.name),
        };
        let launch = Launch::new(Vector3::from(rate), time)?.with_tilt(self.tilt)?;
        Ok(Case { toss: Toss { coin, launch }, tilt: self.tilt })
    }

    fn ensemble(&self, coin: Coin, rates: [f64; 2]) -> anyhow::Result<Vec<Case>> {
        let span = |range: Option<[f64; 2]>| {
            let [from, to] = range.with_context(|| format!("{}: an ensemble needs ranges", self.name))?;
            anyhow::Ok(format!("{from:?}:{to:?}"))
        };
        let (rates, speeds, tilts) = (span(Some(rates))?, span(self.speed_range)?, span(self.tilt_range)?);
        let axes = [(RateX, &*rates), (RateY, &rates), (RateZ, &rates), (Speed, &speeds), (Tilt, &tilts)];
        let space = Space::parse(coin, &axes)?;
        let tosses = random_tosses(&space, 1, 0..self.launches.unwrap_or(0));
        // The attitude at launch is a turn about x, whose quaternion has the sine of half the tilt as its x component.
        let tilt = |toss: &Toss| 2.0 * toss.launch.attitude().components()[1].asin();
        Ok(tosses.into_iter().map(|toss| Case { tilt: tilt(&toss), toss }).collect())
    }
}
