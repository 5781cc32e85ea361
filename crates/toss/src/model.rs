//! The hierarchy of models that the planner chooses from, as a table with one row for each. A new model is a new row,
//! because the planner goes through the rows and treats them alike.
//!
//! A row says what its model assumes and gives, which question it answers and by which function. Its error and cost are
//! in the table of [`fitted`](crate::fitted). Bodies that are no coins have rows of their own, because their motion needs
//! elliptic functions; a question about a coin does not consider those.
//!
//! An outcome takes 15 to 35 ns and cos θ 60 ns. To look for a cheaper form would cost more than it saves, so there is
//! one model for an outcome, `outcome`, and one for cos θ to the last bits, `tilt`. The [proof](exact::certified) of an
//! outcome goes through stages of its own and says which of them decided.

use dynamics::coin::NO_COIN;
use dynamics::{Body, Error, InputError, RigidToss, Solver, Toss};
use exact::{ExactSolver, certify, certify_rigid, compensated_cos_tilt, compensated_landing};
use sampling::{Coordinate, Plan, Rest, Scrambled, Space};

use crate::answer::{Answer, Verdict};
use crate::reason::Reason;
use crate::scene::WantKind;
use crate::trace::trace;

/// A model of the hierarchy.
#[derive(Debug)]
pub struct Model {
    /// The name, as in `share-sobol`.
    pub name: &'static str,
    /// What it assumes of the question, in words.
    pub assumes: &'static str,
    /// What it computes, in words.
    pub gives: &'static str,
    /// For which bodies it is.
    pub(crate) of: Of,
    /// How it answers.
    pub(crate) kind: Kind,
}

/// The bodies that a model is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    /// Coins: bodies with I1 = I2.
    Coins,
    /// Bodies that are no coins.
    Others,
}

impl Of {
    /// Which of them `body` is.
    pub(crate) fn body(body: &Body) -> Self {
        if body.symmetric().is_some() { Self::Coins } else { Self::Others }
    }
}

/// The kind of a model, with the functions that answer.
#[derive(Debug)]
pub(crate) enum Kind {
    /// The exact motion in one of its forms.
    ClosedForm {
        /// The kind of question that it answers.
        serves: WantKind,
        /// Computes the answer for a toss; the number is that of the points of a trace.
        answer: fn(&RigidToss, usize) -> Result<Answer, Error>,
    },
    /// Any integrator with any of its schemes.
    Integrator,
    /// A sample of the launches of a space.
    Sample {
        /// The reason why it cannot answer for this space, if there is one.
        refuses: fn(&Space) -> Option<Reason>,
        /// Makes the plan from the number of launches and the seed.
        plan: fn(u64, u64) -> Plan,
    },
    /// The enclosure of the probability of a space. A plan never chooses it, because its cost is not known before.
    Enclosure,
}

const fn closed_form(
    name: &'static str,
    gives: &'static str,
    serves: WantKind,
    answer: fn(&RigidToss, usize) -> Result<Answer, Error>,
) -> Model {
    Model { name, assumes: "I1 = I2", gives, of: Of::Coins, kind: Kind::ClosedForm { serves, answer } }
}

/// The same model for the bodies that are no coins.
const fn of_others(model: Model) -> Model {
    Model { of: Of::Others, assumes: "I1 ≠ I2", ..model }
}

/// The coin's toss of a model for coins.
fn coin(toss: &RigidToss) -> Result<Toss, InputError> {
    toss.symmetric().ok_or(NO_COIN)
}

const fn sample(
    name: &'static str,
    assumes: &'static str,
    gives: &'static str,
    refuses: fn(&Space) -> Option<Reason>,
    plan: fn(u64, u64) -> Plan,
) -> Model {
    Model { name, assumes, gives, of: Of::Coins, kind: Kind::Sample { refuses, plan } }
}

/// All models: first those for a toss, then those for a space, both in the order of their cost, from the cheapest on,
/// with those for bodies that are no coins behind those for coins.
pub static MODELS: [Model; 18] = [
    closed_form("outcome", "outcome, proven", WantKind::Outcome, |toss, _| {
        Ok(Answer::Outcome(Verdict::Proven(certify(&coin(toss)?)?)))
    }),
    closed_form("tilt", "cos θ to the last bits", WantKind::Tilt, |toss, _| {
        Ok(Answer::Tilt(compensated_cos_tilt(&coin(toss)?)?))
    }),
    closed_form("attitude", "attitude and body rate to the last bits", WantKind::Attitude, |toss, _| {
        Ok(Answer::Attitude(compensated_landing(&coin(toss)?)?))
    }),
    closed_form("tilt-exact", "cos θ to the last bit", WantKind::Tilt, |toss, _| {
        Ok(Answer::Tilt(ExactSolver.cos_tilt(&coin(toss)?)?))
    }),
    closed_form("trace", "the flight at equally spaced times", WantKind::Trace, |toss, points| {
        Ok(Answer::Trace(trace(&ExactSolver, toss, points)?))
    }),
    Model {
        name: "integrator",
        assumes: "a tolerance",
        gives: "any of the above, as a cross-check",
        of: Of::Coins,
        kind: Kind::Integrator,
    },
    of_others(closed_form("body-outcome", "outcome, proven", WantKind::Outcome, |toss, _| {
        Ok(Answer::Outcome(Verdict::Proven(certify_rigid(toss)?)))
    })),
    of_others(closed_form("body-tilt", "cos θ to the last bit", WantKind::Tilt, |toss, _| {
        Ok(Answer::Tilt(ExactSolver.cos_tilt_rigid(toss)?))
    })),
    of_others(closed_form(
        "body-attitude",
        "attitude and body rate to the last bits",
        WantKind::Attitude,
        |toss, _| Ok(Answer::Attitude(ExactSolver.propagate_rigid(toss)?.state)),
    )),
    of_others(closed_form("body-trace", "the flight at equally spaced times", WantKind::Trace, |toss, points| {
        Ok(Answer::Trace(trace(&ExactSolver, toss, points)?))
    })),
    sample(
        "share",
        "that at most the speed is free",
        "probability, to rounding",
        |space| match free(space)[..] {
            _ if space.drop().is_some() => Some(Reason::HasDrop),
            [] | [Coordinate::Speed] => None,
            _ => Some(Reason::MoreIsFree),
        },
        |_, _| Plan::ExactSpeed(Rest::Grid),
    ),
    Model {
        name: "share-enclosure",
        assumes: "at most three free coordinates beside the speed",
        gives: "probability, proven",
        of: Of::Coins,
        kind: Kind::Enclosure,
    },
    sample(
        "share-sobol",
        "that the speed is free",
        "probability, with an interval",
        |space| match free(space).contains(&Coordinate::Speed) {
            _ if space.drop().is_some() => Some(Reason::HasDrop),
            true => None,
            false => Some(Reason::SpeedIsFixed),
        },
        |points, seed| Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, seed))),
    ),
    sample(
        "sobol",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Sobol(Scrambled::new(points, seed)),
    ),
    sample(
        "grid",
        "points on every free axis",
        "probability, without an error estimate",
        |_| Some(Reason::TellsNoError),
        |_, _| Plan::Grid,
    ),
    sample(
        "random",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Random { points, seed },
    ),
    of_others(sample(
        "body-sobol",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Sobol(Scrambled::new(points, seed)),
    )),
    of_others(sample(
        "body-random",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Random { points, seed },
    )),
];

fn free(space: &Space) -> Vec<Coordinate> {
    space.free().collect()
}

impl Model {
    /// The model called `name`.
    pub fn named(name: &str) -> Option<&'static Self> {
        MODELS.iter().find(|model| model.name == name)
    }

    /// Its index in [`MODELS`].
    pub fn place(&self) -> usize {
        MODELS.iter().position(|other| other == self).unwrap_or(MODELS.len())
    }

    /// Whether it is for bodies with I1 ≠ I2, and not for coins.
    pub fn is_for_other_bodies(&self) -> bool {
        self.of == Of::Others
    }

    /// Whether it is a closed form, which takes no steps and no samples.
    pub fn is_closed_form(&self) -> bool {
        matches!(self.kind, Kind::ClosedForm { .. })
    }

    /// The plan of `points` launches with this seed; `None` for a model that takes no samples.
    pub fn plan(&self, points: u64, seed: u64) -> Option<Plan> {
        if let Kind::Sample { plan, .. } = self.kind { Some(plan(points, seed)) } else { None }
    }
}

/// Two models are the same if they have the same name.
impl PartialEq for Model {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Model {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn model_names_are_unique() {
        for (place, model) in MODELS.iter().enumerate() {
            assert_eq!((model.place(), Model::named(model.name)), (place, Some(model)));
        }
        assert_eq!(Model::named("magic"), None);
    }
}
