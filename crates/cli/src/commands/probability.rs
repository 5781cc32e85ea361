//! `unfair-toss probability`: the share of heads over a space of launches.

use sampling::{Counts, Estimate, Found, Interval, IntervalKind, Proven, estimate};
use serde::Serialize;

use crate::args::SamplingSolverArgs;
use crate::failure::Failure;
use crate::output::{self, Format, progress_bar};
use crate::space_args::{DefaultPoints, MethodArg, PlanArgs, SpaceArgs, ThreadArgs};

const DEFAULT_POINTS: DefaultPoints = DefaultPoints { random: 250_000, sobol: 1 << 18 };

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// How launches are chosen
    #[arg(long, value_enum)]
    method: MethodArg,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SamplingSolverArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
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
    /// How many outcomes each stage of the proof decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    proven_by: Option<Proven>,
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
        let solver = self.solver.solver()?;
        let plan = self.plan.plan(self.method, &space, solver.as_ref(), DEFAULT_POINTS)?;
        let progress = progress_bar(plan.points(&space)?, "launches");
        let pool = self.threads.pool()?;
        let found = pool.install(|| estimate(&space, plan, solver.as_ref(), &|more| progress.inc(more)));
        progress.finish_and_clear();
        let found = found?;
        Ok(match self.format {
            Format::Json => output::json(&Answer::new(&found, self.plan.seed_of(plan))),
            Format::Text => text(&found, solver.name()),
        })
    }
}

impl Answer {
    fn new(found: &Estimate, seed: Option<u64>) -> Self {
        let (counts, error_bound) = match found.found {
            Found::Counts(counts) => (Some(counts), None),
            Found::Shares { .. } => (None, found.half_width()),
        };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven);
        let counts = counts.map(|Counts { heads, tails, undecided, .. }| CountsAnswer { heads, tails, undecided });
        Self {
            counts,
            points: found.points,
            probability: found.probability,
            error_bound,
            interval: found.interval.map(|interval| [interval.lo, interval.hi]),
            interval_kind: found.interval_kind.to_string(),
            certified: proven.is_some(),
            proven_by: proven,
            seed,
        }
    }
}

fn text(found: &Estimate, solver: &str) -> String {
    let (probability, kind) = (found.probability, &found.interval_kind);
    let (probability, interval) = match (found.interval, found.half_width()) {
        (Some(_), Some(error)) if *kind == IntervalKind::Rounding => {
            (probability.to_string(), format!("± {error:.1e} ({kind})"))
        }
        (Some(Interval { lo, hi }), Some(error)) => {
            let digits = digits_for(error);
            (format!("{probability:.digits$}"), format!("{lo:.digits$} to {hi:.digits$} ({kind})"))
        }
        _ => (format!("{probability:.6}"), kind.to_string()),
    };
    let launches = match found.found {
        Found::Counts(Counts { heads, tails, undecided, .. }) => {
            format!("{heads} heads, {tails} tails, {undecided} undecided")
        }
        Found::Shares { .. } => format!("{}, each at all its speeds", found.points),
    };
    let mut lines = vec![
        format!("P(heads)     {probability}"),
        format!("interval     {interval}"),
        format!("launches     {launches}"),
        format!("solver       {solver}"),
    ];
    if let Found::Counts(counts) = found.found
        && counts.are_certified()
    {
        let Proven { certain, keller, f64, double_double, multiprecision } = counts.proven;
        lines.push(format!("proven by    Keller's cosine {keller}, no motion {certain}, f64 {f64}, double-double {double_double}, more digits {multiprecision}"));
    }
    lines.join("\n")
}

/// Digits after the point that show two of an error, and at least six.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 6 and 17")]
fn digits_for(error: f64) -> usize {
    (1.0 - error.log10().floor()).clamp(6.0, 17.0) as usize
}
