//! The hierarchy of models that the planner chooses from, as a table with one row for each. A new model is a new row,
//! because the planner goes through the rows and treats them alike.
//!
//! A row says what its model assumes and gives, which question it answers and by which function, and how large its error
//! and its cost are. Bodies that are no coins have rows of their own, because their motion needs elliptic functions; a
//! question about a coin does not consider those.
//!
//! The errors are the largest that were met on random tosses and spaces, times 2. The costs are
//! those of one core of an AMD EPYC, measured on 2026-11-23. Integrators have neither: the planner
//! [flies](crate::Scene::plan) them.
//!
//! An outcome takes 15 to 35 ns and cos θ 60 ns. To look for a cheaper form would cost more than it saves, so there is
//! one model for an outcome, `outcome`, and one for cos θ to the last bits, `tilt`. The [proof](exact::certified) of an
//! outcome goes through stages of its own and says which of them decided.

use dynamics::coin::NO_COIN;
use dynamics::{Body, Error, Solver, Toss};
use exact::{ExactSolver, certify, compensated_cos_tilt, compensated_landing};
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
        if body.coin().is_some() { Self::Coins } else { Self::Others }
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
        answer: fn(&Toss, usize) -> Result<Answer, Error>,
        /// Its largest error, of cos θ or of the attitude (rad).
        error: f64,
        /// Its cost (ns); for a trace, the cost of each point.
        cost_ns: f64,
    },
    /// Any integrator with any of its schemes.
    Integrator,
    /// A sample of the launches of a space.
    Sample {
        /// The reason why it cannot answer for this space, if there is one.
        refuses: fn(&Space) -> Option<Reason>,
        /// Makes the plan from the number of launches and the seed.
        plan: fn(u64, u64) -> Plan,
        /// How large its error and its cost are; `None` without an error estimate, for what is never planned.
        fit: Option<Fit>,
    },
    /// The enclosure of the probability of a space, by so many [`CELLS`].
    Enclosure,
}

/// The error and the cost of a sample.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Fit {
    /// Of rounding alone, whatever the launches.
    Rounding {
        /// The largest error.
        error: f64,
        /// The cost (ns).
        cost_ns: f64,
    },
    /// Of N launches the error is `error` × N^-`power`, and the cost `cost_ns` + N `launch_ns`.
    Launches {
        /// What the error would be with a single launch.
        error: f64,
        /// The exponent with which it falls.
        power: f64,
        /// The cost without the launches (ns).
        cost_ns: f64,
        /// The cost of a launch (ns).
        launch_ns: f64,
    },
}

/// The cells of an enclosure to ± a: `first` × a^-`power` × (φ/[`USUAL_PHASE`])^`by_phase`, where φ is the largest phase at
/// landing. Each takes `cell_ns`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cells {
    /// What their number would be for an accuracy of 1.
    pub first: f64,
    /// The exponent with which it grows.
    pub power: f64,
    /// The exponent with which it grows with the phase.
    pub by_phase: f64,
    /// The cost of a cell (ns).
    pub cell_ns: f64,
}

/// The phase (rad) of most random spaces with rates of up to 70 rad/s, in which [`CELLS`] were counted.
pub(crate) const USUAL_PHASE: f64 = 50.0;

/// The cells of enclosures for each number of coordinates beside the speed: the medians of random spaces with accuracies from
/// 1e-2 to 1e-10, and how they grew where all rates were ten times as large.
pub(crate) const CELLS: [Cells; 4] = [
    Cells { first: 1.0, power: 0.0, by_phase: 0.0, cell_ns: 4000.0 },
    Cells { first: 8.0, power: 0.09, by_phase: 0.8, cell_ns: 6000.0 },
    Cells { first: 25.0, power: 0.42, by_phase: 1.7, cell_ns: 12_000.0 },
    Cells { first: 60.0, power: 0.75, by_phase: 2.6, cell_ns: 15_000.0 },
];

const fn closed_form(
    name: &'static str,
    gives: &'static str,
    serves: WantKind,
    [error, cost_ns]: [f64; 2],
    answer: fn(&Toss, usize) -> Result<Answer, Error>,
) -> Model {
    Model { name, assumes: "I1 = I2", gives, of: Of::Coins, kind: Kind::ClosedForm { serves, answer, error, cost_ns } }
}

/// The same model for the bodies that are no coins.
const fn of_others(model: Model) -> Model {
    Model { of: Of::Others, assumes: "I1 ≠ I2", ..model }
}

const fn sample(
    name: &'static str,
    assumes: &'static str,
    gives: &'static str,
    refuses: fn(&Space) -> Option<Reason>,
    plan: fn(u64, u64) -> Plan,
    fit: Option<Fit>,
) -> Model {
    Model { name, assumes, gives, of: Of::Coins, kind: Kind::Sample { refuses, plan, fit } }
}

/// All models: first those for a toss, then those for a space, both in the order of their cost, from the cheapest on,
/// with those for bodies that are no coins behind those for coins.
pub static MODELS: [Model; 18] = [
    closed_form("outcome", "outcome, proven", WantKind::Outcome, [0.0, 41.3], |toss, _| {
        Ok(Answer::Outcome(Verdict::Proven(certify(toss)?)))
    }),
    closed_form("tilt", "cos θ to the last bits", WantKind::Tilt, [7.62e-16, 87.2], |toss, _| {
        Ok(Answer::Tilt(compensated_cos_tilt(&toss.coin().ok_or(NO_COIN)?)?))
    }),
    closed_form(
        "attitude",
        "attitude and body rate to the last bits",
        WantKind::Attitude,
        [1.08e-15, 159.0],
        |toss, _| Ok(Answer::Attitude(compensated_landing(&toss.coin().ok_or(NO_COIN)?)?)),
    ),
    closed_form("tilt-exact", "cos θ to the last bit", WantKind::Tilt, [2.07e-16, 289.0], |toss, _| {
        Ok(Answer::Tilt(ExactSolver.tilt(toss)?.cos_tilt))
    }),
    closed_form("trace", "the flight at equally spaced times", WantKind::Trace, [1.13e-15, 958.0], |toss, points| {
        Ok(Answer::Trace(trace(&ExactSolver, toss, points)?))
    }),
    Model {
        name: "integrator",
        assumes: "a tolerance",
        gives: "a landing or a flight, as a cross-check",
        of: Of::Coins,
        kind: Kind::Integrator,
    },
    of_others(closed_form("body-outcome", "outcome, proven", WantKind::Outcome, [0.0, 2000.0], |toss, _| {
        Ok(Answer::Outcome(Verdict::Proven(certify(toss)?)))
    })),
    of_others(closed_form("body-tilt", "cos θ to the last bit", WantKind::Tilt, [1.11e-16, 5100.0], |toss, _| {
        Ok(Answer::Tilt(ExactSolver.tilt(toss)?.cos_tilt))
    })),
    of_others(closed_form(
        "body-attitude",
        "attitude and body rate to the last bits",
        WantKind::Attitude,
        [6.64e-16, 6340.0],
        |toss, _| Ok(Answer::Attitude(ExactSolver.land(toss)?.state)),
    )),
    of_others(closed_form(
        "body-trace",
        "the flight at equally spaced times",
        WantKind::Trace,
        [7.61e-16, 6620.0],
        |toss, points| Ok(Answer::Trace(trace(&ExactSolver, toss, points)?)),
    )),
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
        Some(Fit::Rounding { error: 2e-15, cost_ns: 1600.0 }),
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
        Some(Fit::Launches { error: 2.41, power: 1.01, cost_ns: 14100.0, launch_ns: 21.9 }),
    ),
    sample(
        "sobol",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Sobol(Scrambled::new(points, seed)),
        Some(Fit::Launches { error: 5.96, power: 0.64, cost_ns: 11900.0, launch_ns: 24.2 }),
    ),
    sample(
        "grid",
        "points on every free axis",
        "probability, without an error estimate",
        |_| None,
        |_, _| Plan::Grid,
        None,
    ),
    sample(
        "random",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Random { points, seed },
        Some(Fit::Launches { error: 3.05, power: 0.5, cost_ns: 1050.0, launch_ns: 4.24 }),
    ),
    of_others(sample(
        "body-sobol",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Sobol(Scrambled::new(points, seed)),
        Some(Fit::Launches { error: 4.01, power: 0.641, cost_ns: 8230.0, launch_ns: 2130.0 }),
    )),
    of_others(sample(
        "body-random",
        "nothing",
        "probability, with an interval",
        |_| None,
        |points, seed| Plan::Random { points, seed },
        Some(Fit::Launches { error: 2.04, power: 0.5, cost_ns: 180.0, launch_ns: 2110.0 }),
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

    /// Whether it is a closed form, which takes no steps and no samples.
    pub fn is_closed_form(&self) -> bool {
        matches!(self.kind, Kind::ClosedForm { .. })
    }

    /// The cost (ns) that a plan expects of a model whose cost no setting changes; for a trace, that of each point.
    pub fn cost_ns(&self) -> Option<f64> {
        match self.kind {
            Kind::ClosedForm { cost_ns, .. } | Kind::Sample { fit: Some(Fit::Rounding { cost_ns, .. }), .. } => {
                Some(cost_ns)
            }
            _ => None,
        }
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
