//! This file counts the instructions that a toss takes. Unlike times, counts are the same in every run, so they can be
//! compared with a baseline and judged.
//!
//! Valgrind's callgrind runs each work once and three times; the difference is divided by the tosses that the two more
//! rounds solve, so that the start of the program does not count. Valgrind supports AVX2 but not AVX-512.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, bail};
use rayon::ThreadPoolBuilder;
use sampling::{Plan, Rest, Sampler, Scrambled};
use toss::{Batch, Formulation, QuaternionSolver, Registry, Settings, SimdLevel, Solver, Stepping, TAYLOR, Tilt};

use super::launches::box_of_launches;
use super::tosses::Columns;
use crate::files;
use crate::table;

/// Number of tosses in a work of many tosses.
const TOSSES: usize = 512;

/// Number of tosses in a work that solves them one by one.
const FLOWN: usize = 64;

/// Number of launches in a work that estimates a probability.
const LAUNCHES: u64 = 1 << 17;

/// Works without a level take the one that the library chooses by itself. The baseline has it for this one, which
/// valgrind has on every machine of today.
const LEVEL_OF_BASELINE: &str = "avx2";

/// A work is worse if it takes more than this many times the instructions of the baseline.
const MORE: f64 = 1.05;

/// The names of the works: what is computed, a slash, and the SIMD level, or `default` for the one that the library
/// chooses by itself. For `cos-tilt` and `outcome`, one by one, the solver and its scheme follow; for `launches`, the
/// method that chooses them.
const WORKS: [&str; 24] = [
    "cos-tilts/plain",
    "cos-tilts/avx2",
    "count/plain",
    "count/avx2",
    "attitudes/plain",
    "attitudes/avx2",
    "bodies/plain",
    "bodies/avx2",
    "taylor/plain",
    "taylor/avx2",
    "cos-tilts/default",
    "count/default",
    "attitudes/default",
    "landings/default",
    "cos-tilt/exact",
    "outcome/exact",
    "cos-tilt/gamma/dop853",
    "cos-tilt/euler/dop853",
    "cos-tilt/quaternion/dop853",
    "cos-tilt/quaternion/taylor",
    "outcome/quaternion/taylor",
    "launches/random",
    "launches/sobol",
    "launches/exact-speed",
];

pub(crate) fn work(name: &str, times: u32) -> anyhow::Result<()> {
    let (work, by) = name.split_once('/').context("a work has a name such as count/avx2")?;
    match work {
        "cos-tilt" | "outcome" => one_by_one(work, by, times),
        "launches" => estimates(by, times),
        _ => many(work, by, times),
    }
}

/// Does a work of many tosses at a SIMD level.
fn many(work: &str, level: &str, times: u32) -> anyhow::Result<()> {
    let columns = Columns::new(TOSSES);
    let tosses = columns.tosses();
    let known = SimdLevel::all().into_iter().find(|known| known.name() == level);
    let batch = match known {
        None if level == "default" => Batch::new(tosses),
        known => Batch::new(tosses).on(known.context("this machine has no such SIMD level")?),
    };
    let mut tilts = vec![Tilt { cos_tilt: 0.0, error: None }; TOSSES];
    let (mut out, mut quaternions) = (vec![0.0; TOSSES], [(); 4].map(|()| vec![0.0; TOSSES]));
    let bodies = Batch::new(columns.tosses_of(super::bodies::body()));
    let each = columns.each();
    let taylor = QuaternionSolver::new(Stepping::adaptive(TAYLOR, 1e-10)?, Formulation::default());
    for _ in 0..times {
        match (work, known) {
            ("cos-tilts", _) => batch.cos_tilts(&mut out)?,
            ("count", _) => drop(std::hint::black_box(batch.count()?)),
            ("bodies", Some(level)) => drop(std::hint::black_box(bodies.on(level).count()?)),
            ("attitudes", _) => batch.attitudes(quaternions.each_mut().map(Vec::as_mut_slice))?,
            ("taylor", Some(level)) => drop(taylor.land_all(&each, level)),
            ("landings", None) => taylor.tilts(&each, &mut tilts)?,
            _ => bail!("no such work"),
        }
    }
    Ok(())
}

/// Solves tosses one by one with the solver and scheme `by`.
fn one_by_one(work: &str, by: &str, times: u32) -> anyhow::Result<()> {
    let (name, scheme) = by.split_once('/').map_or((by, None), |(name, scheme)| (name, Some(scheme)));
    let entry = Registry::standard().entries().iter().find(|entry| entry.name() == name).context("no such solver")?;
    let scheme = scheme.map(|scheme| entry.schemes().iter().find(|known| known.name() == scheme).context("no scheme"));
    let stepping = scheme.transpose()?.map(|scheme| Stepping::adaptive(*scheme, 1e-10)).transpose()?;
    let settings = Settings { stepping: stepping.unwrap_or(Stepping::DEFAULT), formulation: Formulation::default() };
    let solver = entry.solver(&settings)?;
    let each = Columns::new(FLOWN).each();
    for toss in (0..times).flat_map(|_| &each) {
        match work {
            "cos-tilt" => _ = std::hint::black_box(solver.tilt(toss)?.cos_tilt),
            _ => _ = std::hint::black_box(solver.tilt(toss)?.outcome()),
        }
    }
    Ok(())
}

/// Estimates the probability over the box of launches by a method, on one thread.
fn estimates(method: &str, times: u32) -> anyhow::Result<()> {
    let scrambled = Scrambled::new(LAUNCHES, 1);
    let plan = match method {
        "random" => Plan::Random { points: LAUNCHES, seed: 1 },
        "sobol" => Plan::Sobol(scrambled),
        "exact-speed" => Plan::ExactSpeed(Rest::Sobol(scrambled)),
        _ => bail!("no such method"),
    };
    let space = box_of_launches()?;
    let pool = ThreadPoolBuilder::new().num_threads(1).build().context("cannot start a thread")?;
    for _ in 0..times {
        std::hint::black_box(pool.install(|| Sampler::exact().estimate(&space, plan))?);
    }
    Ok(())
}

/// Whether this machine can do the work called `name` as the baseline has it.
fn is_here(name: &str) -> bool {
    let levels: Vec<&str> = SimdLevel::all().into_iter().map(SimdLevel::name).collect();
    let level = name.rsplit('/').next().unwrap_or_default();
    match level {
        "plain" => true,
        // The other works take the level of the machine too.
        _ => levels.contains(&LEVEL_OF_BASELINE),
    }
}

/// Number of tosses in the work called `name`.
fn tosses(name: &str) -> usize {
    match name.split('/').next() {
        Some("cos-tilt" | "outcome") => FLOWN,
        Some("launches") => usize::try_from(LAUNCHES).unwrap_or(usize::MAX),
        _ => TOSSES,
    }
}

/// Number of instructions for each toss, by work.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Instructions(BTreeMap<String, f64>);

const COLUMNS: [&str; 2] = ["work", "instructions"];

impl Instructions {
    /// Counts the instructions of all works that this machine can do, by running this program under valgrind.
    pub(crate) fn count() -> anyhow::Result<Self> {
        let count = |work: &&str| {
            let more = collected(work, 3)? - collected(work, 1)?;
            Ok((work.to_string(), more / (2 * tosses(work)) as f64))
        };
        Ok(Self(WORKS.iter().filter(|work| is_here(work)).map(count).collect::<anyhow::Result<_>>()?))
    }

    /// Reads the baseline from the file at `path`; empty if there is no file.
    pub(crate) fn read(path: &Path) -> anyhow::Result<Self> {
        let Some(text) = files::read_if_any(path)? else { return Ok(Self::default()) };
        let count = |row: table::Row<2>| Ok((row.cells[0].clone(), row.number(1)?));
        let counts = table::rows(&text, COLUMNS, 1).and_then(|rows| rows.into_iter().map(count).collect());
        Ok(Self(counts.with_context(|| format!("cannot read {}", path.display()))?))
    }

    /// Writes the baseline with counts that are smaller or new; larger ones are not taken over.
    pub(crate) fn bless(&self, baseline: &Self, path: &Path) -> anyhow::Result<()> {
        let mut best = baseline.0.clone();
        for (work, count) in &self.0 {
            best.entry(work.clone()).and_modify(|old| *old = old.min(*count)).or_insert(*count);
        }
        let row = |(work, count): (String, f64)| [work, format!("{:?}", (10.0 * count).round() / 10.0)];
        files::write(path, &table::text(COLUMNS, best.into_iter().map(row))?)
    }

    /// The table of counts beside `baseline`, and whether a work takes more instructions than allowed.
    pub(crate) fn compared(&self, baseline: &Self) -> (String, bool) {
        let mut text = format!("{:<28} {:>14} {:>10}\n", "work", "instructions", "baseline");
        let mut is_worse = false;
        for (work, count) in &self.0 {
            let old = baseline.0.get(work);
            let worse = old.is_some_and(|old| *count > MORE * old);
            is_worse |= worse;
            let old = old.map_or("-".to_owned(), |old| format!("{old:.1}"));
            text += &format!("{work:<28} {count:>14.1} {old:>10}{}\n", if worse { "  MORE" } else { "" });
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
        for name in WORKS {
            let needs_avx2 = name.ends_with(LEVEL_OF_BASELINE);
            assert_eq!(work(name, 1).is_ok(), is_here(name) || !needs_avx2, "{name}");
        }
        for name in ["sums/plain", "count", "taylor/default", "cos-tilt/nobody", "cos-tilt/gamma/taylor", "count/sse"] {
            assert!(work(name, 1).is_err(), "{name}");
        }
    }
}
