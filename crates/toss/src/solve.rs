//! From a plan to the answer: the chosen model is run; a sample is doubled until its interval is within the accuracy.

use dynamics::certified::{by_f64, with_more_digits};
use dynamics::keller::{keller_cos_tilt, keller_outcome, keller_phase};
use dynamics::{
    Certificate, ExactSolver, InputError, Method, Settings, Solver, SolverEntry, Stage, State, Toss, Verdict, certain,
    certify, compensated_cos_tilt, compensated_landing,
};
use sampling::{Estimate, Plan, Rest, Scrambled, Space, estimate};

use crate::choice::{Choice, How};
use crate::model::Model;
use crate::scene::{Scene, SceneError, Want};
use crate::space_plan::no_integrator_for_a_space;
use crate::trace::{TracePoint, trace};

/// The answer to a scene, and the model that gave it.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The answer.
    pub answer: Answer,
    /// The model.
    pub model: Model,
}

/// What was wanted.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Heads or tails, and what it rests on.
    Outcome(Verdict),
    /// cos θ at landing.
    Tilt(f64),
    /// Attitude and body rate at landing.
    Attitude(State),
    /// The flight.
    Trace(Vec<TracePoint>),
    /// The probability of heads.
    Probability(Box<Estimate>),
}

impl Scene {
    /// Answers the scene by the model that [`Scene::plan`] chooses.
    ///
    /// # Errors
    /// [`SceneError`]: what the plan says, or what the solver says.
    #[inline]
    pub fn solve(&self) -> Result<Solution, SceneError> {
        match &self.want {
            Want::Outcome(toss) if self.by.is_none() && self.accuracy > 0.0 => Ok(Solution::of_outcome(certify(toss)?)),
            _ => self.solve_as_planned(),
        }
    }

    #[inline(never)]
    fn solve_as_planned(&self) -> Result<Solution, SceneError> {
        let choice = self.plan()?.choice;
        Ok(Solution { answer: choice.run(self)?, model: choice.model })
    }
}

impl Solution {
    /// The stages of a proof are the rungs for an outcome, so that to plan it is to answer it.
    #[inline]
    fn of_outcome(Certificate { outcome, stage }: Certificate) -> Self {
        let model = match stage {
            Stage::Certain => Model::Certain,
            Stage::Keller => Model::Keller,
            Stage::F64 => Model::Heads,
            Stage::DoubleDouble | Stage::Multiprecision => Model::HeadsExact,
        };
        Self { answer: Answer::Outcome(Verdict { outcome, proof: Some(stage) }), model }
    }
}

impl Choice {
    /// Answers `scene`, for which it was made.
    ///
    /// # Errors
    /// What the solver says; [`SceneError::Input`] for a scene of another kind than the one that it was made for.
    pub fn run(&self, scene: &Scene) -> Result<Answer, SceneError> {
        match (self.how, &scene.want) {
            (How::ClosedForm, Want::Outcome(toss)) => self.outcome(toss),
            (How::ClosedForm, Want::Tilt(toss)) => self.tilt(toss),
            (How::ClosedForm, Want::Attitude(toss)) => Ok(Answer::Attitude(compensated_landing(toss)?)),
            (How::ClosedForm, Want::Trace { toss, points }) => Ok(Answer::Trace(trace(&ExactSolver, toss, *points)?)),
            (How::Integrator(entry, method), want) => integrated(entry, method, want),
            (How::Sampling(plan), Want::Probability(space)) => {
                Ok(Answer::Probability(Box::new(sampled(space, plan, scene.accuracy)?)))
            }
            _ => Err(InputError::Malformed {
                field: "choice",
                value: self.model.name().to_owned(),
                expected: "one that was made for this scene",
            }
            .into()),
        }
    }

    /// The outcome by the chosen stage of its proof; by the others where that cannot tell.
    fn outcome(&self, toss: &Toss) -> Result<Answer, SceneError> {
        let (found, stage) = match self.model {
            Model::Certain => (certain(toss), Stage::Certain),
            Model::Keller => (keller_phase(toss).and_then(keller_outcome), Stage::Keller),
            Model::Heads => (by_f64(toss), Stage::F64),
            _ => (None, Stage::DoubleDouble),
        };
        let Certificate { outcome, stage } = match found {
            Some(outcome) => Certificate { outcome, stage },
            None => with_more_digits(toss)?,
        };
        Ok(Answer::Outcome(Verdict { outcome, proof: Some(stage) }))
    }

    fn tilt(&self, toss: &Toss) -> Result<Answer, SceneError> {
        let of_keller = if self.model == Model::KellerTilt { keller_cos_tilt(toss) } else { None };
        Ok(Answer::Tilt(match (of_keller, self.model) {
            (Some(cos_tilt), _) => cos_tilt,
            (None, Model::Tilt) => compensated_cos_tilt(toss)?,
            (None, _) => ExactSolver.cos_tilt(toss)?,
        }))
    }
}

fn integrated(entry: &SolverEntry, method: Method, want: &Want) -> Result<Answer, SceneError> {
    let solver = (entry.build)(&Settings { method, ..Settings::default() });
    Ok(match want {
        Want::Outcome(toss) => Answer::Outcome(solver.verdict(toss)?),
        Want::Tilt(toss) => Answer::Tilt(solver.cos_tilt(toss)?),
        Want::Attitude(toss) => Answer::Attitude(solver.propagate(toss)?.state),
        Want::Trace { toss, points } => Answer::Trace(trace(solver.as_ref(), toss, *points)?),
        Want::Probability(_) => return Err(no_integrator_for_a_space().into()),
    })
}

/// The estimate of `plan`, with twice the launches as long as its interval reaches beyond the accuracy.
fn sampled(space: &Space, plan: Plan, accuracy: f64) -> Result<Estimate, SceneError> {
    const MOST_LAUNCHES: u64 = 1 << 36;
    let found = estimate(space, plan, &ExactSolver, &|_| {})?;
    match (found.half_width(), doubled(plan)) {
        (Some(reached), Some(more)) if reached > accuracy => {
            if found.points >= MOST_LAUNCHES {
                return Err(SceneError::NotReached { points: found.points, reached, accuracy });
            }
            sampled(space, more, accuracy)
        }
        _ => Ok(found),
    }
}

/// The plan with twice the launches; `None` where nothing is sampled.
fn doubled(plan: Plan) -> Option<Plan> {
    let twice = |scrambled: Scrambled| Scrambled { points: 2 * scrambled.points, ..scrambled };
    match plan {
        Plan::Random { points, seed } => Some(Plan::Random { points: 2 * points, seed }),
        Plan::Sobol(scrambled) => Some(Plan::Sobol(twice(scrambled))),
        Plan::ExactSpeed(Rest::Sobol(scrambled)) => Some(Plan::ExactSpeed(Rest::Sobol(twice(scrambled)))),
        Plan::Grid | Plan::ExactSpeed(Rest::Grid) => None,
    }
}
