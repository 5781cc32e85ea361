//! Runs of one toss as a table, a line a contestant.

use crate::run::Run;

/// Answer, errors and work of each run.
pub fn text(runs: &[Run]) -> String {
    let width = runs.iter().map(|run| run.subject.chars().count()).max().unwrap_or(0);
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1e}"));
    let line = |run: &Run| {
        let calls = run.rhs_calls.map_or_else(|| "-".to_owned(), |calls| calls.to_string());
        format!(
            "{:<width$}  {:<14}  cos θ off by {:>7}, attitude by {:>7} rad  {calls:>8} calls  {}",
            run.subject,
            run.answer.name(),
            number(run.err_cos_tilt),
            number(run.err_attitude),
            run.failure.as_deref().unwrap_or_default()
        )
    };
    runs.iter().map(|run| line(run).trim_end().to_owned() + "\n").collect()
}
