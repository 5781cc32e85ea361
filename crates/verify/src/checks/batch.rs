//! The batch kernels against 256 bits, and their paths against each other.

use rayon::prelude::*;
use toss::batch::{BatchError, TossError, Tosses};
use toss::lanes::Path;
use toss::{Attitude, Outcome, SolveError, TimeOfFlight, Toss};

use super::certified::{adversarial, corners, largest_errors, random, subject, tries};
use crate::case::Case;
use crate::check::{Basis, Check};
use crate::context::Context;
use crate::measurement::Measurement;
use crate::reference::Reference;

pub(super) const COS_TILT: Check = Check {
    id: "batch-cos-tilt",
    claim: "cos θ of a batch is right to its last bits, whatever the phase",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| errors(context, |toss, reference| Ok(reference.cos_tilt_error(solve(toss, cos_tilt)?))),
};

pub(super) const ATTITUDE: Check = Check {
    id: "batch-attitude",
    claim: "the attitude of a batch is right to its last bits, whatever the phase",
    basis: Basis::ClosedForm,
    unit: "rad",
    measure: |context| errors(context, |toss, reference| Ok(reference.attitude_error(&solve(toss, attitude)?))),
};

pub(super) const OUTCOMES: Check = Check {
    id: "batch-outcomes",
    claim: "outcomes of a batch are those of 256 bits, also within 3 ulp of the edge (measured: that differ)",
    basis: Basis::ClosedForm,
    unit: "tosses",
    measure: |context| {
        let differs = |toss: &Toss| Ok(solve(toss, outcome)? != Reference::new(toss).outcome());
        let sets = [("random", random(tries(context), 6e4, 14)?), ("adversarial", adversarial(tries(context) / 2)?)];
        Ok(count(&sets, differs))
    },
};

pub(super) const PATHS: Check = Check {
    id: "batch-paths",
    claim: "every instruction set gives the same bits (measured: tosses of which one differs)",
    basis: Basis::CrossMethod,
    unit: "tosses",
    measure: |context| {
        let bits = |tosses: &Tosses<'_>| -> Result<_, BatchError> {
            let turned: Attitude = attitude(tosses)?;
            Ok((cos_tilt(tosses)?.to_bits(), turned.components().map(f64::to_bits), outcome(tosses)?))
        };
        let differs = |toss: &Toss| {
            let plain = solve(toss, |tosses| bits(&tosses.on(Path::all()[0])))?;
            let same = |path: Path| solve(toss, |tosses| bits(&tosses.on(path))).map(|found| found == plain);
            Path::all().into_iter().map(same).try_fold(false, |differs, same| Ok(differs | !same?))
        };
        let sets = [("random", random(2 * tries(context), 6e4, 15)?), ("adversarial", adversarial(tries(context))?)];
        Ok(count(&sets, differs))
    },
};

/// What `kernel` makes of a batch of one toss.
fn solve<T>(toss: &Toss, kernel: impl Fn(&Tosses<'_>) -> Result<T, BatchError>) -> Result<T, SolveError> {
    let rate = toss.launch.rate();
    // Under 2 m/s² a speed is a time of flight.
    let (speed, gravity) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity),
        other => (other.seconds(), 2.0),
    };
    let rates: [&[f64]; 3] = [&[rate.x], &[rate.y], &[rate.z]];
    let attitude = toss.launch.attitude();
    let tosses = Tosses::new(toss.coin, attitude, gravity, rates, std::slice::from_ref(&speed)).expect("a valid toss");
    kernel(&tosses).map_err(|error| match error.source {
        TossError::Solve(error) => error,
        TossError::Input(error) => unreachable!("a valid toss: {error}"),
    })
}

fn cos_tilt(tosses: &Tosses<'_>) -> Result<f64, BatchError> {
    let mut out = [f64::NAN];
    tosses.cos_tilts(&mut out)?;
    Ok(out[0])
}

fn attitude(tosses: &Tosses<'_>) -> Result<Attitude, BatchError> {
    let mut out = [[f64::NAN]; 4];
    tosses.attitudes(out.each_mut().map(<[f64; 1]>::as_mut_slice))?;
    Ok(Attitude::from_components(out.map(|column| column[0])).expect("a unit quaternion"))
}

fn outcome(tosses: &Tosses<'_>) -> Result<Outcome, BatchError> {
    let mut out = [Outcome::Undecided];
    tosses.outcomes(&mut out)?;
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

/// How many tosses of each set are what `is` says.
fn count(sets: &[(&str, Vec<Case>)], is: impl Fn(&Toss) -> Result<bool, SolveError> + Sync) -> Vec<Measurement> {
    let measure = |(name, cases): &(&str, Vec<Case>)| {
        let found: Vec<_> = cases.par_iter().map(|case| is(&case.toss).map(|is| f64::from(u8::from(is)))).collect();
        let sum: Result<f64, SolveError> = found.iter().cloned().sum();
        let worst = Measurement::largest(&subject(name), found, |index| cases[index]);
        Measurement { measured: sum.unwrap_or(f64::INFINITY), ..worst }
    };
    sets.iter().map(measure).collect()
}
