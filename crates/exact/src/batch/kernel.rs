//! How a kernel is run over the columns of a batch.
//!
//! In tiles that stay in the first-level cache, each in two loops: with fewer operations in a loop, those of more
//! tosses are under way at a time, and none waits long for the one before.

use std::ops::Range;

use dynamics::{Error, SolveError, Toss, Tosses};
use numerics::lanes::{Real, Simd, WithSimd};

use super::momentum::{Constants, Extent};

/// Tosses of a tile; a multiple of the number of lanes.
const TILE: usize = 128;

/// Columns of a tile, as registers are loaded and stored best.
#[repr(align(64))]
struct Columns<const N: usize>([[f64; TILE]; N]);

/// Makes `OUT` columns, by way of `MID` others.
pub(super) trait Kernel<const MID: usize, const OUT: usize> {
    /// What is the same for all tosses.
    fn constants(&self) -> &Constants;

    /// The first loop: from rates (BF, rad/s) and v0 (m/s).
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; MID];

    /// The second loop.
    fn end<S: Simd>(&self, begun: [Real<S>; MID]) -> [Real<S>; OUT];

    /// The results for a toss that is not ordinary.
    fn solve_one(&self, toss: &Toss) -> Result<[f64; OUT], SolveError>;
}

/// A kernel, and where its results go.
pub(super) struct Run<'a, 'out, K, const MID: usize, const OUT: usize> {
    pub(super) kernel: &'a K,
    pub(super) tosses: Tosses<'a>,
    pub(super) out: [&'out mut [f64]; OUT],
}

impl<K: Kernel<MID, OUT>, const MID: usize, const OUT: usize> WithSimd for Run<'_, '_, K, MID, OUT> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        let mut padded = Columns([[1.0; TILE]; 4]);
        let mut begun = Columns([[0.0; TILE]; MID]);
        for start in (0..self.tosses.len()).step_by(TILE) {
            let tile = start..(start + TILE).min(self.tosses.len());
            let [x, y, z, speeds] = whole_registers(&self.tosses, tile.clone(), Real::<S>::LANES, &mut padded.0);
            let mut extent = Extent::new(simd);
            for at in (0..x.len()).step_by(Real::<S>::LANES) {
                let rates = [Real::load(simd, &x[at..]), Real::load(simd, &y[at..]), Real::load(simd, &z[at..])];
                let parts = self.kernel.begin(rates, Real::load(simd, &speeds[at..]), &mut extent);
                for (part, column) in parts.iter().zip(&mut begun.0) {
                    part.store(&mut column[at..]);
                }
            }
            for at in (0..x.len()).step_by(Real::<S>::LANES) {
                let mut parts = [Real::splat(simd, 0.0); MID];
                for (part, column) in parts.iter_mut().zip(&begun.0) {
                    *part = Real::load(simd, &column[at..]);
                }
                let results = self.kernel.end(parts);
                for (result, out) in results.iter().zip(&mut self.out) {
                    result.store_up_to(&mut out[start + at..tile.end]);
                }
            }
            if !extent.is_ordinary(self.kernel.constants()) {
                self.solve_others(tile)?;
            }
        }
        Ok(())
    }
}

impl<K: Kernel<MID, OUT>, const MID: usize, const OUT: usize> Run<'_, '_, K, MID, OUT> {
    /// Solves those of a tile one by one that are not ordinary.
    #[cold]
    #[inline(never)]
    fn solve_others(&mut self, tile: Range<usize>) -> Result<(), Error> {
        for index in tile {
            let launch = self.tosses.columns(index..index + 1).map(|column| column[0]);
            if self.kernel.constants().is_ordinary(launch) {
                continue;
            }
            let results = self.tosses.solve(index, |toss| self.kernel.solve_one(toss))?;
            for (out, result) in self.out.iter_mut().zip(results) {
                out[index] = result;
            }
        }
        Ok(())
    }
}

/// The columns of some tosses for whole registers of so many `lanes`; where the last is not full, filled up in `room` with
/// ordinary tosses.
#[inline(always)]
fn whole_registers<'a>(
    tosses: &Tosses<'a>,
    tile: Range<usize>,
    lanes: usize,
    room: &'a mut [[f64; TILE]; 4],
) -> [&'a [f64]; 4] {
    let columns = tosses.columns(tile);
    let tosses = columns[0].len();
    if tosses.is_multiple_of(lanes) {
        return columns;
    }
    for (padded, column) in room.iter_mut().zip(columns) {
        padded[..tosses].copy_from_slice(column);
    }
    room.each_ref().map(|column| &column[..tosses.next_multiple_of(lanes)])
}
