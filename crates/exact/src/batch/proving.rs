//! This file turns the heights of a filter into proven outcomes, for coins and for other bodies: what the filter leaves
//! undecided is proven one by one.

use std::ops::Range;

use dynamics::{Body, Error, Outcome};
use numerics::lanes::{Real, Simd, WithSimd};

use super::Batch;
use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::rigid::certify;

/// Number of tosses that are filtered together, before the undecided ones among them are proven one by one.
pub(super) const BLOCK: usize = 512;

/// A coin or a body, whose outcomes a filter decides. Only this crate implements it.
pub trait Provable: Copy + Into<Body> {
    /// What the filter computes once for all tosses of a batch.
    type Filter;

    /// The filter of a batch.
    fn filter(batch: &Batch<'_, Self>) -> Self::Filter;

    /// Writes numbers with the proven sign of cos θ for the tosses of a batch; 0 where the filter proves none.
    ///
    /// # Errors
    /// [`Error`] for the first toss with an invalid launch, if the filter finds it.
    fn heights(filter: &Self::Filter, batch: Batch<'_, Self>, heights: &mut [f64]) -> Result<(), Error>;
}

impl<B: Provable> Batch<'_, B> {
    /// Writes the proven outcome of each toss, that of [`certify`]. It is undecided only for an exact tie.
    ///
    /// # Errors
    /// [`Error`] for the first toss that has no outcome; the contents of `out` are then unspecified.
    ///
    /// # Panics
    /// If `out` does not have one entry per toss.
    pub fn outcomes(&self, out: &mut [Outcome]) -> Result<(), Error> {
        assert_eq!(out.len(), self.tosses.len(), "`out` must have one entry per toss");
        let filter = B::filter(self);
        let mut heights = Column([0.0; BLOCK]);
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let start = block * BLOCK;
            let heights = &mut heights.0[..out.len()];
            self.heights(&filter, start..start + out.len(), heights)?;
            for (index, (height, out)) in heights.iter().zip(out).enumerate() {
                *out = of_sign(*height);
                if *out == Outcome::Undecided {
                    *out = self.tosses.solve(start + index, certify)?.outcome();
                }
            }
        }
        Ok(())
    }

    /// Counts the outcomes. All of them are proven: nearly all by the filter in f64, the others by [`certify`].
    ///
    /// # Errors
    /// [`Error`] for the first toss that has no outcome.
    pub fn count(&self) -> Result<ProvenCounts, Error> {
        self.count_and(|_| ())
    }

    /// As [`Batch::count`], and calls `left` with each outcome that the filter could not decide and [`certify`] did.
    ///
    /// # Errors
    /// As [`Batch::count`].
    pub fn count_and(&self, left: impl FnMut(Certificate)) -> Result<ProvenCounts, Error> {
        self.count_with(&B::filter(self), left)
    }

    /// As [`Batch::count_and`], with this filter.
    pub(super) fn count_with(
        &self,
        filter: &B::Filter,
        mut left: impl FnMut(Certificate),
    ) -> Result<ProvenCounts, Error> {
        let mut heights = Column([0.0; BLOCK]);
        let mut counts = ProvenCounts::default();
        for start in (0..self.tosses.len()).step_by(BLOCK) {
            let heights = &mut heights.0[..(self.tosses.len() - start).min(BLOCK)];
            self.heights(filter, start..start + heights.len(), heights)?;
            let decided = self.level.run(Signs(heights));
            counts.add_many(decided.heads, decided.tails, Stage::F64);
            if decided.heads + decided.tails < heights.len() as u64 {
                for (index, _) in
                    heights.iter().enumerate().filter(|(_, height)| of_sign(**height) == Outcome::Undecided)
                {
                    let certificate = self.tosses.solve(start + index, certify)?;
                    left(certificate);
                    counts.add(certificate);
                }
            }
        }
        Ok(counts)
    }

    /// The heights of the tosses of `range`. A filter finds invalid launches alone; a launch before them may be valid and
    /// without an outcome, and its error comes first.
    fn heights(&self, filter: &B::Filter, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error> {
        let block = Batch { tosses: self.tosses.part(range.clone()), level: self.level };
        B::heights(filter, block, heights).map_err(|error| {
            let mut proven = range.clone().map(|index| self.tosses.solve(index, certify));
            proven.find_map(Result::err).unwrap_or_else(|| error.after(range.start as u64))
        })
    }
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
