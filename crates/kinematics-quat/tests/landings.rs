//! Tests of the quaternion's landings: their error against the exact motion, their work, and their bits. By Taylor series, a
//! landing must have the same bits whichever flights are solved with it and at every SIMD level, so that batches can be
//! repeated.

use dynamics::{
    Body, Coin, Formulation, Landing, Launch, Scheme, SolveError, Solver, Stepping, TimeOfFlight, Toss, Work,
};
use exact::ExactMotion;
use kinematics_quat::{QuaternionSolver, TAYLOR};
use numerics::lanes::SimdLevel;

fn adaptive(scheme: Scheme, tolerance: f64) -> QuaternionSolver {
    QuaternionSolver::new(Stepping::adaptive(scheme, tolerance).expect("valid"), Formulation::default())
}

fn toss(body: Body, rate: [f64; 3], time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("valid");
    Toss { body, launch: launch.with_tilt(0.3).expect("valid") }
}

fn moments(moments: [f64; 3]) -> Body {
    Body::from_moments(moments).expect("a body")
}

fn coin(k: f64) -> Body {
    Coin::from_moments(1.0, k).expect("a coin").into()
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
    bodies.extend((0..10).map(|n| coin(0.2 * f64::from(n))));
    bodies
}

/// Flights of many lengths, among them long ones, some that end at once, and some whose phase is too large.
fn tosses() -> Vec<Toss> {
    let (brick, disc) = (moments([1.0, 2.0, 2.5]), coin(0.5));
    let mut tosses = Vec::new();
    for body in [brick, disc] {
        tosses.extend([
            toss(body, [0.0; 3], 1e300),
            toss(body, [3.0, 4.0, 5.0], 0.0),
            toss(body, [3.0, 4.0, 5.0], 1e300),
            toss(body, [1e300, -1e300, 1e299], 1e-299),
            toss(body, [0.0, 60.0, 0.0], 0.1),
            toss(body, [9.0, 1.0, -3.0], 100.0),
        ]);
    }
    tosses.extend([
        toss(moments([1.0, 2.0, 2.25]), [0.75, 1.0, 1.0], 10.0),
        toss(moments([1.0, 2.0, 2.25]), [0.750_001, 1.0, 1.0], 15.0),
        toss(brick, [1e-9, 10.0, 1e-9], 1.0),
        toss(disc, [30.0, 40.0, 50.0], 20.0),
        toss(coin(2.0), [3.0, -4.0, 5.0], 1e-9),
        toss(coin(0.0), [0.0, 0.0, 60.0], 1.0),
        toss(disc, [0.0, 60.0, 0.0], 1.0),
        toss(coin(1.0), [1e-200, 0.0, 60.0], 1.0),
        toss(disc, [5e-324, 0.0, 0.0], 1.0),
        toss(coin(1.9), [1e300, -1e300, 1e299], 1e-299),
    ]);
    let turn = |n: u32, step: f64| 60.0 * (2.0 * (f64::from(n) * step).fract() - 1.0);
    for (n, body) in (0_u32..120).zip(bodies().into_iter().cycle()) {
        let rate = [turn(n, 0.618), turn(n, 0.414), turn(n, 0.732)];
        tosses.push(toss(body, rate, 0.01 * f64::from(n)));
    }
    tosses.push(toss(disc, [9.0, 1.0, -3.0], 300.0));
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
    for tolerance in [1e-3, 1e-9, 1e-12, f64::EPSILON] {
        let solver = adaptive(TAYLOR, tolerance);
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
    let of_number = |n: u32| toss(coin(0.7), [sized(n, 0.618), sized(n, 0.414), sized(n, 0.732)], sized(n, 0.236));
    let tosses: Vec<Toss> = (1..4000).map(of_number).collect();
    let solver = adaptive(TAYLOR, 1e-13);
    let plain = solver.land_all(&tosses, SimdLevel::all()[0]);
    for level in SimdLevel::all() {
        let flown = solver.land_all(&tosses, level);
        let differs = (0..tosses.len()).find(|index| flown[*index] != plain[*index]);
        assert_eq!(differs, None, "{:?} by {}", differs.map(|index| tosses[index]), level.name());
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
                    assert!(toss.coin().is_none(), "{toss:?}");
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
    for toss in tosses() {
        let phase = toss.launch.turn_rate() * toss.launch.flight_time();
        if phase < if toss.coin().is_some() { 120.0 } else { 8.0 } {
            let ((attitude, rate), allowed) = (errors(&toss, &solver.land(&toss).unwrap()), 2e-14 + 2e-16 * phase);
            assert!(attitude < allowed && rate < allowed, "{attitude:e}, {rate:e}: {toss:?}");
        }
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
    let orders: [&[(f64, u64)]; 2] = [&[(1e-12, 26)], &[(0.5, 14), (1e-3, 18), (1e-6, 24), (1e-12, 26)]];
    for (body, orders) in [moments([1.0, 2.0, 2.5]), coin(0.5)].into_iter().zip(orders) {
        let fly = |tolerance, time| adaptive(TAYLOR, tolerance).land(&toss(body, [30.0, 40.0, 50.0], time));
        for &(tolerance, order) in orders {
            let work = fly(tolerance, 1.0).unwrap().work;
            assert!((2..200).contains(&work.accepted_steps), "{work:?}");
            assert_eq!((work.rhs_calls, work.rejected_steps), (order * work.accepted_steps, 0), "{tolerance:e}");
        }
        assert!(matches!(fly(1e-12, 1e18), Err(SolveError::PhaseTooLarge { .. })));
        let Err(SolveError::StepLimit { time, limit: 1_000_000 }) = fly(1e-12, 1e10) else { panic!("too many steps") };
        assert!(1e4 < time && time < 1e6, "{time}");
    }
}

#[test]
fn rates_do_not_drift_in_long_flights() {
    for (k, rate) in [(0.5, [1.0, 1.0, 2.5]), (0.5, [40.0, 30.0, 20.0]), (1.9, [50.0, 1.0, 50.0])] {
        let toss = toss(coin(k), rate, 1e4);
        let landing = adaptive(TAYLOR, 1e-12).land(&toss).unwrap();
        // Half a unit in the last place of a phase of up to 10⁶ rad is 6e-11.
        let (found, _) = errors(&toss, &landing);
        assert!(found < 4e-10, "{found:e} after 10⁴ s at {rate:?}");
    }
}

#[test]
fn steps_are_as_long_as_the_last_two_terms_allow() {
    let launches =
        [([30.0, 20.0, 10.0], 0.5), ([0.0, 60.0, 0.5], 0.5), ([1.0, 2.0, 90.0], 1.9), ([40.0, 0.0, 9.0], 0.1)];
    let steps = |tolerance: f64| {
        launches
            .map(|(rate, k)| adaptive(TAYLOR, tolerance).land(&toss(coin(k), rate, 10.0)).unwrap().work.accepted_steps)
    };
    for (tolerance, expected) in
        [(1e-2, [30, 43, 151, 35]), (1e-5, [38, 56, 196, 45]), (1e-9, [54, 79, 277, 64]), (1e-13, [76, 117, 391, 90])]
    {
        assert_eq!(steps(tolerance), expected, "{tolerance:e}");
    }
}
