//! Tests of traces by every solver, of coins and bodies.

use dynamics::{Body, Coin, Landing, Settings, Stepping};
use exact::{CoinMotion, ExactMotion, ExactSolver};

use super::*;
use crate::registry::Registry;

#[test]
fn every_solver_traces_the_exact_motion_with_continuous_angles() {
    let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.5)).unwrap();
    let toss = Toss::new(Coin::PAPER, launch);
    let motion = CoinMotion::new(&toss.coin().unwrap());
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
fn a_body_of_three_moments_is_traced_with_angles_that_do_not_jump() {
    for (tilt, time) in [(0.0, 1.5), (1.2, 3.0)] {
        let thrown = Launch::new([0.3, 9.0, 0.2], TimeOfFlight::Given(time)).unwrap();
        let body = Body::from_moments([0.00121, 0.01638, 0.01748]).unwrap();
        let toss = Toss { body, launch: thrown.with_tilt(tilt).unwrap() };
        let motion = ExactMotion::new(&toss);
        let trace = trace(&ExactSolver, &toss, 301).unwrap();
        for point in &trace {
            assert!((point.cos_tilt - motion.cos_tilt(point.time).unwrap()).abs() < 1e-14);
            assert!(point.angles.attitude().angle_to(&point.attitude) < 1e-14);
        }
        for pair in trace.windows(2) {
            let [before, after] = [&pair[0].angles, &pair[1].angles];
            assert!((after.beta - before.beta).abs() < 0.2, "{pair:?}");
            let [alpha, gamma] = [after.alpha - before.alpha, after.gamma - before.gamma];
            // Where n is near the vertical, α and γ turn fast against each other, and only their sum (n up) or
            // difference (n down) is smooth.
            let smooth = if after.beta.cos() > 0.0 { alpha + gamma } else { alpha - gamma };
            assert!(smooth.abs() < 1.0, "{pair:?}");
            let near_the_vertical = before.beta.sin().min(after.beta.sin()) < 0.1;
            assert!(near_the_vertical || alpha.abs().max(gamma.abs()) < 1.0, "{pair:?}");
        }
    }
}

#[test]
fn a_trace_by_steps_of_time_ends_at_the_landing() {
    let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.0)).unwrap();
    let toss = Toss::new(Coin::PAPER, launch);
    let times = |step: f64| -> Vec<f64> {
        trace(&ExactSolver, &toss, Times::Every(step)).unwrap().iter().map(|point| point.time).collect()
    };
    assert_eq!(times(0.3), [0.0, 0.3, 0.6, 0.3 * 3.0, 1.0]);
    assert_eq!((times(0.25), times(1.0)), (vec![0.0, 0.25, 0.5, 0.75, 1.0], vec![0.0, 1.0]));
    assert_eq!(times(7.0), [0.0, 1.0]);
    assert_eq!(trace(&ExactSolver, &toss, Times::Every(0.25)).unwrap(), trace(&ExactSolver, &toss, 5).unwrap());
    for step in [0.0, -0.1, f64::NAN, 1e-6] {
        assert_eq!(trace(&ExactSolver, &toss, Times::Every(step)).unwrap_err().field(), Some("dt [s]"));
    }
    let still = Toss { launch: Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(0.0)).unwrap(), ..toss };
    assert_eq!(trace(&ExactSolver, &still, Times::Every(0.1)).unwrap().len(), 1);
}

/// 0.9 is three steps of 0.3, though 3 × 0.3 is 0.899999999999999911 in f64. All are read as decimals, as they are typed.
#[test]
fn a_step_that_divides_the_time_of_flight_in_decimals_has_no_row_next_to_the_landing() {
    let read = |digits: u32, places: &str| format!("{digits}{places}").parse::<f64>().unwrap();
    for places in ["e-1", "e-2", "e-3", "e-6", "e2"] {
        for (step, number) in (1..100).flat_map(|step| (1..33).map(move |number| (step, number))) {
            let (dt, landing) = (read(step, places), read(step * number, places));
            let launch = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(landing)).unwrap();
            let times = stepped(&launch, dt).unwrap();
            assert_eq!((times.len(), times.last()), (number as usize + 1, Some(&landing)), "{dt} {landing}");
        }
    }
    // 2 v0/g is 1 s, which f64 makes of these to two roundings at most.
    for (dt, number) in [(0.1, 10), (0.01, 100), (0.05, 20)] {
        for gravity in (900..1000).map(|digits| read(digits, "e-2")) {
            let thrown = TimeOfFlight::Ballistic { speed: gravity / 2.0, gravity };
            assert_eq!(stepped(&Launch::new([1.0, 0.0, 0.0], thrown).unwrap(), dt).unwrap().len(), number + 1);
        }
    }
    // What is further from the landing than roundings stays a row.
    let launch = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap();
    assert_eq!(stepped(&launch, 0.999_999_999_999_99).unwrap(), [0.0, 0.999_999_999_999_99, 1.0]);
}

/// In rad/s the rate would be rounded, and the time of flight to f64, by 1e-13 rad after these turns.
#[test]
fn closed_forms_are_traced_from_the_launch_as_it_was_given() {
    let turns = dynamics::Unit::TURN;
    let thrown = TimeOfFlight::Ballistic { speed: 49.0501, gravity: 9.81 };
    let launch = Launch::in_unit([101.1, 0.7, -3.3], turns, thrown).unwrap();
    for body in [Coin::PAPER.into(), Body::from_moments([1.0, 2.0, 2.5]).unwrap()] {
        let toss = Toss { body, launch };
        let traced = trace(&ExactSolver, &toss, 3).unwrap();
        let motion = ExactMotion::new(&toss);
        let middle = motion.state(traced[1].time).unwrap().attitude;
        let landed = motion.state(thrown).unwrap().attitude;
        for (point, expected) in [(&traced[1], middle), (&traced[2], landed)] {
            assert!(point.attitude.angle_to(&expected) < 2e-15, "{}", point.time);
            assert!((point.cos_tilt - expected.cos_tilt()).abs() < 1e-15, "{}", point.time);
        }
    }
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
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        if toss.launch.attitude() == Attitude::IDENTITY {
            return ExactSolver.land(toss);
        }
        Err(SolveError::NotFinite { time: toss.launch.flight_time() / 2.0 })
    }
}

#[test]
fn the_error_of_a_later_leg_has_the_time_since_launch() {
    let launch = Launch::new(Vector3::new(0.0, 40.0, 3.0), TimeOfFlight::Given(2.0)).unwrap();
    let error = trace(&Weary, &Toss::new(Coin::PAPER, launch), 3).unwrap_err();
    assert_eq!(error, Error::Solve(SolveError::NotFinite { time: 1.5 }));
}

fn enclosed(solver: &QuaternionSolver, toss: &Toss, times: Times) -> Result<Vec<EnclosedPoint>, Error> {
    trace_enclosed(solver, toss, times)?.collect()
}

#[test]
fn an_enclosed_trace_is_within_its_bounds_at_each_point() {
    let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.5)).unwrap();
    let toss = Toss::new(Coin::PAPER, launch.with_tilt(0.3).unwrap());
    let taylor = Stepping::adaptive(dynamics::Scheme::TAYLOR, 1e-6).unwrap();
    let solver = QuaternionSolver::new(taylor, dynamics::Formulation::default());
    let motion = ExactMotion::new(&toss);
    let traced = enclosed(&solver, &toss, 31.into()).unwrap();
    assert_eq!((traced.len(), traced[30].point.time), (31, 1.5));
    for EnclosedPoint { point, certificate } in &traced {
        let error = (point.cos_tilt - motion.cos_tilt(point.time).unwrap()).abs();
        assert!(error <= certificate.error_bound(), "{error:e}");
    }
    assert_eq!(enclosed(&solver, &toss, Times::Every(0.05)).unwrap().len(), 31);
    let book = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch: toss.launch };
    let motion = ExactMotion::new(&book);
    for EnclosedPoint { point, certificate } in &enclosed(&solver, &book, 31.into()).unwrap() {
        let error = (point.cos_tilt - motion.cos_tilt(point.time).unwrap()).abs();
        assert!(error <= certificate.error_bound() && certificate.error_bound() < 1e-4, "{error:e}");
    }
    let dop853 = QuaternionSolver::new(Stepping::DEFAULT, dynamics::Formulation::default());
    let raw = QuaternionSolver::new(taylor, dynamics::Formulation::RAW);
    for (solver, toss) in [(&dop853, &book), (&dop853, &toss), (&raw, &toss)] {
        let refused = enclosed(solver, toss, 3.into()).unwrap_err();
        assert!(matches!(refused, Error::Solve(SolveError::NotProven { .. })), "{refused}");
    }
}

#[test]
fn fewer_than_two_or_more_than_a_million_points_are_refused() {
    let launch = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap();
    let toss = Toss::new(Coin::PAPER, launch);
    for points in [0, 1, MOST_POINTS + 1] {
        assert!(matches!(trace(&ExactSolver, &toss, points), Err(Error::Input(_))));
    }
}
