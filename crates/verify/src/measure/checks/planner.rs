//! These checks measure how accurate the planner's choices are on random scenes (questions with an accuracy), about coins,
//! other bodies and spaces of launches. Only solving scenes shows whether its choices are right.

use std::cmp::Ordering;

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::planner::trial::Outcome;

pub(super) const DELIVERS: Check = Check {
    id: "plan-delivers",
    claim: "The error of every scene that is solved as planned is at most the accuracy asked for. Measured: the \
            largest error divided by that accuracy; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: |context| largest(context, DELIVERS.id, Outcome::error_by_accuracy),
};

pub(super) const EXPECTS: Check = Check {
    id: "plan-expects",
    claim: "The error of every scene that is solved as planned is at most the error that the plan expects. Measured: \
            the largest error on the scene's toss and, where a small error may be luck, on similar ones, divided by \
            the expected error; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: |context| largest(context, EXPECTS.id, Outcome::error_by_expected),
};

/// The largest `part` over the solved scenes of each kind.
fn largest(context: &Context, check: &str, part: fn(&Outcome) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let trial = context.trial()?;
    let row = |kind: &'static str| {
        let outcomes = trial.outcomes.iter().filter(|outcome| outcome.kind == kind && outcome.model.is_some());
        let larger = |a: &&Outcome, b: &&Outcome| part(a).partial_cmp(&part(b)).unwrap_or(Ordering::Greater);
        let number = outcomes.clone().count() as u64;
        let worst = outcomes.max_by(larger);
        let input = worst.map_or_else(String::new, |outcome| outcome.input.clone());
        Measurement::figure(check, kind, worst.map_or(f64::INFINITY, part), number, input)
    };
    Ok(trial.kinds().into_iter().map(row).collect())
}
