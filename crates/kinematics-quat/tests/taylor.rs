//! Tests of the quaternion by Taylor series: its error against the exact motion, its work, and its bits. A landing must
//! have the same bits whichever flights are solved with it and at every SIMD level, so that batches can be repeated.

use dynamics::{Attitude, Coin, Formulation, Landing, Launch, SolveError, Solver, Stepping, TimeOfFlight, Toss};
use exact::ExactMotion;
use kinematics_quat::{QuaternionSolver, TAYLOR};
use numerics::lanes::SimdLevel;

fn taylor(tolerance: f64) -> QuaternionSolver {
    QuaternionSolver::new(Stepping::adaptive(TAYLOR, tolerance).expect("valid"), Formulation::default())
}

fn toss(k: f64, rate: [f64; 3], time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("valid");
    Toss::new(Coin::from_moments(1.0, k).expect("valid"), launch.with_tilt(0.3).expect("valid"))
}

/// Flights of many lengths, among them long ones, some that end at once, and one whose phase is too large.
fn tosses() -> Vec<Toss> {
    let mut tosses = vec![
        toss(0.5, [0.0; 3], 1e300),
        toss(0.5, [3.0, 4.0, 5.0], 0.0),
        toss(0.5, [3.0, 4.0, 5.0], 1e300),
        toss(0.5, [30.0, 40.0, 50.0], 20.0),
        toss(2.0, [3.0, -4.0, 5.0], 1e-9),
        toss(0.0, [0.0, 0.0, 60.0], 1.0),
        toss(0.5, [0.0, 60.0, 0.0], 1.0),
        toss(1.0, [1e-200, 0.0, 60.0], 1.0),
        toss(0.5, [5e-324, 0.0, 0.0], 1.0),
        toss(1.9, [1e300, -1e300, 1e299], 1e-299),
    ];
    let turn = |n: u32, step: f64| 60.0 * (2.0 * (f64::from(n) * step).fract() - 1.0);
    for n in 0..60 {
        let rate = [turn(n, 0.618), turn(n, 0.414), turn(n, 0.732)];
        tosses.push(toss(0.03 * f64::from(n), rate, 0.02 * f64::from(n)));
    }
    tosses.push(toss(0.5, [9.0, 1.0, -3.0], 300.0));
    tosses
}

/// Error of `attitude` at the landing of `toss` (rad).
fn error(toss: &Toss, attitude: &Attitude) -> f64 {
    let exact = ExactMotion::new(toss).state(toss.launch.time_of_flight()).expect("valid").attitude;
    exact.angle_to(attitude)
}

#[test]
fn a_landing_has_the_same_bits_alone_or_with_others_and_at_every_simd_level() {
    let tosses = tosses();
    for tolerance in [1e-3, 1e-9, 1e-12, f64::EPSILON] {
        let solver = taylor(tolerance);
        let alone: Vec<Result<Landing, SolveError>> = tosses.iter().map(|toss| solver.land(toss)).collect();
        for level in SimdLevel::all() {
            for size in [1, 2, 3, 4, 5, 8, 9, 17, tosses.len()] {
                let flown: Vec<_> = tosses.chunks(size).flat_map(|some| solver.land_all(some, level)).collect();
                assert_eq!(flown, alone, "{tolerance:e} by {} in {size}", level.name());
            }
            let reversed: Vec<Toss> = tosses.iter().rev().copied().collect();
            let mut flown = solver.land_all(&reversed, level);
            flown.reverse();
            assert_eq!(flown, alone, "{tolerance:e} by {}, reversed", level.name());
            assert_eq!(solver.land_all(&[], level), []);
        }
    }
}

/// Rates and times of every size beside ordinary ones, with which products have digits below the range of f64.
#[test]
fn flights_with_tiny_rates_or_times_have_the_same_bits_at_every_simd_level() {
    let sized = |n: u32, step: f64| match (f64::from(n) * step * 7.3).fract() {
        kind if kind < 0.3 => 3.0 + (f64::from(n) * step).fract(),
        kind if kind < 0.4 => 0.0,
        _ => 5e-324 * (170.0 * (f64::from(n) * step).fract()).exp2(),
    };
    let of_number = |n: u32| toss(0.7, [sized(n, 0.618), sized(n, 0.414), sized(n, 0.732)], sized(n, 0.236));
    let tosses: Vec<Toss> = (1..4000).map(of_number).collect();
    let solver = taylor(1e-13);
    let plain = solver.land_all(&tosses, SimdLevel::all()[0]);
    for level in SimdLevel::all() {
        let flown = solver.land_all(&tosses, level);
        let differs = (0..tosses.len()).find(|index| flown[*index] != plain[*index]);
        assert_eq!(differs, None, "{:?} by {}", differs.map(|index| tosses[index]), level.name());
    }
}

#[test]
fn every_flight_is_within_the_error_estimate() {
    for tolerance in [1e-2, 1e-4, 1e-7, 1e-10, 1e-12, 1e-14] {
        let solver = taylor(tolerance);
        for toss in tosses() {
            let Ok(landing) = solver.land(&toss) else {
                assert_eq!(toss.launch.flight_time(), 1e300);
                continue;
            };
            let (found, allowed) = (error(&toss, &landing.state.attitude), landing.error.unwrap());
            assert!(found <= allowed, "{found:e} > {allowed:e} at {tolerance:e}: {toss:?}");
            let exact = ExactMotion::new(&toss).state(toss.launch.time_of_flight()).unwrap().rate;
            let (found, size) = ((landing.state.rate - exact).amax(), exact.amax());
            assert!(found <= 10.0 * allowed * size, "{found:e} of {size:e} at {tolerance:e}: {toss:?}");
        }
    }
}

#[test]
fn short_flights_are_right_to_rounding() {
    let solver = taylor(f64::EPSILON);
    for toss in tosses().into_iter().filter(|toss| toss.launch.flight_time() < 1.3) {
        let found = error(&toss, &solver.land(&toss).unwrap().state.attitude);
        assert!(found < 4e-14, "{found:e}: {toss:?}");
    }
}

#[test]
fn rates_do_not_drift_in_long_flights() {
    for (k, rate) in [(0.5, [1.0, 1.0, 2.5]), (0.5, [40.0, 30.0, 20.0]), (1.9, [50.0, 1.0, 50.0])] {
        let toss = toss(k, rate, 1e4);
        let landing = taylor(1e-12).land(&toss).unwrap();
        // Half a unit in the last place of a phase of up to 10⁶ rad is 6e-11.
        let found = error(&toss, &landing.state.attitude);
        assert!(found < 4e-10, "{found:e} after 10⁴ s at {rate:?}");
    }
}

#[test]
fn each_step_counts_as_many_calls_as_its_order_and_none_is_rejected() {
    for (tolerance, order) in [(0.5, 14), (1e-3, 18), (1e-6, 24), (1e-12, 26)] {
        let work = taylor(tolerance).land(&toss(0.5, [30.0, 20.0, 10.0], 1.0)).unwrap().work;
        assert!(work.accepted_steps > 1);
        assert_eq!((work.rhs_calls, work.rejected_steps), (order * work.accepted_steps, 0), "{tolerance:e}");
    }
}

#[test]
fn steps_are_as_long_as_the_last_two_terms_allow() {
    let launches =
        [([30.0, 20.0, 10.0], 0.5), ([0.0, 60.0, 0.5], 0.5), ([1.0, 2.0, 90.0], 1.9), ([40.0, 0.0, 9.0], 0.1)];
    let steps = |tolerance: f64| {
        launches.map(|(rate, k)| taylor(tolerance).land(&toss(k, rate, 10.0)).unwrap().work.accepted_steps)
    };
    for (tolerance, expected) in
        [(1e-2, [30, 43, 151, 35]), (1e-5, [38, 56, 196, 45]), (1e-9, [54, 79, 277, 64]), (1e-13, [76, 117, 391, 90])]
    {
        assert_eq!(steps(tolerance), expected, "{tolerance:e}");
    }
}

#[test]
fn a_phase_that_is_too_large_and_too_many_steps_are_typed_errors() {
    let solver = taylor(1e-12);
    let alone = |time| solver.land(&toss(0.5, [30.0, 40.0, 50.0], time));
    assert!(matches!(alone(1e18), Err(SolveError::PhaseTooLarge { .. })));
    let Err(SolveError::StepLimit { time, limit: 1_000_000 }) = alone(1e10) else { panic!("it has too many steps") };
    assert!(1e4 < time && time < 1e6, "{time}");
}
