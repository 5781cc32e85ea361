//! The checks near the places where methods fail: what every contestant (a solver with a scheme and a formulation) does there,
//! compared with what is known of it; launches that are chosen to break solvers; and flights far longer than any toss, at
//! tolerances down to the finest, in which rounding adds up. Errors of an integrator grow with the time of flight, so an
//! error estimate that holds for short flights may fail for long ones. The raw equations of the paper are meant to fail at
//! hazards, so doing better than known fails the check too.

use rayon::prelude::*;
use toss::{Formulation, Scheme, SolveError, SolverEntry};

use super::landings::part_of_estimate;
use crate::measure::adversary::Answers;
use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::case;
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::hostile::{self, Flight};
use crate::measure::run::Answer;
use crate::measure::subject::Subject;
use crate::measure::trial::{Fold, Measurement, Trial, Worst};

pub(super) const CHECKS: &[Check] = &[
    Check::of_solvers("atlas-answers", Own(answers)).up_to(0.0, "hazards").claims(
        "Near every place where some method fails, each solver, scheme and formulation does what atlas.toml records: \
         it is right, returns an error, or is wrong as it is known to be. Measured: the number of places where it does \
         anything else; one is enough to fail.",
    ),
    Check::of_solvers("adversarial-silence", Own(silently_wrong)).up_to(0.0, "launches").claims(
        "On launches chosen to break solvers, each at one of five tolerances or of two steps, no answer is wrong \
         without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    ),
    Check::of_solvers("adversarial-refusals", Own(refused)).up_to(LARGEST_REFUSAL, "1").claims(
        "Of the launches chosen to break solvers, the fraction that a solver refuses with an error is at most the \
         limit, or a quarter without one.",
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
        let cases = HAZARDS.iter().map(|hazard| atlas.series(hazard.id, subject).count() as u64).sum();
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

fn silently_wrong(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |answers: &Answers| {
        let [wrong, unclaimed] = [Answer::SilentlyWrong, Answer::Unclaimed].map(|answer| answers.number_of(answer));
        let is_claimed = unclaimed.measured == 0.0;
        Measurement { worst: wrong.worst.or(unclaimed.worst), ..wrong }.claiming(is_claimed.then_some(0.0))
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
