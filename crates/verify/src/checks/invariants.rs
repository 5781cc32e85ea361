//! What a free coin conserves, from launch to landing of the random launches, computed from the integrated state.
//!
//! (a) |S|, (b) the kinetic energy and (c) n·S are the paper's checks. For (c), S at launch, fixed in TF, is carried into
//! the landed body by its attitude, because n·S as I3 ωz would hold by definition. Both frames then see the same number,
//! by two ways through the attitude; S as a vector is the stronger check.

use toss::body_rate::{angular_momentum, angular_momentum_tf, kinetic_energy};
use toss::{Propagation, SolveError, State, Toss, Vector3};

use crate::check::{Basis, Check};
use crate::context::Context;
use crate::measurement::Measurement;
use crate::subject::Subject;

pub(super) const MOMENTUM: Check = Check {
    id: "invariant-momentum",
    claim: "(a) |S| at landing is |S| at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        drift(context, |toss, launch, landing| {
            let [before, after] = [launch, landing].map(|state| angular_momentum(&toss.coin, &state.rate).norm());
            (after - before).abs() / before
        })
    },
};

pub(super) const ENERGY: Check = Check {
    id: "invariant-energy",
    claim: "(b) the kinetic energy at landing is that at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        drift(context, |toss, launch, landing| {
            let [before, after] = [launch, landing].map(|state| kinetic_energy(&toss.coin, &state.rate));
            (after - before).abs() / before
        })
    },
};

pub(super) const NORMAL_MOMENTUM_BODY: Check = Check {
    id: "invariant-normal-momentum-body",
    claim: "(c) n·S in the body frame is what it was at launch, relative to |S|",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        drift(context, |toss, launch, landing| {
            let momentum = angular_momentum_tf(&toss.coin, launch);
            let [before, after] = [launch, landing].map(|state| state.attitude.lab_to_body(&momentum));
            (after.z - before.z).abs() / momentum.norm()
        })
    },
};

pub(super) const NORMAL_MOMENTUM_TRANSPORT: Check = Check {
    id: "invariant-normal-momentum-transport",
    claim: "(c) n·S in the transport frame is what it was at launch, relative to |S|",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        drift(context, |toss, launch, landing| {
            let momentum: Vector3<f64> = angular_momentum_tf(&toss.coin, launch);
            let [before, after] = [launch, landing].map(|state| state.attitude.normal().dot(&momentum));
            (after - before).abs() / momentum.norm()
        })
    },
};

pub(super) const MOMENTUM_VECTOR: Check = Check {
    id: "invariant-momentum-vector",
    claim: "S in the transport frame, from rate and attitude at landing, is S at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| {
        drift(context, |toss, launch, landing| {
            let [before, after] = [launch, landing].map(|state| angular_momentum_tf(&toss.coin, state));
            (after - before).norm() / before.norm()
        })
    },
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
            Measurement::largest(subject, deviations, |index| survey.cases[index])
        };
        Ok(context.subjects.iter().zip(&survey.landings).map(row).collect())
    },
};

/// The largest `drift` of each subject between launch and landing of the random launches.
fn drift(context: &Context, drift: fn(&Toss, &State, &State) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let measure = |(index, subject): (usize, &Subject)| {
        let deviations = survey.cases.iter().zip(&survey.landings[index]).map(|(case, landing)| {
            let launch = State { attitude: case.toss.launch.attitude(), rate: case.toss.launch.rate() };
            landing.as_ref().map(|landing| drift(&case.toss, &launch, &landing.state)).map_err(Clone::clone)
        });
        Measurement::largest(subject, deviations, |index| survey.cases[index])
    };
    Ok(context.subjects.iter().enumerate().map(measure).collect())
}
