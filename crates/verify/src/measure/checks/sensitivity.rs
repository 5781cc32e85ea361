//! This check compares the derivatives of the landing by the launch with central differences of the exact motion. The
//! differences are taken in 256 bits with steps so small that only the rounding of the derivatives is left.

use nalgebra::{Matrix3x4, Matrix4, Vector4};
use rayon::prelude::*;
use toss::{CoinToss, Launch, Sensitivity, SolveError, TimeOfFlight};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

pub(super) const DERIVATIVES: Check = Check {
    id: "sensitivity",
    claim: "The derivatives of attitude and cos θ at landing by relative changes of ω and of the time of flight \
            differ from central differences in 256 bits by at most the bound, relative to the norm of the attitude's \
            derivative.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-10,
    unit: "1",
    measure,
};

/// Number of launches that are taken from the survey.
const LAUNCHES: usize = 500;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let cases: Vec<Case> = context.survey()?.cases.iter().take(LAUNCHES).copied().collect();
    let errors: Vec<Result<[f64; 2], SolveError>> = cases.par_iter().map(|case| errors(&case.toss)).collect();
    let row = |(part, name): (usize, &str)| {
        let deviation =
            |errors: &Result<[f64; 2], SolveError>| errors.as_ref().map(|of| of[part]).map_err(Clone::clone);
        let deviations: Vec<Deviation> = errors.iter().map(deviation).collect();
        Measurement::of_set(name, &deviations, |index| cases[index])
    };
    Ok(["attitude", "cos θ"].into_iter().enumerate().map(row).collect())
}

/// The relative errors of the derivatives of the attitude and of cos θ.
pub(super) fn errors(toss: &CoinToss) -> Result<[f64; 2], SolveError> {
    let found = Sensitivity::new(&(*toss).into())?;
    let (attitude, cos_tilt) = differences(toss);
    let (rate, time) = (toss.launch.rate().norm(), toss.launch.flight_time());
    let relative = Matrix4::from_diagonal(&Vector4::new(rate, rate, rate, time));
    let size = (found.attitude * relative).norm();
    let attitude = ((found.attitude - attitude) * relative).norm();
    Ok([attitude / size, (relative * (found.cos_tilt - cos_tilt)).norm() / size])
}

/// Central differences of attitude and cos θ by ω and time, in 256 bits over relative steps of 2^-37. Their truncation
/// error is below 1e-18.
fn differences(toss: &CoinToss) -> (Matrix3x4<f64>, Vector4<f64>) {
    let (mut attitude, mut cos_tilt) = (Matrix3x4::zeros(), Vector4::zeros());
    let (rate, time) = (toss.launch.rate(), toss.launch.flight_time());
    let inputs = Vector4::new(rate.x, rate.y, rate.z, time);
    let landing = |inputs: &Vector4<f64>| {
        let launch = Launch::new(inputs.xyz(), TimeOfFlight::Given(inputs.w)).expect("next to a valid launch");
        Reference::new(&CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
    };
    for input in 0..4 {
        let size = if input == 3 { time } else { rate.norm() };
        let step = Vector4::ith(input, size * 2f64.powi(-37));
        let (before, after) = (inputs - step, inputs + step);
        let change = after[input] - before[input];
        let (from, to) = (landing(&before), landing(&after));
        attitude.set_column(input, &(from.turn_to(&to) / change));
        cos_tilt[input] = from.cos_tilt_to(&to) / change;
    }
    (attitude, cos_tilt)
}
