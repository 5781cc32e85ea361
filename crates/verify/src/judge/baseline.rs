//! The regression baseline holds the last accepted error and number of calls for each pair of check and subject, and
//! says what has changed since. Limits say what is allowed; the baseline says what was reached, so that accuracy cannot
//! become worse unnoticed within its limits.
//!
//! There is one baseline for each effort, because the largest error depends on how many cases are tried, and for each
//! architecture, because sine and cosine round differently there. A call is an evaluation of the right-hand side by an
//! integrator.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;

use super::row::Row;
use crate::files;
use crate::measure::effort::Effort;
use crate::measure::work_precision::{Sample, Sweep};
use crate::table;

/// An error is worse if it is more than this many times the accepted one, and better if it is less by the same factor;
/// [`Baseline::worse_above`] takes another number.
pub const ERROR_RATIO: f64 = 1.25;

/// The number of calls is worse if it is more than this many times the accepted one, and better if it is less by the
/// same factor.
const CALLS_RATIO: f64 = 1.05;

/// Smaller differences between errors are ignored, because sine and cosine round differently on different platforms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Errors of single runs (rad) below this count as this one, because there rounding decides, which differs between
/// platforms.
const FLOOR: f64 = 1e-11;

/// The error (rad) that counts for a run that failed.
const FAILED: f64 = std::f64::consts::PI;

/// The id of a check and the name of a subject.
type Key = (String, String);

/// What was measured for one pair of check and subject.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// The error, in the unit of the check.
    pub error: f64,
    /// Evaluations of the right-hand side, where they were counted.
    pub calls: Option<u64>,
}

/// Errors and calls by check and subject.
#[derive(Debug, Clone, PartialEq)]
pub struct Baseline {
    entries: BTreeMap<Key, Entry>,
    /// Above so many times the accepted one an error is worse.
    error_ratio: f64,
}

impl Default for Baseline {
    fn default() -> Self {
        Self { entries: BTreeMap::new(), error_ratio: ERROR_RATIO }
    }
}

impl FromIterator<(Key, Entry)> for Baseline {
    fn from_iter<T: IntoIterator<Item = (Key, Entry)>>(entries: T) -> Self {
        Self { entries: entries.into_iter().collect(), ..Self::default() }
    }
}

const COLUMNS: [&str; 4] = ["check", "subject", "error", "calls"];

/// The file, in the folder `baseline`, of the baseline for runs at `effort` on this machine's architecture.
///
/// There is no other to fall back on: against the errors of another architecture, where nothing but rounding decides,
/// half of the rows would be worse or better.
pub fn file(baseline: &Path, effort: Effort) -> PathBuf {
    baseline.join(std::env::consts::ARCH).join(format!("{}.csv", effort.name()))
}

/// How an entry changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// The error is larger, or the calls are more, than what was accepted.
    Worse,
    /// The error is smaller, or the calls are fewer.
    Better,
    /// The entry is not in the baseline.
    New,
    /// The entry is only in the baseline.
    Gone,
}

/// An entry that changed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Move {
    /// The check, or `work-precision/` followed by a problem.
    pub check: String,
    /// The subject.
    pub subject: String,
    /// What changed: `error` or `calls`.
    pub what: &'static str,
    /// The accepted value.
    pub before: Option<f64>,
    /// The value of this run.
    pub now: Option<f64>,
    /// How it changed.
    pub direction: Direction,
}

impl Baseline {
    /// The baseline that a run would give: the largest deviation of each passing row and, for each problem of the sweep,
    /// the geometric mean of the errors and the sum of the calls.
    ///
    /// The largest deviation does not depend on what judges the row. What was judged may be another one: of a row without
    /// a limit it is the deviation that is largest beside the solver's claim, and the first limit would change it.
    pub fn of(rows: &[Row], sweep: Option<&Sweep>) -> Self {
        let passing = rows.iter().filter(|row| row.status.passes());
        let mut entries: BTreeMap<Key, Entry> = passing
            .filter_map(|row| {
                Some(((row.check.clone(), row.subject.clone()), Entry { error: row.largest?, calls: None }))
            })
            .collect();
        if let Some(sweep) = sweep {
            for (problem, ..) in &sweep.problems {
                for subject in sweep.judged() {
                    let samples: Vec<&Sample> = sweep.series(problem, &subject).collect();
                    // Solvers for coins alone have none on other bodies.
                    if samples.is_empty() {
                        continue;
                    }
                    let entry = Entry::of(&samples);
                    entries.insert((format!("work-precision/{problem}"), subject.clone()), entry);
                }
            }
        }
        entries.into_iter().collect()
    }

    /// The same baseline, compared with which an error is worse above `ratio` times the accepted one, and better below it
    /// by the same factor.
    #[must_use]
    pub fn worse_above(self, ratio: f64) -> Self {
        Self { error_ratio: ratio, ..self }
    }

    /// The baseline in the file at `path`; `None` if there is no file.
    ///
    /// # Errors
    /// If the file can't be read, or can't be trusted as [`Baseline::parse`] says; the error has the line and the column.
    pub fn read(path: &Path) -> anyhow::Result<Option<Self>> {
        let Some(text) = files::read_if_any(path)? else { return Ok(None) };
        Self::parse(&text).map(Some).with_context(|| format!("cannot read {}", path.display()))
    }

    /// The baseline that the lines of CSV in `text` describe.
    ///
    /// # Errors
    /// If a number is negative or not finite, two rows have the same name, the heading is another one, or there is no row.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let entry = |row: table::Row<4>| {
            let entry = Entry { error: row.number(2)?, calls: row.count(3)? };
            let [check, subject, ..] = row.cells;
            Ok(((check, subject), entry))
        };
        table::rows(text, COLUMNS, 2)?.into_iter().map(entry).collect()
    }

    /// The baseline as CSV, one line per entry.
    ///
    /// # Errors
    /// If [`Baseline::parse`] would refuse it.
    pub fn csv(&self) -> anyhow::Result<String> {
        let row = |((check, subject), Entry { error, calls }): (&Key, &Entry)| {
            let calls = calls.map(|calls| calls.to_string()).unwrap_or_default();
            [check.clone(), subject.clone(), format!("{error:?}"), calls]
        };
        let text = table::text(COLUMNS, self.entries.iter().map(row))?;
        // A run must not leave a baseline that every later run refuses.
        Self::parse(&text).map(|_| text)
    }

    /// The error of `subject` under `check`.
    pub fn error(&self, check: &str, subject: &str) -> Option<f64> {
        self.entries.get(&(check.to_owned(), subject.to_owned())).map(|entry| entry.error)
    }

    /// The subjects of `check`.
    pub fn subjects<'a>(&'a self, check: &'a str) -> impl Iterator<Item = &'a str> {
        self.entries.keys().filter(move |key| key.0 == check).map(|key| key.1.as_str())
    }

    /// What changed from this baseline to what was `found`. If the run was `complete`, entries that it did not find are
    /// gone.
    pub fn moves(&self, found: &Self, complete: bool) -> Vec<Move> {
        let mut moves = Vec::new();
        for (key, now) in &found.entries {
            match self.entries.get(key) {
                None => moves.push(Move::new(key, "error", None, Some(now.error), Direction::New)),
                Some(before) => moves.extend(before.moves(key, now, self.error_ratio)),
            }
        }
        if complete {
            let gone = self.entries.iter().filter(|(key, _)| !found.entries.contains_key(*key));
            moves.extend(gone.map(|(key, before)| Move::new(key, "error", Some(before.error), None, Direction::Gone)));
        }
        moves
    }

    /// What changed from this baseline to what was `found` in `rows`. A row that fails is not in `found`, but it is not
    /// gone either.
    pub fn moves_to(&self, found: &Self, rows: &[Row], complete: bool) -> Vec<Move> {
        let mut moves = self.moves(found, complete);
        moves.retain(|moved| moved.direction != Direction::Gone || !rows.iter().any(|row| moved.is_of(row)));
        moves
    }

    /// The baseline after a complete run: better and new entries are taken over, entries that are gone are removed, and
    /// everything else stays. Where the run was worse, the accepted value stays, so many small steps for the worse add
    /// up until they show.
    #[must_use]
    pub fn ratcheted(&self, found: &Self) -> Self {
        let accept = |(key, now): (&Key, &Entry)| {
            let entry = self.entries.get(key).map_or(*now, |before| before.ratcheted(key, now, self.error_ratio));
            (key.clone(), entry)
        };
        Self { entries: found.entries.iter().map(accept).collect(), ..*self }
    }
}

impl Entry {
    /// The entry for one subject's samples on one problem.
    fn of(samples: &[&Sample]) -> Self {
        let logs: f64 = samples.iter().map(|sample| sample.err_attitude_rad.unwrap_or(FAILED).max(FLOOR).ln()).sum();
        Self {
            error: (logs / samples.len().max(1) as f64).exp(),
            calls: Some(samples.iter().map(|sample| sample.n_rhs).sum()),
        }
    }

    fn moves(&self, key: &Key, now: &Self, error_ratio: f64) -> Vec<Move> {
        let error = direction(self.error, now.error, error_ratio, ROUNDING);
        let calls = self.calls.zip(now.calls).and_then(|(before, now)| {
            let (before, now) = (before as f64, now as f64);
            Some((before, now, direction(before, now, CALLS_RATIO, 0.0)?))
        });
        let error = error.map(|direction| Move::new(key, "error", Some(self.error), Some(now.error), direction));
        let calls = calls.map(|(before, now, direction)| Move::new(key, "calls", Some(before), Some(now), direction));
        error.into_iter().chain(calls).collect()
    }

    fn ratcheted(&self, key: &Key, now: &Self, error_ratio: f64) -> Self {
        let mut kept = *self;
        for moved in self.moves(key, now, error_ratio).iter().filter(|moved| moved.direction == Direction::Better) {
            if moved.what == "error" {
                kept.error = now.error;
            } else {
                kept.calls = now.calls;
            }
        }
        Self { calls: if self.calls.is_some() == now.calls.is_some() { kept.calls } else { now.calls }, ..kept }
    }
}

/// How `now` compares with `before`; `None` if they differ by less than a factor of `ratio`, apart from `slack`.
fn direction(before: f64, now: f64, ratio: f64, slack: f64) -> Option<Direction> {
    if now > ratio * before + slack {
        Some(Direction::Worse)
    } else if before > ratio * now + slack {
        Some(Direction::Better)
    } else {
        None
    }
}

impl Move {
    /// Whether it is a change of `row`.
    pub fn is_of(&self, row: &Row) -> bool {
        self.check == row.check && self.subject == row.subject
    }

    fn new(key: &Key, what: &'static str, before: Option<f64>, now: Option<f64>, direction: Direction) -> Self {
        Self { check: key.0.clone(), subject: key.1.clone(), what, before, now, direction }
    }
}

#[cfg(test)]
mod tests;
