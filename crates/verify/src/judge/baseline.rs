//! The regression baseline holds the last accepted error and number of calls for each pair of check and subject, and
//! says what has changed since. Bounds say what is allowed; the baseline says what was reached, so that accuracy cannot
//! become worse unnoticed within its bounds.
//!
//! There is one baseline for each effort, because the largest error depends on how many cases are tried. A call is an
//! evaluation of the right-hand side by an integrator.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context;
use serde::{Deserialize, Serialize};

use super::row::Row;
use crate::measure::work_precision::{Sample, Sweep};

/// An error is worse if it is more than this many times the accepted one, and better if it is less by the same factor.
const ERROR_RATIO: f64 = 1.25;

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
struct Entry {
    error: f64,
    calls: Option<u64>,
}

/// Errors and calls by check and subject.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Baseline(BTreeMap<Key, Entry>);

/// A line of the file.
#[derive(Serialize, Deserialize)]
struct Line {
    check: String,
    subject: String,
    error: f64,
    calls: Option<u64>,
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
    /// The baseline that a run would give: the measured value of each passing row and, for each problem of the sweep,
    /// the geometric mean of the errors and the sum of the calls.
    pub fn of(rows: &[Row], sweep: Option<&Sweep>) -> Self {
        let passing = rows.iter().filter(|row| row.status.passes());
        let mut entries: BTreeMap<Key, Entry> = passing
            .filter_map(|row| {
                Some(((row.check.clone(), row.subject.clone()), Entry { error: row.measured?, calls: None }))
            })
            .collect();
        if let Some(sweep) = sweep {
            for (problem, ..) in &sweep.problems {
                for subject in sweep.subjects() {
                    let samples: Vec<&Sample> = sweep.series(problem, &subject).collect();
                    let entry = Entry::of(&samples);
                    entries.insert((format!("work-precision/{problem}"), subject.clone()), entry);
                }
            }
        }
        Self(entries)
    }

    /// Reads the baseline from the file at `path`; empty if there is no file.
    ///
    /// # Errors
    /// If the file can't be read.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let failed = || format!("cannot read {}", path.display());
        let mut entries = BTreeMap::new();
        for line in csv::Reader::from_path(path).with_context(failed)?.deserialize() {
            let Line { check, subject, error, calls } = line.with_context(failed)?;
            entries.insert((check, subject), Entry { error, calls });
        }
        Ok(Self(entries))
    }

    /// The baseline as CSV, one line per entry.
    ///
    /// # Errors
    /// Never for plain values.
    pub fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for ((check, subject), Entry { error, calls }) in &self.0 {
            let (check, subject) = (check.clone(), subject.clone());
            writer.serialize(Line { check, subject, error: *error, calls: *calls })?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }

    /// The error of `subject` under `check`.
    pub fn error(&self, check: &str, subject: &str) -> Option<f64> {
        self.0.get(&(check.to_owned(), subject.to_owned())).map(|entry| entry.error)
    }

    /// The subjects of `check`.
    pub fn subjects<'a>(&'a self, check: &'a str) -> impl Iterator<Item = &'a str> {
        self.0.keys().filter(move |key| key.0 == check).map(|key| key.1.as_str())
    }

    /// What changed from this baseline to what was `found`. If the run was `complete`, entries that it did not find are
    /// gone.
    pub fn moves(&self, found: &Self, complete: bool) -> Vec<Move> {
        let mut moves = Vec::new();
        for (key, now) in &found.0 {
            match self.0.get(key) {
                None => moves.push(Move::new(key, "error", None, Some(now.error), Direction::New)),
                Some(before) => moves.extend(before.moves(key, now)),
            }
        }
        if complete {
            let gone = self.0.iter().filter(|(key, _)| !found.0.contains_key(*key));
            moves.extend(gone.map(|(key, before)| Move::new(key, "error", Some(before.error), None, Direction::Gone)));
        }
        moves
    }

    /// The baseline after a complete run: better and new entries are taken over, entries that are gone are removed, and
    /// everything else stays. Where the run was worse, the accepted value stays, so many small steps for the worse add
    /// up until they show.
    #[must_use]
    pub fn ratcheted(&self, found: &Self) -> Self {
        let accept = |(key, now): (&Key, &Entry)| {
            let entry = self.0.get(key).map_or(*now, |before| before.ratcheted(key, now));
            (key.clone(), entry)
        };
        Self(found.0.iter().map(accept).collect())
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

    fn moves(&self, key: &Key, now: &Self) -> Vec<Move> {
        let error = direction(self.error, now.error, ERROR_RATIO, ROUNDING);
        let calls = self.calls.zip(now.calls).and_then(|(before, now)| {
            let (before, now) = (before as f64, now as f64);
            Some((before, now, direction(before, now, CALLS_RATIO, 0.0)?))
        });
        let error = error.map(|direction| Move::new(key, "error", Some(self.error), Some(now.error), direction));
        let calls = calls.map(|(before, now, direction)| Move::new(key, "calls", Some(before), Some(now), direction));
        error.into_iter().chain(calls).collect()
    }

    fn ratcheted(&self, key: &Key, now: &Self) -> Self {
        let mut kept = *self;
        for moved in self.moves(key, now).iter().filter(|moved| moved.direction == Direction::Better) {
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
    fn new(key: &Key, what: &'static str, before: Option<f64>, now: Option<f64>, direction: Direction) -> Self {
        Self { check: key.0.clone(), subject: key.1.clone(), what, before, now, direction }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(error: f64, calls: u64) -> Baseline {
        Baseline(BTreeMap::from([(("check".to_owned(), "a, b".to_owned()), Entry { error, calls: Some(calls) })]))
    }

    fn directions(before: &Baseline, now: &Baseline) -> Vec<(&'static str, Direction)> {
        before.moves(now, true).iter().map(|moved| (moved.what, moved.direction)).collect()
    }

    #[test]
    fn a_quarter_more_error_or_a_twentieth_more_calls_is_worse() {
        let baseline = one(1e-9, 1000);
        assert_eq!(directions(&baseline, &one(1.24e-9, 1049)), []);
        assert_eq!(directions(&baseline, &one(1.26e-9, 1000)), [("error", Direction::Worse)]);
        assert_eq!(
            directions(&baseline, &one(0.7e-9, 1051)),
            [("error", Direction::Better), ("calls", Direction::Worse)]
        );
        assert_eq!(directions(&baseline, &one(1e-9, 900)), [("calls", Direction::Better)]);
        assert_eq!(directions(&one(1e-16, 0), &one(9e-16, 0)), [], "differences of rounding do not count");
    }

    #[test]
    fn a_ratcheted_baseline_takes_what_is_better_and_keeps_what_would_be_worse() {
        let baseline = one(1e-9, 1000);
        assert_eq!(baseline.ratcheted(&one(1e-8, 900)), one(1e-9, 900));
        assert_eq!(baseline.ratcheted(&one(1e-10, 2000)), one(1e-10, 1000));
        assert_eq!(baseline.ratcheted(&one(0.99e-9, 999)), baseline, "small steps are not taken, in either direction");
        assert_eq!(Baseline::default().ratcheted(&baseline), baseline);
        assert_eq!(directions(&Baseline::default(), &baseline), [("error", Direction::New)]);
        assert_eq!(directions(&baseline, &Baseline::default()), [("error", Direction::Gone)]);
        assert!(baseline.moves(&Baseline::default(), false).is_empty());
    }

    #[test]
    fn a_baseline_keeps_every_bit_through_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("quick.csv");
        assert_eq!(Baseline::read(&path).unwrap(), Baseline::default());
        let baseline = one(0.1 + 0.2, 77);
        std::fs::write(&path, baseline.csv().unwrap()).unwrap();
        assert_eq!(Baseline::read(&path).unwrap(), baseline);
        std::fs::write(&path, "check,subject,error,calls\nx,y,many,\n").unwrap();
        assert!(Baseline::read(&path).unwrap_err().to_string().contains("quick.csv"));
    }
}
