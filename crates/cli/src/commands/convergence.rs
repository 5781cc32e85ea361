//! `unfair-toss convergence`: the running probability of methods A and B.

use sampling::{RunningStep, running_shares};

use crate::args::SamplingSolverArgs;
use crate::failure::Failure;
use crate::output::{SeriesArgs, progress_bar};
use crate::space_args::{SpaceArgs, ThreadArgs};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of equal steps; the last one is the whole grid
    #[arg(long, value_name = "N", default_value_t = 500)]
    steps: u64,
    /// Seed of the random launches, of which there are as many as the grid has
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SamplingSolverArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

impl Args {
    pub(crate) fn run(&self) -> Result<String, Failure> {
        let space = self.space.space()?;
        let solver = self.solver.solver()?;
        let points = space.grid_points()?;
        let bar = progress_bar(2 * points, "launches");
        let steps = self
            .threads
            .pool()?
            .install(|| running_shares(&space, self.steps, self.seed, solver.as_ref(), &|more| bar.inc(more)));
        bar.finish_and_clear();
        let steps = steps?;
        self.series.draw(|| Ok(chart::running(&steps.iter().map(RunningStep::columns).collect::<Vec<_>>())?))?;
        Ok(self.series.data(&steps))
    }
}
