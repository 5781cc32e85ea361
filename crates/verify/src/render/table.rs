//! The table for the terminal.

use std::fmt::Write;

use crate::judge::{Row, Status};

/// One block per check: its claim and basis, then one line per subject; failures and the verdict last.
pub fn text(rows: &[Row]) -> String {
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
    let failures: Vec<&Row> = rows.iter().filter(|row| !row.status.passes()).collect();
    for row in &failures {
        let _ = writeln!(out, "\n{}: {} / {}", row.status.name(), row.check, row.subject);
        for (what, text) in [("why", &row.failure), ("worst input", &row.worst_input), ("repeat with", &row.replay)] {
            if let Some(text) = text {
                let _ = writeln!(out, "  {what}: {text}");
            }
        }
    }
    let verdict = if failures.is_empty() { "PASS" } else { "FAIL" };
    let _ = writeln!(out, "\n{verdict}: {} of {} rows pass{}", rows.len() - failures.len(), rows.len(), remarks(rows));
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
    let margin = row.margin.map_or_else(|| "-".to_owned(), |margin| format!("{margin:.1}×"));
    let unit = if row.unit == "1" { "" } else { row.unit.as_str() };
    format!(
        "{:<width$}  {measured:>8} ≤ {:>8} {unit:<8}  margin {margin:>6}  {:>7} cases  {}",
        row.subject,
        number(row.bound),
        row.cases,
        row.status.name()
    )
}
