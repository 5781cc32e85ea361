//! The reference numbers: the paper's tosses, Kane's body, and flights at the corners of the model.

use toss::{SolveError, Solver};

use crate::check::{Basis, Check};
use crate::context::Context;
use crate::measurement::Measurement;
use crate::reference_data::ReferenceFlight;
use crate::subject::Subject;

pub(super) const COS_TILT: Check = Check {
    id: "reference-cos-tilt",
    claim: "cos θ at landing has the reference digits",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: cos_tilt,
};

pub(super) const ATTITUDE: Check = Check {
    id: "reference-attitude",
    claim: "the attitude at landing has the reference digits",
    basis: Basis::ClosedForm,
    unit: "rad",
    measure: attitude,
};

fn cos_tilt(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    Ok(over_flights(context, |solver, flight| Ok((solver.cos_tilt(&flight.case.toss)? - flight.cos_tilt).abs())))
}

fn attitude(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    Ok(over_flights(context, |solver, flight| {
        Ok(solver.propagate(&flight.case.toss)?.state.attitude.angle_to(&flight.attitude))
    }))
}

/// The largest deviation of each subject over the reference flights.
fn over_flights(
    context: &Context,
    deviation: impl Fn(&dyn Solver, &ReferenceFlight) -> Result<f64, SolveError>,
) -> Vec<Measurement> {
    let flights = &context.data.flights;
    let measure = |subject: &Subject| {
        let deviations = flights.iter().map(|flight| deviation(subject.solver.as_ref(), flight));
        Measurement::largest(subject, deviations, |index| flights[index].case)
    };
    context.subjects.iter().map(measure).collect()
}
