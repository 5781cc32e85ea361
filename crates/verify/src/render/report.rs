//! The report of a run. It holds all that the renderings show.

use serde::Serialize;

use super::pattern;
use crate::judge::LeftOut;
use crate::judge::Row;
use crate::judge::baseline::{Baseline, Direction, Entry, Move};
use crate::judge::time::Timing;
use crate::measure::context::Records;
use crate::measure::effort::Effort;

/// Version of the layout of report.json, which `docs/report.schema.json` describes.
const SCHEMA: u32 = 5;

/// Everything that a run found.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// Version of this layout.
    pub schema: u32,
    /// Whether every row passes.
    pub passed: bool,
    /// The effort of the run: how many cases were tried.
    pub effort: Effort,
    /// What the failing rows have in common, what passes, and what became worse, in words.
    pub pattern: String,
    /// The rows.
    pub rows: &'a [Row],
    /// The time that each check took.
    pub checks: &'a [Timing],
    /// The baseline with which the run was compared.
    pub baseline: Compared,
    /// What moved against the baseline.
    pub moves: &'a [Move],
    /// The checks that gave no row.
    pub left_out: &'a [LeftOut],
    /// The runs behind some of the rows.
    pub records: Records<'a>,
}

/// The baseline with which a run was compared.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Compared {
    /// Its file.
    pub file: String,
    /// Whether there is one. Without it nothing is compared, so that nothing can be worse.
    pub found: bool,
}

impl Compared {
    /// How many rows `moves` shows to have become worse, better, new or gone.
    pub fn words(&self, moves: &[Move]) -> String {
        if !self.found {
            return format!("There is no baseline yet at {}, so nothing was compared; --bless begins one.", self.file);
        }
        let count = |direction| moves.iter().filter(|moved| moved.direction == direction).count();
        let [worse, better, new, gone] =
            [Direction::Worse, Direction::Better, Direction::New, Direction::Gone].map(count);
        format!("Compared with the baseline {}: {worse} worse, {better} better, {new} new, {gone} gone.", self.file)
    }
}

impl<'a> Report<'a> {
    /// The report of `rows`, whose checks took the times of `checks`.
    pub fn new(
        effort: Effort,
        rows: &'a [Row],
        checks: &'a [Timing],
        baseline: Compared,
        moves: &'a [Move],
        left_out: &'a [LeftOut],
        records: Records<'a>,
    ) -> Self {
        let pattern = [pattern::of_rows(rows), pattern::of_moves(moves, rows)].join(" ").trim_end().to_owned();
        let passed = rows.iter().all(|row| row.status.passes());
        Self { schema: SCHEMA, passed, effort, pattern, rows, checks, baseline, moves, left_out, records }
    }

    /// The report as JSON.
    ///
    /// # Errors
    /// Never for plain data.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)?)
    }

    /// What each row measured, and the error and the calls of each problem of speed and accuracy, by check and subject.
    pub(super) fn metrics(&self) -> impl Iterator<Item = (String, String, Entry)> {
        let of_row =
            |row: &Row| Some((row.check.clone(), row.subject.clone(), Entry { error: row.measured?, calls: None }));
        self.rows.iter().filter_map(of_row).chain(Baseline::of(&[], self.records.sweep).into_entries())
    }
}
