//! A suite puts the solvers of a registry under all checks. It is a value with a builder, so that a crate elsewhere can
//! judge its own solver, with limits, baseline and records in its own repository.
//!
//! ```no_run
//! use toss::{ExactSolver, Registry, SolverEntry};
//! use verify::{Effort, Suite, Verdict};
//!
//! // Your own solver takes the place of this one.
//! let mine = SolverEntry::new("mine", "the exact motion again", |_| Box::new(ExactSolver));
//! let suite = Suite::new(Registry::standard().with(mine)?).effort(Effort::Quick);
//! let report = suite.run()?;
//! report.write("target/verify".as_ref())?;
//! assert_eq!(report.verdict(), Verdict::Pass, "{} rows", report.rows.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod selection;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, ensure};
use toss::Registry;

use crate::Row;
use crate::files;
use crate::judge::baseline::{self, Baseline, ERROR_RATIO};
use crate::judge::kept::Kept;
use crate::judge::limits::Limits;
use crate::judge::time::Timing;
use crate::judge::{Judge, LeftOut, record, require_distinct, unused_limits};
use crate::measure::check::{Check, Judges};
use crate::measure::context::Context;
use crate::measure::diagnosis::{self, Diagnosis};
use crate::measure::effort::Effort;
use crate::measure::replay::Commands;
use crate::process::Running;
use crate::render::report::{Compared, Report, Verdict};
use crate::shown::shown;
use crate::watch::{self, End};

pub(crate) use selection::named as check_named;

/// Where a suite reads its limits and its baseline, unless it says otherwise.
const FOLDER: &str = "validation";

/// The solvers of a registry, and how they are verified.
#[derive(Debug, Clone)]
pub struct Suite {
    registry: Registry,
    effort: Effort,
    only: Option<String>,
    limits: Option<Limits>,
    folder: PathBuf,
    commands: Commands,
    of_the_library: bool,
    time_factor: f64,
    error_ratio: f64,
    keeps_in: Option<PathBuf>,
    program: Option<Running>,
}

/// What a run tells while it goes on.
pub(crate) enum Progress<'a> {
    /// A solver is asked for launches, to find what is wrong with it.
    Diagnoses,
    /// A check begins; there are so many in all.
    Begins(&'a Check, usize),
    /// A check has ended with these rows, and took this time.
    Ended(&'a [Row], &'a Timing),
    /// The program is wrong, before any check.
    Wrong(&'a Diagnosis),
}

impl Suite {
    /// A suite for the solvers of `registry`, under the checks that judge solvers.
    ///
    /// Solvers of this workspace that are among them are judged by the limits of this workspace. Any other solver is
    /// judged by the limits in `validation/limits.toml`, relative to the folder in which the program runs, and where
    /// there are none by its own error estimate.
    pub fn new(registry: Registry) -> Self {
        Self {
            registry,
            effort: Effort::Standard,
            only: None,
            limits: None,
            folder: FOLDER.into(),
            commands: Commands::of_this_program(),
            of_the_library: false,
            time_factor: 1.0,
            error_ratio: ERROR_RATIO,
            keeps_in: None,
            program: None,
        }
    }

    /// The suite of this workspace: its own solvers and its library, under all checks.
    pub fn standard() -> Self {
        Self { commands: Commands::of_this_workspace(), ..Self::new(Registry::standard().clone()) }
            .with_library_checks()
    }

    /// The same suite with `limits` in place of those in its folder.
    #[must_use]
    pub fn limits(self, limits: Limits) -> Self {
        Self { limits: Some(limits), ..self }
    }

    /// The same suite with this number of cases.
    #[must_use]
    pub fn effort(self, effort: Effort) -> Self {
        Self { effort, ..self }
    }

    /// The same suite with this check alone, also if it judges the library.
    #[must_use]
    pub fn only(self, id: &str) -> Self {
        Self { only: Some(id.to_owned()), ..self }
    }

    /// The same suite with its limits, baseline and records in this folder.
    #[must_use]
    pub fn folder(self, folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into(), ..self }
    }

    /// The same suite, whose program is started by `command`, such as `cargo run --release --`. The rows' commands begin
    /// with it. Without it the place of the program's file tells.
    #[must_use]
    pub fn command(self, command: &str) -> Self {
        Self { commands: Commands::of(command), ..self }
    }

    /// The same suite with the checks that judge this library: its exact motion, proofs, batches, sampling methods and
    /// planner.
    #[must_use]
    pub fn with_library_checks(self) -> Self {
        Self { of_the_library: true, ..self }
    }

    /// The same suite with the time limits of all checks multiplied by `factor`, for a slow machine or a slow solver.
    /// Where it is not finite and above 0, [`run`](Self::run) says so.
    #[must_use]
    pub fn time_factor(self, factor: f64) -> Self {
        Self { time_factor: factor, ..self }
    }

    /// The same suite, in which an error is worse than the baseline above `ratio` times the accepted one, instead of 1.25:
    /// for machines that share a baseline although their sine and cosine round differently. Where it is not finite and at
    /// least 1, [`run`](Self::run) says so.
    #[must_use]
    pub fn worse_above(self, ratio: f64) -> Self {
        Self { error_ratio: ratio, ..self }
    }

    /// The same suite, which keeps what each check has measured inside `folder`, and goes on with what an interrupted run of
    /// the same program has kept there.
    #[must_use]
    pub fn keeping_in(self, folder: impl Into<PathBuf>) -> Self {
        Self { keeps_in: Some(folder.into()), ..self }
    }

    /// The solvers.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// The folder with limits, baseline and records.
    pub fn data(&self) -> &Path {
        &self.folder
    }

    /// The same suite, whose rows are repeated by these commands.
    pub(crate) fn repeated_by(self, commands: Commands) -> Self {
        Self { commands, ..self }
    }

    /// A suite for a program, which is asked for more than its landings if it fails.
    pub(crate) fn of_program(program: Running) -> anyhow::Result<Self> {
        let registry = Registry::empty().with(program.entry())?;
        Ok(Self { program: Some(program), ..Self::new(registry) })
    }

    /// The program that it judges, if it judges one.
    pub(crate) fn program(&self) -> Option<&Running> {
        self.program.as_ref()
    }

    pub(crate) fn commands(&self) -> &Commands {
        &self.commands
    }

    /// Runs the checks, judges every row, and compares them with the baseline.
    ///
    /// # Errors
    /// If a check of [`only`](Self::only) is unknown, the limits or the baseline can't be read, or no check measures
    /// anything. A solver that fails or panics, and a check that never ends, are no errors but rows that fail.
    pub fn run(&self) -> anyhow::Result<Report> {
        self.run_showing(&|_| {})
    }

    /// The same, and calls `show` as the run goes on.
    pub(crate) fn run_showing(&self, show: &dyn Fn(Progress<'_>)) -> anyhow::Result<Report> {
        ensure!(
            self.time_factor.is_finite() && self.time_factor > 0.0,
            "time_factor = {}: must be finite and above 0",
            self.time_factor
        );
        let ratio = self.error_ratio;
        ensure!(ratio.is_finite() && ratio >= 1.0, "worse_above = {ratio}: must be finite and at least 1");
        let (limits, path) = (self.all_limits()?, self.baseline_path());
        let baseline = Baseline::read(&path)?.map(|baseline| baseline.worse_above(ratio));
        let context = Arc::new(Context::new(self.registry.entries(), self.effort)?);
        let (checks, mut left_out) = self.checks()?;
        let early = self.wrong_program(&context, show)?;
        early.iter().for_each(|found| show(Progress::Wrong(found)));
        let is_explained = early.as_ref().is_some_and(|found| found.explains_all);
        let (mut rows, timings) = self.measure(&checks, &context, &limits, is_explained, show)?;
        let is_complete = self.only.is_none() && timings.len() == checks.len();
        let unused = match is_complete {
            true => unused_limits(&rows, &limits, |check, subject| self.measures(&checks, check, subject)),
            false => Vec::new(),
        };
        if !self.of_the_library && self.only.is_none() {
            rows.retain(|row| row.judges != Some(Judges::Library));
        }
        let ended = |check: &&&Check| timings.iter().any(|timing| timing.check == check.id);
        let without_rows = |check: &&&Check| !rows.iter().any(|row| row.check == check.id);
        let why = "as the registry has no solver, or no pair of solvers, that they measure";
        left_out.extend(checks.iter().filter(ended).filter(without_rows).map(|check| LeftOut { check: check.id, why }));
        if is_explained {
            let why = "as the likeliest cause explains every answer";
            left_out.extend(checks.iter().filter(|check| !ended(check)).map(|check| LeftOut { check: check.id, why }));
        }
        rows.extend(unused);
        ensure!(!rows.is_empty(), "no check measured anything");
        require_distinct(&rows)?;
        let found = Baseline::of(&rows, context.sweep.found());
        let moves = baseline.as_ref().map_or_else(Vec::new, |baseline| baseline.moves_to(&found, &rows, is_complete));
        let compared = Compared { file: shown(&path.display().to_string()), found: baseline.is_some(), written: false };
        // A solver that never ended a check would not end a diagnosis, either.
        let has_ended = timings.len() == checks.len() || early.is_some();
        let diagnoses = if has_ended { self.diagnoses(&context, &rows, early, show)? } else { Vec::new() };
        let asked = self.program().map(Running::tally);
        Ok(Report::new(context, rows, timings, compared, moves, left_out).with_diagnoses(diagnoses, asked))
    }

    /// What the program most likely does wrong, if a few launches show that it is wrong: one that is slow would else be told
    /// after minutes.
    fn wrong_program(&self, context: &Context, show: &dyn Fn(Progress<'_>)) -> anyhow::Result<Option<Diagnosis>> {
        let (Some(program), Some(subject)) = (&self.program, context.subjects.first()) else { return Ok(None) };
        show(Progress::Diagnoses);
        let found = diagnosis::of_some(&subject.name, &|toss, by| program.asked(toss, by, &context.exact))?;
        if found.as_ref().is_none_or(|found| found.explains_all) {
            return Ok(found);
        }
        // One that hangs would else be given up before it is known where.
        let is_silent = found.as_ref().is_some_and(|found| found.without_answer > 0);
        let program = if is_silent { program.impatient() } else { program.clone() };
        Ok(diagnosis::of_solver(&subject.name, &|toss, by| program.asked(toss, by, &context.exact))?.or(found))
    }

    /// What solvers with failing rows most likely do wrong. Of a program that was known to be wrong `early`, it is that.
    fn diagnoses(
        &self,
        context: &Context,
        rows: &[Row],
        early: Option<Diagnosis>,
        show: &dyn Fn(Progress<'_>),
    ) -> anyhow::Result<Vec<Diagnosis>> {
        let fails = |subject: &str| {
            let is_of = |row: &&Row| row.subject == subject && row.judges == Some(Judges::Solver);
            rows.iter().filter(is_of).any(|row| !row.status.passes())
        };
        if !context.subjects.iter().any(|subject| fails(&subject.name)) {
            return Ok(Vec::new());
        }
        show(Progress::Diagnoses);
        if let (Some(program), Some(subject)) = (&self.program, context.subjects.first()) {
            let program = if program.is_given_up() { program.impatient() } else { program.clone() };
            let found = match early {
                None => diagnosis::of_solver(&subject.name, &|toss, by| program.asked(toss, by, &context.exact))?,
                early => early,
            };
            return Ok(found.into_iter().collect());
        }
        let of_entries = context.registry.iter().map(|entry| diagnosis::of_entry(entry, &fails, &context.exact));
        Ok(of_entries.collect::<anyhow::Result<Vec<_>>>()?.concat())
    }

    /// Runs the checks. If the cause of what fails is known and explains all, the first that fails ends the run.
    fn measure(
        &self,
        checks: &[&'static Check],
        context: &Arc<Context>,
        limits: &Limits,
        is_explained: bool,
        show: &dyn Fn(Progress<'_>),
    ) -> anyhow::Result<(Vec<Row>, Vec<Timing>)> {
        let judge = Judge { limits, commands: &self.commands, effort: context.effort };
        let kept = self.keeps_in.as_ref().map(|folder| Kept::new(folder, self.effort)).transpose()?;
        let mut ended = Vec::new();
        let start = |check: &Check| show(Progress::Begins(check, checks.len()));
        let mut end = |check: &Check, timing: Timing, end: End| {
            let rows = end.rows(check, &timing, judge);
            show(Progress::Ended(&rows, &timing));
            let is_last = is_explained && rows.iter().any(|row| !row.status.passes());
            ended.push((rows, timing));
            if is_last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut to_run = Vec::new();
        for check in checks {
            match kept.as_ref().map(|kept| kept.of(check.id)).transpose()?.flatten() {
                Some((timing, measured)) => {
                    start(check);
                    // A run of a program keeps nothing, so that only other solvers come here.
                    let _ = end(check, timing, End::Measured(measured));
                }
                None => to_run.push(*check),
            }
        }
        let mut records = context.records();
        watch::run(&to_run, context, self.time_factor, start, |check, timing, found| {
            // What the reports show beside rows is not kept: its check makes it again.
            let makes_records = std::mem::replace(&mut records, context.records()) != records;
            if let (Some(kept), End::Measured(measured), false) = (&kept, &found, makes_records) {
                kept.keep(check.id, &timing, measured)?;
            }
            Ok(end(check, timing, found))
        })?;
        let place = |timing: &Timing| checks.iter().position(|check| check.id == timing.check);
        ended.sort_by_key(|(_, timing)| place(timing));
        let (rows, timings): (Vec<_>, Vec<_>) = ended.into_iter().unzip();
        Ok((rows.concat(), timings))
    }

    /// Takes what is better or new than the baseline into it, and after a run of standard effort writes a dated record.
    /// What is worse is not taken. The report of the run says so from then on.
    ///
    /// # Errors
    /// If a file can't be written, a row fails, or only one check was run.
    pub fn accept(&self, report: &mut Report) -> anyhow::Result<()> {
        ensure!(self.only.is_none(), "a run of one check is not accepted into the baseline");
        ensure!(report.verdict() != Verdict::Fail, "a run that fails is not accepted into the baseline");
        let path = self.baseline_path();
        let accepted = Baseline::read(&path)?.unwrap_or_default().worse_above(self.error_ratio);
        files::write(&path, &accepted.ratcheted(&report.found()).csv()?)?;
        report.baseline.written = true;
        if let Some(sweep) = report.context.sweep.found().filter(|_| self.effort == Effort::Standard) {
            record::write(&self.folder.join("record"), &report.host, &report.found(), sweep)?;
        }
        Ok(())
    }

    fn baseline_path(&self) -> PathBuf {
        baseline::file(&self.folder.join("baseline"), self.effort)
    }

    /// Its own limits and, for what these leave open, those of this workspace.
    pub(crate) fn all_limits(&self) -> anyhow::Result<Limits> {
        let own = match &self.limits {
            Some(limits) => limits.clone(),
            None => Limits::read_if_any(&self.folder.join("limits.toml"))?,
        };
        Ok(own.over(Limits::of_this_workspace().context("in the limits of this workspace")?))
    }
}
