//! This file reads `data/problems.toml`, the problems on which speed is compared with accuracy. Each problem is
//! one flight or an ensemble of random ones, and stresses something that some method is bad at.

use anyhow::{Context, bail, ensure};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use serde::Deserialize;
use toss::catalogue::named_coin;
use toss::{Body, Coin, CoinToss, Launch, TimeOfFlight, Toss};

use crate::measure::case;
use crate::measure::tosses::{random_flights, throw};

/// One flight, or an ensemble of random flights.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Its name.
    pub name: String,
    /// What it stresses, in words.
    pub stresses: String,
    /// Its tosses.
    pub tosses: Vec<Toss>,
}

impl Problem {
    /// The largest |ω| at launch of its tosses (rad/s).
    pub fn fastest(&self) -> f64 {
        self.tosses.iter().map(|toss| toss.launch.turn_rate()).fold(0.0, f64::max)
    }

    /// The toss as text, or the number of launches.
    pub fn inputs(&self) -> String {
        if let [toss] = &self.tosses[..] { case::text(toss) } else { format!("{} launches", self.tosses.len()) }
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
    coin: Option<String>,
    moments: Option<[f64; 3]>,
    rate: Option<[f64; 3]>,
    speed: Option<f64>,
    time: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    #[serde(default)]
    tilt: f64,
    launches: Option<u64>,
    rate_range: Option<[f64; 2]>,
    speed_range: Option<[f64; 2]>,
    tilt_range: Option<[f64; 2]>,
}

/// All problems.
///
/// # Errors
/// Never: tests read them.
pub fn all() -> anyhow::Result<Vec<Problem>> {
    let file: File = toml::from_str(include_str!("../../../data/problems.toml")).context("in problems.toml")?;
    file.problem.into_iter().map(|entry| entry.problem().context("in problems.toml")).collect()
}

impl Entry {
    fn problem(self) -> anyhow::Result<Problem> {
        let coin = self.coin.as_deref().map(named_coin).transpose()?;
        let tosses = match (coin, self.moments, self.rate, self.rate_range) {
            (Some(coin), None, Some(rate), None) => vec![self.flight(coin.into(), rate)?],
            (Some(coin), None, None, Some(rates)) => self.ensemble(coin, rates)?,
            (None, Some(moments), Some(rate), None) => vec![self.flight(Body::from_moments(moments)?, rate)?],
            _ => bail!("{}: a coin with rate or rate_range, or moments with rate, is needed", self.name),
        };
        ensure!(!tosses.is_empty(), "{}: no launches", self.name);
        Ok(Problem { name: self.name, stresses: self.stresses, tosses })
    }

    fn flight(&self, body: Body, rate: [f64; 3]) -> anyhow::Result<Toss> {
        let time = match (self.speed, self.time) {
            (Some(speed), None) => TimeOfFlight::thrown(speed, self.gravity.unwrap_or(DEFAULT_GRAVITY), self.drop),
            (None, Some(time)) if self.gravity.or(self.drop).is_none() => TimeOfFlight::Given(time),
            _ => bail!("{}: either a speed, with gravity and drop as needed, or a time is needed", self.name),
        };
        Ok(Toss { body, launch: Launch::new(rate, time)?.with_tilt(self.tilt)? })
    }

    /// Random launches of `coin`, whose times of flight are given in every form.
    fn ensemble(&self, coin: Coin, rates: [f64; 2]) -> anyhow::Result<Vec<Toss>> {
        let span = |range: Option<[f64; 2]>| {
            let [from, to] = range.with_context(|| format!("{}: an ensemble needs ranges", self.name))?;
            anyhow::Ok(format!("{from:?}:{to:?}"))
        };
        let (rates, speeds, tilts) = (span(Some(rates))?, span(self.speed_range)?, span(self.tilt_range)?);
        let axes = [(RateX, &*rates), (RateY, &rates), (RateZ, &rates), (Speed, &speeds), (Tilt, &tilts)];
        let space = Space::parse(coin, &axes)?;
        let tosses = random_flights(&space, 1, self.launches.unwrap_or(0))?;
        let vary = |(turn, toss): (u64, CoinToss)| {
            let launch = Launch::new(toss.launch.rate(), throw(toss.launch.time_of_flight(), turn))?;
            Ok(Toss::new(toss.coin, launch.with_attitude(toss.launch.attitude())))
        };
        (0..).zip(tosses).map(vary).collect()
    }
}
