//! These checks solve the paper's two tosses: the cheated one, which must land heads, and the one of its Fig. 3, which
//! must land tails. They are the paper's own examples, and every solver must reproduce them.
//!
//! "Heads with certainty" has two meanings, and both are checked. With the paper's moments the cone angle ψ between
//! normal and angular momentum is 48.5°, and the cheated toss shows heads up to its first flip at 1.3073 s, longer than
//! any flight at the paper's speeds of 3 to 5 m/s. As a disc the coin has ψ = 15.8°, below 45°, and shows heads
//! forever.

use dynamics::time_of_flight::DEFAULT_GRAVITY;
use rayon::prelude::*;
use toss::{Coin, CoinToss, Launch, Outcome, Sensitivity, SolveError, Solver, TimeOfFlight, Vector3};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::motions::FirstFlip;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;

pub(super) const CHEATED_IN_FLIGHT: Check = Check {
    id: "cheated-heads-in-flight",
    claim: "(d) The cheated toss, ω = (1, 1, 2.5) rad/s, lands heads at every speed from 3 to 5 m/s. Measured: the \
            number of launches that do not; one is enough to fail.",
    basis: Basis::PublishedFigure,
    judges: Judges::Solver,
    ceiling: 0.0,
    unit: "launches",
    measure: |context| at_every_speed(context, Vector3::new(1.0, 1.0, 2.5), Outcome::Heads),
};

pub(super) const TAILS_IN_FLIGHT: Check = Check {
    id: "tails-in-flight",
    claim: "The toss of Fig. 3, ω = (2, 2, 0.5) rad/s, lands tails at every speed from 3 to 5 m/s. Measured: the \
            number of launches that do not; one is enough to fail.",
    basis: Basis::PublishedFigure,
    judges: Judges::Solver,
    ceiling: 0.0,
    unit: "launches",
    measure: |context| at_every_speed(context, Vector3::new(2.0, 2.0, 0.5), Outcome::Tails),
};

pub(super) const CHEATED_FOREVER: Check = Check {
    id: "cheated-heads-forever",
    claim: "(d) The cheated toss of a disc lands heads after any time of flight: up to 10 000 s by closed forms, up \
            to 30 s by integrators. Measured: the number of launches that do not; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.0,
    unit: "launches",
    measure: forever,
};

pub(super) const FIRST_FLIP: Check = Check {
    id: "first-flip",
    claim: "The outcome first changes at 1.3073 s for the cheated toss and at 0.5560 s for the tails toss. Measured: \
            the largest distance from the reference time; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "s",
    measure: first_flip,
};

fn at_every_speed(context: &Context, rate: Vector3<f64>, expected: Outcome) -> anyhow::Result<Vec<Measurement>> {
    let speeds = (0..=200).map(|step| 3.0 + 0.01 * f64::from(step));
    let flights = speeds.map(|speed| TimeOfFlight::Ballistic { speed, gravity: DEFAULT_GRAVITY });
    let cases = cases(Coin::PAPER, rate, flights)?;
    Ok(context.subjects.iter().map(|subject| misses(subject, &cases, expected)).collect())
}

fn forever(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let rate = Vector3::new(1.0, 1.0, 2.5);
    let measure = |subject: &Subject| {
        let (count, last): (u32, f64) = if subject.stepping.is_none() { (100_000, 10_000.0) } else { (60, 30.0) };
        let times = (1..=count).map(|step| TimeOfFlight::Given(last * f64::from(step) / f64::from(count)));
        let cases = cases(Coin::DISC, rate, times)?;
        Ok(misses(subject, &cases, Outcome::Heads))
    };
    context.subjects.iter().map(measure).collect()
}

fn cases(coin: Coin, rate: Vector3<f64>, flights: impl Iterator<Item = TimeOfFlight>) -> anyhow::Result<Vec<Case>> {
    flights.map(|flight| Ok(Case { toss: CoinToss { coin, launch: Launch::new(rate, flight)? }, tilt: 0.0 })).collect()
}

/// The number of `cases` that do not land as `expected`. Against a bound an undecided outcome counts; against the
/// solver's own claim only a wrong one does, because an error estimate may leave an outcome undecided.
fn misses(subject: &Subject, cases: &[Case], expected: Outcome) -> Measurement {
    let tilts: Vec<_> = cases.par_iter().map(|case| subject.solver.tilt(&case.toss.into())).collect();
    let count = |is: &dyn Fn(Outcome) -> bool| {
        let found: Vec<_> = tilts.iter().map(|tilt| tilt.clone().map(|tilt| is(tilt.outcome()))).collect();
        Measurement::count(subject, &found, |index| cases[index])
    };
    let wrong = count(&|outcome| ![expected, Outcome::Undecided].contains(&outcome));
    let is_claimed = cases.iter().zip(&tilts).all(|(case, tilt)| match tilt {
        Ok(tilt) => Allowance::new(subject, &case.toss.into(), tilt.error).is_some(),
        Err(_) => true,
    });
    Measurement { claim: wrong.claiming(is_claimed.then_some(0.0)).claim, ..count(&|outcome| outcome != expected) }
}

fn first_flip(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let measure = |subject: &Subject| {
        let mut flips = Vec::new();
        let mut cases = Vec::new();
        for flip in &context.data.first_flips {
            flips.push(flip_time(subject.solver.as_ref(), flip)?.map(|time| (time - flip.time).abs()));
            cases.push(flight(flip, flip.time)?);
        }
        let allowed = |index: usize| flip_allowance(subject, &cases[index]);
        Ok(Measurement::largest_within(subject, flips, |index| cases[index], allowed))
    };
    context.subjects.iter().map(measure).collect()
}

/// The error (s) that the solver's estimate allows for a flip at the landing of `case`: the allowed error of cos θ
/// divided by its rate of change, doubled because that rate is not constant, plus the rounding of the time.
fn flip_allowance(subject: &Subject, case: &Case) -> Result<Option<f64>, SolveError> {
    let rate = Sensitivity::new(&case.toss.into())?.cos_tilt[3].abs();
    let rounding = 4.0 * f64::EPSILON * case.toss.launch.flight_time();
    Ok(Allowance::of(subject, case.toss)?.map(|allowance| 2.0 * allowance.cos_tilt / rate + rounding))
}

fn flight(flip: &FirstFlip, time: f64) -> anyhow::Result<Case> {
    let launch = Launch::new(flip.rate, TimeOfFlight::Given(time))?;
    Ok(Case { toss: CoinToss { coin: flip.coin, launch }, tilt: 0.0 })
}

/// The time (s) of the sign change of cos θ between launch and 1.5 times the expected time, by bisection.
fn flip_time(solver: &dyn Solver, flip: &FirstFlip) -> anyhow::Result<Result<f64, SolveError>> {
    let (mut heads, mut tails) = (0.0, 1.5 * flip.time);
    for _ in 0..60 {
        let middle = 0.5 * (heads + tails);
        match solver.tilt(&flight(flip, middle)?.toss.into()).map(|tilt| tilt.cos_tilt) {
            Ok(cos_tilt) if cos_tilt > 0.0 => heads = middle,
            Ok(_) => tails = middle,
            Err(error) => return Ok(Err(error)),
        }
    }
    Ok(Ok(0.5 * (heads + tails)))
}
