//! What is asked of one toss. Each function returns plain values, from which the Python layer makes a result.

use std::f64::consts::TAU;

use ::toss::sampling::{Cone, Interval, SameSide, Wobble, long_flight_cone, rate_ratio};
use ::toss::trace::trace_every;
use ::toss::{
    Backend, ExactMotion, Launch, Margin, SolveError, Solver, State, StepControl, Stepping, TAYLOR, TimeOfFlight, Toss,
    TracePoint, Work, certify, margin, speeds_of_heads,
};
use exact::motion::COS_TILT_ERROR;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::{body_of, coin_of};
use crate::errors::{Failure, malformed, refused};
use crate::given::{counts, number, optional_number};
use crate::planner::points_of;
use crate::solver::backend_of;
use crate::threads::{self, Stop};
use crate::toss::toss_of;

/// The phase (rad) and the number of equal steps up to which a landing is found so soon that no signal need be listened for.
const SHORT: f64 = 1e4;

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
pub(crate) fn land(
    py: Python<'_>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    solver: &Bound<'_, PyAny>,
) -> PyResult<Landing> {
    let backend = backend_of(solver)?;
    if is_short(&backend, &toss) {
        return Ok(py.detach(|| landing(&backend, &toss))?);
    }
    threads::aside(py, move |_| landing(&backend, &toss))
}

/// Whether a landing is found in some milliseconds at most.
fn is_short(backend: &Backend, toss: &Toss) -> bool {
    let time = toss.launch.flight_time();
    let steps = match backend.solver().stepping().map(|stepping| stepping.control()) {
        None => return toss.coin().is_some(),
        Some(StepControl::Tolerance(_)) => 0.0,
        Some(StepControl::Step(step)) => time / step,
    };
    let moments = toss.body.principal_moments();
    // A body precesses at a rate of at most its angular momentum over its smallest moment.
    steps <= SHORT && toss.launch.rate().norm() * time * (moments[2] / moments[0]) <= SHORT
}

fn landing(backend: &Backend, toss: &Toss) -> Result<Landing, Failure> {
    let solver = backend.solver();
    let landing = solver.land(toss)?;
    let (outcome, stage, estimate) = match backend {
        Backend::Exact(_) => {
            let certificate = certify(toss)?;
            let stage = certificate.is_proven().then(|| certificate.stage().name());
            (certificate.outcome(), stage, landing.error.map(of_state))
        }
        Backend::Solver(_) => (landing.outcome(), None, landing.error),
    };
    let Work { rhs_calls, accepted_steps, rejected_steps } = landing.work;
    let scheme = solver.stepping().map(|stepping| stepping.scheme().name());
    // The program prints no sign of a 0, either.
    let attitude = landing.state.attitude.components().map(|part| part + 0.0);
    Ok((
        (landing.cos_tilt + 0.0, outcome.name(), stage),
        (attitude, landing.state.rate.into()),
        (landing.norm_error, estimate),
        (rhs_calls, accepted_steps, rejected_steps),
        (solver.name().to_owned(), scheme),
    ))
}

/// Margins of the time of flight, the speed, gravity and the tilt; of the rates; and the ranges of rates and of earlier and
/// later times that were searched.
type Margins = ([Option<f64>; 4], [Option<f64>; 3], [f64; 3], [f64; 2]);

/// The nearest values that land the other way.
#[pyfunction]
pub(crate) fn margins(py: Python<'_>, #[pyo3(from_py_with = toss_of)] toss: Toss) -> PyResult<Margins> {
    let found = threads::aside(py, move |_| Ok(margin(&toss)?))?;
    let Margin { time, speed, gravity, tilt, rate, rate_range, time_range } = found;
    Ok(([time, speed, gravity, tilt], rate, rate_range, time_range))
}

/// The ranges of speed from `slowest` to that of the toss that land heads (m/s).
#[pyfunction]
pub(crate) fn intervals(
    py: Python<'_>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    slowest: &Bound<'_, PyAny>,
) -> PyResult<Vec<[f64; 2]>> {
    let slowest = number("slowest", slowest)?;
    let flight = toss.launch.time_of_flight();
    let (Some([fastest, _]), Some(from)) = (flight.throw(), flight.with_speed(slowest)) else {
        return Err(malformed("toss", "given by a time", "a toss with a speed, the fastest of the range"));
    };
    // The slowest throw has to reach the landing, too.
    Launch::new(toss.launch.rate(), from).map_err(|error| Failure::from(error).of("slowest [m/s]"))?;
    let valid = "below the speed of the toss";
    dynamics::error::require("slowest [m/s]", slowest, valid, slowest < fastest).map_err(Failure::from)?;
    let phase = ExactMotion::new(&toss).phase(toss.launch.time_of_flight()).map_err(Failure::from)?;
    let turns = phase / TAU;
    let valid = "at most 10000 turns; ask for a shorter range";
    dynamics::error::require("turns in flight", turns, valid, turns <= MOST_TURNS).map_err(Failure::from)?;
    let found = threads::aside(py, move |_| Ok(speeds_of_heads(&toss, slowest)?))?;
    Ok(found.unwrap_or_default())
}

/// k, Ω/ωz and ψ for which long flights from horizontal land heads with this probability.
#[pyfunction]
pub(crate) fn inverse(probability: &Bound<'_, PyAny>, body: &Bound<'_, PyAny>) -> PyResult<(f64, f64, f64)> {
    let coin = coin_of(&body_of(body)?.get().body, "the limit of long flights is that of bodies with I1 = I2")?;
    let (k, probability) = (coin.inertia_ratio(), number("probability", probability)?);
    let cone = long_flight_cone(probability).map_err(Failure::from)?;
    Ok((k, rate_ratio(probability, k).map_err(Failure::from)?, cone))
}

/// The rate of a coin whose normal goes round its angular momentum at `turn` (rad/s), at the angle `wobble` (rad).
#[pyfunction]
pub(crate) fn rate_of_precession(
    turn: &Bound<'_, PyAny>,
    wobble: &Bound<'_, PyAny>,
    body: &Bound<'_, PyAny>,
) -> PyResult<(f64, f64, f64)> {
    let coin = coin_of(&body_of(body)?.get().body, "the angle to the angular momentum is constant if I1 = I2")?;
    let (turn, wobble) = (number("turn", turn)?, number("wobble", wobble)?);
    let rate = dynamics::rate_of_precession(&coin, turn, wobble).map_err(Failure::from)?;
    Ok((rate.x, rate.y, rate.z))
}

/// Values of a wobble: the counts of all people; their share, and its interval for these flips; the mean over people with its
/// interval and what that means; the spread as deviation, interval, X² and p-value; the interval of a further person; k and
/// Ω/ωz; ψ with its interval; and these of each person alone, NaN where no wobble explains the counts.
type Wobbled = (
    ((u64, u64), (f64, Ends)),
    (f64, Ends, String),
    (Option<(f64, Ends, f64, f64)>, Option<Ends>),
    (f64, Option<f64>),
    Option<(f64, Ends)>,
    Vec<[f64; 3]>,
);

/// The ends of an interval.
type Ends = (f64, f64);

/// The ψ that explains how many of the tosses of each person landed on the side that had been up.
#[pyfunction]
pub(crate) fn wobble(
    py: Python<'_>,
    same_side: &Bound<'_, PyAny>,
    tosses: &Bound<'_, PyAny>,
    body: &Bound<'_, PyAny>,
) -> PyResult<Wobbled> {
    let coin = coin_of(&body_of(body)?.get().body, "the limit of long flights is that of bodies with I1 = I2")?;
    let (is_one, same, of) = (same_side.len().is_err(), counts("same_side", same_side)?, counts("tosses", tosses)?);
    if same.is_empty() {
        return Err(malformed("same_side", "nobody's", "the count of at least 1 person"));
    }
    if same.len() != of.len() {
        return Err(malformed("tosses", format!("{} for {} people", of.len(), same.len()), "as many as of same_side"));
    }
    let person = |(index, (same, tosses))| {
        let failed = |error| if is_one { Failure::from(error) } else { Failure::from(error).element(index) };
        SameSide::new(same, tosses).map_err(failed)
    };
    let people = (0..).zip(same.into_iter().zip(of)).map(person).collect::<Result<Vec<_>, _>>()?;
    let given = people.clone();
    let found = threads::aside(py, move |_| Ok(Wobble::of(&given)?))?;
    let k = coin.inertia_ratio();
    let ratio = (found.mean > 0.5).then(|| rate_ratio(found.mean, k)).transpose().map_err(Failure::from)?;
    let ends = |interval: Interval| (interval.lo, interval.hi);
    let alone = |person| {
        let cone = Wobble::of(&[person]).ok().and_then(|one| one.cone);
        cone.map_or([f64::NAN; 3], |Cone { angle, interval: [least, most] }| [angle, least, most])
    };
    let spread = found.spread.map(|spread| (spread.sd, ends(spread.interval), spread.chi2, spread.p_value));
    Ok((
        ((found.counts.same(), found.counts.tosses()), (found.share, ends(found.these_flips))),
        (found.mean, ends(found.interval), found.interval_kind),
        (spread, found.next_person.map(ends)),
        (k, ratio),
        found.cone.map(|cone| (cone.angle, cone.interval.into())),
        people.into_iter().map(alone).collect(),
    ))
}

/// A row of numbers for each time.
type Rows<'py> = Bound<'py, PyArray2<f64>>;

/// The flight at equally spaced times, as rows: time, attitude (4), angles (3), normal (3), face (3), cos θ.
#[pyfunction]
#[pyo3(signature = (toss, points, dt, solver))]
pub(crate) fn trace<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    points: Option<&Bound<'py, PyAny>>,
    dt: Option<&Bound<'py, PyAny>>,
    solver: &Bound<'py, PyAny>,
) -> PyResult<Rows<'py>> {
    if points.is_some() == dt.is_some() {
        return Err(refused(py, "trace needs points or dt, and not both", "points", None, "either points or dt"));
    }
    let backend = backend_of(solver)?;
    let (points, dt) = (points.map(points_of).transpose()?, optional_number("dt", dt)?);
    let flight = threads::aside(py, move |stop| {
        let solver = Stopping { solver: backend.solver(), stop };
        match (points, dt) {
            (Some(points), _) => Ok(::toss::trace(&solver, &toss, points)?),
            (None, dt) => Ok(trace_every(&solver, &toss, dt.unwrap_or(toss.launch.flight_time()))?),
        }
    })?;
    let rows: Vec<Vec<f64>> = flight.iter().map(row).collect();
    Ok(PyArray2::from_vec2(py, &rows)?)
}

/// A solver that ends when it is asked for a flight and its work is wanted no more.
struct Stopping<'a> {
    solver: &'a dyn Solver,
    stop: &'a Stop,
}

impl Solver for Stopping<'_> {
    fn name(&self) -> &str {
        self.solver.name()
    }

    fn stepping(&self) -> Option<Stepping> {
        self.solver.stepping()
    }

    fn land(&self, toss: &Toss) -> Result<::toss::Landing, SolveError> {
        self.stop.here();
        self.solver.land(toss)
    }
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
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    times: PyReadonlyArray1<'py, f64>,
    solver: &Bound<'py, PyAny>,
) -> PyResult<Solution<'py>> {
    let backend = backend_of(solver)?;
    let times = times.as_slice().map_err(|error| malformed("t_eval", error, "contiguous times"))?.to_vec();
    let (states, work, estimate) = threads::aside(py, move |stop| solved(&backend, &toss, &times, stop))?;
    let quaternion = |row: usize| states.iter().map(|state| state.attitude.components()[row]).collect();
    let rate = |row: usize| states.iter().map(|state| state.rate[row]).collect();
    let rows: Vec<Vec<f64>> = (0..4).map(quaternion).chain((0..3).map(rate)).collect();
    Ok((PyArray2::from_vec2(py, &rows)?, (work.rhs_calls, work.accepted_steps, work.rejected_steps), estimate))
}

/// The states at `times`, the work, and the error estimate at landing.
fn solved(
    backend: &Backend,
    toss: &Toss,
    times: &[f64],
    stop: &Stop,
) -> Result<(Vec<State>, Work, Option<f64>), Failure> {
    match backend {
        Backend::Exact(solver) => {
            let estimate = solver.tilt(toss)?.error.map(of_state);
            Ok((exactly(toss, times, stop)?, Work::default(), estimate))
        }
        Backend::Solver(solver) => {
            let (states, work) = by_legs(solver, toss, times, stop)?;
            Ok((states, work, error_estimate(solver, toss)?))
        }
    }
}

/// The error of cos θ of a state of the exact motion, from the `error` of its cos θ alone, which near 0 is smaller.
fn of_state(error: f64) -> f64 {
    error.max(COS_TILT_ERROR)
}

/// The error estimate of a flight from launch to landing. Only that of Taylor series takes the flight itself.
fn error_estimate(solver: &dyn Solver, toss: &Toss) -> Result<Option<f64>, SolveError> {
    match solver.stepping() {
        Some(stepping) if stepping.scheme() != TAYLOR => stepping.error_estimate(toss),
        _ => Ok(solver.tilt(toss)?.error),
    }
}

/// The states of the exact motion. At the landing its time of flight counts as it was given, not as it was rounded.
fn exactly(toss: &Toss, times: &[f64], stop: &Stop) -> Result<Vec<State>, Failure> {
    let motion = ExactMotion::new(toss);
    let state = |time: &f64| {
        stop.here();
        let landing = *time == toss.launch.flight_time();
        Ok(if landing { motion.state(toss.launch.time_of_flight()) } else { motion.state(*time) }?)
    };
    times.iter().map(state).collect()
}

/// The states by a solver that starts again from each of them.
fn by_legs(solver: &dyn Solver, toss: &Toss, times: &[f64], stop: &Stop) -> Result<(Vec<State>, Work), Failure> {
    let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
    let (mut last, mut work) = ((0.0, launch), Work::default());
    let mut states = Vec::with_capacity(times.len());
    for time in times {
        stop.here();
        let (since, from) = if solver.stepping().is_some() { last } else { (0.0, launch) };
        let leg = Toss { launch: Launch::from_state(&from, TimeOfFlight::Given(time - since))?, ..*toss };
        let done = solver.land(&leg).map_err(|error| error.later(since))?;
        work.rhs_calls += done.work.rhs_calls;
        work.accepted_steps += done.work.accepted_steps;
        work.rejected_steps += done.work.rejected_steps;
        states.push(done.state);
        last = (*time, done.state);
    }
    Ok((states, work))
}
