//! What the checks of a run have measured, in a file a check that is written when the check ends, so that a long run can be
//! interrupted and go on.
//!
//! The files belong to one program and one effort. Another program may measure something else, and takes none of them.

use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde::{Deserialize, Serialize};

use crate::files;
use crate::judge::time::Timing;
use crate::measure::effort::Effort;
use crate::measure::trial::Measurement;

/// A folder of what was measured.
#[derive(Debug)]
pub struct Kept {
    folder: PathBuf,
    /// The program that measures.
    program: String,
}

/// What one check measured, in which time.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ended {
    program: String,
    timing: Timing,
    measured: Vec<Measurement>,
}

impl Kept {
    /// Inside `folder`, for this program.
    ///
    /// # Errors
    /// If the program's own file can't be read.
    pub fn new(folder: &Path, effort: Effort) -> anyhow::Result<Self> {
        let program = std::env::current_exe().and_then(std::fs::read).context("cannot read the program itself")?;
        let mut hasher = DefaultHasher::new();
        hasher.write(&program);
        Ok(Self { folder: folder.join("measured").join(effort.name()), program: format!("{:016x}", hasher.finish()) })
    }

    /// What `check` has measured; `None` if this program has not measured it.
    ///
    /// # Errors
    /// If the file is none of ours.
    pub fn of(&self, check: &str) -> anyhow::Result<Option<(Timing, Vec<Measurement>)>> {
        let path = self.file(check);
        let Some(text) = files::read_if_any(&path)? else { return Ok(None) };
        let failed = || format!("{}: remove it, to measure {check} again", path.display());
        let found: Ended = toml::from_str(&text).with_context(failed)?;
        Ok((found.program == self.program).then_some((found.timing, found.measured)))
    }

    /// Keeps what `check` has measured.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn keep(&self, check: &str, timing: &Timing, measured: &[Measurement]) -> anyhow::Result<()> {
        let ended = Ended { program: self.program.clone(), timing: timing.clone(), measured: measured.to_vec() };
        files::write(&self.file(check), &toml::to_string(&ended)?)
    }

    fn file(&self, check: &str) -> PathBuf {
        self.folder.join(format!("{check}.toml"))
    }
}
