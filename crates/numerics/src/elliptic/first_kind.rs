//! The arithmetic-geometric mean and the integrals of the first kind that follow from it.

use std::f64::consts::TAU;

use super::{negligible, times};
use crate::elementary::Elementary;
use crate::scale::mantissa_and_exponent;

/// Means a and b after some steps from 1 and `b`, while `visit` is called with the means before each step.
///
/// A step leaves (a - b)/a squared and divided by eight or so. The last one starts below the square root of the
/// precision.
fn means<N: Elementary>(one: N, b: N, mut visit: impl FnMut(&N, &N)) -> N {
    let enough = negligible(&one).sqrt();
    let (mut a, mut b) = (one, b);
    // Numbers of 10^-4000 need 14 steps to meet, and some more for the digits. NaN and 0 never meet.
    for _ in 0..64 {
        let meets = (a.clone() - b.clone()).to_f64().abs() / a.to_f64() <= enough;
        let left = distance_after_step(&a, &b);
        visit(&a, &b);
        let root = geometric_mean(&a, &b);
        (a, b) = ((a + b).halved(), root);
        if meets {
            let error = left * a.to_f64();
            return a.widened(error);
        }
    }
    a.widened(f64::INFINITY)
}

/// A bound of (a - b)/a after the next step of the means, in units of the midpoint of a, for all numbers of two balls. A
/// distance of d leaves less than d²/4 for d ≤ ½.
fn distance_after_step<N: Elementary>(a: &N, b: &N) -> f64 {
    let difference = a.clone() - b.clone();
    let distance = (difference.to_f64().abs() + difference.error()) / (a.to_f64() - a.error());
    let is_small = (0.0..=0.5).contains(&distance);
    if is_small { distance * distance + 2f64.powi(-a.digits().min(1000)) } else { f64::INFINITY }
}

/// The nome q = exp(-π K'/K), from K and K' = K(1 - m).
pub fn nome<N: Elementary>(k: N, k_prime: N) -> N {
    (-(k.pi() * k_prime / k)).exp()
}

/// F(φ | m) for an amplitude of 0 ≤ φ ≤ π/2, and the complementary modulus 0 < k' ≤ 1.
///
/// φ is the angle of the point (`cos`, `sin`), neither of them negative. Where tan φ > 1/k', more than half of K, it is
/// better to take K - F of the complementary amplitude, whose tangent is 1/(k' tan φ): near π/2 the digits of F are in
/// that of φ.
///
/// By Landen's transformation φ turns by the angle of (a cos φ, b sin φ) in each step of the means a, b. The point
/// (cos φ, sin φ) is turned, not the angle, so that no step needs a function.
pub fn incomplete_first<N: Elementary>(sin: &N, cos: &N, complementary_modulus: N) -> N {
    let [incomplete, _] = incomplete_and_complete_first(sin, cos, complementary_modulus);
    incomplete
}

/// F(φ | m) as [`incomplete_first`], and K(m) = π/(2 AGM(1, k')), which is the same iteration.
pub fn incomplete_and_complete_first<N: Elementary>(sin: &N, cos: &N, complementary_modulus: N) -> [N; 2] {
    let mut point = unit_sized([cos.clone(), sin.clone()]);
    // The turned angle (rad), right to some roundings: it tells the turns, which the point does not.
    let mut angle = point[1].to_f64().atan2(point[0].to_f64());
    let (mut steps, mut left) = (0, f64::INFINITY);
    let mean = means(complementary_modulus.like(1.0), complementary_modulus, |a, b| {
        left = distance_after_step(a, b);
        let [x, y] = point.clone();
        let slower = [a.clone() * x, b.clone() * y];
        let turn = slower[1].to_f64().atan2(slower[0].to_f64());
        angle += turn + TAU * ((angle - turn) / TAU).round();
        point = unit_sized(times(&point, &slower));
        steps += 1;
    });
    let [x, y] = point;
    let rest = y.atan2(&x);
    let turns = ((angle - rest.to_f64()) / TAU).round();
    let amplitude = rest.pi() * rest.like(2.0 * turns) + rest.clone();
    // Of a ball of points around the origin, not even the number of turns is known.
    let is_known = rest.error() < 3.0;
    let error = if is_known { left * (amplitude.to_f64().abs() + amplitude.error()) } else { f64::INFINITY };
    let complete = rest.pi().halved() / mean.clone();
    [(amplitude.widened(error) / mean).times_power_of_two(-steps), complete]
}

/// K(m), and the complete integral of the third kind in Bulirsch's form, for `p` > 0 and weights a, b ≥ 0:
///
/// ```text
/// cel(k', p, a, b) = ∫ (a cos²φ + b sin²φ)/((cos²φ + p sin²φ) √(cos²φ + k'² sin²φ)) dφ      from 0 to π/2
/// ```
///
/// Each step of the means leaves an integral of the same form (R. Bulirsch, Numer. Math. 13 (1969), 305). Its integrand
/// is positive. In the last one k' is within δ of 1, and taking it as 1 changes the integral by less than δ of itself.
pub fn complete_first_and_third<N: Elementary>(complementary_modulus: N, p: &N, [a, b]: [f64; 2]) -> [N; 2] {
    let enough = negligible(p).sqrt();
    let (mut m, mut k, mut p) = (p.like(1.0), complementary_modulus, p.sqrt());
    let (mut a, mut b) = (p.like(a), p.like(b) / p.clone());
    // Of means that never meet, which are NaN or 0, nothing is known.
    let (mut steps, mut left) = (0, f64::INFINITY);
    for _ in 0..64 {
        let meets = (m.clone() - k.clone()).to_f64().abs() / m.to_f64() <= enough;
        let next = distance_after_step(&m, &k);
        let product = m.clone() * k.clone();
        let shift = product.clone() / p.clone();
        let twice = b.clone() + a.clone() * shift.clone();
        a = a + b / p.clone();
        b = twice.clone() + twice;
        p = p + shift;
        (m, k) = (m.clone() + k.clone(), geometric_mean(&m, &k).times_power_of_two(1));
        steps += 1;
        if meets {
            left = next;
            break;
        }
    }
    let quarter_turn = m.pi().halved();
    let third = quarter_turn.clone() * (b + a * m.clone()) / (m.clone() * (m.clone() + p));
    let first = quarter_turn / m.times_power_of_two(-steps);
    [first, third].map(|integral| {
        let error = left * (integral.to_f64().abs() + integral.error());
        integral.widened(error)
    })
}

/// √(ab). b is taken near 1, so that no digit of the product underflows.
fn geometric_mean<N: Elementary>(a: &N, b: &N) -> N {
    let half_exponent = mantissa_and_exponent(b.to_f64()).1.div_euclid(2);
    (a.clone() * b.times_power_of_two(-2 * half_exponent)).sqrt().times_power_of_two(half_exponent)
}

/// A point of the same direction, with a larger coordinate between 1 and 2.
fn unit_sized<N: Elementary>(point: [N; 2]) -> [N; 2] {
    let mut point = point;
    // A number of many digits may be far below the range of f64.
    for _ in 0..8 {
        let size = point[0].to_f64().abs().max(point[1].to_f64().abs());
        let exponent = if size == 0.0 { -1000 } else { mantissa_and_exponent(size).1 };
        point = point.map(|part| part.times_power_of_two(-exponent));
        if size != 0.0 {
            break;
        }
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::big::exactly;

    /// In many digits a point may be far nearer to the origin than any f64.
    #[test]
    fn a_point_of_any_size_is_brought_to_that_of_1() {
        for exponent in [-5000, -1100, -3, 0, 900] {
            let part = |value: f64| exactly(value).with_precision(200).value().times_power_of_two(exponent);
            let found = unit_sized([part(-0.75), part(1.25)]).map(|part| part.to_f64().value());
            let larger = found[1];
            assert!((1.0..2.0).contains(&larger) && found[0] == -0.6 * larger, "{exponent}: {found:?}");
        }
    }

    #[test]
    fn the_distance_after_a_step_is_that_of_the_farthest_numbers_of_two_balls() {
        for (a, b, expected) in [
            ((2.0, 0.5), (1.875, 0.0), (0.625_f64 / 1.5).powi(2)),
            ((2.0, 0.0), (1.75, 0.25), 0.0625),
            ((2.0, 0.0), (2.25, 0.0), 0.015625),
            ((2.0, 0.0), (0.5, 0.0), f64::INFINITY),
            ((2.0, 3.0), (2.0, 0.0), f64::INFINITY),
        ] {
            let [a, b] = [a, b].map(|(midpoint, radius)| Ball::new(midpoint, radius));
            let found = distance_after_step(&a, &b);
            let least = expected + 2f64.powi(-53);
            assert!(found >= least * (1.0 - 1e-15) && found <= least * (1.0 + 1e-14), "{a:?} {b:?}: {found}");
        }
        // Means that never meet are known by nothing.
        let mean = |b: f64| means(Ball::new(1.0, 0.0), Ball::new(b, 0.0), |_, _| ());
        assert_eq!(mean(0.0).radius(), f64::INFINITY);
        assert!(mean(1e-300).radius() < 1e-16);
    }
}
