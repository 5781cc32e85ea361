//! These checks measure how accurate the methods of sampling launches are, and how often their confidence intervals
//! contain the true probability. The space has four free coordinates and a reference probability, so errors are
//! known, not estimated.

use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::{ESTIMATORS, Estimate, Found, Plan, Sampler, Space, clopper_pearson, rms_error};
use toss::Coin;

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;

pub(super) const ERRORS: Check = Check {
    id: "sampling-errors",
    claim: "On a box of four coordinates the root mean square error of P(heads) by each sampling method, against the \
            reference number, is at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.02,
    unit: "1",
    measure: errors,
};

pub(super) const EXACT_COVERAGE: Check = Check {
    id: "clopper-pearson-coverage",
    claim: "Of 10 000 intervals of Clopper and Pearson for P(heads) at the 95 % level, at least 95 % contain the \
            reference number. Measured: how far the fraction is below 0.95; any shortfall fails.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "1",
    measure: exact_coverage,
};

/// The space of the paper's coin with rates from 1 to 60 rad/s on each axis and speeds from 3 to 5 m/s, whose P(heads)
/// is among the reference numbers.
fn four_coordinates() -> anyhow::Result<Space> {
    let axes = [(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5")];
    Ok(Space::parse(Coin::PAPER, &axes)?)
}

fn probability(context: &Context) -> anyhow::Result<f64> {
    context.reference_probabilities.figure("box of four coordinates")
}

fn errors(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let replicates = match context.effort {
        Effort::Quick => 16,
        Effort::Standard => 64,
        Effort::Deep => 256,
    };
    let (space, probability) = (four_coordinates()?, probability(context)?);
    let mut measurements = Vec::new();
    for estimator in ESTIMATORS {
        for exponent in [14, 16, 18] {
            let estimates = estimator.estimates(&Sampler::exact(), &space, 1 << exponent, replicates)?;
            let subject = format!("{}/2^{exponent}", estimator.name);
            let input = format!("{} replicates", estimates.len());
            let error = rms_error(&estimates, probability);
            measurements.push(Measurement::figure(ERRORS.id, &subject, error, estimates.len() as u64, input));
        }
    }
    Ok(measurements)
}

const REPLICATES: u64 = 10_000;

/// The number of the replicates for which `holds`, called with a seed and the probability, is true.
fn covered(context: &Context, holds: impl Fn(u64, f64) -> anyhow::Result<bool> + Sync) -> anyhow::Result<u64> {
    let probability = probability(context)?;
    let is_covered = |seed| holds(seed, probability).map(u64::from);
    (1..=REPLICATES).into_par_iter().map(is_covered).sum()
}

/// The number of intervals over the box of four coordinates, and of those that contain its probability.
pub(super) fn in_the_box_of_four(
    context: &Context,
    plan: impl Fn(u64, u64) -> Plan + Sync,
) -> anyhow::Result<[u64; 2]> {
    let space = four_coordinates()?;
    let covered = covered(context, |seed, probability| {
        let found = Sampler::exact().estimate(&space, plan(1024, seed))?;
        Ok(found.interval.is_some_and(|interval| interval.contains(probability)))
    })?;
    Ok([REPLICATES, covered])
}

fn exact_coverage(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let space = four_coordinates()?;
    let share = covered(context, |seed, probability| {
        let Estimate { found, .. } = Sampler::exact().estimate(&space, Plan::Random { points: 1000, seed })?;
        let Found::Counts(counts) = found else { anyhow::bail!("random launches gave a share instead of counts") };
        Ok(clopper_pearson(counts.heads(), counts.points(), 0.95).contains(probability))
    })? as f64
        / REPLICATES as f64;
    let input = format!("{share} of the intervals from 1000 launches");
    Ok(vec![Measurement::figure(EXACT_COVERAGE.id, "random", (0.95 - share).max(0.0), REPLICATES, input)])
}
