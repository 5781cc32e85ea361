//! From a scene to the cheapest model that serves it.
//!
//! The rungs of the [ladder](crate::model) are asked from the cheapest on whether they give what is wanted within the
//! accuracy, by the [record](crate::fitted) of what they were measured to do.

use dynamics::certified::by_f64;
use dynamics::error::require;
use dynamics::keller::{keller_outcome, keller_phase};
use dynamics::{InputError, SolveError, TiltTerms, Toss, certain};

use crate::choice::{Candidate, Choice, Decision, How, Offer, Reason};
use crate::fitted::{FITTED, Turn};
use crate::integrator_plan::{Aim, Flights, integrators};
use crate::model::Model;
use crate::scene::{Scene, SceneError, Want};
use crate::space_plan;
use crate::trace::require_points;

impl Scene {
    /// The cheapest model that serves the scene.
    ///
    /// # Errors
    /// [`SceneError::Input`] if the scene makes no sense or no model is that accurate; [`SceneError::Solve`] for a
    /// phase that is too large to mean anything.
    pub fn plan(&self) -> Result<Decision, SceneError> {
        self.validate()?;
        match (self.want.toss(), &self.by) {
            (Some(toss), None) => self.first_closed_form(toss),
            (Some(toss), Some(by)) => {
                let passed_over = CLOSED_FORMS.map(|model| (model.into(), Reason::NotAskedFor)).to_vec();
                let candidates = integrators(Some(by), self.flights(toss)?)?;
                let valid = "at least what the integrator reaches at its finest tolerance";
                cheapest(passed_over, candidates).ok_or_else(|| self.too_accurate(valid))
            }
            (None, _) => {
                let valid = "at least what rounding leaves of a share of speeds, or 2^36 launches of a sample";
                cheapest(Vec::new(), space_plan::candidates(self)?).ok_or_else(|| self.too_accurate(valid))
            }
        }
    }

    /// Every rung's answer to the scene, in the order of the ladder and whatever was asked for.
    ///
    /// # Errors
    /// As [`Scene::plan`].
    pub fn candidates(&self) -> Result<Vec<(Candidate, Offer)>, SceneError> {
        self.validate()?;
        let Some(toss) = self.want.toss() else { return Ok(space_plan::candidates(self)?.collect()) };
        let closed_forms = CLOSED_FORMS.map(|model| (model.into(), self.closed_form(model, toss)));
        Ok(closed_forms.into_iter().chain(integrators(None, self.flights(toss)?)?).collect())
    }

    /// A toss and a space are valid by themselves.
    fn validate(&self) -> Result<(), InputError> {
        require("accuracy", self.accuracy, "finite and > 0", self.accuracy > 0.0)?;
        if let Want::Trace { points, .. } = self.want { require_points(points) } else { Ok(()) }
    }

    fn first_closed_form(&self, toss: &Toss) -> Result<Decision, SceneError> {
        // No model says anything of a phase beyond 2^53.
        turn(toss)?;
        let mut passed_over = Vec::with_capacity(CLOSED_FORMS.len());
        for model in CLOSED_FORMS {
            match self.closed_form(model, toss) {
                Ok(choice) => return Ok(Decision { choice, passed_over }),
                Err(reason) => passed_over.push((model.into(), reason)),
            }
        }
        Err(self.too_accurate("at least 2.3e-16 for cos θ, 1.2e-15 rad for attitudes"))
    }

    fn too_accurate(&self, valid: &'static str) -> SceneError {
        InputError::OutOfRange { field: "accuracy", value: self.accuracy, valid }.into()
    }

    /// The flights that an integrator makes for the scene.
    fn flights(&self, toss: &Toss) -> Result<Flights, SceneError> {
        let aim = match self.want {
            Want::Outcome(_) => Aim::Outcome,
            Want::Tilt(_) => Aim::Tilt,
            Want::Trace { points, .. } => Aim::Trace(points.saturating_sub(1).max(1)),
            Want::Attitude(_) | Want::Probability(_) => Aim::Attitude,
        };
        Ok(Flights { turn: turn(toss)?, aim, accuracy: self.accuracy })
    }

    fn closed_form(&self, model: Model, toss: &Toss) -> Offer {
        let fit = FITTED.closed(model);
        let chosen = |expected_error: f64, points: usize| {
            #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
            let expected_cost_ns = fit.cost_ns * points as f64;
            Ok(Choice { model, how: How::ClosedForm, expected_error, expected_cost_ns })
        };
        let proven = |serves: bool, reason: Reason| if serves { chosen(0.0, 1) } else { Err(reason) };
        let measured = |points: usize| {
            let expected_error = fit.error;
            if expected_error <= self.accuracy {
                chosen(expected_error, points)
            } else {
                Err(Reason::TooRough { expected_error })
            }
        };
        match (model, &self.want) {
            (Model::Certain, Want::Outcome(_)) => proven(certain(toss).is_some(), Reason::NotCertain),
            (Model::Keller, Want::Outcome(_)) | (Model::KellerTilt, Want::Tilt(_)) if keller_phase(toss).is_none() => {
                Err(Reason::NotKellers)
            }
            (Model::Keller, Want::Outcome(_)) => {
                proven(keller_phase(toss).and_then(keller_outcome).is_some(), Reason::OnEdge)
            }
            (Model::Heads, Want::Outcome(_)) => proven(by_f64(toss).is_some(), Reason::OnEdge),
            (Model::HeadsExact, Want::Outcome(_)) => proven(true, Reason::OnEdge),
            (Model::KellerTilt | Model::Tilt | Model::TiltExact, Want::Tilt(_))
            | (Model::Attitude, Want::Attitude(_)) => measured(1),
            (Model::Trace, Want::Trace { points, .. }) => measured(*points),
            // cos θ too, but to no more digits than `tilt` and for more.
            (Model::Attitude, Want::Tilt(_)) => Err(Reason::TooRough { expected_error: fit.error }),
            (Model::Certain | Model::Keller | Model::Heads | Model::HeadsExact, _) => {
                Err(Reason::GivesOnly("the outcome"))
            }
            (Model::KellerTilt | Model::Tilt | Model::TiltExact, _) => Err(Reason::GivesOnly("cos θ")),
            _ => Err(Reason::GivesOnly("one landing")),
        }
    }
}

/// The rungs for a toss that take no steps, in the order of the ladder.
pub const CLOSED_FORMS: [Model; 9] = [
    Model::Keller,
    Model::Certain,
    Model::Heads,
    Model::KellerTilt,
    Model::Tilt,
    Model::Attitude,
    Model::TiltExact,
    Model::HeadsExact,
    Model::Trace,
];

/// How far the motion of `toss` turns.
fn turn(toss: &Toss) -> Result<Turn, SolveError> {
    use dynamics::exact::LARGEST_PHASE;
    let [precession, spin] = TiltTerms::new(toss).phases(toss.launch.flight_time());
    let phase = precession.max(spin);
    let in_range = phase <= LARGEST_PHASE;
    // A motion that does neither is as good as one that only precesses.
    let turn = Turn { phase, spin: if spin == 0.0 { 0.0 } else { spin / precession } };
    in_range.then_some(turn).ok_or(SolveError::PhaseTooLarge { phase })
}

/// The cheapest of the candidates that serve, and what is said of the others after `passed_over`.
fn cheapest(
    mut passed_over: Vec<(Candidate, Reason)>,
    candidates: impl Iterator<Item = (Candidate, Offer)>,
) -> Option<Decision> {
    let mut best: Option<(Candidate, Choice)> = None;
    let dearer = |choice: &Choice| Reason::Dearer { expected_cost_ns: choice.expected_cost_ns };
    for (candidate, offer) in candidates {
        match (offer, &best) {
            (Err(reason), _) => passed_over.push((candidate, reason)),
            (Ok(choice), Some((_, cheapest))) if choice.expected_cost_ns >= cheapest.expected_cost_ns => {
                passed_over.push((candidate, dearer(&choice)));
            }
            (Ok(choice), _) => {
                passed_over.extend(best.map(|(candidate, choice)| (candidate, dearer(&choice))));
                best = Some((candidate, choice));
            }
        }
    }
    best.map(|(_, choice)| Decision { choice, passed_over })
}
