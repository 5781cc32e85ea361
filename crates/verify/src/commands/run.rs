//! `verify run` runs the checks, writes their reports, and compares the result with the baseline. It connects
//! measuring, judging and rendering, which are separate modules.

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use toss::Registry;
use verify::judge::baseline::{Baseline, Direction};
use verify::judge::bounds::Bounds;
use verify::judge::{record, unused_bounds};
use verify::render::charts::{self, Chart};
use verify::render::{Report, html, junit, moves, table};
use verify::{CHECKS, Check, Context, Effort, Row, files, host::Host, judge};

use super::{Folders, fit};

/// Run the checks; write report.html, report.json, junit.xml and charts
#[derive(Debug, Args)]
pub(super) struct Run {
    /// Fewer cases: within a minute on two cores
    #[arg(long, conflicts_with = "deep")]
    quick: bool,
    /// Ten times as many cases
    #[arg(long)]
    deep: bool,
    /// Run this check alone
    #[arg(long, value_name = "ID", value_parser = known_check)]
    only: Option<&'static Check>,
    /// Take what is better or new into the baseline, and write a dated record; what is worse is not taken
    #[arg(long, conflicts_with = "only")]
    bless: bool,
    /// What goes to standard output; text without it
    #[arg(long, value_enum, conflicts_with = "verbose")]
    format: Option<Format>,
    /// Print one line a row instead of one a check
    #[arg(long)]
    verbose: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Junit,
}

fn known_check(id: &str) -> Result<&'static Check, String> {
    let known = || CHECKS.iter().map(|check| check.id).collect::<Vec<_>>().join(", ");
    CHECKS.iter().find(|check| check.id == id).ok_or_else(|| format!("no such check; known: {}", known()))
}

impl Run {
    /// Runs the checks and returns the exit code: 1 if a check fails, 3 if something is worse than the baseline.
    pub(super) fn run(&self, folders: &Folders) -> anyhow::Result<u8> {
        let effort = self.effort();
        let bounds = Bounds::read(&folders.validation.join("bounds.toml"))?;
        let context = Context::new(Registry::standard().entries(), effort, &folders.validation)?;
        let rows = self.measure(&context, &bounds)?;
        anyhow::ensure!(!rows.is_empty(), "no check measured anything");
        let baseline_path = folders.validation.join("baseline").join(format!("{}.csv", effort.name()));
        let (baseline, found) = (Baseline::read(&baseline_path)?, Baseline::of(&rows, context.records().sweep));
        let moves = baseline.moves(&found, self.only.is_none());
        let report = Report::new(effort, &rows, &moves, context.records());
        self.write(&report, folders)?;
        if !report.passed {
            return Ok(1);
        }
        if self.bless {
            files::write(&baseline_path, &baseline.ratcheted(&found).csv()?)?;
            if let Some(sweep) = context.records().sweep.filter(|_| effort == Effort::Standard) {
                record::write(&folders.validation.join("record"), &Host::here(), &found, sweep)?;
                fit::fit()?;
            }
        }
        Ok(if moves.iter().any(|moved| moved.direction == Direction::Worse) { 3 } else { 0 })
    }

    fn effort(&self) -> Effort {
        match (self.quick, self.deep) {
            (true, _) => Effort::Quick,
            (_, true) => Effort::Deep,
            _ => Effort::Standard,
        }
    }

    fn measure(&self, context: &Context, bounds: &Bounds) -> anyhow::Result<Vec<Row>> {
        let asked = |check: &&Check| self.only.is_none_or(|only| only.id == check.id);
        let checks: Vec<&Check> = CHECKS.iter().filter(asked).collect();
        let style = ProgressStyle::with_template("{spinner} check {pos} of {len}: {msg} ({elapsed})")?;
        let progress = ProgressBar::new(checks.len() as u64).with_style(style);
        progress.enable_steady_tick(std::time::Duration::from_millis(100));
        let show = |text: String| progress.suspend(|| self.print(&text));
        show(table::heading())?;
        let mut rows = Vec::new();
        for check in checks {
            progress.inc(1);
            progress.set_message(check.id);
            let judged = judge(check, (check.measure)(context)?, bounds);
            show(table::check(&judged, self.verbose))?;
            rows.extend(judged);
        }
        progress.finish_and_clear();
        if self.only.is_none() {
            let unused = unused_bounds(&rows, bounds);
            show(table::check(&unused, self.verbose))?;
            rows.extend(unused);
        }
        Ok(rows)
    }

    /// Writes the reports into files, and one of them, chosen by the format, to standard output.
    fn write(&self, report: &Report<'_>, folders: &Folders) -> anyhow::Result<()> {
        let (json, junit) = (report.json()?, junit::xml(report.rows)?);
        let charts = charts::charts(&report.records, Registry::standard().entries())?;
        let page = folders.out.join("report.html");
        files::write(&folders.out.join("report.json"), &json)?;
        files::write(&folders.out.join("junit.xml"), &junit)?;
        files::write(&page, &html::page(report, &charts))?;
        for Chart { file, svg, .. } in &charts {
            files::write(&folders.out.join(file), svg)?;
        }
        match self.format() {
            Format::Text => {
                let moved = moves::text(report.moves, report.rows);
                files::print(&format!("{}{moved}\nreport: {}\n", table::verdict(report.rows), page.display()))
            }
            Format::Json => files::print(&format!("{json}\n")),
            Format::Junit => files::print(&format!("{junit}\n")),
        }
    }

    fn format(&self) -> Format {
        self.format.unwrap_or(Format::Text)
    }

    /// Prints `text` if the table for people is what was asked for.
    fn print(&self, text: &str) -> anyhow::Result<()> {
        if self.format() == Format::Text { files::print(text) } else { Ok(()) }
    }
}
