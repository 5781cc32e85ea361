//! What is asked of one toss. A struct becomes a dict, from which the Python layer makes the result of the same fields.

use std::f64::consts::TAU;

use ::toss::defaults::TRACE_POINTS;
use ::toss::quantity::Rounding;
use ::toss::report;
use ::toss::sampling::{Cone, Interval, Power, SameSide, SameSideBias, Spread, long_flight_cone, rate_ratio};
use ::toss::trace::{EnclosedPoint, Times, trace_enclosed};
use ::toss::{
    Backend, Error, ExactMotion, Launch, Margin, SolveError, Solver, Stage, State, StepControl, Stepping, TAYLOR,
    TimeOfFlight, Toss, Work, margin, speeds_of_heads,
};
use exact::motion::COS_TILT_ERROR;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::{body_of, coin_of};
use crate::errors::{Failure, malformed, refused};
use crate::given::{count, counts, number, object, optional_number};
use crate::planner::points_of;
use crate::solver::{backend_of, prover_of};
use crate::threads::{self, Stop};
use crate::toss::{Toss as Given, toss_of};

/// The phase (rad) and the number of equal steps up to which a landing is found so soon that no signal need be listened for.
const SHORT: f64 = 1e4;

/// The largest number of turns for which intervals are listed, with one interval each.
const MOST_TURNS: f64 = 10_000.0;

/// The fields of `unfair_toss.Landing`.
#[derive(IntoPyObject)]
pub(crate) struct Landing {
    outcome: &'static str,
    certified: bool,
    proven_by: Option<&'static str>,
    cos_tilt: f64,
    attitude: [f64; 4],
    rate: [f64; 3],
    flight_time: f64,
    norm_error: f64,
    error_estimate: Option<f64>,
    solver: String,
    scheme: Option<&'static str>,
    work: Cost,
}

/// The fields of `unfair_toss.Work`.
#[derive(IntoPyObject)]
pub(crate) struct Cost {
    rhs_calls: u64,
    accepted_steps: u64,
    rejected_steps: u64,
}

impl From<Work> for Cost {
    fn from(Work { rhs_calls, accepted_steps, rejected_steps }: Work) -> Self {
        Self { rhs_calls, accepted_steps, rejected_steps }
    }
}

/// The landing of a toss by a solver.
#[pyfunction]
pub(crate) fn land(py: Python<'_>, toss: &Bound<'_, PyAny>, solver: &Bound<'_, PyAny>) -> PyResult<Landing> {
    let given = object::<Given>("toss", toss, "a Toss")?.get();
    let (toss, rounding) = (given.toss, given.rounding());
    let backend = backend_of(solver)?;
    if is_short(&backend, &toss) {
        return Ok(py.detach(|| landing(&backend, &toss, &rounding))?);
    }
    threads::aside(py, move |_| landing(&backend, &toss, &rounding))
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

fn landing(backend: &Backend, toss: &Toss, rounding: &Rounding) -> Result<Landing, Failure> {
    let found = report::Landing::new(toss, backend)?.rounded(toss, rounding)?;
    let is_exact = matches!(backend, Backend::Exact(_));
    Ok(Landing {
        outcome: found.outcome.name(),
        certified: found.certified,
        proven_by: found.stage.filter(|_| found.certified).map(Stage::name),
        cos_tilt: found.cos_tilt,
        attitude: found.attitude,
        rate: found.rate,
        flight_time: found.flight_time,
        norm_error: found.norm_error,
        error_estimate: found.error_estimate.map(|error| if is_exact { of_state(error) } else { error }),
        solver: found.solver,
        scheme: found.scheme,
        work: found.work.into(),
    })
}

/// The fields of `unfair_toss.Margins`.
#[derive(IntoPyObject)]
pub(crate) struct Margins {
    time: Option<f64>,
    speed: Option<f64>,
    gravity: Option<f64>,
    tilt: Option<f64>,
    rate: (Option<f64>, Option<f64>, Option<f64>),
    rate_range: (f64, f64, f64),
    time_range: Ends,
}

/// The nearest values that land the other way.
#[pyfunction]
pub(crate) fn margins(py: Python<'_>, #[pyo3(from_py_with = toss_of)] toss: Toss) -> PyResult<Margins> {
    let found = threads::aside(py, move |_| Ok(margin(&toss)?))?;
    let Margin { time, speed, gravity, tilt, rate, rate_range, time_range } = found;
    let time_range = time_range.unwrap_or([f64::INFINITY; 2]).into();
    Ok(Margins { time, speed, gravity, tilt, rate: rate.into(), rate_range: rate_range.into(), time_range })
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

/// The rate of a coin whose normal goes round its angular momentum at `turn` (rad/s), at the angle ψ = `psi` to it (rad).
#[pyfunction]
pub(crate) fn rate_of_precession(
    turn: &Bound<'_, PyAny>,
    psi: &Bound<'_, PyAny>,
    body: &Bound<'_, PyAny>,
) -> PyResult<(f64, f64, f64)> {
    let coin = coin_of(&body_of(body)?.get().body, "the angle to the angular momentum is constant if I1 = I2")?;
    let (turn, psi) = (number("turn", turn)?, number("psi", psi)?);
    let rate = dynamics::rate_of_precession(&coin, turn, psi).map_err(Failure::from)?;
    Ok((rate.x, rate.y, rate.z))
}

/// The fields of `unfair_toss.Power`.
#[derive(IntoPyObject)]
pub(crate) struct PowerFields {
    flips_of_one: f64,
    people_needed: Option<f64>,
    flips_needed: Option<f64>,
    chance: Option<f64>,
    least_share: Option<f64>,
}

/// What it takes to see a same-side share.
#[pyfunction]
pub(crate) fn power(
    share: &Bound<'_, PyAny>,
    sd: &Bound<'_, PyAny>,
    power: &Bound<'_, PyAny>,
    people: Option<&Bound<'_, PyAny>>,
    flips: Option<&Bound<'_, PyAny>>,
) -> PyResult<PowerFields> {
    let wanted = Power::new(number("share", share)?, number("sd", sd)?, number("power", power)?);
    let wanted = wanted.map_err(Failure::from)?;
    #[expect(clippy::cast_precision_loss, reason = "at most 10^12")]
    let whole = |name, given: Option<&Bound<'_, PyAny>>, least, valid| {
        let Some(number) = given.map(|given| count(name, given)).transpose()? else { return Ok(None) };
        let is_valid = (least..=1_000_000_000_000).contains(&number);
        dynamics::error::require(name, number as f64, valid, is_valid).map_err(Failure::from)?;
        Ok::<_, PyErr>(Some(number as f64))
    };
    let people = whole("people", people, 2, "2 to 1e12")?;
    let flips = whole("flips", flips, 1, "1 to 1e12")?;
    let both = people.zip(flips);
    Ok(PowerFields {
        flips_of_one: wanted.flips_of_one(),
        people_needed: flips.map(|flips| wanted.people(flips)),
        flips_needed: people.and_then(|people| wanted.flips(people)),
        chance: both.map(|(people, flips)| wanted.chance(people, flips)),
        least_share: both.and_then(|(people, flips)| wanted.least_share(people, flips)),
    })
}

/// The fields of `unfair_toss.SameSideBias`. Of a person whom no ψ explains, the angles are NaN.
#[derive(IntoPyObject)]
pub(crate) struct SameSideBiasFields {
    same_side: u64,
    tosses: u64,
    probability: f64,
    these_flips: Ends,
    mean_over_people: f64,
    interval: Ends,
    interval_kind: String,
    spread: Option<PeopleSpread>,
    next_person: Option<Ends>,
    inertia_ratio: f64,
    rate_ratio: Option<f64>,
    cone_angle: Option<f64>,
    cone_angle_interval: Option<Ends>,
    each_cone_angle: Vec<f64>,
    each_cone_angle_interval: Vec<[f64; 2]>,
}

/// The fields of `unfair_toss.PeopleSpread`.
#[derive(IntoPyObject)]
struct PeopleSpread {
    sd: f64,
    interval: Ends,
    chi2: f64,
    p_value: f64,
}

/// The ends of an interval.
type Ends = (f64, f64);

/// The ψ that explains how many of the tosses of each person landed on the side that had been up.
#[pyfunction]
pub(crate) fn same_side_bias(
    py: Python<'_>,
    same_side: &Bound<'_, PyAny>,
    tosses: &Bound<'_, PyAny>,
    body: &Bound<'_, PyAny>,
) -> PyResult<SameSideBiasFields> {
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
    let found = threads::aside(py, move |_| Ok(SameSideBias::of(&given)?))?;
    let inertia_ratio = coin.inertia_ratio();
    let ratio = (found.mean > 0.5).then(|| rate_ratio(found.mean, inertia_ratio)).transpose();
    let ends = |interval: Interval| <[f64; 2]>::from(interval).into();
    let unexplained = Cone { angle: f64::NAN, interval: [f64::NAN; 2] };
    let alone = |person| SameSideBias::of(&[person]).ok().and_then(|one| one.cone).unwrap_or(unexplained);
    let each = people.into_iter().map(alone);
    let spread = |Spread { sd, interval, chi2, p_value }| PeopleSpread { sd, interval: ends(interval), chi2, p_value };
    Ok(SameSideBiasFields {
        same_side: found.counts.same(),
        tosses: found.counts.tosses(),
        probability: found.share,
        these_flips: ends(found.these_flips),
        mean_over_people: found.mean,
        interval: ends(found.interval),
        interval_kind: found.interval_kind,
        spread: found.spread.map(spread),
        next_person: found.next_person.map(ends),
        inertia_ratio,
        rate_ratio: ratio.map_err(Failure::from)?,
        cone_angle: found.cone.map(|cone| cone.angle),
        cone_angle_interval: found.cone.map(|cone| cone.interval.into()),
        each_cone_angle: each.clone().map(|cone| cone.angle).collect(),
        each_cone_angle_interval: each.map(|cone| cone.interval).collect(),
    })
}

/// A row of numbers for each time.
type Rows<'py> = Bound<'py, PyArray2<f64>>;

/// The flight at equally spaced times, as rows: time, attitude (4), angles (3), normal (3), face (3), cos θ; with proofs also
/// the bounds of the errors of cos θ and of the quaternion.
#[pyfunction]
#[pyo3(signature = (toss, points, dt, solver, prove))]
pub(crate) fn trace<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = toss_of)] toss: Toss,
    points: Option<&Bound<'py, PyAny>>,
    dt: Option<&Bound<'py, PyAny>>,
    solver: &Bound<'py, PyAny>,
    prove: bool,
) -> PyResult<Rows<'py>> {
    if points.is_some() && dt.is_some() {
        return Err(refused(py, "trace takes points or dt, and not both", "points", None, "either points or dt"));
    }
    let (points, dt) = (points.map(points_of).transpose()?, optional_number("dt", dt)?);
    let times = dt.map_or(Times::Number(points.unwrap_or(TRACE_POINTS)), Times::Every);
    if prove {
        let prover = prover_of(solver)?;
        let rows = threads::aside(py, move |stop| {
            let bounded = |point: Result<EnclosedPoint, Error>| -> Result<Vec<f64>, Failure> {
                stop.here();
                let EnclosedPoint { point, certificate } = point?;
                let bounds = [certificate.error_bound(), certificate.attitude_error_bound()];
                Ok(point.numbers().into_iter().chain(bounds).collect())
            };
            trace_enclosed(&prover, &toss, times)?.map(bounded).collect::<Result<Vec<_>, _>>()
        })?;
        return Ok(PyArray2::from_vec2(py, &rows)?);
    }
    let backend = backend_of(solver)?;
    let flight = threads::aside(py, move |stop| {
        let solver = Stopping { solver: backend.solver(), stop };
        Ok(::toss::trace(&solver, &toss, times)?)
    })?;
    let rows: Vec<Vec<f64>> = flight.iter().map(|point| point.numbers().into()).collect();
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

/// Attitude and rate at each time as a column of 7, the cost, and the error estimate at landing.
type Solution<'py> = (Rows<'py>, Cost, Option<f64>);

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
    Ok((PyArray2::from_vec2(py, &rows)?, work.into(), estimate))
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
