//! This file runs a kernel over the columns of a batch. It works in tiles that stay in the first-level cache, and
//! passes over each tile in two short loops instead of one long one: the processor then overlaps the operations of more
//! tosses, and waits less for results.

use std::ops::Range;

use dynamics::{Body, CoinToss, Error, SolveError, Tosses};
use numerics::lanes::{Real, Simd, WithSimd};

use super::momentum::{Constants, Extent};

/// Number of tosses in a tile, a multiple of the number of lanes of every SIMD level.
const TILE: usize = 128;

/// Columns of a tile, aligned to whole cache lines for fast loads and stores.
#[repr(align(64))]
pub(super) struct Columns<const N: usize, const TILE: usize>([[f64; TILE]; N]);

impl<const N: usize, const TILE: usize> Columns<N, TILE> {
    #[inline(always)]
    pub(super) fn of(value: f64) -> Self {
        Self([[value; TILE]; N])
    }

    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S, at: usize) -> [Real<S>; N] {
        let mut parts = [Real::splat(simd, 0.0); N];
        for (part, column) in parts.iter_mut().zip(&self.0) {
            *part = Real::load(simd, &column[at..]);
        }
        parts
    }

    #[inline(always)]
    pub(super) fn store<S: Simd>(&mut self, parts: &[Real<S>; N], at: usize) {
        for (part, column) in parts.iter().zip(&mut self.0) {
            part.store(&mut column[at..]);
        }
    }
}

/// A computation that makes `OUT` columns of results by way of `MID` intermediate columns.
pub(super) trait Kernel<const MID: usize, const OUT: usize> {
    /// The constants that all tosses share.
    fn constants(&self) -> &Constants;

    /// The body of the first loop: from rates (in the body frame, rad/s) and speeds v0 (m/s) to the intermediate
    /// columns. It adds the tosses to `extent`.
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; MID];

    /// The body of the second loop: from the intermediate columns to the results.
    fn end<S: Simd>(&self, begun: [Real<S>; MID]) -> [Real<S>; OUT];

    /// Solves a single toss that is not ordinary.
    fn solve_one(&self, toss: &CoinToss) -> Result<[f64; OUT], SolveError>;
}

/// A kernel, the tosses that it is run over, and the columns for its results.
pub(super) struct BatchRun<'a, 'out, K, const MID: usize, const OUT: usize> {
    pub(super) kernel: &'a K,
    pub(super) tosses: Tosses<'a>,
    pub(super) out: [&'out mut [f64]; OUT],
}

impl<K: Kernel<MID, OUT>, const MID: usize, const OUT: usize> WithSimd for BatchRun<'_, '_, K, MID, OUT> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        let (mut padded, mut begun) = (Columns::<4, TILE>::of(1.0), Columns::<MID, TILE>::of(0.0));
        for start in (0..self.tosses.len()).step_by(TILE) {
            let tile = start..(start + TILE).min(self.tosses.len());
            let [x, y, z, speeds] = whole_registers(&self.tosses, tile.clone(), Real::<S>::LANES, &mut padded);
            let mut extent = Extent::new(simd);
            for at in (0..x.len()).step_by(Real::<S>::LANES) {
                let rates = [Real::load(simd, &x[at..]), Real::load(simd, &y[at..]), Real::load(simd, &z[at..])];
                let parts = self.kernel.begin(rates, Real::load(simd, &speeds[at..]), &mut extent);
                begun.store(&parts, at);
            }
            for at in (0..x.len()).step_by(Real::<S>::LANES) {
                let results = self.kernel.end(begun.load(simd, at));
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

impl<K: Kernel<MID, OUT>, const MID: usize, const OUT: usize> BatchRun<'_, '_, K, MID, OUT> {
    /// Solves the tosses of a tile that are not ordinary, one by one.
    #[cold]
    #[inline(never)]
    fn solve_others(&mut self, tile: Range<usize>) -> Result<(), Error> {
        for index in tile {
            let launch = self.tosses.columns(index..index + 1).map(|column| column[0]);
            if self.kernel.constants().is_ordinary(launch) {
                continue;
            }
            let results = self.tosses.solve_coin(index, |toss| self.kernel.solve_one(toss))?;
            for (out, result) in self.out.iter_mut().zip(results) {
                out[index] = result;
            }
        }
        Ok(())
    }
}

/// The columns of a tile, as whole registers of `lanes` lanes. If the last register is not full, the columns are copied
/// to `room`, which holds ordinary tosses beyond them.
#[inline(always)]
pub(super) fn whole_registers<'a, B: Copy + Into<Body>, const TILE: usize>(
    tosses: &Tosses<'a, B>,
    tile: Range<usize>,
    lanes: usize,
    room: &'a mut Columns<4, TILE>,
) -> [&'a [f64]; 4] {
    let columns = tosses.columns(tile);
    let tosses = columns[0].len();
    if tosses.is_multiple_of(lanes) {
        return columns;
    }
    for (padded, column) in room.0.iter_mut().zip(columns) {
        padded[..tosses].copy_from_slice(column);
    }
    room.0.each_ref().map(|column| &column[..tosses.next_multiple_of(lanes)])
}
