//! The checks of what is proven by integration, by the 256-bit reference: the bounds of cos θ and of the attitude, which no
//! error may exceed, and the outcomes. The tosses include those where rounding is hardest: the corners of the model, units
//! that have to be rounded, tosses that land within a few ulp of a change of the outcome, and bodies with I1 ≠ I2 in families
//! each of which is hard for a method of its own. Next to a turn about the middle axis some flights have no bound; they are
//! no cases.

use dynamics::{Phases, Toss};
use rayon::prelude::*;
use toss::{IntegratedCertificate, Outcome, QuaternionSolver, SolveError, Stepping};

use super::exact::moved_to_an_edge;
use crate::measure::check::Fold::{Count, Largest, Median};
use crate::measure::check::Measure::{Both, Own, Tosses};
use crate::measure::check::{Check, Fold, Set};
use crate::measure::context::Context;
use crate::measure::families::{FAMILIES, FLOWN, Family, launches};
use crate::measure::reference::Reference;
use crate::measure::subject::taylor;
use crate::measure::tosses::{adversarial, corners, few_turns, random, tries};
use crate::measure::trial::{Measurement, Trial, Worst};

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("integrated-bounds", Both(&[Tosses(bounds, Largest), Own(bounds_of_bodies)]))
        .up_to(1.0, "1")
        .claims(
            "No error of cos θ or of the attitude exceeds the bound that its integration proves for it, at any \
             tolerance. Measured: the largest error divided by its bound; it fails above 1.",
        ),
    Check::of_library("integrated-outcomes", Tosses(outcomes, Count)).up_to(0.0, "tosses").claims(
        "Outcomes proven by integration are those of the 256-bit reference, also within 3 ulp of the speed at which \
         the outcome changes; those of bodies with I1 ≠ I2 may be undecided there. Measured: the number of tosses that \
         differ, those of coins also by being undecided; one is enough to fail.",
    ),
    Check::of_library("integrated-tightness", Tosses(tightness, Median)).up_to(300.0, "1").claims(
        "The bound that an integration at the default tolerance proves for the attitude is not far above its error. \
         Measured: the median of the bound divided by the error.",
    ),
];

fn tightness() -> Vec<Set> {
    let ratio = |toss: &Toss, reference: &Reference| {
        let found = usual()?.enclose(toss)?;
        Ok(found.attitude_error_bound() / distance(&found, reference))
    };
    [("phases to 1e2", 1e2, 10), ("phases to 1e3", 1e3, 10), ("phases to 1e5", 1e5, 100)]
        .map(|(name, phase, part)| Set::of_tries(name, move |tries| random(tries / part, phase, 36), ratio))
        .into()
}

/// The longest phase (rad) of launches at the corners: a flight of 1e4 rad takes some thousand steps.
const LONGEST: f64 = 1e4;

/// The solver that proves, at its default tolerance.
fn usual() -> Result<QuaternionSolver, SolveError> {
    taylor(Stepping::DEFAULT_TOLERANCE)
}

/// Refuses flights of more than the phase 1e5 rad, which would take minutes and are in none of the sets.
fn require_short(toss: &Toss) -> Result<(), SolveError> {
    let phase = Phases::new(toss)?.largest;
    let error =
        || SolveError::failed(QuaternionSolver::NAME, std::io::Error::other("flights above 1e5 rad are not flown"));
    (phase <= 1e5).then_some(()).ok_or_else(error)
}

/// The sets of coins, each with the tolerance of its flights.
fn bounds() -> Vec<Set> {
    fn set(name: &str, tolerance: f64, tosses: fn(u64) -> anyhow::Result<Vec<Toss>>) -> Set {
        let share = move |toss: &Toss, reference: &Reference| {
            require_short(toss)?;
            Ok(share(&taylor(tolerance)?.enclose(toss)?, reference))
        };
        Set::of_tries(name, tosses, share)
    }
    fn is_short(toss: &Toss) -> bool {
        Phases::new(toss).is_ok_and(|phases| phases.largest <= LONGEST)
    }
    vec![
        set("phases to 1e2", Stepping::DEFAULT_TOLERANCE, |tries| random(tries, 1e2, 31)),
        set("phases to 1e2, tolerance 1e-4", 1e-4, |tries| random(tries, 1e2, 32)),
        set("phases to 1e2, finest tolerance", f64::EPSILON, |tries| random(tries, 1e2, 33)),
        set("phases to 6e4", 1e-12, |tries| random(tries / 100, 6e4, 34)),
        set("corners", Stepping::DEFAULT_TOLERANCE, |_| Ok(corners()?.into_iter().filter(is_short).collect())),
        set("adversarial", f64::EPSILON, |tries| adversarial(tries / 4, few_turns)),
    ]
}

/// The larger one of the errors of cos θ and of the attitude, divided by their bounds.
pub(super) fn share(found: &IntegratedCertificate, reference: &Reference) -> f64 {
    let of_cos_tilt = reference.cos_tilt_error(found.cos_tilt()) / found.error_bound();
    of_cos_tilt.max(distance(found, reference) / found.attitude_error_bound())
}

/// The distance of the quaternions, which is half the angle between the attitudes, or less.
fn distance(found: &IntegratedCertificate, reference: &Reference) -> f64 {
    0.5 * reference.attitude_error(&found.landing().state.attitude)
}

/// The tolerances of the flights of bodies, one after the other.
const TOLERANCES: [f64; 4] = [Stepping::DEFAULT_TOLERANCE, 1e-4, 1e-7, f64::EPSILON];

fn bounds_of_bodies(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let solvers: Vec<QuaternionSolver> = TOLERANCES.into_iter().map(taylor).collect::<Result<_, SolveError>>()?;
    Ok(FAMILIES.iter().map(|family| bounds_of_family(context, family, &solvers)).collect())
}

/// The largest error of cos θ or of the attitude in a family, divided by its bound, by solvers in turn.
fn bounds_of_family(context: &Context, family: &Family, solvers: &[QuaternionSolver]) -> Measurement {
    let tosses = launches(family, tries(context.effort) / 20, FLOWN);
    let fly = |(index, toss): (usize, &Toss)| {
        let found = solvers[index % solvers.len()].enclose(toss).ok()?;
        (found.error_bound() < 2.0).then_some((index, *toss, found))
    };
    let bounded: Vec<(usize, Toss, IntegratedCertificate)> = tosses.par_iter().enumerate().filter_map(fly).collect();
    let judged = |(index, toss, found): &(usize, Toss, IntegratedCertificate)| {
        let trial = Trial::of_library(toss, Ok(share(found, &*context.exact.of(toss)?)));
        let tolerance = TOLERANCES[index % TOLERANCES.len()];
        let remark = format!("of {} tosses {} have a bound; tolerance {tolerance:e}", tosses.len(), bounded.len());
        Some(Trial { remark, ..trial })
    };
    let trials: Vec<Trial<'_>> = bounded.par_iter().filter_map(judged).collect();
    let found = Fold::Largest.of(&format!("bodies: {}", family.name), &trials);
    // The text of a toss has no tolerance, so that the whole check repeats it.
    found.with_worst(|worst| Worst { replay: None, ..worst }).beside_unjudged(bounded.len() - trials.len())
}

fn outcomes() -> Vec<Set> {
    let of_coin = |toss: &Toss, reference: &Reference| {
        require_short(toss)?;
        Ok(f64::from(usual()?.certify(toss)?.outcome() != reference.outcome()))
    };
    let coins = [
        Set::of_tries("random", |tries| random(tries, 1e2, 35), of_coin),
        Set::of_tries("adversarial", |tries| adversarial(tries / 4, few_turns), of_coin),
    ];
    // Next to an edge a body may be undecided.
    let of_body = |toss: &Toss, reference: &Reference| {
        let found = usual()?.certify(toss).map_or(Outcome::Undecided, |found| found.outcome());
        Ok(f64::from(found != Outcome::Undecided && found != reference.outcome()))
    };
    let of_family = |family: &'static Family| {
        let tosses = move |context: &Context| {
            let tosses = launches(family, tries(context.effort) / 20, FLOWN).into_iter();
            Ok(tosses.flat_map(|toss| [Some(toss), moved_to_an_edge(&toss)]).flatten().collect())
        };
        Set::new(format!("bodies: {}", family.name), tosses, of_body)
    };
    coins.into_iter().chain(FAMILIES.iter().map(of_family)).collect()
}
