//! These checks compare the exact motion (the closed form in double-double arithmetic) and the outcomes that it proves
//! with the 256-bit reference. Its last bits and its proofs depend on rounding, so the launches include those where
//! rounding is hardest: large phases, corners of the model, and tosses that land within a few ulp of a change of the
//! outcome.
//!
//! An ulp is the distance from an f64 to the next; the phase (rad) is the angle by which a motion turns, and ψ the cone
//! angle between the coin's normal n and its angular momentum S.

use exact::TiltTerms;
use exact::certified::{cos_tilt_in_double_double, f64_bound};
use rayon::prelude::*;
use toss::{CoinMotion, CoinToss, SolveError, Stage, certify};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::hard_cases::{adversarial, corners, few_turns, random, tries};
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

pub(super) const COS_TILT: Check = Check {
    id: "last-bit-cos-tilt",
    claim: "cos θ at landing from the exact motion differs from the 256-bit reference by at most the bound, about an \
            ulp of 1, for phases up to 1e9 rad and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-15,
    unit: "1",
    measure: |context| last_bit(context, cos_tilt_error),
};

pub(super) const ATTITUDE: Check = Check {
    id: "last-bit-attitude",
    claim: "The attitude at landing from the exact motion differs from the 256-bit reference by at most the bound, a \
            few ulp, for phases up to 1e9 rad and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-14,
    unit: "rad",
    measure: |context| last_bit(context, attitude_error),
};

pub(super) const EULER_ANGLES: Check = Check {
    id: "last-bit-euler-angles",
    claim: "The attitude that the exact motion's Euler angles at landing give differs from the 256-bit reference by \
            at most the bound, in ulp of 1 plus the largest angle.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 10.0,
    unit: "ulp",
    measure: |context| last_bit(context, euler_angles_error),
};

pub(super) const OUTCOMES: Check = Check {
    id: "certified-outcomes",
    claim: "Certified outcomes are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ, also by being undecided; one is enough to \
            fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "tosses",
    measure: outcomes,
};

pub(super) const BOUNDS: Check = Check {
    id: "certified-bounds",
    claim: "The error of cos θ in the proof stages f64 and double-double is within the error bound by which the stage \
            proves an outcome. Measured: the largest error divided by that error bound; it fails above the bound of \
            this check.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: bounds,
};

/// Error of cos θ.
pub(super) fn cos_tilt_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(CoinMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?))
}

/// Angle to the exact attitude (rad).
pub(super) fn attitude_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&CoinMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
}

/// Angle of the attitude of the Euler angles to the exact one, in ulp of 1 plus the largest angle.
pub(super) fn euler_angles_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    let angles = CoinMotion::new(toss).euler_angles(toss.launch.time_of_flight())?;
    let largest = angles.alpha.abs().max(angles.beta.abs()).max(angles.gamma.abs());
    Ok(reference.attitude_error(&angles.attitude()) / (f64::EPSILON * (1.0 + largest)))
}

/// 1 if the proven outcome is another one than that of `reference`, else 0.
pub(super) fn outcome_differs(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(f64::from(certify(&(*toss).into())?.outcome() != reference.outcome()))
}

fn last_bit(
    context: &Context,
    error: fn(&CoinToss, &Reference) -> Result<f64, SolveError>,
) -> anyhow::Result<Vec<Measurement>> {
    let sets = [
        ("phases to 1e2", random(tries(context.effort), 1e2, 1)?),
        ("phases to 6e4", random(tries(context.effort), 6e4, 2)?),
        ("phases to 1e9", random(tries(context.effort), 1e9, 3)?),
        ("corners", corners()?),
    ];
    Ok(largest_errors(&sets, error))
}

/// The largest error in each set, against the 256-bit reference.
pub(super) fn largest_errors(
    sets: &[(&str, Vec<Case>)],
    error: fn(&CoinToss, &Reference) -> Result<f64, SolveError>,
) -> Vec<Measurement> {
    let measure = |(name, cases): &(&str, Vec<Case>)| {
        let one = |case: &Case| (*case, error(&case.toss, &Reference::new(&case.toss)));
        let solved = cases.par_iter().map(one).filter(|(_, error)| is_in_range(error));
        let (cases, errors): (Vec<Case>, Vec<Deviation>) = solved.unzip();
        Measurement::of_set(name, &errors, |index| cases[index])
    };
    sets.iter().map(measure).collect()
}

/// Whether the toss was solved: phases above 2^53 rad are refused, which the check `atlas-answers` tests (F6).
fn is_in_range(result: &Deviation) -> bool {
    !matches!(result, Err(SolveError::PhaseTooLarge { .. }))
}

fn outcomes(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let sets = [
        ("random", random(3 * tries(context.effort), 6e4, 4)?),
        ("adversarial", adversarial(tries(context.effort), few_turns)?),
    ];
    sets.into_iter()
        .map(|(name, cases)| {
            let judged: Vec<_> = cases
                .par_iter()
                .map(|case| certify(&case.toss.into()).map(|found| (found, Reference::new(&case.toss).outcome())))
                .collect();
            let stages = Stage::ALL.map(|stage| {
                judged.iter().filter(|found| found.as_ref().is_ok_and(|(found, _)| found.stage() == stage)).count()
            });
            let differs = judged.into_iter().map(|judged| judged.map(|(found, right)| found.outcome() != right));
            let mut counted = Measurement::count_of_set(name, &differs.collect::<Vec<_>>(), |index| cases[index]);
            if let Some(worst) = &mut counted.worst {
                worst.input = format!("decided by f64, double-double, more digits: {stages:?}; {}", worst.input);
            }
            Ok(counted)
        })
        .collect()
}

fn bounds(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut cases = Vec::new();
    for (seed, phase) in [(5, 1.0), (6, 1e2), (7, 6e4), (8, 1e9)] {
        cases.extend(random(tries(context.effort) / 4, phase, seed)?);
    }
    cases.extend(adversarial(tries(context.effort) / 4, few_turns)?);
    let largest = |name: &str, ratio: fn(&CoinToss, &Reference) -> Deviation| {
        let ratios: Vec<_> = cases.par_iter().map(|case| ratio(&case.toss, &Reference::new(&case.toss))).collect();
        Measurement::of_set(name, &ratios, |index| cases[index])
    };
    Ok(vec![largest("f64", of_f64), largest("double-double", of_double_double)])
}

/// Error of cos θ in the f64 stage, divided by the stage's error bound.
pub(super) fn of_f64(toss: &CoinToss, reference: &Reference) -> Deviation {
    let terms = TiltTerms::new(toss);
    let [phase, _] = terms.phases(toss.launch.flight_time());
    let error = reference.cos_tilt_error(terms.height(phase) / terms.size);
    Ok(error / f64_bound(phase))
}

/// Error of cos θ in the double-double stage, divided by the radius of its ball; 0 of a toss that has none.
pub(super) fn of_double_double(toss: &CoinToss, reference: &Reference) -> Deviation {
    let Some(ball) = cos_tilt_in_double_double(toss) else { return Ok(0.0) };
    Ok(reference.unrounded_cos_tilt_error(*ball.midpoint()) / ball.radius())
}
