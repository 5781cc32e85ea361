//! Texts for the terminal: the report of a run, the runs of one toss, the accuracy of the records over time.
//!
//! While the suite runs, it prints a line for each check that has ended, so that someone who
//! waits sees how far it is; at the end come the pattern, one line a check with the worst first, what fails in full,
//! and the verdict last, where it is read first.

use std::fmt::Write;

use super::words::{by_check, comparison, failing, reserve, unjudged, verdict};
use super::{Report, diagnosis, standing, words};
use crate::judge::record::Record;
use crate::judge::time::Timing;
use crate::judge::{Row, Status};
use crate::measure::run::Run;
use crate::measure::trial::Measurement;
use crate::{CHECKS, Check};

/// The line for a check that has just ended, with its rows and its time.
pub(crate) fn ended(rows: &[Row], timing: &Timing) -> String {
    let failing = failing(rows);
    let result = if failing == 0 { "ok".to_owned() } else { format!("FAIL: {failing}") };
    format!("{:<width$} {:>7.1} s  {:>4} rows  {result}\n", timing.check, timing.t_wall_s, rows.len(), width = width())
}

/// The report of a run: what fails and what moved, the verdict, and what it does not speak of.
pub(crate) fn whole(found: &Report, verbose: bool) -> String {
    let (moved, left_out) = (words::moves(&found.moves, &found.rows), words::left_out(&found.left_out));
    let (standing, compared) = (standing::sentences(found), found.baseline.words(&found.moves));
    format!("{}{moved}{}{left_out}{standing}{compared}\n", report(found, verbose), passing(&found.rows))
}

/// The rows: one line a check or, with `verbose`, one line a row below its claim.
fn report(report: &Report, verbose: bool) -> String {
    let mut out = format!("\n{}{}\n", diagnosis::paragraph(report), report.pattern);
    let checks = by_check(&report.rows);
    if !verbose {
        let _ = writeln!(out, "\n{:<width$}  rows  worst row", "check", width = width());
    }
    for rows in &checks {
        out += &if verbose { every_row(rows) } else { summary(rows) };
    }
    let failing = checks.into_iter().flatten().filter(|row| !row.status.passes());
    let (shown, same) = diagnosis::folded(report, failing.collect());
    out += &shown.into_iter().map(in_full).collect::<String>();
    out + &same
}

/// Whether the run passes, and how many rows do.
fn passing(rows: &[Row]) -> String {
    let failing = failing(rows);
    let verdict = if failing == 0 { "PASS" } else { "FAIL" };
    format!("\n{verdict}: {} of {} rows pass{}\n", rows.len() - failing, rows.len(), remarks(rows))
}

/// How many rows a check has, and the one that is the furthest above its limit or the closest to it.
fn summary(rows: &[&Row]) -> String {
    let (worst, failing) = (rows[0], failing(rows.iter().copied()));
    let status = if failing == 0 { String::new() } else { format!("  FAIL: {failing} of {}", rows.len()) };
    // Where nothing deviates, no subject is closer to its limit than another.
    let subject = if worst.part() == 0.0 && failing == 0 { "" } else { worst.subject.as_str() };
    let closest = format!("{:<18}  {subject}", reserve(worst));
    format!("{:<width$}  {:>4}  {}{status}\n", worst.check, rows.len(), closest.trim_end(), width = width())
}

/// Every row of a check, below its claim.
fn every_row(rows: &[&Row]) -> String {
    let width = rows.iter().map(|row| row.subject.chars().count()).max().unwrap_or(0);
    let first = rows[0];
    let basis = first.basis.map_or("", crate::measure::check::Basis::name);
    let mut out = format!("\n{}  [{basis}]\n  {}\n", first.check, first.claim);
    for row in rows {
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
    let mut out = format!("\n{}: {} / {}\n", verdict(row), row.check, row.subject);
    let _ = writeln!(out, "  claim: {}", row.claim);
    let _ = writeln!(out, "  {}", line(row, row.subject.chars().count()));
    let judges = row.judges.map(|judges| judges.name().to_owned());
    for (what, text) in [
        ("why", &row.failure),
        (
            "launches without an answer",
            &(row.without_answer > 0).then(|| format!("{} of {}", row.without_answer, row.cases)),
        ),
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

/// How many of the rows that pass do so for another reason than a limit that is near to what was measured.
fn remarks(rows: &[Row]) -> String {
    let remark = |(status, words): (Status, &str)| {
        let number = rows.iter().filter(|row| row.status == status).count();
        if number > 0 { format!(", {number} {words}") } else { String::new() }
    };
    [
        (Status::PassLoose, "with a limit ten times above what was measured or more"),
        (Status::PassByClaim, "without a limit of their own, by their claim"),
        (Status::NotJudged, "without a limit, not judged"),
    ]
    .map(remark)
    .concat()
}

fn line(row: &Row, width: usize) -> String {
    let (comparison, reserve, cases, verdict) = (comparison(row), reserve(row), row.cases, verdict(row));
    let unjudged = unjudged(row);
    format!("{:<width$}  {comparison:<28}  {reserve:<18}  {cases:>7} cases{unjudged}  {verdict}", row.subject)
}

/// The answer, errors and work of each run.
pub(crate) fn runs(all: &[Run]) -> String {
    let width = all.iter().map(|run| run.subject.chars().count()).max().unwrap_or(0);
    let line = |run: &Run| {
        // A program tells none.
        let calls = run.rhs_calls.filter(|calls| *calls > 0).map_or_else(|| "-".to_owned(), |calls| calls.to_string());
        let (answer, failure) = (run.answer.name(), run.failure.as_deref().unwrap_or_default());
        format!("{:<width$}  {answer:<14}  {}  {calls:>8} calls  {failure}", run.subject, run.words())
    };
    all.iter().map(|run| line(run).trim_end().to_owned() + "\n").collect()
}

/// What a check of the library measures on the toss, or why it failed.
pub(crate) fn of_library(check: &Check, found: &Measurement) -> String {
    let failure = found.worst.as_ref().and_then(|worst| worst.failure.clone());
    let measured = failure.unwrap_or_else(|| format!("{:.1e} {}", found.measured, check.unit));
    format!("{:<27} {:<31} {measured}\n", check.id, found.subject)
}

/// What a row measures on the toss, what is allowed, and the verdict.
pub(crate) fn of_row(row: &Row) -> String {
    let number = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |value| format!("{value:e}"));
    let (measured, limit, unit) = (number(row.measured), number(row.limit), &row.unit);
    let failure = row.failure.as_ref().map(|failure| format!(": {failure}")).unwrap_or_default();
    let (check, subject, verdict) = (&row.check, &row.subject, verdict(row));
    format!("{check} / {subject}\nmeasured {measured} {unit}, limit {limit}\n{verdict}{failure}\n")
}

/// The check whose errors are followed: random launches, against the exact motion.
pub(crate) const FOLLOWED: &str = "random-attitude";

/// One block for each record: its date, commit and host, then the errors of every subject.
pub(crate) fn history(records: &[Record]) -> String {
    let block = |record: &Record| {
        let host = &record.host;
        let commit: String = host.commit.chars().take(12).collect();
        let heading = format!("\n{}  {commit}  {}, {} cores\n", host.date, host.cpu, host.cores);
        let line = |subject: &str| {
            let error = record.accuracy.error(FOLLOWED, subject).unwrap_or(f64::NAN);
            format!("  {FOLLOWED} / {subject:<18} {error:.2e} rad\n")
        };
        heading + &record.accuracy.subjects(FOLLOWED).map(line).collect::<String>()
    };
    records.iter().map(block).collect()
}
