//! These checks compare every subject (a solver with its settings) on random launches with the 256-bit reference, and
//! the solvers with each other. Random launches show errors between the special cases that the other checks choose.

use toss::{Landing, SolveError};

use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::survey::Survey;

pub(super) const COS_TILT: Check = Check {
    id: "random-cos-tilt",
    claim: "On random launches, cos θ at landing differs from the 256-bit reference by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::COS_TILT,
    unit: "1",
    measure: |context| {
        let error = |reference: &Reference, landing: &Landing| reference.cos_tilt_error(landing.cos_tilt);
        against_reference(context, error, |allowance| allowance.cos_tilt)
    },
};

pub(super) const ATTITUDE: Check = Check {
    id: "random-attitude",
    claim: "On random launches, the attitude at landing differs from the 256-bit reference by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "rad",
    measure: |context| {
        let error = |reference: &Reference, landing: &Landing| reference.attitude_error(&landing.state.attitude);
        against_reference(context, error, |allowance| allowance.attitude)
    },
};

pub(super) const CROSS_METHOD: Check = Check {
    id: "cross-method-attitude",
    claim: "On random launches, the attitudes at landing of any two solvers with the same scheme, or of a closed form \
            and any other, differ by at most the bound.",
    basis: Basis::CrossMethod,
    judges: Judges::Solver,
    ceiling: 2.0 * ceiling::ATTITUDE,
    unit: "rad",
    measure: cross_method,
};

fn against_reference(
    context: &Context,
    error: fn(&Reference, &Landing) -> f64,
    allowed: fn(&Allowance) -> f64,
) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let measure = |(subject, landings): (&Subject, &Vec<Result<Landing, SolveError>>)| {
        let deviations = landings.iter().zip(&survey.references).map(|(landing, reference)| {
            landing.as_ref().map(|landing| error(reference, landing)).map_err(Clone::clone)
        });
        survey.largest(subject, landings, deviations, allowed)
    };
    Ok(context.subjects.iter().zip(&survey.landings).map(measure).collect())
}

fn cross_method(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let mut measurements = Vec::new();
    for (index, one) in context.subjects.iter().enumerate() {
        for (offset, other) in context.subjects[index + 1..].iter().enumerate() {
            let comparable = one.stepping == other.stepping || one.stepping.is_none() || other.stepping.is_none();
            if comparable {
                measurements.push(pair(survey, (index, one), (index + 1 + offset, other)));
            }
        }
    }
    Ok(measurements)
}

fn pair(survey: &Survey, (index, one): (usize, &Subject), (other_index, other): (usize, &Subject)) -> Measurement {
    let deviations = survey.landings[index].iter().zip(&survey.landings[other_index]).map(|pair| match pair {
        (Ok(a), Ok(b)) => Ok(a.state.attitude.angle_to(&b.state.attitude)),
        (Err(error), _) | (_, Err(error)) => Err(error.clone()),
    });
    // The two errors may add up, so the difference may be as large as the sum of both allowances.
    let allowed = |case: usize| -> Result<Option<f64>, SolveError> {
        let allowance = |subject, index: usize| survey.allowance(subject, &survey.landings[index], case);
        Ok(allowance(one, index)?.zip(allowance(other, other_index)?).map(|(one, other)| one.attitude + other.attitude))
    };
    let measurement = Measurement::largest_within(other, deviations, |index| survey.cases[index], allowed);
    Measurement { subject: format!("{} ~ {}", one.entry.name(), other.name), ..measurement }.beside(one)
}
