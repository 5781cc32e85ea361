//! This file turns the heights of a filter into proven outcomes, for coins and for other bodies: what the filter leaves
//! undecided is proven one by one.

use std::ops::Range;

use dynamics::{Body, Error, Outcome, Stage};
use numerics::lanes::{Real, Simd, WithSimd};

use super::Batch;
use crate::certificate::{Certificate, ProvenCounts};
use crate::rigid::certify;

/// Number of tosses that are filtered together, before the undecided ones among them are proven one by one.
pub(super) const BLOCK: usize = 512;

/// A filter of the tosses of a batch.
pub(super) trait Filter<B> {
    /// Writes numbers with the proven sign of cos θ for the tosses of `range`, at most [`BLOCK`]; 0 where it proves none. An
    /// error has the index of its toss in the whole batch.
    fn heights(&self, batch: &Batch<'_, B>, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error>;
}

impl<B: Copy + Into<Body>> Batch<'_, B> {
    /// Writes the outcome of each toss, by the `filter` or one by one.
    pub(super) fn outcomes_by(&self, filter: &impl Filter<B>, out: &mut [Outcome]) -> Result<(), Error> {
        assert_eq!(out.len(), self.tosses.len(), "`out` must have one entry per toss");
        let mut heights = Column([0.0; BLOCK]);
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let start = block * BLOCK;
            let heights = &mut heights.0[..out.len()];
            self.heights(filter, start..start + out.len(), heights)?;
            for (index, (height, out)) in heights.iter().zip(out).enumerate() {
                *out = of_sign(*height);
                if *out == Outcome::Undecided {
                    *out = self.certify(start + index)?.outcome();
                }
            }
        }
        Ok(())
    }

    /// Counts the outcomes, by the `filter` or one by one.
    pub(super) fn counts_by(&self, filter: &impl Filter<B>) -> Result<ProvenCounts, Error> {
        let mut heights = Column([0.0; BLOCK]);
        let mut counts = ProvenCounts::default();
        for start in (0..self.tosses.len()).step_by(BLOCK) {
            let heights = &mut heights.0[..(self.tosses.len() - start).min(BLOCK)];
            self.heights(filter, start..start + heights.len(), heights)?;
            let [heads, tails] = self.level.run(Signs(heights));
            counts.add_many(heads, tails, Stage::F64);
            if heads + tails < heights.len() as u64 {
                let is_open = |(_, height): &(usize, &f64)| of_sign(**height) == Outcome::Undecided;
                for (index, _) in heights.iter().enumerate().filter(is_open) {
                    counts.add(self.certify(start + index)?);
                }
            }
        }
        Ok(counts)
    }

    /// The heights of a block. A filter finds invalid launches alone; a launch before them may be valid and without an
    /// outcome, and its error comes first.
    fn heights(&self, filter: &impl Filter<B>, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error> {
        filter.heights(self, range.clone(), heights).map_err(|error| {
            let mut proven = range.map(|index| self.certify(index));
            proven.find_map(Result::err).unwrap_or(error)
        })
    }

    fn certify(&self, index: usize) -> Result<Certificate, Error> {
        self.tosses.solve(index, certify)
    }
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
    type Output = [u64; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [u64; 2] {
        let (zero, one) = (Real::splat(simd, 0.0), Real::splat(simd, 1.0));
        let smallest = Real::splat(simd, f64::from_bits(1));
        let (mut heads, mut tails) = (zero, zero);
        let (whole, rest) = self.0.split_at(self.0.len() - self.0.len() % Real::<S>::LANES);
        for at in (0..whole.len()).step_by(Real::<S>::LANES) {
            let height = Real::load(simd, &whole[at..]);
            heads = heads + smallest.at_most(height).choose(one, zero);
            tails = tails + height.at_most(-smallest).choose(one, zero);
        }
        let [mut heads, mut tails] = [heads, tails].map(|count| count.total() as u64);
        for height in rest {
            heads += u64::from(*height > 0.0);
            tails += u64::from(*height < 0.0);
        }
        [heads, tails]
    }
}
