//! The table for the terminal. It is printed check by check while the suite runs, so that someone who waits sees how far
//! it is; what fails is then shown in full, with the verdict.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::CHECKS;
use crate::judge::{Row, Status};

/// The names of the columns that [`check`] fills when it is not verbose.
pub fn heading() -> String {
    format!("{:<width$}  rows  closest margin\n", "check", width = check_width())
}

/// The result of one check in one line, or with `verbose` in one line a row below its claim; empty if there are no rows.
pub fn check(rows: &[Row], verbose: bool) -> String {
    let Some(first) = rows.first() else { return String::new() };
    if !verbose {
        return summary(first, rows);
    }
    let width = rows.iter().map(|row| row.subject.chars().count()).max().unwrap_or(0);
    let basis = first.basis.map_or("", crate::measure::check::Basis::name);
    let mut out = format!("\n{}  [{basis}]\n  {}\n", first.check, first.claim);
    for row in rows {
        let _ = writeln!(out, "    {}", line(row, width));
    }
    out
}

/// What fails, in full and below a sentence on what the failures have in common, and the verdict.
pub fn verdict(rows: &[Row]) -> String {
    let mut out = String::new();
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

/// How many rows a check has, and the subject that is closest to its bound.
fn summary(first: &Row, rows: &[Row]) -> String {
    let failing = rows.iter().filter(|row| !row.status.passes()).count();
    let status = if failing == 0 { String::new() } else { format!("  FAIL: {failing} of {}", rows.len()) };
    let margin = |row: &Row| row.margin.unwrap_or(if row.status.passes() { f64::INFINITY } else { 0.0 });
    let closest = rows.iter().min_by(|a, b| margin(a).total_cmp(&margin(b))).unwrap_or(first);
    let subject = match closest.margin {
        // Nothing deviates, so that no subject is closer to its bound than another.
        None if closest.status.passes() => "",
        _ => closest.subject.as_str(),
    };
    let closest = format!("{}  {subject}", shown_margin(closest));
    format!("{:<width$}  {:>4}  {}{status}\n", first.check, rows.len(), closest.trim_end(), width = check_width())
}

/// The width of the longest name of a check.
fn check_width() -> usize {
    CHECKS.iter().map(|check| check.id.len()).max().unwrap_or(0)
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

/// The solver of a row's subject, `gamma` of `gamma/dop853`.
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

/// How many of the rows that pass do so for another reason than a bound that is near to what was measured.
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

/// How many times the bound is above what was measured.
fn shown_margin(row: &Row) -> String {
    format!("{:>7}", row.margin.map_or_else(|| "-".to_owned(), |margin| format!("{margin:.1}×")))
}
