//! These checks compare proven intervals of P(heads) with reference numbers of many digits, and with each other.

use sampling::enclosure::{coordinates, require_enclosable};
use sampling::{Interval, Plan, Sampler, Space};

use super::figures;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;
use crate::measure::planner::scenes;

pub(super) const FIGURES: Check = Check {
    id: "enclosure-figures",
    claim: "The proven interval of P(heads) to ± 1e-9 (± 1e-5 over two coordinates) contains the reference number. Measured: its \
            distance from the middle divided by the half-width.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: figures,
};

pub(super) const OVERLAP: Check = Check {
    id: "enclosures-overlap",
    claim: "On random spaces, the proven intervals of P(heads) to two accuracies overlap. Measured: the distance of their middles \
            divided by the sum of the half-widths.",
    basis: Basis::CrossMethod,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: overlap,
};

/// Middle and half-width of the proven interval.
fn enclosed(space: &Space, accuracy: f64) -> anyhow::Result<[f64; 2]> {
    let found = Sampler::exact().estimate(space, Plan::Enclosure { accuracy })?;
    let Interval { lo, hi } = found.interval.ok_or_else(|| anyhow::anyhow!("an enclosure without an interval"))?;
    Ok([0.5 * (lo + hi), 0.5 * (hi - lo)])
}

/// Accuracies that take some hundredths of a second.
fn accuracy_for(space: &Space) -> f64 {
    match coordinates(space) {
        0 | 1 => 1e-9,
        2 => 1e-5,
        _ => 2e-2,
    }
}

fn figures(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut measurements = Vec::new();
    for of in figures::all()? {
        let space = of.space()?;
        // The flights of some spaces make 10^8 turns, and have as many edges.
        if require_enclosable(&space).is_err() || space.axis(sampling::Coordinate::Speed).bounds()[1] > 1e3 {
            continue;
        }
        let figure = context.reference_probabilities.figure(of.name)?;
        let [middle, half_width] = enclosed(&space, accuracy_for(&space))?;
        let input = format!("{middle:.12} ± {half_width:.1e} for {figure:.12}");
        // A reference number that is rounded to f64 is off by 1e-16.
        let ratio = ((middle - figure).abs() - f64::EPSILON).max(0.0) / half_width;
        measurements.push(Measurement::figure(FIGURES.id, of.name, ratio, 1, input));
    }
    Ok(measurements)
}

/// The spaces are those of the planner's scenes: rates and the tilt are values or ranges, and the speed is a range.
fn overlap(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const SEED: u64 = 64;
    let spaces = match context.effort {
        Effort::Quick => 30,
        Effort::Standard => 300,
        Effort::Deep => 1500,
    };
    let names =
        ["one coordinate beside the speed", "two coordinates beside the speed", "three coordinates beside the speed"];
    let mut worst = names.map(|_| (0.0, String::new()));
    let mut cases = names.map(|_| 0);
    for index in 0..spaces {
        let space = scenes::space(SEED, index)?;
        let number = coordinates(&space);
        if require_enclosable(&space).is_err() || number == 0 {
            continue;
        }
        let accuracy = accuracy_for(&space);
        let [[rough, rough_half], [fine, fine_half]] = [enclosed(&space, 5.0 * accuracy)?, enclosed(&space, accuracy)?];
        // Spaces whose launches all show one face have a width of a rounding.
        let ratio = (rough - fine).abs() / (rough_half + fine_half).max(f64::MIN_POSITIVE);
        cases[number - 1] += 1;
        if ratio > worst[number - 1].0 {
            worst[number - 1] =
                (ratio, format!("space {index}: {rough} ± {rough_half:.1e} and {fine} ± {fine_half:.1e}"));
        }
    }
    let all = names.into_iter().zip(worst).zip(cases).filter(|(_, cases)| *cases > 0);
    Ok(all.map(|((name, (ratio, input)), cases)| Measurement::figure(OVERLAP.id, name, ratio, cases, input)).collect())
}
