//! Tests of the quaternion of any rigid body: its error against the exact motion, its work, and its bits.

use dynamics::{
    Attitude, Body, Coin, Formulation, Landing, Launch, Scheme, SolveError, Solver, Stepping, TimeOfFlight, Toss, Work,
};
use exact::ExactMotion;
use kinematics_quat::{QuaternionSolver, TAYLOR};
use numerics::lanes::SimdLevel;

fn solver(stepping: Stepping) -> QuaternionSolver {
    QuaternionSolver::new(stepping, Formulation::default())
}

fn adaptive(scheme: Scheme, tolerance: f64) -> QuaternionSolver {
    solver(Stepping::adaptive(scheme, tolerance).expect("valid"))
}

fn toss(body: Body, rate: [f64; 3], time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("valid");
    Toss { body, launch: launch.with_tilt(0.3).expect("valid") }
}

fn moments(moments: [f64; 3]) -> Body {
    Body::from_moments(moments).expect("a body")
}

/// Bodies of every kind: generic in three orders, plates, rods, nearly symmetric, nearly spherical, a tensor, a coin.
fn bodies() -> Vec<Body> {
    let mut bodies: Vec<Body> = [
        [1.0, 2.0, 2.5],
        [2.5, 1.0, 2.0],
        [2.0, 2.5, 1.0],
        [1.0, 2.0, 3.0],
        [1e-6, 1.0, 1.0 + 5e-7],
        [0.0, 1.0, 1.0],
        [1.0, 1.0 + 1e-9, 1.9],
        [1.0, 1.0 + 1e-7, 1.0 - 1e-6],
    ]
    .map(moments)
    .into();
    bodies.push(Body::from_tensor([[2.0, 0.3, -0.1], [0.3, 2.2, 0.25], [-0.1, 0.25, 1.4]]).expect("a body"));
    bodies.push(Coin::PAPER.into());
    bodies
}

/// Flights of many lengths, among them long ones, some that end at once, and one whose phase is too large.
fn tosses() -> Vec<Toss> {
    let brick = moments([1.0, 2.0, 2.5]);
    let mut tosses = vec![
        toss(brick, [0.0; 3], 1e300),
        toss(brick, [3.0, 4.0, 5.0], 0.0),
        toss(brick, [3.0, 4.0, 5.0], 1e300),
        toss(brick, [1e300, -1e300, 1e299], 1e-299),
        toss(brick, [0.0, 60.0, 0.0], 0.1),
        toss(moments([1.0, 2.0, 2.25]), [0.75, 1.0, 1.0], 10.0),
        toss(moments([1.0, 2.0, 2.25]), [0.750_001, 1.0, 1.0], 15.0),
        toss(brick, [1e-9, 10.0, 1e-9], 1.0),
    ];
    let turn = |n: u32, step: f64| 60.0 * (2.0 * (f64::from(n) * step).fract() - 1.0);
    for (n, body) in (0_u32..60).zip(bodies().into_iter().cycle()) {
        let rate = [turn(n, 0.618), turn(n, 0.414), turn(n, 0.732)];
        tosses.push(toss(body, rate, 0.02 * f64::from(n)));
    }
    tosses.push(toss(brick, [9.0, 1.0, -3.0], 100.0));
    tosses
}

/// Errors of the attitude (rad) and of the rate, relative to the largest rate.
fn errors(toss: &Toss, landing: &Landing) -> (f64, f64) {
    let exact = ExactMotion::new(toss).state(toss.launch.time_of_flight()).expect("valid");
    let size = toss.launch.rate().amax().max(f64::MIN_POSITIVE);
    (exact.attitude.angle_to(&landing.state.attitude), ((exact.rate - landing.state.rate) / size).amax())
}

#[test]
fn a_landing_has_the_same_bits_alone_or_with_others_and_at_every_simd_level() {
    let tosses = tosses();
    for tolerance in [1e-3, 1e-9, f64::EPSILON] {
        let solver = adaptive(TAYLOR, tolerance);
        let alone: Vec<Result<Landing, SolveError>> = tosses.iter().map(|toss| solver.land(toss)).collect();
        for level in SimdLevel::all() {
            for size in [1, 2, 3, 5, 8, 17, tosses.len()] {
                let flown: Vec<_> = tosses.chunks(size).flat_map(|some| solver.land_all(some, level)).collect();
                assert_eq!(flown, alone, "{tolerance:e} by {} in {size}", level.name());
            }
        }
    }
}

#[test]
fn every_flight_is_within_the_error_estimate() {
    let mut undecided = 0;
    for tolerance in [1e-2, 1e-4, 1e-7, 1e-10, 1e-12, 1e-14] {
        for scheme in [TAYLOR, Scheme::DOP853, Scheme::DOPRI5] {
            let solver = adaptive(scheme, tolerance);
            for toss in tosses() {
                let Ok(landing) = solver.land(&toss) else {
                    assert_eq!(toss.launch.flight_time(), 1e300);
                    continue;
                };
                let Some(allowed) = landing.error else {
                    undecided += 1;
                    continue;
                };
                let (attitude, rate) = errors(&toss, &landing);
                assert!(attitude <= allowed, "{scheme} {tolerance:e}: {attitude:e} > {allowed:e}: {toss:?}");
                assert!(rate <= 10.0 * allowed, "{scheme} {tolerance:e}: {rate:e} of the rate: {toss:?}");
            }
        }
    }
    // Estimates that say nothing are few: those of rough tolerances, and of flights along the separatrix.
    assert!(undecided < 400, "{undecided}");
}

#[test]
fn short_flights_by_series_are_right_to_rounding() {
    let solver = adaptive(TAYLOR, f64::EPSILON);
    for toss in tosses().into_iter().filter(|toss| toss.launch.turn_rate() * toss.launch.flight_time() < 8.0) {
        let (attitude, rate) = errors(&toss, &solver.land(&toss).unwrap());
        assert!(attitude < 2e-14 && rate < 2e-14, "{attitude:e}, {rate:e}: {toss:?}");
    }
}

#[test]
fn a_body_with_two_equal_moments_about_n_is_a_coin_bit_by_bit() {
    let coin = Coin::from_moments(1.0, 1.9).unwrap();
    let launch = Launch::new([3.0, -4.0, 5.0], TimeOfFlight::Given(2.0)).unwrap();
    for scheme in [TAYLOR, Scheme::DOP853, Scheme::DOPRI5] {
        let solver = adaptive(scheme, 1e-10);
        let (as_coin, body) = (Toss::new(coin, launch), Toss::new(moments([1.0, 1.0, 1.9]), launch));
        assert_eq!(solver.land(&body), solver.land(&as_coin));
    }
}

#[test]
fn flights_that_end_where_they_start_take_no_step() {
    for scheme in [TAYLOR, Scheme::DOP853] {
        for body in [moments([1.0, 2.0, 2.5]), moments([1.0, 1.0, 0.5])] {
            for (rate, time) in [([3.0, 4.0, 5.0], 0.0), ([0.0; 3], 9.0), ([0.0; 3], 1e300)] {
                let toss = toss(body, rate, time);
                let landing = adaptive(scheme, 1e-9).land(&toss).unwrap();
                assert!(scheme != TAYLOR || landing.work == Work::default());
                assert!(landing.state.attitude.angle_to(&toss.launch.attitude()) < 1e-15);
                assert_eq!(landing.state.rate, toss.launch.rate());
            }
        }
    }
}

#[test]
fn each_step_counts_as_many_calls_as_its_order_and_too_many_are_typed_errors() {
    let solver = adaptive(TAYLOR, 1e-12);
    let fly = |time| solver.land(&toss(moments([1.0, 2.0, 2.5]), [30.0, 40.0, 50.0], time));
    let work = fly(1.0).unwrap().work;
    assert!((20..200).contains(&work.accepted_steps), "{work:?}");
    assert_eq!((work.rhs_calls, work.rejected_steps), (26 * work.accepted_steps, 0));
    assert!(matches!(fly(1e18), Err(SolveError::PhaseTooLarge { .. })));
    assert!(matches!(fly(1e10), Err(SolveError::StepLimit { limit: 1_000_000, .. })));
}

/// The published motion of NASA check case 2 (a tumbling brick), body rates in deg/s.
#[test]
fn a_tumbling_brick_has_the_rates_of_the_check_case() {
    let brick = moments([0.001_894_220, 0.006_211_019, 0.007_194_665]);
    for (time, rates) in [
        (10.0, [-2.418_902_221_692_9, -23.552_569_519_560_5, 28.128_592_630_041_4]),
        (30.0, [12.618_390_775_914_2, -17.397_474_761_611_4, 31.119_588_886_944_3]),
    ] {
        let toss = toss(brick, [10.0, 20.0, 30.0].map(f64::to_radians), time);
        let toss = Toss { launch: toss.launch.with_attitude(Attitude::IDENTITY), ..toss };
        let landed = adaptive(TAYLOR, 1e-14).land(&toss).unwrap().state.rate;
        for (found, expected) in landed.iter().zip(rates) {
            assert!((found.to_degrees() - expected).abs() < 1e-11, "{found:e}, not {expected}");
        }
    }
}
