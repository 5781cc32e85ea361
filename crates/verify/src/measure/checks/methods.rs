//! What the methods of sampling are worth: their errors, and whether their intervals mean what they say.

use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::{ESTIMATORS, Estimate, Found, Plan, Rest, Sampler, Scrambled, Space, clopper_pearson, rms_error};
use toss::Coin;

use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;

pub(super) const ERRORS: Check = Check {
    id: "sampling-errors",
    claim: "on a box of all four coordinates the methods' root mean square errors are small (measured: that error)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: errors,
};

pub(super) const COVERAGE: Check = Check {
    id: "interval-coverage",
    claim: "95 % intervals hold the probability in 95 % of 10 000 replicates (measured: distance from 0.95)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: coverage,
};

pub(super) const EXACT_COVERAGE: Check = Check {
    id: "clopper-pearson-coverage",
    claim: "Clopper and Pearson's 95 % intervals hold the probability in no fewer (measured: shortfall)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: exact_coverage,
};

/// Rates from 1 to 60 rad/s on each axis, speeds from 3 to 5 m/s, the paper's coin; its probability is a reference.
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

/// The share of the replicates whose interval holds the probability.
fn covered(context: &Context, holds: impl Fn(u64, f64) -> anyhow::Result<bool>) -> anyhow::Result<f64> {
    let probability = probability(context)?;
    let mut covered = 0;
    for seed in 1..=REPLICATES {
        covered += u64::from(holds(seed, probability)?);
    }
    Ok(covered as f64 / REPLICATES as f64)
}

fn coverage(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let space = four_coordinates()?;
    let plan = |method: &str, seed| match method {
        "random" => Plan::Random { points: 1000, seed },
        "sobol" => Plan::Sobol(Scrambled::new(1024, seed)),
        _ => Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1024, seed))),
    };
    ["random", "sobol", "exact-speed"]
        .into_iter()
        .map(|method| {
            let share = covered(context, |seed, probability| {
                let found = Sampler::exact().estimate(&space, plan(method, seed))?;
                Ok(found.interval.is_some_and(|interval| interval.contains(probability)))
            })?;
            let input = format!("{share} of the intervals from about 1000 launches");
            Ok(Measurement::figure(COVERAGE.id, method, (share - 0.95).abs(), REPLICATES, input))
        })
        .collect()
}

fn exact_coverage(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let space = four_coordinates()?;
    let share = covered(context, |seed, probability| {
        let Estimate { found, .. } = Sampler::exact().estimate(&space, Plan::Random { points: 1000, seed })?;
        let Found::Counts(counts) = found else { anyhow::bail!("random launches are counted") };
        Ok(clopper_pearson(counts.heads(), counts.points(), 0.95).contains(probability))
    })?;
    let input = format!("{share} of the intervals from 1000 launches");
    Ok(vec![Measurement::figure(EXACT_COVERAGE.id, "random", (0.95 - share).max(0.0), REPLICATES, input)])
}
