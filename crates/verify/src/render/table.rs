//! The text for the terminal. While the suite runs, it prints a line for each check that has ended, so that someone who
//! waits sees how far it is; at the end come the pattern, one line a check with the worst first, what fails in full,
//! and the verdict last, where it is read first.

use std::fmt::Write;

use super::Report;
use super::words::{Block, comparison, margin};
use crate::CHECKS;
use crate::judge::time::Timing;
use crate::judge::{Row, Status};

/// The line for a check that has just ended, with its rows and its time.
pub fn ended(rows: &[Row], timing: &Timing) -> String {
    let failing = rows.iter().filter(|row| !row.status.passes()).count();
    let result = if failing == 0 { "ok".to_owned() } else { format!("FAIL: {failing}") };
    format!("{:<width$} {:>7.1} s  {:>4} rows  {result}\n", timing.check, timing.t_wall_s, rows.len(), width = width())
}

/// The report of a run: one line a check or, with `verbose`, one line a row below its claim.
pub fn text(report: &Report<'_>, verbose: bool) -> String {
    let mut out = format!("\n{}\n", report.pattern);
    let blocks = Block::all(report.rows);
    if !verbose {
        let _ = writeln!(out, "\n{:<width$}  rows  the row over its bound or closest to it", "check", width = width());
    }
    for block in &blocks {
        out += &if verbose { every_row(block) } else { summary(block) };
    }
    for row in blocks.iter().flat_map(|block| &block.rows).filter(|row| !row.status.passes()) {
        out += &in_full(row);
    }
    out
}

/// Whether the run passes, and how many rows do.
pub fn verdict(rows: &[Row]) -> String {
    let failing = rows.iter().filter(|row| !row.status.passes()).count();
    let verdict = if failing == 0 { "PASS" } else { "FAIL" };
    format!("\n{verdict}: {} of {} rows pass{}\n", rows.len() - failing, rows.len(), remarks(rows))
}

/// How many rows a check has, and the one that is the furthest above its bound or the closest to it.
fn summary(block: &Block<'_>) -> String {
    let (worst, failing) = (block.worst(), block.failing());
    let status = if failing == 0 { String::new() } else { format!("  FAIL: {failing} of {}", block.rows.len()) };
    // Where nothing deviates, no subject is closer to its bound than another.
    let subject = if worst.part() == 0.0 && failing == 0 { "" } else { worst.subject.as_str() };
    let closest = format!("{:<18}  {subject}", margin(worst));
    format!("{:<width$}  {:>4}  {}{status}\n", worst.check, block.rows.len(), closest.trim_end(), width = width())
}

/// Every row of a check, below its claim.
fn every_row(block: &Block<'_>) -> String {
    let width = block.rows.iter().map(|row| row.subject.chars().count()).max().unwrap_or(0);
    let first = block.worst();
    let basis = first.basis.map_or("", crate::measure::check::Basis::name);
    let mut out = format!("\n{}  [{basis}]\n  {}\n", first.check, first.claim);
    for row in &block.rows {
        let _ = writeln!(out, "    {}", line(row, width));
    }
    out
}

/// The width of the longest name of a check.
fn width() -> usize {
    CHECKS.iter().map(|check| check.id.len()).max().unwrap_or(0)
}

/// A failing row with its claim, its worst input and the command that repeats it.
fn in_full(row: &Row) -> String {
    let mut out = format!("\n{}: {} / {}\n", row.status.name(), row.check, row.subject);
    let _ = writeln!(out, "  claim: {}", row.claim);
    let _ = writeln!(out, "  {}", line(row, row.subject.chars().count()));
    let judges = row.judges.map(|judges| judges.name().to_owned());
    for (what, text) in [
        ("why", &row.failure),
        ("judges the", &judges),
        ("worst input", &row.worst_input),
        ("repeat with", &row.replay),
    ] {
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
    let (comparison, margin, cases, status) = (comparison(row), margin(row), row.cases, row.status.name());
    format!("{:<width$}  {comparison:<28}  {margin:<18}  {cases:>7} cases  {status}", row.subject)
}
