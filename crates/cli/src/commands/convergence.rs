//! `unfair-toss convergence` prints the probability of heads after each step of a growing number of launches, for a
//! grid (the paper's method A) and for random launches (method B). With the space `paper-fig4` it reproduces the
//! paper's Fig. 4.

use sampling::{RunningStep, Sampler};
use toss::defaults::{self, SEED};
use toss::{Error, Registry};

use crate::chart;
use crate::failure::Failure;
use crate::output::{Asked, SeriesArgs};
use crate::quantity;
use crate::solver_args::SolverArgs;
use crate::space_args::{SpaceArgs, ThreadArgs};
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of equal steps, of which the last one contains the whole grid [default: 500, or the number of launches if there
    /// are fewer]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(1..=1_000_000))]
    steps: Option<u64>,
    /// Seed of the random launches, which are as many as the grid has
    #[arg(long, value_name = "S", default_value_t = SEED, allow_hyphen_values = true, value_parser = quantity::seed)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        self.series.validate()?;
        let space = self.space.space()?;
        let backend = self.solver.backend_of_outcomes(registry)?;
        let points = space.grid_points()?;
        let steps = self.steps.unwrap_or(defaults::steps(points));
        let ask = |sampler: &Sampler<'_>| sampler.running_shares(&space, steps, self.seed);
        let steps = self.threads.ask(&asked.watch, backend.sampler(), (points.saturating_mul(2), "launches"), ask)?;
        if steps.is_empty() {
            return Err(Error::Ended.into());
        }
        let columns = || steps.iter().filter_map(RunningStep::columns).collect::<Vec<_>>();
        let draw = || Ok(chart::running(&format!(", {}", self.space.words(&space)), &columns())?);
        self.series.answer_lines(asked, &steps, draw)
    }
}
