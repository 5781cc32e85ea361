//! These checks compare quantities that a free coin conserves, computed from the state at landing, with their values at
//! launch. They need no reference solution, and (a) to (c) are the checks that the paper itself applies: the length of
//! the angular momentum S, the kinetic energy, and n·S, where n is the coin's normal.

use toss::{CoinToss, Landing, SolveError, State};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::drift;
use crate::measure::measurement::Measurement;
use crate::measure::subject::Subject;

pub(super) const MOMENTUM: Check = Check {
    id: "invariant-momentum",
    claim: "(a) |S|, the length of the angular momentum, differs at landing from its value at launch by at most the \
            bound, relative to |S|.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| largest(context, drift::momentum),
};

pub(super) const ENERGY: Check = Check {
    id: "invariant-energy",
    claim: "(b) The kinetic energy differs at landing from its value at launch by at most the bound, relative to that \
            value.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| largest(context, drift::energy),
};

pub(super) const NORMAL_MOMENTUM_BODY: Check = Check {
    id: "invariant-normal-momentum-body",
    claim: "(c) n·S, the angular momentum S along the coin's normal n, computed in the body frame from the attitude \
            at landing, differs from its value at launch by at most the bound, relative to |S|.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| largest(context, drift::normal_momentum_body),
};

pub(super) const NORMAL_MOMENTUM_TRANSPORT: Check = Check {
    id: "invariant-normal-momentum-transport",
    claim: "(c) n·S, the angular momentum S along the coin's normal n, computed in the transport frame from the \
            attitude at landing, differs from its value at launch by at most the bound, relative to |S|.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| largest(context, drift::normal_momentum),
};

pub(super) const MOMENTUM_VECTOR: Check = Check {
    id: "invariant-momentum-vector",
    claim: "The angular momentum S as a vector in the transport frame, computed from rate and attitude at landing, \
            differs from its value at launch by at most the bound, relative to |S|.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| largest(context, drift::momentum_vector),
};

pub(super) const PROJECTION: Check = Check {
    id: "invariant-projection",
    claim: "The quaternion of the attitude at landing has norm 1, and cos θ at landing is the cos θ of that attitude, \
            each to within the bound.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::COS_TILT,
    unit: "1",
    measure: |context| {
        let survey = context.survey()?;
        let off = |landing: &Landing| {
            let norm = landing.state.attitude.components().iter().map(|part| part * part).sum::<f64>().sqrt();
            (norm - 1.0).abs().max((landing.cos_tilt - landing.state.attitude.cos_tilt()).abs())
        };
        let row = |(subject, landings): (&Subject, &Vec<Result<Landing, SolveError>>)| {
            let deviations = landings.iter().map(|landing| landing.as_ref().map(off).map_err(Clone::clone));
            survey.largest(subject, landings, deviations, |allowance| allowance.attitude)
        };
        Ok(context.subjects.iter().zip(&survey.landings).map(row).collect())
    },
};

/// The largest `drift` of each subject between launch and landing of the random launches.
fn largest(context: &Context, drift: fn(&CoinToss, &State) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let row = |(subject, landings): (&Subject, &Vec<Result<Landing, SolveError>>)| {
        let of_one = |(case, landing): (&Case, &Result<Landing, SolveError>)| {
            landing.as_ref().map(|landing| drift(&case.toss, &landing.state)).map_err(Clone::clone)
        };
        let deviations = survey.cases.iter().zip(landings).map(of_one);
        survey.largest(subject, landings, deviations, |allowance| allowance.attitude)
    };
    Ok(context.subjects.iter().zip(&survey.landings).map(row).collect())
}
