//! This check compares the coins of the catalogue with the moments of inertia that follow from what mints publish. A
//! coin that is wrong by a percent changes no outcome of a toss given by its rates, so that no other check shows it.

use dynamics::catalogue::{CATALOGUE, CatalogueEntry};

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;

pub(super) const MOMENTS: Check = Check {
    id: "catalogue-moments",
    claim: "I1 and I3 of every coin of the catalogue differ from those of its published mass, diameter and thickness \
            by at most the bound, relative to their size; each coin of one list is in the other.",
    basis: Basis::PublishedFigure,
    judges: Judges::Library,
    ceiling: 1e-14,
    unit: "1",
    measure,
};

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let unknown = context.coins.iter().filter(|coin| CATALOGUE.iter().all(|entry| entry.name != coin.name));
    let unknown = unknown.map(|coin| (f64::INFINITY, coin.name.as_str()));
    let known = CATALOGUE.iter().map(|entry| (deviation(context, entry), entry.name));
    let (largest, name) = known.chain(unknown).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, "none"));
    Ok(vec![Measurement::figure(MOMENTS.id, "catalogue", largest, CATALOGUE.len() as u64, name.to_owned())])
}

/// The larger of the relative deviations of I1 and I3; infinite for a coin without reference, or without moments.
fn deviation(context: &Context, entry: &CatalogueEntry) -> f64 {
    let reference = context.coins.iter().find(|coin| coin.name == entry.name);
    let (Some(reference), Ok(coin)) = (reference, entry.coin()) else { return f64::INFINITY };
    let relative = |(found, expected): (f64, f64)| (found / expected - 1.0).abs();
    [coin.i1(), coin.i3()].into_iter().zip(reference.moments).map(relative).fold(0.0, f64::max)
}
