//! Estimates of probabilities.

use ::toss::defaults;
use ::toss::sampling::{self, Counts, Found, IntervalKind, Sampler, Space};
use ::toss::solvers::{IntegratedCounts, Proving};
use ::toss::{Answer, Backend, InputError, Scene, Stage, Want};
use exact::STAGES;
use pyo3::prelude::*;

use crate::errors::Failure;
use crate::plans::{Plan, accuracy, plan_of};
use crate::solver::{backend_of, prover_of};
use crate::space::space_of;
use crate::threads;
use crate::threads::threads_of;

/// The fields of `unfair_toss.Estimate`.
#[derive(IntoPyObject)]
pub(crate) struct Estimate {
    probability: Option<f64>,
    interval: Option<(f64, f64)>,
    interval_kind: String,
    points: u64,
    heads: Option<u64>,
    tails: Option<u64>,
    undecided: Option<u64>,
    certified: bool,
    proven_by: Option<Stages>,
    integrated_by: Option<Integrated>,
    plan: Plan,
}

/// The numbers of proven outcomes by the stage of the proof.
#[derive(IntoPyObject)]
struct Stages {
    f64: u64,
    double_double: u64,
    multiprecision: u64,
}

/// The numbers of outcomes proven by integration, by the stage of the proof.
#[derive(IntoPyObject)]
struct Integrated {
    coarse: u64,
    f64: u64,
    finest_tolerance: u64,
    double_double: u64,
    more_digits: u64,
}

impl Estimate {
    /// The same, of which each outcome is proven as these `counts` say.
    fn integrated(self, counts: &IntegratedCounts) -> Self {
        let [coarse, f64, finest_tolerance, double_double, more_digits] = Stage::ALL.map(|stage| counts.by(stage));
        let integrated_by = Integrated { coarse, f64, finest_tolerance, double_double, more_digits };
        Self { certified: counts.undecided == 0, integrated_by: Some(integrated_by), ..self }
    }
}

impl From<&sampling::Estimate> for Estimate {
    fn from(found: &sampling::Estimate) -> Self {
        let counts = if let Found::Counts(counts) = found.found { Some(counts) } else { None };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
        let by_stage = proven.map(|counts| STAGES.map(|stage| counts.by(stage)));
        let stages = |[f64, double_double, multiprecision]: [u64; 3]| Stages { f64, double_double, multiprecision };
        Self {
            probability: found.is_known().then_some(found.probability),
            interval: found.interval.map(|interval| <[f64; 2]>::from(interval).into()),
            interval_kind: found.interval_in_words(),
            points: found.points,
            heads: counts.map(|counts| counts.heads()),
            tails: counts.map(|counts| counts.tails()),
            undecided: counts.map(|counts| counts.undecided()),
            certified: proven.is_some() || found.interval_kind == IntervalKind::Proven,
            proven_by: by_stage.map(stages),
            integrated_by: None,
            plan: found.plan.into(),
        }
    }
}

/// The estimate of a plan, with outcomes by a solver.
#[pyfunction]
pub(crate) fn estimate_by_solver(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    plan: &Bound<'_, PyAny>,
    solver: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
    prove: bool,
) -> PyResult<Estimate> {
    let plan = plan_of(plan, &space)?;
    if prove {
        let proving = Proving::new(prover_of(solver)?).map_err(Failure::from)?;
        let pool = threads::pool(threads)?;
        let found = threads::aside(py, move |stop| {
            let progress = |_| stop.here();
            let found = pool.install(|| Sampler::by(&proving).on_progress(&progress).estimate(&space, plan))?;
            Ok(Estimate::from(&found).integrated(&proving.counts()))
        });
        return found;
    }
    let (backend, pool): (Backend, _) = (backend_of(solver)?, threads::pool(threads)?);
    let found = threads::aside(py, move |stop| {
        let progress = |_| stop.here();
        Ok(pool.install(|| backend.sampler().on_progress(&progress).estimate(&space, plan))?)
    });
    Ok((&found?).into())
}

/// The estimate by the plan that is cheapest for an error.
#[pyfunction]
pub(crate) fn estimate_by_accuracy(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    accuracy: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<Estimate> {
    let accuracy = accuracy.map(self::accuracy).transpose()?.unwrap_or_else(|| defaults::accuracy(&space));
    let (scene, pool) = (Scene::new(Want::Probability(space), accuracy), threads::pool(threads)?);
    let found = threads::aside(py, move |stop| {
        let progress = |_| stop.here();
        Ok(pool.install(|| scene.solve_with(&Sampler::exact().on_progress(&progress)))?)
    });
    match found? {
        Answer::Probability(found) => Ok((&*found).into()),
        _ => {
            let why = "the plan for this space is no sample";
            Err(Failure::from(InputError::OutsideModel { field: "accuracy", why }).into())
        }
    }
}
