//! What a run of a suite found: rows, what moved against the baseline, the verdict, and the reports.

use std::path::Path;
use std::sync::Arc;

use toss::Registry;

use super::Suite;
use crate::host::Host;
use crate::judge::baseline::{Baseline, Direction, Move};
use crate::judge::time::Timing;
use crate::judge::{LeftOut, Row, proposal};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::render::charts::{self, Chart};
use crate::render::report::Compared;
use crate::render::{Report, github, html, junit, metrics};
use crate::{Error, files};

/// Name of the file with proposed limits, beside the reports.
pub(crate) const PROPOSAL: &str = "limits.proposed.toml";

/// The verdict on a whole run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Every row passes, and none is worse than the baseline.
    Pass,
    /// Every row passes, but something is worse than the baseline.
    Worse,
    /// A row fails.
    Fail,
}

/// The result of a run.
pub struct Verified {
    registry: Registry,
    host: Host,
    effort: Effort,
    rows: Vec<Row>,
    moves: Vec<Move>,
    left_out: Vec<LeftOut>,
    timings: Vec<Timing>,
    compared: Compared,
    found: Baseline,
    context: Arc<Context>,
}

impl Verified {
    pub(super) fn new(
        suite: &Suite,
        is_complete: bool,
        rows: Vec<Row>,
        timings: Vec<Timing>,
        context: Arc<Context>,
        left_out: Vec<LeftOut>,
    ) -> anyhow::Result<Self> {
        let (registry, effort, path) = (suite.registry.clone(), suite.effort, suite.baseline_path());
        let (baseline, found) = (Baseline::read(&path)?, Baseline::of(&rows, context.records().sweep));
        let moves = baseline.as_ref().map_or_else(Vec::new, |baseline| baseline.moves_to(&found, &rows, is_complete));
        let compared = Compared { file: path.display().to_string(), found: baseline.is_some(), written: false };
        let host = Host::here();
        Ok(Self { registry, host, effort, rows, moves, left_out, timings, compared, found, context })
    }

    /// The judged rows.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// What moved against the baseline.
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// The checks that gave no row, with the reasons.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// The verdict on the whole run.
    pub fn verdict(&self) -> Verdict {
        if self.rows.iter().any(|row| !row.status.passes()) {
            Verdict::Fail
        } else if self.moves.iter().any(|moved| moved.direction == Direction::Worse) {
            Verdict::Worse
        } else {
            Verdict::Pass
        }
    }

    /// The exit code that tells a script the verdict: 0, 3 or 1.
    pub fn exit_code(&self) -> u8 {
        match self.verdict() {
            Verdict::Pass => 0,
            Verdict::Fail => 1,
            Verdict::Worse => 3,
        }
    }

    /// Limits for the rows that pass without one, as the text of a `limits.toml`: twice what was measured, rounded up to
    /// one digit. `None` if every row that passes has a limit.
    pub fn proposed_limits(&self) -> Option<String> {
        proposal::text(&self.rows, &format!("a {} run on {}", self.effort.name(), self.host.date))
    }

    /// Writes report.html, report.json, junit.xml, summary.md, metrics, charts and, if there are any, proposed limits into
    /// `folder`.
    ///
    /// # Errors
    /// If a file can't be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        Ok(self.written(folder)?)
    }

    fn written(&self, folder: &Path) -> anyhow::Result<()> {
        let report = self.report();
        let charts = charts::charts(&report, self.registry.entries())?;
        for (file, text) in [
            ("report.json", report.json()?),
            ("junit.xml", junit::xml(&report)?),
            ("summary.md", github::summary(&report)),
            ("metrics.json", metrics::bencher(&report)?),
            ("github-action-benchmark.json", metrics::smaller_is_better(&report)?),
            ("report.html", html::page(&report, &charts)),
        ] {
            files::write(&folder.join(file), &text)?;
        }
        for Chart { file, svg, .. } in &charts {
            files::write(&folder.join(file), svg)?;
        }
        if let Some(proposal) = self.proposed_limits() {
            files::write(&folder.join(PROPOSAL), &proposal)?;
        }
        Ok(())
    }

    /// Everything that the reports show.
    pub fn report(&self) -> Report<'_> {
        Report::new(
            &self.host,
            self.effort,
            &self.rows,
            &self.timings,
            self.compared.clone(),
            &self.moves,
            &self.left_out,
            self.context.records(),
        )
    }

    /// The machine, the commit and the day of the run.
    pub(crate) fn host(&self) -> &Host {
        &self.host
    }

    pub(super) fn note_that_the_baseline_was_written(&mut self) {
        self.compared.written = true;
    }

    /// What the baseline would be after this run.
    pub(crate) fn found(&self) -> &Baseline {
        &self.found
    }

    pub(crate) fn context(&self) -> &Context {
        &self.context
    }
}
