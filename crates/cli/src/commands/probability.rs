//! `unfair-toss probability`: the share of heads over a space of launches.

use indicatif::{ProgressBar, ProgressStyle};
use sampling::space::parse_space;
use sampling::{Counts, Plan, Space, estimate, named_space, wilson};
use serde::Serialize;
use toss::Coin;
use toss::launch::DEFAULT_GRAVITY;

use crate::args::{CoinArgs, SolverArgs};
use crate::failure::Failure;
use crate::output::{self, Format};

/// Confidence level of the intervals shown.
const LEVEL: f64 = 0.95;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    coin: CoinArgs,
    /// A named space of launches; `spaces` lists them
    #[arg(long, value_name = "NAME", conflicts_with_all = ["rate_x", "rate_y", "rate_z", "speed", "gravity"],
          required_unless_present_all = ["rate_x", "rate_y", "rate_z", "speed"])]
    space: Option<String>,
    /// ωx (rad/s): VALUE, LO:HI or LO:HI:POINTS
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    rate_x: Option<String>,
    /// ωy (rad/s): VALUE, LO:HI or LO:HI:POINTS, or x for ωy = ωx
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    rate_y: Option<String>,
    /// ωz (rad/s): VALUE, LO:HI or LO:HI:POINTS
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    rate_z: Option<String>,
    /// v0 (m/s): VALUE, LO:HI or LO:HI:POINTS
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    speed: Option<String>,
    /// Gravity (m/s²) [default: 9.81]
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    gravity: Option<f64>,
    /// How launches are chosen
    #[arg(long, value_enum)]
    method: MethodArg,
    /// Number of random launches
    #[arg(long, value_name = "N", default_value_if("method", "random", "250000"))]
    points: Option<u64>,
    /// Seed of the random launches
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Number of threads [default: one a core]
    #[arg(long, value_name = "K")]
    threads: Option<usize>,
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
    /// Method B: uniform random launches
    Random,
}

#[derive(Serialize)]
struct Answer {
    heads: u64,
    tails: u64,
    undecided: u64,
    points: u64,
    probability: f64,
    interval: Option<[f64; 2]>,
    interval_kind: &'static str,
    certified: bool,
    seed: Option<u64>,
}

impl Args {
    pub(crate) fn run(&self) -> Result<String, Failure> {
        let space = self.space()?;
        let plan = self.plan()?;
        let solver = self.solver.solver(&self.scheme)?;
        let points = match plan {
            Plan::Grid => space.grid_points()?,
            Plan::Random { points, .. } => points,
        };
        let progress = progress_bar(points);
        let pool = self.pool()?;
        let counted = pool.install(|| estimate(&space, plan, solver.as_ref(), &|more| progress.inc(more)));
        progress.finish_and_clear();
        let answer = Answer::new(counted?, plan);
        Ok(match self.format {
            Format::Json => output::json(&answer),
            Format::Text => answer.text(solver.name()),
        })
    }

    fn space(&self) -> Result<Space, Failure> {
        let coin = self.coin.given()?;
        if let Some(name) = &self.space {
            let space = named_space(name)?;
            return Ok(coin.map_or(space, |coin| space.with_coin(coin)));
        }
        let axis = |text: &Option<String>, option: &str| {
            text.clone().ok_or_else(|| Failure::Usage(format!("--space, or {option} among the four axes, is needed")))
        };
        let (x, y) = (axis(&self.rate_x, "--rate-x")?, axis(&self.rate_y, "--rate-y")?);
        let (z, speed) = (axis(&self.rate_z, "--rate-z")?, axis(&self.speed, "--speed")?);
        let gravity = self.gravity.unwrap_or(DEFAULT_GRAVITY);
        Ok(parse_space(coin.unwrap_or(Coin::PAPER), [&x, &y, &z, &speed], gravity)?)
    }

    fn plan(&self) -> Result<Plan, Failure> {
        match (self.method, self.points) {
            (MethodArg::Grid, None) => Ok(Plan::Grid),
            (MethodArg::Grid, Some(_)) => {
                Err(Failure::Usage("--points is for random launches; a grid takes its points from the axes".to_owned()))
            }
            (MethodArg::Random, points) => Ok(Plan::Random { points: points.unwrap_or(0), seed: self.seed }),
        }
    }

    fn pool(&self) -> Result<rayon::ThreadPool, Failure> {
        const MOST_THREADS: usize = 1024;
        let threads = match self.threads {
            None => 0,
            Some(threads @ 1..=MOST_THREADS) => threads,
            Some(threads) => return Err(Failure::Usage(format!("threads = {threads}: valid are 1 to {MOST_THREADS}"))),
        };
        let build = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        build.map_err(|error| Failure::Usage(format!("threads = {threads}: {error}")))
    }
}

/// Hidden unless standard error is a terminal.
fn progress_bar(points: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} launches, {per_sec}, {eta} left")
        .expect("the template is valid");
    ProgressBar::new(points).with_style(style)
}

impl Answer {
    fn new(counts: Counts, plan: Plan) -> Self {
        let points = counts.points();
        let (interval, interval_kind, seed) = match plan {
            Plan::Grid => (None, "none: a grid has a discretisation error, not a confidence interval", None),
            Plan::Random { seed, .. } => {
                let interval = wilson(counts.heads, points, LEVEL);
                (Some([interval.lo, interval.hi]), "wilson 95 %", Some(seed))
            }
        };
        Self {
            heads: counts.heads,
            tails: counts.tails,
            undecided: counts.undecided,
            points,
            probability: counts.probability(),
            interval,
            interval_kind,
            // No solver proves its outcomes.
            certified: false,
            seed,
        }
    }

    fn text(&self, solver: &str) -> String {
        let interval = match self.interval {
            Some([lo, hi]) => format!("{lo:.6} to {hi:.6} ({})", self.interval_kind),
            None => self.interval_kind.to_owned(),
        };
        [
            format!("P(heads)     {:.6}", self.probability),
            format!("interval     {interval}"),
            format!("launches     {} heads, {} tails, {} undecided", self.heads, self.tails, self.undecided),
            format!("solver       {solver}"),
        ]
        .join("\n")
    }
}
