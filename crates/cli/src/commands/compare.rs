//! `unfair-toss compare` solves one toss by every solver and scheme. It prints how far each is off the exact motion and
//! what it costs, so that a solver can be chosen for a toss at hand.

use std::time::{Duration, Instant};

use serde::Serialize;
use toss::planner::Nanoseconds;
use toss::quantity::Dimension;
use toss::report::{Comparison, candidates};
use toss::{ExactSolver, Formulation, Registry, Solver, SolverConfig, Stepping, Toss};

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs, fixed, table};
use crate::quantity;
use crate::toss_args::TossArgs;
use crate::watch::{BudgetArgs, Watch};

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
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Rows {
    cos_tilt: f64,
    flight_time: f64,
    rows: Vec<Comparison>,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        let toss = self.toss.toss()?;
        let exact = ExactSolver.land(&toss)?;
        let formulation = if self.formulation == "all" { None } else { Some(Formulation::named(&self.formulation)?) };
        let row = |config: &SolverConfig| -> Result<Comparison, Failure> {
            let compared = Comparison::new(registry, config, &toss, &exact)?;
            let answered = compared.failure.is_none();
            let is_measured = answered && !asked.watch.is_over();
            let time_ns =
                is_measured.then(|| self.time_ns(registry, config, &toss, &asked.watch)).transpose()?.flatten();
            Ok(Comparison { time_ns, ..compared })
        };
        let candidates = candidates(registry, self.tolerance, self.step, formulation)?;
        asked.watch.show(Some(candidates.len() as u64), "solvers");
        let goes_on = |_: &&SolverConfig| !asked.watch.is_over();
        let rows = candidates.iter().take_while(goes_on).map(row).inspect(|_| asked.watch.count(1));
        let rows = rows.collect::<Result<_, _>>()?;
        let answer = Rows { cos_tilt: exact.cos_tilt, flight_time: toss.launch.flight_time(), rows };
        Ok(self.format.print(asked, &answer, || text(&answer.rows, self.repeats > 0)))
    }

    /// The median of the time of a flight (ns), if it is to be measured.
    fn time_ns(
        &self,
        registry: &Registry,
        config: &SolverConfig,
        toss: &Toss,
        watch: &Watch,
    ) -> Result<Option<f64>, Failure> {
        let backend = registry.configured(config)?;
        Ok(median_ns(self.repeats, watch, || backend.solver().land(toss).is_ok()))
    }
}

fn cells(row: &Comparison, has_times: bool) -> Vec<String> {
    let or_dash = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
    let mut cells = vec![row.solver.clone(), or_dash(row.scheme.clone()), or_dash(row.formulation.map(str::to_owned))];
    cells.extend([
        or_dash(row.cos_tilt.map(|value| fixed(value, 12))),
        or_dash(row.cos_tilt_error.map(|value| format!("{value:.1e}"))),
        or_dash(row.attitude_error.map(|value| format!("{value:.1e}"))),
        or_dash(row.outcome.map(str::to_owned)),
        or_dash(row.rhs_calls.map(|value| value.to_string())),
        or_dash(row.accepted_steps.map(|value| value.to_string())),
    ]);
    cells.extend(has_times.then(|| or_dash(row.time_ns.map(|time| Nanoseconds(time).to_string()))));
    cells.push(row.failure.as_ref().map_or(String::new(), |failure| failure.message.clone()));
    cells
}

fn text(rows: &[Comparison], has_times: bool) -> String {
    let mut heading =
        vec!["solver", "scheme", "formulation", "cos θ", "error", "attitude/rad", "outcome", "calls", "steps"];
    heading.extend(has_times.then_some("time"));
    let fails = rows.iter().any(|row| row.failure.is_some());
    heading.push(if fails { "why there is no answer" } else { "" });
    let heading = heading.into_iter().map(str::to_owned).collect();
    table(&std::iter::once(heading).chain(rows.iter().map(|row| cells(row, has_times))).collect::<Vec<_>>())
}

/// The median of the time (ns) of a call of `job`, from `repeats` measurements; `None` for 0. A measurement repeats the
/// call until it takes long enough for the clock. Where they take long together, there are fewer.
fn median_ns(repeats: u32, watch: &Watch, job: impl Fn() -> bool) -> Option<f64> {
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
    let goes_on = |done: &u32| !watch.is_over() && (*done == 0 || began.elapsed() < LONG);
    let mut times: Vec<f64> = (0..repeats).take_while(goes_on).map(|_| measured(calls) / f64::from(calls)).collect();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied()
}
