//! Estimates of probabilities, as plain values.

use ::toss::planner::How;
use ::toss::report::Estimate;
use ::toss::sampling::{self, Space};
use ::toss::{Answer, Backend, Choice, InputError, Registry, Scene, Want};
use pyo3::prelude::*;

use crate::errors::Failure;
use crate::plans::{Plan, accuracy, plan_of};
use crate::solver::backend_of;
use crate::space::space_of;
use crate::threads;
use crate::threads::threads_of;

/// Values of an estimate: the probability, its interval and what that means, the number of launches, the counts of heads,
/// tails and undecided, where they were counted, and by stage of the proof, where they are proven.
pub(crate) type Values =
    (Option<f64>, Option<(f64, f64)>, String, u64, Option<(u64, u64, u64)>, Option<Vec<(&'static str, u64)>>);

/// The values of an estimate that `plan` has `found`.
pub(crate) fn values(found: &sampling::Estimate, plan: sampling::Plan) -> Values {
    let Estimate { probability, interval, interval_kind, points, counts, proven_by, .. } = Estimate::new(found, plan);
    let counts = counts.map(|counts| (counts.heads(), counts.tails(), counts.undecided()));
    (probability, interval.map(Into::into), interval_kind, points, counts, proven_by)
}

/// The estimate of a plan, with outcomes by a solver.
#[pyfunction]
pub(crate) fn estimate_by_solver(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    #[pyo3(from_py_with = plan_of)] plan: sampling::Plan,
    solver: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<Values> {
    let (backend, pool): (Backend, _) = (backend_of(solver)?, threads::pool(threads)?);
    let found = threads::aside(py, move |stop| {
        let progress = |_| stop.here();
        Ok(pool.install(|| backend.sampler().on_progress(&progress).estimate(&space, plan))?)
    });
    Ok(values(&found?, plan))
}

/// The estimate by the plan that is cheapest for an error, and that plan.
#[pyfunction]
pub(crate) fn estimate_by_accuracy(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    #[pyo3(from_py_with = accuracy)] accuracy: f64,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<(Values, Plan)> {
    let (scene, pool) = (Scene::new(Want::Probability(space), accuracy), threads::pool(threads)?);
    let found = threads::aside(py, move |stop| {
        let progress = |_| stop.here();
        Ok(pool.install(|| scene.choose_and_run(Registry::standard(), &progress))?)
    });
    match found? {
        (Choice { how: How::Sampling(plan), .. }, Answer::Probability(found)) => {
            Ok((values(&found, plan), plan.into()))
        }
        _ => {
            let why = "the plan for this space is no sample";
            Err(Failure::from(InputError::OutsideModel { field: "accuracy", why }).into())
        }
    }
}
