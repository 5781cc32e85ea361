//! Renders the rows as the table that a run prints on the terminal.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::judge::{Row, Status};

/// One line for each check, or with `verbose` one for each row. Failing rows follow in full, and then the verdict.
pub fn text(rows: &[Row], verbose: bool) -> String {
    let mut out = if verbose { every_row(rows) } else { every_check(rows) };
    let failures: Vec<&Row> = rows.iter().filter(|row| !row.status.passes()).collect();
    if !failures.is_empty() {
        let _ = writeln!(out, "\n{}", pattern(&failures));
    }
    for row in &failures {
        out += &in_full(row);
    }
    let verdict = if failures.is_empty() { "PASS" } else { "FAIL" };
    let _ = writeln!(out, "\n{verdict}: {} of {} rows pass{}", rows.len() - failures.len(), rows.len(), remarks(rows));
    out
}

/// One line for each check: how many rows it has, and which of them is closest to its bound.
fn every_check(rows: &[Row]) -> String {
    let width = rows.iter().map(|row| row.check.chars().count()).max().unwrap_or(0);
    let mut out = format!("\n{:<width$}  rows  closest margin\n", "check");
    for block in rows.chunk_by(|a, b| a.check == b.check) {
        let failing = block.iter().filter(|row| !row.status.passes()).count();
        let status = if failing == 0 { String::new() } else { format!("  FAIL: {failing} of {}", block.len()) };
        let margin = |row: &Row| row.margin.unwrap_or(if row.status.passes() { f64::INFINITY } else { 0.0 });
        let closest = block.iter().min_by(|a, b| margin(a).total_cmp(&margin(b)));
        let closest = closest.map_or_else(String::new, |row| match row.margin {
            // No row deviates, so no subject is closer to its bound than another.
            None if row.status.passes() => shown_margin(row),
            _ => format!("{}  {}", shown_margin(row), row.subject),
        });
        let _ = writeln!(out, "{:<width$}  {:>4}  {closest}{status}", block[0].check, block.len());
    }
    out
}

/// One block for each check: its claim and basis, then one line for each subject.
fn every_row(rows: &[Row]) -> String {
    let mut out = String::new();
    let width = rows.iter().map(|row| row.subject.chars().count()).max().unwrap_or(0);
    for block in rows.chunk_by(|a, b| a.check == b.check) {
        let first = &block[0];
        let basis = first.basis.map_or("", crate::measure::check::Basis::name);
        let _ = writeln!(out, "\n{}  [{basis}]\n  {}", first.check, first.claim);
        for row in block {
            let _ = writeln!(out, "    {}", line(row, width));
        }
    }
    out
}

/// What the failing rows have in common, in a sentence or two.
fn pattern(failures: &[&Row]) -> String {
    let distinct = |of: fn(&Row) -> &str| failures.iter().map(|row| of(row)).collect::<BTreeSet<&str>>();
    let (checks, solvers) = (distinct(|row| &row.check), distinct(solver));
    let rows = if failures.len() == 1 { "One row fails".to_owned() } else { format!("{} rows fail", failures.len()) };
    let listed = |names: &BTreeSet<&str>| names.iter().copied().collect::<Vec<_>>().join(", ");
    match (checks.len(), solvers.len()) {
        (1, 1) => format!("{rows}: {} under the check {}.", listed(&solvers), listed(&checks)),
        (1, _) => format!(
            "{rows}, all under the check {}. The fault may be in what its subjects share, or in the check.",
            listed(&checks)
        ),
        (number, 1) => format!("{rows}, all of {}, under {number} checks. The others pass.", listed(&solvers)),
        (number, _) => format!("{rows}, of {}, under {number} checks.", listed(&solvers)),
    }
}

/// The solver of a row's subject, which is `gamma` for `gamma/dop853`.
fn solver(row: &Row) -> &str {
    row.subject.split('/').next().unwrap_or(&row.subject)
}

/// A failing row with its claim, its worst input and the command that repeats it.
fn in_full(row: &Row) -> String {
    let mut out = format!("\n{}: {} / {}\n", row.status.name(), row.check, row.subject);
    let _ = writeln!(out, "  claim: {}", row.claim);
    let _ = writeln!(out, "  {}", line(row, row.subject.chars().count()));
    for (what, text) in [("why", &row.failure), ("worst input", &row.worst_input), ("repeat with", &row.replay)] {
        if let Some(text) = text {
            let _ = writeln!(out, "  {what}: {text}");
        }
    }
    out
}

/// How many rows pass although no bound is near to the measured value.
fn remarks(rows: &[Row]) -> String {
    let remark = |(status, words): (Status, &str)| {
        let number = rows.iter().filter(|row| row.status == status).count();
        if number > 0 { format!(", {number} {words}") } else { String::new() }
    };
    [
        (Status::PassLoose, "with a bound ten times above what was measured or more"),
        (Status::PassByClaim, "without a bound, by their own claim"),
        (Status::NotJudged, "without a bound, not judged"),
    ]
    .map(remark)
    .concat()
}

fn line(row: &Row, width: usize) -> String {
    let number = |value: Option<f64>| match value {
        Some(value) if value == 0.0 || (value.fract() == 0.0 && value < 1e6) => format!("{value}"),
        Some(value) => format!("{value:.1e}"),
        None => "-".to_owned(),
    };
    let measured = if row.failure.is_some() { "failed".to_owned() } else { number(row.measured) };
    let margin = shown_margin(row);
    let unit = if row.unit == "1" { "" } else { row.unit.as_str() };
    format!(
        "{:<width$}  {measured:>8} ≤ {:>8} {unit:<8}  margin {margin}  {:>7} cases  {}",
        row.subject,
        number(row.bound),
        row.cases,
        row.status.name()
    )
}

/// How many times the measured value the bound is, as text.
fn shown_margin(row: &Row) -> String {
    format!("{:>7}", row.margin.map_or_else(|| "-".to_owned(), |margin| format!("{margin:.1}×")))
}
