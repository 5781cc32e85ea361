//! Tests of balls: they contain every result, and are not much larger than the errors.

use super::*;
use crate::DoubleDouble;
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

/// Whether the ball contains the angle `exact` up to a turn, where the ball crosses the cut at π.
fn is_angle<N: Elementary>(ball: &Ball<N>, exact: &Big) -> bool {
    let turn = Big::pi(DIGITS) * exactly(2.0);
    [exact + &turn, exact - &turn, exact.clone()].iter().any(|exact| contains(ball, exact))
}

/// Balls of every size that an f64 has, each with a number in it that is near its edge.
fn extremes() -> Vec<(Ball<DoubleDouble>, Big)> {
    let mut samples = Vec::new();
    for exponent in [-1074, -1060, -1023, -1000, -960, -903, -600, -200, -1, 2, 80, 400] {
        for (share, side) in [(0.0, 1.0), (1e-40, -1.0), (1e-12, 1.0), (0.1, -1.0), (0.9, -1.0), (3.0, 1.0)] {
            for mantissa in [1.0, -1.618_033_988_749_895] {
                let midpoint = DoubleDouble::exactly(mantissa).times_power_of_two(exponent);
                let radius = midpoint.hi().abs() * share;
                samples.push((Ball::new(midpoint, radius), big(midpoint.hi()) + big(0.999 * side * radius)));
            }
        }
    }
    samples.push((Ball::new(DoubleDouble::ZERO, 0.0), big(0.0)));
    samples.push((Ball::new(DoubleDouble::exactly(1e308), 1e307), big(1.09e308)));
    // The exponential of the middle underflows, that of the edge does not.
    samples.push((Ball::new(DoubleDouble::exactly(-800.0), 200.0), big(-600.0)));
    samples
}

/// Whether the ball contains `exact`, or says that it knows nothing.
fn is_right<N: Elementary>(ball: &Ball<N>, exact: &Big) -> bool {
    !ball.radius.is_finite() || contains(ball, exact)
}

#[test]
fn no_digit_that_underflows_is_forgotten() {
    for (a, exact_a) in extremes() {
        let rough_a = Ball::new(a.midpoint.hi(), a.radius);
        if a.midpoint.hi().abs() + a.radius < 1100.0 {
            let exact = exact_a.exp();
            assert!(is_right(&a.exp(), &exact) && is_right(&rough_a.exp(), &exact), "{a:?}");
        }
        for exponent in [-1100, -1030, -3, 7, 900] {
            let exact = exact_a.times_power_of_two(exponent);
            assert!(is_right(&a.times_power_of_two(exponent), &exact), "{a:?} {exponent}");
        }
        let (sin, cos) = exact_a.sin_cos();
        let [found_sin, found_cos] = a.sine_and_cosine();
        assert!(is_right(&found_sin, &sin) && is_right(&found_cos, &cos), "{a:?} {found_sin:?} {found_cos:?}");
        if exact_a >= Big::ZERO {
            let exact = exact_a.sqrt();
            assert!(is_right(&a.sqrt(), &exact) && is_right(&rough_a.sqrt(), &exact), "{a:?} {:?}", a.sqrt());
        }
        for (b, exact_b) in extremes() {
            let rough_b = Ball::new(b.midpoint.hi(), b.radius);
            let sum = &exact_a + &exact_b;
            assert!(is_right(&(a + b), &sum) && is_right(&(rough_a + rough_b), &sum), "{a:?} {b:?}");
            let product = &exact_a * &exact_b;
            assert!(is_right(&(a * b), &product) && is_right(&(rough_a * rough_b), &product), "{a:?} {b:?}");
            // (a + b t)(b + a t) = a b + (a² + b²) t
            let series = Ball::product_of_series(&[a, b], &[b, a], &[], &[0, 0]);
            assert!(is_right(&series[0], &product), "{a:?} {b:?}");
            assert!(is_right(&series[1], &(&exact_a * &exact_a + &exact_b * &exact_b)), "{a:?}");
            let angle = Elementary::atan2(&exact_a, &exact_b);
            assert!(is_angle(&a.atan2(&b), &angle) && is_angle(&rough_a.atan2(&rough_b), &angle), "{a:?} {b:?}");
            if exact_b != Big::ZERO {
                let quotient = &exact_a / &exact_b;
                assert!(is_right(&(a / b), &quotient), "{a:?} {b:?} {:?}", a / b);
                assert!(is_right(&(rough_a / rough_b), &quotient), "{a:?} {b:?}");
            }
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
    // e^r - 1, by which the radius of an exponential grows.
    for index in 1..3_000 {
        let radius = 10f64.powf(-20.0 * (f64::from(index) * 3f64.sqrt()).fract()) * [1.0, 40.0][index as usize % 2];
        let exact = big(radius).exp() - big(1.0);
        let error = ((big(radius.exp_m1()) - &exact) / &exact).to_f64().value().abs();
        assert!(error <= 0.55 * 2f64.powi(-51), "{radius}: {error:e}");
    }
}

/// The leading f64 of a number may be finite where the remainder is not: splitting a factor above 2^996 overflows.
#[test]
fn of_a_midpoint_with_a_part_that_is_not_finite_nothing_is_known() {
    let torn = DoubleDouble::product(1e301, 1.0);
    assert!(torn.hi() == 1e301 && torn.lo().is_nan());
    for midpoint in [torn, torn.times_power_of_two(-30), -torn, f64::NAN.into(), f64::INFINITY.into()] {
        let ball = Ball::new(midpoint, 0.0);
        let one = ball.like(1.0);
        let [sin, cos] = ball.sine_and_cosine();
        #[rustfmt::skip]
        let results = [
            ball, -ball, ball + one, ball * one, ball / one, ball.exp(), ball.sqrt(), sin, cos, ball.atan2(&one),
            ball.times_power_of_two(-3), ball.widened(0.1), ball.magnitude(), one.like(midpoint.hi() * f64::INFINITY),
        ];
        for (number, found) in results.into_iter().enumerate() {
            assert!(!found.radius().is_finite() && !found.has_sign(), "{number} of {midpoint:?}: {found:?}");
            assert!(!found.has_known_sign(), "{number} of {midpoint:?}");
        }
    }
    for midpoint in [f64::NAN, f64::INFINITY] {
        let found = Ball::new(midpoint, 0.0);
        assert!(found.radius().is_infinite() && !found.exp().radius().is_finite(), "{found:?}");
    }
}

/// The distance from the origin overflows where neither of the coordinates does.
#[test]
fn an_angle_of_coordinates_next_to_the_largest_f64_keeps_its_error() {
    let corner = Ball::new(1.5e308, 1e307);
    let exact = big(1.6e308).atan2(&big(1.4e308));
    assert!(contains(&corner.atan2(&corner), &exact), "{:?}", corner.atan2(&corner));
    let double_double = Ball::new(DoubleDouble::exactly(1.5e308), 1e307);
    assert!(contains(&double_double.atan2(&double_double), &exact));
    let known = Ball::new(1.5e308, 0.0);
    assert!(known.atan2(&known).radius() < 1e-15);
    assert!(!Ball::new(DoubleDouble::exactly(1.0), f64::NAN).has_sign());
    assert!(!(corner / Ball::new(1e-30, 1e-30)).has_sign());
}

/// Checks the radii of the sum, the product and so on of two balls: they are those of the module's table, and no larger.
fn check_radii<N: Elementary>(a: &Ball<N>, b: &Ball<N>) {
    let digits = |value: f64| exactly(value).with_precision(DIGITS + 40).value();
    let (a_mid, b_mid) = (a.midpoint.to_big(), b.midpoint.to_big());
    let [x, y] = [&a_mid, &b_mid].map(|value| digits(0.0).like_big(value));
    let [size, other] = [x.magnitude(), y.magnitude()];
    let [r, s, rounding] = [a.radius, b.radius, a.midpoint.rounding()].map(digits);
    let (grown, one) = (digits(a.radius.exp_m1()), digits(1.0));
    let angle = Elementary::atan2(&x, &y).magnitude();
    let across = (&other + &s) * &r + (&size + &r) * &s;
    let [sin, cos] = a.sine_and_cosine();
    let positive = if a_mid > Big::ZERO { a.clone() } else { -a.clone() };
    let rows = [
        ("+", a.clone() + b.clone(), &r + &s + &rounding * (&x + &y).magnitude()),
        ("-", a.clone() - b.clone(), &r + &s + &rounding * (&x - &y).magnitude()),
        ("*", a.clone() * b.clone(), &size * &s + &other * &r + &r * &s + &rounding * &size * &other),
        ("/", a.clone() / b.clone(), (&r + &size / &other * &s) / (&other - &s) + &rounding * &size / &other),
        ("sqrt", positive.sqrt(), &r / (&size - &r).sqrt() + &rounding * size.sqrt()),
        ("exp", a.exp(), x.exp() * (grown + &rounding)),
        ("sin", sin, &r + &rounding * if size < one { &size } else { &one }),
        ("cos", cos, &r + &rounding),
        ("atan2", a.atan2(b), digits(1.5) * across / (&x * &x + &y * &y) + &rounding * angle),
        ("pi", a.pi(), &rounding * digits(4.0)),
        ("like_big", a.like_big(&y), &rounding * &other),
        ("widened", a.clone().widened(b.radius), &r + &s),
        ("times 2^3", a.times_power_of_two(3), &r * digits(8.0)),
    ];
    let largest = digits(1.0 + 1e-14);
    for (name, ball, radius) in rows {
        let found = digits(ball.radius);
        assert!(
            found >= radius,
            "{name}: {} < {}, {} {}",
            ball.radius,
            radius.to_f64().value(),
            a.to_f64(),
            b.to_f64()
        );
        let most = radius * &largest + digits(2.0 * TINY);
        assert!(found <= most, "{name}: {} > {}", ball.radius, most.to_f64().value());
    }
}

#[test]
fn the_radius_is_the_one_of_the_table() {
    for index in 1..40 {
        let [x, y] = [3.0, 5.0].map(|root: f64| 5.0 * (2.0 * (f64::from(index) * root.sqrt()).fract() - 1.0));
        for share in [0.0, 1e-60, 1e-31, 1e-16, 1e-6, 0.03] {
            let [r, s] = [share * x.abs(), 0.6 * share * y.abs()];
            check_radii(&Ball::new(x, r), &Ball::new(y, s));
            check_radii(&Ball::new(DoubleDouble::exactly(x), 0.0), &Ball::new(DoubleDouble::exactly(y), s));
            check_radii(&Ball::new(DoubleDouble::exactly(x), r), &Ball::new(DoubleDouble::exactly(y), s));
            check_radii(&Ball::new(big(x), r), &Ball::new(big(y), s));
        }
    }
}

/// The radii of two terms, of one product and of three: each product has the radius of the table, and the roundings of
/// n products and n - 1 sums are those of 2n operations on the sum of the sizes.
fn check_radii_of_series<N: Elementary>(one: &[Ball<N>; 2], other: &[Ball<N>; 2]) {
    let digits = |value: f64| exactly(value).with_precision(DIGITS + 40).value();
    let found = Ball::product_of_series(one, other, &[[1, 1]], &[0, 1]);
    let pairs: [&[[usize; 2]]; 2] = [&[[0, 0]], &[[0, 1], [1, 1], [1, 0]]];
    for (ball, pairs) in found.iter().zip(pairs) {
        let (mut middle, mut error, mut size) = (digits(0.0), digits(0.0), digits(0.0));
        for [i, j] in pairs {
            let [a, b] = [&one[*i], &other[*j]];
            let [x, y] = [a, b].map(|ball| digits(0.0).like_big(&ball.midpoint.to_big()));
            let [r, s] = [a.radius, b.radius].map(digits);
            error = error + x.magnitude() * &s + y.magnitude() * &r + &r * &s;
            size += (&x * &y).magnitude();
            middle += x * y;
        }
        let rounding = digits(ball.midpoint.rounding() * 2.0 * pairs.len() as f64);
        let (radius, found) = (error + &rounding * &size, digits(ball.radius));
        assert!(found >= radius, "{} < {}", ball.radius, radius.to_f64().value());
        assert!(found <= radius * digits(1.0 + 1e-14) + digits(2.0 * TINY), "{}", ball.radius);
        let off = digits(0.0).like_big(&ball.midpoint.to_big()) - middle;
        assert!(off.magnitude() <= rounding * size, "{}", ball.to_f64());
    }
}

#[test]
fn the_radius_of_a_term_of_a_product_is_that_of_its_parts() {
    for index in 1..40 {
        let [x, y, z, w] =
            [2.0, 3.0, 5.0, 7.0].map(|root: f64| 5.0 * (2.0 * (f64::from(index) * root.sqrt()).fract() - 1.0));
        for share in [0.0, 1e-60, 1e-31, 1e-16, 1e-6, 0.3, 4.0] {
            let [p, q, r, s] = [x, 0.6 * y, 0.0, 2.0 * w].map(|value: f64| share * value.abs());
            let of = |value: f64, radius| Ball::new(value, radius);
            check_radii_of_series(&[of(x, p), of(y, q)], &[of(z, r), of(w, s)]);
            let of = |value: f64, radius| Ball::new(DoubleDouble::exactly(value), radius);
            check_radii_of_series(&[of(x, p), of(y, q)], &[of(z, r), of(w, s)]);
            check_radii_of_series(&[of(z, r), of(w, s)], &[of(x, p), of(y, q)]);
        }
    }
}

#[test]
fn a_quotient_by_a_ball_that_nearly_holds_0_allows_for_the_rounding_of_the_distance() {
    for exponent in [-20, -35, -48] {
        for mantissa in [1.0, 1.3, 1.9] {
            // The nearest f64 is half of an ulp further from 0 than the number.
            let divisor = DoubleDouble::exactly(mantissa) - (0.49 * f64::EPSILON * mantissa).into();
            let [radius, one] = [mantissa * (1.0 - 2f64.powi(exponent)), 1.0];
            let found = Ball::new(DoubleDouble::exactly(one), 0.0) / Ball::new(divisor, radius);
            let size = big(divisor.hi()) + big(divisor.lo());
            let least = big(radius) / &size / (&size - big(radius));
            assert!(big(found.radius) >= least && found.radius < 1.2 * least.to_f64().value(), "{divisor:?} {found:?}");
        }
    }
}

#[test]
fn a_sign_is_known_beyond_the_radius_and_of_an_exact_zero() {
    for (midpoint, radius, has_sign, is_known) in [
        (1.0, 0.5, true, true),
        (-1.0, 0.5, true, true),
        (0.5, 0.5, false, false),
        (-0.5, 1.0, false, false),
        (0.0, 0.0, false, true),
        (0.0, 1e-300, false, false),
        (1.0, 0.0, true, true),
        (1.0, f64::INFINITY, false, false),
        (1.0, f64::NAN, false, false),
    ] {
        let ball = Ball::new(midpoint, radius);
        assert_eq!((ball.has_sign(), ball.has_known_sign()), (has_sign, is_known), "{ball:?}");
        assert_eq!(ball.sign(), if midpoint == 0.0 { 0.0 } else { midpoint.signum() });
        assert_eq!((ball.to_f64(), ball.to_double_double()), (midpoint, midpoint.into()));
        assert_eq!((ball.to_big(), ball.digits()), (exactly(midpoint), 53));
        assert!(ball.error() == radius || radius.is_nan());
        assert_eq!((ball.magnitude().midpoint, ball.like(2.5)), (midpoint.abs(), Ball::new(2.5, 0.0)));
    }
    // A difference of 0 is exact only between exact numbers.
    let [exact, rough] = [0.0, 1e-20].map(|radius| Ball::new(DoubleDouble::exactly(0.3), radius));
    assert_eq!((exact - exact).radius, 0.0);
    assert!((rough - rough).radius >= 2e-20 && (exact - rough).radius >= 1e-20);
    // Roots of balls around 0, and a quotient by one, say so.
    let around = Ball::new(-0.5, 1.0);
    assert!(around.sqrt().radius >= 0.5f64.sqrt() && around.sqrt().radius < 1.3);
    assert_eq!((exact.midpoint, (Ball::new(0.5, 0.0) / around).radius), (0.3.into(), f64::INFINITY));
}
