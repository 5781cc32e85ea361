//! `unfair-toss convergence`: the running probability of methods A and B.

use std::path::PathBuf;

use sampling::estimate::LEVEL;
use sampling::{SampleError, running_grid, running_random, wilson};

use crate::args::SolverArgs;
use crate::chart::{self, Step};
use crate::failure::Failure;
use crate::output::{self, DataFormat, progress_bar};
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
    solver: SolverArgs,
    /// Runge-Kutta method of the solver: dop853, dopri5 or rk4
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    scheme: String,
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    pub(crate) format: DataFormat,
    /// Also draw the series into this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Args {
    pub(crate) fn run(&self) -> Result<String, Failure> {
        let space = self.space.space()?;
        let solver = self.solver.solver(&self.scheme)?;
        let points = space.grid_points()?;
        let bar = progress_bar(2 * points, "launches");
        let progress = |more| bar.inc(more);
        let counted: Result<_, SampleError> = self.threads.pool()?.install(|| {
            let grid = running_grid(&space, self.steps, solver.as_ref(), &progress)?;
            Ok((grid, running_random(&space, points, self.seed, self.steps, solver.as_ref(), &progress)?))
        });
        bar.finish_and_clear();
        let (grid, random) = counted?;
        let step = |(grid, random): (&sampling::Counts, &sampling::Counts)| {
            let interval = wilson(random.heads, random.points(), LEVEL);
            Step {
                launches: grid.points(),
                grid: grid.probability(),
                random: random.probability(),
                random_lo: interval.lo,
                random_hi: interval.hi,
            }
        };
        let steps: Vec<Step> = grid.iter().zip(&random).map(step).collect();
        if let Some(path) = &self.svg {
            output::write_file(path, &chart::convergence(&steps)?)?;
        }
        Ok(output::data(self.format, &steps))
    }
}
