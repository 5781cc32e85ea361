//! What a free coin conserves, from launch to landing of the random launches, computed from the integrated state: (a) |S|,
//! (b) the kinetic energy and (c) n·S are the paper's checks.

use toss::{Propagation, SolveError, State, Toss};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::drift;
use crate::measure::measurement::Measurement;
use crate::measure::subject::Subject;

pub(super) const MOMENTUM: Check = Check {
    id: "invariant-momentum",
    claim: "(a) |S| at landing is |S| at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, drift::momentum),
};

pub(super) const ENERGY: Check = Check {
    id: "invariant-energy",
    claim: "(b) the kinetic energy at landing is that at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, drift::energy),
};

pub(super) const NORMAL_MOMENTUM_BODY: Check = Check {
    id: "invariant-normal-momentum-body",
    claim: "(c) n·S in the body frame is what it was at launch, relative to |S|",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, drift::normal_momentum_body),
};

pub(super) const NORMAL_MOMENTUM_TRANSPORT: Check = Check {
    id: "invariant-normal-momentum-transport",
    claim: "(c) n·S in the transport frame is what it was at launch, relative to |S|",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, drift::normal_momentum),
};

pub(super) const MOMENTUM_VECTOR: Check = Check {
    id: "invariant-momentum-vector",
    claim: "S in the transport frame, from rate and attitude at landing, is S at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, drift::momentum_vector),
};

pub(super) const PROJECTION: Check = Check {
    id: "invariant-projection",
    claim: "cos θ of a landing is that of its attitude, which has unit norm",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        let survey = context.survey()?;
        let off = |landing: &Propagation| {
            let norm = landing.state.attitude.components().iter().map(|part| part * part).sum::<f64>().sqrt();
            (norm - 1.0).abs().max((landing.cos_tilt - landing.state.attitude.cos_tilt()).abs())
        };
        let row = |(subject, landings): (&Subject, &Vec<Result<Propagation, SolveError>>)| {
            let deviations = landings.iter().map(|landing| landing.as_ref().map(off).map_err(Clone::clone));
            Measurement::largest(subject, deviations, |index| survey.cases[index], |allowance| allowance.attitude)
        };
        Ok(context.subjects.iter().zip(&survey.landings).map(row).collect())
    },
};

/// The largest `drift` of each subject between launch and landing of the random launches.
fn largest(context: &Context, drift: fn(&Toss, &State) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let row = |(subject, landings): (&Subject, &Vec<Result<Propagation, SolveError>>)| {
        let of_one = |(case, landing): (&Case, &Result<Propagation, SolveError>)| {
            landing.as_ref().map(|landing| drift(&case.toss, &landing.state)).map_err(Clone::clone)
        };
        let deviations = survey.cases.iter().zip(landings).map(of_one);
        Measurement::largest(subject, deviations, |index| survey.cases[index], |allowance| allowance.attitude)
    };
    Ok(context.subjects.iter().zip(&survey.landings).map(row).collect())
}
