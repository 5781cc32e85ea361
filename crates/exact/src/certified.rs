//! This file proves the outcome of a toss: whether the ideal flight with exactly the numbers that coin and launch were
//! made from ends in heads or tails. It tries stages from the cheapest to the most accurate and stops at the first whose
//! error bound is smaller than |cos θ|, so that for nearly all tosses a proof costs little more than plain f64.
//!
//! The numbers are the moments or the cylinder, the rates, the tilt or the quaternion, and the time or the speed, gravity
//! and drop. Values derived from them, as k = 6 r²/(3 r² + h²) or the vertical seen from a tilted coin, are not rounded
//! before the proof, or the bound covers their rounding.
//!
//! The stages use more and more digits, after the adaptive predicates of J. R. Shewchuk, Discrete Comput. Geom. 18 (1997),
//! 305. φ is the phase ωL T at landing, and u = 2^-53:
//!
//! **1. f64.** [`TiltTerms`] gives G = A + B cos φ + C sin φ, which has the sign of cos θ. The errors derived there
//! lead to these, in units of `size` ≥ |A|, √(B² + C²), |G|:
//!
//! ```text
//! A                                    12u
//! B, C                                 14.8u       √(10.9² + 9.9²), as cos² + sin² = 1
//! cos, sin                             2.9u        √2 · 2u: std is assumed right to 2 ulp, of numbers below 1
//! φ                                    6u φ        |dG/dφ| ≤ size
//! B cos, C sin                         1.42u       rounded products, |B| + |C| ≤ √2 size
//! the two sums                         2u
//! sum                                  33.2u + 6u φ
//! ```
//!
//! [`f64_bound`] rounds this up, to cover the squares of u and the rounding of the bound itself. Underflow loses less
//! than 2^-1000, and `size` is above 10^-200. The ratio k is rounded once, and the vertical of
//! [`Attitude::vertical`](dynamics::Attitude::vertical) is right to the errors that the errors of A, B and C are derived
//! from, whatever the attitude was made from.
//!
//! Rates that were not given in rad/s are rounded to it, with a relative error of u each. This turns the landed coin by at
//! most u φ, which is added to the bound.
//!
//! A coin whose |A| exceeds √(B² + C²) never changes its face, so that the sign of A decides without a sine or cosine:
//!
//! ```text
//! |A| - √(B² + C²)              29u size          12u (1 + √2)
//! times |A| + √(B² + C²)        70u size²         which is at most 2.4 size
//! A² - (B² + C²), as computed   78u size²         8u for its operations; the code uses 100
//! ```
//!
//! **2. Double-double.** The same formula, in [`Ball`]s of double-double numbers: they contain the numbers as they were
//! given and cover each rounding. Launches whose rates are not in rad/s, or differ too much, go on to the next stage.
//!
//! **3. As many digits as it takes.** The formula in balls of more digits, whose number doubles until the sign is certain:
//! see `multiprecision.rs`.

use dynamics::phase::LARGEST_PHASE;
use dynamics::{Attitude, CoinToss, Outcome, SolveError, Stage};
use numerics::{Ball, DoubleDouble, Elementary, UNIT_ROUNDOFF};

use crate::certificate::Certificate;
use crate::given::{in_double_double, inertia_ratio};
use crate::motion::{CoinMotion, LARGEST_PHASE_IN_DOUBLE_DOUBLE};
use crate::multiprecision::{by_multiprecision, rounded_cos_tilt};
use crate::tilt_terms::{TiltTerms, cos_tilt_in};

/// Proves the outcome of a toss.
#[inline]
pub(crate) fn certify_coin(toss: &CoinToss) -> Result<Certificate, SolveError> {
    match by_f64(toss) {
        Some(outcome) => Ok(Certificate::new(outcome, Stage::F64)),
        None => with_more_digits(toss),
    }
}

/// cos θ at landing to the error [`COS_TILT_ERROR`](crate::motion::COS_TILT_ERROR), and of the sign of the proven outcome:
/// it is 0 for a tie alone. Near 0, where that error would take the leading digits, at large phases and for rates that are
/// not in rad/s, it is rounded from more digits.
pub fn cos_tilt(toss: &CoinToss) -> Result<f64, SolveError> {
    // Above the error of double-double at any phase.
    const NEAR_0: f64 = 1e-9;
    let (cos_tilt, phase) = CoinMotion::new(toss).cos_tilt_parts(toss.launch.time_of_flight())?;
    let cos_tilt = cos_tilt.hi().clamp(-1.0, 1.0);
    let is_short = phase.hi() <= LARGEST_PHASE_IN_DOUBLE_DOUBLE;
    let is_right = is_short && cos_tilt.abs() > NEAR_0 && toss.launch.rate_error() == 0.0;
    Ok(if is_right { cos_tilt } else { rounded_cos_tilt(toss) })
}

/// Whether all tosses land as `toss` does whose rates, inertia ratio k and time of flight differ from its own by up to
/// `relative`, a small part of each. For `false` nothing is known.
///
/// cos θ is the height of ẑ, turned by Φ = (ωx, ωy, k ωz) T and seen from the attitude at launch, and so changes by no more
/// than Φ does. Three factors change Φ by up to 3.1 `relative` |Φ|, where |Φ| is the phase; 4 covers the rounding of cos θ and
/// of the bound, for a `relative` of 4 u or more.
pub fn holds_within(toss: &CoinToss, relative: f64) -> Result<bool, SolveError> {
    let phase = CoinMotion::new(toss).phase(toss.launch.time_of_flight())?;
    Ok(cos_tilt(toss)?.abs() > 4.0 * relative * phase)
}

/// The stage in f64. `None` if |cos θ| is within the error bound.
#[inline]
fn by_f64(toss: &CoinToss) -> Option<Outcome> {
    if let Some(phase) = flat_phase(toss) {
        return decided(phase.cos(), f64_bound(phase));
    }
    let terms = TiltTerms::new(toss);
    by_terms(&terms, phase_in_range(toss, &terms)?, toss.launch.rate_error())
}

/// Heads or tails by a cosine with this error bound.
#[inline]
fn decided(cos_tilt: f64, bound: f64) -> Option<Outcome> {
    match Outcome::of(cos_tilt, bound) {
        Outcome::Undecided => None,
        decided => Some(decided),
    }
}

/// The phase Ω T (rad) of a coin that is thrown flat and without spin, Ω = √(ωx² + ωy²). Its A and C are 0, and cos θ is
/// cos(Ω T) (J. B. Keller, Am. Math. Mon. 93 (1986), 191), with an error of at most 2u + 4u Ω T. `None` for any other toss,
/// and outside the range in which squares, time and phase keep their digits.
#[inline]
fn flat_phase(toss: &CoinToss) -> Option<f64> {
    const SQUARES: std::ops::Range<f64> = 1e-200..1e200;
    const PHASES: std::ops::Range<f64> = 1e-100..0.99 * LARGEST_PHASE;
    let rate = toss.launch.rate();
    let squared = rate.x * rate.x + rate.y * rate.y;
    let is_flat = rate.z == 0.0 && toss.launch.attitude() == Attitude::IDENTITY && toss.launch.rate_error() == 0.0;
    if !(is_flat && SQUARES.contains(&squared)) {
        return None;
    }
    Some(squared.sqrt() * toss.launch.flight_time()).filter(|phase| PHASES.contains(phase))
}

/// The phase ωL T (rad) at landing. `None` if it or the phase |q| T of the spin may exceed [`LARGEST_PHASE`] or have
/// lost digits.
#[inline]
fn phase_in_range(toss: &CoinToss, terms: &TiltTerms) -> Option<f64> {
    const SMALLEST_TIME: f64 = 1e-200;
    let time = toss.launch.flight_time();
    let [phase, spin] = terms.phases(time);
    // A smaller time may have lost digits that matter at the largest rates. The comparisons also reject a NaN.
    let in_range =
        (time >= SMALLEST_TIME || time == 0.0) && phase < 0.99 * LARGEST_PHASE && spin < 0.99 * LARGEST_PHASE;
    in_range.then_some(phase)
}

/// The outcome by the terms in f64 of a toss whose rates have this relative error, at the phase of its landing (rad), which
/// is in range.
#[inline]
fn by_terms(terms: &TiltTerms, phase: f64, rate_error: f64) -> Option<Outcome> {
    let TiltTerms { mean, cosine, sine, size, .. } = *terms;
    let beyond_amplitude = mean * mean - (cosine * cosine + sine * sine);
    if rate_error == 0.0 && beyond_amplitude > 100.0 * UNIT_ROUNDOFF * (size * size) {
        return Some(Outcome::of(mean, 0.0));
    }
    // Of a phase of 0 and lost digits the product is NaN, within which nothing is decided.
    decided(terms.height(phase), (f64_bound(phase) + rate_error * phase) * size)
}

/// Decides by the stages with more digits than f64.
#[cold]
fn with_more_digits(toss: &CoinToss) -> Result<Certificate, SolveError> {
    CoinMotion::new(toss).phase(toss.launch.time_of_flight())?;
    Ok(match cos_tilt_in_double_double(toss).filter(Ball::has_sign) {
        Some(cos_tilt) => Certificate::new(Outcome::of(cos_tilt.sign(), 0.0), Stage::DoubleDouble),
        None => Certificate::new(by_multiprecision(toss), Stage::MoreDigits),
    })
}

/// A ball of double-double numbers with cos θ at landing, by which the second stage decides. `None` for rates that are not
/// in rad/s or differ too much.
pub fn cos_tilt_in_double_double(toss: &CoinToss) -> Option<Ball<DoubleDouble>> {
    let (time, vertical) = in_double_double(&toss.launch)?;
    Some(cos_tilt_in(toss, &time, vertical, inertia_ratio(&toss.coin)))
}

/// Error bound of [`TiltTerms::height`] at a `phase` (rad), in units of [`TiltTerms::size`].
#[inline]
pub fn f64_bound(phase: f64) -> f64 {
    (34.0 + 7.0 * phase) * UNIT_ROUNDOFF
}

#[cfg(test)]
mod tests;
