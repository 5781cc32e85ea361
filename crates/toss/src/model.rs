//! The hierarchy of models: from what needs no motion to what integrates it, a row each.
//!
//! A row says what its model assumes and gives, which questions it serves and how it answers; its error and cost are in
//! the table of [`fitted`](crate::fitted). Nothing else knows the models one by one.
//!
//! For a single landing there is little to choose from: an outcome takes 15 to 35 ns, cos θ 60 ns. To look for a cheaper
//! form of these costs more than it saves, so `outcome` and `tilt` are one model each. The [proof](exact::certified) of
//! an outcome goes through its own stages, and says which of them decided.

use dynamics::{Error, Solver, Toss};
use exact::{ExactSolver, certify, compensated_cos_tilt, compensated_landing};
use sampling::{Coordinate, Plan, Rest, Scrambled, Space};

use crate::answer::{Answer, Verdict};
use crate::reason::Reason;
use crate::scene::WantKind;
use crate::trace::trace;

/// A model of the hierarchy.
#[derive(Debug)]
pub struct Model {
    /// Its name.
    pub name: &'static str,
    /// What it assumes.
    pub assumes: &'static str,
    /// What it gives.
    pub gives: &'static str,
    /// What it is.
    pub(crate) kind: Kind,
}

/// What a model is, and how it answers.
#[derive(Debug)]
pub(crate) enum Kind {
    /// The exact motion in one of its forms.
    ClosedForm {
        /// The wants that it serves.
        serves: WantKind,
        /// The answer for a toss; a trace has so many points.
        answer: fn(&Toss, usize) -> Result<Answer, Error>,
    },
    /// An integrator, by any of its schemes.
    Integrator,
    /// Launches of a space.
    Sample {
        /// Why it does not serve a space, if it does not.
        refuses: fn(&Space) -> Option<Reason>,
        /// The plan of so many launches with a seed.
        plan: fn(u64, u64) -> Plan,
    },
}

const fn closed_form(
    name: &'static str,
    gives: &'static str,
    serves: WantKind,
    answer: fn(&Toss, usize) -> Result<Answer, Error>,
) -> Model {
    Model { name, assumes: "nothing", gives, kind: Kind::ClosedForm { serves, answer } }
}

const fn sample(
    name: &'static str,
    assumes: &'static str,
    gives: &'static str,
    refuses: fn(&Space) -> Option<Reason>,
    plan: fn(u64, u64) -> Plan,
) -> Model {
    Model { name, assumes, gives, kind: Kind::Sample { refuses, plan } }
}

/// All models: those of a toss and those of a space, each from the cheapest on.
pub static MODELS: [Model; 11] = [
    closed_form("outcome", "outcome, proven", WantKind::Outcome, |toss, _| {
        Ok(Answer::Outcome(Verdict::Proven(certify(toss)?)))
    }),
    closed_form("tilt", "cos θ to the last bits", WantKind::Tilt, |toss, _| {
        Ok(Answer::Tilt(compensated_cos_tilt(toss)?))
    }),
    closed_form("attitude", "attitude and body rate to the last bits", WantKind::Attitude, |toss, _| {
        Ok(Answer::Attitude(compensated_landing(toss)?))
    }),
    closed_form("tilt-exact", "cos θ to the last bit", WantKind::Tilt, |toss, _| {
        Ok(Answer::Tilt(ExactSolver.cos_tilt(toss)?))
    }),
    closed_form("trace", "the flight at equal steps of time", WantKind::Trace, |toss, points| {
        Ok(Answer::Trace(trace(&ExactSolver, toss, points)?))
    }),
    Model {
        name: "integrator",
        assumes: "a tolerance",
        gives: "all of these, as a cross-check",
        kind: Kind::Integrator,
    },
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
        "probability, without an error",
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
];

fn free(space: &Space) -> Vec<Coordinate> {
    space.free().collect()
}

impl Model {
    /// The model called `name`.
    pub fn named(name: &str) -> Option<&'static Self> {
        MODELS.iter().find(|model| model.name == name)
    }

    /// Its place in [`MODELS`].
    pub fn place(&self) -> usize {
        MODELS.iter().position(|other| other == self).unwrap_or(MODELS.len())
    }

    /// Whether it takes no steps and no samples.
    pub fn is_closed_form(&self) -> bool {
        matches!(self.kind, Kind::ClosedForm { .. })
    }

    /// Its plan with so many launches and this seed; `None` for a model that samples nothing.
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
    fn every_model_has_a_name_of_its_own() {
        for (place, model) in MODELS.iter().enumerate() {
            assert_eq!((model.place(), Model::named(model.name)), (place, Some(model)));
        }
        assert_eq!(Model::named("magic"), None);
    }
}
