//! `unfair-toss probability`: the share of heads over a space of launches.

use sampling::{Counts, Estimate, Found, IntervalKind, Plan, Rest, Scrambled, Space, estimate};
use serde::Serialize;

use crate::args::{SolverArgs, SpaceArgs, ThreadArgs};
use crate::failure::Failure;
use crate::output::{self, Format, progress_bar};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// How launches are chosen
    #[arg(long, value_enum)]
    method: MethodArg,
    /// Number of launches [default: 250000 for random, 262144 for sobol; exact-speed uses the grid of the other axes if
    /// they have one, else 262144]
    #[arg(long, value_name = "N")]
    points: Option<u64>,
    /// Seed of the random launches and of the scrambles
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
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum MethodArg {
    /// Method A: a grid over the space
    Grid,
    /// Method B: independent random launches
    Random,
    /// Owen-scrambled Sobol points, 8 scrambles
    Sobol,
    /// The speed integrated in closed form, by the exact motion; the rest by its grid or by Sobol points
    ExactSpeed,
}

#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    counts: Option<CountsAnswer>,
    points: u64,
    probability: f64,
    /// For exact-speed: how far the interval reaches from the probability.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    interval: Option<[f64; 2]>,
    interval_kind: String,
    certified: bool,
    seed: Option<u64>,
}

#[derive(Serialize)]
struct CountsAnswer {
    heads: u64,
    tails: u64,
    undecided: u64,
}

impl Args {
    pub(crate) fn run(&self) -> Result<String, Failure> {
        let space = self.space.space()?;
        let plan = self.plan(&space)?;
        let solver = self.solver.solver(&self.scheme)?;
        if matches!(plan, Plan::ExactSpeed(_)) && solver.method().is_some() {
            return Err(Failure::Usage("exact-speed integrates the exact motion; leave --solver out".to_owned()));
        }
        let progress = progress_bar(plan.points(&space)?);
        let pool = self.threads.pool()?;
        let found = pool.install(|| estimate(&space, plan, solver.as_ref(), &|more| progress.inc(more)));
        progress.finish_and_clear();
        let found = found?;
        Ok(match self.format {
            Format::Json => output::json(&Answer::new(&found, self.seed_of(plan))),
            Format::Text => text(&found, solver.name()),
        })
    }

    fn plan(&self, space: &Space) -> Result<Plan, Failure> {
        const SOBOL_POINTS: u64 = 1 << 18;
        let seed = self.seed;
        let scrambled = || Scrambled::new(self.points.unwrap_or(SOBOL_POINTS), seed);
        match self.method {
            MethodArg::Grid if self.points.is_some() => {
                Err(Failure::Usage("--points: a grid takes its points from the axes, LO:HI:POINTS".to_owned()))
            }
            MethodArg::Grid => Ok(Plan::Grid),
            MethodArg::Random => Ok(Plan::Random { points: self.points.unwrap_or(250_000), seed }),
            MethodArg::Sobol => Ok(Plan::Sobol(scrambled())),
            MethodArg::ExactSpeed => {
                let grid = Plan::ExactSpeed(Rest::Grid);
                let has_grid = self.points.is_none() && grid.points(space).is_ok();
                Ok(if has_grid { grid } else { Plan::ExactSpeed(Rest::Sobol(scrambled())) })
            }
        }
    }

    fn seed_of(&self, plan: Plan) -> Option<u64> {
        match plan {
            Plan::Grid | Plan::ExactSpeed(Rest::Grid) => None,
            Plan::Random { .. } | Plan::Sobol(_) | Plan::ExactSpeed(Rest::Sobol(_)) => Some(self.seed),
        }
    }
}

impl Answer {
    fn new(found: &Estimate, seed: Option<u64>) -> Self {
        let (counts, error_bound) = match found.found {
            Found::Counts(Counts { heads, tails, undecided }) => (Some(CountsAnswer { heads, tails, undecided }), None),
            Found::Shares { .. } => (None, Some(error_bound(found))),
        };
        Self {
            counts,
            points: found.points,
            probability: found.probability,
            error_bound: error_bound.flatten(),
            interval: found.interval.map(|interval| [interval.lo, interval.hi]),
            interval_kind: found.interval_kind.to_string(),
            // No solver proves its outcomes.
            certified: false,
            seed,
        }
    }
}

/// How far the interval reaches from the probability.
fn error_bound(found: &Estimate) -> Option<f64> {
    let interval = found.interval?;
    Some((found.probability - interval.lo).max(interval.hi - found.probability))
}

fn text(found: &Estimate, solver: &str) -> String {
    let kind = &found.interval_kind;
    let (probability, interval) = match (found.interval, error_bound(found)) {
        (Some(_), Some(error)) if *kind == IntervalKind::Rounding => {
            (format!("{}", found.probability), format!("± {error:.1e} ({kind})"))
        }
        (Some(interval), _) => {
            (format!("{:.7}", found.probability), format!("{:.7} to {:.7} ({kind})", interval.lo, interval.hi))
        }
        (None, _) => (format!("{:.7}", found.probability), kind.to_string()),
    };
    let launches = match found.found {
        Found::Counts(counts) => {
            format!("launches     {} heads, {} tails, {} undecided", counts.heads, counts.tails, counts.undecided)
        }
        Found::Shares { .. } => format!("launches     {}, each at all its speeds", found.points),
    };
    [
        format!("P(heads)     {probability}"),
        format!("interval     {interval}"),
        launches,
        format!("solver       {solver}"),
    ]
    .join("\n")
}
