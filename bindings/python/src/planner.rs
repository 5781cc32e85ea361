//! The planner: which model answers a question at the least cost.

use ::toss::defaults::PLANNED_POINTS;
use ::toss::planner::{Decision, How};
use ::toss::{Scene, Want};
use pyo3::prelude::*;

use crate::errors::malformed;
use crate::given::{count, refused_value, text};
use crate::plans::{Plan, accuracy};
use crate::space::Space;
use crate::threads;
use crate::toss::Toss;

/// The fields of `unfair_toss.Choice`.
#[derive(IntoPyObject)]
pub(crate) struct Choice {
    model: &'static str,
    solver: String,
    scheme: Option<&'static str>,
    method: Option<&'static str>,
    tolerance: Option<f64>,
    points: Option<u64>,
    expected_error: f64,
    expected_cost_ns: f64,
    plan: Option<Plan>,
    passed_over: Vec<(String, String)>,
}

/// The cheapest model for a question.
#[pyfunction]
pub(crate) fn plan(
    py: Python<'_>,
    want: &Bound<'_, PyAny>,
    of: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = accuracy)] accuracy: f64,
    points: Option<&Bound<'_, PyAny>>,
    solver: Option<&Bound<'_, PyAny>>,
    scheme: Option<&Bound<'_, PyAny>>,
) -> PyResult<Choice> {
    let want = text("want", want, "outcome, tilt, attitude, trace or probability")?;
    let solver = solver.map(|solver| text("solver", solver, "the name of a solver")).transpose()?;
    let scheme = scheme.map(|scheme| text("scheme", scheme, "the name of a scheme")).transpose()?;
    let want = wanted(&want, of, points)?;
    let mut scene = Scene::new(want, accuracy);
    match (solver, scheme) {
        (Some(solver), scheme) => scene = scene.by(&solver, scheme.as_deref()),
        (None, Some(scheme)) => return Err(malformed("scheme", scheme, "a solver with it")),
        (None, None) => {}
    }
    let Decision { choice, passed_over } = threads::aside(py, move |_| Ok(scene.plan()?))?;
    Ok(Choice {
        model: choice.model.name,
        solver: choice.solver().to_owned(),
        scheme: choice.scheme(),
        method: choice.method(),
        tolerance: choice.tolerance(),
        points: choice.points,
        expected_error: choice.expected_error,
        expected_cost_ns: choice.expected_cost_ns,
        plan: if let How::Sampling(plan) = choice.how { Some(plan.into()) } else { None },
        passed_over: passed_over.iter().map(|(other, why)| (other.to_string(), why.to_string())).collect(),
    })
}

/// What may be wanted.
const WANTED: [&str; 5] = ["outcome", "tilt", "attitude", "trace", "probability"];

/// What is wanted of a toss or a space.
fn wanted(want: &str, of: &Bound<'_, PyAny>, points: Option<&Bound<'_, PyAny>>) -> PyResult<Want> {
    if !WANTED.contains(&want) {
        return Err(malformed("want", want, "outcome, tilt, attitude, trace or probability"));
    }
    if points.is_some() && want != "trace" {
        return Err(malformed("points", "given", "None: points are for a trace"));
    }
    if let Ok(space) = of.cast::<Space>() {
        return match want {
            "probability" => Ok(Want::Probability(space.get().space)),
            _ => Err(malformed("want", want, "probability, for a space")),
        };
    }
    let toss = of.cast::<Toss>().map_err(|_| refused_value("of", of, "a Toss or a Space"))?;
    let points = points.map(points_of).transpose()?;
    let toss = toss.get().toss;
    match want {
        "outcome" => Ok(Want::Outcome(toss)),
        "tilt" => Ok(Want::Tilt(toss)),
        "attitude" => Ok(Want::Attitude(toss)),
        "trace" => Ok(Want::Trace { toss, points: points.unwrap_or(PLANNED_POINTS) }),
        _ => Err(malformed("want", want, "outcome, tilt, attitude or trace, for a toss")),
    }
}

/// The number of points of a trace that an argument is. One beyond all memory is refused as too many.
pub(crate) fn points_of(value: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(usize::try_from(count("points", value)?).unwrap_or(usize::MAX))
}
