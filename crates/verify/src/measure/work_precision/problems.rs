//! This file reads `data/problems.toml`, the problems on which speed is compared with accuracy. Each problem is
//! one flight or an ensemble of random ones, and stresses something that some method is bad at.

use anyhow::{Context, bail, ensure};
use sampling::Space;
use serde::Deserialize;
use toss::Toss;

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
    toss: Option<Toss>,
    space: Option<Space>,
    launches: Option<u64>,
}

/// All problems.
pub fn all() -> anyhow::Result<Vec<Problem>> {
    let file: File = toml::from_str(include_str!("../../../data/problems.toml")).context("in problems.toml")?;
    file.problem.into_iter().map(|entry| entry.problem().context("in problems.toml")).collect()
}

impl Entry {
    fn problem(self) -> anyhow::Result<Problem> {
        let tosses = match (self.toss, self.space, self.launches) {
            (Some(toss), None, None) => vec![toss],
            (None, Some(space), Some(launches)) => ensemble(&space, launches)?,
            _ => bail!("{}: a toss, or a space with launches, is needed", self.name),
        };
        ensure!(!tosses.is_empty(), "{}: no launches", self.name);
        Ok(Problem { name: self.name, stresses: self.stresses, tosses })
    }
}

/// Random launches, whose times of flight are given in every form.
fn ensemble(space: &Space, launches: u64) -> anyhow::Result<Vec<Toss>> {
    let vary = |(turn, toss): (u64, Toss)| {
        let launch = toss.launch.with_time_of_flight(throw(toss.launch.time_of_flight(), turn))?;
        Ok(Toss { launch, ..toss })
    };
    (0..).zip(random_flights(space, 1, launches)?).map(vary).collect()
}
