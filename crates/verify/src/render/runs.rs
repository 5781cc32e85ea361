//! Renders the runs of one toss as a table, with one line for each contestant, and what the checks of the library
//! measure on it, with one line for each of their quantities.

use crate::measure::atlas::conditioning::Conditioning;
use crate::measure::measurement::Measurement;
use crate::measure::run::Run;
use crate::{Check, Row};

/// The answer, errors and work of each run, and the effect of one rounding of the launch by itself.
pub fn text(runs: &[Run], conditioning: Option<Conditioning>) -> String {
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
    let rounding = conditioning.map_or_else(String::new, |conditioning| {
        let (attitude, cos_tilt) = (conditioning.rounding(), f64::EPSILON * conditioning.cos_tilt);
        format!("one rounding of the launch moves cos θ by {cos_tilt:.1e}, the attitude by {attitude:.1e} rad\n")
    });
    runs.iter().map(|run| line(run).trim_end().to_owned() + "\n").collect::<String>() + &rounding
}

/// What a check of the library measures on the toss, or why it failed.
pub fn of_library(check: &Check, found: &Measurement) -> String {
    let failure = found.worst.as_ref().and_then(|worst| worst.failure.clone());
    let measured = failure.unwrap_or_else(|| format!("{:.1e} {}", found.measured, check.unit));
    format!("{:<27} {:<31} {measured}\n", check.id, found.subject)
}

/// What a row measures on the toss, what is allowed, and the verdict.
pub fn of_row(row: &Row) -> String {
    let number = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |value| format!("{value:e}"));
    let (measured, bound, unit) = (number(row.measured), number(row.bound), &row.unit);
    let failure = row.failure.as_ref().map(|failure| format!(": {failure}")).unwrap_or_default();
    format!(
        "{} / {}\nmeasured {measured} {unit}, allowed {bound}\n{}{failure}\n",
        row.check,
        row.subject,
        row.status.name()
    )
}
