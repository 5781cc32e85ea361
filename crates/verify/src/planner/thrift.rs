//! How well the planner kept its word: the regret table, and what each rung took.

use serde::Serialize;
use toss::Model;

use super::trial::{Outcome, Trial};

/// How well the planner kept its word, and what each rung took.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Thrift {
    /// The regret table.
    pub lines: Vec<Line>,
    /// Costs by rung, in the order of the ladder.
    pub t_costs_ns: Vec<Cost>,
}

/// What a rung took over the scenes where it was tried (ns); a trace, each point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cost {
    /// The model.
    pub model: &'static str,
    /// 5 % took less.
    pub low: f64,
    /// Half of them took less.
    pub median: f64,
    /// 5 % took more.
    pub high: f64,
}

/// A line of the regret table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// The kind of scenes.
    pub kind: String,
    /// Their number.
    pub scenes: usize,
    /// How many were refused, because no setting is accurate enough.
    pub refused: usize,
    /// The largest error in parts of the accuracy that was asked.
    pub largest_error_by_accuracy: f64,
    /// The largest error in parts of what was expected.
    pub largest_error_by_expected: f64,
    /// Share of scenes whose expected error is at most 30 times the largest of their families.
    pub within_30: f64,
    /// The same against the error of the one toss.
    pub within_30_of_one: f64,
    /// Scenes that were solved by every rung.
    pub tried: usize,
    /// Share of them whose choice costs at most 1.2 times the cheapest rung that serves, by the record.
    pub thrifty: f64,
    /// The same by the clock.
    #[serde(rename = "t_thrifty")]
    pub thrifty_by_clock: f64,
    /// The largest such factor by the clock.
    #[serde(rename = "t_largest_regret")]
    pub largest_regret_by_clock: f64,
}

impl Trial {
    /// The kinds of scenes, in the order of their first.
    pub fn kinds(&self) -> Vec<&'static str> {
        let mut kinds: Vec<&str> = Vec::new();
        for outcome in &self.outcomes {
            if !kinds.contains(&outcome.kind) {
                kinds.push(outcome.kind);
            }
        }
        kinds
    }

    /// One line a kind of scene and one for all.
    pub fn lines(&self) -> Vec<Line> {
        let of = |kind: &str| self.line(kind, |outcome| outcome.kind == kind);
        self.kinds().into_iter().map(of).chain([self.line("all", |_| true)]).collect()
    }

    /// For the reports.
    pub fn thrift(&self) -> Thrift {
        let cost = |(model, [low, median, high]): (Model, [f64; 3])| Cost { model: model.name(), low, median, high };
        Thrift { lines: self.lines(), t_costs_ns: self.quantiles().into_iter().map(cost).collect() }
    }

    fn line(&self, kind: &str, belongs: impl Fn(&Outcome) -> bool) -> Line {
        let outcomes: Vec<&Outcome> = self.outcomes.iter().filter(|outcome| belongs(outcome)).collect();
        let largest = |of: fn(&Outcome) -> f64| outcomes.iter().map(|outcome| of(outcome)).fold(0.0, f64::max);
        let regrets: Vec<f64> = outcomes.iter().filter_map(|outcome| outcome.regret).collect();
        let by_clock: Vec<f64> = outcomes.iter().filter_map(|outcome| outcome.regret_by_clock).collect();
        let thrifty = |regrets: &[f64]| share(regrets.iter().map(|regret| *regret <= 1.2));
        Line {
            kind: kind.to_owned(),
            scenes: outcomes.len(),
            refused: outcomes.iter().filter(|outcome| outcome.model.is_none()).count(),
            largest_error_by_accuracy: largest(Outcome::error_by_accuracy),
            largest_error_by_expected: largest(Outcome::error_by_expected),
            within_30: share(outcomes.iter().map(|outcome| outcome.is_within_30(outcome.error_of_family))),
            within_30_of_one: share(outcomes.iter().map(|outcome| outcome.is_within_30(outcome.error))),
            tried: regrets.len(),
            thrifty: thrifty(&regrets),
            thrifty_by_clock: thrifty(&by_clock),
            largest_regret_by_clock: by_clock.into_iter().fold(0.0, f64::max),
        }
    }

    /// Median cost of each rung that was tried (ns), with its 5 % and 95 % quantiles.
    pub fn quantiles(&self) -> Vec<(Model, [f64; 3])> {
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

/// The share of what holds; 1 of nothing.
#[expect(clippy::cast_precision_loss, reason = "thousands")]
fn share(holds: impl Iterator<Item = bool> + Clone) -> f64 {
    let all = holds.clone().count();
    if all == 0 { 1.0 } else { holds.filter(|holds| *holds).count() as f64 / all as f64 }
}
