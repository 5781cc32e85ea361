//! This file proves the outcome of a toss: whether the ideal flight with exactly the given f64 moments, rates,
//! attitude, speed and gravity ends in heads or tails. It tries stages from the cheapest to the most accurate and stops
//! at the first whose error bound is smaller than |cos θ|, so that for nearly all tosses a proof costs little more than
//! plain f64.
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
//! than 2^-1000, and `size` is above 10^-200.
//!
//! **2. Double-double.** [`ExactMotion::cos_tilt_parts`] gives cos θ = a + b cos φ + c sin φ. No result goes through
//! more than some fifteen operations with an error of at most 10 u² each. So a, b, c and their sum are right within
//! 10³ u², and the phase within 70 u² φ (k 10 u², |L| 20 u², time 25 u², their product 5 u²). Sine and cosine of the
//! leading part of the phase are those of std (2u each, √2 for both); turning them by the trailing part `lo`, |lo| ≤ ½,
//! adds an error of 4u |lo|. Hence |Δ cos θ| ≤ 3u + 6u |lo| + 70 u² φ, which [`double_double_bound`] rounds up.
//!
//! **3. As many digits as it takes.** The number of digits doubles until the sign is certain. This ends: e^(iφ) is
//! transcendental for an algebraic φ ≠ 0 (Lindemann), so A + B cos φ + C sin φ = 0 with algebraic A, B, C needs φ = 0
//! or A = B = C = 0, and exact arithmetic finds these ties first.

use dynamics::attitude::vertical_in_body;
use dynamics::{Error, Outcome, SolveError, TimeOfFlight, Toss};
use numerics::big::{Big, exactly};
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::keller::{keller_outcome, keller_phase};
use crate::motion::ExactMotion;
use crate::tilt_terms::{TiltTerms, terms};
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

impl ProvenCounts {
    /// Proves and counts the outcomes of `tosses`.
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

/// Tries the stages in f64: Keller's coin, no trigonometry, then all three terms. `None` if none of them can decide.
#[inline]
fn cheaply(toss: &Toss) -> Option<Certificate> {
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
    Ok(match by_double_double(&motion, time)? {
        Some(outcome) => Certificate::new(outcome, Stage::DoubleDouble),
        None => Certificate::new(by_multiprecision(toss), Stage::Multiprecision),
    })
}

/// The stage in double-double. `None` if |cos θ| is within its error bound.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
fn by_double_double(motion: &ExactMotion, time: TimeOfFlight) -> Result<Option<Outcome>, SolveError> {
    let (cos_tilt, phase) = motion.cos_tilt_parts(time)?;
    Ok(match Outcome::of(cos_tilt.hi(), double_double_bound(phase)) {
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

/// The stage with as many digits as it takes. It decides every toss; an exact tie is undecided.
pub(crate) fn by_multiprecision(toss: &Toss) -> Outcome {
    if is_tie(toss) {
        return Outcome::Undecided;
    }
    let mut digits: isize = 192;
    loop {
        let (cos_tilt, bound) = (cos_tilt(toss, digits), multiprecision_bound(digits));
        if cos_tilt > bound {
            return Outcome::Heads;
        }
        if cos_tilt < -bound {
            return Outcome::Tails;
        }
        digits *= 2;
    }
}

/// Error bound of cos θ computed in `digits` binary digits: some twenty operations lose a few bits, and the phase,
/// which may be 2^53 rad, loses 53 more. 2^80 units leave a margin.
fn multiprecision_bound(digits: isize) -> Big {
    Big::ONE >> (digits - 80)
}

/// The vertical in the body frame (BF) at launch, times |Q|² of the attitude quaternion Q, exactly.
fn vertical(toss: &Toss) -> [Big; 3] {
    vertical_in_body(toss.launch.attitude().components().map(exactly)).0
}

/// Whether cos θ = 0 exactly at landing.
fn is_tie(toss: &Toss) -> bool {
    let [m_x, m_y, m_z] = vertical(toss);
    let zero = exactly(0.0);
    if m_z != zero {
        // No tie if mz ≠ 0: at phase 0, cos θ = mz. If B = C = 0, either Ω = 0 and again cos θ = mz, or m is parallel
        // to L, where A = 0 needs Lz = 0 and thus mz = 0.
        return false;
    }
    let rate = toss.launch.rate();
    let landed_at_once = !toss.launch.time_of_flight().is_positive();
    let precesses = rate.x != 0.0 || rate.y != 0.0;
    let level_momentum = rate.z == 0.0 || toss.coin.i3() == 0.0;
    landed_at_once || !precesses || (level_momentum && m_x * exactly(rate.y) == m_y * exactly(rate.x))
}

/// cos θ at landing, computed in `digits` binary digits.
fn cos_tilt(toss: &Toss, digits: isize) -> Big {
    let digits = digits.unsigned_abs();
    let round = |value: Big| value.with_precision(digits).value();
    let [x, y, z] = momentum(toss, digits);
    let across = &x * &x + &y * &y;
    let squared = &across + &z * &z;
    let vertical = vertical(toss).map(round);
    if squared == exactly(0.0) {
        let [.., m_z] = vertical;
        return m_z;
    }
    let momentum = squared.sqrt();
    let time = flight_time(toss, digits);
    let (sin, cos) = (&momentum * time).sin_cos();
    let [mean, cosine, sine] = terms(vertical, [x, y, z], across);
    let height = mean + cosine * cos + sine * &momentum * sin;
    // Division by |Q|² is left out: it is 1 to rounding, and only the sign of the result and its scale within a factor
    // of two matter here.
    height / squared
}

/// (ωx, ωy, k ωz) in `digits` binary digits (rad/s).
pub(crate) fn momentum(toss: &Toss, digits: usize) -> [Big; 3] {
    let big = |value: f64| exactly(value).with_precision(digits).value();
    let rate = toss.launch.rate();
    [big(rate.x), big(rate.y), big(toss.coin.i3()) / big(toss.coin.i1()) * big(rate.z)]
}

/// T in `digits` binary digits (s).
pub(crate) fn flight_time(toss: &Toss, digits: usize) -> Big {
    let round = |value: Big| value.with_precision(digits).value();
    let big = |value: f64| round(exactly(value));
    match toss.launch.time_of_flight() {
        TimeOfFlight::Given(time) => big(time),
        TimeOfFlight::Ballistic { speed, gravity } => big(2.0) * big(speed) / big(gravity),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => {
            let (speed, gravity) = (exactly(speed), exactly(gravity));
            let discriminant = &speed * &speed + exactly(2.0) * &gravity * exactly(drop);
            (round(speed) + round(discriminant).sqrt()) / round(gravity)
        }
    }
}

#[cfg(test)]
mod tests;
