//! This file proves the outcome of a toss: whether the ideal flight with exactly the numbers that coin and launch were
//! made from ends in heads or tails. It tries stages from the cheapest to the most accurate and stops at the first whose
//! error bound is smaller than |cos θ|, so that for nearly all tosses a proof costs little more than plain f64.
//!
//! The numbers are the moments or the cylinder, the rates, the tilt or the quaternion, and the time or the speed, gravity
//! and drop. Values derived from them, as k = 6 r²/(3 r² + h²) or the vertical seen from a tilted coin, are not rounded
//! before the proof, or the bound covers their rounding.
//!
//! The first two stages need little of the motion: `keller.rs` (Keller's coin: flat, without spin) and `trig_free.rs`
//! (no sine or cosine). The other three use more and more digits, after the adaptive predicates of J. R. Shewchuk,
//! Discrete Comput. Geom. 18 (1997), 305. φ is the phase ωL T at landing, and u = 2^-53:
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
//! **2. Double-double.** [`ExactMotion::cos_tilt_parts`] gives cos θ = a + b cos φ + c sin φ. No result goes through
//! more than some fifteen operations with an error of at most 10 u² each, and the vertical is right to 2^-67. So a, b, c
//! and their sum are right within 2^-66, and the phase within 70 u² φ (|L| 37 u², of which k has 25 u²; time 25 u², their
//! product 5 u²). Sine and cosine of the leading part of the phase are those of std (2u each, √2 for both); turning them
//! by the trailing part `lo`, |lo| ≤ ½, adds an error of 4u |lo|. Hence |Δ cos θ| ≤ 3u + 6u |lo| + 70 u² φ, which
//! [`double_double_bound`] rounds up.
//!
//! Rates that were not given in rad/s are rounded to it, with an error of u each. This turns the landed coin by at most
//! u φ. The bounds in f64 have no room for it, so such a toss starts with the stage in double-double, which adds it to its
//! bound.
//!
//! **3. As many digits as it takes.** The number of digits doubles until the sign is certain: see `multiprecision.rs`.

use dynamics::{Error, Outcome, SolveError, TimeOfFlight, Toss};
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::keller::{keller_outcome, keller_phase};
use crate::motion::ExactMotion;
use crate::multiprecision::{by_multiprecision, rounded_cos_tilt};
use crate::tilt_terms::TiltTerms;
use crate::trig_free::{phase_in_range, trig_free_by};

/// Proves the outcome of a toss.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`] for a phase above 2^53 rad.
#[inline]
pub fn certify(toss: &Toss) -> Result<Certificate, SolveError> {
    match cheaply(toss) {
        Some(certificate) => Ok(certificate),
        None => with_more_digits(toss),
    }
}

/// cos θ at landing to the error [`COS_TILT_ERROR`](crate::motion::COS_TILT_ERROR), and of the sign of the proven outcome:
/// it is 0 for a tie alone. Near 0, where that error would take the leading digits, it is rounded from more digits.
///
/// # Errors
/// As [`certify`].
pub fn cos_tilt(toss: &Toss) -> Result<f64, SolveError> {
    // Above the error of double-double at any phase.
    const NEAR_0: f64 = 1e-9;
    let cos_tilt = ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?;
    let is_right = cos_tilt.abs() > NEAR_0 && toss.launch.rate_error() == 0.0;
    Ok(if is_right { cos_tilt } else { rounded_cos_tilt(toss) })
}

impl ProvenCounts {
    /// Proves and counts the outcomes of `tosses`.
    ///
    /// # Errors
    /// [`Error::Launch`] for the first toss that has no outcome.
    pub fn of(tosses: impl IntoIterator<Item = Toss>) -> Result<Self, Error> {
        let mut counts = Self::default();
        for (index, toss) in (0..).zip(tosses) {
            let certificate = certify(&toss);
            counts.add(certificate.map_err(|source| Error::Launch { index, toss: Box::new(toss.into()), source })?);
        }
        Ok(counts)
    }
}

/// Whether all tosses land as `toss` does whose rates, inertia ratio k and time of flight differ from its own by up to
/// `relative`, a small part of each. For `false` nothing is known.
///
/// cos θ is the height of ẑ, turned by Φ = (ωx, ωy, k ωz) T and seen from the attitude at launch, and so changes by no more
/// than Φ does. Three factors change Φ by up to 3.1 `relative` |Φ|, where |Φ| is the phase; 4 covers the rounding of cos θ and
/// of the bound, for a `relative` of 4 u or more.
///
/// # Errors
/// As [`certify`].
pub fn holds_within(toss: &Toss, relative: f64) -> Result<bool, SolveError> {
    let phase = ExactMotion::new(toss).phase(toss.launch.time_of_flight())?;
    Ok(cos_tilt(toss)?.abs() > 4.0 * relative * phase)
}

/// Tries the stages in f64: Keller's coin, no trigonometry, then all three terms. `None` if none of them can decide.
#[inline]
fn cheaply(toss: &Toss) -> Option<Certificate> {
    if toss.launch.rate_error() != 0.0 {
        return None;
    }
    let by = |stage| move |outcome| Certificate::new(outcome, stage);
    if let Some(outcome) = keller_phase(toss).and_then(keller_outcome) {
        return Some(by(Stage::Keller)(outcome));
    }
    let terms = TiltTerms::new(toss);
    let phase = phase_in_range(toss, &terms)?;
    trig_free_by(&terms, phase).map(by(Stage::TrigFree)).or_else(|| by_terms(&terms, phase).map(by(Stage::F64)))
}

/// The stage that evaluates all three terms in f64, at the phase of the landing (rad), which is in range. `None` if
/// |cos θ| is within the error bound.
#[inline]
fn by_terms(terms: &TiltTerms, phase: f64) -> Option<Outcome> {
    match Outcome::of(terms.height(phase), f64_bound(phase) * terms.size) {
        Outcome::Undecided => None,
        decided => Some(decided),
    }
}

/// Decides by the stages with more digits than f64.
///
/// # Errors
/// As [`certify`].
#[cold]
fn with_more_digits(toss: &Toss) -> Result<Certificate, SolveError> {
    let motion = ExactMotion::new(toss);
    let time = toss.launch.time_of_flight();
    motion.phase(time)?;
    Ok(match by_double_double(&motion, time, toss.launch.rate_error())? {
        Some(outcome) => Certificate::new(outcome, Stage::DoubleDouble),
        None => Certificate::new(by_multiprecision(toss), Stage::Multiprecision),
    })
}

/// The stage in double-double, for rates with this relative error. `None` if |cos θ| is within its error bound.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
fn by_double_double(motion: &ExactMotion, time: TimeOfFlight, rate_error: f64) -> Result<Option<Outcome>, SolveError> {
    let (cos_tilt, phase) = motion.cos_tilt_parts(time)?;
    // Of a phase of 0 and lost digits the product is NaN, within which nothing is decided.
    let bound = double_double_bound(phase) + rate_error * phase.hi();
    Ok(match Outcome::of(cos_tilt.hi(), bound) {
        Outcome::Undecided => None,
        decided => Some(decided),
    })
}

/// Error bound of cos θ in the double-double stage at a `phase` (rad).
pub fn double_double_bound(phase: DoubleDouble) -> f64 {
    const CONSTANT: f64 = 4.0 * UNIT_ROUNDOFF;
    const OF_REST: f64 = 8.0 * UNIT_ROUNDOFF;
    const OF_PHASE: f64 = 80.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF;
    CONSTANT + OF_REST * phase.lo().abs() + OF_PHASE * phase.hi()
}

/// Error bound of [`TiltTerms::height`] at a `phase` (rad), in units of [`TiltTerms::size`].
#[inline]
pub fn f64_bound(phase: f64) -> f64 {
    (34.0 + 7.0 * phase) * UNIT_ROUNDOFF
}

#[cfg(test)]
mod tests;
