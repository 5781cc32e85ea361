//! This module proves the outcomes of many tosses of one rigid body. A filter computes cos θ with a bound of its error in
//! SIMD registers and decides nearly all of them; [`certify`](crate::certify) proves the few that it leaves.
//!
//! The formulas are those of [`rigid`](crate::rigid), in plain f64: the series of theta functions at all nomes, and no
//! branch. Launches around the axis of the largest moment stand beside those around the smallest in a register. Outcomes
//! need few digits, so that sums end early:
//!
//! - Four steps of arithmetic and geometric means give K, the integral of the third kind, e^(-πc/(2K)) or e^(-πv/(2K)),
//!   and x at launch, by roots and divisions alone.
//! - The nome is a series of the second step's means, and five terms make the theta functions.
//! - Only the two phases need sines, and those of the coins' filter do.
//!
//! Nothing cancels but E, whose condition the bound is multiplied by, and the terms of the theta functions. The bound is
//! derived in `docs/proofs/rigid-outcomes.md`. Next to the separatrix (a nome above 0.44), for extreme rates and for
//! launches near the edge nothing is decided.

mod constants;
mod filter;
mod landing;
mod means;
mod start;

use dynamics::{Body, Error, Tosses};
use numerics::lanes::{Real, Simd};

use super::Batch;
use super::kernel::{BatchRun, Kernel};
use super::momentum::{self, Extent};
use super::proving::Provable;
use crate::certificate::ProvenCounts;
use constants::Constants;
pub use filter::BodyFilter;
use landing::{Begun, Height};

/// Number of columns between the two loops over a tile.
const BETWEEN: usize = 18;

impl Provable for Body {
    type Filter = BodyFilter;

    fn filter(batch: &Batch<'_, Body>) -> BodyFilter {
        BodyFilter::new(&batch.tosses)
    }

    fn heights(filter: &BodyFilter, batch: Batch<'_, Body>, heights: &mut [f64]) -> Result<(), Error> {
        let Some(kernel) = filter.constants() else {
            heights.fill(0.0);
            return Ok(());
        };
        batch.level.run(BatchRun { kernel, tosses: batch.tosses, out: [heights] })
    }
}

impl Batch<'_, Body> {
    /// As [`Batch::count`], by a filter that other batches may share. The counts are the same for every filter; one that was
    /// made for another body, attitude or gravity saves no time.
    ///
    /// # Errors
    /// As [`Batch::count`].
    pub fn count_by(&self, filter: &BodyFilter) -> Result<ProvenCounts, Error> {
        if filter.is_of(&self.tosses) { self.count_with(filter, |_| ()) } else { self.count() }
    }
}

impl Kernel<BETWEEN, 1> for Constants {
    type Body = Body;

    fn limits(&self) -> Option<&momentum::Constants> {
        None
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, _: &mut Extent<S>) -> [Real<S>; BETWEEN] {
        let start = self.start(rates, speed);
        let means = start.means();
        let [[a, b], [c, d], [e, f], [g, h]] = means.points;
        let ([cos, sin], [across, precession]) = (start.point, means.turns);
        let (is_c, side, upright, condition) = (start.is_c, start.side, start.upright, start.condition);
        let (decay, nome) = (means.decay, means.nome);
        [cos, sin, is_c, side, upright, condition, across, precession, decay, nome, a, b, c, d, e, f, g, h]
    }

    /// Numbers with the proven sign of cos θ, and 0 where none is proven.
    #[inline(always)]
    fn end<S: Simd>(&self, begun: [Real<S>; BETWEEN]) -> [Real<S>; 1] {
        [self.height(begun).written()]
    }

    fn solve_one(&self, tosses: &Tosses<'_, Body>, index: usize) -> Result<[f64; 1], Error> {
        tosses.solve(index, |_| Ok([0.0]))
    }
}

impl Constants {
    #[inline(always)]
    fn height<S: Simd>(&self, begun: [Real<S>; BETWEEN]) -> Height<S> {
        let [cos, sin, is_c, side, upright, condition, across, precession, decay, nome, a, b, c, d, e, f, g, h] = begun;
        let (point, turns, points) = ([cos, sin], [across, precession], [[a, b], [c, d], [e, f], [g, h]]);
        self.landing(&Begun { point, is_c, side, upright, condition, turns, decay, nome, points })
    }
}

#[cfg(test)]
mod tests;
