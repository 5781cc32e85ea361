//! The checks of every subject (a solver with its settings) on random launches of coins and on bodies in families each of
//! which is hard for a method of its own: by the 256-bit reference, by what a free body conserves and by what they claim. Random launches show errors between the special cases that other checks choose. Solvers that refuse bodies
//! have no rows of them: what they must refuse is in the atlas.
//!
//! The paper itself checks (a) the length of the angular momentum S, (b) the kinetic energy, and (c) n·S, where n is the coin's
//! normal. (a) and (c) follow from (b) and S as a vector.

use std::f64::consts::TAU;

use dynamics::Phases;
use rayon::prelude::*;
use toss::{CoinMotion, Formulation, Landing, Launch, Scheme, SolverEntry, State, TimeOfFlight, Toss};

use crate::measure::any_launch;
use crate::measure::case::is_horizontal;
use crate::measure::check::Basis::Invariant;
use crate::measure::check::Measure::Own;
use crate::measure::check::ceiling::{ATTITUDE, COS_TILT};
use crate::measure::check::{Allowed, Check, Landed, Measure, OfLanding, of_landings};
use crate::measure::context::Context;
use crate::measure::drift;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::{Subject, by_scheme, tight};
use crate::measure::survey::{Landings, Survey};
use crate::measure::trial::{Fold, Measurement, Trial};

/// A deviation on the random launches, of which as much is allowed as of the attitude.
const fn random(deviation: OfLanding) -> Measure {
    random_allowing(deviation, |allowance| allowance.attitude)
}

const fn random_allowing(deviation: OfLanding, allowed: fn(&Allowance) -> f64) -> Measure {
    Measure::Landings { of: |context| context.survey.get(context), deviation, allowed: Allowed::By(allowed) }
}

const fn of_bodies(deviation: OfLanding, allowed: Allowed) -> Measure {
    Measure::Landings { of: |context| context.bodies.get(context), deviation, allowed }
}

pub(super) const CHECKS: &[Check] = &[
    Check::of_solvers("random-cos-tilt", random_allowing(cos_tilt_error, |allowance| allowance.cos_tilt))
        .up_to(COS_TILT, "1")
        .claims("On random launches, cos θ at landing differs from the 256-bit reference by at most the limit."),
    Check::of_solvers("random-attitude", random(attitude_error))
        .up_to(ATTITUDE, "rad")
        .claims("On random launches, the attitude at landing differs from the 256-bit reference by at most the limit."),
    Check::of_solvers("claims-measured", Own(claims)).up_to(LARGEST_RATIO, "1").claims(
        "A solver claims no errors that are far larger than its own. Measured: on random launches, the median of its \
         error estimates divided by its largest error of the attitude, which is never smaller than that of cos θ, or \
         by four roundings of the phase if they are larger; horizontal and tilted launches apart. It fails above the \
         limit, or at a thousand without one. A solver that is judged by what its tolerance permits makes no claim.",
    ),
    Check::of_solvers("any-launch", Own(any_launch)).up_to(1.0, "1").claims(
        "On coins of any two moments at any attitude Q or -Q, with rates of 1e-3 to 1e3 rad/s, times from 0 on and phases \
         of up to 3000 rad, the errors of cos θ and of the attitude are at most what the solver's estimate allows. \
         Measured: the largest error divided by that; it fails above the limit, or at 1 without one. A solver may return \
         an error for a phase above 1000 rad.",
    ),
    Check::of_solvers("vertical-frame-to-first-return", Own(first_return)).up_to(ATTITUDE, "rad").claims(
        "In the paper's vertical frame, from sin β = 0 at launch to 0.1 rad of phase before the first return there, \
         the attitude differs from the 256-bit reference by at most the limit.",
    ),
    Check::of_solvers("invariant-energy", random(|landed| drifted(landed, drift::energy)))
        .up_to(ATTITUDE, "1")
        .by(Invariant)
        .claims(
            "(b) The kinetic energy differs at landing from its value at launch by at most the limit, relative to that \
             value.",
        ),
    Check::of_solvers("invariant-momentum-vector", random(|landed| drifted(landed, drift::momentum_vector)))
        .up_to(ATTITUDE, "1")
        .by(Invariant)
        .claims(
            "The angular momentum S as a vector in the transport frame, computed from rate and attitude at landing, \
             differs from its value at launch by at most the limit, relative to |S|.",
        ),
    Check::of_solvers("invariant-projection", random(off_the_attitude)).up_to(COS_TILT, "1").by(Invariant).claims(
        "The quaternion of the attitude at landing has norm 1, and cos θ at landing is the cos θ of that attitude, \
         each to within the limit.",
    ),
    Check::of_solvers("bodies-within-estimate", of_bodies(part_of_allowed, Allowed::UpTo(1.0))).up_to(1.0, "1").claims(
        "On bodies of seven families, next to the separatrix and the middle axis too, with phases of 1 to 30 rad, the \
         errors of cos θ and of the attitude are at most what the solver's estimate allows. Measured: the largest \
         error divided by that; it fails above the limit, or at 1 without one. Where a solver states no estimate, it \
         decides nothing and is not judged.",
    ),
    Check::of_solvers("bodies-stated", Own(stated)).up_to(0.5, "1").claims(
        "A solver that lands a body states an estimate of its error. Measured: the share of tosses without one, which \
         no other check judges; of the families of `bodies-within-estimate`.",
    ),
    Check::of_solvers("bodies-attitude", of_bodies(steady_attitude_error, Allowed::NotJudged))
        .up_to(ATTITUDE, "rad")
        .claims(
            "On bodies of five families, away from the separatrix and the middle axis, with phases of 1 to 30 rad, the \
             attitude at landing differs from the 256-bit reference by at most the limit.",
        ),
    Check::of_solvers("bodies-conserved", of_bodies(drift_of_body, Allowed::NotJudged))
        .up_to(ATTITUDE, "1")
        .by(Invariant)
        .claims(
            "The angular momentum S of any body, its length and the kinetic energy differ at landing from their values \
             at launch by at most the limit, relative to those of a body that turns as fast about its largest axis.",
        ),
];

fn cos_tilt_error(landed: &Landed<'_>) -> Option<f64> {
    Some(landed.exact.cos_tilt_error(landed.landing.cos_tilt))
}

fn attitude_error(landed: &Landed<'_>) -> Option<f64> {
    Some(landed.exact.attitude_error(&landed.landing.state.attitude))
}

/// The largest ratio that is no fault. Error estimates hold for every launch, also those near the places where a method
/// fails, so that those of honest solvers are a few hundred times too large for most launches.
const LARGEST_RATIO: f64 = 1000.0;

/// |ω| (rad/s) below which launches are left out: whatever a solver claims for a coin that hardly turns, its error is
/// rounding.
const SLOW: f64 = 1.0;

/// A solver that claims enough would be right everywhere, where checks judge it by its own error estimate.
fn claims(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey.get(context)?;
    let (horizontal, tilted): (Vec<usize>, Vec<usize>) =
        (0..survey.tosses.len()).partition(|index| is_horizontal(&survey.tosses[*index].launch));
    let row = |(subject, landings): (&Subject, &Landings)| {
        let classes = [("horizontal", &horizontal), ("tilted", &tilted)];
        Measurement::worst_of(
            classes.map(|(name, class)| claims_of_class(survey, subject, landings, name, class)).into(),
        )
    };
    let estimates = |(subject, _): &(&Subject, _)| subject.solver.estimates_its_error();
    Ok(context.subjects.iter().zip(&survey.landings).filter(estimates).filter_map(row).collect())
}

/// The ratio of `subject` over the launches of one class.
fn claims_of_class(
    survey: &Survey,
    subject: &Subject,
    landings: &Landings,
    name: &str,
    class: &[usize],
) -> Measurement {
    let figure = |ratio, cases, input| Measurement::figure(&subject.name, ratio, cases, input);
    let (mut claims, mut phases, mut largest) = (Vec::new(), Vec::new(), 0.0_f64);
    for &index in class {
        let toss = &survey.tosses[index];
        // Launches that fail are counted by other checks.
        let (Ok(landing), Some(_)) = (&landings[index], toss.coin()) else { continue };
        if toss.launch.turn_rate() < SLOW {
            continue;
        }
        let Some(exact) = &survey.exact[index] else { continue };
        largest = largest.max(exact.attitude_error(&landing.state.attitude));
        let Some(claim) = landing.error else {
            return figure(f64::NAN, 0, "it claims no error".to_owned()).claiming(None);
        };
        match Phases::new(toss).map(|phases| phases.largest) {
            Ok(phase) => {
                claims.push(claim);
                phases.push(phase);
            }
            Err(error) => return figure(f64::NAN, 0, error.to_string()).claiming(Some(0.0)),
        }
    }
    let (number, claim, phase) = (claims.len() as u64, median(&mut claims), median(&mut phases));
    let rounding = 4.0 * f64::EPSILON * (1.0 + phase);
    let input = format!("{name} launches: claims {claim:.1e} in the median, largest error {largest:.1e} rad");
    figure(claim / largest.max(rounding), number, input).claiming(Some(LARGEST_RATIO))
}

/// The median; not a number if there are none.
fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Horizontal launches as the paper solves them: Euler angles and the γ-ODE in the vertical frame, in which both systems are
/// singular at launch, sin β = 0, and must leave it with the right attitude.
fn first_return(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut subjects = Vec::new();
    for entry in context.registry.iter().filter(|entry| entry.formulations().contains(&Formulation::VERTICAL)) {
        for scheme in entry.schemes().iter().filter(|scheme| scheme.is_adaptive()) {
            subjects.push(Subject::new(entry, Some(tight(*scheme)?), Formulation::VERTICAL));
        }
    }
    let survey = Survey::of(&subjects, returning_flights(context)?, Vec::new(), &context.exact);
    let allowed = Allowed::By(|allowance| allowance.attitude);
    let each = subjects.iter().zip(&survey.landings);
    Ok(each.filter_map(|by| of_landings(&survey, by, attitude_error, allowed)).collect())
}

/// The horizontal launches of the survey, each ending just before its first return.
fn returning_flights(context: &Context) -> anyhow::Result<Vec<Toss>> {
    /// Phase (rad) before the first return at which each flight ends.
    const DISTANCE: f64 = 0.1;
    /// Distance (rad) that the cone angle ψ keeps from 0 and π, where n stays near the vertical, and from π/2, where the
    /// coin turns end over end. The vertical frame's solvers divide by sin β, and such flights come too near to sin β = 0.
    const CLEARANCE: f64 = 0.1;
    let horizontal = context.survey.get(context)?.tosses.iter().filter(|toss| is_horizontal(&toss.launch));
    let mut tosses = Vec::new();
    for toss in horizontal.filter_map(Toss::coin) {
        let motion = CoinMotion::new(&toss);
        let from_right_angle = (motion.cone_angle() - TAU / 4.0).abs();
        if from_right_angle < CLEARANCE || TAU / 4.0 - from_right_angle < CLEARANCE {
            continue;
        }
        let time = TimeOfFlight::Given((TAU - DISTANCE) / motion.precession_rate());
        tosses.push(Toss::new(toss.coin, Launch::new(toss.launch.rate(), time)?));
    }
    Ok(tosses)
}

/// How far the quaternion is from norm 1, or cos θ from that of the attitude.
fn off_the_attitude(Landed { landing, .. }: &Landed<'_>) -> Option<f64> {
    let norm = landing.state.attitude.components().iter().map(|part| part * part).sum::<f64>().sqrt();
    Some((norm - 1.0).abs().max((landing.cos_tilt - landing.state.attitude.cos_tilt()).abs()))
}

fn drifted(landed: &Landed<'_>, drift: fn(&Toss, &State) -> f64) -> Option<f64> {
    landed.toss.coin().map(|_| drift(landed.toss, &landed.landing.state))
}

/// As [`part_of_estimate`].
pub(super) fn part_of_allowed(landed: &Landed<'_>) -> Option<f64> {
    part_of_estimate(landed.exact, landed.landing)
}

/// The larger one of the errors of cos θ and of the attitude, divided by what the estimate allows.
pub(super) fn part_of_estimate(exact: &Reference, landing: &Landing) -> Option<f64> {
    let allowed = Allowance::by_estimate(landing.error?);
    let attitude = exact.attitude_error(&landing.state.attitude);
    Some((exact.cos_tilt_error(landing.cos_tilt) / allowed.cos_tilt).max(attitude / allowed.attitude))
}

fn any_launch(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let tosses = any_launch::tosses(context.effort.of([1000, 2000, 20_000]))?;
    let row = |(entry, scheme): (&SolverEntry, Option<Scheme>)| {
        let by = |toss| Ok((toss, any_launch::subject(entry, scheme, any_launch::TOLERANCE, toss)?));
        let flights: Vec<(&Toss, Subject)> = tosses.iter().map(by).collect::<anyhow::Result<_>>()?;
        let trial = |(toss, by): &'_ (&Toss, Subject)| {
            let (landing, exact) = (by.solver.land(toss), context.exact.of(toss)?);
            if landing.is_err() && any_launch::may_be_declined(toss) {
                return None;
            }
            Some(landing.map(|landing| match part_of_estimate(&exact, &landing) {
                Some(part) => (part, Some(1.0)),
                None => (0.0, None),
            }))
        };
        let found: Vec<_> = flights.par_iter().map(trial).collect();
        let tried = flights.iter().zip(found).filter_map(|((toss, by), found)| Some(Trial::by(by, toss, found?)));
        let trials: Vec<Trial<'_>> = tried.collect();
        let name = flights.first().map(|(_, by)| by.name.clone()).unwrap_or_default();
        Ok(Fold::Largest.of(&name, &trials))
    };
    context.registry.iter().flat_map(by_scheme).map(row).collect()
}

fn stated(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.bodies.get(context)?;
    let row = |(subject, landings): (&Subject, &Landings)| {
        let is_silent = |landing: &Result<Landing, _>| landing.as_ref().is_ok_and(|one| one.error.is_none());
        let trial = |(toss, landing)| Trial::by(subject, toss, Ok((f64::from(is_silent(landing)), None)));
        let trials: Vec<Trial<'_>> = survey.tosses.iter().zip(landings).map(trial).collect();
        Fold::Share.of(&subject.name, &trials).without_claim()
    };
    let solve = context.subjects.iter().zip(&survey.landings).filter(|(_, landings)| !landings.is_empty());
    Ok(solve.map(row).collect())
}

/// The error of the attitude where a motion is steady. What the estimate allows is judged by `bodies-within-estimate`.
fn steady_attitude_error(landed: &Landed<'_>) -> Option<f64> {
    let is_steady = !["near the middle axis", "near the separatrix"].contains(&landed.family);
    is_steady.then(|| landed.exact.attitude_error(&landed.landing.state.attitude))
}

fn drift_of_body(landed: &Landed<'_>) -> Option<f64> {
    Some(drift::of_body(landed.toss, &landed.landing.state).into_iter().fold(0.0, f64::max))
}
