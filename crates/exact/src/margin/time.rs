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

use std::f64::consts::TAU;
use std::iter::successors;

use dynamics::phase::LARGEST_PHASE;
use dynamics::{CoinToss, Outcome, SolveError};
use numerics::Elementary;

use crate::given::{self, Vertical, inertia_ratio, right_to_roundings, scaled};
use crate::motion::CoinMotion;
use crate::tilt_terms::terms;

/// Relative error of half a change of the phase.
const RESOLUTION: f64 = 2e-13;

/// Digits to begin with, and after which a motion counts as one that touches the edge. Of components that differ by 2^2100,
/// as f64 allows, D is some 2^-4200 or exactly 0.
const DIGITS: usize = 192;
const MOST_DIGITS: usize = 12_288;

/// The changes of the time of flight (s) to the last flip before the landing of a decided toss, and to the next after it.
pub(super) fn flips(toss: &CoinToss, outcome: Outcome) -> Result<[Option<f64>; 2], SolveError> {
    let motion = CoinMotion::new(toss);
    let (phase, _) = motion.phases(toss.launch.time_of_flight())?;
    if motion.precession_rate() == 0.0 {
        return Ok([None; 2]);
    }
    let Some(halves) = in_double_double(toss).unwrap_or_else(|| in_digits(toss)) else { return Ok([None; 2]) };
    // Each flip is one of the turn after the landing, and one of the turn before.
    let changes = halves.map(|half| 2.0 * half);
    let later = changes.map(|change| if change.is_sign_positive() { change } else { change + TAU });
    let earlier = changes.map(|change| if change.is_sign_positive() { change - TAU } else { change });
    let (later, earlier) = (later[0].min(later[1]), earlier[0].max(earlier[1]));
    // Next to the launch, the phase does not tell whether the flip is after it. It is if the face then was the other.
    let [.., at_launch] = toss.launch.attitude().exact_vertical();
    let from_launch = earlier + phase.hi();
    let is_near = from_launch.abs() <= 1e-12 * phase.hi();
    let is_other = if at_launch.hi() > 0.0 { outcome == Outcome::Tails } else { outcome == Outcome::Heads };
    let is_after = if is_near { is_other && at_launch.hi() != 0.0 } else { from_launch.is_sign_positive() };
    let is_in_range = later < LARGEST_PHASE - phase.hi();
    let time_of = |(phase, exists)| Some(motion.time_of(phase)).filter(|change| exists && change.is_finite());
    Ok([(earlier, is_after), (later, is_in_range)].map(time_of))
}

/// h/2 of both flips (rad), from -π/2 to π/2; none if there are none, `None` if double-double has too few digits.
fn in_double_double(toss: &CoinToss) -> Option<Option<[f64; 2]>> {
    let (time, _) = given::in_double_double(&toss.launch)?;
    let vertical = Vertical::Own.in_double_double(&toss.launch.attitude());
    halves(toss, &time, vertical, inertia_ratio(&toss.coin))
}

/// The same in as many digits as it takes.
fn in_digits(toss: &CoinToss) -> Option<[f64; 2]> {
    let mut tries = successors(Some(DIGITS), |digits| Some(2 * digits)).take_while(|digits| *digits <= MOST_DIGITS);
    let in_so_many = |digits| {
        let (time, vertical) = given::in_digits(&toss.launch, digits);
        halves(toss, &time, vertical, right_to_roundings(toss.coin.inertia_ratio_in_digits(digits), digits))
    };
    tries.find_map(in_so_many).flatten()
}

/// h/2 of both flips, none if there are none, from the time in the unit of [`scaled`] rates, the vertical (BF) at launch, and
/// k; `None` if these have too few digits.
fn halves<N: Elementary>(toss: &CoinToss, time: &N, vertical: [N; 3], ratio: N) -> Option<Option<[f64; 2]>> {
    let square = |number: &N| number.clone() * number.clone();
    let [x, y, z] = scaled(&toss.launch.given_rate().0, time);
    let momentum = [x, y, ratio * z];
    let across = square(&momentum[0]) + square(&momentum[1]);
    let squared = across.clone() + square(&momentum[2]);
    let [mean, cosine, sine] = terms(vertical, momentum, across);
    let discriminant = square(&cosine) + square(&sine) * squared.clone() - square(&mean);
    // At a touch it is 0 in any number of digits, so that they end here, before the sine and cosine, which take longer.
    if discriminant.sign() == 0.0 || !discriminant.has_known_sign() {
        return None;
    }
    if discriminant.sign() < 0.0 {
        return Some(None);
    }
    let size = squared.sqrt();
    let [sin, cos] = (size.clone() * time.clone()).sine_and_cosine();
    let sine = sine * size;
    let f = mean.clone() + cosine.clone() * cos.clone() + sine.clone() * sin.clone();
    let slope = sine * cos - cosine * sin;
    let root = discriminant.sqrt();
    let g = mean.clone() + mean - f.clone();
    let q = if slope.sign() < 0.0 { root - slope } else { -(root + slope) };
    // The tangent tells h/2 but for half turns.
    let angle = |y: N, x: N| if x.sign() < 0.0 { (-y).atan2(&-x) } else { y.atan2(&x) };
    let halves = [angle(q.clone(), g), angle(f, q)];
    let is_right = |half: &N| half.error() < RESOLUTION * half.to_f64().abs();
    halves.iter().all(is_right).then(|| Some(halves.each_ref().map(N::to_f64)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;

    /// A toss at a phase `from_flip` rad after a flip, with k ωz = (1 + `from_touch`) |(ωx, ωy)|: from horizontal its cone
    /// touches the edge at 0. From another tilt it is far from a touch.
    fn toss(tilt: f64, from_touch: f64, from_flip: f64) -> Option<CoinToss> {
        let rate = [3.0, -4.0, 5.0 * (1.0 + from_touch) / 1.3];
        let at = |time: f64| {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
            CoinToss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch }
        };
        let start = at(2.0);
        let [_, earlier] =
            in_digits(&start)?.map(|half| 2.0 * half).map(|change| if change > 0.0 { change - TAU } else { change });
        let rate = CoinMotion::new(&start).phase(start.launch.time_of_flight()).unwrap() / 2.0;
        Some(at(2.0 + (earlier + from_flip) / rate))
    }

    /// Compares flips in double-double with those in more digits; whether they were found.
    fn is_found(toss: &CoinToss) -> bool {
        let Some(halves) = in_double_double(toss) else { return false };
        let exact = in_digits(toss).expect("flips");
        for (half, exact) in halves.expect("flips").into_iter().zip(exact) {
            assert!((half - exact).abs() <= RESOLUTION * exact.abs(), "{toss:?}: {half:e} {exact:e}");
        }
        true
    }

    #[test]
    fn flips_in_double_double_are_those_of_more_digits_and_all_but_the_nearest_are_found_so() {
        let (mut found, mut open) = (0, 0);
        for tilt in [0.0, 0.7, -2.0] {
            for from_touch in [-0.5, -0.1, -1e-3, -1e-6, -1e-9, -1e-12, -1e-15, 1e-15, 1e-3, 0.5] {
                for from_flip in [PI, 1.0, 0.1, -0.01, 1e-4, -1e-6, 1e-9, -1e-12, 1e-15] {
                    let Some(toss) = toss(tilt, from_touch, from_flip) else { continue };
                    let is_far = f64::abs(from_flip) >= 1e-12 && (f64::abs(from_touch) >= 1e-4 || tilt != 0.0);
                    let is_found = is_found(&toss);
                    assert!(is_found || !is_far, "{tilt} {from_touch} {from_flip}");
                    found += u32::from(is_found);
                    open += u32::from(!is_found);
                }
            }
        }
        assert!(found > 100 && open > 20, "{found} {open}");
    }

    #[test]
    fn beyond_a_touch_there_is_no_flip_and_at_one_double_double_does_not_say() {
        let toss = |from_touch: f64| {
            let launch = Launch::new([3.0, -4.0, 2.5 * (1.0 + from_touch)], TimeOfFlight::Given(2.0)).unwrap();
            CoinToss { coin: Coin::from_moments(1.0, 2.0).unwrap(), launch }
        };
        for from_touch in [0.5, 1e-3, 1e-9, 1e-12, 1e-15] {
            assert_eq!((in_double_double(&toss(from_touch)), in_digits(&toss(from_touch))), (Some(None), None));
        }
        assert_eq!((in_double_double(&toss(0.0)), in_digits(&toss(0.0))), (None, None));
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
}
