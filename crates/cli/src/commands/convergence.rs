//! `unfair-toss convergence` prints the probability of heads after each step of a growing number of launches, for a
//! grid (the paper's method A) and for random launches (method B). With the space `paper-fig4` it reproduces the
//! paper's Fig. 4.

use sampling::{RunningStep, Sampler};

use crate::failure::Failure;
use crate::output::{self, Input, SeriesArgs};
use crate::solver_args::SolverArgs;
use crate::space_args::{SpaceArgs, ThreadArgs};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of equal steps, of which the last one contains the whole grid
    #[arg(long, value_name = "N", default_value_t = 500)]
    steps: u64,
    /// Seed of the random launches, which are as many as the grid has
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
        self.series.validate()?;
        let space = self.space.space()?;
        let backend = self.solver.backend()?;
        let launches = (space.grid_points()?.saturating_mul(2), "launches");
        let ask = |sampler: &Sampler<'_>| sampler.running_shares(&space, self.steps, self.seed);
        let steps = self.threads.ask(backend.sampler(), launches, ask)?;
        self.series.answer(
            |format| output::series(input, format, &steps),
            || Ok(chart::running(&steps.iter().map(RunningStep::columns).collect::<Vec<_>>())?),
        )
    }
}
