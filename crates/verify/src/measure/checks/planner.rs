//! These checks measure how accurate and how costly the planner's choices are on random scenes (questions with an
//! accuracy). The planner chooses by a table of measured errors and costs, so only solving scenes shows whether its
//! choices are right.

use std::cmp::Ordering;

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::planner::summary::Line;
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

pub(super) const TIGHT: Check = Check {
    id: "plan-tight",
    claim: "The error that a plan expects is at most 30 times the actual error. Measured: the fraction of scenes \
            where it is more; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.2,
    unit: "1",
    measure: |context| {
        share(
            context,
            TIGHT.id,
            &[("of the toss", |line| line.within_30_of_one), ("of its kind", |line| line.within_30)],
        )
    },
};

pub(super) const COST_RATIO: Check = Check {
    id: "plan-regret",
    claim: "By recorded cost the chosen model costs at most 1.2 times as much as the cheapest model that was accurate \
            enough when tried. Measured: the fraction of scenes where it costs more; it fails above the bound. (The \
            report has the ratios by measured cost.)",
    basis: Basis::CrossMethod,
    judges: Judges::Library,
    ceiling: 0.1,
    unit: "1",
    measure: |context| share(context, COST_RATIO.id, &[("all", |line| line.economical)]),
};

/// Reads from a line of the summary a fraction of its scenes, from 0 to 1.
type Share = fn(&Line) -> f64;

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

/// 1 less each of the `shares` of all scenes, so a smaller number is better.
fn share(context: &Context, check: &str, shares: &[(&str, Share)]) -> anyhow::Result<Vec<Measurement>> {
    let lines = context.trial()?.lines();
    let all = lines.last().expect("there is a line for all scenes");
    let row = |(subject, share): &(&str, Share)| {
        let cases = if check == COST_RATIO.id { all.tried } else { all.scenes };
        Measurement::figure(check, subject, 1.0 - share(all), cases as u64, "all scenes".to_owned())
    };
    Ok(shares.iter().map(row).collect())
}
