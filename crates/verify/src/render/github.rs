//! Renders the report for GitHub Actions: annotations, which are lines on standard output that GitHub shows beside the
//! run, and a summary in Markdown for the page of the run.
//!
//! The syntax and its escapes are those of GitHub's documentation, "Workflow commands for GitHub Actions".

use std::fmt::Write;

use super::report::{Cost, ENOUGH, Reached, Verdict};
use super::words::{Group, comparison, reserve, verdict};
use super::{Report, diagnosis, words};
use crate::judge::Row;
use crate::judge::baseline::Move;

/// GitHub shows so many annotations of a kind for each step and drops the rest, so the last one says how many are left.
const SHOWN: usize = 10;

/// The summary shows so many failing rows and as many that became worse: GitHub refuses a summary of more than 1 MiB.
const IN_FULL: usize = 100;

/// One `::error` for each failing row and one `::warning` for each that became worse, the worst first, each with the
/// command that repeats it.
pub(crate) fn annotations(report: &Report) -> String {
    let failing = report.failing();
    let errors = failing.iter().map(|row| {
        let replay = row.replay.as_ref().map_or_else(String::new, |replay| format!("\nRepeat with: {replay}"));
        let why = row.failure.as_ref().map_or_else(String::new, |why| format!("\n{why}"));
        let text = format!("{}: {} ({}){why}{replay}", verdict(row), comparison(row), reserve(row));
        (format!("{} / {}", row.check, row.subject), text)
    });
    let warnings = report.worse().into_iter().map(|moved| {
        let replay = words::replay(moved, &report.rows);
        let text = format!("Worse than the baseline: {}\nRepeat with: {replay}", words::change(moved));
        (format!("{} / {}", moved.check, moved.subject), text)
    });
    listed("error", errors.collect()) + &listed("warning", warnings.collect())
}

fn listed(kind: &str, all: Vec<(String, String)>) -> String {
    let number = all.len();
    let shown = if number > SHOWN { SHOWN - 1 } else { number };
    let mut out = String::new();
    for (title, text) in all.into_iter().take(shown) {
        let _ = writeln!(out, "::{kind} title={}::{}", property(&title), data(&text));
    }
    if number > shown {
        let rest = format!("{} more; the summary and the artifact have all of them", number - shown);
        let _ = writeln!(out, "::{kind} title=and {} more::{}", number - shown, data(&rest));
    }
    out
}

/// The message of a workflow command, in which line breaks and percent signs are escaped.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A property of a workflow command, in which colons and commas are escaped, too.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// The summary: the verdict, the pattern, what fails and what became worse with the commands that repeat it, what each
/// solver reaches at which cost, one line a family, and folded one line a check.
pub(crate) fn summary(report: &Report) -> String {
    let failing = report.failing();
    let verdict = match report.verdict() {
        Verdict::Pass => "✅ PASS",
        Verdict::Worse => "⚠️ WORSE than the baseline",
        Verdict::Fail => "❌ FAIL",
    };
    let mut out = format!("## {verdict}: {} of {} rows pass\n\n", report.rows.len() - failing.len(), report.rows.len());
    for words in report.diagnoses.iter().map(diagnosis::sentence).chain([report.pattern.clone()]) {
        let _ = writeln!(out, "{}\n", cell(&words));
    }
    let facts: Vec<String> =
        report.facts().into_iter().map(|(name, value)| format!("{name} {}", cell(&value))).collect();
    let _ = writeln!(out, "{}. {}\n", facts.join(" · "), report.baseline.words(&report.moves));
    let blocks = Group::checks(&report.rows);
    out += &in_full("Fails", failing.iter().map(|row| (failed(row), row.replay.clone().unwrap_or_default())));
    let moved =
        |moved: &Move| format!("**{} / {}**: {}", cell(&moved.check), cell(&moved.subject), words::change(moved));
    let moved = |found: &&Move| (moved(found), words::replay(found, &report.rows));
    out += &in_full("Worse than the baseline", report.worse().iter().map(moved));
    out += &reached(report);
    out += &families(report);
    out += "\n<details><summary>All checks, the worst first</summary>\n\n";
    out += "| | check | rows | worst row | measured and limit | |\n|---|---|---|---|---|---|\n";
    for block in &blocks {
        let (worst, sign) = (block.worst(), if block.failing() == 0 { "✅" } else { "❌" });
        let (check, subject, rows) = (cell(&worst.check), cell(&worst.subject), block.rows.len());
        let _ = writeln!(out, "| {sign} | {check} | {rows} | {subject} | {} | {} |", comparison(worst), reserve(worst));
    }
    out + "\n</details>\n"
}

/// What each solver reaches, and at which cost; empty if that was not measured.
fn reached(report: &Report) -> String {
    let (all, Some((problem, launches))) = (report.reached(), report.ordinary()) else { return String::new() };
    let mut out = format!(
        "### What each solver reaches\n\n| solver | smallest error | calls | time | calls to {ENOUGH:e} rad | time |\n\
         |---|---|---|---|---|---|\n"
    );
    for Reached { subject, finest, enough } in all {
        let [error, calls, time] = finest.words();
        let [_, fewer, less] = enough.map_or_else(|| ["–", "–", "–"].map(str::to_owned), Cost::words);
        let _ = writeln!(out, "| {} | {error} | {calls} | {time} | {fewer} | {less} |", cell(&subject));
    }
    let _ = writeln!(out, "\nThe attitude, per launch, over the {launches} launches of the problem {problem}.\n");
    out
}

fn families(report: &Report) -> String {
    let mut out = "### Families of checks\n\n| | family | rows | worst row | |\n|---|---|---|---|---|\n".to_owned();
    for family in Group::families(&report.rows) {
        let (worst, sign) = (family.worst(), if family.failing() == 0 { "✅" } else { "❌" });
        let row = format!("{} / {}", cell(&worst.check), cell(&worst.subject));
        let _ = writeln!(out, "| {sign} | {} | {} | {row} | {} |", family.name, family.rows.len(), reserve(worst));
    }
    out
}

fn failed(row: &Row) -> String {
    let why = row.failure.as_ref().map_or_else(String::new, |why| format!(". {}", cell(why)));
    let name = format!("**{} / {}**", cell(&row.check), cell(&row.subject));
    format!("{name}: {}, {} ({}){why}", verdict(row), comparison(row), reserve(row))
}

/// A heading, and each item with its command; empty without items.
fn in_full(heading: &str, items: impl ExactSizeIterator<Item = (String, String)>) -> String {
    let number = items.len();
    if number == 0 {
        return String::new();
    }
    let mut out = format!("### {heading}: {number}\n\n");
    for (text, replay) in items.take(IN_FULL) {
        let _ = writeln!(out, "- {text}");
        if !replay.is_empty() {
            let _ = writeln!(out, "  ```sh\n  {replay}\n  ```");
        }
    }
    if number > IN_FULL {
        let _ = writeln!(out, "- and {} more", number - IN_FULL);
    }
    out + "\n"
}

/// Text without the characters that would end a cell of a table or begin markup.
fn cell(text: &str) -> String {
    let mut out = String::new();
    for character in text.chars() {
        match character {
            '\n' | '\r' => out.push(' '),
            '|' | '*' | '_' | '`' | '<' | '[' | '\\' | '~' => out.extend(['\\', character]),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests;
