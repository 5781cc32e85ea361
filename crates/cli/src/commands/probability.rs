//! `unfair-toss probability` estimates the probability of heads over a space of launches. It prints the error or
//! interval of the estimate with it, as far as the method has one.

use exact::{ProvenCounts, Stage};
use sampling::{Counts, Estimate, Found, Interval, IntervalKind, Plan, Rest, Sampler, Scrambled, Space};
use serde::Serialize;
use toss::{Answer as Answered, Backend, How, IntegratedCounts, Integration, Proving, Registry, Scene, Solver, Want};

use crate::failure::Failure;
use crate::output::{self, Format, Input};
use crate::shard_args::ShardArgs;
use crate::solver_args::SolverArgs;
use crate::space_args::{DEFAULT_QUADRATURE, Defaults, MethodArg, PlanArgs, SpaceArgs, ThreadArgs, lays_grid};

/// Largest error if neither a method nor an accuracy is given.
const DEFAULT_ACCURACY: f64 = 1e-4;
/// The same for bodies with I1 ≠ I2, which have no closed form of the share over a speed.
const DEFAULT_ACCURACY_OF_BODIES: f64 = 1e-3;

const DEFAULTS: Defaults = Defaults { random: 250_000, sobol: 1 << 18, accuracy: DEFAULT_QUADRATURE };

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// How launches are chosen [default: the cheapest one that serves, with as many launches as it takes]
    #[arg(long, value_enum)]
    method: Option<MethodArg>,
    /// Largest acceptable error of the probability, if no method is given [default: 1e-4, and 1e-3 for a body with
    /// I1 ≠ I2], or of quadrature [default: 1e-10]
    #[arg(long, value_name = "EPS", allow_hyphen_values = true)]
    accuracy: Option<f64>,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Prove each outcome by integration: for the solver quaternion with the scheme taylor, which is then its default
    #[arg(long)]
    prove: bool,
    #[command(flatten)]
    shard: ShardArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// An estimate as JSON.
#[derive(Serialize)]
pub(crate) struct Answer {
    #[serde(flatten)]
    counts: Option<CountsAnswer>,
    points: u64,
    probability: f64,
    /// For exact-speed and quadrature: half the width of the interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    interval: Option<[f64; 2]>,
    interval_kind: String,
    certified: bool,
    /// The number of outcomes that each stage of the proof decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    proven_by: Option<ProvenBy>,
    /// The number of outcomes that each kind of integration decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    integrated_by: Option<IntegratedBy>,
    seed: Option<u64>,
    /// The method by which launches were chosen.
    method: &'static str,
}

#[derive(Serialize)]
struct CountsAnswer {
    heads: u64,
    tails: u64,
    undecided: u64,
}

/// The number of outcomes by stage of the proof.
#[derive(Serialize)]
struct ProvenBy {
    keller: u64,
    certain: u64,
    f64: u64,
    double_double: u64,
    multiprecision: u64,
}

/// The number of outcomes by kind of integration.
#[derive(Serialize)]
struct IntegratedBy {
    f64: u64,
    finest_tolerance: u64,
    double_double: u64,
    more_digits: u64,
}

impl From<IntegratedCounts> for IntegratedBy {
    fn from(counts: IntegratedCounts) -> Self {
        Self {
            f64: counts.by(Integration::AsConfigured),
            finest_tolerance: counts.by(Integration::Finest),
            double_double: counts.by(Integration::DoubleDouble),
            more_digits: counts.by(Integration::MoreDigits),
        }
    }
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, input: &Input) -> Result<String, Failure> {
        let space = self.space.space()?;
        if self.prove {
            return self.run_proving(&space, registry, input);
        }
        let backend = self.solver.backend(registry)?;
        if let (true, Some(method)) = (self.shard.is_given(), self.method) {
            if self.format == Format::Json {
                return Err(Failure::usage("format", "--format has no effect with --shard: the part itself is JSON"));
            }
            let plan = self.plan_of(method, &space)?;
            return self.shard.write((&space, plan), backend.sampler(), &self.threads);
        }
        let (plan, found) = match self.method {
            Some(method) => self.by_method(method, &space, &backend)?,
            None => self.by_plan(&space, &backend)?,
        };
        Ok(match self.format {
            Format::Json => output::json(input, &Answer::new(&found, plan)),
            Format::Text => {
                let chosen =
                    format!("\nmethod       {}, chosen for an error of {:e}", name_of(plan), self.accuracy(&space));
                text(&found, backend.solver().name()) + if self.method.is_none() { &chosen } else { "" }
            }
        })
    }

    /// The answer of which each outcome is proven by integration.
    fn run_proving(&self, space: &Space, registry: &Registry, input: &Input) -> Result<String, Failure> {
        let proving = Proving::new(self.solver.prover(registry)?)?;
        if self.shard.is_given() {
            return Err(Failure::usage(
                "shard",
                "--shard has no effect with --prove: parts are counted by the exact motion",
            ));
        }
        let needed = || Failure::usage("method", "--prove needs --method: a plan takes the exact motion");
        let plan = self.plan_of(self.method.ok_or_else(needed)?, space)?;
        let ask = |sampler: &Sampler<'_>| sampler.estimate(space, plan);
        let found = self.threads.ask(Sampler::by(&proving), (plan.points(space)?, "launches"), ask)?;
        let (mut answer, counts) = (Answer::new(&found, plan), proving.counts());
        answer.certified = counts.undecided() == 0;
        answer.integrated_by = Some(counts.into());
        Ok(match self.format {
            Format::Json => output::json(input, &answer),
            Format::Text => {
                let kinds = Integration::ALL.map(|kind| format!("{kind} {}", counts.by(kind)));
                format!("{}\nproven by    integration: {}", text(&found, proving.name()), kinds.join(", "))
            }
        })
    }

    /// The plan of a method.
    fn plan_of(&self, method: MethodArg, space: &Space) -> Result<Plan, Failure> {
        if self.accuracy.is_some() && method != MethodArg::Quadrature {
            let message =
                "--accuracy can't be used with this --method: it is for quadrature, or chooses the method itself";
            return Err(Failure::usage("accuracy", message));
        }
        let accuracy = self.accuracy.unwrap_or(DEFAULTS.accuracy);
        let plan = self.plan.plan(method, space, Defaults { accuracy, ..DEFAULTS })?;
        self.space.require_grid_where_points_are(space, |of| lays_grid(plan, of))?;
        Ok(plan)
    }

    fn by_method(&self, method: MethodArg, space: &Space, backend: &Backend) -> Result<(Plan, Estimate), Failure> {
        let plan = self.plan_of(method, space)?;
        if let Plan::Quadrature { .. } = plan {
            // Its number of shares is not known before, so that there is no progress to show.
            return Ok((plan, self.threads.run(|| backend.sampler().estimate(space, plan))??));
        }
        let launches = (plan.points(space)?, "launches");
        let ask = |sampler: &Sampler<'_>| sampler.estimate(space, plan);
        Ok((plan, self.threads.ask(backend.sampler(), launches, ask)?))
    }

    /// The estimate by the method and with the launches that the planner chooses for the accuracy.
    fn by_plan(&self, space: &Space, backend: &Backend) -> Result<(Plan, Estimate), Failure> {
        if !backend.sampler().is_exact() {
            return Err(Failure::usage("solver", "--solver needs --method: a plan takes the exact motion"));
        }
        self.plan.require_none()?;
        self.space.require_grid_where_points_are(space, |_| false)?;
        let scene = Scene::new(Want::Probability(*space), self.accuracy(space));
        let (choice, answer) = self.threads.run(|| scene.choose_and_run(Registry::standard()))??;
        match (choice.how, answer) {
            (How::Sampling(plan), Answered::Probability(found)) => Ok((plan, *found)),
            _ => Err(no_sample()),
        }
    }

    fn accuracy(&self, space: &Space) -> f64 {
        let default = if space.coin().is_some() { DEFAULT_ACCURACY } else { DEFAULT_ACCURACY_OF_BODIES };
        self.accuracy.unwrap_or(default)
    }
}

/// The error of a planner that answers a probability by something else than a sample.
fn no_sample() -> Failure {
    Failure::usage("accuracy", "--accuracy: the plan for this space is no sample; --method chooses one")
}

/// The name of the method of `plan`, as `--method` takes it.
pub(crate) fn name_of(plan: Plan) -> &'static str {
    match plan {
        Plan::Grid => "grid",
        Plan::Random { .. } => "random",
        Plan::Sobol(_) => "sobol",
        Plan::ExactSpeed(_) => "exact-speed",
        Plan::Quadrature { .. } => "quadrature",
    }
}

/// The seed of `plan`; `None` if nothing in it is random.
fn seed_of(plan: Plan) -> Option<u64> {
    match plan {
        Plan::Grid | Plan::ExactSpeed(Rest::Grid) | Plan::Quadrature { .. } => None,
        Plan::Random { seed, .. } => Some(seed),
        Plan::Sobol(Scrambled { seed, .. }) | Plan::ExactSpeed(Rest::Sobol(Scrambled { seed, .. })) => Some(seed),
    }
}

impl Answer {
    pub(crate) fn new(found: &Estimate, plan: Plan) -> Self {
        let (counts, error_bound) = match found.found {
            Found::Counts(counts) => (Some(counts), None),
            Found::Shares { .. } => (None, found.half_width()),
        };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
        Self {
            counts: counts.map(CountsAnswer::from),
            points: found.points,
            probability: found.probability,
            error_bound,
            interval: found.interval.map(|interval| [interval.lo, interval.hi]),
            interval_kind: found.interval_kind.to_string(),
            certified: proven.is_some(),
            proven_by: proven.map(ProvenBy::from),
            integrated_by: None,
            seed: seed_of(plan),
            method: name_of(plan),
        }
    }
}

impl From<Counts> for CountsAnswer {
    fn from(counts: Counts) -> Self {
        Self { heads: counts.heads(), tails: counts.tails(), undecided: counts.undecided() }
    }
}

impl From<ProvenCounts> for ProvenBy {
    fn from(proven: ProvenCounts) -> Self {
        Self {
            keller: proven.by(Stage::Keller),
            certain: proven.by(Stage::TrigFree),
            f64: proven.by(Stage::F64),
            double_double: proven.by(Stage::DoubleDouble),
            multiprecision: proven.by(Stage::Multiprecision),
        }
    }
}

/// An estimate as text.
pub(crate) fn text(found: &Estimate, solver: &str) -> String {
    let (probability, kind) = (found.probability, &found.interval_kind);
    let (probability, interval) = match (found.interval, found.half_width()) {
        (Some(_), Some(error)) if *kind == IntervalKind::Rounding => {
            (probability.to_string(), format!("± {error:.1e} ({kind})"))
        }
        (Some(_), Some(error)) if *kind == IntervalKind::Quadrature => {
            (format!("{probability:.0$}", digits_for(error)), format!("± {error:.1e} ({kind})"))
        }
        (Some(Interval { lo, hi }), Some(error)) => {
            let digits = digits_for(error);
            (format!("{probability:.digits$}"), format!("{lo:.digits$} to {hi:.digits$} ({kind})"))
        }
        _ => (format!("{probability:.6}"), kind.to_string()),
    };
    let launches = match found.found {
        Found::Counts(counts) => {
            format!("{} heads, {} tails, {} undecided", counts.heads(), counts.tails(), counts.undecided())
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
        let stages = Stage::ALL.map(|stage| format!("{} {}", stage.name(), counts.proven().by(stage)));
        lines.push(format!("proven by    {}", stages.join(", ")));
    }
    lines.join("\n")
}

/// The number of decimal places that show two digits of `error`, at least six.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 6 and 17")]
fn digits_for(error: f64) -> usize {
    (1.0 - error.log10().floor()).clamp(6.0, 17.0) as usize
}
