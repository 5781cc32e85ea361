//! What can be chosen: solvers with their colours, coins, units. The page lists what the library has.

use dynamics::error::find_named;
use serde::Serialize;
use toss::catalogue::CATALOGUE;
use toss::quantity::Dimension;
use toss::{Error, Registry};

/// Everything that can be chosen by name.
#[derive(Debug, Serialize)]
pub(crate) struct Known {
    version: &'static str,
    solvers: Vec<KnownSolver>,
    coins: Vec<KnownCoin>,
}

#[derive(Debug, Serialize)]
struct KnownSolver {
    name: &'static str,
    color: Option<[u8; 3]>,
    schemes: Vec<KnownScheme>,
    formulations: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
struct KnownScheme {
    name: &'static str,
    adaptive: bool,
}

#[derive(Debug, Serialize)]
struct KnownCoin {
    name: &'static str,
    description: &'static str,
}

/// A quantity as it was typed.
#[derive(Debug, Serialize)]
pub(crate) struct Typed {
    si: f64,
    value: f64,
    unit: String,
}

pub(crate) fn known() -> Known {
    let solvers = Registry::standard().entries().iter().map(|entry| KnownSolver {
        name: entry.name(),
        color: entry.color(),
        schemes: entry
            .schemes()
            .iter()
            .map(|scheme| KnownScheme { name: scheme.name(), adaptive: scheme.is_adaptive() })
            .collect(),
        formulations: entry.formulations().iter().map(|formulation| formulation.name()).collect(),
    });
    let coins = CATALOGUE.iter().map(|entry| KnownCoin { name: entry.name, description: entry.description });
    Known { version: env!("CARGO_PKG_VERSION"), solvers: solvers.collect(), coins: coins.collect() }
}

const DIMENSIONS: [(&str, Dimension); 6] = [
    ("angle", Dimension::Angle),
    ("rate", Dimension::TurnRate),
    ("speed", Dimension::Speed),
    ("time", Dimension::Time),
    ("acceleration", Dimension::Acceleration),
    ("length", Dimension::Length),
];

/// The quantity `text` of this kind in SI units, and its unit, if one was given.
pub(crate) fn quantity(kind: &str, text: &str) -> Result<Typed, Error> {
    let dimension = find_named("quantity", kind, &DIMENSIONS, |(name, _)| name)?.1;
    let given = dimension.given("quantity", text)?;
    Ok(Typed { si: given.si(), value: given.value(), unit: given.unit().name().to_owned() })
}
