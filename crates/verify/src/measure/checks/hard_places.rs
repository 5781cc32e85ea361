//! The checks near the places where methods fail: what every contestant (a solver with a scheme and a formulation) does there,
//! compared with what is known of it, and what such a place costs; launches that are chosen to break solvers; and flights
//! far longer than any toss, also at the finest tolerances, in which rounding adds up. Errors of an integrator grow with the
//! time of flight, so an error estimate that holds for short flights may fail for long ones. The raw equations of the paper
//! are meant to fail at hazards, so doing better than known fails the check too.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;
use toss::{
    Attitude, CoinMotion, CoinToss, Formulation, Launch, Scheme, SolveError, Solver, SolverEntry, Stepping, Toss,
};

use super::landings::part_of_estimate;
use crate::measure::adversary::Answers;
use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::case::{self, is_horizontal};
use crate::measure::check::Basis::{CrossMethod, Invariant};
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::check::ceiling::COS_TILT;
use crate::measure::context::Context;
use crate::measure::hostile::{self, Flight};
use crate::measure::long_flights::Drift;
use crate::measure::run::Answer;
use crate::measure::subject::Subject;
use crate::measure::trial::{Fold, Measurement, Trial, Worst};

pub(super) const CHECKS: &[Check] = &[
    Check::of_solvers("atlas-answers", Own(answers)).up_to(0.0, "hazards").claims(
        "Near every place where some method fails, each solver, scheme and formulation does what atlas.toml records: \
         it is right, returns an error, or is wrong as it is known to be. Measured: the number of places where it does \
         anything else; one is enough to fail.",
    ),
    Check::of_solvers("work-by-tilt", Own(tilt_work)).up_to(1.0, "1").by(Invariant).claims(
        "The calls of the right-hand side do not depend on how near to the vertical the coin's normal starts, for \
         tilts from 1 rad to 0. Measured: the most calls divided by the fewest, less 1; it fails above the limit.",
    ),
    Check::of_solvers("work-through-returns", Own(return_work)).up_to(3.0, "1").by(CrossMethod).claims(
        "A horizontal launch, on which the coin's normal returns to the vertical again and again, takes by default no \
         more calls of the right-hand side, unless it is short, than the same flight in the vertical formulation, \
         tilted so that the normal stays away from the vertical. Measured: the largest ratio of calls; it fails above \
         the limit.",
    ),
    Check::of_solvers("adversarial-silence", Own(silently_wrong)).up_to(0.0, "launches").claims(
        "On launches chosen to break solvers, each at one of five tolerances or of two steps, no answer is wrong \
         without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    ),
    Check::of_solvers("adversarial-refusals", Own(refused)).up_to(LARGEST_REFUSAL, "1").claims(
        "Of the launches chosen to break solvers, the fraction that a solver refuses with an error is at most the \
         limit, or a quarter without one.",
    ),
    Check::of_solvers("long-flight-error", Own(long_errors)).up_to(1.0, "1").claims(
        "On flights of up to 10⁴ s the error of the attitude is within the solver's error estimate, or the solver \
         returns an error. Measured: the largest error divided by what the estimate allows; it fails above the limit.",
    ),
    Check::of_solvers("long-flight-drift", Own(long_drifts)).up_to(COS_TILT, "1").by(Invariant).claims(
        "On flights of up to 10⁴ s the angular momentum S in the transport frame differs at landing from its value at \
         launch by at most the limit, relative to |S|.",
    ),
    Check::of_solvers("hostile-within-estimate", Own(hostile_flights)).up_to(1.0, "1").claims(
        "On flights of up to 1e6 rad at tolerances down to 2.3e-16, of coins and bodies whose rounding errors add up, \
         the errors of cos θ and of the attitude are at most what the solver's estimate allows, or the solver returns \
         an error. Measured: the largest error divided by that; it fails above the limit, or at 1 without one. Where a \
         solver states no estimate, it decides nothing and is not judged.",
    ),
];

fn answers(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let atlas = context.atlas.get(context)?;
    let row = |subject: &str| {
        let (mut unexpected, mut is_unclaimed) = (Vec::new(), false);
        for hazard in HAZARDS {
            let (found, expected) = (atlas.worst(hazard.id, subject), expected(context, subject, hazard.id));
            is_unclaimed |= found == Some(Answer::Unclaimed);
            if !found.zip(expected).is_some_and(|(found, expected)| expected.allows(found)) {
                let found = found.map_or("nothing", Answer::name);
                let expected = expected.map_or("nothing", Expectation::name);
                unexpected.push(format!("{}: {found}, where {expected} is expected", hazard.id));
            }
        }
        let cases = HAZARDS.iter().map(|hazard| hazard.distances.len() as u64).sum();
        let input =
            if unexpected.is_empty() { "as expected at every hazard".to_owned() } else { unexpected.join("; ") };
        let found = Measurement::figure(subject, unexpected.len() as f64, cases, input);
        found.claiming((!is_unclaimed).then_some(0.0))
    };
    Ok(atlas.subjects().into_iter().map(row).collect())
}

/// What `subject` is known to do at `hazard`. A subject that the table does not list may be right or return a typed
/// error.
fn expected(context: &Context, subject: &str, hazard: &str) -> Option<Expectation> {
    let known = context.expected.knows(subject);
    if known { context.expected.get(subject, hazard) } else { Some(Expectation::RightOrTypedError) }
}

/// The calls of each default solver over the distances of hazard F1, which are the tilts at launch.
fn tilt_work(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let atlas = context.atlas.get(context)?;
    let row = |subject: &Subject| {
        // A flight that fails has no count, and then the spread of the whole row is not a number.
        let calls: Option<Vec<u64>> = atlas.series("F1", &subject.name).map(|spot| spot.run.rhs_calls).collect();
        let calls = calls.unwrap_or_default();
        let (fewest, most) = (calls.iter().min(), calls.iter().max());
        let spread = fewest.zip(most).map_or(f64::NAN, |(fewest, most)| *most as f64 / *fewest as f64 - 1.0);
        let input = match fewest.zip(most) {
            Some((fewest, most)) => format!("{fewest} to {most} calls for tilts from 1 rad to 0"),
            None => "a flight failed".to_owned(),
        };
        Measurement::figure(&subject.name, spread, calls.len() as u64, input).without_claim()
    };
    Ok(context.subjects.iter().filter(|subject| subject.stepping.is_some()).map(row).collect())
}

fn return_work(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    // Slow coins do not return to the vertical.
    let returns = |toss: &&Toss| is_horizontal(&toss.launch) && toss.launch.turn_rate() > 1.0;
    let horizontal: Vec<Toss> = context.survey.get(context)?.tosses.iter().filter(returns).copied().collect();
    let with_angles = |entry: &&SolverEntry| entry.formulations().contains(&Formulation::VERTICAL);
    let adaptive = |entry: &SolverEntry| entry.schemes().iter().copied().find(|scheme| scheme.is_adaptive());
    let row = |(entry, scheme): (&SolverEntry, Scheme)| {
        let stepping = Stepping::adaptive(scheme, Stepping::DEFAULT_TOLERANCE)?;
        let [cured, far] = [Formulation::MOMENTUM, Formulation::VERTICAL]
            .map(|formulation| Subject::new(entry, Some(stepping), formulation));
        let ratio = |toss: &Toss| {
            let seen = far_from_the_vertical(&toss.coin()?)?.into();
            let ratio = calls(&*cured.solver, toss).and_then(|here| Ok((here / calls(&*far.solver, &seen)?, None)));
            Some(Trial::by(&cured, toss, ratio))
        };
        let ratios: Vec<Trial<'_>> = horizontal.par_iter().filter_map(ratio).collect();
        Ok(Fold::Largest.of(&cured.name, &ratios).without_claim())
    };
    let angles = context.registry.iter().filter(with_angles);
    angles.filter_map(|entry| Some((entry, adaptive(entry)?))).map(row).collect()
}

fn calls(solver: &dyn Solver, toss: &Toss) -> Result<f64, SolveError> {
    Ok(solver.land(toss)?.work.rhs_calls as f64)
}

/// The same flight, turned so that the angular momentum S is tilted from the vertical by half of the tilt that would
/// let n pass through the vertical or its opposite; `None` where the cone of n about S leaves too little room for that.
fn far_from_the_vertical(toss: &CoinToss) -> Option<CoinToss> {
    const ROOM: f64 = 0.3;
    let cone = CoinMotion::new(toss).cone_angle();
    let room = FRAC_PI_2 - (FRAC_PI_2 - cone).abs();
    if room < ROOM {
        return None;
    }
    let rate = toss.launch.rate();
    // The turn about n brings S over -y; the turn about x then brings S upright and beyond by half the room.
    let attitude = Attitude::about_x(0.5 * room - cone) * Attitude::about_z(-FRAC_PI_2 - rate.y.atan2(rate.x));
    let launch = Launch::new(rate, toss.launch.time_of_flight()).ok()?.with_attitude(attitude);
    Some(CoinToss { launch, ..*toss })
}

fn silently_wrong(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |answers: &Answers| {
        let is_claimed = answers.number_of(Answer::Unclaimed).measured == 0.0;
        answers.number_of(Answer::SilentlyWrong).claiming(is_claimed.then_some(0.0))
    };
    Ok(context.search.get(context)?.iter().map(row).collect())
}

/// The largest fraction of launches that a solver without a limit may refuse.
const LARGEST_REFUSAL: f64 = 0.25;

fn refused(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |answers: &Answers| {
        // A refusal is what this row counts, so it is not reported as a failure of the measurement.
        let refused = answers.number_of(Answer::TypedError).with_worst(|worst| Worst { failure: None, ..worst });
        let measured = refused.measured / refused.cases as f64;
        Measurement { measured, ..refused }.claiming(Some(LARGEST_REFUSAL))
    };
    Ok(context.search.get(context)?.iter().map(row).collect())
}

fn long_errors(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let part = |drift: &Drift| drift.err_attitude / drift.allowed.unwrap_or(0.0);
    over_long_flights(context, part, |drift| drift.allowed.map(|_| 1.0))
}

fn long_drifts(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    over_long_flights(context, |drift| drift.momentum_vector, |drift| drift.allowed)
}

/// The largest `part` of each subject over the flights that it solved, with what its error estimate allows for that
/// part.
fn over_long_flights(
    context: &Context,
    part: fn(&Drift) -> f64,
    allowed: fn(&Drift) -> Option<f64>,
) -> anyhow::Result<Vec<Measurement>> {
    let flights = context.long_flights.get(context)?;
    let row = |subject: &str| {
        let solved: Vec<(f64, &Drift)> =
            flights.of(subject).filter_map(|(time, found)| Some((time, found.as_ref().ok()?))).collect();
        let refused = flights.of(subject).count() - solved.len();
        let figure = |time: f64, measured: f64| {
            let input = format!("ω = (1, 1, 2.5) rad/s for {time} s; {refused} longer flights refused");
            Measurement::figure(subject, measured, solved.len() as u64, input)
        };
        let all = solved.iter().map(|(time, drift)| figure(*time, part(drift)).claiming(allowed(drift))).collect();
        Measurement::worst_of(all).unwrap_or_else(|| figure(0.0, f64::NAN).claiming(Some(0.0)))
    };
    Ok(flights.subjects().map(row).collect())
}

fn hostile_flights(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let integrators = context.registry.iter().filter(|entry| entry.integrates());
    let each: Vec<(&SolverEntry, Scheme)> =
        integrators.flat_map(|entry| entry.schemes().iter().map(move |scheme| (entry, *scheme))).collect();
    each.into_par_iter().map(|(entry, scheme)| on_hostile_flights(context, entry, scheme)).collect()
}

fn on_hostile_flights(context: &Context, entry: &SolverEntry, scheme: Scheme) -> anyhow::Result<Measurement> {
    let flights = hostile::flights(entry, scheme, context.effort)?;
    let landings: Vec<_> = flights.par_iter().map(|Flight { toss, by }| by.solver.land(toss)).collect();
    let errors = landings.iter().filter_map(|landing| landing.as_ref().err());
    // A solver for coins flies no bodies.
    let refused = errors.filter(|error| !matches!(error, SolveError::NotSymmetric { .. })).count();
    let landed = flights.iter().zip(&landings).filter_map(|(flight, landing)| Some((flight, landing.as_ref().ok()?)));
    let (stated, silent): (Vec<_>, Vec<_>) = landed.partition(|(_, landing)| landing.error.is_some());
    let trials = stated.par_iter().filter_map(|(Flight { toss, by }, landing)| {
        let part = part_of_estimate(&*context.exact.of(toss)?, landing)?;
        Some(Trial::by(by, toss, Ok((part, Some(1.0)))))
    });
    let mut trials: Vec<Trial<'_>> = trials.collect();
    let over = trials.iter().filter(|trial| trial.deviation.as_ref().is_ok_and(|part| *part > 1.0)).count();
    for trial in &mut trials {
        let settings = trial.by.map(case::settings).unwrap_or_default();
        let silent = silent.len();
        trial.remark =
            format!("{}; {over} above; {refused} refused, {silent} without an estimate", settings.trim_start());
    }
    let unjudged = stated.len() - trials.len();
    let name = Subject::new(entry, Some(hostile::finest(scheme)?), Formulation::default()).name;
    let found = Fold::Largest.of(&name, &trials);
    Ok(Measurement { cases: found.cases + (refused + silent.len()) as u64, ..found }.beside_unjudged(unjudged))
}
