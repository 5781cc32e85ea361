//! Dated records: what a run found, with the machine that found it beside it.

use std::path::Path;
use std::process::Command;

use anyhow::Context;
use serde::{Deserialize, Serialize};

use crate::ledger::Ledger;
use crate::report::write_file;
use crate::work_precision::{Sample, Sweep};

/// Version of the layout of records.
const SCHEMA: u32 = 1;

/// The file of a record's runs, one a line.
const SAMPLES: &str = "work-precision.jsonl";

/// The machine and the code of a record.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Host {
    /// Version of the layout of the record.
    pub schema: u32,
    /// Day of the run (UTC).
    pub date: String,
    /// The commit, with `+` if files were changed.
    pub commit: String,
    /// The compiler.
    pub rustc: String,
    /// Architecture and operating system.
    pub target: String,
    /// The processor.
    pub cpu: String,
    /// Its cores that may be used.
    pub cores: usize,
}

impl Host {
    /// This machine, now. What can't be found out is `unknown`.
    pub fn here() -> Self {
        // What `--bless` writes itself is no change of the code.
        let status = ["status", "--porcelain", "--untracked-files=no", "--", ".", ":!validation"];
        let changed = output("git", &status).is_some_and(|files| !files.is_empty());
        let commit = output("git", &["rev-parse", "HEAD"]).unwrap_or_else(unknown);
        Self {
            schema: SCHEMA,
            date: jiff::Timestamp::now().strftime("%Y-%m-%d").to_string(),
            commit: format!("{commit}{}", if changed { "+" } else { "" }),
            rustc: output("rustc", &["--version"]).unwrap_or_else(unknown),
            target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
            cpu: cpu().unwrap_or_else(unknown),
            cores: std::thread::available_parallelism().map_or(0, usize::from),
        }
    }
}

fn unknown() -> String {
    "unknown".to_owned()
}

fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}

fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// One committed record.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Where and when it was made.
    pub host: Host,
    /// What it found.
    pub accuracy: Ledger,
}

/// Writes the record of a run into `folder`/DATE.
///
/// # Errors
/// If a file can't be written.
pub fn write(folder: &Path, host: &Host, accuracy: &Ledger, sweep: &Sweep) -> anyhow::Result<()> {
    let folder = folder.join(&host.date);
    let lines: Result<Vec<String>, _> = sweep.samples.iter().map(serde_json::to_string).collect();
    write_file(&folder.join(SAMPLES), &(lines?.join("\n") + "\n"))?;
    write_file(&folder.join("accuracy.csv"), &accuracy.csv()?)?;
    write_file(&folder.join("host.json"), &(serde_json::to_string_pretty(host)? + "\n"))
}

/// The records in `folder`, by date.
///
/// # Errors
/// If one can't be read.
pub fn read(folder: &Path) -> anyhow::Result<Vec<Record>> {
    let failed = || format!("cannot read {}", folder.display());
    let mut dates: Vec<_> = std::fs::read_dir(folder).with_context(failed)?.collect::<Result<_, _>>()?;
    dates.sort_by_key(std::fs::DirEntry::file_name);
    let record = |folder: &Path| {
        let path = folder.join("host.json");
        let text = std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        let host = serde_json::from_str(&text).with_context(|| format!("in {}", path.display()))?;
        Ok(Record { host, accuracy: Ledger::read(&folder.join("accuracy.csv"))? })
    };
    dates.iter().filter(|entry| entry.path().is_dir()).map(|entry| record(&entry.path())).collect()
}

/// The runs of the record in `folder`/`date`.
///
/// # Errors
/// If they can't be read.
pub fn samples(folder: &Path, date: &str) -> anyhow::Result<Vec<Sample>> {
    let path = folder.join(date).join(SAMPLES);
    let text = std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let sample = |line: &str| serde_json::from_str(line).with_context(|| format!("in {}", path.display()));
    text.lines().map(sample).collect()
}
