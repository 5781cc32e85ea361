//! `unfair-toss limit` compares p(ψ), the limit of the probability of heads for long flights, with the share of heads
//! in a sample of long flights. ψ is the angle between the coin's normal and its angular momentum; the comparison shows
//! that the limit holds.

use sampling::{LongFlightShare, Sampler};
use serde::Serialize;
use toss::defaults::SEED;
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
    #[arg(long, value_name = "N", default_value_t = 1000, allow_hyphen_values = true,
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

/// One line: ψ (rad), p(ψ), the number of flights, the share of heads among them, the 95 % interval of the share, and the
/// number of undecided flights if any of the series is undecided.
#[derive(Serialize)]
struct Line {
    cone_angle: f64,
    limit: f64,
    launches: u64,
    share: Option<f64>,
    share_lo: Option<f64>,
    share_hi: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    undecided: Option<u64>,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        self.series.validate()?;
        let coin = self.coin.coin()?;
        let backend = self.solver.backend_of_outcomes(registry)?;
        // 30° to 90° in steps of 2.5°; beyond 90° the curve is the mirror image.
        let cone_angles: Vec<f64> = (12..=36).map(|step| (2.5 * f64::from(step)).to_radians()).collect();
        let flights = (self.points.saturating_mul(cone_angles.len() as u64), "flights");
        let ask = |sampler: &Sampler<'_>| sampler.long_flight_shares(coin, &cone_angles, (self.points, self.seed));
        let shares = self.threads.ask(&asked.watch, backend.sampler(), flights, ask)?;
        if shares.is_empty() {
            return Err(Error::Ended.into());
        }
        let is_undecided = shares.iter().any(|found| found.estimate.undecided() > 0);
        let line = |found: &LongFlightShare| Line {
            cone_angle: found.cone_angle,
            limit: found.limit,
            launches: found.estimate.points,
            share: found.estimate.is_known().then_some(found.estimate.probability),
            share_lo: found.estimate.interval.map(|interval| interval.lo),
            share_hi: found.estimate.interval.map(|interval| interval.hi),
            undecided: is_undecided.then(|| found.estimate.undecided()),
        };
        let lines: Vec<Line> = shares.iter().map(line).collect();
        self.series.answer_lines(asked, &lines, || Ok(chart::limit(&shares, &chart::named(&coin.into()))?))
    }
}
