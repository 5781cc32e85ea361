//! `unfair-toss compare` solves one toss by every solver and scheme. It prints how far each is off the exact motion and
//! what it costs, so that a solver can be chosen for a toss at hand.

use std::time::{Duration, Instant};

use serde::Serialize;
use toss::{
    Dimension, ExactSolver, Formulation, InputError, Landing, Nanoseconds, Registry, Scheme, Settings, SolveError,
    Solver, Stepping, Toss,
};

use crate::failure::Failure;
use crate::output::{self, Format, Input, fixed, table};
use crate::quantity;
use crate::toss_args::TossArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    toss: TossArgs,
    /// Local error per step of the schemes that control their step
    #[arg(long, value_name = "TOL", allow_hyphen_values = true, default_value_t = Stepping::DEFAULT_TOLERANCE,
          value_parser = quantity::tolerance)]
    tolerance: f64,
    /// Step of the schemes with a fixed step (s)
    #[arg(long, value_name = "H", allow_hyphen_values = true, default_value_t = Stepping::DEFAULT_STEP,
          value_parser = quantity::of(Dimension::Time))]
    step: f64,
    /// Formulation of the kinematics of the integrators; `all` for every one that a solver has
    #[arg(long, value_name = "NAME|all", default_value = Formulation::default().name())]
    formulation: String,
    /// Number of measurements of the time, of which the median is printed; 0 for no times
    #[arg(long, value_name = "N", default_value_t = 7, allow_hyphen_values = true,
          value_parser = quantity::count::<u32>(0..=1000))]
    repeats: u32,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Answer {
    cos_tilt: f64,
    flight_time: f64,
    rows: Vec<Row>,
}

/// A solver with its settings, and what it answers.
#[derive(Serialize)]
struct Row {
    solver: String,
    scheme: Option<&'static str>,
    formulation: Option<&'static str>,
    cos_tilt: Option<f64>,
    /// |Δ cos θ| from the exact motion.
    cos_tilt_error: Option<f64>,
    /// Angle from the attitude of the exact motion (rad).
    attitude_error: Option<f64>,
    outcome: Option<&'static str>,
    rhs_calls: Option<u64>,
    accepted_steps: Option<u64>,
    rejected_steps: Option<u64>,
    time_ns: Option<f64>,
    /// Why the solver gave no answer.
    failure: Option<FailureOfSolver>,
}

#[derive(Serialize)]
struct FailureOfSolver {
    kind: &'static str,
    message: String,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, input: &Input) -> Result<String, Failure> {
        let toss = self.toss.toss()?;
        let exact = ExactSolver.land(&toss)?;
        let candidates = self.candidates(registry)?;
        let rows = candidates.iter().map(|candidate| self.row(registry, candidate, &toss, &exact));
        let flight_time = toss.launch.flight_time();
        let answer = Answer { cos_tilt: exact.cos_tilt, flight_time, rows: rows.collect::<Result<_, Failure>>()? };
        Ok(match self.format {
            Format::Json => output::json(input, &answer),
            Format::Text => answer.text(self.repeats > 0),
        })
    }

    /// Every solver with each of its schemes and of the wanted formulations.
    fn candidates<'a>(&self, registry: &'a Registry) -> Result<Vec<Candidate<'a>>, InputError> {
        let wanted = if self.formulation == "all" { None } else { Some(Formulation::named(&self.formulation)?) };
        let mut all = Vec::new();
        for entry in registry.entries() {
            if !entry.integrates() {
                all.push(Candidate {
                    solver: entry.name(),
                    scheme: None,
                    formulation: None,
                    settings: Settings::default(),
                });
            }
            for scheme in entry.schemes() {
                let stepping = self.stepping(*scheme)?;
                let one = [Formulation::default()];
                let own = if entry.formulations().is_empty() { &one } else { entry.formulations() };
                // A solver with a single formulation, which has no name, is among those of every one.
                let is_wanted =
                    |own: &&Formulation| entry.formulations().is_empty() || wanted.is_none_or(|wanted| wanted == **own);
                all.extend(own.iter().filter(is_wanted).map(|formulation| Candidate {
                    solver: entry.name(),
                    scheme: Some(scheme.name()),
                    formulation: entry.formulations().contains(formulation).then(|| formulation.name()),
                    settings: Settings { stepping, formulation: *formulation },
                }));
            }
        }
        Ok(all)
    }

    fn stepping(&self, scheme: Scheme) -> Result<Stepping, InputError> {
        match scheme.is_adaptive() {
            true => Stepping::adaptive(scheme, self.tolerance),
            false => Stepping::fixed(scheme, self.step),
        }
    }

    fn row(
        &self,
        registry: &Registry,
        candidate: &Candidate<'_>,
        toss: &Toss,
        exact: &Landing,
    ) -> Result<Row, Failure> {
        let backend = registry.backend(candidate.solver, &candidate.settings)?;
        let mut row = Row::new(candidate);
        let landed = backend.solver().land(toss);
        let answered = landed.and_then(|landing| Ok((landing, backend.verdict(toss, landing.tilt())?)));
        match answered {
            Ok((landing, verdict)) => {
                row.answered(&landing, exact, candidate.solver != ExactSolver::NAME);
                row.outcome = Some(verdict.outcome().name());
                row.time_ns = median_ns(self.repeats, || backend.solver().land(toss).is_ok());
            }
            Err(error) => row.failure = Some(FailureOfSolver::new(&error)),
        }
        Ok(row)
    }
}

/// A solver with its settings.
struct Candidate<'a> {
    solver: &'a str,
    scheme: Option<&'static str>,
    formulation: Option<&'static str>,
    settings: Settings,
}

impl FailureOfSolver {
    fn new(error: &SolveError) -> Self {
        Self { kind: error.kind(), message: error.to_string() }
    }
}

impl Row {
    /// The row of a solver that has not answered yet.
    fn new(candidate: &Candidate<'_>) -> Self {
        Self {
            solver: candidate.solver.to_owned(),
            scheme: candidate.scheme,
            formulation: candidate.formulation,
            cos_tilt: None,
            cos_tilt_error: None,
            attitude_error: None,
            outcome: None,
            rhs_calls: None,
            accepted_steps: None,
            rejected_steps: None,
            time_ns: None,
            failure: None,
        }
    }

    /// Adds where the toss `landed`. The exact motion has no errors here, because they are measured from it, and no work.
    fn answered(&mut self, landed: &Landing, exact: &Landing, is_other: bool) {
        self.cos_tilt = Some(landed.cos_tilt);
        if is_other {
            self.cos_tilt_error = Some((landed.cos_tilt - exact.cos_tilt).abs());
            self.attitude_error = Some(landed.state.attitude.angle_to(&exact.state.attitude));
            self.rhs_calls = Some(landed.work.rhs_calls);
            self.accepted_steps = Some(landed.work.accepted_steps);
            self.rejected_steps = Some(landed.work.rejected_steps);
        }
    }

    fn cells(&self, has_times: bool) -> Vec<String> {
        let or_dash = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
        let mut cells = vec![
            self.solver.clone(),
            or_dash(self.scheme.map(str::to_owned)),
            or_dash(self.formulation.map(str::to_owned)),
        ];
        cells.extend([
            or_dash(self.cos_tilt.map(|value| fixed(value, 12))),
            or_dash(self.cos_tilt_error.map(|value| format!("{value:.1e}"))),
            or_dash(self.attitude_error.map(|value| format!("{value:.1e}"))),
            or_dash(self.outcome.map(str::to_owned)),
            or_dash(self.rhs_calls.map(|value| value.to_string())),
            or_dash(self.accepted_steps.map(|value| value.to_string())),
        ]);
        cells.extend(has_times.then(|| or_dash(self.time_ns.map(|time| Nanoseconds(time).to_string()))));
        cells.push(self.failure.as_ref().map_or(String::new(), |failure| failure.message.clone()));
        cells
    }
}

impl Answer {
    fn text(&self, has_times: bool) -> String {
        let mut heading =
            vec!["solver", "scheme", "formulation", "cos θ", "error", "attitude/rad", "outcome", "calls", "steps"];
        heading.extend(has_times.then_some("time"));
        let fails = self.rows.iter().any(|row| row.failure.is_some());
        heading.push(if fails { "why there is no answer" } else { "" });
        let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
        rows.extend(self.rows.iter().map(|row| row.cells(has_times)));
        table(&rows)
    }
}

/// The median of the time (ns) of a call of `job`, from `repeats` measurements; `None` for 0. A measurement repeats the
/// call until it takes long enough for the clock. Where they take long together, there are fewer.
fn median_ns(repeats: u32, job: impl Fn() -> bool) -> Option<f64> {
    const LONG_ENOUGH_NS: f64 = 2e5;
    const LONG: Duration = Duration::from_millis(500);
    let measured = |calls: u32| {
        let start = Instant::now();
        (0..calls).for_each(|_| _ = std::hint::black_box(job()));
        start.elapsed().as_secs_f64() * 1e9
    };
    let mut calls = 1;
    while repeats > 0 && measured(calls) < LONG_ENOUGH_NS && calls < 1 << 20 {
        calls *= 2;
    }
    let began = Instant::now();
    let goes_on = |done: &u32| *done == 0 || began.elapsed() < LONG;
    let mut times: Vec<f64> = (0..repeats).take_while(goes_on).map(|_| measured(calls) / f64::from(calls)).collect();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied()
}
