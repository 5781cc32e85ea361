//! This file turns the heights of a filter into proven outcomes, for coins and for other bodies: what the filter leaves
//! undecided is proven one by one.

use std::ops::Range;

use dynamics::{Error, Outcome, Stage};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use crate::certificate::{Certificate, ProvenCounts};

/// Number of tosses that are filtered together, before the undecided ones among them are proven one by one.
pub(super) const BLOCK: usize = 512;

/// A filter of tosses, and the proof of those that it leaves.
pub(super) trait Proving {
    /// Number of tosses.
    fn len(&self) -> usize;

    /// The SIMD level of the filter.
    fn level(&self) -> SimdLevel;

    /// Writes numbers with the proven sign of cos θ for the tosses of `range`, at most [`BLOCK`]; 0 where the filter
    /// proves none. An error has the index of its toss among all.
    fn heights(&self, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error>;

    /// The outcome of one toss.
    fn certify(&self, index: usize) -> Result<Certificate, Error>;
}

/// Writes the outcome of each toss.
pub(super) fn outcomes(proving: &impl Proving, out: &mut [Outcome]) -> Result<(), Error> {
    assert_eq!(out.len(), proving.len(), "`out` must have one entry per toss");
    let mut heights = Column([0.0; BLOCK]);
    for (block, out) in out.chunks_mut(BLOCK).enumerate() {
        let start = block * BLOCK;
        let heights = &mut heights.0[..out.len()];
        heights_of(proving, start..start + out.len(), heights)?;
        for (index, (height, out)) in heights.iter().zip(out).enumerate() {
            *out = of_sign(*height);
            if *out == Outcome::Undecided {
                *out = proving.certify(start + index)?.outcome();
            }
        }
    }
    Ok(())
}

/// Counts the outcomes, and calls `left` with each that the filter did not decide.
pub(super) fn count(proving: &impl Proving, mut left: impl FnMut(Certificate)) -> Result<ProvenCounts, Error> {
    let mut heights = Column([0.0; BLOCK]);
    let mut counts = ProvenCounts::default();
    for start in (0..proving.len()).step_by(BLOCK) {
        let heights = &mut heights.0[..(proving.len() - start).min(BLOCK)];
        heights_of(proving, start..start + heights.len(), heights)?;
        let decided = proving.level().run(Signs(heights));
        counts.add_many(decided.heads, decided.tails, Stage::F64);
        if decided.heads + decided.tails < heights.len() as u64 {
            for (index, _) in heights.iter().enumerate().filter(|(_, height)| of_sign(**height) == Outcome::Undecided) {
                let certificate = proving.certify(start + index)?;
                left(certificate);
                counts.add(certificate);
            }
        }
    }
    Ok(counts)
}

/// The heights of a block. A filter finds invalid launches alone; a launch before them may be valid and without an outcome,
/// and its error comes first.
fn heights_of(proving: &impl Proving, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error> {
    proving.heights(range.clone(), heights).map_err(|error| {
        let mut proven = range.map(|index| proving.certify(index));
        proven.find_map(Result::err).unwrap_or(error)
    })
}

/// Numbers of outcomes that the filter decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct FilterCounts {
    heads: u64,
    tails: u64,
}

/// The outcome by the sign of a height: heads for positive, tails for negative, undecided for 0. It is looked up in a
/// table, because heads and tails alternate at random and the processor would mispredict half of the branches.
#[inline]
fn of_sign(height: f64) -> Outcome {
    const OF_SIGNS: [Outcome; 3] = [Outcome::Undecided, Outcome::Heads, Outcome::Tails];
    OF_SIGNS[usize::from(height > 0.0) + 2 * usize::from(height < 0.0)]
}

/// Heights of a block, aligned to whole cache lines for fast loads and stores.
#[repr(align(64))]
struct Column([f64; BLOCK]);

/// Counts the positive numbers (heads) and the negative ones (tails).
struct Signs<'a>(&'a [f64]);

impl WithSimd for Signs<'_> {
    type Output = FilterCounts;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> FilterCounts {
        let (zero, one) = (Real::splat(simd, 0.0), Real::splat(simd, 1.0));
        let smallest = Real::splat(simd, f64::from_bits(1));
        let (mut heads, mut tails) = (zero, zero);
        let (whole, rest) = self.0.split_at(self.0.len() - self.0.len() % Real::<S>::LANES);
        for at in (0..whole.len()).step_by(Real::<S>::LANES) {
            let height = Real::load(simd, &whole[at..]);
            heads = heads + smallest.at_most(height).choose(one, zero);
            tails = tails + height.at_most(-smallest).choose(one, zero);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts below 2^53")]
        let mut decided = FilterCounts { heads: heads.total() as u64, tails: tails.total() as u64 };
        for height in rest {
            decided.heads += u64::from(*height > 0.0);
            decided.tails += u64::from(*height < 0.0);
        }
        decided
    }
}
