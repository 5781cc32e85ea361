//! Bodies that are given by a tensor, above all with moments that are equal or nearly so, on the separatrix and spinning
//! about an axis.

use dynamics::{Attitude, Body, Launch, Outcome, Solver, TimeOfFlight, Toss, Unit};
use exact::{Certificate, ExactMotion, ExactSolver, Sensitivity, certify, margin};

fn toss(inertia: [f64; 6], rate: [f64; 3], tilt: f64, time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("valid").with_tilt(tilt).expect("valid");
    Toss { body: Body::from_inertia(inertia).expect("valid"), launch }
}

/// A tensor (kg m²), a rate (rad/s), a tilt (rad), a time of flight (s), and cos θ by an integration of the equations of
/// motion in 77 digits.
type Integrated = ([f64; 6], [f64; 3], f64, f64, f64);

const INTEGRATED: [Integrated; 11] = [
    ([1.0, 1.0, 1.0, 0.0, -5e-18, 0.0], [6.0, 9.0, 7.0], 0.0, 0.3, -0.233_012_678_425_572_9),
    ([1.0, 1.0, 1.0, 0.0, -1e-19, 0.0], [8.0, 8.0, -7.0], 0.0, 0.8, 0.027_325_799_927_544_48),
    ([1.0, 1.0, 0.5, -1e-17, 0.0, 0.0], [3.0, 4.0, 5.0], 0.0, 0.5, -0.552_451_592_217_799_5),
    ([1.5, 1.5, 1.5, -0.2, -0.2, -0.2], [-6.0, -15.6, -4.9], 0.0, 0.41, 0.149_128_538_462_577_76),
    ([1.25, 1.0, 1.0, 0.0, 0.0, -3e-18], [-1.35, -6.0, 3.0], 1.2, 1.94, -0.202_299_053_796_386_35),
    ([0.7, 0.7, 0.7, 0.0, -3e-18, -7e-19], [-0.6, -11.09, -11.23], -2.0, 2.08, -0.665_284_337_073_893_2),
    ([1.0, 1.1, 1.0, 0.0, 0.1, 0.0], [1.0, 2.0, 3.0], 0.0, 0.6, 0.459_536_353_495_535_5),
    ([1.0, 1.0, 1.0, 1e-17, 0.0, 0.0], [1.0, 2.0, 3.0], 0.0, 0.6, 0.419_903_188_896_739_3),
    // On the separatrix, spinning about a principal axis, and a slender body.
    ([41.0, 34.0, 56.25, -12.0, 0.0, 0.0], [-7.0, 24.0, 20.0], 0.5, 0.9, -0.254_559_448_527_063_97),
    ([2.0, 2.0, 3.0, 0.5, 0.0, 0.0], [1.0, 1.0, 0.0], 0.5, 7.0, -0.625_586_633_985_173_9),
    ([1e-5, 1.0, 1.0, 0.0, 1e-6, 0.0], [3.0, 2.0, 1.0], 0.0, 5.0, -0.475_918_329_367_289_4),
];

#[test]
fn outcomes_and_cos_tilt_are_those_of_an_integration() {
    for (inertia, rate, tilt, time, expected) in INTEGRATED {
        let toss = toss(inertia, rate, tilt, time);
        let certificate = certify(&toss).unwrap();
        assert!(certificate.is_proven(), "{inertia:?}");
        assert_eq!(certificate.outcome(), Outcome::of(expected, 0.0), "{inertia:?}");
        let landing = ExactSolver.land(&toss).unwrap();
        assert!((landing.cos_tilt - expected).abs() <= 0.5 * f64::EPSILON * expected.abs(), "{inertia:?}: {landing:?}");
        assert!((landing.state.attitude.cos_tilt() - expected).abs() < 4e-16, "{inertia:?}: {landing:?}");
    }
}

/// The search for a flip takes series about the middles of intervals, and outcomes take balls.
#[test]
fn the_outcome_changes_at_each_margin_and_not_before() {
    for (inertia, rate, tilt, time, _) in INTEGRATED {
        let toss = toss(inertia, rate, tilt, time);
        let outcome = certify(&toss).unwrap().outcome();
        let found = margin(&toss).unwrap();
        let changed = |input: usize, change: f64| {
            let mut rate = rate;
            let mut time = time;
            *rate.get_mut(input).unwrap_or(&mut time) += change;
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
            certify(&Toss { launch, ..toss }).unwrap().outcome()
        };
        let flips = found.rate.into_iter().chain([found.time]).enumerate();
        for (input, flip) in flips.filter_map(|(input, flip)| Some((input, flip?))) {
            let parts = (1..200).map(|part| f64::from(part) / 200.0).chain([1.0 - 1e-9]);
            assert!(
                parts.clone().all(|part| [part, -part].iter().all(|part| {
                    let change = part * flip;
                    (input == 3 && time + change < 0.0) || changed(input, change) == outcome
                })),
                "{inertia:?} {input} {flip}"
            );
            assert_ne!(changed(input, flip * (1.0 + 1e-9)), outcome, "{inertia:?} {input} {flip}");
        }
        assert!(
            found.time.is_some() || found.time_range.is_some_and(|[_, later]| later > 0.0),
            "{inertia:?}: {found:?}"
        );
    }
}

#[test]
fn derivatives_are_those_of_the_motion() {
    const STEP: f64 = 1e-6;
    for (inertia, rate, tilt, time, _) in INTEGRATED {
        let found = Sensitivity::new(&toss(inertia, rate, tilt, time)).unwrap();
        for input in 0..4 {
            let cos_tilt = |step: f64| {
                let (mut rate, mut time) = (rate, time);
                *rate.get_mut(input).unwrap_or(&mut time) += step;
                let toss = toss(inertia, rate, tilt, time);
                ExactSolver.tilt(&toss).unwrap().cos_tilt
            };
            let slope = (cos_tilt(STEP) - cos_tilt(-STEP)) / (2.0 * STEP);
            let off = (found.cos_tilt[input] - slope).abs();
            assert!(off < 1e-8 * slope.abs().max(10.0), "{inertia:?} {input}: {} {slope}", found.cos_tilt[input]);
        }
    }
}

fn rotated(moments: [f64; 3], [w, x, y, z]: [i32; 4]) -> [f64; 6] {
    let [w, x, y, z] = [w, x, y, z].map(f64::from);
    // Columns of |q|² times the rotation, in whole numbers.
    let columns = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z],
    ];
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(row, column): (usize, usize)| {
        moments.iter().zip(&columns).map(|(moment, axis)| moment * axis[row] * axis[column]).sum()
    })
}

/// The same motion by moments or by the closed form of coins, and by a tensor in a turned frame: moments of whole
/// numbers and a frame turned by a quaternion of whole numbers leave no rounding between them.
#[test]
fn a_turned_body_lands_as_the_same_body_does_along_its_axes() {
    let moments =
        [[4.0, 4.0, 7.0], [4.0, 7.0, 7.0], [3.0, 4.0, 6.0], [4.0, 4.0, 4.0], [5.0, 4.0, 9.0], [4.0, 8.0, 9.0]];
    let turns = [[1, 2, 2, 4], [1, 0, 2, 2], [2, 1, 0, 2], [1, 1, 1, 1]];
    let rates = [[3.0, 4.0, 5.0], [3.0, 4.0, 4.0], [0.0, 2.0, 0.0], [-1.0, 0.0, 6.0]];
    let mut compared = 0;
    for ((moments, turn), rate) in
        moments.iter().flat_map(|body| turns.map(|turn| (*body, turn))).flat_map(|case| rates.map(|rate| (case, rate)))
    {
        let turned = Body::from_inertia(rotated(moments, turn)).unwrap();
        if turned.moments().is_some() {
            continue;
        }
        let frame = Attitude::from_components(turn.map(f64::from)).unwrap();
        let squared: f64 = turn.map(|part| f64::from(part * part)).iter().sum();
        let in_frame = <[f64; 3]>::from(frame.body_to_lab(&rate.into()) * squared).map(f64::round);
        for time in [0.5, 5.0, 50.0] {
            // The body frame differs, so that the normal of the one is made that of the other by the attitude at launch.
            let along = Launch::new(rate.map(|part| part * squared), TimeOfFlight::Given(time)).unwrap();
            let [one, other] = [
                ExactMotion::new(&Toss { body: Body::from_moments(moments).unwrap(), launch: along }),
                ExactMotion::new(&Toss {
                    body: turned,
                    launch: Launch::new(in_frame, TimeOfFlight::Given(time)).unwrap(),
                }),
            ];
            let [one, other] = [one.state(time).unwrap(), other.state(time).unwrap()];
            let expected = frame * one.attitude * frame.inverse();
            assert!(expected.angle_to(&other.attitude) < 2e-15, "{moments:?} {turn:?} {rate:?} {time}");
            let off = (frame.body_to_lab(&one.rate) - other.rate).norm() / one.rate.norm();
            assert!(off < 2e-15, "{moments:?} {turn:?} {rate:?} {time}: {off:e}");
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn long_flights_and_extreme_rates_are_decided() {
    let [near_sphere, symmetric, separatrix] = [INTEGRATED[0].0, INTEGRATED[3].0, INTEGRATED[8].0];
    for (inertia, rate, time) in [
        (near_sphere, [6.0, 9.0, 7.0], 1e8),
        (symmetric, [6.0, 9.0, 7.0], 1e8),
        (separatrix, [-7.0, 24.0, 20.0], 1e6),
        (separatrix, [-7.0, 24.0, 20.000_000_000_000_004], 30.0),
        (separatrix, [3.0, 4.0, 0.0], 1e5),
        (separatrix, [4.0, -3.0, 1e-60], 3.0),
        (near_sphere, [1e-300, 1.0, 0.0], 5.0),
        (near_sphere, [3e300, 2e300, 1e300], 1e-300),
        (symmetric, [3e-300, 2e-300, 1e-300], 1e300),
    ] {
        let found = certify(&toss(inertia, rate, 0.3, time)).unwrap();
        assert!(found.is_proven() && found.outcome() != Outcome::Undecided, "{inertia:?} {rate:?} {time:e}");
    }
}

/// By exact arithmetic, where there is no motion.
#[test]
fn a_body_at_rest_is_decided_and_a_tie_is_proven() {
    let at = |tilt: dynamics::Quantity, rate: [f64; 3], time: f64| -> Certificate {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
        certify(&Toss { body: Body::from_inertia(INTEGRATED[0].0).unwrap(), launch }).unwrap()
    };
    let quarter = Unit::TURN.times(0.25);
    for (rate, time) in [([0.0; 3], 1.0), ([1.0, 2.0, 3.0], 0.0)] {
        let tie = at(quarter, rate, time);
        assert!(tie.is_proven() && tie.outcome() == Outcome::Undecided);
        assert_eq!(at(1.0.into(), rate, time).outcome(), Outcome::Heads);
        assert_eq!(at(2.0.into(), rate, time).outcome(), Outcome::Tails);
    }
}

/// 1e-300 of the rate beside the middle axis takes more digits than there are after some thousand radians.
#[test]
fn a_flight_beyond_the_digits_is_an_error_and_no_small_cos_tilt() {
    let toss = toss(INTEGRATED[8].0, [4.0, -3.0, 1e-300], 0.3, 1e4);
    assert!(!certify(&toss).unwrap().is_proven());
    assert_eq!(ExactSolver.tilt(&toss).unwrap_err().kind(), "not_finite");
}

/// A rate in degrees is not one of f64 in radians.
#[test]
fn rates_in_degrees_are_decided_as_they_were_given() {
    let degree = Unit::DEGREE;
    for (inertia, ..) in INTEGRATED {
        let body = Body::from_inertia(inertia).unwrap();
        let launch = Launch::in_unit([300.0, 200.0, 100.0], degree, TimeOfFlight::Given(2.0)).unwrap();
        let rounded = Launch::new(launch.rate(), TimeOfFlight::Given(2.0)).unwrap();
        let [given, rounded] = [launch, rounded].map(|launch| ExactSolver.tilt(&Toss { body, launch }).unwrap());
        let off = (given.cos_tilt - rounded.cos_tilt).abs();
        assert!(off < 1e-14 && given.error.unwrap() < 3e-16, "{inertia:?}: {off:e}");
    }
}
