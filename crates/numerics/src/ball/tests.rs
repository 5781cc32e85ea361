//! Tests of balls: they contain every result, and are not much larger than the errors.

use super::*;
use crate::big::exactly;

const DIGITS: usize = 200;

fn big(value: f64) -> Big {
    exactly(value).with_precision(DIGITS).value()
}

/// Whether the ball contains `exact`.
fn contains<N: Elementary>(ball: &Ball<N>, exact: &Big) -> bool {
    let midpoint = ball.midpoint.to_double_double();
    let off = exactly(midpoint.hi()) + exactly(midpoint.lo()) - exact;
    off.to_f64().value().abs() <= ball.radius
}

/// Balls of many radii, each with a number in it that is near its edge.
fn samples() -> Vec<(Ball<DoubleDouble>, Big)> {
    let mut samples = Vec::new();
    for index in 1..10 {
        let part = 2.0 * (f64::from(index) * 3f64.sqrt()).fract() - 1.0;
        for radius in [0.0, 1e-30, 1e-17, 1e-9, 0.01, 0.4] {
            let midpoint = 3.0 * part;
            let inside = big(midpoint) + big(0.999 * radius * if index % 2 == 0 { 1.0 } else { -1.0 });
            samples.push((Ball::new(midpoint.into(), radius), inside));
        }
    }
    samples
}

#[test]
fn every_result_contains_that_of_every_number_in_its_balls() {
    for (a, exact_a) in samples() {
        assert!(contains(&a.exp(), &exact_a.exp()), "{a:?}");
        let (sin, cos) = exact_a.sin_cos();
        let found = a.sine_and_cosine();
        assert!(contains(&found[0], &sin) && contains(&found[1], &cos), "{a:?}");
        if exact_a > Big::ZERO {
            assert!(contains(&a.sqrt(), &exact_a.sqrt()), "{a:?}");
        }
        for (b, exact_b) in samples() {
            assert!(contains(&(a + b), &(&exact_a + &exact_b)), "{a:?} {b:?}");
            assert!(contains(&(a - b), &(&exact_a - &exact_b)), "{a:?} {b:?}");
            assert!(contains(&(a * b), &(&exact_a * &exact_b)), "{a:?} {b:?}");
            assert!(contains(&(a / b), &(&exact_a / &exact_b)), "{a:?} {b:?}");
            // An angle is meant up to a turn where the ball crosses the cut at π.
            let (found, exact, turn) = (a.atan2(&b), exact_a.atan2(&exact_b), Big::pi(DIGITS) * exactly(2.0));
            let turns = [&exact + &turn, &exact - &turn, exact];
            assert!(turns.iter().any(|exact| contains(&found, exact)), "{a:?} {b:?}");
        }
    }
}

/// The functions of the standard library are right to less than 2^-52, on which balls of f64 rest.
#[test]
fn balls_of_f64_contain_every_result_and_the_functions_are_right_to_half_of_their_bound() {
    let bound = 0.5_f64.rounding();
    for index in 1..6_000 {
        let part = 2.0 * (f64::from(index) * 3f64.sqrt()).fract() - 1.0;
        let x = part * [1e-5, 0.1, 1.0, 3.0, 40.0, 700.0][index as usize % 6];
        let ball = Ball::new(x, 0.0);
        let exact = big(x);
        let (sin, cos) = exact.sin_cos();
        let [found_sin, found_cos] = ball.sine_and_cosine();
        let y = 2.0 * (f64::from(index) * 5f64.sqrt()).fract() - 1.0;
        let pairs = [
            (found_sin, sin),
            (found_cos, cos),
            (ball.exp(), exact.exp()),
            (ball.atan2(&Ball::new(y, 0.0)), exact.atan2(&big(y))),
            (Ball::new(x.abs(), 0.0).sqrt(), big(x.abs()).sqrt()),
            (ball / Ball::new(y, 0.0), &exact / big(y)),
        ];
        for (number, (found, exact)) in pairs.into_iter().enumerate() {
            assert!(contains(&found, &exact), "{number}: {x} {y}");
            // Below the range of f64 the error is not relative.
            if found.midpoint.abs() < f64::MIN_POSITIVE {
                continue;
            }
            let error = ((big(found.midpoint) - &exact) / &exact).to_f64().value().abs();
            assert!(error <= 0.55 * bound, "{number}: {x} {y} {error:e}");
        }
    }
    for (a, exact_a) in samples() {
        for (b, exact_b) in samples() {
            let [x, y] = [a, b].map(|ball| Ball::new(ball.midpoint.hi(), ball.radius));
            assert!(contains(&(x + y), &(&exact_a + &exact_b)) && contains(&(x * y), &(&exact_a * &exact_b)));
            assert!(contains(&(x / y), &(&exact_a / &exact_b)) && contains(&x.exp(), &exact_a.exp()));
        }
    }
}

/// A bound that were always infinite would pass the test above.
#[test]
fn radii_are_not_much_larger_than_the_errors() {
    let [a, b] = [0.7, -2.1].map(|value| Ball::new(DoubleDouble::exactly(value), 1e-20));
    for (ball, most) in [
        (a + b, 2.1e-20),
        (a * b, 2.9e-20),
        (a / b, 1e-20),
        (a.sqrt(), 1.3e-20),
        (a.exp(), 2.1e-20),
        (a.atan2(&b), 1.4e-20),
        (a.sine_and_cosine()[0], 1.1e-20),
    ] {
        assert!(ball.radius() <= most && ball.has_sign(), "{ball:?}");
    }
    assert!(!Ball::new(DoubleDouble::exactly(1.0), f64::NAN).has_sign());
    assert!(!(a / Ball::new(DoubleDouble::exactly(1e-30), 1e-30)).has_sign());
}

#[test]
fn balls_of_many_digits_contain_more_digits() {
    let seventh = |digits: usize| {
        let one = Ball::new(exactly(1.0).with_precision(digits).value(), 0.0);
        one.clone() / one.like(7.0)
    };
    let [rough, fine] = [seventh(150), seventh(600)];
    let off = (rough.midpoint() - fine.midpoint()).to_f64().value().abs();
    assert!(off <= rough.radius() + fine.radius() && rough.radius() < 1e-41 && fine.radius() < 1e-178);
    assert!(!fine.widened(0.2).has_sign());
}
