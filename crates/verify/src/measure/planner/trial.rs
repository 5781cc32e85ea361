//! A trial solves random scenes as planned. It shows whether the planned answers are accurate enough, and whether their
//! errors were expected.

use anyhow::{bail, ensure};
use rayon::prelude::*;
use toss::planner::Model;
use toss::{Answer, Choice, Error, InputError, Scene, Want};

use super::delivered::{Truth, true_probability};
use super::scenes::{self, TossScene};
use crate::measure::effort::Effort;

/// Seed of the scenes.
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
    /// The model that was chosen; `None` if the planner refused the scene because no setting is accurate enough, or the
    /// integrator does not solve its toss.
    pub model: Option<&'static Model>,
    /// The error of its answer.
    pub error: f64,
    /// The largest error of that model on the scene's family: its toss and, if the error there is far below the
    /// expected one, some similar tosses. The error on a single toss may be small by luck.
    pub error_of_family: f64,
    /// The error that the plan expected.
    pub expected: f64,
    /// The scene in words, its toss as hex floats.
    pub input: String,
}

/// All scenes of a run.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The results of the scenes.
    pub outcomes: Vec<Outcome>,
}

impl Trial {
    /// Solves a number of scenes that depends on `effort`.
    ///
    /// # Errors
    /// If a scene cannot be solved, except because its accuracy is out of reach or the integrator does not solve its toss.
    pub fn new(effort: Effort) -> anyhow::Result<Self> {
        let (tosses, spaces) = match effort {
            Effort::Quick => (1000, 6),
            Effort::Standard => (10_000, 24),
            Effort::Deep => (10_000, 100),
        };
        let tosses = (0..tosses).into_par_iter().map(|index| solve(&scenes::toss_scene(SEED, index)?));
        let mut outcomes: Vec<Outcome> = tosses.collect::<anyhow::Result<_>>()?;
        for index in 0..spaces {
            outcomes.push(solve_space(index)?);
        }
        Ok(Self { outcomes })
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
    fn is_within_30(&self, error: f64) -> bool {
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
        input: input(&scene.scene, &scene.case.hex()),
    };
    let choice = match scene.scene.plan() {
        Ok(decision) => decision.choice,
        Err(Error::Input(InputError::OutOfRange { field: "accuracy", .. }) | Error::Solve(_)) => return Ok(outcome),
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

/// Samples a space as planned.
fn solve_space(index: u64) -> anyhow::Result<Outcome> {
    const POINTS: u64 = 1 << 20;
    let space = scenes::space(SEED, index)?;
    let scene = Scene::new(Want::Probability(space), scenes::accuracy_of_a_probability(SEED, index));
    let planned = scene.plan()?.choice;
    let Answer::Probability(estimate) = planned.run(&scene)? else { bail!("a probability was planned") };
    let error = (estimate.probability - true_probability(&space, POINTS)?).abs();
    Ok(Outcome {
        kind: "probability",
        accuracy: scene.accuracy,
        model: Some(planned.model),
        error,
        error_of_family: error,
        expected: planned.expected_error,
        input: input(&scene, &format!("space {index} of seed {SEED}")),
    })
}

/// The largest error of a choice on tosses that are similar to the scene's; `None` if it fails on one.
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
