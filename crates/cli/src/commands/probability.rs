//! `unfair-toss probability` estimates the probability of heads over a space of launches. It prints the error or
//! interval of the estimate with it, as far as the method has one.

use sampling::{Estimate, Found, Interval, Method, Plan, Sampler, Space};
use toss::defaults::{self, ACCURACY, ACCURACY_OF_BODIES, LAUNCHES};
use toss::solvers::Proving;
use toss::{Answer, Backend, Registry, Scene, Solver, Stage, Want, report};

use crate::commands::parts::ShardArgs;
use crate::estimate::text;
use crate::failure::Failure;
use crate::output::{Asked, Format, FormatArgs};
use crate::quantity;
use crate::solver_args::SolverArgs;
use crate::space_args::{PlanArgs, SpaceArgs, ThreadArgs, lays_grid};
use crate::watch::{BudgetArgs, Watch};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// How launches are chosen [default: the cheapest one that serves, with as many launches as it takes]
    #[arg(long, value_parser = quantity::method(&Method::ALL))]
    method: Option<Method>,
    #[arg(long, value_name = "EPS", allow_hyphen_values = true, value_parser = quantity::fraction,
          help = help_of_accuracy())]
    accuracy: Option<f64>,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Prove each outcome by integration: for the solver quaternion, whose scheme is then taylor by default
    #[arg(long)]
    prove: bool,
    #[command(flatten)]
    shard: ShardArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

fn help_of_accuracy() -> String {
    format!(
        "Largest acceptable error of the probability, if no method is given [default: {ACCURACY:e}, and \
         {ACCURACY_OF_BODIES:e} for a body with I1 ≠ I2], or of enclosure [default: 1e-10, 1e-6 or 1e-3 with one, two or \
         three coordinates beside the speed]"
    )
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        let space = self.space.space()?;
        if self.prove {
            return self.run_proving(&space, registry, asked);
        }
        let backend = self.solver.backend_of_outcomes(registry)?;
        if let (true, Some(method)) = (self.shard.is_given(), self.method) {
            if self.format.format == Format::Json {
                return Err(Failure::usage("format", "--format has no effect with --shard: the part itself is JSON"));
            }
            let plan = self.plan_of(method, &space)?;
            return self.shard.write((&space, plan), backend.sampler(), (&self.threads, &asked.watch));
        }
        let found = match self.method {
            Some(method) => self.by_method(method, &space, &backend, &asked.watch)?,
            None => self.by_plan(&space, &backend, &asked.watch)?,
        };
        let (method, accuracy) = (found.plan.method(), self.accuracy(&space));
        let chosen = || format!("\nmethod       {method}, chosen for an error of {accuracy:e}");
        Ok(self.format.print(asked, &report::Estimate { found: &found, integrated: None }, || {
            let chosen = if self.method.is_none() { chosen() } else { String::new() };
            text(&found, backend.solver().name()) + &chosen + &not_reached(&found, &asked.watch) + &self.turn_in_words()
        }))
    }

    /// The answer of which each outcome is proven by integration.
    fn run_proving(&self, space: &Space, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
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
        let found = self.threads.ask(&asked.watch, Sampler::by(&proving), (plan.points(space)?, "launches"), ask)?;
        let counts = proving.counts();
        Ok(self.format.print(asked, &report::Estimate { found: &found, integrated: Some(&counts) }, || {
            let stages = Stage::ALL.map(|stage| format!("{stage} {}", counts.by(stage)));
            let counted = format!("\nproven by    integration: {}", stages.join(", "));
            text(&found, proving.name()) + &counted + &self.turn_in_words()
        }))
    }

    /// A line with the turn as it was understood, if it was given so.
    fn turn_in_words(&self) -> String {
        self.space.turn_in_words().map_or_else(String::new, |line| format!("\n{line}"))
    }

    /// The plan of a method.
    fn plan_of(&self, method: Method, space: &Space) -> Result<Plan, Failure> {
        if self.accuracy.is_some() && method != Method::Enclosure {
            let message =
                "--accuracy can't be used with this --method: it is for enclosure, or chooses the method itself";
            return Err(Failure::usage("accuracy", message));
        }
        let plan = self.plan.plan(method, self.accuracy, space, LAUNCHES)?;
        self.space.require_grid_where_points_are(space, |of| lays_grid(plan, of))?;
        Ok(plan)
    }

    fn by_method(&self, method: Method, space: &Space, backend: &Backend, watch: &Watch) -> Result<Estimate, Failure> {
        let plan = self.plan_of(method, space)?;
        if let Plan::Enclosure { .. } = plan {
            return self.enclosed(backend.sampler(), space, plan, watch);
        }
        let launches = (plan.points(space)?, "launches");
        let ask = |sampler: &Sampler<'_>| sampler.estimate(space, plan);
        self.threads.ask(watch, backend.sampler(), launches, ask)
    }

    /// The estimate of a plan by enclosure. Who waits sees the cells and how narrow the enclosure is.
    fn enclosed(&self, sampler: Sampler<'_>, space: &Space, plan: Plan, watch: &Watch) -> Result<Estimate, Failure> {
        watch.show(None, "cells");
        let narrowed = |interval: Interval| {
            watch.say(format!("cells, the probability is known to {:.1e}", 0.5 * interval.width()));
        };
        let estimate = |sampler: &Sampler<'_>| sampler.estimate(space, plan);
        Ok(self.threads.run(|| watch.ask(sampler.on_narrowing(&narrowed), estimate))??)
    }

    /// The estimate by the method and with the launches that the planner chooses for the accuracy.
    fn by_plan(&self, space: &Space, backend: &Backend, watch: &Watch) -> Result<Estimate, Failure> {
        if !backend.sampler().is_exact() {
            return Err(Failure::usage("solver", "--solver needs --method: a plan takes the exact motion"));
        }
        self.plan.require_none()?;
        self.space.require_grid_where_points_are(space, |_| false)?;
        let scene = Scene::new(Want::Probability(*space), self.accuracy(space));
        let is_enclosed = scene.plan()?.choice.method() == Some(Method::Enclosure.name());
        watch.show(None, if is_enclosed { "cells or launches" } else { "launches" });
        let answer = self.threads.run(|| watch.ask(backend.sampler(), |sampler| scene.solve_with(sampler)))??;
        if let Answer::Probability(found) = answer { Ok(*found) } else { Err(no_sample()) }
    }

    fn accuracy(&self, space: &Space) -> f64 {
        self.accuracy.unwrap_or_else(|| defaults::accuracy(space))
    }
}

/// A line that says so if an enclosure did not reach its accuracy.
fn not_reached(found: &Estimate, watch: &Watch) -> String {
    match (found.plan, found.half_width()) {
        (Plan::Enclosure { accuracy }, Some(reached)) if found.is_wider_than_asked() => {
            let why = match watch.ended() {
                Some(ended) => ended.in_words().to_owned(),
                None if found.found == (Found::Enclosed { is_spent: true }) => {
                    format!("more than {} cells are too many", found.points)
                }
                None => "smaller cells do not make it narrower".to_owned(),
            };
            let reached = quantity::rounded_up(reached);
            format!("\naccuracy     {reached}, and not the {accuracy:e} that was asked for: {why}")
        }
        _ => String::new(),
    }
}

/// The error of a planner that answers a probability by something else than a sample.
fn no_sample() -> Failure {
    Failure::usage("accuracy", "--accuracy: the plan for this space is no sample; --method chooses one")
}
