//! The checks of bodies and launches for which no method has a simple case: nearly equal moments, tensors turned in any
//! direction, plates and rods, turns about an axis, quaternions of any norm, numbers in units. They ask of these the same
//! as other checks ask of random launches: accuracy, proofs, no silence, margins. The judge is the reference alone.

use std::sync::Arc;

use dynamics::Toss;
use exact::{ExactMotion, certify};
use rayon::prelude::*;
use toss::{
    Launch, Outcome, QuaternionSolver, Scheme, SolveError, Solver, SolverEntry, Stepping, TimeOfFlight, Vector3, margin,
};

use super::exact::{edge_near, is_right};
use super::landings::part_of_estimate;
use super::proofs::share;
use crate::measure::adversary::{self, Findings};
use crate::measure::cases::{Case, hard_number};
use crate::measure::check::{Allowed, Basis, Check, Fold, Landed, Measure, Set};
use crate::measure::context::Context;
use crate::measure::families::{FAMILIES, Family, HARD, HardFamily, TOSSED, hard_toss, hard_tosses, launches};
use crate::measure::hostile;
use crate::measure::measurement::{Deviation, Measurement, Worst};
use crate::measure::reference::Reference;
use crate::measure::subject::{Subject, by_scheme, taylor};
use crate::measure::tosses::random;

/// What the checks of the library on these bodies have in common.
const OF_FAMILIES: Check = Check { ceiling: 0.0, unit: "tosses", ..Check::OF_LIBRARY };

pub(super) const CLOSED_FORMS: Check = Check {
    id: "reference-closed-forms",
    claim: "Where the reference answers in closed form, its ground truth, an integration of the equations of motion by \
            Taylor series, lands at the same attitude: on coins, and on a sample of each family of bodies, for phases of \
            1 to 100 rad. Measured: the largest angle between the two; it fails above the limit.",
    basis: Basis::CrossMethod,
    ceiling: 1e-30,
    unit: "rad",
    measure: Measure::Tosses(closed_forms, Fold::Largest),
    ..Check::OF_LIBRARY
};

fn closed_forms() -> Vec<Set> {
    let angle = |toss: &Toss, _: &Reference| match Reference::in_closed_form(toss) {
        Some(closed) => Ok(closed.distance(&Reference::flown(toss)?)),
        None => Ok(0.0),
    };
    let number = |context: &Context| hard_number(context.effort) / 4;
    let of_family = |family: &'static Family| {
        let tosses = move |context: &Context| Ok(launches(family, number(context), TOSSED).collect());
        Set::new(family.name, tosses, angle)
    };
    let coins = move |context: &Context| {
        let adversarial = (0..4 * number(context)).map(|index| adversary::launch(8, index));
        let random = random(number(context), 100.0, 81)?.into_iter().map(Toss::from);
        Ok(random.chain(adversarial).filter(|toss| Reference::flown(toss).is_ok()).collect())
    };
    FAMILIES.iter().map(of_family).chain([Set::new("coins", coins, angle)]).collect()
}

pub(super) const COS_TILT: Check = Check {
    id: "hard-cos-tilt",
    claim: "cos θ at landing from the exact motion differs from the reference by at most the limit, for bodies of eight \
            families without a simple case and phases of 1 to 30 rad.",
    ceiling: 1e-15,
    unit: "1",
    measure: Measure::Tosses(
        || {
            on_cases(|toss, reference| {
                Ok(reference.cos_tilt_error(ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?))
            })
        },
        Fold::Largest,
    ),
    ..OF_FAMILIES
};

pub(super) const ATTITUDE: Check = Check {
    id: "hard-attitude",
    claim: "The attitude at landing from the exact motion differs from the reference by at most the limit, for bodies of \
            eight families without a simple case and phases of 1 to 30 rad.",
    ceiling: 1e-14,
    unit: "rad",
    measure: Measure::Tosses(attitudes, Fold::Largest),
    ..OF_FAMILIES
};

fn attitudes() -> Vec<Set> {
    on_cases(|toss, reference| {
        Ok(reference.attitude_error(&ExactMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
    })
}

/// A set of each family, with the references that all checks of it share.
fn on_cases(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    let set = |(index, family): (usize, &HardFamily)| {
        Set::of_cases(family.name, move |context| Ok(context.hard_bodies.get(context)?[index].clone()), deviation)
    };
    HARD.iter().enumerate().map(set).collect()
}

/// The same, and for each family the same tosses within 3 ulp of a change of the outcome.
fn with_edges(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    let at_edges = |(index, family): (usize, &HardFamily)| {
        let cases = move |context: &Context| Ok(context.hard_edges.get(context)?[index].clone());
        Set::of_cases(format!("{}, at an edge", family.name), cases, deviation)
    };
    on_cases(deviation).into_iter().chain(HARD.iter().enumerate().map(at_edges)).collect()
}

pub(super) const OUTCOMES: Check = Check {
    id: "hard-outcomes",
    claim: "The proven outcomes of bodies of eight families without a simple case are those of the reference, also within \
            3 ulp of a time at which the outcome changes. Measured: the number of tosses that differ or are undecided; one \
            is enough to fail.",
    measure: Measure::Tosses(
        || with_edges(|toss, reference| Ok(f64::from(certify(toss)?.outcome() != reference.outcome()))),
        Fold::Count,
    ),
    ..OF_FAMILIES
};

pub(super) const INTEGRATED_OUTCOMES: Check = Check {
    id: "hard-integrated-outcomes",
    claim: "Outcomes that an integration proves, of bodies of eight families without a simple case, are those of the \
            reference, also within 3 ulp of a time at which the outcome changes. Measured: the number of tosses with \
            another outcome, not counting those that stay undecided; one is enough to fail.",
    measure: Measure::Tosses(
        || {
            with_edges(|toss, reference| {
                let found = integrated_outcome(toss)?;
                Ok(f64::from(found != Outcome::Undecided && found != reference.outcome()))
            })
        },
        Fold::Count,
    ),
    ..OF_FAMILIES
};

pub(super) const INTEGRATED_UNDECIDED: Check = Check {
    id: "hard-integrated-undecided",
    claim: "An integration proves the outcome of nearly all bodies of eight families without a simple case that don't land \
            next to a change of it. Measured: the share of tosses that stay undecided.",
    ceiling: 0.5,
    unit: "1",
    measure: Measure::Tosses(
        || on_cases(|toss, _| Ok(f64::from(integrated_outcome(toss)? == Outcome::Undecided))),
        Fold::Mean,
    ),
    ..OF_FAMILIES
};

/// The outcome that an integration at the default tolerance proves; undecided where it has no bound.
fn integrated_outcome(toss: &Toss) -> Result<Outcome, SolveError> {
    let solver = taylor(Stepping::DEFAULT_TOLERANCE)?;
    Ok(solver.certify(toss).map_or(Outcome::Undecided, |found| found.outcome()))
}

pub(super) const INTEGRATED_BOUNDS: Check = Check {
    id: "hard-integrated-bounds",
    claim: "No error of cos θ or of the attitude exceeds the bound that its integration proves for it, for bodies of eight \
            families without a simple case, where there is a bound. Measured: the largest error divided by its bound; it \
            fails above 1.",
    ceiling: 1.0,
    unit: "1",
    measure: Measure::Tosses(
        || {
            on_cases(|toss, reference| {
                let solver: QuaternionSolver = taylor(Stepping::DEFAULT_TOLERANCE)?;
                Ok(solver.enclose(toss).map_or(0.0, |found| share(&found, reference)))
            })
        },
        Fold::Largest,
    ),
    ..OF_FAMILIES
};

pub(super) const WITHIN_ESTIMATE: Check = Check {
    id: "hard-within-estimate",
    claim: "On bodies of eight families without a simple case, with phases of 1 to 30 rad and flights of up to 50 s, the \
            errors of cos θ and of the attitude are at most what the solver's estimate allows. Measured: the largest error divided by that; it fails \
            above the limit, or at 1 without one. Where a solver states no estimate, it decides nothing and is not judged.",
    ceiling: 1.0,
    measure: Measure::Landings {
        of: |context| context.hard.get(context),
        deviation: part_of_estimate,
        allowed: Allowed::UpTo(1.0),
    },
    ..Check::OF_SOLVERS
};

pub(super) const SILENTLY_WRONG: Check = Check {
    id: "hard-silence",
    claim: "On bodies of eight families without a simple case, each at one of five tolerances or of two steps, no answer is \
            wrong without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    unit: "launches",
    measure: Measure::Own(silently_wrong),
    ..Check::OF_SOLVERS
};

fn silently_wrong(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let cases = context.hard_bodies.get(context)?.iter().flatten();
    let (judged, unjudged): (Vec<&Case>, Vec<&Case>) = cases.partition(|case| case.reference.is_some());
    let case = |index: u64| {
        let case = judged[usize::try_from(index).unwrap_or(0)];
        Ok((case.toss, case.reference.clone().unwrap_or(Arc::new(Reference::of(&case.toss)?))))
    };
    let row = |Findings { subject, launches, refused, silently_wrong, unclaimed, first_wrong, .. }| {
        let (measured, worst) = (silently_wrong as f64, first_wrong);
        let found = Measurement { measured, cases: launches, worst, ..Measurement::of(&subject) };
        // Next to the separatrix a rough tolerance gives no estimate.
        let claims = refused + unclaimed < launches;
        found.claiming(claims.then_some(0.0)).beside_unjudged(unjudged.len())
    };
    let found = adversary::search_among(&context.registry, judged.len() as u64, case)?;
    Ok(found.into_iter().map(row).collect())
}

pub(super) const LONG_FLIGHTS: Check = Check {
    id: "hard-long-flights",
    claim: "On flights of 100 rad at tolerances down to 2.3e-16, of bodies of eight families without a simple case, the \
            errors of cos θ and of the attitude are at most what the solver's estimate allows, or the solver returns an \
            error. Measured: the largest error divided by that; it fails above the limit, or at 1 without one.",
    ceiling: 1.0,
    measure: Measure::Own(long_flights),
    ..Check::OF_SOLVERS
};

fn long_flights(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const PHASE: f64 = 100.0;
    let number = hard_number(context.effort) / 12;
    let tosses = |family| (0..number).filter_map(move |index| hard_toss(family, index, Some(PHASE)));
    let tosses: Vec<Toss> = HARD.iter().flat_map(tosses).collect();
    let references: Vec<Option<Reference>> = tosses.par_iter().map(|toss| Reference::of(toss).ok()).collect();
    let unjudged = references.iter().filter(|reference| reference.is_none()).count();
    let row = |(entry, scheme): (&SolverEntry, Scheme)| {
        let part = |(index, (toss, exact)): (usize, (&Toss, &Option<Reference>))| {
            let by = hostile::of_toss(entry, scheme, toss, index as u64).ok()?;
            let found = by.solver.land(toss).ok().zip(exact.as_ref());
            let part = found.map(|(landing, exact)| {
                part_of_estimate(&Landed { toss, family: "", exact, landing: &landing }).unwrap_or(0.0)
            });
            part.map(|part| (part, Worst::by(toss, &by, None)))
        };
        let parts = tosses.par_iter().zip(&references).enumerate().filter_map(part);
        let parts: Vec<(f64, Worst)> = parts.collect();
        let name = Subject::new(entry, Some(hostile::finest(scheme)?), toss::Formulation::default()).name;
        let cases = parts.len() as u64;
        let (measured, worst) = parts.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unzip();
        let measured = measured.unwrap_or(f64::INFINITY);
        anyhow::Ok(
            Measurement { measured, cases, worst, ..Measurement::of(&name) }
                .claiming(Some(1.0))
                .beside_unjudged(unjudged),
        )
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

pub(super) const MARGINS: Check = Check {
    id: "hard-margins",
    claim: "Where a margin of a body says that the outcome changes with one input, the reference changes there, to a \
            relative 1e-9. No toss that was looked at in between has another outcome, nor has any that was looked at for an \
            input without a margin: that is a sample, and a flip between two looks would not be seen. Measured: the number \
            of inputs of a toss with a wrong margin; one is enough to fail.",
    unit: "inputs",
    measure: Measure::Tosses(margins, Fold::Largest),
    ..OF_FAMILIES
};

fn margins() -> Vec<Set> {
    let set = |family: &'static HardFamily| {
        let tosses = move |context: &Context| Ok(hard_tosses(family, hard_number(context.effort) / 12));
        Set::new(family.name, tosses, wrong_margins)
    };
    HARD.iter().map(set).collect()
}

/// The number of inputs whose margin is wrong: time, ωx, ωy and ωz, in the units that the toss was given in.
fn wrong_margins(toss: &Toss, reference: &Reference) -> Deviation {
    const LOOKS: u32 = 3;
    let (found, outcome) = (margin(toss)?, reference.outcome());
    let (time, turn) = (toss.launch.flight_time(), 3.0 / toss.launch.flight_time());
    // The rounding of a rate in another unit would move the toss.
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time));
    let launch = launch.map_err(|error| SolveError::failed("the check", error))?;
    let si = Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss };
    let after = |change: &dyn Fn(&Launch) -> Option<Launch>| {
        let launch = change(&si.launch)?.with_attitude(toss.launch.attitude());
        Some(Reference::of(&Toss { launch, ..si }).ok()?.outcome())
    };
    let later = |change: f64| {
        let time = TimeOfFlight::Given(time + change);
        after(&|launch| launch.with_time_of_flight(time).ok())
    };
    let mut wrong = usize::from(!is_right(
        time,
        found.time,
        found.time_range.map_or(time, |[earlier, _]| earlier.min(time)),
        outcome,
        LOOKS,
        later,
    ));
    for axis in 0..3 {
        let faster = |change: f64| {
            let rate = toss.launch.rate() + Vector3::ith(axis, change);
            after(&|launch| Launch::new(rate, launch.time_of_flight()).ok())
        };
        let (value, range) = (toss.launch.rate()[axis], found.rate_range[axis].min(turn));
        wrong += usize::from(!is_right(value, found.rate[axis], range, outcome, LOOKS, faster));
    }
    Ok(wrong as f64)
}

/// A toss of each family within 3 ulp of a time at which its outcome changes.
pub(crate) fn edges(context: &Context) -> anyhow::Result<Vec<Vec<Case>>> {
    let solver = taylor(f64::EPSILON)?;
    let edge = |case: &Case| Some(Case::solved(edge_of_body(&solver, &case.toss)?));
    let all = context.hard_bodies.get(context)?;
    Ok(all.iter().map(|cases| cases.par_iter().filter_map(edge).collect()).collect())
}

/// The same toss with a time within 3 ulp of one at which the outcome changes: found by an integration in f64, and moved
/// to the edge by the reference.
fn edge_of_body(solver: &QuaternionSolver, toss: &Toss) -> Option<Toss> {
    let until = |time: f64| {
        let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(time)).ok()?;
        Some(Toss { launch, ..*toss })
    };
    let edge = edge_near(toss, |time| solver.tilt(&until(time)?).ok().map(|tilt| tilt.cos_tilt))?;
    let edge = edge + Reference::of(&until(edge)?).ok()?.time_to_an_edge();
    let ulps = (edge.to_bits() % 7) as i64 - 3;
    (edge > 0.0).then(|| until(f64::from_bits(edge.to_bits().wrapping_add_signed(ulps)))).flatten()
}
