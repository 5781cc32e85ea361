//! Renders the report for GitHub Actions: annotations, which are lines on standard output that GitHub shows beside the
//! run, and a summary for the page of the run.
//!
//! The syntax and its escapes are those of GitHub's documentation, "Workflow commands for GitHub Actions".

use std::fmt::Write;

use super::report::Verdict;
use super::words::{comparison, reserve, verdict};
use super::{Report, text, words};

/// GitHub shows so many annotations of a kind for each step and drops the rest, so the last one says how many are left.
const SHOWN: usize = 10;

/// GitHub refuses a summary of more than 1 MiB.
const MOST_BYTES: usize = 1_000_000;

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

/// The summary: the verdict, and below it the text of the report.
pub(crate) fn summary(report: &Report) -> String {
    let verdict = match report.verdict() {
        Verdict::Pass => "✅ PASS",
        Verdict::Worse => "⚠️ WORSE than the baseline",
        Verdict::Fail => "❌ FAIL",
    };
    let all = report.rows.len();
    let mut out = format!("## {verdict}: {} of {all} rows pass\n\n", all - report.failing().len());
    for line in text::whole(report, false).lines() {
        if out.len() + line.len() > MOST_BYTES {
            out += "    …\n";
            break;
        }
        // Four spaces begin a block without markup.
        let _ = writeln!(out, "    {line}");
    }
    out
}

#[cfg(test)]
mod tests;
