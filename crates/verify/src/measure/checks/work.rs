//! The checks of error by work: error estimates over the whole range of tolerances and steps, on every problem; the order of
//! convergence of every scheme, because a mistake in coefficients or equations often leaves the error small, but lowers the
//! order; and the error by the tolerance, of which a tenth must give ten times the accuracy, whatever the scheme.

use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use toss::{Coin, Formulation, InputError, Stepping};

use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::convergence::{Convergence, error};
use crate::measure::reference;
use crate::measure::run::Answer;
use crate::measure::subject::{Subject, usual};
use crate::measure::tosses::random_flights;
use crate::measure::trial::Measurement;
use crate::measure::work_precision::Sample;
use crate::slope::slope;

pub(super) const CHECKS: &[Check] = &[
    Check::of_solvers("work-precision", Own(within_estimate)).up_to(1.0, "1").claims(
        "On every problem, at every tolerance from 1e-3 to 1e-14 or step from 1/|ω| down, the error of the attitude is \
         within the solver's error estimate. Measured: the largest error divided by what the estimate allows; it fails \
         above the limit.",
    ),
    Check::of_solvers("convergence-order", Own(order)).up_to(0.5, "1").claims(
        "With a fixed step h the error falls as h to the power of the scheme's order by theory. Measured: the distance \
         of the fitted power from that order; it fails above the limit.",
    ),
    Check::of_solvers("tolerance-proportion", Own(proportion)).up_to(0.5, "1").claims(
        "The error is proportional to the tolerance from 1e-3 down to 1e-11, whatever the order of the scheme. \
         Measured: the distance from 1 of the slope of log error by log tolerance; it fails above the limit.",
    ),
];

fn within_estimate(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let sweep = context.sweep.get(context)?;
    let row = |subject: &String| {
        let samples: Vec<&Sample> = sweep.samples.iter().filter(|sample| sample.subject() == *subject).collect();
        let part = |sample: &Sample| sample.err_by_allowance.unwrap_or(f64::INFINITY);
        let worst = samples.iter().max_by(|a, b| part(a).total_cmp(&part(b)));
        let input = worst.map_or_else(String::new, |sample| {
            let setting = sample.tol.or(sample.step).unwrap_or(0.0);
            let failure = sample.failure.as_deref().unwrap_or("answered");
            format!("{} # {} at tolerance or step {setting:e}: {failure}", sample.inputs, sample.problem)
        });
        let measured = worst.map_or(f64::INFINITY, |sample| part(sample));
        let is_claimed = samples.iter().all(|sample| sample.status != Answer::Unclaimed);
        let found = Measurement::figure(subject, measured, samples.len() as u64, input);
        found.claiming(is_claimed.then_some(1.0))
    };
    Ok(sweep.judged().iter().map(row).collect())
}

fn order(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |found: &Convergence| {
        let observed = found.observed.unwrap_or(f64::NAN);
        let input = format!("observed order {observed:.3} over {:.1} halvings of the step", found.halvings);
        let distance = (observed - f64::from(found.order)).abs();
        Measurement::figure(&found.subject, distance, found.points.len() as u64, input).without_claim()
    };
    Ok(context.convergence.get(context)?.iter().map(row).collect())
}

/// Number of flights whose errors are added up. The error of one flight depends on where its last step happens to end.
const FLIGHTS: u64 = 100;

/// Errors below this are rounding and are left out (rad, summed over the flights).
const ROUNDING: f64 = 3e-12;

const PER_DECADE: i32 = 4;

fn proportion(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let axes = [(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5"), (Tilt, "0:3")];
    let tosses = random_flights(&Space::parse(Coin::PAPER, &axes)?, 1, FLIGHTS)?;
    let flights: Vec<_> =
        tosses.into_iter().map(|toss| Ok((toss, reference::of(&toss)?))).collect::<anyhow::Result<_>>()?;
    let mut measurements = Vec::new();
    for entry in &context.registry {
        for scheme in entry.schemes().iter().filter(|scheme| scheme.is_adaptive()) {
            let point = |part: i32| -> Result<Option<[f64; 2]>, InputError> {
                let tolerance = 10f64.powf(-3.0 - f64::from(part) / f64::from(PER_DECADE));
                let stepping = Stepping::adaptive(*scheme, tolerance)?;
                let solver = Subject::new(entry, Some(stepping), Formulation::default()).solver;
                // A tolerance at which a flight fails gives no point; without any point the slope is not a number.
                let found = error(solver.as_ref(), &flights).ok().filter(|error| *error > ROUNDING);
                Ok(found.map(|error| [tolerance.ln(), error.ln()]))
            };
            let found: Vec<_> = (0..=8 * PER_DECADE).into_par_iter().map(point).collect::<Result<_, _>>()?;
            let points: Vec<[f64; 2]> = found.into_iter().flatten().collect();
            let slope = slope(&points);
            let subject = Subject::new(entry, Some(usual(*scheme)?), Formulation::default()).name;
            let input =
                if slope.is_nan() { "too few flights for a slope".to_owned() } else { format!("slope {slope:.4}") };
            let (distance, cases) = ((slope - 1.0).abs(), points.len() as u64);
            measurements.push(Measurement::figure(&subject, distance, cases, input).without_claim());
        }
    }
    Ok(measurements)
}
