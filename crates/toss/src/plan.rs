//! Plans a scene: finds the cheapest model that gives what is wanted within the accuracy, and answers by it. You don't
//! have to know the models, because their errors and costs decide.
//!
//! Closed forms are tried in the order of the table of [models](crate::model), from the cheapest on, and the first that
//! serves is taken. Integrators and samples have costs that depend on the scene, so all of them are compared. Integrators
//! are [flown](crate::integrators) for that.

use dynamics::error::require;
use dynamics::{Body, Error, InputError, Phases, Toss};
use exact::{ExactMotion, certify};
use sampling::Sampler;

use crate::answer::{Answer, Verdict};
use crate::choice::{Candidate, Choice, Decision, How, Offer};
use crate::integrators::{integrated, integrators};
use crate::model::{Kind, MODELS, Model, Of};
use crate::proofs::{plan as proof, run as proven};
use crate::reason::Reason;
use crate::registry::Registry;
use crate::samples::{is_missed, run, samples};
use crate::scene::{Integrator, Scene, Want};
use crate::trace::require_points;

impl Scene {
    /// The cheapest model that serves the scene, with the integrators of [`Registry::standard`].
    ///
    /// # Errors
    /// As for [`Scene::plan_with`].
    pub fn plan(&self) -> Result<Decision, Error> {
        self.plan_with(Registry::standard())
    }

    /// The cheapest model that serves the scene, with the integrators of `registry`. An integrator that the scene asks for
    /// flies at one tolerance after the other, from coarse to fine, until its answer is within the accuracy of the exact
    /// motion.
    ///
    /// # Errors
    /// [`Error::Input`] if the scene is invalid or no model is accurate enough; [`Error::Solve`] for a phase above 2^53
    /// rad, at which neighbouring inputs differ by whole turns, and for a toss that the integrator does not solve.
    pub fn plan_with(&self, registry: &Registry) -> Result<Decision, Error> {
        self.validate()?;
        if let Some(by) = self.by_proof() {
            return proof(registry, by, &self.want, self.accuracy);
        }
        match (self.want.toss(), &self.by) {
            (Some(toss), None) => self.first_closed_form(toss),
            (Some(toss), Some(by)) => {
                let of = Of::body(&toss.body);
                let passed_over = closed_forms(of).map(|model| (model.into(), Reason::NotAskedFor)).collect();
                let candidates = integrators(registry, Some(by), self)?;
                let failed = candidates.iter().find_map(|(_, offer)| match offer {
                    Err(Reason::Fails(error)) => Some(error.clone()),
                    _ => None,
                });
                let is_solved = candidates.iter().any(|(_, offer)| !matches!(offer, Err(Reason::Fails(_))));
                match (cheapest(passed_over, candidates), failed) {
                    (Some(decision), _) => Ok(decision),
                    (None, Some(error)) if !is_solved => Err(error),
                    (None, _) => Err(self.too_accurate("at least what the integrator reaches at its finest tolerance")),
                }
            }
            (None, _) => {
                let valid =
                    "at least what rounding leaves of a share of speeds or an enclosure, or 2^36 launches of a sample";
                cheapest(Vec::new(), samples(self)?).ok_or_else(|| self.too_accurate(valid))
            }
        }
    }

    /// The integrator that has to prove its answer, if the scene asks for one.
    fn by_proof(&self) -> Option<&Integrator> {
        self.by.as_ref().filter(|by| by.prove)
    }

    /// The offers of all models to the scene, in the order of [`MODELS`]. For a toss, all integrators of `registry` are
    /// among them, whether the scene asks for one or not. All of them are flown.
    ///
    /// # Errors
    /// As for [`Scene::plan_with`].
    pub fn candidates(&self, registry: &Registry) -> Result<Vec<(Candidate, Offer)>, Error> {
        self.validate()?;
        let Some(toss) = self.want.toss() else { return Ok(samples(self)?) };
        let of = Of::body(&toss.body);
        let closed_forms = closed_forms(of).map(|model| (model.into(), self.closed_form(model, of)));
        Ok(closed_forms.chain(integrators(registry, None, self)?).collect())
    }

    /// Answers the scene by the model that [`Scene::plan`] chooses. A model that turns out not to reach the accuracy for a
    /// space, by its rule or because of rounding, gives way to the next. Where there is no next one, an enclosure is the answer
    /// as far as it was proven; [`sampling::Estimate::is_wider_than_asked`] tells.
    ///
    /// # Errors
    /// The [`Error`] of the plan or of the solver; [`Error::NotReached`] if samples do not reach the accuracy.
    #[inline]
    pub fn solve(&self) -> Result<Answer, Error> {
        match &self.want {
            // A shortcut: an outcome has one model, and planning would cost more than the answer.
            Want::Outcome(toss @ Toss { body: Body::Coin(_), .. }) if self.by.is_none() && self.accuracy > 0.0 => {
                Ok(Answer::Outcome(Verdict::Proven(certify(toss)?)))
            }
            _ => self.solve_with(&Sampler::exact()),
        }
    }

    /// As [`Scene::solve`], with the `sampler` of a space, which decides by the exact motion. When it is
    /// [time to end](sampling::Sampler::until), the answer is the best estimate so far.
    ///
    /// # Errors
    /// As [`Scene::solve`]; [`Error::Ended`] if there is no estimate yet.
    #[inline(never)]
    pub fn solve_with(&self, sampler: &Sampler<'_>) -> Result<Answer, Error> {
        let mut choice = self.plan()?.choice;
        let Want::Probability(_) = self.want else { return choice.run(self) };
        let (mut failed, mut narrowest) = (Vec::new(), None);
        loop {
            failed.push(choice.model);
            let next = self.next(&failed)?;
            let found = choice.run_by(self, sampler, next.as_ref());
            match next.filter(|_| is_missed(&found) && !sampler.is_over()) {
                Some(next) => (choice, narrowest) = (next, found.ok().or(narrowest)),
                None => return found.or_else(|error| narrowest.ok_or(error)),
            }
        }
    }

    /// What is chosen for a space if the models that `failed` are left out.
    fn next(&self, failed: &[&Model]) -> Result<Option<Choice>, Error> {
        let others = samples(self)?.into_iter().filter(|(other, _)| !failed.contains(&other.model));
        Ok(cheapest(Vec::new(), others).map(|decision| decision.choice))
    }

    /// Checks the accuracy and the number of points. A toss and a space need no check: their types hold valid values
    /// only.
    fn validate(&self) -> Result<(), InputError> {
        require("accuracy", self.accuracy, "finite and > 0", self.accuracy > 0.0)?;
        if let Want::Trace { points, .. } = self.want { require_points(points) } else { Ok(()) }
    }

    fn first_closed_form(&self, toss: &Toss) -> Result<Decision, Error> {
        // No model has an answer beyond a phase of 2^53 rad; this returns the error.
        match toss.coin() {
            Some(_) => _ = Phases::new(toss)?,
            None => _ = ExactMotion::new(toss).phase(toss.launch.time_of_flight())?,
        }
        let of = Of::body(&toss.body);
        let mut passed_over = Vec::new();
        for model in closed_forms(of) {
            match self.closed_form(model, of) {
                Ok(choice) => return Ok(Decision { choice, passed_over }),
                Err(reason) => passed_over.push((model.into(), reason)),
            }
        }
        Err(self.too_accurate("at least 2.3e-16 for cos θ, 1.2e-15 rad for attitudes"))
    }

    fn too_accurate(&self, valid: &'static str) -> Error {
        InputError::OutOfRange { field: "accuracy", value: self.accuracy, valid }.into()
    }

    fn closed_form(&self, model: &'static Model, of: Of) -> Offer {
        if model.of != of {
            return Err(Reason::OnlyCoins);
        }
        let Kind::ClosedForm { serves, error, cost_ns, .. } = model.kind else { return Err(Reason::NotAskedFor) };
        if serves != self.want.kind() {
            return Err(Reason::GivesOnly(serves.words()));
        }
        if error > self.accuracy {
            return Err(Reason::TooRough { expected_error: error });
        }
        #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
        let expected_cost_ns = cost_ns * self.want.points() as f64;
        Ok(Choice { model, how: How::ClosedForm, expected_error: error, expected_cost_ns, points: None })
    }
}

impl Choice {
    /// Answers `scene`, for which this choice was made.
    ///
    /// # Errors
    /// The error of the solver; [`Error::Input`] for a scene that wants something else than the one planned.
    pub fn run(&self, scene: &Scene) -> Result<Answer, Error> {
        self.run_by(scene, &Sampler::exact(), None)
    }

    fn run_by(&self, scene: &Scene, sampler: &Sampler<'_>, next: Option<&Self>) -> Result<Answer, Error> {
        let expected = "one that was made for this scene";
        let other = || InputError::Malformed { field: "choice", value: self.model.name.to_owned(), expected };
        match (&self.how, &self.model.kind, &scene.want) {
            (How::ClosedForm, Kind::ClosedForm { serves, answer, .. }, want) if *serves == want.kind() => {
                answer(want.toss().ok_or_else(other)?, want.points())
            }
            (How::Proof(stepping), _, want) => proven(*stepping, want),
            (How::Integrator(entry, stepping), _, want) => integrated(entry, *stepping, want),
            (How::Sampling(plan), _, Want::Probability(space)) => {
                Ok(Answer::Probability(Box::new(run(sampler, space, *plan, (scene.accuracy, next))?)))
            }
            _ => Err(other().into()),
        }
    }
}

/// The models in closed form that are considered for these bodies: those for coins are passed over for the others.
fn closed_forms(of: Of) -> impl Iterator<Item = &'static Model> {
    MODELS.iter().filter(move |model| model.is_closed_form() && (model.of == Of::Coins || model.of == of))
}

/// Chooses the cheapest candidate that serves, and appends the others with their reasons to `passed_over`. `None` if no
/// candidate serves.
fn cheapest(
    mut passed_over: Vec<(Candidate, Reason)>,
    candidates: impl IntoIterator<Item = (Candidate, Offer)>,
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
