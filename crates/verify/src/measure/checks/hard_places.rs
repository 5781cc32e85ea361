//! The checks near the places where methods fail: what every contestant (a solver with a scheme and a formulation) does there,
//! compared with what is known of it, and what such a place costs; launches that are chosen to break solvers; and flights
//! far longer than any toss, also at the finest tolerances, in which rounding adds up. Errors of an integrator grow with the
//! time of flight, so an error estimate that holds for short flights may fail for long ones. The raw equations of the paper
//! are meant to fail at hazards, so doing better than known fails the check too.

use std::f64::consts::FRAC_PI_2;

use anyhow::Context as _;
use rayon::prelude::*;
use toss::{
    Attitude, CoinMotion, CoinToss, Formulation, InputError, Launch, Scheme, SolveError, Solver, SolverEntry, Stepping,
    Toss,
};

use super::landings::part_of_estimate;
use crate::measure::adversary::Findings;
use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::case::{self, is_horizontal};
use crate::measure::check::{Basis, Check, Landed, Measure, ceiling};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::families::FAMILIES;
use crate::measure::hostile::{self, Flight};
use crate::measure::long_flights::Drift;
use crate::measure::measurement::{Deviation, Measurement, Worst};
use crate::measure::reference::Reference;
use crate::measure::run::Answer;
use crate::measure::subject::Subject;

pub(super) const ANSWERS: Check = Check {
    id: "atlas-answers",
    claim: "Near every place where some method fails, each solver, scheme and formulation does what \
            atlas.toml records: it is right, returns an error, or is wrong as it is known to be. Measured: \
            the number of places where it does anything else; one is enough to fail.",
    unit: "hazards",
    measure: Measure::Own(answers),
    ..Check::OF_SOLVERS
};

pub(super) const TILT_WORK: Check = Check {
    id: "work-by-tilt",
    claim: "The calls of the right-hand side do not depend on how near to the vertical the coin's normal starts, for \
            tilts from 1 rad to 0. Measured: the most calls divided by the fewest, less 1; it fails above the limit.",
    basis: Basis::Invariant,
    ceiling: 1.0,
    measure: Measure::Own(tilt_work),
    ..Check::OF_SOLVERS
};

pub(super) const RETURN_WORK: Check = Check {
    id: "work-through-returns",
    claim: "A horizontal launch, on which the coin's normal returns to the vertical again and again, takes by default \
            no more calls of the right-hand side, unless it is short, than the same flight in the vertical formulation, \
            tilted so that the normal stays away from the vertical. Measured: the largest ratio of calls; it fails above \
            the limit.",
    basis: Basis::CrossMethod,
    ceiling: 3.0,
    measure: Measure::Own(return_work),
    ..Check::OF_SOLVERS
};

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
        let ratio = |toss: &Toss| -> Option<(Toss, Deviation)> {
            let seen = far_from_the_vertical(&toss.coin()?)?.into();
            Some((*toss, calls(&*cured.solver, toss).and_then(|here| Ok(here / calls(&*far.solver, &seen)?))))
        };
        let (flown, ratios): (Vec<Toss>, Vec<Deviation>) = horizontal.par_iter().filter_map(ratio).unzip();
        Ok(Measurement::largest(&cured, &ratios, |index| flown[index], |_| Ok(None)).without_claim())
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

pub(super) const SILENTLY_WRONG: Check = Check {
    id: "adversarial-silence",
    claim: "On launches chosen to break solvers, each at one of five tolerances or of two steps, no answer is wrong \
            without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    unit: "launches",
    measure: Measure::Own(|context| {
        searched(context, |findings| {
            let claim = (findings.unclaimed == 0).then_some(0.0);
            (findings.silently_wrong as f64, findings.first_wrong.clone(), claim)
        })
    }),
    ..Check::OF_SOLVERS
};

pub(super) const REFUSED: Check = Check {
    id: "adversarial-refusals",
    claim: "Of the launches chosen to break solvers, the fraction that a solver refuses with an error is at most the \
            limit, or a quarter without one.",
    ceiling: 0.25,
    measure: Measure::Own(|context| {
        searched(context, |findings| {
            // A refusal is what this row counts, so it is not reported as a failure of the measurement.
            let worst = findings.first_refused.clone().map(|worst| Worst { failure: None, ..worst });
            (findings.refused as f64 / findings.launches as f64, worst, Some(REFUSED.ceiling))
        })
    }),
    ..Check::OF_SOLVERS
};

/// What was measured, its worst case, and what is allowed without a limit.
type Counted = (f64, Option<Worst>, Option<f64>);

fn searched(context: &Context, found: fn(&Findings) -> Counted) -> anyhow::Result<Vec<Measurement>> {
    let row = |findings: &Findings| {
        let (subject, cases, (measured, worst, allowed)) =
            (findings.subject.clone(), findings.launches, found(findings));
        Measurement { measured, cases, worst, ..Measurement::of(&subject) }.claiming(allowed)
    };
    Ok(context.search.get(context)?.iter().map(row).collect())
}

pub(super) const LONG_ERROR: Check = Check {
    id: "long-flight-error",
    claim: "On flights of up to 10⁴ s the error of the attitude is within the solver's error estimate, or the solver \
            returns an error. Measured: the largest error divided by what the estimate allows; it fails above the \
            limit.",
    ceiling: 1.0,
    measure: Measure::Own(|context| {
        let part = |drift: &Drift| drift.err_attitude / drift.allowed.unwrap_or(0.0);
        over_long_flights(context, part, |drift| drift.allowed.map(|_| 1.0))
    }),
    ..Check::OF_SOLVERS
};

pub(super) const LONG_DRIFT: Check = Check {
    id: "long-flight-drift",
    claim: "On flights of up to 10⁴ s the angular momentum S in the transport frame differs at landing from its value \
            at launch by at most the limit, relative to |S|.",
    basis: Basis::Invariant,
    ceiling: ceiling::COS_TILT,
    measure: Measure::Own(|context| over_long_flights(context, |drift| drift.momentum_vector, |drift| drift.allowed)),
    ..Check::OF_SOLVERS
};

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

pub(super) const HOSTILE: Check = Check {
    id: "hostile-within-estimate",
    claim: "On flights of up to 1e6 rad at tolerances down to 2.3e-16, of coins and bodies whose rounding errors add up, the \
            errors of cos θ and of the attitude are at most what the solver's estimate allows, or the solver returns an \
            error. Measured: the largest error divided by that; it fails above the limit, or at 1 without one. Where a \
            solver states no estimate, it decides nothing and is not judged.",
    ceiling: 1.0,
    measure: Measure::Own(|context| {
        let integrators = context.registry.iter().filter(|entry| entry.integrates());
        let each: Vec<(&SolverEntry, Scheme)> =
            integrators.flat_map(|entry| entry.schemes().iter().map(move |scheme| (entry, *scheme))).collect();
        each.into_par_iter().map(|(entry, scheme)| on_hostile_flights(context.effort, entry, scheme)).collect()
    }),
    ..Check::OF_SOLVERS
};

fn on_hostile_flights(effort: Effort, entry: &SolverEntry, scheme: Scheme) -> anyhow::Result<Measurement> {
    let ([coins, bodies], most_steps) = hostile::numbers(effort);
    let families = FAMILIES.len() as u64;
    let coin = |index: u64| hostile::of_coin(entry, scheme, index, most_steps).map(Some);
    let body = |index: u64| hostile::of_body(entry, scheme, [index % families, index / families], most_steps);
    let flown = (0..coins).into_par_iter().map(coin).chain((0..bodies * families).into_par_iter().map(body));
    let land = |flight: Result<Option<Flight>, InputError>| {
        Ok(flight?.and_then(|flight| match land(&flight) {
            // A solver for coins flies no bodies.
            Err(SolveError::NotSymmetric { .. }) => None,
            part => Some((flight, part)),
        }))
    };
    let landings: Vec<_> = flown.map(land).collect::<Result<_, InputError>>()?;
    let landings: Vec<(Flight, Result<Judged, SolveError>)> = landings.into_iter().flatten().collect();
    let name = hostile::of_coin(entry, scheme, 0, most_steps)?.by.name;
    let number = |is: fn(&Result<Judged, SolveError>) -> bool| landings.iter().filter(|(_, part)| is(part)).count();
    let refused = number(Result::is_err);
    let silent = number(|part| matches!(part, Ok(Judged::Silent)));
    let unjudged = number(|part| matches!(part, Ok(Judged::WithoutReference)));
    let judged = landings.iter().filter_map(|(flight, part)| match part {
        Ok(Judged::Part(part)) => Some((flight, *part)),
        _ => None,
    });
    let over = judged.clone().filter(|(_, part)| *part > 1.0).count();
    let (Flight { toss, by }, measured) =
        judged.max_by(|a, b| a.1.total_cmp(&b.1)).context("every flight was refused")?;
    let settings = case::settings(by);
    let remark = format!("{}; {over} above; {refused} refused, {silent} without an estimate", settings.trim_start());
    let worst = Some(Worst::by(toss, by, None).remarking(&remark));
    let cases = (landings.len() - unjudged) as u64;
    Ok(Measurement { measured, cases, worst, ..Measurement::of(&name) }.claiming(Some(1.0)).beside_unjudged(unjudged))
}

/// How a flight is judged.
enum Judged {
    /// By its error, divided by what the estimate allows.
    Part(f64),
    /// Not at all, without an estimate.
    Silent,
    /// Not at all, without a reference.
    WithoutReference,
}

fn land(Flight { toss, by }: &Flight) -> Result<Judged, SolveError> {
    let landing = by.solver.land(toss)?;
    if landing.error.is_none() {
        return Ok(Judged::Silent);
    }
    let Ok(exact) = Reference::of(toss) else { return Ok(Judged::WithoutReference) };
    let part = part_of_estimate(&Landed { toss, family: "", exact: &exact, landing: &landing });
    Ok(part.map_or(Judged::Silent, Judged::Part))
}
