//! This file describes the machine and the version of the code of a measurement. Times depend on the machine, and
//! errors on the code, so a record without them could not be interpreted.

use std::process::Command;

use anyhow::{Context, ensure};
use serde::{Deserialize, Serialize};

use crate::shown::shown;

/// Version of the layout of records.
const SCHEMA: u32 = 1;

/// The machine, the code and the day of a record.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Host {
    /// Version of the layout of the record.
    pub schema: u32,
    /// Day of the run (UTC).
    pub date: String,
    /// The commit, followed by `+` if tracked files outside `validation` were changed.
    pub commit: String,
    /// The compiler's version.
    pub rustc: String,
    /// The architecture and the operating system.
    pub target: String,
    /// The name of the processor.
    pub cpu: String,
    /// Number of cores that the program may use.
    pub cores: usize,
}

impl Host {
    /// The host that the JSON in `text` describes.
    ///
    /// # Errors
    /// If it describes none, or one of another layout.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let mut host: Self = serde_json::from_str(text).context("it describes no host")?;
        ensure!(host.schema == SCHEMA, "schema = {}: expected {SCHEMA}", host.schema);
        for part in [&mut host.date, &mut host.commit, &mut host.rustc, &mut host.target, &mut host.cpu] {
            *part = shown(part);
        }
        Ok(host)
    }

    /// This machine, today. Each text that cannot be found out is `unknown`.
    pub fn here() -> Self {
        // `--bless` writes into `validation`, and that is no change of the code.
        let status = ["status", "--porcelain", "--untracked-files=no", "--", ".", ":!validation"];
        let changed = output("git", &status).is_some_and(|files| !files.is_empty());
        let commit = output("git", &["rev-parse", "HEAD"]).unwrap_or_else(unknown);
        Self {
            schema: SCHEMA,
            date: chrono::Utc::now().format("%Y-%m-%d").to_string(),
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
    Some(shown(String::from_utf8(output.stdout).ok()?.trim()))
}

fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(shown(line.split_once(':')?.1.trim()))
}
