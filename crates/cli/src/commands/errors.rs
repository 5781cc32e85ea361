//! `unfair-toss errors` measures the error of every sampling method for a range of numbers of launches. It shows which
//! method reaches a wanted accuracy with the fewest launches.

use sampling::{MethodErrors, Sampler};
use toss::defaults::{REPLICATES, UP_TO};

use crate::chart;
use crate::failure::Failure;
use crate::output::{Asked, SeriesArgs};
use crate::quantity;
use crate::space_args::{SpaceArgs, ThreadArgs};
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of seeds over which the root mean square error is taken
    #[arg(long, value_name = "N", default_value_t = REPLICATES, allow_hyphen_values = true,
          value_parser = quantity::count::<u64>(1..=10_000))]
    replicates: u64,
    /// The largest number of launches is 2^EXPONENT
    #[arg(long, value_name = "EXPONENT", default_value_t = UP_TO, allow_hyphen_values = true,
          value_parser = quantity::count::<u32>(8..=24))]
    up_to: u32,
    /// The probability that is taken as true [default: exact-speed with 64 times the largest number of launches]
    #[arg(long, value_name = "P", allow_hyphen_values = true, value_parser = probability)]
    reference: Option<f64>,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

fn probability(text: &str) -> Result<f64, String> {
    let number = quantity::fraction(text)?;
    let is_valid = (0.0..=1.0).contains(&number);
    is_valid.then_some(number).ok_or_else(|| "expected a probability from 0 to 1, or from 0% to 100%".to_owned())
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        self.series.validate()?;
        let space = self.space.space()?;
        // Every number of launches has a grid of its own.
        self.space.require_grid_where_points_are(&space, |_| false)?;
        let Self { replicates, up_to, reference, .. } = *self;
        let wanted = MethodErrors { replicates, up_to, reference };
        let ask = |sampler: &Sampler<'_>| wanted.measure(sampler, &space);
        let found = self.threads.ask(&asked.watch, Sampler::exact(), (wanted.launches(), "launches"), ask)?;
        self.series.answer_lines(asked, &found.lines, || Ok(chart::errors(&found, &self.space.words(&space))?))
    }
}
