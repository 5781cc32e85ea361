//! The checks of numbers from outside the workspace, so that an error which all our code shares shows: landings in
//! `data/motion.toml`, published motions of bodies, the coins of the catalogue, and the paper's
//! two tosses, of which the cheated one must land heads and the one of its Fig. 3 tails.
//!
//! "Heads with certainty" has two meanings, and both are checked. With the paper's moments the cone angle ψ between
//! normal and angular momentum is 48.5°, and the cheated toss shows heads up to its first flip at 1.3073 s, longer than
//! any flight at the paper's speeds of 3 to 5 m/s. As a disc the coin has ψ = 15.8°, below 45°, and shows heads
//! forever.

use dynamics::catalogue::{CATALOGUE, Entry};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use rayon::prelude::*;
use toss::{Coin, Landing, Launch, Outcome, Sensitivity, SolveError, Solver, Tilt, TimeOfFlight, Toss};

use crate::measure::check::Basis::PublishedFigure;
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::check::ceiling::{ATTITUDE, COS_TILT};
use crate::measure::context::Context;
use crate::measure::outside::{FirstFlip, ReferenceBody, ReferenceFlight};
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::trial::{Fold, Measurement, Trial};

pub(super) const CHECKS: &[Check] = &[
    Check::of_solvers("reference-cos-tilt", Own(cos_tilt))
        .up_to(COS_TILT, "1")
        .claims("On every reference flight, cos θ at landing differs from the reference number by at most the limit."),
    Check::of_solvers("reference-attitude", Own(attitude)).up_to(ATTITUDE, "rad").claims(
        "On every reference flight, the attitude at landing differs from the reference attitude by at most the limit.",
    ),
    Check::of_library("catalogue-moments", Own(moments)).up_to(1e-14, "1").by(PublishedFigure).claims(
        "I1 and I3 of every coin of the catalogue differ from those of its published mass, diameter and thickness by \
         at most the limit, relative to their size; each coin of one list is in the other.",
    ),
    Check::of_solvers("bodies-published", Own(published)).up_to(ATTITUDE, "rad").by(PublishedFigure).claims(
        "Published motions of bodies that are no coins, of up to 100 s: the attitudes of seven flights that were \
         computed in 128 bits, two of them next to the separatrix and one on it, and the rates of NASA's check \
         case 2, a tumbling brick. Measured: the largest error (rad; of rates, relative to the largest).",
    ),
    Check::of_solvers(
        "cheated-heads-in-flight",
        Own(|context| at_every_speed(context, [1.0, 1.0, 2.5], Outcome::Heads)),
    )
    .up_to(0.0, "launches")
    .by(PublishedFigure)
    .claims(
        "(d) The cheated toss, ω = (1, 1, 2.5) rad/s, lands heads at every speed from 3 to 5 m/s. Measured: the \
         number of launches that do not; one is enough to fail.",
    ),
    Check::of_solvers("tails-in-flight", Own(|context| at_every_speed(context, [2.0, 2.0, 0.5], Outcome::Tails)))
        .up_to(0.0, "launches")
        .by(PublishedFigure)
        .claims(
            "The toss of Fig. 3, ω = (2, 2, 0.5) rad/s, lands tails at every speed from 3 to 5 m/s. Measured: the \
             number of launches that do not; one is enough to fail.",
        ),
    Check::of_solvers("cheated-heads-forever", Own(forever)).up_to(0.0, "launches").claims(
        "(d) The cheated toss of a disc lands heads after any time of flight: up to 10 000 s by closed forms, up to 30 \
         s by integrators. Measured: the number of launches that do not; one is enough to fail.",
    ),
    Check::of_solvers("first-flip", Own(first_flip)).up_to(ATTITUDE, "s").claims(
        "The outcome first changes at 1.3073 s for the cheated toss and at 0.5560 s for the tails toss. Measured: the \
         largest distance from the reference time; it fails above the limit.",
    ),
];

fn cos_tilt(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let error = |solver: &dyn Solver, flight: &ReferenceFlight| {
        let tilt = solver.tilt(&flight.toss)?;
        Ok(((tilt.cos_tilt - flight.cos_tilt()).abs(), tilt.error))
    };
    Ok(over_flights(context, error, |allowance| allowance.cos_tilt))
}

fn attitude(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let error = |solver: &dyn Solver, flight: &ReferenceFlight| {
        let landing = solver.land(&flight.toss)?;
        Ok((landing.state.attitude.angle_to(&flight.attitude), landing.error))
    };
    Ok(over_flights(context, error, |allowance| allowance.attitude))
}

/// The largest deviation of each subject over the reference flights, of which `found` gives it with the error estimate.
fn over_flights(
    context: &Context,
    found: impl Fn(&dyn Solver, &ReferenceFlight) -> Result<(f64, Option<f64>), SolveError> + Sync,
    allowed: fn(&Allowance) -> f64,
) -> Vec<Measurement> {
    let row = |subject: &Subject| {
        let trial = |flight: &ReferenceFlight| {
            let allowed = |estimate| Allowance::new(subject, &flight.toss, estimate).as_ref().map(allowed);
            let found = found(subject.solver.as_ref(), flight);
            Trial::by(subject, &flight.toss, found.map(|(deviation, estimate)| (deviation, allowed(estimate))))
        };
        Fold::Largest.of(&subject.name, &context.data.flights.iter().map(trial).collect::<Vec<_>>())
    };
    context.subjects.par_iter().map(row).collect()
}

fn moments(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let unknown = context.coins.iter().filter(|coin| CATALOGUE.iter().all(|entry| entry.name != coin.name));
    let unknown = unknown.map(|coin| (f64::INFINITY, coin.name.as_str()));
    let known = CATALOGUE.iter().map(|entry| (deviation_of_moments(context, entry), entry.name));
    let (largest, name) = known.chain(unknown).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, "none"));
    Ok(vec![Measurement::figure("catalogue", largest, CATALOGUE.len() as u64, name.to_owned())])
}

/// The larger of the relative deviations of I1 and I3; infinite for a coin without reference, or without moments.
fn deviation_of_moments(context: &Context, entry: &Entry) -> f64 {
    let reference = context.coins.iter().find(|coin| coin.name == entry.name);
    let (Some(reference), Ok(coin)) = (reference, entry.coin()) else { return f64::INFINITY };
    let relative = |(found, expected): (f64, f64)| (found / expected - 1.0).abs();
    [coin.i1(), coin.i3()].into_iter().zip([reference.i1, reference.i3]).map(relative).fold(0.0, f64::max)
}

fn published(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    Ok(context.subjects.par_iter().filter_map(|subject| by_published(context, subject)).collect())
}

/// The largest error of `subject` on the published motions, with the largest ratio to what its estimate allows; `None` of a
/// solver for coins.
fn by_published(context: &Context, subject: &Subject) -> Option<Measurement> {
    let bodies = &context.data.bodies;
    let landings: Vec<_> = bodies.par_iter().map(|body| subject.solver.land(&body.toss)).collect();
    if landings.iter().any(|landing| matches!(landing, Err(SolveError::NotSymmetric { .. }))) {
        return None;
    }
    let trial = |(body, landing): (&ReferenceBody, &Result<Landing, SolveError>)| {
        let found = landing.as_ref().map_err(Clone::clone).map(|landing| {
            // The published digits are fifteen.
            let allowed = landing.error.map_or(f64::INFINITY, |estimate| 10.0 * estimate.max(1e-15));
            (body.error(&landing.state), Some(allowed))
        });
        Trial::by(subject, &body.toss, found)
    };
    let trials: Vec<Trial<'_>> = bodies.iter().zip(&landings).map(trial).collect();
    Some(Fold::Largest.of(&subject.name, &trials))
}

fn at_every_speed(context: &Context, rate: [f64; 3], expected: Outcome) -> anyhow::Result<Vec<Measurement>> {
    let speeds = (0..=200).map(|step| 3.0 + 0.01 * f64::from(step));
    let flights = speeds.map(|speed| TimeOfFlight::Ballistic { speed, gravity: DEFAULT_GRAVITY });
    let tosses = thrown(Coin::PAPER, rate, flights)?;
    Ok(context.subjects.par_iter().map(|subject| misses(subject, &tosses, expected)).collect())
}

fn forever(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let measure = |subject: &Subject| {
        let flown = context.effort.of([20, 60, 60]);
        let (count, last): (u32, f64) = if subject.stepping.is_none() { (100_000, 10_000.0) } else { (flown, 30.0) };
        let times = (1..=count).map(|step| TimeOfFlight::Given(last * f64::from(step) / f64::from(count)));
        Ok(misses(subject, &thrown(Coin::DISC, [1.0, 1.0, 2.5], times)?, Outcome::Heads))
    };
    context.subjects.par_iter().map(measure).collect()
}

fn thrown(coin: Coin, rate: [f64; 3], flights: impl Iterator<Item = TimeOfFlight>) -> anyhow::Result<Vec<Toss>> {
    flights.map(|flight| Ok(Toss::new(coin, Launch::new(rate, flight)?))).collect()
}

/// The number of `tosses` that do not land as `expected`. Against a limit an undecided outcome counts; against the
/// solver's own claim only a wrong one does, because an error estimate may leave an outcome undecided.
fn misses(subject: &Subject, tosses: &[Toss], expected: Outcome) -> Measurement {
    let tilts: Vec<_> = tosses.par_iter().map(|toss| subject.solver.tilt(toss)).collect();
    let count = |is: &dyn Fn(Outcome) -> bool| {
        let trial = |(toss, tilt): (&Toss, &Result<Tilt, SolveError>)| {
            let found = tilt.clone().map(|tilt| (f64::from(is(tilt.outcome())), None));
            Trial::by(subject, toss, found)
        };
        Fold::Count.of(&subject.name, &tosses.iter().zip(&tilts).map(trial).collect::<Vec<_>>())
    };
    let wrong = count(&|outcome| ![expected, Outcome::Undecided].contains(&outcome));
    let is_claimed = tosses.iter().zip(&tilts).all(|(toss, tilt)| match tilt {
        Ok(tilt) => Allowance::new(subject, toss, tilt.error).is_some(),
        Err(_) => true,
    });
    Measurement { claim: wrong.claiming(is_claimed.then_some(0.0)).claim, ..count(&|outcome| outcome != expected) }
}

fn first_flip(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |subject: &Subject| {
        let trial = |flip: &FirstFlip| {
            let found = flip_time(subject.solver.as_ref(), flip)?;
            let off = |time: f64| (time - flip.toss.launch.flight_time()).abs();
            let found = found.and_then(|time| Ok((off(time), flip_allowance(subject, &flip.toss)?)));
            anyhow::Ok(Trial::by(subject, &flip.toss, found))
        };
        let trials: Vec<Trial<'_>> = context.data.first_flips.iter().map(trial).collect::<anyhow::Result<_>>()?;
        Ok(Fold::Largest.of(&subject.name, &trials))
    };
    context.subjects.par_iter().map(row).collect()
}

/// The error (s) that the solver's estimate allows for a flip at the landing of `toss`: the allowed error of cos θ
/// divided by its rate of change, doubled because that rate is not constant, plus the rounding of the time.
fn flip_allowance(subject: &Subject, toss: &Toss) -> Result<Option<f64>, SolveError> {
    let rate = Sensitivity::new(toss)?.cos_tilt[3].abs();
    let rounding = 4.0 * f64::EPSILON * toss.launch.flight_time();
    Ok(Allowance::of(subject, toss)?.map(|allowance| 2.0 * allowance.cos_tilt / rate + rounding))
}

/// The time (s) of the sign change of cos θ between launch and 1.5 times the expected time, by bisection.
fn flip_time(solver: &dyn Solver, flip: &FirstFlip) -> anyhow::Result<Result<f64, SolveError>> {
    let (mut heads, mut tails) = (0.0, 1.5 * flip.toss.launch.flight_time());
    for _ in 0..60 {
        let middle = 0.5 * (heads + tails);
        match solver.tilt(&flip.until(middle)?).map(|tilt| tilt.cos_tilt) {
            Ok(cos_tilt) if cos_tilt > 0.0 => heads = middle,
            Ok(_) => tails = middle,
            Err(error) => return Ok(Err(error)),
        }
    }
    Ok(Ok(0.5 * (heads + tails)))
}
