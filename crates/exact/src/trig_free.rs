//! This file proves outcomes without evaluating a sine or cosine. Many tosses never change their face, or land before
//! they can, and simple inequalities prove it at a fraction of the cost.
//!
//! [`TiltTerms`] gives `size` cos θ = G(φ) = A + B cos φ + C sin φ at the phase φ = ωL T of the landing. The outcome is
//! certain in two cases:
//!
//! - The coin never changes its face: |A| > √(B² + C²). From horizontal this means ψ < 45° or ψ > 135°, ψ being the
//!   angle between the coin's normal and its angular momentum. The outcome is the sign of A.
//! - The flight is too short for a change: |A + B| > |C| φ + ½ |B| φ² ≥ |G(φ) - G(0)|. The outcome is that of the
//!   launch, the sign of A + B. From horizontal this covers every phase below √2.

use dynamics::phase::LARGEST_PHASE;
use dynamics::{Outcome, Toss};
use numerics::UNIT_ROUNDOFF;

use crate::tilt_terms::TiltTerms;

/// The phase ωL T (rad) at landing. `None` if it or the phase |q| T of the spin may exceed [`LARGEST_PHASE`] or have
/// lost digits.
#[inline]
pub(crate) fn phase_in_range(toss: &Toss, terms: &TiltTerms) -> Option<f64> {
    const SMALLEST_TIME: f64 = 1e-200;
    let time = toss.launch.flight_time();
    let [phase, spin] = terms.phases(time);
    // A smaller time may have lost digits that matter at the largest rates. The comparisons also reject a NaN.
    let in_range =
        (time >= SMALLEST_TIME || time == 0.0) && phase < 0.99 * LARGEST_PHASE && spin < 0.99 * LARGEST_PHASE;
    in_range.then_some(phase)
}

/// The proven outcome of a toss by its terms and the phase of its landing (rad). `None` if it takes a sine and cosine
/// to tell.
///
/// The errors, with u the [`UNIT_ROUNDOFF`] and an error of at most 12u `size` in each term:
///
/// ```text
/// |A| - √(B² + C²)              29u size          12u (1 + √2)
/// times |A| + √(B² + C²)        70u size²         which is at most 2.4 size
/// A² - (B² + C²), as computed   78u size²         8u for its operations
/// A + B                         25u size          two terms and one sum
/// |C| φ                         19u φ size        12u of C, 6u of φ, one product
/// ½ |B| φ²                      13u φ² size       6u of B, 6u of φ², two products
/// ```
///
/// The code uses 100 for the 78, and 32, 24 and 16 for the 25, 19 and 13; the difference is a margin.
#[inline]
pub(crate) fn trig_free_by(terms: &TiltTerms, phase: f64) -> Option<Outcome> {
    let TiltTerms { mean, cosine, sine, size, .. } = *terms;
    let amplitude_squared = cosine * cosine + sine * sine;
    if mean * mean - amplitude_squared > 100.0 * UNIT_ROUNDOFF * (size * size) {
        return Some(Outcome::of(mean, 0.0));
    }
    let (launch, change) = (mean + cosine, phase * (sine.abs() + 0.5 * cosine.abs() * phase));
    let error = (32.0 + phase * (24.0 + 16.0 * phase)) * UNIT_ROUNDOFF * size;
    (launch.abs() - change > error).then(|| Outcome::of(launch, 0.0))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;
    use crate::multiprecision::by_multiprecision;

    fn trig_free(toss: &Toss) -> Option<Outcome> {
        let terms = TiltTerms::new(toss);
        trig_free_by(&terms, phase_in_range(toss, &terms)?)
    }

    fn toss(k: f64, rate: [f64; 3], tilt: f64, time: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss { coin: Coin::from_moments(1.0, k).unwrap(), launch: launch.with_tilt(tilt).unwrap() }
    }

    #[test]
    fn the_outcome_is_certain_below_45_degrees_and_before_the_first_flip() {
        // tan ψ = Ω/(k ωz), here just below and just above 1.
        assert_eq!(trig_free(&toss(2.0, [1.999, 0.0, 1.0], 0.0, 1e9)), Some(Outcome::Heads));
        assert_eq!(trig_free(&toss(2.0, [2.001, 0.0, 1.0], 0.0, 1e9)), None);
        // End over end, the first flip is at π/2 rad; the inequality is certain up to √2 rad.
        assert_eq!(trig_free(&toss(2.0, [1.0, 0.0, 0.0], 0.0, SQRT_2 - 1e-8)), Some(Outcome::Heads));
        assert_eq!(trig_free(&toss(2.0, [1.0, 0.0, 0.0], 0.0, SQRT_2 + 1e-8)), None);
        // Upside down, and at rest.
        assert_eq!(trig_free(&toss(2.0, [1.0, 0.0, 9.0], 3.1, 1e9)), Some(Outcome::Tails));
        assert_eq!(trig_free(&toss(2.0, [0.0; 3], 2.0, 1.0)), Some(Outcome::Tails));
        // A phase beyond the limit is not decided here, so that the caller can refuse it.
        assert_eq!(trig_free(&toss(2.0, [1.0, 0.0, 9.0], 0.0, 1e300)), None);
    }

    /// The launches are near both limits, down to a few units in the last place: cones of nearly 45° that land at their
    /// lowest point, and coins nearly on edge that land as they pass it.
    #[test]
    fn certain_outcomes_are_those_of_multiprecision() {
        let mut decided = [0, 0];
        for index in 0..3000 {
            let part = |irrational: f64| 2.0 * (f64::from(index) * irrational).fract() - 1.0;
            let nearness = 10f64.powi(-(index % 17)) * part(13f64.sqrt());
            let (k, x, z) = (f64::from(1 + index % 4) * 0.5, 40.0 * part(2f64.sqrt()), 40.0 * part(5f64.sqrt()));
            let across = k * z * (1.0 + nearness);
            let graze = toss(k, [across, 0.0, z], 0.0, PI / across.hypot(k * z));
            let edge = toss(
                k,
                [x, 0.0, 0.0],
                FRAC_PI_2 + nearness,
                nearness.abs() / x.abs() * (1.0 + 1e-3 * part(3f64.sqrt())),
            );
            for (toss, decided) in [graze, edge].iter().zip(&mut decided) {
                let Some(outcome) = trig_free(toss) else { continue };
                *decided += 1;
                assert_eq!(outcome, by_multiprecision(toss), "{toss:?}");
            }
        }
        assert!(decided.iter().all(|decided| *decided > 700), "{decided:?}");
    }

    /// Terms with these values instead of those of a toss.
    fn terms(mean: f64, cosine: f64, sine: f64, size: f64) -> TiltTerms {
        let mut terms = TiltTerms::new(&toss(1.0, [1.0, 0.0, 0.0], 0.0, 1.0));
        (terms.mean, terms.cosine, terms.sine, terms.size) = (mean, cosine, sine, size);
        terms
    }

    /// At each threshold the outcome is not yet certain; two units beyond it, it is.
    #[test]
    fn decides_only_beyond_its_thresholds() {
        const U: f64 = UNIT_ROUNDOFF;
        let certain_at = |terms: TiltTerms, phase: f64| trig_free_by(&terms, phase).is_some();
        // The face never changes: A² - (B² + C²) above 100 u size². At a phase of 10 the other inequality never holds.
        for (units, certain) in [(448.0, false), (450.0, false), (452.0, true)] {
            assert_eq!(certain_at(terms(1.0, 1.0 - units * U, 0.0, 3.0), 10.0), certain, "{units}");
            assert_eq!(certain_at(terms(1.0, 0.0, 1.0 - units * U, 3.0), 10.0), certain, "{units}");
        }
        // The flight is too short, at phase 0: A + B above 32 u size.
        for (units, certain) in [(94.0, false), (96.0, false), (98.0, true)] {
            assert_eq!(certain_at(terms(1.0, units * U - 1.0, 0.0, 3.0), 0.0), certain, "{units}");
        }
        // The same at half a radian: A + B - |C| φ above (32 + 24 φ + 16 φ²) u size = 144 u.
        for (units, certain) in [(142.0, false), (144.0, false), (146.0, true)] {
            for sign in [1.0, -1.0] {
                let sine = sign * (2.0 - 2.0 * units * U);
                assert_eq!(certain_at(terms(1.0, 0.0, sine, 3.0), 0.5), certain, "{units}");
            }
        }
        // |A + B| - ½ |B| φ² > 0, with A = 0: phases below √2.
        assert!(certain_at(terms(0.0, -1.0, 0.0, 1.0), 1.414) && !certain_at(terms(0.0, -1.0, 0.0, 1.0), 1.4143));
    }

    #[test]
    fn accepts_phases_up_to_99_percent_of_the_largest() {
        let in_range = |k: f64, rate: [f64; 3], time: f64| {
            let toss = toss(k, rate, 0.0, time);
            phase_in_range(&toss, &TiltTerms::new(&toss)).is_some()
        };
        for (part, taken) in [(0.985, true), (0.99, false), (0.995, false)] {
            let time = part * LARGEST_PHASE;
            assert_eq!(in_range(1.0, [1.0, 0.0, 0.0], time), taken, "precession {part}");
            assert_eq!(in_range(0.0, [0.0, 0.0, 1.0], time), taken, "spin {part}");
        }
        for (time, taken) in [(0.0, true), (1e-200, true), (0.99e-200, false)] {
            assert_eq!(in_range(1.0, [1.0, 0.0, 0.0], time), taken, "{time}");
        }
    }
}
