//! What a tolerance or a step is worth: errors over the whole range of both.

use crate::check::{Basis, Check};
use crate::context::Context;
use crate::measurement::Measurement;
use crate::work_precision::Sample;

pub(super) const PROMISE: Check = Check {
    id: "work-precision",
    claim: "at every tolerance from 1e-3 to 1e-14, or step from 1/|ω| down, the attitude is within what the solver answers \
            for, on every problem (measured: the largest part)",
    basis: Basis::ClosedForm,
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
        Measurement::figure(PROMISE.id, subject, measured, samples.len() as u64, input)
    };
    Ok(sweep.subjects().iter().map(row).collect())
}
