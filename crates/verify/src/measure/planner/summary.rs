//! This file sums up a trial of the planner for the report: accuracy and cost in one line per kind of scene, and the
//! measured cost of each model. The checks read their fractions from these lines.

use serde::Serialize;
use toss::Model;

use super::trial::{Outcome, Trial};

/// A choice is economical if it costs at most this many times as much as the cheapest model that serves.
const ECONOMICAL: f64 = 1.2;

/// Accuracy and cost of the planner's choices. Fields that come from measured times begin with `t_`, because they
/// differ from run to run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannerSummary {
    /// One line per kind of scene, and one for all.
    pub lines: Vec<Line>,
    /// Costs by model, in the order of the hierarchy.
    pub t_costs_ns: Vec<Cost>,
}

/// The measured cost of a model over the scenes where it was tried (ns); for a trace, the cost of each point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cost {
    /// The model's name.
    pub model: &'static str,
    /// 5 % of the scenes cost less.
    pub low: f64,
    /// The median.
    pub median: f64,
    /// 5 % of the scenes cost more.
    pub high: f64,
}

/// Accuracy and cost over the scenes of one kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// The kind, or `all`.
    pub kind: String,
    /// Number of scenes.
    pub scenes: usize,
    /// Number of scenes that were refused because no setting is accurate enough.
    pub refused: usize,
    /// Largest error divided by the accuracy that was asked for.
    pub largest_error_by_accuracy: f64,
    /// Largest error divided by the expected one.
    pub largest_error_by_expected: f64,
    /// Fraction of scenes whose expected error is at most 30 times the largest error on the scene's toss and similar
    /// ones.
    pub within_30: f64,
    /// Fraction of scenes whose expected error is at most 30 times the error on the scene's toss alone.
    pub within_30_of_one: f64,
    /// Number of scenes that were solved by every model.
    pub tried: usize,
    /// Fraction of them whose choice costs at most 1.2 times the cheapest model that serves, by recorded cost.
    pub economical: f64,
    /// As above, by measured instead of recorded cost.
    #[serde(rename = "t_economical")]
    pub economical_by_clock: f64,
    /// The largest cost ratio, by measured cost.
    #[serde(rename = "t_largest_cost_ratio")]
    pub largest_cost_ratio_by_clock: f64,
}

impl Trial {
    /// The kinds of scenes, in the order in which they first appear.
    pub fn kinds(&self) -> Vec<&'static str> {
        let mut kinds: Vec<&str> = Vec::new();
        for outcome in &self.outcomes {
            if !kinds.contains(&outcome.kind) {
                kinds.push(outcome.kind);
            }
        }
        kinds
    }

    /// One line per kind of scene, and one for all.
    pub fn lines(&self) -> Vec<Line> {
        let of = |kind: &str| self.line(kind, |outcome| outcome.kind == kind);
        self.kinds().into_iter().map(of).chain([self.line("all", |_| true)]).collect()
    }

    /// Accuracy by kind of scene and cost by model, for the report.
    pub fn summary(&self) -> PlannerSummary {
        let cost =
            |(model, [low, median, high]): (&'static Model, [f64; 3])| Cost { model: model.name, low, median, high };
        PlannerSummary { lines: self.lines(), t_costs_ns: self.quantiles().into_iter().map(cost).collect() }
    }

    fn line(&self, kind: &str, belongs: impl Fn(&Outcome) -> bool) -> Line {
        let outcomes: Vec<&Outcome> = self.outcomes.iter().filter(|outcome| belongs(outcome)).collect();
        let largest = |of: fn(&Outcome) -> f64| outcomes.iter().map(|outcome| of(outcome)).fold(0.0, f64::max);
        let ratios: Vec<f64> = outcomes.iter().filter_map(|outcome| outcome.cost_ratio).collect();
        let by_clock: Vec<f64> = outcomes.iter().filter_map(|outcome| outcome.cost_ratio_by_clock).collect();
        let economical = |ratios: &[f64]| fraction(ratios.iter().map(|ratio| *ratio <= ECONOMICAL));
        Line {
            kind: kind.to_owned(),
            scenes: outcomes.len(),
            refused: outcomes.iter().filter(|outcome| outcome.model.is_none()).count(),
            largest_error_by_accuracy: largest(Outcome::error_by_accuracy),
            largest_error_by_expected: largest(Outcome::error_by_expected),
            within_30: fraction(outcomes.iter().map(|outcome| outcome.is_within_30(outcome.error_of_family))),
            within_30_of_one: fraction(outcomes.iter().map(|outcome| outcome.is_within_30(outcome.error))),
            tried: ratios.len(),
            economical: economical(&ratios),
            economical_by_clock: economical(&by_clock),
            largest_cost_ratio_by_clock: by_clock.into_iter().fold(0.0, f64::max),
        }
    }

    /// Median cost of each model that was tried (ns), with its 5 % and 95 % quantiles.
    pub fn quantiles(&self) -> Vec<(&'static Model, [f64; 3])> {
        let quantile = |costs: &[f64], part: f64| {
            let mut sorted = costs.to_vec();
            sorted.sort_unstable_by(f64::total_cmp);
            #[expect(
                clippy::cast_precision_loss,
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "an index"
            )]
            let index = (part * (sorted.len() - 1) as f64).round() as usize;
            sorted[index]
        };
        self.costs.iter().map(|(model, costs)| (*model, [0.05, 0.5, 0.95].map(|part| quantile(costs, part)))).collect()
    }
}

/// Fraction of true items; 1 if there are none.
#[expect(clippy::cast_precision_loss, reason = "thousands")]
fn fraction(items: impl Iterator<Item = bool> + Clone) -> f64 {
    let all = items.clone().count();
    if all == 0 { 1.0 } else { items.filter(|holds| *holds).count() as f64 / all as f64 }
}
