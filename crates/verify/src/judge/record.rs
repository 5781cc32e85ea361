//! A record is what a run found on a certain day, together with the machine that ran it. Records are committed, so that
//! accuracy and speed can be followed over time.

use std::path::Path;

use anyhow::Context;

use super::baseline::Baseline;
use crate::files;
use crate::host::Host;
use crate::measure::work_precision::{Sample, Sweep};

/// Name of the file with a record's samples, one on each line.
const SAMPLES: &str = "work-precision.jsonl";

/// One committed record.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The machine, the commit and the day.
    pub host: Host,
    /// The errors and calls by check and subject.
    pub accuracy: Baseline,
}

/// Writes the record of a run into `folder`/DATE.
///
/// # Errors
/// If a file can't be written.
pub fn write(folder: &Path, host: &Host, accuracy: &Baseline, sweep: &Sweep) -> anyhow::Result<()> {
    let folder = folder.join(&host.date);
    let lines: Result<Vec<String>, _> = sweep.samples.iter().map(serde_json::to_string).collect();
    files::write(&folder.join(SAMPLES), &(lines?.join("\n") + "\n"))?;
    files::write(&folder.join("accuracy.csv"), &accuracy.csv()?)?;
    files::write(&folder.join("host.json"), &(serde_json::to_string_pretty(host)? + "\n"))
}

/// Reads the records in `folder`, ordered by date; none if there is no such folder.
///
/// # Errors
/// If one can't be read.
pub fn read(folder: &Path) -> anyhow::Result<Vec<Record>> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let failed = || format!("cannot read {}", folder.display());
    let mut dates: Vec<_> = std::fs::read_dir(folder).with_context(failed)?.collect::<Result<_, _>>()?;
    dates.sort_by_key(std::fs::DirEntry::file_name);
    let record = |folder: &Path| {
        let path = folder.join("host.json");
        let host = serde_json::from_str(&files::read(&path)?).with_context(|| format!("in {}", path.display()))?;
        let accuracy = Baseline::read(&folder.join("accuracy.csv"))?.unwrap_or_default();
        Ok(Record { host, accuracy })
    };
    dates.iter().filter(|entry| entry.path().is_dir()).map(|entry| record(&entry.path())).collect()
}

/// Reads the samples of the record in `folder`/`date`.
///
/// # Errors
/// If they can't be read.
pub fn samples(folder: &Path, date: &str) -> anyhow::Result<Vec<Sample>> {
    let path = folder.join(date).join(SAMPLES);
    let sample = |line: &str| serde_json::from_str(line).with_context(|| format!("in {}", path.display()));
    files::read(&path)?.lines().map(sample).collect()
}
