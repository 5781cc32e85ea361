//! Runs the checks of a suite, writes their reports, and compares the result with the baseline; or lists the checks, or
//! solves one toss again. It shows what the library does; it measures and judges nothing itself.

use std::path::Path;

use anyhow::{Context as _, ensure};
use clap::{Args, ValueEnum};
use dynamics::Toss;
use indicatif::{ProgressBar, ProgressStyle};
use toss::{Formulation, StepControl, Stepping};

use super::program::Foreign;
use crate::measure::atlas;
use crate::measure::case;
use crate::measure::reference;
use crate::measure::run::Run;
use crate::render::report::{PROPOSAL, Report, Verdict};
use crate::render::{diagnosis, github, junit, text};
use crate::shown::shown;
use crate::suite::{Progress, Suite, check_named};
use crate::{CHECKS, Check, Context, Effort, Judges, files, judge};

/// Run the checks: one line a check, and in full what fails
///
/// Writes report.html, report.json, junit.xml, summary.md and charts.
///
/// Exit codes: 0 all checks pass; 1 a check fails, or a replayed toss is wrong or without an answer; 2 bad usage; 3
/// accuracy or work is worse than the baseline, though within limits; 4 could not run.
#[derive(Debug, Args)]
pub(super) struct RunArgs {
    /// Take fewer cases: half a minute on two cores, once built
    #[arg(long, conflicts_with = "deep")]
    quick: bool,
    /// Take ten times as many cases
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
    /// Keep what each check measures in the folder of --out, and go on with what an interrupted run of the same program kept
    /// there
    #[arg(long, conflicts_with_all = ["only", "command"])]
    resume: bool,
    /// Print one line a row instead of one a check
    #[arg(long)]
    verbose: bool,
    /// Multiply the time limit of every check, for a slow machine or a slow solver
    #[arg(long, value_name = "FACTOR", value_parser = time_factor)]
    time_factor: Option<f64>,
    /// An error is worse than the baseline above so many times the accepted one [default: 1.25]; 4 allows for another
    /// machine's last digits
    #[arg(long, value_name = "RATIO", value_parser = worse_above)]
    worse_above: Option<f64>,
    /// With --replay: print what this row, given as CHECK / SUBJECT, measures on the toss, and the verdict
    #[arg(long, value_name = "ROW", requires = "replay", value_parser = row)]
    row: Option<RowName>,
    #[command(flatten)]
    foreign: Foreign,
    #[command(flatten)]
    instead: Instead,
}

/// The name of a row: its check and its subject.
#[derive(Debug, Clone)]
struct RowName(&'static Check, String);

/// What is done instead of running the checks.
#[derive(Debug, Args)]
#[group(multiple = false, conflicts_with_all = ["quick", "deep", "only", "bless", "format", "resume", "verbose", "time_factor", "worse_above"])]
struct Instead {
    /// List the checks and what they claim
    #[arg(long, conflicts_with = "command")]
    list: bool,
    /// Solve one toss, given as the text of a worst input, by every solver, scheme and formulation, at its tolerance or step
    /// if it has one; for the solvers of this workspace, take every measure of proofs, batches and margins on it, too
    #[arg(long, value_name = "INPUT", value_parser = input)]
    replay: Option<Box<Replayed>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Junit,
    /// The text, then annotations; the summary is appended to the file that $GITHUB_STEP_SUMMARY names
    Github,
}

/// A toss, and the tolerance or the step of those who fly it.
#[derive(Debug, Clone, Copy)]
struct Replayed(Toss, Option<StepControl>);

fn input(text: &str) -> Result<Box<Replayed>, String> {
    let read = case::read_with_settings(text).map_err(|error| shown(&format!("{error:#}")));
    read.map(|(toss, control)| Box::new(Replayed(toss, control)))
}

fn row(text: &str) -> Result<RowName, String> {
    let (check, subject) = text.split_once(" / ").ok_or("a row is CHECK / SUBJECT")?;
    Ok(RowName(known_check(check)?, subject.to_owned()))
}

fn known_check(id: &str) -> Result<&'static Check, String> {
    check_named(id).map_err(|error| shown(&error.to_string()))
}

fn time_factor(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|factor: &f64| factor.is_finite() && *factor > 0.0);
    factor.ok_or_else(|| "the time factor must be finite and above 0".to_owned())
}

fn worse_above(text: &str) -> Result<f64, String> {
    let ratio = text.parse().ok().filter(|ratio: &f64| ratio.is_finite() && *ratio >= 1.0);
    ratio.ok_or_else(|| "the ratio must be finite and at least 1".to_owned())
}

/// The environment variable with the name of the file into which a step of GitHub Actions writes its summary.
const SUMMARY: &str = "GITHUB_STEP_SUMMARY";

impl RunArgs {
    /// Runs the checks and returns the exit code: 1 if a check fails, 3 if something is worse than the baseline.
    pub(super) fn run(&self, suite: Suite, validation: Option<&Path>, out: &Path) -> anyhow::Result<u8> {
        if self.instead.list {
            return list();
        }
        let suite = self.foreign.in_place_of(suite, validation, out)?;
        if let Some(replayed) = &self.instead.replay {
            let (passes, text) = match &self.row {
                Some(row) => as_row(&suite, replayed, row)?,
                None => by_all(&suite, replayed, self.foreign.is_given())?,
            };
            return files::print(&text).map(|()| u8::from(!passes));
        }
        let suite = self.asked_for(suite);
        let suite = if self.resume { suite.keeping_in(out) } else { suite };
        let mut report = measure(&suite)?;
        // The reports know the baseline that the run has written, and are written even if it could not be.
        let is_accepted = self.bless && report.verdict() != Verdict::Fail;
        let accepted = if is_accepted { suite.accept(&mut report) } else { Ok(()) };
        report.write(out)?;
        self.print(&report, out)?;
        accepted?;
        Ok(report.exit_code())
    }

    /// The suite with the effort and the check that the options ask for.
    fn asked_for(&self, suite: Suite) -> Suite {
        let suite = match (self.quick, self.deep) {
            (true, _) => suite.effort(Effort::Quick),
            (_, true) => suite.effort(Effort::Deep),
            _ => suite,
        };
        let suite = match self.only {
            Some(check) => suite.only(check.id),
            None => suite,
        };
        let suite = match self.time_factor {
            Some(factor) => suite.time_factor(factor),
            None => suite,
        };
        match self.worse_above {
            Some(ratio) => suite.worse_above(ratio),
            None => suite,
        }
    }

    /// Prints the report in the format that was asked for.
    fn print(&self, report: &Report, out: &Path) -> anyhow::Result<()> {
        match self.format.unwrap_or(Format::Text) {
            Format::Text => files::print(&self.text(report, out)),
            Format::Json => files::print(&format!("{}\n", report.json()?)),
            Format::Junit => files::print(&format!("{}\n", junit::xml(report)?)),
            Format::Github => {
                if let Some(path) = std::env::var_os(SUMMARY).filter(|path| !path.is_empty()) {
                    files::append(Path::new(&path), &github::summary(report))?;
                }
                files::print(&format!("{}{}", self.text(report, out), github::annotations(report)))
            }
        }
    }

    fn text(&self, report: &Report, out: &Path) -> String {
        text::whole(report, self.verbose) + &written(report, out)
    }
}

/// Prints the id, the evidence, what is judged and the claim of every check, one line each.
fn list() -> anyhow::Result<u8> {
    let line =
        |check: &Check| format!("{:<36} [{}; {}] {}\n", check.id, check.basis.name(), check.judges.name(), check.claim);
    files::print(&CHECKS.iter().map(line).collect::<String>())?;
    Ok(0)
}

/// Whether a row passes on one toss, and what it measures and allows.
fn as_row(
    suite: &Suite,
    Replayed(toss, control): &Replayed,
    RowName(check, subject): &RowName,
) -> anyhow::Result<(bool, String)> {
    ensure!(control.is_none(), "--row has a tolerance of its own: leave it out of --replay");
    let context = Context::new(suite.registry().entries(), Effort::Quick)?;
    let measured = check.again(&context, toss, &|name| name == subject)?;
    let judged = judge(check, measured, &suite.all_limits()?);
    let id = check.id;
    let of_many = || format!("'{id} / {subject}' measures no deviation of one such toss: --only {id} repeats it");
    let row = judged.first().with_context(of_many)?;
    Ok((row.status.passes(), text::of_row(row)))
}

/// The answers of every solver, scheme and formulation for one toss, side by side. Below come the deviations that the checks
/// of the library measure on that toss, a quantity of several sets once: proofs, batches at every SIMD level, margins. They
/// say nothing about a foreign program. It passes if every solver in its default formulation answers as it should.
fn by_all(suite: &Suite, Replayed(toss, control): &Replayed, is_foreign: bool) -> anyhow::Result<(bool, String)> {
    let context = Context::new(suite.registry().entries(), Effort::Quick)?;
    let (subjects, exact) = (atlas::contestants_at(&context.registry, *control)?, reference::of(toss)?);
    let runs: Vec<Run> = subjects.iter().map(|subject| Run::new(subject, toss, &exact)).collect();
    let by_default = subjects.iter().zip(&runs).filter(|(subject, _)| subject.formulation == Formulation::default());
    let passes = by_default.into_iter().all(|(_, run)| run.passes());
    let mut table = text::runs(&runs);
    if let Some(asked) = suite.program().and_then(|program| program.asked(toss, tolerance(*control), &context.exact)) {
        table += &diagnosis::example(&asked.example());
    }
    for check in CHECKS.iter().filter(|check| check.judges == Judges::Library && !is_foreign) {
        let mut last = None;
        for found in check.again(&context, toss, &|_| true)? {
            if last.replace(found.measured) != Some(found.measured) {
                table += &text::of_library(check, &found);
            }
        }
    }
    Ok((passes, table))
}

/// The tolerance of a program that is replayed.
fn tolerance(control: Option<StepControl>) -> f64 {
    match control {
        Some(StepControl::Tolerance(tolerance)) => tolerance,
        _ => Stepping::DEFAULT_TOLERANCE,
    }
}

/// Runs the checks of `suite`; what has ended is shown on standard error.
fn measure(suite: &Suite) -> anyhow::Result<Report> {
    let style = ProgressStyle::with_template("{spinner} {msg} ({elapsed})")?;
    let progress = ProgressBar::new(0).with_style(style);
    progress.enable_steady_tick(std::time::Duration::from_millis(100));
    let report = suite.run_showing(&|now| match now {
        Progress::Diagnoses => progress.set_message("asking for launches of every kind, to find what is wrong"),
        Progress::Begins(check, number) => {
            progress.inc(1);
            progress.set_message(format!("check {} of {number}: {}", progress.position(), check.id));
        }
        Progress::Ended(rows, timing) => progress.suspend(|| files::say(&text::ended(rows, timing))),
        Progress::Wrong(found) => progress.suspend(|| files::say(&diagnosis::early(found))),
    })?;
    progress.finish_and_clear();
    Ok(report)
}

/// The files that were written, for someone who reads the text.
fn written(report: &Report, out: &Path) -> String {
    let line = |what: &str, file: &str| format!("{what}: {}\n", shown(&out.join(file).display().to_string()));
    let page = line("report", "report.html");
    match report.proposed_limits() {
        Some(_) => page + &line("proposed limits", PROPOSAL),
        None => page,
    }
}
