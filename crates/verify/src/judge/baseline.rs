//! The regression baseline: the last accepted error and work of every check × subject, and what has moved against it.
//!
//! Bounds say what is allowed; the baseline says what was, so that accuracy can't slip unnoticed within its bounds. There
//! is one for each effort, because the largest error depends on how much is tried.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context;
use serde::{Deserialize, Serialize};

use super::row::Row;
use crate::measure::work_precision::{Sample, Sweep};

/// An error this many times larger is worse, and this many times smaller better.
const ERROR_RATIO: f64 = 1.25;

/// Calls this many times more are worse, and this many times fewer better.
const CALLS_RATIO: f64 = 1.05;

/// Errors that differ by less are the platform's: its sine and cosine may round otherwise.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Errors of single runs below it are taken for it (rad): there rounding decides, which differs by platform.
const FLOOR: f64 = 1e-11;

/// Stands for the error of a run that failed (rad).
const FAILED: f64 = std::f64::consts::PI;

/// Check and subject.
type Key = (String, String);

/// What was measured of a check × subject.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    error: f64,
    calls: Option<u64>,
}

/// Errors and work by check × subject.
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

/// Which way an entry went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// More error or work than was accepted.
    Worse,
    /// Less of it.
    Better,
    /// Not in the baseline.
    New,
    /// In the baseline only.
    Gone,
}

/// An entry that moved.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Move {
    /// The check, or `work-precision/` and a problem.
    pub check: String,
    /// The subject.
    pub subject: String,
    /// `error` or `calls`.
    pub what: &'static str,
    /// The accepted value.
    pub before: Option<f64>,
    /// The value found.
    pub now: Option<f64>,
    /// Which way.
    pub direction: Direction,
}

impl Baseline {
    /// What a run found: the measured value of each passing row, and of the sweep, by problem, the geometric mean of the
    /// errors and the sum of the calls.
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

    /// The baseline in the file at `path`; empty if there is none.
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

    /// What moved from this baseline to what was `found`. A `complete` run also misses what is gone.
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

    /// The baseline after a complete run: what is better or new is taken over, what is gone goes, and everything else
    /// stays, so that many small steps back are seen as the large one that they are.
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
    /// Of one subject's samples on one problem.
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
        assert_eq!(directions(&one(1e-16, 0), &one(9e-16, 0)), [], "rounding is the platform's");
    }

    #[test]
    fn a_ratchet_keeps_what_is_worse_and_takes_what_is_better() {
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
    fn a_file_gives_every_bit_back() {
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
