//! Planner accuracy and cost.

use std::cmp::Ordering;

use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::planner::summary::Line;
use crate::measure::planner::trial::Outcome;

pub(super) const DELIVERS: Check = Check {
    id: "plan-delivers",
    claim: "a scene solved as planned is as accurate as was asked (measured: the largest error, divided by the accuracy)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| largest(context, DELIVERS.id, Outcome::error_by_accuracy),
};

pub(super) const EXPECTS: Check = Check {
    id: "plan-expects",
    claim: "no error is larger than the plan expects (measured: the largest error, divided by the expected one, on similar \
            tosses too)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| largest(context, EXPECTS.id, Outcome::error_by_expected),
};

pub(super) const TIGHT: Check = Check {
    id: "plan-tight",
    claim: "the plan expects at most 30 times the error that there is (measured: share of scenes where it expects more)",
    basis: Basis::ClosedForm,
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
    claim: "by recorded cost the chosen model costs at most 1.2 times the cheapest that serves, of all that were tried (measured: \
            fraction of scenes where it costs more; the ratios by measured cost are in the report)",
    basis: Basis::CrossMethod,
    unit: "1",
    measure: |context| share(context, COST_RATIO.id, &[("all", |line| line.economical)]),
};

/// A share of the scenes, from 0 to 1.
type Share = fn(&Line) -> f64;

/// The largest `part` of each kind of scenes.
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

/// What is missing to 1 in shares of all scenes.
fn share(context: &Context, check: &str, shares: &[(&str, Share)]) -> anyhow::Result<Vec<Measurement>> {
    let lines = context.trial()?.lines();
    let all = lines.last().expect("there is a line for all scenes");
    let row = |(subject, share): &(&str, Share)| {
        let cases = if check == COST_RATIO.id { all.tried } else { all.scenes };
        Measurement::figure(check, subject, 1.0 - share(all), cases as u64, "all scenes".to_owned())
    };
    Ok(shares.iter().map(row).collect())
}
