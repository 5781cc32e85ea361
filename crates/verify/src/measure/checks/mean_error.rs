//! These checks show whether a rounding error that is carried along was lost. The largest error of cos θ grows by no more
//! than a fifth then, because the rounding of the result hides it; the mean over many tosses is steadier, and the error
//! before that rounding grows ten-thousandfold.

use exact::compensated_cos_tilt;
use rayon::prelude::*;
use toss::{CoinMotion, CoinToss, Launch, SolveError, TimeOfFlight};

use super::batch;
use super::certified::largest_errors;
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::hard_cases::{corners, random, tries};
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

pub(super) const COS_TILT: Check = Check {
    id: "mean-cos-tilt-error",
    claim: "The mean of |error| of cos θ at landing by the exact motion, by compensated phases and by a batch, against \
            the 256-bit reference, is at most the bound, for phases up to 100 rad.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-15,
    unit: "1",
    measure,
};

pub(super) const TERMS: Check = Check {
    id: "cos-tilt-terms",
    claim: "The terms of cos θ of the exact motion have more digits than f64: at launch, where they add up to cos θ \
            without a sine or cosine of f64, their sum differs from the 256-bit reference by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-18,
    unit: "1",
    measure: |context| {
        Ok(largest_errors(
            &[("phases to 1e2", random(tries(context.effort) / 4, 1e2, 9)?), ("corners", corners()?)],
            terms_error,
        ))
    },
};

/// Error of cos θ at launch before it is rounded to f64. There the terms of cos θ add up to it without a sine or cosine
/// of f64, whose rounding hides theirs.
pub(super) fn terms_error(toss: &CoinToss, _: &Reference) -> Deviation {
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(0.0)).expect("the rate of a valid launch");
    let toss = CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss };
    let (cos_tilt, _) = CoinMotion::new(&toss).cos_tilt_parts(0.0)?;
    Ok(Reference::new(&toss).unrounded_cos_tilt_error(cos_tilt))
}

/// cos θ of a toss.
type CosTilt = fn(&CoinToss) -> Result<f64, SolveError>;

const METHODS: [(&str, CosTilt); 3] = [
    ("exact", |toss| CoinMotion::new(toss).cos_tilt(toss.launch.time_of_flight())),
    ("compensated", compensated_cos_tilt),
    ("batch", batch::cos_tilt_of_one),
];

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let (tilted, flat): (Vec<Case>, Vec<Case>) =
        batch::at_one_height(random(tries(context.effort).min(100_000), 1e2, 16)?)?
            .into_iter()
            .partition(|case| case.tilt != 0.0);
    let mut rows = Vec::new();
    for (launches, cases) in [("horizontal", flat), ("tilted", tilted)] {
        let references: Vec<Reference> = cases.par_iter().map(|case| Reference::new(&case.toss)).collect();
        for (method, cos_tilt) in METHODS {
            let error = |(case, reference): (&Case, &Reference)| {
                cos_tilt(&case.toss).map_or(f64::INFINITY, |found| reference.cos_tilt_error(found))
            };
            let errors: Vec<f64> = cases.par_iter().zip(&references).map(error).collect();
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            let largest = errors.iter().copied().fold(0.0, f64::max);
            let input = format!("largest error {largest:.3e}");
            let subject = format!("{method}, {launches}");
            rows.push(Measurement::figure(COS_TILT.id, &subject, mean, errors.len() as u64, input));
        }
    }
    Ok(rows)
}
