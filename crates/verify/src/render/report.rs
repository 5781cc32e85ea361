//! The report of a run. It holds all that the renderings show, and answers first: in one sentence, and by what each
//! solver reaches at which cost.

use std::sync::Arc;

use serde::{Serialize, Serializer};
use toss::planner::Nanoseconds;

use super::pattern;
use super::words::{comparison, reserve, worst_first};
use crate::host::Host;
use crate::judge::baseline::{Baseline, Direction, Move};
use crate::judge::time::Timing;
use crate::judge::{LeftOut, Row, limits};
use crate::measure::context::Context;
use crate::measure::diagnosis::Diagnosis;
use crate::measure::effort::Effort;
use crate::measure::work_precision::Sample;
use crate::process::Tally;

/// Version of the layout of report.json, which `docs/report.schema.json` describes.
const SCHEMA: u32 = 10;

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

/// Everything that a run found.
#[derive(Serialize)]
pub struct Report {
    /// Version of this layout.
    pub schema: u32,
    /// Whether every row passes.
    pub passed: bool,
    /// Version of the suite.
    pub version: &'static str,
    /// The day, the commit and the machine.
    pub host: Host,
    /// The effort of the run: how many cases were tried.
    pub effort: Effort,
    /// What the failing rows have in common, what passes, and what became worse, in words.
    pub pattern: String,
    /// The rows.
    pub rows: Vec<Row>,
    /// The time that each check took.
    pub checks: Vec<Timing>,
    /// The baseline with which the run was compared.
    pub baseline: Compared,
    /// What moved against the baseline.
    pub moves: Vec<Move>,
    /// The checks that gave no row, with the reasons.
    pub left_out: Vec<LeftOut>,
    /// What solvers with failing rows most likely do wrong.
    pub diagnoses: Vec<Diagnosis>,
    /// What became of the questions to a program; `None` if no program was asked.
    pub program: Option<Tally>,
    /// The solvers, and the runs behind some of the rows.
    #[serde(rename = "records", serialize_with = "serialized")]
    pub context: Arc<Context>,
}

fn serialized<S: Serializer>(context: &Arc<Context>, to: S) -> Result<S::Ok, S::Error> {
    (**context).serialize(to)
}

/// The baseline with which a run was compared.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Compared {
    /// Its file.
    pub file: String,
    /// Whether there was one. Without it nothing is compared, so that nothing can be worse.
    pub found: bool,
    /// Whether the run wrote it.
    pub written: bool,
}

impl Compared {
    /// How many rows `moves` shows to have become worse, better, new or gone, and what was done about them.
    pub fn words(&self, moves: &[Move]) -> String {
        let Self { file, found, written } = self;
        let count = |direction| moves.iter().filter(|moved| moved.direction == direction).count();
        let [worse, better, new, gone] =
            [Direction::Worse, Direction::Better, Direction::New, Direction::Gone].map(count);
        match (found, written) {
            (false, false) => {
                format!("There is no baseline yet at {file}, so nothing was compared; --bless begins one.")
            }
            (false, true) => format!("This run began the baseline {file}."),
            (true, false) => {
                format!("Compared with the baseline {file}: {worse} worse, {better} better, {new} new, {gone} gone.")
            }
            (true, true) => format!(
                "Compared with the baseline {file}, and written into it: {better} better and {new} new were taken over, \
                 {gone} gone were dropped, {worse} worse were not taken."
            ),
        }
    }
}

/// What one solver reaches on a problem, and at which cost, per launch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reached {
    pub(super) subject: String,
    /// Its run with the smallest error.
    pub(super) finest: Cost,
    /// What an error of [`ENOUGH`] costs: between its runs to either side of it, or by its cheapest run within; `None` if
    /// there is none within.
    pub(super) enough: Option<Cost>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    /// The largest error of the attitude over the launches (rad).
    pub(super) error: f64,
    /// Calls of the right-hand side; 0 for a closed form.
    pub(super) calls: f64,
    /// Time (µs).
    pub(super) microseconds: f64,
}

/// An error of the attitude (rad) that is enough for most purposes.
pub(super) const ENOUGH: f64 = 1e-9;

/// The problem of which a report says what each solver reaches, if it was flown: launches like those of a hand.
const ORDINARY: &str = "ensemble";

impl Report {
    /// The report of the `rows` of `context`, today on this machine, whose checks took the times of `checks`.
    pub fn new(
        context: Arc<Context>,
        rows: Vec<Row>,
        checks: Vec<Timing>,
        baseline: Compared,
        moves: Vec<Move>,
        left_out: Vec<LeftOut>,
    ) -> Self {
        Self {
            schema: SCHEMA,
            passed: rows.iter().all(|row| row.status.passes()),
            version: env!("CARGO_PKG_VERSION"),
            host: Host::here(),
            effort: context.effort,
            pattern: [pattern::of_rows(&rows), pattern::of_moves(&moves, &rows)].join(" ").trim_end().to_owned(),
            rows,
            checks,
            baseline,
            moves,
            left_out,
            diagnoses: Vec::new(),
            program: None,
            context,
        }
    }

    /// The same report with what solvers most likely do wrong, and what became of the questions to a program.
    #[must_use]
    pub fn with_diagnoses(self, diagnoses: Vec<Diagnosis>, program: Option<Tally>) -> Self {
        Self { diagnoses, program, ..self }
    }

    /// The verdict on the whole run.
    pub fn verdict(&self) -> Verdict {
        match (self.passed, self.worse().is_empty()) {
            (true, true) => Verdict::Pass,
            (true, false) => Verdict::Worse,
            (false, _) => Verdict::Fail,
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
    /// two digits. `None` if every row that passes has a limit.
    pub fn proposed_limits(&self) -> Option<String> {
        limits::proposed(&self.rows, &format!("a {} run on {}", self.effort.name(), self.host.date))
    }

    /// What the baseline would be after this run.
    pub(crate) fn found(&self) -> Baseline {
        Baseline::of(&self.rows, self.context.sweep.found())
    }

    /// The report as JSON.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)?)
    }

    /// The verdict in one sentence: how many rows pass, or which of them fails by most.
    pub(super) fn sentence(&self) -> String {
        let failing = self.failing();
        let all = self.rows.len();
        let Some(worst) = failing.first() else {
            return match self.worse().len() {
                0 => self.pattern.clone(),
                worse => format!("All {all} rows are within their limits, but {worse} became worse than the baseline."),
            };
        };
        let number = failing.len();
        let by = match worst.measured {
            Some(_) => format!("{} ({})", comparison(worst), reserve(worst)),
            None => worst.failure.clone().unwrap_or_else(|| reserve(worst)),
        };
        let (are, it_is) = if number == 1 { ("fails", "it is") } else { ("fail", "the worst is") };
        format!("{number} of {all} rows {are}: {it_is} {} under {}, {by}.", worst.subject, worst.check)
    }

    /// The rows that fail, the worst first.
    pub(super) fn failing(&self) -> Vec<&Row> {
        let mut failing: Vec<&Row> = self.rows.iter().filter(|row| !row.status.passes()).collect();
        failing.sort_by(|a, b| worst_first(a, b));
        failing
    }

    pub(super) fn worse(&self) -> Vec<&Move> {
        self.moves.iter().filter(|moved| moved.direction == Direction::Worse).collect()
    }

    /// When, where, of what and how long, as names and values.
    pub(super) fn facts(&self) -> Vec<(&'static str, String)> {
        let Host { date, commit, rustc, target, cpu, cores, .. } = &self.host;
        let changed = if commit.ends_with('+') { " with changes" } else { "" };
        let seconds: f64 = self.checks.iter().map(|timing| timing.t_wall_s).sum();
        let rustc = rustc.split(" (").next().unwrap_or(rustc);
        vec![
            ("date", date.clone()),
            ("commit", commit.trim_end_matches('+').chars().take(12).collect::<String>() + changed),
            ("version", self.version.to_owned()),
            ("machine", format!("{cpu}, {cores} cores, {target}, {rustc}")),
            ("effort", self.effort.name().to_owned()),
            ("time", format!("{seconds:.0} s for {} checks", self.checks.len())),
        ]
    }

    /// The problem, with its number of launches, of which [`reached`](Self::reached) speaks.
    pub(super) fn ordinary(&self) -> Option<(&str, usize)> {
        let problems = &self.context.sweep.found()?.problems;
        let found = problems.iter().find(|(name, ..)| name == ORDINARY).or(problems.first())?;
        Some((&found.0, found.2))
    }

    /// What each solver reaches at which cost, the most accurate first.
    pub(super) fn reached(&self) -> Vec<Reached> {
        let (Some(sweep), Some((problem, launches))) = (self.context.sweep.found(), self.ordinary()) else {
            return Vec::new();
        };
        let launches = launches.max(1) as f64;
        let reached = |subject: String| {
            let cost = |sample: &Sample| {
                let microseconds = sample.t_min_ns as f64 * 1e-3 / launches;
                Some(Cost { error: sample.err_attitude_rad?, calls: sample.n_rhs as f64 / launches, microseconds })
            };
            let runs: Vec<Cost> = sweep.series(problem, &subject).filter_map(cost).collect();
            let finest = *runs.iter().min_by(|a, b| a.error.total_cmp(&b.error))?;
            Some(Reached { subject, finest, enough: enough(&runs) })
        };
        let mut all: Vec<Reached> = sweep.subjects().into_iter().filter_map(reached).collect();
        all.sort_by(|a, b| a.finest.error.total_cmp(&b.finest.error));
        all
    }
}

/// What an error of [`ENOUGH`] costs by these runs.
fn enough(runs: &[Cost]) -> Option<Cost> {
    let (within, beyond): (Vec<&Cost>, Vec<&Cost>) = runs.iter().partition(|run| run.error <= ENOUGH);
    let fine = within.into_iter().min_by(|a, b| a.microseconds.total_cmp(&b.microseconds))?;
    let coarse = beyond.into_iter().min_by(|a, b| a.error.total_cmp(&b.error));
    // On a scale of powers, as the chart is. A run may be exact.
    let part = |coarse: &Cost| (coarse.error / ENOUGH).ln() / (coarse.error / fine.error.max(f64::MIN_POSITIVE)).ln();
    let cheaper = coarse.filter(|coarse| coarse.calls <= fine.calls && coarse.microseconds <= fine.microseconds);
    Some(cheaper.map_or(*fine, |coarse| {
        let part = part(coarse);
        let between = |coarse: f64, fine: f64| coarse.powf(1.0 - part) * fine.powf(part);
        Cost {
            error: ENOUGH,
            calls: between(coarse.calls, fine.calls),
            microseconds: between(coarse.microseconds, fine.microseconds),
        }
    }))
}

impl Cost {
    /// Error, calls and time in few characters.
    pub(super) fn words(self) -> [String; 3] {
        let calls = if self.calls > 0.0 { format!("{:.0}", self.calls) } else { "–".to_owned() };
        let time = Nanoseconds(1e3 * self.microseconds).to_string();
        [format!("{:.1e} rad", self.error), calls, time]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs at tolerances that are far apart would else make two solvers of one cost differ by what a step between them costs.
    #[test]
    fn the_cost_of_an_error_is_that_between_two_runs() {
        let run = |error, calls| Cost { error, calls, microseconds: 2.0 * calls };
        let cost = |runs: &[Cost]| enough(runs).map(|cost| (cost.calls * 1e6).round() / 1e6);
        assert_eq!(cost(&[run(1e-5, 50.0), run(1e-7, 100.0), run(1e-11, 400.0)]), Some(200.0));
        assert_eq!(cost(&[run(1e-7, 100.0), run(1e-9, 150.0), run(1e-11, 400.0)]), Some(150.0));
        assert_eq!(cost(&[run(1e-11, 400.0), run(1e-12, 500.0)]), Some(400.0));
        // An error that does not fall with the cost has nothing between.
        assert_eq!(cost(&[run(1e-7, 500.0), run(1e-11, 400.0)]), Some(400.0));
        assert_eq!(cost(&[run(1e-7, 0.0), run(0.0, 0.0)]), Some(0.0));
        assert_eq!(cost(&[run(1e-7, 100.0)]), None);
    }
}
