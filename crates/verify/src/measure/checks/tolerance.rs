//! This check measures how the error of each adaptive scheme depends on its tolerance. It must be proportional to it,
//! so that a tolerance ten times smaller gives ten times the accuracy, whatever the scheme.

use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use toss::{Coin, Formulation, InputError, Stepping};

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::convergence::error;
use crate::measure::measurement::Measurement;
use crate::measure::random_flights::random_flights;
use crate::measure::reference::Reference;
use crate::measure::subject::{Subject, usual};
use crate::slope::slope;

pub(super) const PROPORTION: Check = Check {
    id: "tolerance-proportion",
    claim: "The error is proportional to the tolerance from 1e-3 down to 1e-11, whatever the order of the scheme. \
            Measured: the distance from 1 of the slope of log error by log tolerance; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.5,
    unit: "1",
    measure,
};

/// Number of flights whose errors are added up. The error of one flight depends on where its last step happens to end.
const FLIGHTS: u64 = 100;

/// Errors below this are rounding and are left out (rad, summed over the flights).
const ROUNDING: f64 = 3e-12;

/// Number of tolerances in each decade.
const PER_DECADE: i32 = 4;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let axes = [(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5"), (Tilt, "0:3")];
    let tosses = random_flights(&Space::parse(Coin::PAPER, &axes)?, 1, FLIGHTS)?;
    let flights: Vec<_> = tosses.into_iter().map(|toss| (toss, Reference::new(&toss))).collect();
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
            let input = format!("slope {slope:.4}");
            let (distance, cases) = ((slope - 1.0).abs(), points.len() as u64);
            measurements.push(Measurement::figure(PROPORTION.id, &subject, distance, cases, input).without_claim());
        }
    }
    Ok(measurements)
}
