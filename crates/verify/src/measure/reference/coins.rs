//! This file reads `data/coins.toml`: the moments of inertia of the catalogue's coins, derived outside
//! this workspace from what mints publish. A wrong figure in the catalogue shows here and nowhere else.

use anyhow::Context;
use serde::Deserialize;

use crate::data;

/// A coin of the catalogue with its moments.
pub struct ReferenceCoin {
    /// Its name in the catalogue.
    pub name: String,
    /// I1 and I3 (kg m²).
    pub moments: [f64; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    coin: Vec<CoinEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CoinEntry {
    name: String,
    i1: String,
    i3: String,
}

/// The data inside this crate.
///
/// # Errors
/// Never: tests read it.
pub fn inside() -> anyhow::Result<Vec<ReferenceCoin>> {
    let coin =
        |entry: CoinEntry| Ok(ReferenceCoin { name: entry.name, moments: [entry.i1.parse()?, entry.i3.parse()?] });
    let file: File = toml::from_str(data::COINS).context("in coins.toml")?;
    file.coin.into_iter().map(coin).collect()
}
