//! Tests of the constants of the ideal flight and of each part of the recursion, against the exact motion and against the
//! formulas of the proof.

use dynamics::nalgebra::Matrix3;
use dynamics::{Body, Launch, TimeOfFlight, Vector3};
use exact::ExactMotion;

use super::*;

const MOMENTS: [[f64; 3]; 4] = [[1.0, 2.0, 2.5], [0.2, 1.0, 1.1], [1.0, 1.0 + 1e-6, 1.9], [0.02, 1.0, 1.01]];

/// A plate as thin as rounding, whose first coupling is 1.85.
const THIN: [f64; 3] = [1.2e-16, 1.0, 1.000_000_000_000_000_2];

/// Rates whose largest is between 1 and 2, so that the unit of the flight is 1 rad/s.
const RATES: [[f64; 3]; 4] = [[0.7, -0.4, 1.1], [-1.3, 0.2, 0.3], [0.1, 1.5, 0.4], [1.0, -0.01, 0.002]];

fn toss(moments: [f64; 3], rate: [f64; 3]) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(10.0)).unwrap();
    Toss { body: Body::from_moments(moments).unwrap(), launch }
}

fn polhode(toss: &Toss) -> Polhode {
    Polhode::new(toss, &toss.body.rigid().model(), &Flight::new(toss).unwrap()).unwrap()
}

fn tosses() -> impl Iterator<Item = ([f64; 3], Toss)> {
    MOMENTS.into_iter().flat_map(|moments| RATES.map(|rate| (moments, toss(moments, rate))))
}

/// The rates at some times.
fn rates(toss: &Toss) -> impl Iterator<Item = Vector3<f64>> {
    let motion = ExactMotion::new(toss);
    (0..40).map(move |step| motion.state(0.25 * f64::from(step)).unwrap().rate)
}

/// f and its Jacobian, from the moments.
fn field([a, b, c]: [f64; 3], rate: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let [p, q, r] = [(b - c) / a, (c - a) / b, (a - b) / c];
    let (x, y, z) = (rate.x, rate.y, rate.z);
    let jacobian = Matrix3::new(0.0, p * z, p * y, q * z, 0.0, q * x, r * y, r * x, 0.0);
    (Vector3::new(p * y * z, q * z * x, r * x * y), jacobian)
}

#[test]
fn the_constants_are_upper_bounds_along_the_whole_flight() {
    let mut closest = [0.0_f64; 4];
    for (moments, toss) in tosses() {
        let polhode = polhode(&toss);
        for rate in rates(&toss) {
            let (f, jacobian) = field(moments, &rate);
            let momentum = Vector3::from(moments).component_mul(&rate);
            let growth = (0.5 * (jacobian + jacobian.transpose())).symmetric_eigenvalues().amax();
            let across = rate - momentum * (rate.dot(&momentum) / momentum.norm_squared());
            let shares = [
                rate.norm() / polhode.fastest,
                growth / polhode.growth,
                across.norm() / polhode.across,
                jacobian.norm() / (ROOT_2 * polhode.coupling * polhode.fastest),
            ];
            for (closest, share) in closest.iter_mut().zip(shares) {
                assert!(share <= 1.0 + 1e-12, "{shares:?}, {toss:?}");
                *closest = closest.max(share);
            }
            let ([a, b, c], [x, y, z]) = (moments, [rate.x, rate.y, rate.z].map(|part| part * part));
            let [p, q, r] = [(c - b) / a, (c - a) / b, (b - a) / c];
            let [of_a, of_b] = [x + p / q * y, z + r / q * y];
            let fastest = (x + y + z + p * r * y).sqrt();
            let most_across = (c * q * (of_a * of_b).sqrt() / momentum.norm()).min(fastest);
            for (found, expected) in [
                (polhode.fastest, fastest),
                (polhode.coupling, q),
                (polhode.growth, (p + r) * fastest * INVERSE_ROOT_3),
                (polhode.across, most_across),
                (polhode.invariants[0].to_f64(), of_a),
                (polhode.invariants[1].to_f64(), of_b),
            ] {
                approx::assert_relative_eq!(found, expected, max_relative = 1e-9, epsilon = 0.0);
            }
            let speed = polhode.speed(rate.into()) * polhode.coupling;
            approx::assert_relative_eq!(speed, f.norm(), max_relative = 1e-9, epsilon = 1e-15);
        }
    }
    assert!(closest.iter().all(|share| *share > 0.75), "{closest:?}");
}

/// The error across the curve is at most what the invariants tell, and not much less.
#[test]
fn the_invariants_bound_an_error_across_the_curve() {
    const SIZE: f64 = 1e-6;
    for (moments, toss) in tosses() {
        let (polhode, mut ratios) = (polhode(&toss), Vec::new());
        for (index, rate) in rates(&toss).enumerate() {
            let (f, _) = field(moments, &rate);
            let any = Vector3::new((index as f64).sin(), (1.3 * index as f64).cos(), (2.1 * index as f64).sin());
            let error = f.cross(&any).normalize() * SIZE;
            let computed: [f64; 3] = (rate + error).into();
            let least = polhode.speed_near(computed, 1.1 * SIZE);
            let found = polhode.across(computed, 1.1 * SIZE, least);
            assert!(found >= SIZE * (1.0 - 1e-6), "{found:e} {toss:?}");
            ratios.push(polhode.across(computed, 1e-3, least) / SIZE);
        }
        ratios.sort_by(f64::total_cmp);
        assert!(ratios[10] < 3.0, "{}, {toss:?}", ratios[10]);
    }
}

/// Of κ1 and κ3 with a known error, the speed is smaller and the gradients are larger by what the error can make of them.
#[test]
fn errors_of_the_constants_count_by_their_formulas() {
    for (moments, toss) in tosses() {
        let plain = polhode(&toss);
        let kappas = [(0, 1e-4), (1, 3e-4)].map(|(index, radius): (usize, f64)| plain.kappas[index].widened(radius));
        let wide = Polhode { kappas, ..plain };
        let (rates, [r, s]) = (toss.launch.rate().into(), kappas.map(|kappa| kappa.radius()));
        let ([x, y, z], [k, l]) = (rates, kappas.map(|kappa| kappa.to_f64()));
        let speed = (k * y * z).hypot(x * z).hypot(l * x * y);
        let expected = speed - 2.0 * (r + s) * wide.fastest * wide.fastest;
        approx::assert_relative_eq!(wide.speed(rates), expected, epsilon = 1e-15, max_relative = 1e-12);
        let (error, ideal, [of_a, of_b]) = (1e-2, 0.5, wide.residuals(rates));
        let off = wide.widest * error;
        let across_a = x.hypot(k * y) + off + r * wide.fastest;
        let across_b = z.hypot(l * y) + off + s * wide.fastest;
        let expected = 0.5 * (across_a * of_b + across_b * of_a) / (ideal - 0.5 * off * (across_a + across_b));
        let found = wide.across(rates, error, ideal);
        approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-12);
        assert!(expected < error && wide.across(rates, 1e-12, ideal) == 1e-12);
        assert!(of_a >= r * y * y && of_b >= s * y * y && r >= 1e-4 && s >= 3e-4, "{moments:?}");
    }
}

/// A and B are off by how far the rates are from the curve, by their own errors and by roundings of double-double alone.
#[test]
fn what_the_invariants_are_off_adds_up() {
    let of_dd = 20.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF;
    let plain = polhode(&toss(MOMENTS[0], RATES[0]));
    let off = |[r, s, far]: [f64; 3], rates: [f64; 3]| {
        let ball = |value: f64, radius: f64| Ball::new(DoubleDouble::exactly(value), radius);
        let [a, b] = [rates[0], rates[2]].map(|part| part * part);
        let of = |square: f64, kappa: f64| ball(square + kappa * rates[1] * rates[1] + far, s);
        Polhode { kappas: [ball(0.5, r), ball(0.25, r)], invariants: [of(a, 0.5), of(b, 0.25)], ..plain }
            .residuals(rates)
    };
    for (parts, expected) in [
        ([0.0; 3], [of_dd * 2.0 * 0.6875, of_dd * 2.0 * 1.625]),
        ([1e-9, 0.0, 0.0], [0.25e-9; 2]),
        ([0.0, 1e-9, 0.0], [1e-9; 2]),
        ([0.0, 0.0, 0.0625], [0.0625; 2]),
        ([0.0, 0.0, -0.0625], [0.0625; 2]),
    ] {
        for (found, expected) in off(parts, [0.75, -0.5, 1.25]).into_iter().zip(expected) {
            approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-12);
        }
    }
    assert_eq!(off([0.0; 3], [0.0; 3]), [TINY * TINY; 2], "underflow");
}

/// Each bound of a number that is known to a radius is strictly above what the radius allows, by a few roundings.
#[test]
fn bounds_of_numbers_have_room_for_their_rounding_and_no_more() {
    let ball = |value: f64, radius: f64| Ball::new(DoubleDouble::exactly(value), radius);
    let slightly_above = |found: f64, least: f64| assert!(found > least && found < least * (1.0 + 4e-15), "{found:e}");
    slightly_above(above(&ball(3.0, 0.5)), 3.5);
    slightly_above(above(&ball(-3.0, 0.5)), 3.5);
    let ideal = [ball(1.0, 0.25), ball(2.0, 0.5), ball(-1.0, 0.0)];
    slightly_above(distance(&ideal, [1.5, 2.25, -1.5]), 2.0);
    slightly_above(distance(&ideal.map(|ball| Ball::new(*ball.midpoint(), 0.0)), [1.5, 2.25, -1.5]), 1.25);
    // The angular momentum is (3, 4, 0).
    let (moments, rates) = ([1.0, 2.0, 2.5].map(|moment| ball(moment, 0.0)), [3.0, 2.0, 0.0]);
    slightly_above(across(&moments, &rates.map(|rate| ball(rate, 0.0)), 0.5), 0.25);
    let wide = across(&moments, &rates.map(|rate| ball(rate, 0.01)), 0.5);
    assert!(wide > 0.5 * 2.5 / (5.0 - 0.022) && wide < 0.5 * 2.5 / 4.9, "{wide}");
    assert_eq!(across(&moments, &rates.map(|rate| ball(rate, 10.0)), 0.5), f64::INFINITY);
    let axes = |radii: [f64; 3]| [radii, [0.0; 3], [0.0; 3]].map(|axis| axis.map(|radius| ball(1.0, radius)));
    let (found, expected) = (axes_error(&axes([1e-9, 3e-9, 2e-9])), 18e-9 + 12.0 * UNIT_ROUNDOFF);
    approx::assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-12);
    assert_eq!(axes_error(&[[ball(0.8, 0.0); 3]; 3]), 12.0 * UNIT_ROUNDOFF);
    for radii in [[f64::NAN, 0.0, 0.0], [0.0, f64::NAN, 1e-9], [0.0, 1e-9, f64::NAN]] {
        assert!(axes_error(&axes(radii)).is_nan(), "{radii:?}");
    }
}

/// The growth of an error is (16), and none is bounded that would more than double by its square.
#[test]
fn an_error_grows_by_its_formula() {
    for (_, toss) in tosses().chain([(THIN, toss(THIN, RATES[0]))]) {
        let polhode = polhode(&toss);
        assert!(polhode.widest >= polhode.rounded_kappas()[0].max(1.0), "κ1 of a thin plate is above 1");
        for (start, h) in [(1e-9, 0.1), (1e-3, 0.7), (0.02, 1.0), (0.1, 2.5), (0.3, 2.0), (2.0, 9.0)] {
            let first = start * exp_above(polhode.growth * h);
            let square = exp_above(2.0 * 0.5774 * polhode.widest * polhode.coupling * first * h);
            let expected = if square <= 2.0 { first * square } else { f64::INFINITY };
            approx::assert_relative_eq!(polhode.grown(start, h), expected, epsilon = 0.0, max_relative = 1e-12);
            let off = start * polhode.widest * (1.4143 * polhode.fastest + 0.5774 * start);
            let expected = polhode.speed(RATES[0]) - off;
            approx::assert_relative_eq!(polhode.speed_near(RATES[0], start), expected, max_relative = 1e-12);
        }
    }
}

/// A flight by other couplings than those of the toss has no bound: of a body that is nearly a sphere they are tiny.
#[test]
fn couplings_of_another_body_are_refused() {
    for moments in [MOMENTS[0], [1.0, 1.0 + 1e-6, 1.0 + 2e-6], [1.0, 1.3, 1.3 + 1e-9]] {
        let toss = toss(moments, RATES[0]);
        let (model, couplings) = (toss.body.rigid().model(), toss.body.rigid().couplings());
        assert!(are_told(&model, couplings), "{moments:?}");
        for index in 0..3 {
            let mut other = couplings;
            other[index] += 4.0 * UNIT_ROUNDOFF * couplings[1].abs();
            assert!(!are_told(&model, other), "{moments:?} {index}");
        }
    }
}

/// The parts of one step are those of the formulas (16), (17) and (20), and at most two thirds more.
#[test]
fn each_part_of_a_step_counts_by_its_formula() {
    const H: f64 = 0.1;
    let (moments, rate) = (MOMENTS[0], RATES[0]);
    let toss = toss(moments, rate);
    let polhode = polhode(&toss);
    let after = ExactMotion::new(&toss).state(H).unwrap().rate;
    let (speeds, growth) = ([rate.into(), after].map(|rate| field(moments, &rate).0.norm()), polhode.growth);
    let slowest = speeds[0].min(speeds[1]);
    let within = |found: f64, least: f64| assert!((least..1.67 * least).contains(&found), "{found:e}, not {least:e}");
    for (across, rates, rounding) in [(1e-9, 0.0, 0.0), (0.0, 1e-9, 0.0), (0.0, 0.0, 1e-9), (1e-9, 3e-9, 2e-9)] {
        let mut errors = Errors::at_launch(polhode, rate);
        (errors.along.across, errors.growing.error) = (across, across);
        errors.add(&Step { h: H, turn: 3e-7, rates, rounding, after: after.into() });
        let reach = (across + rates) * (growth * H).exp();
        for integral in [errors.along.integral, errors.growing.integral].into_iter().filter(|_| reach > 0.0) {
            within(integral, H * reach * (1.0 - 1e-9));
        }
        within(errors.growing.error, reach + rounding);
        within(errors.along.shift, (2.0 * growth * H * reach + rates + rounding) / slowest * 0.99);
        let expected = 3e-7 + 0.5 * errors.growing.integral;
        approx::assert_relative_eq!(errors.bound(), expected, epsilon = 0.0, max_relative = 1e-9);
        errors.growing.integral = f64::INFINITY;
        let expected = 3e-7 + 0.5 * errors.along.integral + polhode.across * errors.along.shift;
        approx::assert_relative_eq!(errors.bound(), expected, epsilon = 0.0, max_relative = 1e-9);
    }
    assert_eq!(Errors::at_launch(polhode, rate).fastest(), polhode.fastest);
    let moved = Errors::at_launch(Polhode { launched: 1e-9, ..polhode }, rate);
    within(moved.along.shift, 1e-9 / speeds[0] * 0.99);
    assert!(moved.growing.error == 1e-9 && moved.along.across <= 1e-9);
}

#[test]
fn a_bound_of_the_exponential_is_above_it_and_close() {
    for x in [0.0, 1e-9, 0.1, 1.0, 3.0, 10.0] {
        assert!(exp_above(x) >= f64::exp(x) * (1.0 - 1e-15) && exp_above(x) <= f64::exp(x) * (1.0 + 0.01 * x * x * x));
    }
    assert_eq!([exp_above(16.0), exp_above(1e300)], [f64::INFINITY; 2]);
}

/// The shift is bounded by (17) exactly where the conditions (18) hold, and underflow counts unless no product can have it.
#[test]
fn a_shift_is_bounded_where_its_conditions_hold() {
    let (mut bounded, mut refused) = (0, 0);
    let steps = |launch| (0..24).flat_map(move |power| [0.01, 0.1, 0.5, 1.0].map(|h| (launch, power, h)));
    for ((moments, start), power, h) in steps((MOMENTS[0], [1e-3, 1.5, 1e-3])).chain(steps((THIN, RATES[0]))) {
        let polhode = polhode(&toss(moments, start));
        let error = 1e-6 * 1.5_f64.powi(power);
        let mut errors = Errors::at_launch(polhode, start);
        errors.add(&Step { h, turn: 0.0, rates: error, rounding: 0.5 * error, after: start });
        let reach = polhode.grown(error, h);
        let most = reach + 0.5 * error;
        let time = |speed: f64| {
            let tilt = 1.4143 * polhode.widest * polhode.fastest * most / speed;
            let arc =
                (2.0 * polhode.growth + 0.5774 * polhode.widest * polhode.coupling * reach) * h * reach + 1.5 * error;
            if tilt <= 0.25 { arc / (1.0 - tilt) / (polhode.coupling * speed) } else { f64::INFINITY }
        };
        let (first, end) = (polhode.speed_near(start, 0.0), polhode.speed_near(start, most));
        let least = first / exp_above(polhode.growth * h);
        let slowed = polhode.growth * time(0.875 * least);
        if slowed > 0.125 || end <= 0.0 {
            refused += 1;
            assert_eq!(errors.along.shift, f64::INFINITY, "{error:e} {h}");
        } else {
            bounded += 1;
            let speed = least.max((first * end).sqrt() / exp_above(0.5 * polhode.growth * h)) * (1.0 - slowed);
            let share = errors.along.shift / time(speed);
            assert!((1.0 + 5e-12..1.0 + 2e-11).contains(&share), "{share} of the formula, with room for its roundings");
        }
    }
    assert!(bounded > 20 && refused > 20, "{bounded} {refused}");
    let (start, still) =
        ([1e-3, 1.5, 1e-3], Step { h: 0.0, turn: 0.0, rates: 0.0, rounding: 0.0, after: [0.0, 1.5, 0.0] });
    let mut errors = Errors::at_launch(polhode(&toss(MOMENTS[0], start)), start);
    errors.add(&Step { after: start, ..still });
    assert!(errors.growing.error >= 1e-150 && errors.along.shift < 1e-140);
    // A step to the middle axis, and a launch about it.
    errors.add(&Step { rounding: 1e-6, ..still });
    let launched = Errors::at_launch(polhode(&toss(MOMENTS[0], still.after)), still.after);
    assert_eq!([errors.along.shift, launched.along.shift], [f64::INFINITY; 2]);
}

/// Rates in another unit whose product with it may leave the range of f64, or lose digits below it.
#[test]
fn rates_in_another_unit_near_the_ends_of_the_range_are_refused() {
    let degree = dynamics::Unit::DEGREE;
    for (size, is_told) in [(1e-210, false), (1e-190, true), (1.0, true), (1e190, true), (1e210, false)] {
        let rates = [40.0, -23.0, 63.0].map(|part: f64| part * size);
        let launch = Launch::in_unit(rates, degree, TimeOfFlight::Given(10.0 / size)).unwrap();
        let toss = Toss { body: Body::from_moments(MOMENTS[0]).unwrap(), launch };
        assert_eq!(
            Polhode::new(&toss, &toss.body.rigid().model(), &Flight::new(&toss).unwrap()).is_some(),
            is_told,
            "{size:e}"
        );
    }
}

/// A body whose smallest moment may underflow has no bound. Equal moments have one, and those that are nearly equal.
#[test]
fn bodies_without_a_curve_are_refused() {
    let is_told = |body: Body| {
        let toss = Toss { body, ..toss(MOMENTS[0], RATES[0]) };
        Polhode::new(&toss, &toss.body.rigid().model(), &Flight::new(&toss).unwrap()).is_some()
    };
    for (smallest, expected) in [(0.0, true), (SMALLEST, true), (0.9 * SMALLEST, false)] {
        assert_eq!(is_told(Body::from_moments([smallest, 1.0, 1.0]).unwrap()), expected, "{smallest:e}");
    }
    for off in [1e-10, 1e-20, 1e-200] {
        let body = Body::from_tensor([[1.0, off, 0.0], [off, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
        assert!(is_told(body), "{off:e}");
    }
    assert!(is_told(Body::from_moments([1.0; 3]).unwrap()));
    assert!(is_told(Body::from_tensor([[5.0, 1.0, 1.0], [1.0, 5.0, 1.0], [1.0, 1.0, 5.0]]).unwrap()));
}

/// A body that is not quite its model turns away from it by (21), and one that is its own model does not.
#[test]
fn the_difference_from_the_model_counts() {
    let found = |off: f64, span: f64| {
        let body = Body::from_tensor([[1.0, off, 0.0], [off, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
        let launch = Launch::new(RATES[0], TimeOfFlight::Given(span)).unwrap();
        let polhode = polhode(&Toss { body, launch });
        (polhode.axes - 12.0 * UNIT_ROUNDOFF, 1.5 * polhode.fastest * span)
    };
    for (off, span) in [(1e-50, 1e12), (1e-55, 1e13)] {
        let (found, phase) = found(off, span);
        // The moments are 1 - off, 1 and 1 + off, and the model is a sphere.
        let expected = 2.0 * off * phase * phase * (1.0 + phase / 5.0);
        assert!((1.0..1.01).contains(&(found / expected)), "{off:e}: {found:e}, {expected:e}");
    }
    assert!(found(1e-45, 1e3).0.abs() < 1e-20, "the axes are known");
}

/// Rates in degrees and the axes of a tensor are rounded, and no more.
#[test]
fn the_rounding_of_the_toss_counts() {
    let degree = dynamics::Unit::DEGREE;
    let launch = Launch::in_unit([40.0, -23.0, 63.0], degree, TimeOfFlight::Given(10.0)).unwrap();
    let exact = Toss { body: Body::from_moments(MOMENTS[0]).unwrap(), launch };
    for (rate, is_about_axis) in [([40.0, 0.0, 0.0], true), ([40.0, 0.0, 1.0], false)] {
        let launch = Launch::in_unit(rate, degree, TimeOfFlight::Given(10.0)).unwrap();
        assert_eq!(polhode(&Toss { launch, ..exact }).about_axis, is_about_axis, "{rate:?}");
    }
    let off = [40.0, -23.0, 63.0].map(|part: f64| {
        let exact = DoubleDouble::nearest(&degree.in_digits(160)) * part;
        (exact - (part.to_radians()).into()).hi().abs()
    });
    approx::assert_relative_eq!(polhode(&exact).launched, off.iter().sum::<f64>(), epsilon = 0.0, max_relative = 1e-6);
    let body = Body::from_tensor([[2.0, 0.3, -0.1], [0.3, 2.2, 0.25], [-0.1, 0.25, 1.4]]).unwrap();
    let tensor = Toss { body, ..toss(MOMENTS[0], RATES[0]) };
    let (found, rates) = (polhode(&tensor), Flight::new(&tensor).unwrap().rate);
    assert!(found.launched > 0.0 && found.launched < 4.0 * UNIT_ROUNDOFF);
    assert!(Errors::at_launch(found, rates.into()).bound() >= 12.0 * UNIT_ROUNDOFF);
    let plain = toss(MOMENTS[0], RATES[0]);
    assert_eq!((polhode(&plain).launched, Errors::at_launch(polhode(&plain), RATES[0]).bound()), (0.0, 0.0));
}

/// Axes are those of the body frame only where that is known: an axis that rounds to one of them is not.
#[test]
fn axes_that_are_known_but_for_a_rounding_are_not_exact() {
    let frame = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let with_radius = |radius: f64| frame.map(|axis| axis.map(|part| Ball::new(DoubleDouble::exactly(part), radius)));
    assert!(are_exact(&with_radius(0.0)) && !are_exact(&with_radius(1e-300)));
    let mut turned = with_radius(0.0);
    turned[0][2] = Ball::new(DoubleDouble::exactly(0.8), 0.0);
    assert!(!are_exact(&turned));
}

/// The smallest parts of a rate lose digits below the smallest f64 in the unit of the flight.
#[test]
fn what_underflow_takes_from_a_rate_is_within_its_bound() {
    let axes = |radius: f64| {
        [0, 1, 2].map(|axis| {
            let part = |place| Ball::new(DoubleDouble::exactly(f64::from(u8::from(place == axis))), radius);
            [0, 1, 2].map(part)
        })
    };
    let least = f64::from_bits(1);
    for (largest, smallest) in [(4.5, 3.0 * least), (4.5, 5.0 * least), (4.5, 7.0 * least), (1e250, 1e-100)] {
        let launch = Launch::new([largest, smallest, -1.0], TimeOfFlight::Given(1.0 / largest)).unwrap();
        let toss = Toss { launch, ..toss(MOMENTS[0], RATES[0]) };
        let flight = Flight::new(&toss).unwrap();
        let scale = numerics::scale::power_of_two_scale(largest);
        let found = ideal_rates(&toss, &axes(0.0), &flight).unwrap()[1];
        let lost = (found.midpoint().to_f64() * scale - smallest).abs() / scale;
        assert!(found.radius() >= lost && (1e-300..1.01e-300).contains(&found.radius()), "{smallest:e}: {found:?}");
    }
    let least = toss(MOMENTS[0], [1.0, TINY, -1.0]);
    assert_eq!(ideal_rates(&least, &axes(0.0), &Flight::new(&least).unwrap()).unwrap()[1].radius(), 0.0);
    let at_rest = toss(MOMENTS[0], [0.0; 3]);
    let found = ideal_rates(&at_rest, &axes(1e-30), &Flight::new(&at_rest).unwrap()).unwrap()[1];
    assert!((TINY..1.01 * TINY).contains(&found.radius()), "{found:?}");
}
