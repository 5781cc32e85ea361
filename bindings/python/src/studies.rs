//! Series, maps and comparisons. Each is asked of the library as the command line asks it, and given to the Python layer as the
//! same JSON.

use ::toss::defaults::{self, LAUNCHES_OF_A_NODE, LONG_FLIGHTS, REPLICATES, SEED, UP_TO};
use ::toss::planner::MODELS;
use ::toss::report::{self, Comparison, candidates};
use ::toss::sampling::{
    Coordinate, LongFlightLine, Method, MethodErrors, Sampler, Space, first_node, listed_cone_angles, map_nodes,
};
use ::toss::{Backend, ExactSolver, Formulation, Registry, Sensitivity, Solver as _, Stepping, Toss, Verdict};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use serde::Serialize;

use crate::body::{body_of, coin_of};
use crate::errors::{Failure, malformed};
use crate::given::{count, number, optional_number, text};
use crate::plans::{Plan, plan_of};
use crate::solver::{backend_of, prover_of};
use crate::space::space_of;
use crate::threads::{self, Stop, threads_of};
use crate::toss::toss_of;

/// A question to a sampler, on so many threads, as JSON.
fn asked<R: Serialize + Send + 'static>(
    py: Python<'_>,
    backend: Backend,
    threads: Option<u64>,
    question: impl FnOnce(&Sampler<'_>) -> Result<R, ::toss::Error> + Send + 'static,
) -> PyResult<String> {
    let pool = threads::pool(threads)?;
    let found = threads::aside(py, move |stop| {
        let (progress, over) = (|_| stop.here(), || stop.is_set());
        Ok(pool.install(|| question(&backend.sampler().on_progress(&progress).until(&over)))?)
    });
    json(&found?)
}

fn json(found: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(found).map_err(|error| malformed("answer", error, "numbers"))
}

/// A whole number, or what is usual.
fn count_or(name: &'static str, value: Option<&Bound<'_, PyAny>>, usual: u64) -> PyResult<u64> {
    value.map_or(Ok(usual), |value| count(name, value))
}

/// The same, within the range that the command line takes.
fn count_in(
    name: &'static str,
    value: Option<&Bound<'_, PyAny>>,
    usual: u64,
    [least, most]: [u64; 2],
    valid: &'static str,
) -> PyResult<u64> {
    let number = count_or(name, value, usual)?;
    if (least..=most).contains(&number) { Ok(number) } else { Err(malformed(name, number, valid)) }
}

fn seed(value: Option<&Bound<'_, PyAny>>) -> PyResult<u64> {
    value.map_or(Ok(SEED), crate::plans::seed)
}

/// The limit of long flights beside the shares among some.
#[pyfunction]
pub(crate) fn limit(
    py: Python<'_>,
    body: &Bound<'_, PyAny>,
    points: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    solver: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<String> {
    let coin = coin_of(&body_of(body)?.get().body, "the limit of long flights is that of bodies with I1 = I2")?;
    let wanted = (count_in("points", points, LONG_FLIGHTS, [1, u64::MAX], "at least 1")?, self::seed(seed)?);
    asked(py, backend_of(solver)?, threads, move |sampler| {
        Ok(LongFlightLine::list(&sampler.long_flight_shares(coin, &listed_cone_angles(), wanted)?))
    })
}

/// The largest spreads of a hand.
#[pyfunction]
pub(crate) fn spread(
    py: Python<'_>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    heads: &Bound<'_, PyAny>,
    points: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<String> {
    let space = Space::of(&toss).map_err(Failure::from)?;
    let (heads, seed) = (number("heads", heads)?, self::seed(seed)?);
    let points = points.map(|points| count_in("points", Some(points), 0, [8, 1 << 24], "8 to 16777216")).transpose()?;
    asked(py, exact()?, threads, move |sampler| sampler.spreads(&space, heads, points, seed))
}

/// A map of P(heads).
#[pyfunction]
#[pyo3(name = "map")]
pub(crate) fn map_of(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    across: &Bound<'_, PyAny>,
    up: &Bound<'_, PyAny>,
    plan: Option<&Bound<'_, PyAny>>,
    solver: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<String> {
    let named = |field, name: &Bound<'_, PyAny>| {
        Ok::<_, PyErr>(
            Coordinate::named_in(field, &text(field, name, "the name of a coordinate")?).map_err(Failure::from)?,
        )
    };
    let axes = [named("across", across)?, named("up", up)?];
    map_nodes(&space, axes).map_err(Failure::from)?;
    let node = first_node(&space, axes).map_err(Failure::from)?;
    let usual = Plan::of_method(Method::ExactSpeed);
    let plan = match plan {
        Some(plan) => crate::given::object::<Plan>("plan", plan, "a Plan")?.get().plan_of(&node, LAUNCHES_OF_A_NODE)?,
        None => usual.plan_of(&node, LAUNCHES_OF_A_NODE)?,
    };
    let pool = threads::pool(threads)?;
    let backend = backend_of(solver)?;
    let found = threads::aside(py, move |stop| {
        let (progress, over) = (|_| stop.here(), || stop.is_set());
        Ok(pool.install(|| backend.sampler().on_progress(&progress).until(&over).map(&space, axes, plan))?)
    });
    json(&report::Map::from(&found?))
}

/// The running shares of a grid and of random launches.
#[pyfunction]
pub(crate) fn convergence(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    steps: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    solver: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<String> {
    let points = space.grid_points().map_err(Failure::from)?;
    let (steps, seed) = (count_or("steps", steps, defaults::steps(points))?, self::seed(seed)?);
    asked(py, backend_of(solver)?, threads, move |sampler| sampler.running_shares(&space, steps, seed))
}

/// The errors of all methods.
#[pyfunction]
pub(crate) fn sampling_errors(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: Space,
    replicates: Option<&Bound<'_, PyAny>>,
    up_to: Option<&Bound<'_, PyAny>>,
    reference: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<String> {
    let replicates = count_in("replicates", replicates, REPLICATES, [1, 10_000], "1 to 10000")?;
    let up_to = count_in("up_to", up_to, UP_TO.into(), [8, 24], "8 to 24")?;
    let reference = optional_number("reference", reference)?;
    if let Some(given) = reference {
        let is_valid = (0.0..=1.0).contains(&given);
        dynamics::error::require("reference", given, "from 0 to 1", is_valid).map_err(Failure::from)?;
    }
    let wanted = MethodErrors { replicates, up_to: u32::try_from(up_to).unwrap_or(UP_TO), reference };
    asked(py, exact()?, threads, move |sampler| Ok(wanted.measure(sampler, &space)?.lines))
}

fn exact() -> PyResult<Backend> {
    Ok(Registry::standard().configured(&::toss::SolverConfig::new(ExactSolver::NAME)).map_err(Failure::from)?)
}

/// One toss by every solver and scheme.
#[pyfunction]
pub(crate) fn compare(
    py: Python<'_>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    rtol: Option<&Bound<'_, PyAny>>,
    step: Option<&Bound<'_, PyAny>>,
    formulation: &Bound<'_, PyAny>,
) -> PyResult<String> {
    let rtol = optional_number("rtol", rtol)?.unwrap_or(Stepping::DEFAULT_TOLERANCE);
    let step = optional_number("step", step)?.unwrap_or(Stepping::DEFAULT_STEP);
    let name = text("formulation", formulation, "the name of a formulation, or all")?;
    let formulation = if name == "all" { None } else { Some(Formulation::named(&name).map_err(Failure::from)?) };
    let registry = Registry::standard();
    let all = candidates(registry, rtol, step, formulation).map_err(Failure::from)?;
    let found = threads::aside(py, move |stop| {
        let exact = ExactSolver.land(&toss)?;
        let row = |config| {
            stop.here();
            Ok(Comparison::new(registry, config, &toss, &exact)?)
        };
        all.iter().map(row).collect::<Result<Vec<_>, Failure>>()
    });
    json(&found?)
}

/// How cos θ changes with the launch.
#[pyfunction]
pub(crate) fn sensitivity(py: Python<'_>, #[pyo3(from_py_with = toss_of)] toss: Toss) -> PyResult<String> {
    json(&threads::aside(py, move |_| Ok(Sensitivity::new(&toss)?))?)
}

/// A landing that is proven by integration, with the bounds of its errors.
#[pyfunction]
pub(crate) fn prove(py: Python<'_>, toss: &Bound<'_, PyAny>, solver: &Bound<'_, PyAny>) -> PyResult<String> {
    let given = crate::given::object::<crate::toss::Toss>("toss", toss, "a Toss")?.get();
    let (toss, rounding) = (given.toss, given.rounding());
    let solver = prover_of(solver)?;
    let found =
        threads::aside(py, move |_| Ok(report::Landing::integrated(&toss, &solver)?.rounded(&toss, &rounding)?));
    json(&found?)
}

/// The models from which the planner chooses: name, what it gives, and what it assumes.
#[pyfunction]
pub(crate) fn models() -> Vec<(&'static str, &'static str, &'static str, Option<f64>)> {
    MODELS.iter().map(|model| (model.name, model.gives, model.assumes, model.cost_ns())).collect()
}

/// Launches as rows of ωx, ωy, ωz, the speed, gravity, drop, tilt, time of flight and cos θ; their outcomes, and which are proven.
type Sample<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<bool>>);

/// Launches solved between two looks at whether they are still wanted.
const CHUNK: usize = 1 << 10;

/// The launches of a plan, each with its landing.
#[pyfunction]
pub(crate) fn sample<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = space_of)] space: Space,
    plan: &Bound<'py, PyAny>,
    solver: &Bound<'py, PyAny>,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<Sample<'py>> {
    let drawn = space.drawn(plan_of(plan, &space)?).map_err(Failure::from)?;
    let (backend, pool) = (backend_of(solver)?, threads::pool(threads)?);
    let rows = threads::aside(py, move |stop| pool.install(|| landed(drawn.flatten(), &backend, stop)))?;
    let numbers: Vec<Vec<f64>> = rows.iter().map(|(numbers, _)| numbers.to_vec()).collect();
    let outcomes = rows.iter().map(|(_, verdict)| crate::launches::sign(verdict.outcome())).collect();
    let proven = rows.iter().map(|(_, verdict)| verdict.is_proven()).collect();
    Ok((PyArray2::from_vec2(py, &numbers)?, PyArray1::from_vec(py, outcomes), PyArray1::from_vec(py, proven)))
}

fn landed(
    mut drawn: impl Iterator<Item = ::toss::sampling::Drawn>,
    backend: &Backend,
    stop: &Stop,
) -> Result<Vec<([f64; 9], Verdict)>, Failure> {
    let mut rows = Vec::new();
    loop {
        let first = rows.len() as u64;
        let chunk: Vec<_> = drawn.by_ref().take(CHUNK).collect();
        if chunk.is_empty() {
            return Ok(rows);
        }
        let one = |(index, drawn): (usize, &::toss::sampling::Drawn)| {
            stop.here();
            let landed = backend.landed(&drawn.toss);
            let (tilted, verdict) = landed.map_err(|error| Failure::from(error).at(first + index as u64))?;
            let [x, y, z, speed, gravity, tilt] = drawn.values;
            let drop = drawn.toss.launch.time_of_flight().drop().unwrap_or(0.0);
            Ok(([x, y, z, speed, gravity, drop, tilt, drawn.toss.launch.flight_time(), tilted.cos_tilt], verdict))
        };
        let solved: Vec<Result<_, Failure>> =
            chunk.par_iter().enumerate().map(|(index, drawn)| one((index, drawn))).collect();
        for row in solved {
            rows.push(row?);
        }
    }
}
