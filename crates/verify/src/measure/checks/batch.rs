//! These checks compare the batch kernels with the 256-bit reference, and their SIMD levels with each other. The
//! kernels are written separately from the solver of one toss, so checks of that solver say nothing about them.

use rayon::prelude::*;
use toss::{Attitude, Batch, Error, Outcome, SimdLevel, SolveError, TimeOfFlight, Toss, Tosses};

use super::certified::{adversarial, corners, largest_errors, random, tries};
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::Reference;

pub(super) const COS_TILT: Check = Check {
    id: "batch-cos-tilt",
    claim: "cos θ at landing from a batch differs from the 256-bit reference by at most the bound, for phases up to \
            1e9 rad, near changes of the outcome and at the corners of the model.",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| errors(context, |toss, reference| Ok(reference.cos_tilt_error(solve(toss, cos_tilt)?))),
};

pub(super) const ATTITUDE: Check = Check {
    id: "batch-attitude",
    claim: "The attitude at landing from a batch differs from the 256-bit reference by at most the bound, for phases \
            up to 1e9 rad, near changes of the outcome and at the corners of the model.",
    basis: Basis::ClosedForm,
    unit: "rad",
    measure: |context| errors(context, |toss, reference| Ok(reference.attitude_error(&solve(toss, attitude)?))),
};

pub(super) const OUTCOMES: Check = Check {
    id: "batch-outcomes",
    claim: "The outcomes of a batch are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ; one is enough to fail.",
    basis: Basis::ClosedForm,
    unit: "tosses",
    measure: |context| {
        let differs = |toss: &Toss| Ok(solve(toss, outcome)? != Reference::new(toss).outcome());
        let sets = [("random", random(tries(context), 6e4, 14)?), ("adversarial", adversarial(tries(context) / 2)?)];
        Ok(count(&sets, differs))
    },
};

pub(super) const SIMD_LEVELS: Check = Check {
    id: "batch-paths",
    claim: "Every SIMD level of the machine gives the same bits of cos θ, attitude and outcome as plain code. \
            Measured: the number of tosses with a difference; one is enough to fail.",
    basis: Basis::CrossMethod,
    unit: "tosses",
    measure: |context| {
        let bits = |batch: &Batch<'_>| -> Result<_, Error> {
            let turned: Attitude = attitude(batch)?;
            Ok((cos_tilt(batch)?.to_bits(), turned.components().map(f64::to_bits), outcome(batch)?))
        };
        let differs = |toss: &Toss| {
            let plain = solve(toss, |batch| bits(&batch.on(SimdLevel::all()[0])))?;
            let same = |level: SimdLevel| solve(toss, |batch| bits(&batch.on(level))).map(|found| found == plain);
            SimdLevel::all().into_iter().map(same).try_fold(false, |differs, same| Ok(differs | !same?))
        };
        let sets = [("random", random(2 * tries(context), 6e4, 15)?), ("adversarial", adversarial(tries(context))?)];
        Ok(count(&sets, differs))
    },
};

/// The result of `kernel` for a batch that holds only `toss`.
fn solve<T>(toss: &Toss, kernel: impl Fn(&Batch<'_>) -> Result<T, Error>) -> Result<T, SolveError> {
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
    error: fn(&Toss, &Reference) -> Result<f64, SolveError>,
) -> anyhow::Result<Vec<Measurement>> {
    let sets = [
        ("phases to 1e2", random(tries(context), 1e2, 11)?),
        ("phases to 1e9", random(tries(context), 1e9, 13)?),
        ("adversarial", adversarial(tries(context) / 2)?),
        ("corners", corners()?),
    ];
    Ok(largest_errors(&sets, error))
}

/// The number of tosses of each set for which `is` returns true.
fn count(sets: &[(&str, Vec<Case>)], is: impl Fn(&Toss) -> Result<bool, SolveError> + Sync) -> Vec<Measurement> {
    let measure = |(name, cases): &(&str, Vec<Case>)| {
        let found: Vec<_> = cases.par_iter().map(|case| is(&case.toss)).collect();
        Measurement::count_of_set(name, &found, |index| cases[index])
    };
    sets.iter().map(measure).collect()
}
