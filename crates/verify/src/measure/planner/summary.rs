//! This file sums up a trial of the planner for the report, in one line per kind of scene.

use serde::Serialize;

use super::trial::{Outcome, Trial};

/// Accuracy of the planner's choices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannerSummary {
    /// One line per kind of scene, and one for all.
    pub lines: Vec<Line>,
}

/// Accuracy over the scenes of one kind.
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
    pub fn summary(&self) -> PlannerSummary {
        let of = |kind: &str| self.line(kind, |outcome| outcome.kind == kind);
        PlannerSummary { lines: self.kinds().into_iter().map(of).chain([self.line("all", |_| true)]).collect() }
    }

    fn line(&self, kind: &str, belongs: impl Fn(&Outcome) -> bool) -> Line {
        let outcomes: Vec<&Outcome> = self.outcomes.iter().filter(|outcome| belongs(outcome)).collect();
        let largest = |of: fn(&Outcome) -> f64| outcomes.iter().map(|outcome| of(outcome)).fold(0.0, f64::max);
        Line {
            kind: kind.to_owned(),
            scenes: outcomes.len(),
            refused: outcomes.iter().filter(|outcome| outcome.model.is_none()).count(),
            largest_error_by_accuracy: largest(Outcome::error_by_accuracy),
            largest_error_by_expected: largest(Outcome::error_by_expected),
        }
    }
}
