//! This file reads `data/probability.toml`: probabilities of heads that were computed outside this
//! workspace. They test the sampling methods independently of all our code.

use std::collections::BTreeMap;

use anyhow::Context;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use serde::Deserialize;
use toss::Coin;

use crate::data;

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
struct File {
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
        let file: File = toml::from_str(data::PROBABILITIES).context("in probability.toml")?;
        Ok(Self {
            shares: file.share.into_iter().map(ReferenceShare::new).collect::<anyhow::Result<_>>()?,
            figures: file
                .figure
                .into_iter()
                .map(|entry| Ok((entry.name, entry.probability.parse()?)))
                .collect::<anyhow::Result<_>>()?,
        })
    }

    /// The probability called `name`.
    ///
    /// # Errors
    /// If there is none.
    pub fn figure(&self, name: &str) -> anyhow::Result<f64> {
        self.figures.get(name).copied().with_context(|| format!("no figure '{name}' in the reference numbers"))
    }
}

impl ReferenceShare {
    fn new(entry: ShareEntry) -> anyhow::Result<Self> {
        let [x, y, z] = entry.rate.map(|rate| rate.to_string());
        let (tilt, speed) = (entry.tilt.to_string(), format!("{}:{}", entry.speed[0], entry.speed[1]));
        let texts = [(RateX, &*x), (RateY, &y), (RateZ, &z), (Tilt, &tilt), (Speed, &speed)];
        Ok(Self {
            space: Space::parse(Coin::from_moments(entry.i1, entry.i3)?, &texts)?,
            probability: entry.probability.parse()?,
            name: entry.name,
        })
    }
}
