//! Estimates of probabilities, as plain values.

use ::toss::sampling::{Counts, Estimate, Found};
use ::toss::{Answer, Backend, Choice, How, InputError, Registry, Scene, Stage, Want};
use pyo3::prelude::*;

use crate::errors::Failure;
use crate::plans::Plan;
use crate::solver::backend_of;
use crate::space::Space;
use crate::threads;

/// Values of an estimate: the probability, its interval and what that means, the number of launches, the counts of heads,
/// tails and undecided, where they were counted, and by stage of the proof, where they are proven.
pub(crate) type Values =
    (f64, Option<(f64, f64)>, String, u64, Option<(u64, u64, u64)>, Option<[u64; Stage::ALL.len()]>);

/// The values of an estimate.
pub(crate) fn values(found: &Estimate) -> Values {
    let counts = if let Found::Counts(counts) = found.found { Some(counts) } else { None };
    let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
    (
        found.probability,
        found.interval.map(|interval| (interval.lo, interval.hi)),
        found.interval_kind.to_string(),
        found.points,
        counts.map(|counts| (counts.heads(), counts.tails(), counts.undecided())),
        proven.map(|proven| Stage::ALL.map(|stage| proven.by(stage))),
    )
}

/// The estimate of a plan, with outcomes by a solver.
#[pyfunction]
pub(crate) fn estimate_by_solver(
    py: Python<'_>,
    space: &Space,
    plan: &Plan,
    solver: &Bound<'_, PyAny>,
    threads: Option<usize>,
) -> PyResult<Values> {
    let (backend, pool): (Backend, _) = (backend_of(solver)?, threads::pool(threads)?);
    let (space, plan) = (space.space, plan.plan);
    let found = py.detach(|| pool.install(|| backend.sampler().estimate(&space, plan)));
    Ok(values(&found.map_err(Failure::from)?))
}

/// The estimate by the plan that is cheapest for an error, and that plan.
#[pyfunction]
pub(crate) fn estimate_by_accuracy(
    py: Python<'_>,
    space: &Space,
    accuracy: f64,
    threads: Option<usize>,
) -> PyResult<(Values, Plan)> {
    let (scene, pool) = (Scene::new(Want::Probability(space.space), accuracy), threads::pool(threads)?);
    let run = || pool.install(|| scene.choose_and_run(Registry::standard()));
    match py.detach(run).map_err(Failure::from)? {
        (Choice { how: How::Sampling(plan), .. }, Answer::Probability(found)) => Ok((values(&found), plan.into())),
        _ => {
            let why = "the plan for this space is no sample";
            Err(Failure::from(InputError::OutsideModel { field: "accuracy", why }).into())
        }
    }
}
