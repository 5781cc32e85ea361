//! These checks compare the batch kernels with the 256-bit reference, and their SIMD levels with each other. The
//! kernels are written separately from the solver of one toss, so checks of that solver say nothing about them.

use rayon::prelude::*;
use toss::{Attitude, Batch, CoinToss, Error, Launch, Outcome, SimdLevel, SolveError, TimeOfFlight, Tosses};

use super::certified::largest_errors;
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::hard_cases::{adversarial, corners, few_turns, random, tries};
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

pub(super) const COS_TILT: Check = Check {
    id: "batch-cos-tilt",
    claim: "cos θ at landing from a batch differs from the 256-bit reference by at most the bound, for phases up to \
            1e9 rad, near changes of the outcome and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-14,
    unit: "1",
    measure: |context| errors(context, cos_tilt_error),
};

pub(super) const ATTITUDE: Check = Check {
    id: "batch-attitude",
    claim: "The attitude at landing from a batch differs from the 256-bit reference by at most the bound, for phases \
            up to 1e9 rad, near changes of the outcome and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-14,
    unit: "rad",
    measure: |context| errors(context, attitude_error),
};

pub(super) const OUTCOMES: Check = Check {
    id: "batch-outcomes",
    claim: "The outcomes of a batch are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "tosses",
    measure: |context| {
        let sets = [
            ("random", at_one_height(random(tries(context.effort), 6e4, 14)?)?),
            ("adversarial", at_one_height(adversarial(tries(context.effort) / 2, few_turns)?)?),
            ("adversarial, many turns", at_one_height(adversarial(tries(context.effort) / 4, many_turns)?)?),
        ];
        Ok(count(&sets, |toss| outcome_differs(toss, &Reference::new(toss))))
    },
};

pub(super) const SIMD_LEVELS: Check = Check {
    id: "batch-paths",
    claim: "Every SIMD level of the machine gives the same bits of cos θ, attitude and outcome as plain code. \
            Measured: the number of tosses with a difference; one is enough to fail.",
    basis: Basis::CrossMethod,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "tosses",
    measure: |context| {
        let adversarial = at_one_height(adversarial(tries(context.effort), few_turns)?)?;
        let sets =
            [("random", at_one_height(random(2 * tries(context.effort), 6e4, 15)?)?), ("adversarial", adversarial)];
        Ok(count(&sets, levels_that_differ))
    },
};

/// The cases as a batch can take them: it knows no landing at another height, only how long such a flight lasts.
pub(super) fn at_one_height(cases: Vec<Case>) -> anyhow::Result<Vec<Case>> {
    let level = |case: Case| {
        let flight = case.toss.launch.time_of_flight();
        let TimeOfFlight::BallisticTo { .. } = flight else { return Ok(case) };
        let launch =
            Launch::new(case.toss.launch.rate(), TimeOfFlight::Given(flight.seconds()))?.with_tilt(case.tilt)?;
        Ok(Case { toss: CoinToss { launch, ..case.toss }, ..case })
    };
    cases.into_iter().map(level).collect()
}

/// From a thousand to 10^9 turns, where the rounding of the phase is far above that of cos θ.
fn many_turns(index: usize) -> f64 {
    10f64.powi(3 + i32::try_from(index % 7).unwrap_or(0))
}

/// Error of cos θ.
pub(super) fn cos_tilt_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(cos_tilt_of_one(toss)?))
}

/// cos θ.
pub(super) fn cos_tilt_of_one(toss: &CoinToss) -> Deviation {
    solve(toss, cos_tilt)
}

/// Angle to the exact attitude (rad).
pub(super) fn attitude_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&solve(toss, attitude)?))
}

/// 1 if the outcome is another one than that of `reference`, else 0.
pub(super) fn outcome_differs(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(f64::from(solve(toss, outcome)? != reference.outcome()))
}

/// The number of SIMD levels that give other bits than plain code.
pub(super) fn levels_that_differ(toss: &CoinToss) -> Deviation {
    let bits = |batch: &Batch<'_>| -> Result<_, Error> {
        let turned: Attitude = attitude(batch)?;
        Ok((cos_tilt(batch)?.to_bits(), turned.components().map(f64::to_bits), outcome(batch)?))
    };
    let plain = solve(toss, |batch| bits(&batch.on(SimdLevel::all()[0])))?;
    let differs = |level: SimdLevel| solve(toss, |batch| bits(&batch.on(level))).map(|found| f64::from(found != plain));
    SimdLevel::all().into_iter().map(differs).sum()
}

/// The result of `kernel` for a batch that holds only `toss`.
fn solve<T>(toss: &CoinToss, kernel: impl Fn(&Batch<'_>) -> Result<T, Error>) -> Result<T, SolveError> {
    let rate = toss.launch.rate();
    // A batch takes speeds, not times: with a gravity of 2 m/s² the time 2 v0/g has the number of the speed.
    let (speed, gravity) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity),
        other => (other.seconds(), 2.0),
    };
    let rates: [&[f64]; 3] = [&[rate.x], &[rate.y], &[rate.z]];
    let attitude = toss.launch.attitude();
    let tosses = Tosses::new(toss.coin, attitude, gravity, rates, std::slice::from_ref(&speed)).expect("a valid toss");
    kernel(&Batch::new(tosses)).map_err(|error| match error {
        Error::Launch { source, .. } => source,
        other => unreachable!("a valid toss: {other}"),
    })
}

fn cos_tilt(batch: &Batch<'_>) -> Result<f64, Error> {
    let mut out = [f64::NAN];
    batch.cos_tilts(&mut out)?;
    Ok(out[0])
}

fn attitude(batch: &Batch<'_>) -> Result<Attitude, Error> {
    let mut out = [[f64::NAN]; 4];
    batch.attitudes(out.each_mut().map(<[f64; 1]>::as_mut_slice))?;
    Ok(Attitude::from_components(out.map(|column| column[0])).expect("a unit quaternion"))
}

fn outcome(batch: &Batch<'_>) -> Result<Outcome, Error> {
    let mut out = [Outcome::Undecided];
    batch.outcomes(&mut out)?;
    Ok(out[0])
}

fn errors(
    context: &Context,
    error: fn(&CoinToss, &Reference) -> Result<f64, SolveError>,
) -> anyhow::Result<Vec<Measurement>> {
    let sets = [
        ("phases to 1e2", at_one_height(random(tries(context.effort), 1e2, 11)?)?),
        ("phases to 1e9", at_one_height(random(tries(context.effort), 1e9, 13)?)?),
        ("adversarial", at_one_height(adversarial(tries(context.effort) / 2, few_turns)?)?),
        ("corners", corners()?),
    ];
    Ok(largest_errors(&sets, error))
}

/// The number of tosses of each set with a deviation.
fn count(sets: &[(&str, Vec<Case>)], deviation: impl Fn(&CoinToss) -> Deviation + Sync) -> Vec<Measurement> {
    let measure = |(name, cases): &(&str, Vec<Case>)| {
        let found: Vec<_> = cases.par_iter().map(|case| deviation(&case.toss).map(|size| size != 0.0)).collect();
        Measurement::count_of_set(name, &found, |index| cases[index])
    };
    sets.iter().map(measure).collect()
}
