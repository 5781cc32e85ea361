//! The nearest flips along the time of flight, in closed form.
//!
//! At the landing let f = cos θ = A + B cos φ + C sin φ with the phase φ = |L| T, and f' its slope by φ. A phase h further,
//! with τ = tan(h/2),
//!
//! ```text
//! (1 + τ²) f(φ + h) = f + 2 f' τ + g τ²       g = 2A - f
//! D = f'² - f g = B² + C² - A²
//! τ = q/g and τ = f/q                         q = -(f' ± √D), with the sign that f' has
//! ```
//!
//! are the flips. There is none for D ≤ 0, and a touch at D = 0. What a difference can cancel is f, f', g and D: where their
//! errors count, as next to an edge or a touch, they are found in more digits.

use std::f64::consts::{PI, TAU};
use std::iter::successors;

use dynamics::CoinToss;
use numerics::big::Big;
use numerics::{DoubleDouble, Elementary};

use super::line::{error_of_vertical, fine_error};
use crate::motion::momentum_direction;
use crate::multiprecision::{flight_time, momentum};
use crate::tilt_terms::terms;

/// Relative error of a change of the phase.
const RESOLUTION: f64 = 2e-13;

/// Digits to begin with, and after which a motion counts as one that touches the edge. Of components that differ by 2^2100,
/// as f64 allows, D is some 2^-4200 or exactly 0.
const DIGITS: usize = 192;
const MOST_DIGITS: usize = 12_288;

/// Of these digits at most 80 are lost: the phase is up to 2^53, and there are some thirty operations.
const LOST_DIGITS: usize = 80;

/// The changes of the `phase` of the landing (rad) to the next flip and to the last one before, if the motion flips at all.
pub(super) fn flips(toss: &CoinToss, phase: DoubleDouble) -> Option<[f64; 2]> {
    let halves = in_double_double(toss, phase).unwrap_or_else(|| in_digits(toss))?;
    // Each flip is one of the turn after the landing, and one of the turn before.
    let changes = halves.map(|half| 2.0 * half);
    let later = changes.map(|change| if change.is_sign_positive() { change } else { change + TAU });
    let earlier = changes.map(|change| if change.is_sign_positive() { change - TAU } else { change });
    Some([later[0].min(later[1]), earlier[0].max(earlier[1])])
}

/// h/2 of both flips (rad), from -π/2 to π/2.
fn halves<N: Elementary>([f, slope, g, root]: [&N; 4]) -> [N; 2] {
    let sum = |a: &N, b: &N| a.clone() + b.clone();
    let q = if slope.sign() < 0.0 { sum(&-slope.clone(), root) } else { -sum(slope, root) };
    [q.clone() / g.clone(), f.clone() / q]
}

/// h/2 of both flips, none if there are none; `None` if more digits are needed.
fn in_double_double(toss: &CoinToss, phase: DoubleDouble) -> Option<Option<[f64; 2]>> {
    let [term_error, error, g_error] = errors_of_terms(phase.hi(), error_of_vertical(toss));
    let direction = momentum_direction(toss);
    let [x, y, _] = direction;
    let [mean, cosine, sine] = terms(toss.launch.attitude().exact_vertical(), direction, x * x + y * y);
    let (sin, cos) = phase.exact_sin_cos();
    let (f, slope) = (mean + cosine * cos + sine * sin, sine * cos - cosine * sin);
    let g = mean + mean - f;
    let discriminant = cosine * cosine + sine * sine - mean * mean;
    let d_error = error_of_discriminant([mean, cosine, sine].map(DoubleDouble::hi), term_error);
    if discriminant.hi() < -d_error {
        return Some(None);
    }
    if discriminant.hi() <= 4.0 * d_error {
        return None;
    }
    let root = discriminant.sqrt();
    let [by_g, by_q] = halves([&f, &slope, &g, &root]).map(|tangent| tangent.hi().atan());
    let values = [f, slope, g, root].map(DoubleDouble::hi);
    let [off_g, off_q] = errors_of_halves(values, [error, g_error, d_error]);
    let is_right = off_g < RESOLUTION * by_g.abs() && off_q < RESOLUTION;
    is_right.then_some(Some([by_g, by_q]))
}

/// Bounds of the errors of A, B and C, of f and f', and of g at a `phase` (rad), with that `of_vertical`.
fn errors_of_terms(phase: f64, of_vertical: f64) -> [f64; 3] {
    const OF_TERMS: f64 = 2.465_190_328_815_662e-30; // 200 u²
    let (of_terms, of_values) = (OF_TERMS + of_vertical, fine_error(phase) + of_vertical);
    [of_terms, of_values, of_values + 2.0 * of_terms]
}

/// Bound of the error of D if A, B and C are off by `error`.
fn error_of_discriminant(terms: [f64; 3], error: f64) -> f64 {
    4.0 * terms.map(|term| term.abs() + error).iter().sum::<f64>() * error
}

/// Bounds of the error (rad) of the first of both [`halves`], and of the relative one of the second, if f and f' are off by
/// `error`, g by `g_error` and D by `d_error` < D/4.
fn errors_of_halves([f, slope, g, root]: [f64; 4], [error, g_error, d_error]: [f64; 3]) -> [f64; 2] {
    let (q_size, q_error) = (slope.abs() + root, error + d_error / root);
    let (f_size, g_size) = (f.abs(), g.abs());
    let off_g = (q_error * g_size + g_error * q_size) / (q_size * q_size + g_size * g_size);
    [off_g, error / f_size + q_error / q_size]
}

/// h/2 of both flips in as many digits as it takes.
fn in_digits(toss: &CoinToss) -> Option<[f64; 2]> {
    let mut tries = successors(Some(DIGITS), |digits| Some(2 * digits)).take_while(|digits| *digits <= MOST_DIGITS);
    tries.find_map(|digits| in_so_many_digits(toss, digits)).flatten()
}

/// As [`in_double_double`], in `digits` binary digits.
fn in_so_many_digits(toss: &CoinToss, digits: usize) -> Option<Option<[f64; 2]>> {
    let round = |value: Big| value.with_precision(digits).value();
    let (vertical, norm) = toss.launch.attitude().vertical_in_digits(digits);
    let [x, y, z] = momentum(toss, digits);
    let across = &x * &x + &y * &y;
    let squared = &across + &z * &z;
    // Without the factor |m| |L|² of all terms, of which each is then right to 2^(10 - digits).
    let size = &squared * round(norm);
    let bound = Big::ONE >> (digits - LOST_DIGITS - 60).cast_signed();
    let is_clear = |value: &Big, of: &Big| value.magnitude() > of * &bound;
    let rate = squared.sqrt();
    let [mean, cosine, sine] = terms(vertical.map(round), [x, y, z], across);
    let discriminant = &cosine * &cosine + &sine * &sine * &squared - &mean * &mean;
    // At a touch it is 0 in any number of digits, so that they end here, before the sine and cosine, which take longer.
    if !is_clear(&discriminant, &(&size * &size)) {
        return None;
    }
    if discriminant < Big::ZERO {
        return Some(None);
    }
    let (sin, cos) = (&rate * flight_time(toss, digits)).sin_cos();
    let sine = sine * rate;
    let (f, slope) = (&mean + &cosine * &cos + &sine * &sin, &sine * &cos - &cosine * &sin);
    if !is_clear(&f, &size) {
        return None;
    }
    let g = &mean + &mean - &f;
    let root = discriminant.sqrt();
    // An infinite tangent is that of half a turn.
    let is_level = g == Big::ZERO;
    let divisor = if is_level { g.like(1.0) } else { g };
    let [by_g, by_q] = halves([&f, &slope, &divisor, &root]).map(|tangent| tangent.to_f64().value().atan());
    Some(Some([if is_level { 0.5 * PI } else { by_g }, by_q]))
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;
    use crate::motion::CoinMotion;

    /// A toss at a phase `from_flip` rad after a flip, with k ωz = (1 + `from_touch`) |(ωx, ωy)|: from horizontal its cone
    /// touches the edge at 0. From another tilt it is far from a touch.
    fn toss(tilt: f64, from_touch: f64, from_flip: f64) -> Option<(CoinToss, DoubleDouble)> {
        let rate = [3.0, -4.0, 5.0 * (1.0 + from_touch) / 1.3];
        let at = |time: f64| {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
            CoinToss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch }
        };
        let phase = |toss: &CoinToss| {
            let [x, y, z] = super::super::line::turn(toss);
            (x * x + y * y + z * z).sqrt()
        };
        let start = at(2.0);
        let [_, earlier] =
            in_digits(&start)?.map(|half| 2.0 * half).map(|change| if change > 0.0 { change - TAU } else { change });
        let rate = CoinMotion::new(&start).phase(start.launch.time_of_flight()).unwrap() / 2.0;
        let near = at(2.0 + (earlier + from_flip) / rate);
        Some((near, phase(&near)))
    }

    /// Compares flips in double-double with those in more digits; whether they were found.
    fn is_found(toss: &CoinToss, phase: DoubleDouble) -> bool {
        let Some(halves) = in_double_double(toss, phase) else { return false };
        let exact = in_digits(toss).expect("flips");
        for (half, exact) in halves.expect("flips").into_iter().zip(exact) {
            assert!((half - exact).abs() <= RESOLUTION * exact.abs(), "{toss:?}: {half:e} {exact:e}");
        }
        true
    }

    #[test]
    fn flips_in_double_double_are_those_of_more_digits_and_all_but_the_nearest_are_found_so() {
        let (mut found, mut open) = (0, 0);
        for (tilt, least) in [(0.0, 1e-13), (0.7, 1e-6), (-2.0, 1e-6)] {
            for from_touch in [-0.5, -0.1, -1e-3, -1e-6, -1e-9, -1e-12, -1e-15, 1e-15, 1e-3, 0.5] {
                for from_flip in [PI, 1.0, 0.1, -0.01, 1e-4, -1e-6, 1e-9, -1e-12, 1e-15] {
                    let Some((toss, phase)) = toss(tilt, from_touch, from_flip) else { continue };
                    let is_far = f64::abs(from_flip) >= 10.0 * least && (f64::abs(from_touch) >= 1e-4 || tilt != 0.0);
                    let is_found = is_found(&toss, phase);
                    assert!(is_found || !is_far, "{tilt} {from_touch} {from_flip}");
                    found += u32::from(is_found);
                    open += u32::from(!is_found);
                }
            }
        }
        assert!(found > 100 && open > 20, "{found} {open}");
    }

    /// The vertical of a tilted coin has fewer digits, which count most where the cone just reaches the horizontal.
    #[test]
    fn flips_of_tilted_coins_next_to_a_touch_are_those_of_more_digits() {
        let (mut found, mut open) = (0, 0);
        for from_touch in [-0.3, -0.05] {
            let reaches = |tilt: f64| toss(tilt, from_touch, 1.0).is_some();
            let [mut flips, mut none] = [0.0, if reaches(0.8) { -0.8 } else { 0.8 }];
            assert!(reaches(flips) && !reaches(none));
            while (flips - none).abs() > 1e-15 {
                let middle = f64::midpoint(flips, none);
                *(if reaches(middle) { &mut flips } else { &mut none }) = middle;
            }
            for power in 1..16 {
                let tilt = flips - none.signum() * 10f64.powi(-power);
                for from_flip in [1.0, -1e-2, 1e-3, -1e-4, 1e-5, 1e-6, -1e-7, 1e-9] {
                    let Some((toss, phase)) = toss(tilt, from_touch, from_flip) else { continue };
                    let is_found = is_found(&toss, phase);
                    assert!(is_found || power > 3 || f64::abs(from_flip) < 1e-4, "{tilt} {from_flip}");
                    // Of the root, half as many digits are left as the discriminant loses.
                    assert!(!is_found || power < 10 || f64::abs(from_flip) > 1e-3, "{tilt} {from_flip}");
                    found += u32::from(is_found);
                    open += u32::from(!is_found);
                }
            }
        }
        assert!(found > 40 && open > 40, "{found} {open}");
    }

    #[test]
    fn beyond_a_touch_there_is_no_flip_and_at_one_double_double_does_not_say() {
        let toss = |from_touch: f64| {
            let launch = Launch::new([3.0, -4.0, 2.5 * (1.0 + from_touch)], TimeOfFlight::Given(2.0)).unwrap();
            CoinToss { coin: Coin::from_moments(1.0, 2.0).unwrap(), launch }
        };
        let phase = DoubleDouble::from(10.0);
        for from_touch in [0.5, 1e-3, 1e-9, 1e-12, 1e-15] {
            assert_eq!((in_double_double(&toss(from_touch), phase), in_digits(&toss(from_touch))), (Some(None), None));
        }
        assert_eq!((in_double_double(&toss(0.0), phase), in_digits(&toss(0.0))), (None, None));
        assert!(in_digits(&toss(-1e-15)).is_some());
    }

    /// A horizontal launch touches the edge where k ωz = |(ωx, ωy)|, of any size and in a quaternion of any size. With a k
    /// whose digits do not end, only the last digits tell; with ωy next to 0, only the first of many.
    #[test]
    fn a_touch_is_told_from_two_flips_next_to_each_other() {
        let [large, small] = [200.0, -200.0].map(f64::exp2);
        let scales = [(1.0, 1.0), (large, 1.0), (large, 1e50), (small, 1e50), (1.0, 1e50), (1.0, 1e-50)];
        for (inverse, (scale, norm)) in
            [1.0, 3.0, 5.0, 7.0, 11.0, 13.0].into_iter().flat_map(|k| scales.map(|s| (k, s)))
        {
            let flips = |y: f64| {
                let rate = [1.0, y, inverse].map(|part| part * scale);
                let launch = Launch::new(rate, TimeOfFlight::Given(1.0 / scale)).unwrap();
                let attitude = dynamics::Attitude::from_components([norm, 0.0, 0.0, 0.0]).unwrap();
                let coin = Coin::from_moments(inverse, 1.0).unwrap();
                in_digits(&CoinToss { coin, launch: launch.with_attitude(attitude) })
            };
            let rest = (PI - std::f64::consts::SQRT_2) / 2.0;
            assert_eq!(flips(0.0), None, "{inverse} {scale} {norm}");
            for y in [1e-20, 1e-60, 1e-100] {
                let found = flips(y).unwrap_or_else(|| panic!("{inverse} {scale} {norm} {y}: no flip"));
                assert!(
                    found.iter().all(|half| (half - rest).abs() < 1e-15),
                    "{inverse} {scale} {norm} {y}: {found:?}"
                );
            }
        }
    }

    /// With L along (1, 0, 2) and the vertical along (-3, 12, 4), half a turn about L takes cos θ from 4/13 to exactly 0.
    #[test]
    fn a_flip_after_half_a_turn_is_one_in_many_digits() {
        let attitude = dynamics::Attitude::from_components([17.0, 12.0, 3.0, 0.0]).unwrap();
        let launch = Launch::new([1.0, 0.0, 2.0], TimeOfFlight::Given(0.0)).unwrap().with_attitude(attitude);
        let toss = CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
        let phases = in_digits(&toss).unwrap().map(|half| (2.0 * half).rem_euclid(TAU));
        assert!(phases[0] == PI && phases[1] != PI, "{phases:?}");
        for phase in phases {
            let cos_tilt = CoinMotion::new(&toss).cos_tilt(phase / 5f64.sqrt()).unwrap();
            assert!(cos_tilt.abs() < 1e-15, "{phase}: {cos_tilt:e}");
        }
    }

    #[test]
    fn errors_of_the_terms_are_those_of_double_double_and_of_the_vertical() {
        let unit = 2f64.powi(-106);
        for (phase, vertical) in [(0.0, 0.0), (30.0, 0.0), (0.0, 5e4), (30.0, 1e3)] {
            let found = errors_of_terms(phase, vertical * unit).map(|error| error / unit);
            let of_values = 2000.0 + 100.0 * phase;
            let expected = [200.0 + vertical, of_values + vertical, of_values + 400.0 + 3.0 * vertical];
            assert!(found.iter().zip(expected).all(|(error, expected)| (error / expected - 1.0).abs() < 1e-15));
        }
    }

    /// All errors at their worst, or one of them alone, change D and the flips by no more than the bounds and by a quarter.
    #[test]
    fn bounds_are_what_errors_of_the_terms_make_of_the_flips() {
        let signs = || (0..16).map(|bits| [1, 2, 4, 8].map(|bit| if bits & bit == 0 { 1.0 } else { -1.0 }));
        for (terms, error) in [([0.3, -0.5, 0.7], 1e-3), ([1e-3, 0.5, 1e-3], 0.01), ([0.2, 1e-4, 0.2], 0.1)] {
            let change = |[a, b, c]: [f64; 3]| b * b + c * c - a * a;
            let moved = signs().map(|s| change([0, 1, 2].map(|term: usize| terms[term] + s[term] * error)));
            let [most, bound] = [
                moved.fold(0.0, |most, d| f64::max(most, (d - change(terms)).abs())),
                error_of_discriminant(terms, error),
            ];
            assert!(most <= bound && bound < 4.0 * most, "{terms:?}: {most:e} {bound:e}");
        }
        for values in [[0.1, 0.7, 0.4, 0.6], [-1e-4, -0.2, 0.9, 0.3], [0.6, 1e-3, -1e-2, 0.9], [0.1, 0.1, 0.3, 0.02]] {
            let of = |[f, slope, g, discriminant]: [f64; 4]| {
                halves([f, slope, g, discriminant.sqrt()].map(DoubleDouble::from).each_ref()).map(|t| t.hi().atan())
            };
            let [f, slope, g, root] = values;
            let exact = of([f, slope, g, root * root]);
            for errors in [[1e-9, 0.0, 0.0], [0.0, 1e-9, 0.0], [0.0, 0.0, 1e-9], [1e-9, 2e-9, 3e-10]] {
                let [error, g_error, d_error] = errors;
                let mut most = [0.0_f64; 2];
                for [a, b, c, d] in signs() {
                    let moved = [f + a * error, slope + b * error, g + c * g_error, root * root + d * d_error];
                    for ((most, half), exact) in most.iter_mut().zip(of(moved)).zip(exact) {
                        *most = most.max((half - exact).abs());
                    }
                }
                let bounds = errors_of_halves(values, errors);
                for (most, bound) in [most[0], most[1] / exact[1].abs()].into_iter().zip(bounds) {
                    assert!(most <= bound * (1.0 + 1e-5) + 1e-15, "{values:?} {errors:?}: {most:e} {bound:e}");
                    assert!(bound <= 4.0 * most + 1e-15, "{values:?} {errors:?}: {most:e} {bound:e}");
                }
            }
        }
    }

    #[test]
    fn the_nearer_flip_loses_no_digit_to_a_difference() {
        for slope in [1.0, -1.0] {
            let (f, g) = (1e-40, 0.5);
            let [far, near] = halves([f, slope, g, 1.0].map(DoubleDouble::from).each_ref());
            let [far, near] = [far, near].map(|tangent| tangent.hi() * slope);
            assert!((far + 4.0).abs() < 1e-15 && (near + 0.5e-40).abs() < 1e-55, "{far:e} {near:e}");
        }
    }
}
