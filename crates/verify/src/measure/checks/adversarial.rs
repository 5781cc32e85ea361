//! A search for answers that are wrong without an error, by launches that an adversary would pick.

use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::measurement::{Claim, Measurement, Worst};
use crate::measure::search::Findings;

pub(super) const SILENTLY_WRONG: Check = Check {
    id: "adversarial-silence",
    claim: "no adversarial launch is answered wrongly without an error, at five tolerances or two steps (measured: how many are)",
    basis: Basis::ClosedForm,
    unit: "launches",
    measure: |context| {
        rows(context, |findings| {
            let measurement = Measurement {
                subject: findings.subject.clone(),
                measured: findings.silently_wrong as f64,
                cases: findings.launches,
                worst: findings.first_wrong.clone(),
                claim: Claim::Silent,
            };
            measurement.claiming((findings.unclaimed == 0).then_some(0.0))
        })
    },
};

pub(super) const REFUSED: Check = Check {
    id: "adversarial-refusals",
    claim: "few adversarial launches are refused with an error (measured: the share)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| {
        rows(context, |findings| Measurement {
            subject: findings.subject.clone(),
            measured: findings.refused as f64 / findings.launches as f64,
            cases: findings.launches,
            // The refusal is an answer of the subject, not a failure of the row.
            worst: findings.first_refused.clone().map(|worst| Worst { failure: None, ..worst }),
            claim: Claim::Silent,
        })
    },
};

fn rows(context: &Context, row: fn(&Findings) -> Measurement) -> anyhow::Result<Vec<Measurement>> {
    Ok(context.search()?.iter().map(row).collect())
}
