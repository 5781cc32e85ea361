//! The checks of probabilities: the limit of long flights, the named spaces by every sampling method and solver, reference
//! numbers of many digits for spaces of which only some inputs vary, proven intervals, and the accuracy of the sampling
//! methods with the coverage of their intervals. Each is compared with the paper's number, with the exact motion, with a
//! reference, or with another method. What they count is in `counting`, how often intervals contain P(heads) in `coverage`.
//!
//! ψ is the cone angle between the coin's normal and its angular momentum S, k = I3/I1 the inertia ratio, and p(ψ) the
//! probability of heads of long flights.

use anyhow::Context as _;
use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::enclosure::{coordinates, require_enclosable};
use sampling::{
    ESTIMATORS, Estimate, Found, Interval, Plan, Rest, RunningStep, Sampler, Scrambled, Space, clopper_pearson,
    long_flight_probability, named_space, random_tosses, rms_error,
};
use toss::{Coin, ExactSolver, Formulation, InputError, SolverEntry};

use super::counting::counts;
use crate::measure::check::Basis::{CrossMethod, PublishedFigure};
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::planner;
use crate::measure::subject::{Subject, usual};
use crate::measure::tables::tables;
use crate::measure::trial::Measurement;

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("long-flight-probability", Own(long_flight)).up_to(1e-12, "1").claims(
        "The long-flight probability of heads p(ψ) = ½ + asin(cot²ψ)/π differs from the reference numbers by at most \
         the limit, for cone angles ψ from 45° to 90°.",
    ),
    Check::of_library("probability-tables", Own(published)).up_to(0.005, "1").by(PublishedFigure).claims(
        "P(heads) by every sampling method differs from the paper's by at most the limit: 0.66 in Fig. 4, 1 for the \
         cheated toss, 0 for the tails toss.",
    ),
    Check::of_library("fig4-grid-in-random", Own(grid_in_random)).by(CrossMethod).claims(
        "In Fig. 4's space P(heads) by a grid (the paper's method A) lies in the Clopper-Pearson interval of random \
         launches (its method B), which misses the probability at most once in a million. Measured: the distance from \
         the interval; any distance fails.",
    ),
    Check::of_solvers("fig4-same-counts", Own(same_counts)).up_to(1000.0, "launches").by(CrossMethod).claims(
        "On the grid of Fig. 4's space every other solver counts as many heads and as many tails as the exact motion. \
         Measured: the sum of the two differences; one launch is enough to fail.",
    ),
    Check::of_library("exact-speed-share", Own(|context| worst_share(context, |error, _| error)))
        .up_to(1e-9, "1")
        .claims(
            "With all inputs but the speed fixed, P(heads) by exact-speed differs from the reference numbers by at \
             most the limit.",
        ),
    Check::of_library("exact-speed-error-bound", Own(|context| worst_share(context, |error, bound| error / bound)))
        .up_to(1.0, "1")
        .claims(
            "With all inputs but the speed fixed, the error of P(heads) by exact-speed is within the error bound that \
             the method states. Measured: the largest error divided by that error bound; it fails above the limit of \
             this check.",
        ),
    Check::of_library("probability-figures", Own(figures))
        .up_to(1e-3, "1")
        .claims("P(heads) by exact-speed with Sobol points differs from the reference numbers by at most the limit."),
    Check::of_library("enclosure-figures", Own(enclosures)).up_to(1.0, "1").claims(
        "The proven interval of P(heads) to ± 1e-9 (± 1e-5 over two coordinates) contains the reference number. \
         Measured: its distance from the middle divided by the half-width.",
    ),
    Check::of_library("enclosures-overlap", Own(overlap)).up_to(1.0, "1").by(CrossMethod).claims(
        "On random spaces, the proven intervals of P(heads) to two accuracies overlap. Measured: the distance of their \
         middles divided by the sum of the half-widths.",
    ),
    Check::of_library("sampling-errors", Own(errors)).up_to(0.02, "1").claims(
        "On a box of four coordinates the root mean square error of P(heads) by each sampling method, against the \
         reference number, is at most the limit.",
    ),
];

fn published(_: &Context) -> anyhow::Result<Vec<Measurement>> {
    let measure = |(space, method, found): (&str, &str, Estimate)| {
        let expected = match space {
            "cheated" => 1.0,
            "tails" => 0.0,
            _ => 0.66,
        };
        let interval = found.interval.map_or(String::new(), |i| format!(", {:.6} to {:.6}", i.lo, i.hi));
        let input = format!("P = {}{interval}, {}", found.probability, found.interval_kind);
        let (subject, off) = (format!("{space}/{method}"), (found.probability - expected).abs());
        Measurement::figure(&subject, off, found.points, input)
    };
    Ok(tables()?.into_iter().map(measure).collect())
}

fn grid_in_random(_: &Context) -> anyhow::Result<Vec<Measurement>> {
    const SEED: u64 = 1;
    let running = Sampler::exact().running_shares(&named_space("paper-fig4")?, 1, SEED)?;
    let &RunningStep { launches, grid, random, .. } = running.last().context("the series is empty")?;
    let (grid, random) = grid.zip(random).context("no launch is decided")?;
    let heads = (random * launches as f64).round() as u64;
    let interval = clopper_pearson(heads, launches, 1.0 - 1e-6);
    let outside = (interval.lo - grid).max(grid - interval.hi).max(0.0);
    let input = format!("A: {grid}; B: {:.6} to {:.6}", interval.lo, interval.hi);
    Ok(vec![Measurement::figure("exact", outside, launches, input)])
}

fn same_counts(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let whole = named_space("paper-fig4")?;
    let space = context.effort.of([whole.with_grid_of(2500)?, whole, whole]);
    let exact = counts(&space, &Sampler::exact(), Plan::Grid)?;
    let one = random_tosses(&space, 1, 0..1)[0];
    let measure = |entry: &SolverEntry| {
        let stepping = entry.schemes().first().map(|scheme| usual(*scheme)).transpose()?;
        let subject = Subject::new(entry, stepping, Formulation::default());
        let (difference, undecided, input) = match counts(&space, &Sampler::by(subject.solver.as_ref()), Plan::Grid) {
            Ok(counts) => {
                let [heads, tails, undecided] = [counts.heads(), counts.tails(), counts.undecided()];
                let difference = heads.abs_diff(exact.heads()) + tails.abs_diff(exact.tails());
                (difference as f64, undecided as f64, format!("{heads} heads, {tails} tails, {undecided} undecided"))
            }
            Err(error) => (f64::INFINITY, 0.0, error.to_string()),
        };
        let is_unclaimed = subject.solver.tilt(&one).is_ok_and(|tilt| tilt.error.is_none());
        let found = Measurement::figure(entry.name(), difference, exact.points(), input);
        // A solver's error estimate may leave launches undecided, which then are neither heads nor tails.
        Ok(found.claiming((!is_unclaimed).then_some(undecided)))
    };
    context.registry.iter().filter(|entry| entry.name() != ExactSolver::NAME).map(measure).collect()
}

fn long_flight(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let flights = &context.data.long_flights;
    let each = flights.iter().map(|one| (one.cone_deg.to_radians(), one.probability));
    let all = each.map(|(cone, probability)| ((long_flight_probability(cone, cone) - probability).abs(), cone));
    let worst = all.max_by(|a, b| a.0.total_cmp(&b.0));
    let (deviation, cone) = worst.context("no cone angle in the reference numbers")?;
    let input = format!("ψ = {}°", cone.to_degrees());
    Ok(vec![Measurement::figure("exact", deviation, flights.len() as u64, input)])
}

fn worst_share(context: &Context, measure: fn(f64, f64) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let mut worst = (f64::NEG_INFINITY, String::new());
    for reference in &context.reference_probabilities.shares {
        let found = Sampler::exact().estimate(&reference.space, Plan::ExactSpeed(Rest::Grid))?;
        let Found::Shares { rounding_error } = found.found else {
            anyhow::bail!("exact-speed gave counts instead of a share")
        };
        let measured = measure((found.probability - reference.probability).abs(), rounding_error);
        if measured > worst.0 {
            worst = (measured, reference.name.clone());
        }
    }
    let cases = context.reference_probabilities.shares.len() as u64;
    Ok(vec![Measurement::figure("exact", worst.0, cases, worst.1)])
}

/// The names of all reference probabilities, and the spaces of launches that they belong to.
fn all() -> anyhow::Result<Vec<(&'static str, Space)>> {
    // The flights of these speeds (m/s) last some 10^8 turns, so that the long-flight limit holds.
    const LONG: &str = "0:1e9";
    let coin = |k: f64| Coin::from_moments(1.0, k);
    // Three independent normal components of equal deviation have an isotropic direction. S = (I1 ωx, I1 ωy, I3 ωz), so
    // with k = 0.5 an isotropic S needs twice the deviation in ωz.
    let normal = "normal:0:1";
    let [from, to] = [36.0, 40.0].map(|turns: f64| turns * std::f64::consts::TAU);
    let mut spaces = vec![
        ("isotropic angular momentum", space(coin(0.5)?, [normal, normal, "normal:0:2", LONG])?),
        ("isotropic rate, k = 0.5", space(coin(0.5)?, [normal, normal, normal, LONG])?),
        ("isotropic rate, k = 1.0", space(coin(1.0)?, [normal, normal, normal, LONG])?),
        ("isotropic rate, k = 1.98", space(coin(1.98)?, [normal, normal, normal, LONG])?),
        ("isotropic rate, k = 2.0", space(coin(2.0)?, [normal, normal, normal, LONG])?),
        // J. B. Keller, Am. Math. Mon. 93 (1986), 191: no spin, 36 to 40 turns a second.
        ("Keller's box", space(Coin::DISC, [&format!("{from}:{to}"), "0", "0", "2.1:2.7"])?),
        ("box of four coordinates", four_coordinates()?),
    ];
    // Flights too short for the long-flight limit, with precession rates ωL from 2 to 20 rad/s.
    for (name, degrees) in [
        ("finite flights, 60 degrees", 60.0_f64),
        ("finite flights, 75 degrees", 75.0),
        ("finite flights, 90 degrees", 90.0),
    ] {
        // ψ is fixed by k ωz/ωx = cot ψ, here with ωz = ωx; then ωx = ωL sin ψ.
        let cone = degrees.to_radians();
        let x = format!("{}:{}", 2.0 * cone.sin(), 20.0 * cone.sin());
        let z = if degrees == 90.0 { "0" } else { "x" };
        spaces.push((name, space(coin(cone.cos() / cone.sin())?, [&x, "0", z, "3:5"])?));
    }
    Ok(spaces)
}

fn space(coin: Coin, [x, y, z, speed]: [&str; 4]) -> Result<Space, InputError> {
    Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed)])
}

fn figures(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let points = context.effort.of([1 << 19, 1 << 22, 1 << 22]);
    let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, 1)));
    all()?
        .into_iter()
        .map(|(name, space)| {
            let found = Sampler::exact().estimate(&space, plan)?;
            let figure = context.reference_probabilities.figure(name)?;
            let interval = found.interval.map_or(String::new(), |i| format!(", {:.8} to {:.8}", i.lo, i.hi));
            let input = format!("{:.8} for {figure:.8}{interval}", found.probability);
            Ok(Measurement::figure(name, (found.probability - figure).abs(), points, input))
        })
        .collect()
}

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

fn enclosures(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut measurements = Vec::new();
    for (name, space) in all()? {
        // The flights of some spaces make 10^8 turns, and have as many edges.
        if require_enclosable(&space).is_err() || space.axis(Speed).bounds()[1] > 1e3 {
            continue;
        }
        let figure = context.reference_probabilities.figure(name)?;
        let [middle, half_width] = enclosed(&space, accuracy_for(&space))?;
        let input = format!("{middle:.12} ± {half_width:.1e} for {figure:.12}");
        // A reference number that is rounded to f64 is off by 1e-16.
        let ratio = ((middle - figure).abs() - f64::EPSILON).max(0.0) / half_width;
        measurements.push(Measurement::figure(name, ratio, 1, input));
    }
    Ok(measurements)
}

/// The spaces are those of the planner's scenes: rates and the tilt are values or ranges, and the speed is a range.
fn overlap(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const SEED: u64 = 64;
    let spaces = context.effort.of([30, 300, 1500]);
    let names =
        ["one coordinate beside the speed", "two coordinates beside the speed", "three coordinates beside the speed"];
    let mut worst = names.map(|_| (0.0, String::new()));
    let mut cases = names.map(|_| 0);
    for index in 0..spaces {
        let space = planner::space(SEED, index)?;
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
    Ok(all.map(|((name, (ratio, input)), cases)| Measurement::figure(name, ratio, cases, input)).collect())
}

/// The space of the paper's coin with rates from 1 to 60 rad/s on each axis and speeds from 3 to 5 m/s, whose P(heads)
/// is among the reference numbers.
fn four_coordinates() -> Result<Space, InputError> {
    space(Coin::PAPER, ["1:60", "1:60", "1:60", "3:5"])
}

fn probability(context: &Context) -> anyhow::Result<f64> {
    context.reference_probabilities.figure("box of four coordinates")
}

fn errors(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let replicates = context.effort.of([16, 64, 256]);
    let (space, probability) = (four_coordinates()?, probability(context)?);
    let mut measurements = Vec::new();
    for estimator in ESTIMATORS {
        for exponent in [14, 16, 18] {
            let estimates = estimator.estimates(&Sampler::exact(), &space, 1 << exponent, replicates)?;
            let subject = format!("{}/2^{exponent}", estimator.name);
            let input = format!("{} replicates", estimates.len());
            let error = rms_error(&estimates, probability);
            measurements.push(Measurement::figure(&subject, error, estimates.len() as u64, input));
        }
    }
    Ok(measurements)
}

/// The number of intervals over the box of four coordinates, and of those that contain its probability.
pub(super) fn in_the_box_of_four(
    context: &Context,
    plan: impl Fn(u64, u64) -> Plan + Sync,
) -> anyhow::Result<[u64; 2]> {
    let (space, probability) = (four_coordinates()?, probability(context)?);
    let is_covered = |seed| {
        let found = Sampler::exact().estimate(&space, plan(1024, seed))?;
        anyhow::Ok(u64::from(found.interval.is_some_and(|interval| interval.contains(probability))))
    };
    let replicates = context.effort.of([2000, 10_000, 10_000]);
    let covered = (1..=replicates).into_par_iter().map(is_covered).sum::<anyhow::Result<u64>>()?;
    Ok([replicates, covered])
}
