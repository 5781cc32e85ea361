//! This file counts the instructions that a toss takes. Unlike times, counts are the same in every run, so they can be
//! compared with a baseline and judged.
//!
//! Valgrind's callgrind runs each work once and three times; the difference is divided by the tosses that the two more
//! rounds solve, so that the start of the program does not count. Valgrind supports AVX2 but not AVX-512.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use toss::{Formulation, QuaternionSolver, SimdLevel, Stepping, TAYLOR};

use super::tosses::Columns;
use crate::files;

/// Number of tosses in a work.
const TOSSES: usize = 512;

/// A work is worse if it takes more than this many times the instructions of the baseline.
const MORE: f64 = 1.05;

/// The names of the works: what is computed, a slash, and the SIMD level.
const WORKS: [&str; 8] = [
    "cos-tilts/plain",
    "cos-tilts/avx2",
    "count/plain",
    "count/avx2",
    "attitudes/plain",
    "attitudes/avx2",
    "taylor/plain",
    "taylor/avx2",
];

/// Does the work called `name` `times` times.
///
/// # Errors
/// If the work is unknown, or this machine does not have its SIMD level.
pub fn work(name: &str, times: u32) -> anyhow::Result<()> {
    let (work, level) = name.split_once('/').context("a work has a name such as count/avx2")?;
    let level = SimdLevel::all()
        .into_iter()
        .find(|known| known.name() == level)
        .context("this machine has no such SIMD level")?;
    let columns = Columns::new(TOSSES);
    let batch = columns.batch(level);
    let (mut out, mut quaternions) = (vec![0.0; TOSSES], [(); 4].map(|()| vec![0.0; TOSSES]));
    let each = columns.each();
    let taylor = QuaternionSolver::new(Stepping::adaptive(TAYLOR, 1e-10)?, Formulation::default());
    for _ in 0..times {
        match work {
            "cos-tilts" => batch.cos_tilts(&mut out)?,
            "count" => drop(std::hint::black_box(batch.count()?)),
            "attitudes" => batch.attitudes(quaternions.each_mut().map(Vec::as_mut_slice))?,
            "taylor" => drop(taylor.propagate_all(&each, level)),
            _ => bail!("no such work"),
        }
    }
    Ok(())
}

/// Number of instructions for each toss, by work.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Instructions(BTreeMap<String, f64>);

/// A line of the baseline.
#[derive(Serialize, Deserialize)]
struct Line {
    work: String,
    instructions: f64,
}

impl Instructions {
    /// Counts the instructions of all works that this machine can do, by running this program under valgrind.
    ///
    /// # Errors
    /// If there is no valgrind, or it fails.
    pub fn count() -> anyhow::Result<Self> {
        let levels = SimdLevel::all().into_iter().map(SimdLevel::name).collect::<Vec<_>>();
        let here = |work: &&&str| levels.iter().any(|level| work.ends_with(level));
        let count =
            |work: &&str| Ok((work.to_string(), (collected(work, 3)? - collected(work, 1)?) / (2 * TOSSES) as f64));
        Ok(Self(WORKS.iter().filter(here).map(count).collect::<anyhow::Result<_>>()?))
    }

    /// Reads the baseline from the file at `path`; empty if there is no file.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let mut reader = csv::Reader::from_path(path)?;
        let lines = reader.deserialize().map(|line| line.map(|Line { work, instructions }| (work, instructions)));
        Ok(Self(lines.collect::<Result<_, _>>()?))
    }

    /// Writes the baseline with counts that are smaller or new; larger ones are not taken over.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn bless(&self, baseline: &Self, path: &Path) -> anyhow::Result<()> {
        let mut best = baseline.0.clone();
        for (work, count) in &self.0 {
            best.entry(work.clone()).and_modify(|old| *old = old.min(*count)).or_insert(*count);
        }
        let mut writer = csv::Writer::from_writer(Vec::new());
        for (work, count) in best {
            writer.serialize(Line { work, instructions: (10.0 * count).round() / 10.0 })?;
        }
        files::write(path, &String::from_utf8(writer.into_inner()?)?)
    }

    /// The table of counts beside `baseline`, and whether a work takes more instructions than allowed.
    pub fn compared(&self, baseline: &Self) -> (String, bool) {
        let mut text = format!("{:<20} {:>14} {:>10}\n", "work", "instructions", "baseline");
        let mut is_worse = false;
        for (work, count) in &self.0 {
            let old = baseline.0.get(work);
            let worse = old.is_some_and(|old| *count > MORE * old);
            is_worse |= worse;
            let old = old.map_or("-".to_owned(), |old| format!("{old:.1}"));
            text += &format!("{work:<20} {count:>14.1} {old:>10}{}\n", if worse { "  MORE" } else { "" });
        }
        (text, is_worse)
    }
}

/// Number of instructions that this program executes to do a work `times` times.
fn collected(work: &str, times: u32) -> anyhow::Result<f64> {
    let program = std::env::current_exe()?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["work", work, "--times", &times.to_string()])
        .output()
        .context("valgrind cannot be started; it counts the instructions")?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = said.lines().find_map(|line| line.split_once("Collected :"));
    let count = line.and_then(|(_, count)| count.trim().parse().ok());
    count.filter(|_| output.status.success()).with_context(|| format!("valgrind failed on {work}: {said}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(count: f64) -> Instructions {
        Instructions([("count/avx2".to_owned(), count)].into())
    }

    #[test]
    fn more_instructions_are_worse_and_are_not_taken_into_the_baseline() {
        let baseline = counts(100.0);
        assert!(!counts(104.0).compared(&baseline).1);
        assert!(counts(106.0).compared(&baseline).1);
        assert!(!counts(106.0).compared(&Instructions::default()).1, "a work without a baseline is not worse");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("instructions.csv");
        for (found, kept) in [(106.0, 100.0), (90.0, 90.0)] {
            counts(found).bless(&baseline, &path).unwrap();
            assert_eq!(Instructions::read(&path).unwrap(), counts(kept));
        }
    }

    #[test]
    fn every_work_of_this_machine_can_be_done() {
        let levels: Vec<&str> = SimdLevel::all().into_iter().map(SimdLevel::name).collect();
        for name in WORKS {
            let is_here = levels.iter().any(|level| name.ends_with(level));
            assert_eq!(work(name, 1).is_ok(), is_here, "{name}");
        }
        assert!(work("sums/plain", 1).is_err() && work("count", 1).is_err());
    }
}
