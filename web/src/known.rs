//! What can be chosen: solvers with their colours, coins, units. The page lists what the library has.

use dynamics::error::find_named;
use dynamics::quantity::NamedUnit;
use serde_json::{Value, json};
use toss::catalogue::CATALOGUE;
use toss::quantity::Dimension;
use toss::{Error, Registry};

/// Everything that can be chosen by name.
pub(crate) fn known() -> Value {
    let solvers = Registry::standard().entries().iter().map(|entry| {
        let schemes =
            entry.schemes().iter().map(|scheme| json!({ "name": scheme.name(), "adaptive": scheme.is_adaptive() }));
        let formulations = entry.formulations().iter().map(|formulation| formulation.name());
        json!({
            "name": entry.name(),
            "summary": entry.summary(),
            "color": entry.color(),
            "schemes": schemes.collect::<Vec<_>>(),
            "formulations": formulations.collect::<Vec<_>>(),
        })
    });
    let coins = CATALOGUE.iter().map(|entry| json!({ "name": entry.name, "description": entry.description }));
    let units = |dimension: Dimension| dimension.units().iter().map(NamedUnit::name).collect::<Vec<_>>();
    let si = |dimension: Dimension| dimension.units().iter().map(|unit| unit.to_si(1.0)).collect::<Vec<_>>();
    let dimensions = DIMENSIONS.map(|(name, dimension)| {
        json!({ "name": name, "expected": dimension.expected(), "units": units(dimension), "si": si(dimension) })
    });
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "solvers": solvers.collect::<Vec<_>>(),
        "coins": coins.collect::<Vec<_>>(),
        "dimensions": dimensions,
    })
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
pub(crate) fn quantity(kind: &str, text: &str) -> Result<Value, Error> {
    let dimension = find_named("quantity", kind, &DIMENSIONS, |(name, _)| name)?.1;
    let given = dimension.given("quantity", text)?;
    Ok(json!({ "si": given.si(), "value": given.value(), "unit": given.unit().name() }))
}
