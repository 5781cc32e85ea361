//! What is asked of one toss. Each function returns plain values, from which the Python layer makes a result.

use std::f64::consts::TAU;

use ::toss::sampling::{long_flight_cone, rate_ratio};
use ::toss::{
    Backend, InputError, Launch, Margin, Outcome, RigidMargin, RigidMotion, RigidToss, Solver, State, TimeOfFlight,
    TracePoint, Work, certify_rigid, margin_rigid, rigid_speeds_of_heads, trace_every,
};
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::{body_of, coin_of};
use crate::errors::{Failure, malformed};
use crate::solver::backend_of;
use crate::toss::Toss;

/// The largest number of turns for which intervals are listed, with one interval each.
const MOST_TURNS: f64 = 10_000.0;

/// Values of a landing: cos θ, outcome, whether it is proven and by which stage, attitude, body rate, norm error, error
/// estimate of cos θ, calls, accepted and rejected steps, and the names of solver and scheme.
type Landing = (
    (f64, &'static str, Option<&'static str>),
    ([f64; 4], [f64; 3]),
    (f64, Option<f64>),
    (u64, u64, u64),
    (String, Option<&'static str>),
);

/// The landing of a toss by a solver.
#[pyfunction]
pub(crate) fn land(py: Python<'_>, toss: &Toss, solver: &Bound<'_, PyAny>) -> PyResult<Landing> {
    let (backend, toss) = (backend_of(solver)?, toss.toss);
    Ok(py.detach(|| landing(&backend, &toss))?)
}

fn landing(backend: &Backend, toss: &RigidToss) -> Result<Landing, Failure> {
    let solver = backend.solver();
    let landing = solver.propagate_rigid(toss)?;
    let (outcome, stage): (Outcome, _) = match backend {
        Backend::Exact(_) => {
            let certificate = certify_rigid(toss)?;
            (certificate.outcome(), certificate.is_proven().then(|| certificate.stage().name()))
        }
        Backend::Solver(solver) => (solver.outcome_at_rigid(toss, landing.cos_tilt)?, None),
    };
    let Work { rhs_calls, accepted_steps, rejected_steps } = landing.work;
    let scheme = solver.stepping().map(|stepping| stepping.scheme().name());
    // The program prints no sign of a 0, either.
    let attitude = landing.state.attitude.components().map(|part| part + 0.0);
    Ok((
        (landing.cos_tilt + 0.0, outcome.name(), stage),
        (attitude, landing.state.rate.into()),
        (landing.norm_error, solver.error_estimate_rigid(toss)?),
        (rhs_calls, accepted_steps, rejected_steps),
        (solver.name().to_owned(), scheme),
    ))
}

/// Margins of the time of flight, the speed, gravity and the tilt; of the rates; and the ranges of rates and of earlier and
/// later times that were searched.
type Margins = ([Option<f64>; 4], [Option<f64>; 3], [f64; 3], [f64; 2]);

/// The nearest values that land the other way.
#[pyfunction]
pub(crate) fn margins(py: Python<'_>, toss: &Toss) -> PyResult<Margins> {
    let toss = toss.toss;
    let RigidMargin { margin, time_range, .. } = py.detach(|| margin_rigid(&toss)).map_err(Failure::from)?;
    let Margin { time, speed, gravity, tilt, rate, rate_range } = margin;
    Ok(([time, speed, gravity, tilt], rate, rate_range, time_range))
}

/// The ranges of speed from `slowest` to that of the toss that land heads (m/s).
#[pyfunction]
pub(crate) fn intervals(py: Python<'_>, toss: &Toss, slowest: f64) -> PyResult<Vec<[f64; 2]>> {
    let toss = toss.toss;
    let (fastest, from) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, TimeOfFlight::Ballistic { speed: slowest, gravity }),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => {
            (speed, TimeOfFlight::BallisticTo { speed: slowest, gravity, drop })
        }
        _ => return Err(malformed("toss", "given by a time", "a toss with a speed, the fastest of the range")),
    };
    // The slowest throw has to reach the landing, too.
    Launch::new(toss.launch.rate(), from).map_err(Failure::from)?;
    let valid = "below the speed of the toss";
    dynamics::error::require("slowest [m/s]", slowest, valid, slowest < fastest).map_err(Failure::from)?;
    let phase = RigidMotion::new(&toss).phase(toss.launch.time_of_flight()).map_err(Failure::from)?;
    let turns = phase / TAU;
    let valid = "at most 10000 turns; ask for a shorter range";
    dynamics::error::require("turns in flight", turns, valid, turns <= MOST_TURNS).map_err(Failure::from)?;
    let found = py.detach(|| rigid_speeds_of_heads(&toss, slowest)).map_err(Failure::from)?;
    Ok(found.unwrap_or_default())
}

/// k, Ω/ωz and ψ for which long flights from horizontal land heads with this probability.
#[pyfunction]
pub(crate) fn inverse(probability: f64, body: &Bound<'_, PyAny>) -> PyResult<(f64, f64, f64)> {
    let coin = coin_of(&body_of(body)?.get().body, "the limit of long flights is that of bodies with I1 = I2")?;
    let k = coin.inertia_ratio();
    let cone = long_flight_cone(probability).map_err(Failure::from)?;
    Ok((k, rate_ratio(probability, k).map_err(Failure::from)?, cone))
}

/// A row of numbers for each time.
type Rows<'py> = Bound<'py, PyArray2<f64>>;

/// The flight at equally spaced times, as rows: time, attitude (4), angles (3), normal (3), face (3), cos θ.
#[pyfunction]
#[pyo3(signature = (toss, points, dt, solver))]
pub(crate) fn trace<'py>(
    py: Python<'py>,
    toss: &Toss,
    points: Option<usize>,
    dt: Option<f64>,
    solver: &Bound<'py, PyAny>,
) -> PyResult<Rows<'py>> {
    let backend = backend_of(solver)?;
    let toss = toss.toss;
    let flight = py.detach(|| match (points, dt) {
        (Some(points), None) => ::toss::trace(backend.solver(), toss, points).map_err(Failure::from),
        (None, Some(dt)) => trace_every(backend.solver(), toss, dt).map_err(Failure::from),
        _ => {
            let (field, expected) = ("points", "either points or dt");
            Err(InputError::Malformed { field, value: "given with dt, or neither".to_owned(), expected }.into())
        }
    })?;
    let rows: Vec<Vec<f64>> = flight.iter().map(row).collect();
    Ok(PyArray2::from_vec2(py, &rows)?)
}

/// The numbers of a point, without signs of 0, as the program prints them.
fn row(point: &TracePoint) -> Vec<f64> {
    let TracePoint { time, attitude, angles, normal, face, cos_tilt } = point;
    let mut row = vec![*time];
    row.extend(attitude.components());
    row.extend([angles.alpha, angles.beta, angles.gamma]);
    row.extend(normal.iter().chain(face.iter()));
    row.push(*cos_tilt);
    row.into_iter().map(|number| number + 0.0).collect()
}

/// Attitude and rate at each time as a column of 7, calls, accepted and rejected steps, and the error estimate at landing.
type Solution<'py> = (Rows<'py>, (u64, u64, u64), Option<f64>);

/// Attitude and rate at ascending times from launch to landing.
#[pyfunction]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    toss: &Toss,
    times: PyReadonlyArray1<'py, f64>,
    solver: &Bound<'py, PyAny>,
) -> PyResult<Solution<'py>> {
    let (backend, toss) = (backend_of(solver)?, toss.toss);
    let times = times.as_slice().map_err(|error| malformed("t_eval", error, "contiguous times"))?;
    let (states, work, estimate) = py.detach(|| solved(&backend, &toss, times))?;
    let out = PyArray2::zeros(py, [7, times.len()], false);
    {
        let mut out = out.try_readwrite().map_err(|error| malformed("y", error, "a new array"))?;
        let mut out = out.as_array_mut();
        for (column, state) in states.iter().enumerate() {
            let numbers = state.attitude.components().into_iter().chain(<[f64; 3]>::from(state.rate));
            numbers.enumerate().for_each(|(row, number)| out[[row, column]] = number);
        }
    }
    Ok((out, (work.rhs_calls, work.accepted_steps, work.rejected_steps), estimate))
}

/// The states at `times`, the work, and the error estimate at landing.
fn solved(backend: &Backend, toss: &RigidToss, times: &[f64]) -> Result<(Vec<State>, Work, Option<f64>), Failure> {
    let solver = backend.solver();
    let (states, work) = match backend {
        Backend::Exact(_) => (exactly(toss, times)?, Work::default()),
        Backend::Solver(solver) => by_legs(solver.as_ref(), toss, times)?,
    };
    Ok((states, work, solver.error_estimate_rigid(toss)?))
}

/// The states of the exact motion. At the landing its time of flight counts as it was given, not as it was rounded.
fn exactly(toss: &RigidToss, times: &[f64]) -> Result<Vec<State>, Failure> {
    let motion = RigidMotion::new(toss);
    let state = |time: &f64| {
        let landing = *time == toss.launch.flight_time();
        Ok(if landing { motion.state(toss.launch.time_of_flight()) } else { motion.state(*time) }?)
    };
    times.iter().map(state).collect()
}

/// The states by a solver that starts again from each of them.
fn by_legs(solver: &dyn Solver, toss: &RigidToss, times: &[f64]) -> Result<(Vec<State>, Work), Failure> {
    let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
    let (mut last, mut work) = ((0.0, launch), Work::default());
    let mut states = Vec::with_capacity(times.len());
    for time in times {
        let (since, from) = if solver.stepping().is_some() { last } else { (0.0, launch) };
        let leg = RigidToss { launch: Launch::from_state(&from, TimeOfFlight::Given(time - since))?, ..*toss };
        let done = solver.propagate_rigid(&leg).map_err(|error| error.later(since))?;
        work.rhs_calls += done.work.rhs_calls;
        work.accepted_steps += done.work.accepted_steps;
        work.rejected_steps += done.work.rejected_steps;
        states.push(done.state);
        last = (*time, done.state);
    }
    Ok((states, work))
}
