//! Outcomes that are proven: heads or tails of the ideal flight for exactly the numbers that coin and launch were made
//! from.
//!
//! These are the moments or the cylinder, the rates, the tilt or the quaternion, and the time or the speed, gravity and
//! drop. What is derived from them, as k = 6 r²/(3 r² + h²) or the vertical seen from a tilted coin, is not rounded
//! before the proof, or its rounding is in the bound.
//!
//! Stages, each asked only where those before cannot decide. Two do without the motion or most of it:
//! `keller.rs` (Keller's coin) and `trig_free.rs` (no sine or cosine). Three have more digits, one than the
//! other, after the adaptive predicates of J. R. Shewchuk, Discrete Comput. Geom. 18 (1997), 305. With u = 2^-53:
//!
//! **1. f64.** By [`TiltTerms`], G = A + B cos φ + C sin φ, the sign of cos θ. With the errors derived there, in units
//! of `size` ≥ |A|, √(B² + C²), |G|:
//!
//! ```text
//! A                                    12u
//! B, C                                 14.8u       √(10.9² + 9.9²), as cos² + sin² = 1
//! cos, sin                             2.9u        √2 · 2u: std is taken to be right to 2 ulp, of numbers below 1
//! φ                                    6u φ        |dG/dφ| ≤ size
//! B cos, C sin                         1.42u       rounded products, |B| + |C| ≤ √2 size
//! the two sums                         2u
//! sum                                  33.2u + 6u φ
//! ```
//!
//! [`f64_bound`] rounds this up for the squares of u and the rounding of the bound itself. What underflows is below
//! 2^-1000, and `size` is above 10^-200. k is rounded once. The vertical of [`Attitude::vertical`](dynamics::Attitude::vertical)
//! is right to the errors from which those of A, B and C are derived, whatever the attitude was made from.
//!
//! **2. Double-double.** By [`ExactMotion::cos_tilt_parts`]. No result goes through more than some fifteen operations
//! of at most 10 u² each, which leaves a, b, c and their sum within 10³ u² and the 2^-67 of the vertical, and the phase
//! (|L| 37 u², of which k has 25 u²; time 25 u², their product 5 u²) within 70 u² φ. Sine and cosine of its leading part
//! are std's (2u each, √2 for both), turned by its rest `lo` ≤ ½ with an error of 4u |lo|. So
//! |Δ cos θ| ≤ 3u + 6u |lo| + 70 u² φ, rounded up in [`double_double_bound`].
//!
//! Rates that were not given in rad/s are rounded to it, each by u. That turns the landed coin by u φ at most, which the
//! bounds of the stages in f64 have room for, and which is added in the next: [`rate_error`].
//!
//! **3. As many digits as it takes**, from the numbers that were given: `multiprecision.rs`.

use dynamics::{AngleUnit, Error, Outcome, SolveError, TimeOfFlight, Toss};
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::keller::{keller_outcome, keller_phase};
use crate::motion::ExactMotion;
use crate::multiprecision::{by_multiprecision, rounded_cos_tilt};
use crate::tilt_terms::TiltTerms;
use crate::trig_free::{phase_in_range, trig_free_by};

/// The proven outcome of a toss.
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
    let is_right = cos_tilt.abs() > NEAR_0 && rate_error(toss) == 0.0;
    Ok(if is_right { cos_tilt } else { rounded_cos_tilt(toss) })
}

impl ProvenCounts {
    /// The proven outcomes of `tosses`, counted.
    ///
    /// # Errors
    /// [`Error::Launch`] for the first toss that has no outcome.
    pub fn of(tosses: impl IntoIterator<Item = Toss>) -> Result<Self, Error> {
        let mut counts = Self::default();
        for (index, toss) in (0..).zip(tosses) {
            let certificate = certify(&toss);
            counts.add(certificate.map_err(|source| Error::Launch { index, toss: Box::new(toss), source })?);
        }
        Ok(counts)
    }
}

/// The stages in f64.
#[inline]
fn cheaply(toss: &Toss) -> Option<Certificate> {
    if rate_error(toss).is_infinite() {
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

/// The stage in f64, from the terms of a toss and the phase of its landing (rad), which is in range; `None` where it cannot
/// decide.
#[inline]
fn by_terms(terms: &TiltTerms, phase: f64) -> Option<Outcome> {
    match Outcome::of(terms.height(phase), f64_bound(phase) * terms.size) {
        Outcome::Undecided => None,
        decided => Some(decided),
    }
}

/// The stages with more digits than f64.
///
/// # Errors
/// As [`certify`].
#[cold]
fn with_more_digits(toss: &Toss) -> Result<Certificate, SolveError> {
    let motion = ExactMotion::new(toss);
    let time = toss.launch.time_of_flight();
    motion.phase(time)?;
    Ok(match by_double_double(&motion, time, rate_error(toss))? {
        Some(outcome) => Certificate::new(outcome, Stage::DoubleDouble),
        None => Certificate::new(by_multiprecision(toss), Stage::Multiprecision),
    })
}

/// Relative error of the rates in rad/s: 0 if they were given so, and infinite where they may have lost digits.
#[inline]
fn rate_error(toss: &Toss) -> f64 {
    const SLOWEST: f64 = 1e-200;
    if toss.launch.given_rate().1 == AngleUnit::RADIAN {
        0.0
    } else if toss.launch.rate().amax() >= SLOWEST {
        1.01 * UNIT_ROUNDOFF
    } else {
        f64::INFINITY
    }
}

/// The stage in double-double for rates with this relative error; `None` where it cannot decide.
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

/// Bound of the error of cos θ in the double-double stage at a `phase` (rad).
pub fn double_double_bound(phase: DoubleDouble) -> f64 {
    const CONSTANT: f64 = 4.0 * UNIT_ROUNDOFF;
    const OF_REST: f64 = 8.0 * UNIT_ROUNDOFF;
    const OF_PHASE: f64 = 80.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF;
    CONSTANT + OF_REST * phase.lo().abs() + OF_PHASE * phase.hi()
}

/// Bound of the error of the f64 stage's height at a `phase` (rad), in parts of the terms' size.
#[inline]
pub fn f64_bound(phase: f64) -> f64 {
    (34.0 + 7.0 * phase) * UNIT_ROUNDOFF
}

#[cfg(test)]
mod tests;
