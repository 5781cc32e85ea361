//! Choices of the planner as plain data, so that a program can plan once and run the choice later. The solver of a choice is
//! found in [`Registry::standard`].

use dynamics::error::{find_named, require};
use dynamics::{InputError, Stepping};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::choice::{Candidate, Choice, Decision, How};
use crate::model::{Kind, MODELS, Model};
use crate::plan::Solution;
use crate::reason::Reason;
use crate::registry::Registry;

/// A choice as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ChoiceData {
    model: String,
    expected_error: f64,
    expected_cost_ns: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    solver: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stepping: Option<Stepping>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sampling: Option<sampling::Plan>,
}

impl ChoiceData {
    /// How `model` is used, if the file has what the model needs and nothing else.
    fn how(&self, model: &Model) -> Result<How, InputError> {
        match (&model.kind, &self.solver, self.stepping, self.sampling) {
            (Kind::ClosedForm { .. }, None, None, None) => Ok(How::ClosedForm),
            (Kind::Integrator, Some(solver), Some(stepping), None) => {
                let entry = Registry::standard().named(solver)?;
                entry.scheme(stepping.scheme().name())?;
                Ok(How::Integrator(entry.clone(), stepping))
            }
            (Kind::Sample { .. }, None, None, Some(plan)) => Ok(How::Sampling(plan)),
            (Kind::Enclosure, None, None, Some(plan @ sampling::Plan::Enclosure { .. })) => Ok(How::Sampling(plan)),
            _ => Err(InputError::Malformed {
                field: "model",
                value: self.model.clone(),
                expected: "solver and stepping with an integrator, sampling with a sample, none of them with a closed form",
            }),
        }
    }
}

impl TryFrom<ChoiceData> for Choice {
    type Error = InputError;

    fn try_from(data: ChoiceData) -> Result<Self, InputError> {
        let model = find_named("model", &data.model, &MODELS, |model| model.name)?;
        let &ChoiceData { expected_error, expected_cost_ns, .. } = &data;
        require("expected_error", expected_error, "finite and >= 0", expected_error >= 0.0)?;
        require("expected_cost_ns [ns]", expected_cost_ns, "finite and >= 0", expected_cost_ns >= 0.0)?;
        Ok(Self { model, how: data.how(model)?, expected_error, expected_cost_ns })
    }
}

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        ChoiceData::deserialize(from)?.try_into().map_err(D::Error::custom)
    }
}

impl Serialize for Choice {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (solver, stepping, sampling) = match &self.how {
            How::ClosedForm => (None, None, None),
            How::Integrator(entry, stepping) => (Some(entry.name().to_owned()), Some(*stepping), None),
            How::Sampling(plan) => (None, None, Some(*plan)),
        };
        let &Self { model, expected_error, expected_cost_ns, .. } = self;
        ChoiceData { model: model.name.to_owned(), expected_error, expected_cost_ns, solver, stepping, sampling }
            .serialize(to)
    }
}

/// The reason in words.
impl Serialize for Reason {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

/// The name of the model, or `solver/scheme`.
impl Serialize for Candidate {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

/// `{ choice, passed_over }`, the latter a list of each model with the reason.
impl Serialize for Decision {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data<'a> {
            choice: &'a Choice,
            passed_over: &'a [(Candidate, Reason)],
        }
        Data { choice: &self.choice, passed_over: &self.passed_over }.serialize(to)
    }
}

/// `{ model, answer }`.
impl Serialize for Solution {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Data<'a> {
            model: &'static str,
            answer: &'a crate::answer::Answer,
        }
        Data { model: self.model.name, answer: &self.answer }.serialize(to)
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Toss};
    use sampling::Space;
    use serde_json::{Value, from_value, json, to_value};

    use super::*;
    use crate::scene::{Scene, Want};

    fn scenes() -> [Scene; 3] {
        let launch = Launch::new([9.0, 4.0, 3.0], TimeOfFlight::Given(1.5)).unwrap();
        let toss = Toss::new(Coin::PAPER, launch);
        let space = Space::builder(Coin::PAPER).rate_x(0.0..=50.0).rate_y(1.0).rate_z(3.0).speed(3.0..=5.0).build();
        [
            Scene::new(Want::Tilt(toss), 1e-9),
            Scene::new(Want::Attitude(toss), 1e-6).by("gamma", None),
            Scene::new(Want::Probability(space.unwrap()), 1e-3),
        ]
    }

    #[test]
    fn a_choice_that_was_read_back_gives_the_same_answer() {
        for scene in scenes() {
            let choice = scene.plan().unwrap().choice;
            let written = to_value(&choice).unwrap();
            let back: Choice = from_value(written.clone()).unwrap();
            assert_eq!(to_value(&back).unwrap(), written);
            assert_eq!(back.run(&scene), choice.run(&scene), "{written}");
        }
    }

    #[test]
    fn choices_that_no_planner_makes_are_refused_with_the_field_at_fault() {
        let [tilt, gamma, share] = scenes().map(|scene| to_value(scene.plan().unwrap().choice).unwrap());
        let changed = |choice: &Value, field: &str, value: Value| {
            let mut choice = choice.clone();
            choice[field] = value;
            from_value::<Choice>(choice).unwrap_err().to_string()
        };
        for (found, message) in [
            (changed(&tilt, "model", json!("magic")), "model = 'magic' is unknown; known: outcome, tilt"),
            (changed(&tilt, "solver", json!("gamma")), "model = 'tilt' can't be used"),
            (changed(&tilt, "expected_error", json!(-1.0)), "expected_error = -1.0 is outside"),
            (changed(&gamma, "solver", json!("delta")), "solver = 'delta' is unknown"),
            (changed(&gamma, "stepping", json!({ "scheme": "taylor" })), "scheme of this solver = 'taylor'"),
            (changed(&gamma, "sampling", json!({ "method": "grid" })), "model = 'integrator' can't be used"),
            (changed(&share, "sampling", json!(null)), "model = 'share-sobol' can't be used"),
            (changed(&share, "cost", json!(1)), "unknown field `cost`"),
        ] {
            assert!(found.starts_with(message), "{found}");
        }
    }

    #[test]
    fn decisions_and_solutions_are_written_with_their_reasons_and_answers() {
        let [tilt, gamma, _] = scenes();
        let decision = to_value(gamma.plan().unwrap()).unwrap();
        assert_eq!(decision["passed_over"][0], json!(["outcome", "an integrator was asked for"]));
        let solution = to_value(tilt.solve().unwrap()).unwrap();
        assert_eq!(solution["model"], "tilt");
        assert!(solution["answer"]["tilt"].is_f64(), "{solution}");
    }
}
