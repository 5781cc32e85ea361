//! A trial solves random scenes as planned, and some of them by every other model as well. It shows whether the planned
//! answers are accurate enough, whether their errors were expected, and whether another model would have been cheaper.

use anyhow::ensure;
use rayon::prelude::*;
use toss::{Answer, Choice, Error, How, InputError, Model, Scene, Want};

use super::clock::nanoseconds;
use super::delivered::{Truth, true_probability};
use super::scenes::{self, TossScene, served};
use crate::measure::effort::Effort;

/// Seed of the scenes, another one than that of the table.
const SEED: u64 = 12;

/// Actual and expected errors below this count as this one, because a result near 1 is rounded by as much in f64.
pub const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// The result of one scene.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The scene's kind.
    pub kind: &'static str,
    /// The accuracy that was asked for.
    pub accuracy: f64,
    /// The model that was chosen; `None` if the planner refused the scene because no setting is accurate enough.
    pub model: Option<&'static Model>,
    /// The error of its answer.
    pub error: f64,
    /// The largest error of that model on the scene's family: its toss and, if the error there is far below the
    /// expected one, some similar tosses. The error on a single toss may be small by luck.
    pub error_of_family: f64,
    /// The error that the plan expected.
    pub expected: f64,
    /// Cost of the choice divided by that of the cheapest model that serves the scene, by recorded cost; `None` if not
    /// all models were tried.
    pub cost_ratio: Option<f64>,
    /// As above, by measured instead of recorded cost.
    pub cost_ratio_by_clock: Option<f64>,
    /// The scene in words, its toss as hex floats.
    pub input: String,
}

/// All scenes of a run.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The results of the scenes.
    pub outcomes: Vec<Outcome>,
    /// The measured costs of each model where it was tried (ns), in the order of the hierarchy.
    pub costs: Vec<(&'static Model, Vec<f64>)>,
}

impl Trial {
    /// Solves a number of scenes that depends on `effort`.
    ///
    /// # Errors
    /// If a scene cannot be solved, except because its accuracy is out of reach.
    pub fn new(effort: Effort) -> anyhow::Result<Self> {
        let (solved, tried, spaces) = match effort {
            Effort::Quick => (1000, 100, 6),
            Effort::Standard => (10_000, 500, 24),
            Effort::Deep => (10_000, 10_000, 100),
        };
        let tosses: Vec<Outcome> = (0..solved)
            .into_par_iter()
            .map(|index| solve(&scenes::toss_scene(SEED, index)?))
            .collect::<anyhow::Result<_>>()?;
        let mut trial = Self { outcomes: tosses, costs: Vec::new() };
        // These are timed, so they run on one thread, where no other thread disturbs the clock.
        for index in 0..tried {
            trial.try_all(usize::try_from(index)?, &scenes::toss_scene(SEED, index)?)?;
        }
        for index in 0..spaces {
            trial.solve_space(index)?;
        }
        trial.costs.sort_by_key(|(model, _)| model.place());
        Ok(trial)
    }
}

impl Outcome {
    /// The error divided by the accuracy that was asked for.
    pub fn error_by_accuracy(&self) -> f64 {
        self.error / self.accuracy
    }

    /// The largest error on the scene's family divided by the expected one, which counts as at least [`ROUNDING`]; 0 if
    /// there is no error.
    pub fn error_by_expected(&self) -> f64 {
        if self.error_of_family == 0.0 { 0.0 } else { self.error_of_family / self.expected.max(ROUNDING) }
    }

    /// Whether the expected error is at most 30 times `error`, which counts as at least [`ROUNDING`].
    pub(super) fn is_within_30(&self, error: f64) -> bool {
        self.expected <= 30.0 * error.max(ROUNDING)
    }
}

/// Solves the scene as planned.
fn solve(scene: &TossScene) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome {
        kind: scene.kind,
        accuracy: scene.scene.accuracy,
        model: None,
        error: 0.0,
        error_of_family: 0.0,
        expected: 0.0,
        cost_ratio: None,
        cost_ratio_by_clock: None,
        input: input(&scene.scene, &scene.case.hex()),
    };
    let choice = match scene.scene.plan() {
        Ok(decision) => decision.choice,
        Err(Error::Input(InputError::OutOfRange { field: "accuracy", .. })) => return Ok(outcome),
        Err(error) => return Err(error.into()),
    };
    let solution = scene.scene.solve()?;
    ensure!(solution.model == choice.model, "{} was planned, not {}", choice.model.name, solution.model.name);
    outcome.model = Some(choice.model);
    outcome.expected = choice.expected_error;
    outcome.error = Truth::new(&scene.case.toss).error(&scene.scene, &solution.answer)?;
    outcome.error_of_family = outcome.error;
    if !outcome.is_within_30(outcome.error) {
        outcome.error_of_family = outcome.error.max(largest_of_neighbours(&choice, scene)?.unwrap_or(0.0));
    }
    Ok(outcome)
}

/// The scene in words; `of` names its toss or space.
fn input(scene: &Scene, of: &str) -> String {
    let wanted = scene.want.kind().name();
    let by = scene.by.as_ref().map(|by| format!(" by {}", by.solver)).unwrap_or_default();
    format!("{wanted} to {:e}{by}: {of}", scene.accuracy)
}

impl Trial {
    /// Runs every model that can answer the scene, and compares the costs of those that serve it.
    fn try_all(&mut self, index: usize, scene: &TossScene) -> anyhow::Result<()> {
        let truth = Truth::new(&scene.case.toss);
        let mut serving: Vec<Costs> = Vec::new();
        let mut chosen = None;
        if self.outcomes[index].model.is_none() {
            return Ok(());
        }
        let planned = scene.scene.plan()?.choice;
        for choice in contestants(&scene.scene)? {
            let Ok(answer) = choice.run(&scene.scene) else { continue };
            let cost_ns = nanoseconds(|| choice.run(&scene.scene));
            self.note(choice.model, cost_ns, &scene.scene);
            let is_planned = same(&choice, &planned);
            let costs = [choice.expected_cost_ns, cost_ns];
            if is_planned {
                chosen = Some(costs);
            }
            let error = truth.error(&scene.scene, &answer)?;
            if is_planned || (error <= scene.scene.accuracy && serves_family(&choice, scene)?) {
                serving.push(costs);
            }
        }
        let [by_record, by_clock] = cost_ratios(chosen, &serving);
        self.outcomes[index].cost_ratio = Some(by_record);
        self.outcomes[index].cost_ratio_by_clock = Some(by_clock);
        Ok(())
    }

    fn note(&mut self, model: &'static Model, cost_ns: f64, scene: &Scene) {
        #[expect(clippy::cast_precision_loss, reason = "a few points")]
        let landings = if let Want::Trace { points, .. } = scene.want { points as f64 } else { 1.0 };
        match self.costs.iter_mut().find(|(other, _)| *other == model) {
            Some((_, costs)) => costs.push(cost_ns / landings),
            None => self.costs.push((model, vec![cost_ns / landings])),
        }
    }

    /// Samples a space by every model that serves its scene, and notes the one that was planned.
    fn solve_space(&mut self, index: u64) -> anyhow::Result<()> {
        const POINTS: u64 = 1 << 20;
        let space = scenes::space(SEED, index)?;
        let scene = Scene::new(Want::Probability(space), scenes::accuracy_of_a_probability(SEED, index));
        let planned = scene.plan()?.choice;
        let truth = true_probability(&space, POINTS)?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
        let mut serving: Vec<Costs> = Vec::new();
        let (mut error, mut chosen) = (f64::INFINITY, None);
        // Models that are expected to cost far more cannot be the cheapest, and would take minutes.
        let most_ns = 30.0 * planned.expected_cost_ns;
        for choice in served(&scene)?.into_iter().filter(|choice| choice.expected_cost_ns <= most_ns) {
            let Answer::Probability(estimate) = choice.run(&scene)? else { continue };
            let cost_ns = pool.install(|| nanoseconds(|| choice.run(&scene)));
            self.note(choice.model, cost_ns, &scene);
            let (this, costs) = ((estimate.probability - truth).abs(), [choice.expected_cost_ns, cost_ns]);
            if choice.model == planned.model {
                (error, chosen) = (this, Some(costs));
            }
            if this <= scene.accuracy {
                serving.push(costs);
            }
        }
        let [by_record, by_clock] = cost_ratios(chosen, &serving);
        self.outcomes.push(Outcome {
            kind: "probability",
            accuracy: scene.accuracy,
            model: Some(planned.model),
            error,
            error_of_family: error,
            expected: planned.expected_error,
            cost_ratio: Some(by_record),
            cost_ratio_by_clock: Some(by_clock),
            input: input(&scene, &format!("space {index} of seed {SEED}")),
        });
        Ok(())
    }
}

/// Recorded and measured cost of an answer (ns), in this order.
type Costs = [f64; 2];

/// The recorded and the measured cost of the choice, each divided by that of the cheapest answer in `serving`.
fn cost_ratios(chosen: Option<Costs>, serving: &[Costs]) -> [f64; 2] {
    let cheapest = |of: usize| serving.iter().map(|costs| costs[of]).fold(f64::INFINITY, f64::min);
    let chosen = chosen.unwrap_or([f64::INFINITY; 2]);
    [chosen[0] / cheapest(0), chosen[1] / cheapest(1)]
}

/// Whether two choices are the same model and, for integrators, the same solver and scheme.
fn same(a: &Choice, b: &Choice) -> bool {
    match (&a.how, &b.how) {
        (How::Integrator(entry, stepping), How::Integrator(other, others)) => {
            entry.name() == other.name() && stepping.scheme() == others.scheme()
        }
        _ => a.model == b.model,
    }
}

/// Every model that can answer the scene, closed forms even if the planner expects too large an error of them. If the
/// scene asks for an integrator, its schemes alone.
fn contestants(scene: &Scene) -> anyhow::Result<Vec<Choice>> {
    if let Some(by) = &scene.by {
        let serves = |choice: &Choice| match &choice.how {
            How::Integrator(entry, stepping) => {
                entry.name() == by.solver && by.scheme.as_ref().is_none_or(|scheme| *scheme == stepping.scheme().name())
            }
            _ => false,
        };
        return Ok(served(scene)?.into_iter().filter(serves).collect());
    }
    let loose = Scene::new(scene.want.clone(), f64::MAX);
    let in_closed_form = served(&loose)?.into_iter().filter(|choice| matches!(choice.how, How::ClosedForm));
    let others = served(scene)?.into_iter().filter(|choice| !matches!(choice.how, How::ClosedForm));
    Ok(in_closed_form.chain(others).collect())
}

/// Whether a choice is accurate enough on tosses that are similar to the scene's. Outcomes need no such test, because
/// they are proven.
fn serves_family(choice: &Choice, scene: &TossScene) -> anyhow::Result<bool> {
    if matches!(scene.scene.want, Want::Outcome(_)) {
        return Ok(true);
    }
    Ok(largest_of_neighbours(choice, scene)?.is_some_and(|error| error <= scene.scene.accuracy))
}

/// The largest error of a choice on tosses that are similar to the scene's; `None` if it fails on one. A model that is
/// accurate enough on one toss by luck must not count as a cheaper way to serve the scene.
fn largest_of_neighbours(choice: &Choice, scene: &TossScene) -> anyhow::Result<Option<f64>> {
    const NEIGHBOURS: u64 = 8;
    let mut largest = 0.0_f64;
    for index in 0..NEIGHBOURS {
        let toss = scenes::neighbour(&scene.case, SEED, index)?;
        let near = Scene { want: scene.scene.want.of(toss), ..scene.scene.clone() };
        let Ok(answer) = choice.run(&near) else { return Ok(None) };
        largest = largest.max(Truth::new(&toss).error(&near, &answer)?);
    }
    Ok(Some(largest))
}
