//! The report of a run. It holds all that the renderings show.

use serde::Serialize;

use crate::judge::Row;
use crate::judge::baseline::Move;
use crate::measure::context::Records;
use crate::measure::effort::Effort;

/// Version of the layout of report.json.
const SCHEMA: u32 = 3;

/// Everything that a run found.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// Version of this layout.
    pub schema: u32,
    /// Whether every row passes.
    pub passed: bool,
    /// The effort of the run: how many cases were tried.
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
        Self { schema: SCHEMA, passed: rows.iter().all(|row| row.status.passes()), effort, rows, moves, records }
    }

    /// The report as JSON.
    ///
    /// # Errors
    /// Never for plain data.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)?)
    }
}
