//! The planner: which model answers a question at the least cost.

use ::toss::{Choice, ExactSolver, How, Scene, StepControl, Want};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::errors::{Failure, malformed};
use crate::space::Space;
use crate::toss::Toss;

/// Values of a choice: the model, the solver and its scheme, the method of a sample, the tolerance of an integrator, the
/// launches of a sample, the expected error and cost (ns), and what was passed over and why.
type Values = (
    &'static str,
    String,
    Option<&'static str>,
    Option<&'static str>,
    Option<f64>,
    Option<u64>,
    (f64, f64),
    Vec<(String, String)>,
);

/// The cheapest model for a question.
#[pyfunction]
pub(crate) fn plan(
    want: &str,
    of: &Bound<'_, PyAny>,
    accuracy: f64,
    points: Option<usize>,
    solver: Option<&str>,
    scheme: Option<&str>,
) -> PyResult<Values> {
    let want = wanted(want, of, points)?;
    let mut scene = Scene::new(want, accuracy);
    match (solver, scheme) {
        (Some(solver), scheme) => scene = scene.by(solver, scheme),
        (None, Some(scheme)) => return Err(malformed("scheme", scheme, "a solver with it")),
        (None, None) => {}
    }
    let decision = scene.plan().map_err(Failure::from)?;
    let Choice { model, how, expected_error, expected_cost_ns } = &decision.choice;
    let passed_over = decision.passed_over.iter().map(|(model, why)| (model.to_string(), why.to_string())).collect();
    let costs = (*expected_error, *expected_cost_ns);
    let exact = ExactSolver::NAME.to_owned();
    Ok(match (how, &scene.want) {
        (How::Integrator(entry, stepping), _) => {
            let tolerance = match stepping.control() {
                StepControl::Tolerance(tolerance) => Some(tolerance),
                StepControl::Step(_) => None,
            };
            let scheme = Some(stepping.scheme().name());
            (model.name, entry.name().to_owned(), scheme, None, tolerance, None, costs, passed_over)
        }
        (How::Sampling(plan), Want::Probability(space)) => {
            // A quadrature chooses its shares as it goes, and has no number of them before.
            let points = plan.points(space).ok();
            (model.name, exact, None, Some(plan.method().name()), None, points, costs, passed_over)
        }
        _ => (model.name, exact, None, None, None, None, costs, passed_over),
    })
}

/// What is wanted of a toss or a space.
fn wanted(want: &str, of: &Bound<'_, PyAny>, points: Option<usize>) -> PyResult<Want> {
    if points.is_some() && want != "trace" {
        return Err(malformed("points", "given", "None: points are for a trace"));
    }
    if let Ok(space) = of.cast::<Space>() {
        return match want {
            "probability" => Ok(Want::Probability(space.get().space)),
            _ => Err(malformed("want", want, "probability, for a space")),
        };
    }
    let toss = of.cast::<Toss>().map_err(|_| PyTypeError::new_err("of: a Toss or a Space is expected"))?;
    let toss = toss.get().toss;
    match want {
        "outcome" => Ok(Want::Outcome(toss)),
        "tilt" => Ok(Want::Tilt(toss)),
        "attitude" => Ok(Want::Attitude(toss)),
        "trace" => Ok(Want::Trace { toss, points: points.unwrap_or(100) }),
        _ => Err(malformed("want", want, "outcome, tilt, attitude or trace, for a toss")),
    }
}
