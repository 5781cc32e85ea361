//! Follows a flight at equally spaced times, for charts and for comparisons of solvers along the way. Point i of n is
//! at the time t = i T/(n - 1), where T is the time of flight and i goes from 0 to n - 1.
//!
//! BF is the body frame, whose z axis is the coin's normal n. LF is the laboratory frame, whose z axis ẑ points up; θ
//! is the angle between n and ẑ.

use dynamics::error::require;
use dynamics::{Attitude, Checked, Error, EulerAngles, InputError, Launch, Solver, State, TimeOfFlight, Toss, Vector3};
use exact::ExactMotion;

/// The largest number of points of a trace. A chart needs some hundreds.
pub const MOST_POINTS: usize = 1_000_000;

/// The coin at one time of its flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Time after launch (s).
    pub time: f64,
    /// Attitude (BF to LF).
    pub attitude: Attitude,
    /// Euler angles (rad), continuous over the flight.
    pub angles: EulerAngles,
    /// The coin's normal n (unit vector in LF).
    pub normal: Vector3<f64>,
    /// The body's x axis, which is fixed in the coin's face (unit vector in LF).
    pub face: Vector3<f64>,
    /// cos θ = n · ẑ.
    pub cos_tilt: f64,
}

/// The flight of `toss` by `solver` at `points` equally spaced times, launch and landing included.
///
/// An integrator starts from the previous point, a closed form from the launch. The attitude leaves the
/// branch of the Euler angles open; the one nearest to the exact motion is taken.
///
/// # Errors
/// [`Error::Input`] for fewer than 2 or more than [`MOST_POINTS`] points; else the error of the solver.
pub fn trace(solver: &dyn Solver, toss: &Toss, points: usize) -> Result<Vec<TracePoint>, Error> {
    require_points(points)?;
    #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
    let time = |index: usize| toss.launch.flight_time() * (index as f64 / (points - 1) as f64);
    trace_at(solver, toss, (0..points).map(time))
}

/// The flight of `toss` by `solver` every `step` seconds from launch on, and at landing.
///
/// # Errors
/// [`Error`]: a step that is not positive, or so small that there would be more than [`MOST_POINTS`] points; or what the
/// solver says.
pub fn trace_every(solver: &dyn Solver, toss: &Toss, step: f64) -> Result<Vec<TracePoint>, Error> {
    let landing = toss.launch.flight_time();
    let valid = "> 0 s, and at least a millionth of the time of flight";
    require("dt [s]", step, valid, step > 0.0 && landing / step < (MOST_POINTS - 2) as f64)?;
    let steps = (0_u32..).map(|index| f64::from(index) * step).take_while(|time| *time < landing);
    trace_at(solver, toss, steps.chain([landing]))
}

/// The flight of `toss` by `solver` at `times`, which ascend from 0.
fn trace_at(solver: &dyn Solver, toss: &Toss, times: impl Iterator<Item = f64>) -> Result<Vec<TracePoint>, Error> {
    let solver = Checked::new(solver);
    let motion = ExactMotion::new(toss);
    let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
    let mut last = (0.0, launch);
    let mut trace = Vec::with_capacity(times.size_hint().0);
    for time in times {
        let (since, from) = if solver.stepping().is_some() { last } else { (0.0, launch) };
        let leg = Toss { launch: Launch::from_state(&from, TimeOfFlight::Given(time - since))?, ..*toss };
        let state = solver.propagate(&leg).map_err(|error| error.later(since))?.state;
        trace.push(TracePoint::new(time, state.attitude, &motion.euler_angles(time)?));
        last = (time, state);
    }
    Ok(trace)
}

/// Checks the number of points.
///
/// # Errors
/// [`InputError`] for fewer than 2 or more than [`MOST_POINTS`] points.
pub(crate) fn require_points(points: usize) -> Result<(), InputError> {
    let malformed = || InputError::Malformed { field: "points", value: points.to_string(), expected: "2 to 1000000" };
    (2..=MOST_POINTS).contains(&points).then_some(()).ok_or_else(malformed)
}

impl TracePoint {
    fn new(time: f64, attitude: Attitude, branch: &EulerAngles) -> Self {
        Self {
            time,
            attitude,
            angles: EulerAngles::nearest(&attitude, branch),
            normal: attitude.normal(),
            face: attitude.body_to_lab(&Vector3::x()),
            cos_tilt: attitude.cos_tilt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Propagation, Settings, SolveError, Stepping};
    use exact::ExactSolver;

    use super::*;
    use crate::registry::Registry;

    #[test]
    fn every_solver_traces_the_exact_motion_with_continuous_angles() {
        let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.5)).unwrap();
        let toss = Toss { coin: Coin::PAPER, launch };
        let motion = ExactMotion::new(&toss);
        for entry in Registry::standard().entries() {
            let trace = trace(&entry.solver(&Settings::default()).unwrap(), &toss, 301).unwrap();
            assert_eq!((trace[0].time, trace[300].time), (0.0, 1.5));
            for point in &trace {
                assert!((point.cos_tilt - motion.cos_tilt(point.time).unwrap()).abs() < 1e-7, "{}", entry.name());
                let exact = motion.euler_angles(point.time).unwrap();
                assert!((point.angles.beta - exact.beta).abs() < 1e-6, "{} at {}", entry.name(), point.time);
                assert!(point.angles.attitude().angle_to(&point.attitude) < 1e-14);
                assert!(point.normal.dot(&point.face).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_trace_by_steps_of_time_ends_at_the_landing() {
        let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss { coin: Coin::PAPER, launch };
        let times = |step: f64| -> Vec<f64> {
            trace_every(&ExactSolver, &toss, step).unwrap().iter().map(|point| point.time).collect()
        };
        assert_eq!(times(0.3), [0.0, 0.3, 0.6, 0.3 * 3.0, 1.0]);
        assert_eq!((times(0.25), times(1.0)), (vec![0.0, 0.25, 0.5, 0.75, 1.0], vec![0.0, 1.0]));
        assert_eq!(times(7.0), [0.0, 1.0]);
        assert_eq!(trace_every(&ExactSolver, &toss, 0.25).unwrap(), trace(&ExactSolver, &toss, 5).unwrap());
        for step in [0.0, -0.1, f64::NAN, 1e-6] {
            assert_eq!(trace_every(&ExactSolver, &toss, step).unwrap_err().field(), Some("dt [s]"));
        }
        let still = Toss { launch: Launch::new(Vector3::x(), TimeOfFlight::Given(0.0)).unwrap(), ..toss };
        assert_eq!(trace_every(&ExactSolver, &still, 0.1).unwrap().len(), 1);
    }

    /// An integrator that fails in the middle of every leg but the first.
    struct Weary;
    impl Solver for Weary {
        fn name(&self) -> &str {
            "weary"
        }
        fn stepping(&self) -> Option<Stepping> {
            Some(Stepping::DEFAULT)
        }
        fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
            Ok(None)
        }
        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            if toss.launch.attitude() == Attitude::IDENTITY {
                return ExactSolver.propagate(toss);
            }
            Err(SolveError::NotFinite { time: toss.launch.flight_time() / 2.0 })
        }
    }

    #[test]
    fn the_error_of_a_later_leg_has_the_time_since_launch() {
        let launch = Launch::new(Vector3::new(0.0, 40.0, 3.0), TimeOfFlight::Given(2.0)).unwrap();
        let error = trace(&Weary, &Toss { coin: Coin::PAPER, launch }, 3).unwrap_err();
        assert_eq!(error, Error::Solve(SolveError::NotFinite { time: 1.5 }));
    }

    #[test]
    fn fewer_than_two_or_more_than_a_million_points_are_refused() {
        let launch = Launch::new(Vector3::x(), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss { coin: Coin::PAPER, launch };
        for points in [0, 1, MOST_POINTS + 1] {
            assert!(matches!(trace(&ExactSolver, &toss, points), Err(Error::Input(_))));
        }
    }
}
