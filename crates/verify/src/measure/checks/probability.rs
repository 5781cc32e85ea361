//! These checks test probabilities of heads: the limit of long flights, and the named spaces by every sampling method
//! and solver. Each is compared with the paper's number, with the exact motion, or with another method.

use anyhow::Context as _;
use sampling::{
    Counts, Found, Plan, RunningStep, Sampler, Space, clopper_pearson, long_flight_probability, named_space,
    random_tosses,
};
use toss::{Coin, CoinMotion, CoinToss, ExactSolver, Formulation, Launch, SolverEntry, TimeOfFlight, Vector3};

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;
use crate::measure::subject::{Subject, usual};
use crate::measure::tables::Probability;

pub(super) const LONG_FLIGHT: Check = Check {
    id: "long-flight-probability",
    claim: "The long-flight probability of heads p(ψ) = ½ + asin(cot²ψ)/π differs from the reference numbers by at \
            most the bound, for cone angles ψ from 45° to 90°.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-12,
    unit: "1",
    measure: long_flight,
};

pub(super) const LONG_FLIGHT_SHARE: Check = Check {
    id: "long-flight-share",
    claim: "The fraction of heads over a million evenly spaced phases of one turn of the exact motion differs from \
            the long-flight probability p(ψ) by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-4,
    unit: "1",
    measure: long_flight_share,
};

pub(super) const TABLES: Check = Check {
    id: "probability-tables",
    claim: "P(heads) by every sampling method differs from the paper's by at most the bound: 0.66 in Fig. 4, 1 for \
            the cheated toss, 0 for the tails toss.",
    basis: Basis::PublishedFigure,
    judges: Judges::Library,
    ceiling: 0.005,
    unit: "1",
    measure: published,
};

pub(super) const FIG4_GRID_IN_RANDOM: Check = Check {
    id: "fig4-grid-in-random",
    claim: "In Fig. 4's space P(heads) by a grid (the paper's method A) lies in the Clopper-Pearson interval of \
            random launches (its method B), which misses the probability at most once in a million. Measured: the \
            distance from the interval; any distance fails.",
    basis: Basis::CrossMethod,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "1",
    measure: grid_in_random,
};

pub(super) const FIG4_SAME_COUNTS: Check = Check {
    id: "fig4-same-counts",
    claim: "On the grid of Fig. 4's space every other solver counts as many heads and as many tails as the exact \
            motion. Measured: the sum of the two differences; one launch is enough to fail.",
    basis: Basis::CrossMethod,
    judges: Judges::Solver,
    ceiling: 1000.0,
    unit: "launches",
    measure: same_counts,
};

fn published(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let measure = |found: &Probability| {
        let expected = match found.space {
            "cheated" => 1.0,
            "tails" => 0.0,
            _ => 0.66,
        };
        let subject = format!("{}/{}", found.space, found.method);
        let input = format!("P = {}, {}", found.probability, found.interval_kind);
        Measurement::figure(TABLES.id, &subject, (found.probability - expected).abs(), found.points, input)
    };
    Ok(context.probabilities()?.iter().map(measure).collect())
}

fn grid_in_random(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let &RunningStep { launches, grid, random, .. } = context.fig4()?.last().context("the series is empty")?;
    let heads = (random * launches as f64).round() as u64;
    let interval = clopper_pearson(heads, launches, 1.0 - 1e-6);
    let outside = (interval.lo - grid).max(grid - interval.hi).max(0.0);
    let input = format!("A: {grid}; B: {:.6} to {:.6}", interval.lo, interval.hi);
    Ok(vec![Measurement::figure(FIG4_GRID_IN_RANDOM.id, "exact", outside, launches, input)])
}

fn counts(space: &Space, sampler: &Sampler<'_>) -> anyhow::Result<Counts> {
    match sampler.estimate(space, Plan::Grid)?.found {
        Found::Counts(counts) => Ok(counts),
        Found::Shares { .. } => anyhow::bail!("a grid gave a share instead of counts"),
    }
}

fn same_counts(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let space = match context.effort {
        Effort::Quick => named_space("paper-fig4")?.with_grid_of(10_000)?,
        Effort::Standard | Effort::Deep => named_space("paper-fig4")?,
    };
    let exact = counts(&space, &Sampler::exact())?;
    let one = random_tosses(&space, 1, 0..1)[0];
    let measure = |entry: &SolverEntry| {
        let stepping = entry.schemes().first().map(|scheme| usual(*scheme)).transpose()?;
        let subject = Subject::new(entry, stepping, Formulation::default());
        let (difference, undecided, input) = match counts(&space, &Sampler::by(subject.solver.as_ref())) {
            Ok(counts) => {
                let [heads, tails, undecided] = [counts.heads(), counts.tails(), counts.undecided()];
                let difference = heads.abs_diff(exact.heads()) + tails.abs_diff(exact.tails());
                (difference as f64, undecided as f64, format!("{heads} heads, {tails} tails, {undecided} undecided"))
            }
            Err(error) => (f64::INFINITY, 0.0, error.to_string()),
        };
        let is_unclaimed = subject.solver.tilt(&one).is_ok_and(|tilt| tilt.error.is_none());
        let found = Measurement::figure(FIG4_SAME_COUNTS.id, entry.name(), difference, exact.points(), input);
        // A solver's error estimate may leave launches undecided, which then are neither heads nor tails.
        Ok(found.claiming((!is_unclaimed).then_some(undecided)))
    };
    context.registry.iter().filter(|entry| entry.name() != ExactSolver::NAME).map(measure).collect()
}

fn long_flight(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let deviation = |&(cone, probability): &(f64, f64)| (long_flight_probability(cone, cone) - probability).abs();
    worst_cone(LONG_FLIGHT.id, &context.data.long_flights, 1, deviation)
}

/// Counts heads at the midpoints of a million equal parts of one turn, for horizontal launches with each cone angle ψ.
fn long_flight_share(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const PHASES: u32 = 1_000_000;
    let deviation = |&(cone, _): &(f64, f64)| {
        let rate = Vector3::new(cone.sin(), 0.0, cone.cos() / Coin::PAPER.inertia_ratio());
        let launch = Launch::new(rate, TimeOfFlight::Given(0.0)).expect("sines and cosines are finite");
        let motion = CoinMotion::new(&CoinToss { coin: Coin::PAPER, launch });
        let turn = std::f64::consts::TAU / motion.precession_rate();
        let heads = (0..PHASES)
            .map(|part| turn * (f64::from(part) + 0.5) / f64::from(PHASES))
            .filter(|time| motion.cos_tilt(*time).is_ok_and(|cos_tilt| cos_tilt > 0.0))
            .count();
        (heads as f64 / f64::from(PHASES) - long_flight_probability(cone, cone)).abs()
    };
    worst_cone(LONG_FLIGHT_SHARE.id, &context.data.long_flights, u64::from(PHASES), deviation)
}

fn worst_cone(
    check: &str,
    cones: &[(f64, f64)],
    cases_each: u64,
    deviation: impl Fn(&(f64, f64)) -> f64,
) -> anyhow::Result<Vec<Measurement>> {
    let worst = cones.iter().map(|cone| (deviation(cone), cone.0)).max_by(|a, b| a.0.total_cmp(&b.0));
    let (deviation, cone) = worst.ok_or_else(|| anyhow::anyhow!("no cone angle in the reference numbers"))?;
    let input = format!("ψ = {}°", cone.to_degrees());
    Ok(vec![Measurement::figure(check, "exact", deviation, cases_each * cones.len() as u64, input)])
}
