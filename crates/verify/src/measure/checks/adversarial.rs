//! These checks count the wrong answers and the refusals of each solver on launches that are chosen to break solvers. A
//! wrong answer that comes without an error is the worst that a solver can do, and random launches rarely provoke one.

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::{Claim, Measurement, Worst};
use crate::measure::search::Findings;

pub(super) const SILENTLY_WRONG: Check = Check {
    id: "adversarial-silence",
    claim: "On launches chosen to break solvers, each at one of five tolerances or of two steps, no answer is wrong \
            without an error. Measured: the number of wrong answers without an error; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.0,
    unit: "launches",
    measure: |context| {
        rows(context, |findings| {
            let measurement = Measurement {
                subject: findings.subject.clone(),
                measured: findings.silently_wrong as f64,
                cases: findings.launches,
                worst: findings.first_wrong.clone(),
                claim: Claim::Silent,
                judges: None,
            };
            measurement.claiming((findings.unclaimed == 0).then_some(0.0))
        })
    },
};

pub(super) const REFUSED: Check = Check {
    id: "adversarial-refusals",
    claim: "Of the launches chosen to break solvers, the fraction that a solver refuses with an error is at most the \
            bound, or a quarter without one.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.25,
    unit: "1",
    measure: |context| {
        rows(context, |findings| {
            let measurement = Measurement {
                subject: findings.subject.clone(),
                measured: findings.refused as f64 / findings.launches as f64,
                cases: findings.launches,
                // A refusal is what this row counts, so it is not reported as a failure of the measurement.
                worst: findings.first_refused.clone().map(|worst| Worst { failure: None, ..worst }),
                claim: Claim::Silent,
                judges: None,
            };
            measurement.claiming(Some(REFUSED.ceiling))
        })
    },
};

fn rows(context: &Context, row: fn(&Findings) -> Measurement) -> anyhow::Result<Vec<Measurement>> {
    Ok(context.search()?.iter().map(row).collect())
}
