//! Tests of each part of the sum against the formulas (4) and (20) of the proof, where no other part is as large.

use dynamics::{Body, Coin, Flight, TimeOfFlight, Toss, Unit};

use super::*;

const STEP: StepBound = StepBound { turn: 2e-9, rates: 3e-9, eta: 5e-9 };

/// A toss whose k, η, q and time are exact in f64.
fn toss(launch: Launch) -> (CoinToss, Flight) {
    let toss = CoinToss { coin: Coin::from_moments(1.0, 1.5).unwrap(), launch };
    (toss, Flight::new(&toss.into()).unwrap())
}

fn in_radians(rate: [f64; 3]) -> (CoinToss, Flight) {
    toss(Launch::new(rate, TimeOfFlight::Given(10.0)).unwrap())
}

/// The bound from the sum of all errors.
fn of_sum(sum: f64) -> f64 {
    sum * (1.0 + 4.0 * sum) * (1.0 + 1e-9)
}

/// To 1e-10 of itself, however small.
fn assert_close(found: f64, expected: f64) {
    approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-10);
}

#[test]
fn errors_of_steps_and_drift_add_up() {
    let (toss, flight) = in_radians([1.0, 0.0, 1.25]);
    let [below, above] = [2f64.powi(-27), 2f64.powi(-25)];
    let record = Record { steps: 7, moduli: [0.5 - below, 0.5 + above], longest: 1.0 };
    let expected = 7.0 * 1e-8 + above * 10.0;
    assert_close(attitude_bound(&toss, &flight, &record, &STEP), of_sum(expected));
    let lower = Record { moduli: [0.5 - above, 0.5 + below], ..record };
    assert_close(attitude_bound(&toss, &flight, &lower, &STEP), of_sum(expected));
    // Without steps nothing drifts.
    let none = Record { steps: 0, ..record };
    assert!(attitude_bound(&toss, &flight, &none, &STEP) < 1e-25);
}

#[test]
fn a_modulus_that_is_no_f64_is_off_by_what_it_loses() {
    let (toss, flight) = in_radians([1.0, 0.3, 1.25]);
    let modulus = modulus(&flight);
    let record = Record { steps: 1, moduli: [modulus.hi(); 2], longest: 1.0 };
    assert!(modulus.lo().abs() > 1e-18);
    let found = attitude_bound(&toss, &flight, &record, &StepBound::default());
    assert_close(found, of_sum(10.0 * modulus.lo().abs()));
}

#[test]
fn a_direction_of_no_rate_is_no_error() {
    for (rate, of_eta) in [(1e-139, STEP.eta), (1e-150, 0.0)] {
        let (toss, flight) = in_radians([rate, 0.0, 1.25]);
        let record = Record { steps: 7, moduli: [0.5 * rate; 2], longest: 1.0 };
        assert_close(attitude_bound(&toss, &flight, &record, &STEP), of_sum(7.0 * (5e-9 + of_eta)));
    }
}

#[test]
fn rates_in_another_unit_are_off_by_their_rounding_in_each_part() {
    let degree = Unit::DEGREE;
    let (toss, flight) = toss(Launch::in_unit([50.0, 0.0, -70.0], degree, TimeOfFlight::Given(10.0)).unwrap());
    let (eta, z, span, rounding) = (0.5 * flight.rate.x, flight.rate.z.abs(), flight.span(), 1.01 * UNIT_ROUNDOFF);
    let record = Record { steps: 1, moduli: [eta; 2], longest: 1.0 };
    let of_q = 1.01 * rounding * 2.0 * z;
    let expected = (rounding * (eta + 0.5 * z) + 2.0 * of_q) * span + rounding;
    assert_close(attitude_bound(&toss, &flight, &record, &StepBound::default()), of_sum(expected));
}

#[test]
fn a_ratio_of_moments_and_a_time_that_are_no_f64_are_off_by_what_they_lose() {
    let coin = Coin::from_moments(3.0, 4.0).unwrap();
    let time = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
    let toss = CoinToss { coin, launch: Launch::new([40.0, 0.0, 33.0], time).unwrap() };
    let flight = Flight::new(&toss.into()).unwrap();
    let launched = Launched::new(&toss, &flight);
    let exactly = |value: f64| DoubleDouble::from(value);
    // The unit of the flight is 32 rad/s, a power of two.
    let time = exactly(32.0) * (exactly(6.0) / exactly(9.81)) - exactly(flight.span());
    let third = exactly(1.0) / exactly(3.0) * exactly(33.0 / 32.0);
    let rounded = exactly(body_precession_rate(coin.inertia_ratio(), 33.0 / 32.0));
    let assert_close =
        |found: f64, expected: f64| approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-9);
    assert_close(launched.time, time.hi().abs());
    assert_close(launched.q, (third - rounded).hi().abs());
    assert!(launched.time > 0.0 && launched.q > 0.0 && launched.rate == 0.0);
}

#[test]
fn a_body_has_the_errors_of_its_turn_and_of_its_time() {
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    let bound = Bound { turn: 1e-16, fastest: 3.0 };
    let time = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
    let toss = Toss { body, launch: Launch::new([40.0, -4.0, 33.0], time).unwrap() };
    let flight = Flight::new(&toss).unwrap();
    let of_time = time_error(&toss.launch, &flight);
    assert!(of_time > 1e-17);
    let expected = of_sum(1e-16 + 1.5 * of_time);
    assert_close(attitude_bound_of_body(&toss.launch, &flight, &bound), expected);
}

#[test]
fn what_a_bound_of_steps_depends_on_is_that_of_the_record() {
    let (toss, flight) = in_radians([1.0, 0.0, 1.25]);
    let record = Record { steps: 7, moduli: [0.375, 0.5], longest: 0.7 };
    let expected = Steps { modulus: 0.5, spread: 0.25, half_z: 0.625, q: 0.625, longest: 0.7 };
    assert_eq!(steps(&toss, &flight, &record), expected);
    let still = Record { moduli: [0.0, 1e-150], ..record };
    assert_eq!(steps(&toss, &flight, &still), Steps { modulus: 1e-150, spread: 0.0, ..expected });
    assert_eq!(steps(&toss, &flight, &Record { steps: 0, ..record }), Steps::default());
}

#[test]
fn a_time_that_is_an_f64_is_off_by_the_rounding_of_its_unit() {
    let (toss, flight) = in_radians([1.0, 0.0, 1.25]);
    assert_eq!(time_error(&toss.launch, &flight), OF_DOUBLE_DOUBLE * 10.0);
}

#[test]
fn a_flight_of_no_time_has_the_error_of_underflow_alone() {
    let launch = Launch::new([1.0, 0.0, 1.25], TimeOfFlight::Given(0.0)).unwrap();
    let (toss, flight) = toss(launch);
    assert_eq!(attitude_bound(&toss, &flight, &Record::default(), &STEP), of_sum(TINY));
    let still = Bound { turn: 0.0, fastest: 3.0 };
    assert_eq!(attitude_bound_of_body(&launch, &flight, &still), of_sum(TINY));
}

#[test]
fn large_errors_have_no_bound() {
    assert_close(whole(9e-4), of_sum(9e-4));
    assert_eq!([whole(LARGEST), whole(f64::INFINITY), whole(f64::NAN)], [f64::INFINITY; 3]);
}
