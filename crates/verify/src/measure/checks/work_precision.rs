//! This check compares errors with the solvers' error estimates over the whole range of tolerances and steps, on every
//! problem. Most other checks use one setting, but an error estimate must hold at any setting that you choose.

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::run::Answer;
use crate::measure::work_precision::Sample;

pub(super) const WITHIN_ESTIMATE: Check = Check {
    id: "work-precision",
    claim: "On every problem, at every tolerance from 1e-3 to 1e-14 or step from 1/|ω| down, the error of the \
            attitude is within the solver's error estimate. Measured: the largest error divided by what the estimate \
            allows; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 1.0,
    unit: "1",
    measure,
};

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let sweep = context.sweep()?;
    let row = |subject: &String| {
        let samples: Vec<&Sample> = sweep.samples.iter().filter(|sample| sample.subject() == *subject).collect();
        let part = |sample: &Sample| sample.err_by_allowance.unwrap_or(f64::INFINITY);
        let worst = samples.iter().max_by(|a, b| part(a).total_cmp(&part(b)));
        let input = worst.map_or_else(String::new, |sample| {
            let setting = sample.tol.or(sample.step).unwrap_or(0.0);
            let failure = sample.failure.as_deref().unwrap_or("answered");
            format!("{} at tolerance or step {setting:e}: {failure}; {}", sample.problem, sample.inputs)
        });
        let measured = worst.map_or(f64::INFINITY, |sample| part(sample));
        let is_claimed = samples.iter().all(|sample| sample.status != Answer::Unclaimed);
        let found = Measurement::figure(WITHIN_ESTIMATE.id, subject, measured, samples.len() as u64, input);
        found.claiming(is_claimed.then_some(1.0))
    };
    Ok(sweep.subjects().iter().map(row).collect())
}
