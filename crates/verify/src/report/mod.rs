//! Reports render rows; they measure and judge nothing.

pub mod charts;
pub mod history;
pub mod html;
pub mod junit;
pub mod moves;
pub mod runs;
pub mod table;

use std::path::Path;

use anyhow::Context;
use serde::Serialize;

use crate::context::Records;
use crate::effort::Effort;
use crate::judge::Row;
use crate::ledger::Move;

/// Everything that a run found.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// Version of this layout.
    pub schema: u32,
    /// Whether every row passes.
    pub passed: bool,
    /// How much was tried.
    pub effort: Effort,
    /// The rows.
    pub rows: &'a [Row],
    /// What moved against the baseline.
    pub moves: &'a [Move],
    /// The runs behind some of the rows.
    pub records: Records<'a>,
}

impl<'a> Report<'a> {
    /// The report of `rows`.
    pub fn new(effort: Effort, rows: &'a [Row], moves: &'a [Move], records: Records<'a>) -> Self {
        Self { schema: 2, passed: rows.iter().all(|row| row.status.passes()), effort, rows, moves, records }
    }

    /// As JSON.
    ///
    /// # Errors
    /// Never for plain data.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)?)
    }
}

/// Writes a file whole or not at all, and the folder that it is in.
///
/// # Errors
/// If the folder can't be made or the file not be written.
pub fn write_file(path: &Path, content: &str) -> anyhow::Result<()> {
    let failed = || format!("cannot write {}", path.display());
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(failed)?;
    whole_file::write(path, content).with_context(failed)
}
