//! These checks compare every solver with the landings in `data/motion.toml`: the paper's tosses, Kane's body, and
//! flights at the corners of the model. These numbers come from outside the workspace, so an error which all our
//! code shares shows.

use toss::{SolveError, Solver};

use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::motions::ReferenceFlight;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;

pub(super) const COS_TILT: Check = Check {
    id: "reference-cos-tilt",
    claim: "On every reference flight, cos θ at landing differs from the reference number by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::COS_TILT,
    unit: "1",
    measure: cos_tilt,
};

pub(super) const ATTITUDE: Check = Check {
    id: "reference-attitude",
    claim: "On every reference flight, the attitude at landing differs from the reference attitude by at most the \
            bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "rad",
    measure: attitude,
};

fn cos_tilt(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let error = |solver: &dyn Solver, flight: &ReferenceFlight| {
        Ok((solver.tilt(&flight.case.toss.into())?.cos_tilt - flight.cos_tilt).abs())
    };
    Ok(over_flights(context, error, |allowance| allowance.cos_tilt))
}

fn attitude(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let error = |solver: &dyn Solver, flight: &ReferenceFlight| {
        Ok(solver.land(&flight.case.toss.into())?.state.attitude.angle_to(&flight.attitude))
    };
    Ok(over_flights(context, error, |allowance| allowance.attitude))
}

/// The largest deviation of each subject over the reference flights.
fn over_flights(
    context: &Context,
    deviation: impl Fn(&dyn Solver, &ReferenceFlight) -> Result<f64, SolveError>,
    allowed: fn(&Allowance) -> f64,
) -> Vec<Measurement> {
    let flights = &context.data.flights;
    let measure = |subject: &Subject| {
        let deviations = flights.iter().map(|flight| deviation(subject.solver.as_ref(), flight));
        Measurement::largest(subject, deviations, |index| flights[index].case, allowed)
    };
    context.subjects.iter().map(measure).collect()
}
