//! `unfair-toss limit` compares p(ψ), the limit of the probability of heads for long flights, with the share of heads
//! in a sample of long flights. ψ is the angle between the coin's normal and its angular momentum; the comparison shows
//! that the limit holds.

use sampling::{LongFlightLine, Sampler, listed_cone_angles};
use toss::defaults::{LONG_FLIGHTS, SEED};
use toss::{Error, Registry};

use crate::chart;
use crate::failure::Failure;
use crate::output::{Asked, SeriesArgs};
use crate::quantity;
use crate::solver_args::SolverArgs;
use crate::space_args::ThreadArgs;
use crate::toss_args::CoinArgs;
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    coin: CoinArgs,
    /// Number of flights at each ψ
    #[arg(long, value_name = "N", default_value_t = LONG_FLIGHTS, allow_hyphen_values = true,
          value_parser = quantity::count::<u64>(1..=u64::MAX))]
    points: u64,
    /// Seed of the random speeds
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
        let coin = self.coin.coin()?;
        let backend = self.solver.backend_of_outcomes(registry)?;
        let cone_angles = listed_cone_angles();
        let flights = (self.points.saturating_mul(cone_angles.len() as u64), "flights");
        let ask = |sampler: &Sampler<'_>| sampler.long_flight_shares(coin, &cone_angles, (self.points, self.seed));
        let shares = self.threads.ask(&asked.watch, backend.sampler(), flights, ask)?;
        if shares.is_empty() {
            return Err(Error::Ended.into());
        }
        let lines = LongFlightLine::list(&shares);
        self.series.answer_lines(asked, &lines, || Ok(chart::limit(&shares, &chart::named(&coin.into()))?))
    }
}
