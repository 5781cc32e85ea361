//! This file proves the outcomes of all tosses of a batch. A filter in f64 decides nearly all of them in SIMD
//! registers, and [`certify`](crate::certify) proves the few that the filter leaves undecided.
//!
//! The filter evaluates G = A + B cos φ + C sin φ of [`TiltTerms`](crate::TiltTerms), which has the sign of cos θ. Let
//! the phase be φ = 2πτ, x what is left of τ without its whole turns, |x| ≤ ½, s = sin πx and c = cos πx. Then
//!
//! ```text
//! G = (A + B) + 2 s (C c - B s)
//! ```
//!
//! because s and c are sine and cosine of φ/2 up to a common sign, which cancels. Few digits of s and c suffice where G
//! is far from 0, so they come from short polynomials with an error of ε. In units of `size`, with u = 2^-53, the
//! errors of G are:
//!
//! ```text
//! A, B, C            41u          12u (1 + √2 + 1), as derived there; fused products round less
//! s, c               7ε           2|C|(ε|c| + ε|s|) + 4|B| ε|s|
//! φ                  44u τ        7u φ: |L| 4u, 1/(πg) 1.5u, two products; |dG/dφ| ≤ size
//! operations         12u          six, of numbers below 4
//! ```
//!
//! [`THRESHOLD`] is more than twice the sum of all lines but that of φ, and [`THRESHOLD_OF_TURN`] is that of φ rounded
//! up. Underflow loses less than 2^-1000, which is below [`SMALLEST`].

use std::ops::Range;

use dynamics::{Coin, CoinToss, Error, Outcome, SolveError};
use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{ROUGH_ERROR, Real, Simd, rough_cos_of_half, rough_sin_of_half};

use super::Batch;
use super::kernel::{BatchRun, Kernel};
use super::momentum::{Constants, Extent, PlainMotion, TiltTerms};
use super::proving;
use crate::certificate::ProvenCounts;

/// |G|/size up to which the filter leaves a toss undecided, for a phase of 0.
const THRESHOLD: f64 = 15.0 * ROUGH_ERROR;

/// What each turn of the phase adds to [`THRESHOLD`].
const THRESHOLD_OF_TURN: f64 = 50.0 * UNIT_ROUNDOFF;

/// |G| up to which the filter leaves a toss undecided whatever its size ((rad/s)²).
const SMALLEST: f64 = 1e-200;

impl Batch<'_> {
    /// Writes the proven outcome of each toss. It is undecided only for an exact tie. Fails for the first toss that has
    /// no outcome; the contents of `out` are then unspecified. Panics if `out` does not have one entry per toss.
    pub fn outcomes(&self, out: &mut [Outcome]) -> Result<(), Error> {
        self.outcomes_by(&Filter::new(self), out)
    }

    /// Counts the outcomes. All of them are proven: nearly all by the filter in f64, the others by
    /// [`certify`](crate::certify). Fails for the first toss that has no outcome.
    pub fn count(&self) -> Result<ProvenCounts, Error> {
        self.counts_by(&Filter::new(self))
    }
}

/// The filter's kernel for a batch, by the attitude at launch.
enum Filter {
    Flat(Flat),
    Tilted(Tilted),
}

impl Filter {
    fn new(batch: &Batch<'_>) -> Self {
        let constants = Constants::new(&batch.tosses);
        if batch.is_flat() {
            Self::Flat(Flat(constants))
        } else {
            Self::Tilted(Tilted(constants, TiltTerms::new(&batch.tosses)))
        }
    }
}

impl proving::Filter<Coin> for Filter {
    /// Writes by how much |G| exceeds its threshold, with the sign of G.
    fn heights(&self, batch: &Batch<'_>, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error> {
        let (level, tosses) = (batch.level, batch.tosses.part(range.clone()));
        let done = match self {
            Self::Flat(kernel) => level.run(BatchRun { kernel, tosses, out: [heights] }),
            Self::Tilted(kernel) => level.run(BatchRun { kernel, tosses, out: [heights] }),
        };
        done.map_err(|error| error.after(range.start as u64))
    }
}

/// The kernel for launches from horizontal, where A + B = |L|², B = Ω² = Lx² + Ly² and C = 0.
struct Flat(Constants);

/// The kernel for launches from any attitude.
struct Tilted(Constants, TiltTerms);

impl Kernel<4, 1> for Flat {
    fn constants(&self) -> &Constants {
        &self.0
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 4] {
        let PlainMotion { across_squared, squared, turns, .. } = self.0.plain_motion(rates, speed, extent);
        [turns, squared, threshold(turns, squared), across_squared + across_squared]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [turns, squared, threshold, twice_across_squared]: [Real<S>; 4]) -> [Real<S>; 1] {
        let sin = rough_sin_of_half(turns - turns.round());
        [beyond(squared - twice_across_squared * (sin * sin), threshold)]
    }

    fn solve_one(&self, _: &CoinToss) -> Result<[f64; 1], SolveError> {
        Ok([0.0])
    }
}

impl Kernel<5, 1> for Tilted {
    fn constants(&self) -> &Constants {
        &self.0
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 5] {
        let PlainMotion { along, across_squared, squared, size, turns } = self.0.plain_motion(rates, speed, extent);
        let [mean, cosine, sine] = self.1.terms(rates, along, across_squared, size);
        [turns, threshold(turns, squared * turns.constant(self.1.norm)), mean, cosine, sine]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [turns, threshold, mean, cosine, sine]: [Real<S>; 5]) -> [Real<S>; 1] {
        let part = turns - turns.round();
        let (sin, cos) = (rough_sin_of_half(part), rough_cos_of_half(part));
        let change = sin * sine.mul_add(cos, -(cosine * sin));
        [beyond((mean + cosine) + (change + change), threshold)]
    }

    fn solve_one(&self, _: &CoinToss) -> Result<[f64; 1], SolveError> {
        Ok([0.0])
    }
}

/// |G| up to which a toss with this phase (turns) and `size` is left undecided.
#[inline(always)]
fn threshold<S: Simd>(turns: Real<S>, size: Real<S>) -> Real<S> {
    let relative = turns.mul_add(turns.constant(THRESHOLD_OF_TURN), turns.constant(THRESHOLD));
    relative.mul_add(size, turns.constant(SMALLEST))
}

/// |`height`| - `threshold` with the sign of `height`, or 0 if that is negative.
#[inline(always)]
fn beyond<S: Simd>(height: Real<S>, threshold: Real<S>) -> Real<S> {
    (height.abs() - threshold).max(height.constant(0.0)).times_sign_of(height)
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Stage, Tosses};
    use numerics::lanes::SimdLevel;

    use super::proving::{BLOCK, Filter as _};
    use super::*;

    const RATES: [[f64; 20]; 3] = [[3.0; 20], [4.0; 20], [5.0; 20]];

    fn speeds() -> [f64; 20] {
        std::array::from_fn(|index| 0.3 * index as f64)
    }

    fn tosses(speeds: &[f64]) -> Tosses<'_> {
        let columns = RATES.each_ref().map(|column| &column[..speeds.len()]);
        Tosses::new(Coin::PAPER, Attitude::about_x(0.7), 9.81, columns, speeds).unwrap()
    }

    #[test]
    fn counts_match_the_outcomes_at_every_level_and_length() {
        let speeds = speeds();
        for (level, length) in
            SimdLevel::all().into_iter().flat_map(|level| (0..=20).map(move |length| (level, length)))
        {
            let batch = Batch::new(tosses(&speeds[..length])).on(level);
            let mut outcomes = vec![Outcome::Undecided; length];
            batch.outcomes(&mut outcomes).unwrap();
            let number = |of: Outcome| outcomes.iter().filter(|outcome| **outcome == of).count() as u64;
            let counted = batch.count().unwrap();
            let expected = (number(Outcome::Heads), number(Outcome::Tails), length as u64);
            let found = (counted.heads, counted.tails, counted.by(Stage::F64));
            assert_eq!(found, expected, "{length} at {}", level.name());
            assert!(length < 20 || (counted.heads > 3 && counted.tails > 3), "{counted:?}");
        }
        let (mut heights, batch) = ([f64::NAN; 20], Batch::new(tosses(&speeds)));
        Filter::new(&batch).heights(&batch, 0..20, &mut heights).unwrap();
        assert!(heights.iter().all(|height| *height != 0.0), "the filter decides them");
    }

    #[test]
    fn an_error_has_the_index_of_its_toss_beyond_the_first_block() {
        let length = 3 * BLOCK;
        let (rates, speeds) = (vec![3.0; length], vec![2.0; length]);
        let mut bad = rates.clone();
        bad[2 * BLOCK + 7] = f64::NAN;
        for attitude in [Attitude::IDENTITY, Attitude::about_x(0.7)] {
            let tosses = Tosses::new(Coin::PAPER, attitude, 9.81, [&rates, &bad, &rates], &speeds).unwrap();
            let counted = Batch::new(tosses).count().unwrap_err();
            let listed = Batch::new(tosses).outcomes(&mut vec![Outcome::Heads; length]).unwrap_err();
            assert!(counted.to_string().starts_with("launch 1031: rate y"), "{counted}");
            assert_eq!(listed.to_string(), counted.to_string());
        }
    }
}
