//! These checks compare what is proven by integration with the 256-bit reference: the bounds of cos θ and of the attitude,
//! which no error may exceed, and the outcomes. The launches include those where rounding is hardest: the corners of the
//! model, units that have to be rounded, and tosses that land within a few ulp of a change of the outcome.

use dynamics::phase::RoughPhases;
use rayon::prelude::*;
use toss::{CoinToss, ExactSolver, IntegratedCertificate, Outcome, SolveError, Solver, Stepping};

use super::enclosed::{distance, require_short, share, share_by_exact_motion, share_by_reference};
use super::{integrated_bodies, judged};
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::hard_cases::{adversarial, corners, few_turns, random, tries};
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;
use crate::measure::subject::taylor;

pub(super) const BOUNDS: Check = Check {
    id: "integrated-bounds",
    claim: "No error of cos θ or of the attitude exceeds the bound that its integration proves for it, at any tolerance. \
            Measured: the largest error divided by its bound; it fails above 1.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: bounds,
};

pub(super) const OUTCOMES: Check = Check {
    id: "integrated-outcomes",
    claim: "Outcomes proven by integration are those of the 256-bit reference, also within 3 ulp of the speed at which \
            the outcome changes; those of bodies with I1 ≠ I2 may be undecided there. Measured: the number of tosses that \
            differ, those of coins also by being undecided; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "tosses",
    measure: outcomes,
};

pub(super) const TIGHTNESS: Check = Check {
    id: "integrated-tightness",
    claim: "The bound that an integration at the default tolerance proves for the attitude is not far above its error. \
            Measured: the median of the bound divided by the error.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 300.0,
    unit: "1",
    measure: tightness,
};

/// The longest phase (rad) of launches at the corners: a flight of 1e4 rad takes some thousand steps.
const LONGEST: f64 = 1e4;

/// The sets of launches whose bounds are measured, each with the tolerance of its flights.
pub(super) const SETS: [(&str, f64); 6] = [
    ("phases to 1e2", Stepping::DEFAULT_TOLERANCE),
    ("phases to 1e2, tolerance 1e-4", 1e-4),
    ("phases to 1e2, finest tolerance", f64::EPSILON),
    ("phases to 6e4", 1e-12),
    ("corners", Stepping::DEFAULT_TOLERANCE),
    ("adversarial", f64::EPSILON),
];

/// [`share`] at the tolerance of the set with this number.
pub(super) fn share_of_set<const SET: usize>(toss: &CoinToss, _: &Reference) -> Deviation {
    require_short(toss)?;
    share(&taylor(SETS[SET].1)?, toss)
}

/// 1 if the outcome that is proven at the default tolerance is not that of `reference`, else 0.
pub(super) fn outcome_differs(toss: &CoinToss, reference: &Reference) -> Deviation {
    require_short(toss)?;
    Ok(f64::from(taylor(Stepping::DEFAULT_TOLERANCE)?.certify(&(*toss).into())?.outcome() != reference.outcome()))
}

type Found = Result<IntegratedCertificate, SolveError>;

fn bounds(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let number = tries(context.effort);
    let is_short = |case: &Case| RoughPhases::new(&case.toss).largest().is_ok_and(|phase| phase <= LONGEST);
    let cases = [
        random(number, 1e2, 31)?,
        random(number, 1e2, 32)?,
        random(number, 1e2, 33)?,
        random(number / 100, 6e4, 34)?,
        corners()?.into_iter().filter(is_short).collect(),
        adversarial(number / 4, few_turns)?,
    ];
    let measure = |((name, tolerance), cases): ((&'static str, f64), Vec<Case>)| {
        let solver = taylor(tolerance)?;
        let found: Vec<_> = cases.par_iter().map(|case| (case.toss, solver.enclose(&case.toss.into()))).collect();
        let quick = |_, (toss, found): &(CoinToss, Found)| share_by_exact_motion(found.as_ref().ok()?, toss);
        let thorough =
            |_, (toss, found): &(CoinToss, Found)| share_by_reference(found.as_ref().map_err(Clone::clone)?, toss);
        let shares = judged::shares(&found, quick, thorough);
        Ok(Measurement::of_set(name, &shares, |index| cases[index]))
    };
    let coins: anyhow::Result<Vec<Measurement>> = SETS.into_iter().zip(cases).map(measure).collect();
    let bodies = integrated_bodies::bounds(BOUNDS.id, number / 20)?;
    Ok([coins?, bodies].concat())
}

fn outcomes(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let solver = taylor(Stepping::DEFAULT_TOLERANCE)?;
    let sets = [
        ("random", random(tries(context.effort), 1e2, 35)?),
        ("adversarial", adversarial(tries(context.effort) / 4, few_turns)?),
    ];
    let measure = |(name, cases): (&str, Vec<Case>)| {
        let differs = |case: &Case| -> Result<bool, SolveError> {
            Ok(solver.certify(&case.toss.into())?.outcome() != outcome(&case.toss))
        };
        let differs: Vec<_> = cases.par_iter().map(differs).collect();
        Measurement::count_of_set(name, &differs, |index| cases[index])
    };
    let coins: Vec<Measurement> = sets.into_iter().map(measure).collect();
    let bodies = integrated_bodies::outcomes(OUTCOMES.id, tries(context.effort) / 20)?;
    Ok([coins, bodies].concat())
}

/// The outcome by the exact motion where cos θ is far from 0, else by the reference.
fn outcome(toss: &CoinToss) -> Outcome {
    match ExactSolver.tilt(&(*toss).into()) {
        Ok(tilt) if tilt.cos_tilt.abs() > 1e3 * judged::EXACT => tilt.outcome(),
        _ => Reference::new(toss).outcome(),
    }
}

fn tightness(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let (solver, number) = (taylor(Stepping::DEFAULT_TOLERANCE)?, tries(context.effort) / 10);
    let sets = [("phases to 1e2", 1e2, number), ("phases to 1e3", 1e3, number), ("phases to 1e5", 1e5, number / 10)];
    let measure = |(name, phase, number): (&str, f64, u64)| {
        let cases = random(number, phase, 36)?;
        let ratio = |case: &Case| -> Deviation {
            let found = solver.enclose(&case.toss.into())?;
            Ok(found.attitude_error_bound() / distance(&found, &Reference::new(&case.toss)))
        };
        let ratios: Result<Vec<f64>, _> = cases.par_iter().map(ratio).collect();
        let mut ratios = ratios?;
        ratios.sort_by(f64::total_cmp);
        let largest = ratios[ratios.len() * 95 / 100];
        let median = ratios[ratios.len() / 2];
        Ok(Measurement::figure(TIGHTNESS.id, name, median, number, format!("95 % are below {largest:.0}")))
    };
    sets.into_iter().map(measure).collect()
}
