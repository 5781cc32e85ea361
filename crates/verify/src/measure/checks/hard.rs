//! The checks of bodies and launches for which no method has a simple case: nearly equal moments, tensors turned in any
//! direction, plates and rods, turns about an axis, quaternions of any norm, numbers in units. They ask of these the same
//! as other checks ask of random launches: accuracy, proofs, no silence, margins. The judge is the reference alone.

use dynamics::Toss;
use exact::certify;
use rayon::prelude::*;
use toss::{Outcome, Scheme, SolveError, Solver, SolverEntry, Stepping, TimeOfFlight};

use super::exact::{at_an_edge, attitude_error, cos_tilt_error};
use super::landings::{part_of_allowed, part_of_estimate};
use super::proofs::share;
use crate::measure::adversary::{self, Answers};
use crate::measure::check::Basis::CrossMethod;
use crate::measure::check::Fold::{Count, Largest, Share};
use crate::measure::check::Measure::{Own, Tosses};
use crate::measure::check::{Allowed, Check, Fold, Measure, Set};
use crate::measure::context::Context;
use crate::measure::families::{
    FAMILIES, Family, HARD, TOSSED, hard_number, hard_toss, hard_tosses, hard_tosses_of, launches,
};
use crate::measure::hostile;
use crate::measure::reference::Reference;
use crate::measure::run::Answer;
use crate::measure::subject::{Subject, by_scheme, taylor};
use crate::measure::tosses::random;
use crate::measure::trial::{Deviation, Measurement, Trial};

/// What the checks of the library on these bodies have in common.
pub(super) const CHECKS: &[Check] = &[
    Check::of_library("reference-closed-forms", Tosses(closed_forms, Largest))
        .up_to(1e-30, "rad")
        .by(CrossMethod)
        .claims(
            "Where the reference answers in closed form, its ground truth, an integration of the equations of motion \
             by Taylor series, lands at the same attitude: on coins, and on a sample of each family of bodies, for \
             phases of 1 to 100 rad. Measured: the largest angle between the two; it fails above the limit.",
        ),
    Check::of_library("hard-cos-tilt", Tosses(|| of_families(cos_tilt_error), Largest)).up_to(1e-15, "1").claims(
        "cos θ at landing from the exact motion differs from the reference by at most the limit, for bodies of eight \
         families without a simple case and phases of 1 to 30 rad.",
    ),
    Check::of_library("hard-attitude", Tosses(|| of_families(attitude_error), Largest)).up_to(1e-14, "rad").claims(
        "The attitude at landing from the exact motion differs from the reference by at most the limit, for bodies of \
         eight families without a simple case and phases of 1 to 30 rad.",
    ),
    Check::of_library("hard-outcomes", Tosses(outcomes, Count)).up_to(0.0, "tosses").claims(
        "The proven outcomes of bodies of eight families without a simple case are those of the reference, also within \
         3 ulp of a time at which the outcome changes. Measured: the number of tosses that differ or are undecided; \
         one is enough to fail.",
    ),
    Check::of_library("hard-integrated-outcomes", Tosses(integrated_outcomes, Count)).up_to(0.0, "tosses").claims(
        "Outcomes that an integration proves, of bodies of eight families without a simple case, are those of the \
         reference, also within 3 ulp of a time at which the outcome changes. Measured: the number of tosses with \
         another outcome, not counting those that stay undecided; one is enough to fail.",
    ),
    Check::of_library("hard-integrated-undecided", Tosses(undecided, Share)).up_to(0.5, "1").claims(
        "An integration proves the outcome of nearly all bodies of eight families without a simple case that don't \
         land next to a change of it. Measured: the share of tosses that stay undecided.",
    ),
    Check::of_library("hard-integrated-bounds", Tosses(integrated_bounds, Largest)).up_to(1.0, "1").claims(
        "No error of cos θ or of the attitude exceeds the bound that its integration proves for it, for bodies of \
         eight families without a simple case, where there is a bound. Measured: the largest error divided by its \
         bound; it fails above 1.",
    ),
    Check::of_solvers("hard-within-estimate", WITHIN_ESTIMATES).up_to(1.0, "1").claims(
        "On bodies of eight families without a simple case, with phases of 1 to 30 rad and flights of up to 50 s, the \
         errors of cos θ and of the attitude are at most what the solver's estimate allows. Measured: the largest \
         error divided by that; it fails above the limit, or at 1 without one. Where a solver states no estimate, it \
         decides nothing and is not judged.",
    ),
    Check::of_solvers("hard-silence", Own(silently_wrong)).up_to(0.0, "launches").claims(
        "On bodies of eight families without a simple case, each at one of five tolerances or of two steps, no answer \
         is wrong without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    ),
    Check::of_solvers("hard-long-flights", Own(long_flights)).up_to(1.0, "1").claims(
        "On flights of 100 rad at tolerances down to 2.3e-16, of bodies of eight families without a simple case, the \
         errors of cos θ and of the attitude are at most what the solver's estimate allows, or the solver returns an \
         error. Measured: the largest error divided by that; it fails above the limit, or at 1 without one.",
    ),
];

fn closed_forms() -> Vec<Set> {
    let angle = |toss: &Toss, _: &Reference| match Reference::in_closed_form(toss) {
        Some(closed) => Ok(closed.distance(&Reference::flown(toss)?)),
        None => Ok(0.0),
    };
    let number = |context: &Context| hard_number(context.effort) / 4;
    let coins = move |context: &Context| {
        let adversarial = (0..4 * number(context) as usize).map(|index| adversary::launch(8, index));
        let random = random(number(context), 100.0, 81)?.into_iter();
        Ok(random.chain(adversarial).filter(|toss| Reference::flown(toss).is_ok()).collect())
    };
    let bodies = |family: &'static Family, context: &Context| launches(family, hard_number(context.effort) / 4, TOSSED);
    Set::of_families(&FAMILIES, bodies, angle).into_iter().chain([Set::new("coins", coins, angle)]).collect()
}

fn of_families(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    Set::of_families(&HARD, |family, context| hard_tosses_of(family, hard_number(context.effort)), deviation)
}

/// The same, and for each family the same tosses within 3 ulp of a change of the outcome.
fn with_edges(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    let at_edges = |(index, family): (usize, &Family)| {
        let tosses = move |context: &Context| Ok(context.hard_edges.get(context)?[index].clone());
        Set::new(format!("{}, at an edge", family.name), tosses, deviation)
    };
    of_families(deviation).into_iter().chain(HARD.iter().enumerate().map(at_edges)).collect()
}

fn outcomes() -> Vec<Set> {
    with_edges(|toss, reference| Ok(f64::from(certify(toss)?.outcome() != reference.outcome())))
}

fn integrated_outcomes() -> Vec<Set> {
    with_edges(|toss, reference| {
        let found = integrated_outcome(toss)?;
        Ok(f64::from(found != Outcome::Undecided && found != reference.outcome()))
    })
}

fn undecided() -> Vec<Set> {
    of_families(|toss, _| Ok(f64::from(integrated_outcome(toss)? == Outcome::Undecided)))
}

fn integrated_bounds() -> Vec<Set> {
    of_families(|toss, reference| {
        let solver = taylor(Stepping::DEFAULT_TOLERANCE)?;
        Ok(solver.enclose(toss).map_or(0.0, |found| share(&found, reference)))
    })
}

const WITHIN_ESTIMATES: Measure = Measure::Landings {
    of: |context| context.hard.get(context),
    deviation: part_of_allowed,
    allowed: Allowed::UpTo(1.0),
};

/// The outcome that an integration at the default tolerance proves; undecided where it has no bound.
fn integrated_outcome(toss: &Toss) -> Result<Outcome, SolveError> {
    let solver = taylor(Stepping::DEFAULT_TOLERANCE)?;
    Ok(solver.certify(toss).map_or(Outcome::Undecided, |found| found.outcome()))
}

fn silently_wrong(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let tosses = hard_tosses(context.effort).into_iter().flatten();
    let (judged, unjudged): (Vec<Toss>, Vec<Toss>) = tosses.partition(|toss| context.exact.of(toss).is_some());
    let row = |answers: Answers| {
        let found = answers.number_of(Answer::SilentlyWrong);
        // Next to the separatrix a rough tolerance gives no estimate.
        let unclaimed = [Answer::TypedError, Answer::Unclaimed].map(|answer| answers.number_of(answer).measured);
        let claims = unclaimed.iter().sum::<f64>() < found.cases as f64;
        found.claiming(claims.then_some(0.0)).beside_unjudged(unjudged.len())
    };
    Ok(adversary::search_among(context, &judged)?.into_iter().map(row).collect())
}

fn long_flights(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const PHASE: f64 = 100.0;
    let number = hard_number(context.effort) / 12;
    let tosses = |family| (0..number).filter_map(move |index| hard_toss(family, index, Some(PHASE)));
    let tosses: Vec<Toss> = HARD.iter().flat_map(tosses).collect();
    let row = |(entry, scheme): (&SolverEntry, Scheme)| {
        let by = |(index, toss): (u64, &Toss)| Some((*toss, hostile::of_toss(entry, scheme, toss, index).ok()?));
        let flights: Vec<(Toss, Subject)> = (0..).zip(&tosses).filter_map(by).collect();
        let trials = flights.par_iter().filter_map(|(toss, by)| {
            let (landing, exact) = (by.solver.land(toss).ok()?, context.exact.of(toss)?);
            let part = part_of_estimate(&exact, &landing).unwrap_or(0.0);
            Some(Trial::by(by, toss, Ok((part, Some(1.0)))))
        });
        let trials: Vec<Trial<'_>> = trials.collect();
        let name = Subject::new(entry, Some(hostile::finest(scheme)?), toss::Formulation::default()).name;
        let unjudged = tosses.par_iter().filter(|toss| context.exact.of(toss).is_none()).count();
        anyhow::Ok(Fold::Largest.of(&name, &trials).beside_unjudged(unjudged))
    };
    let each = context.registry.iter().flat_map(by_scheme).filter_map(|(entry, scheme)| Some((entry, scheme?)));
    // A solver for coins flies few of these bodies.
    let flies_bodies = |(entry, scheme): &(&SolverEntry, Scheme)| {
        let first = tosses.iter().find(|toss| toss.coin().is_none());
        first.is_none_or(|toss| {
            let by = hostile::of_toss(entry, *scheme, toss, 0);
            by.is_ok_and(|by| !matches!(by.solver.land(toss), Err(SolveError::NotSymmetric { .. })))
        })
    };
    each.filter(flies_bodies).map(row).collect()
}

/// A toss of each family within 3 ulp of a time at which its outcome changes.
pub(crate) fn edges(context: &Context) -> anyhow::Result<Vec<Vec<Toss>>> {
    let solver = taylor(f64::EPSILON)?;
    let edge = |toss: &Toss| {
        at_an_edge(toss, |time| {
            let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(time)).ok()?;
            Some(solver.tilt(&Toss { launch, ..*toss }).ok()?.cos_tilt)
        })
    };
    let edges = |tosses: Vec<Toss>| tosses.par_iter().filter_map(edge).collect();
    Ok(hard_tosses(context.effort).into_iter().map(edges).collect())
}
