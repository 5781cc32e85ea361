//! This module proves the outcomes of many tosses of one rigid body. A filter computes cos θ with a bound of its error in
//! SIMD registers and decides nearly all of them; [`certify`](crate::certify) proves the few that it leaves.
//!
//! # The motion by theta functions
//! Single tosses double a point of an elliptic curve ([`rigid`](crate::rigid)). Lanes take functions of two phases, which have
//! the same short length for every launch. Let the principal axes be 1, 2, 3, m = I ω the angular momentum in the body frame
//! (BF), G = |m|, T the kinetic energy and α_ij = (I_j - I_i)/(I_i I_j). The sign of
//!
//! ```text
//! E = I3 (I3 - I2) ω3² - I1 (I2 - I1) ω1² = G² - 2 T I2
//! ```
//!
//! tells which axis m circles in BF: that of the largest moment for E > 0, that of the smallest for E < 0, after which
//! the axes are relabelled (1, 2, 3) → (3, -2, 1). Two axes are reversed if m3 < 0. Then, with no difference that
//! cancels,
//!
//! ```text
//! P1 = α12 m2² + α13 m3²,   P3 = α13 m1² + α23 m2²,   λ = ±√(P1 α23)                      the sign of α13
//! k² = α12 P3/(α23 P1),     k'² = |α13 E|/(I2 |α23 P1|)
//! m ~ (b1 cn u, b2 sn u, b3 dn u),   u = λt + u0,   b1 : b2 = √|α23| : √|α13|              C. G. J. Jacobi 1849
//! c = F(atan √(α23/α12) | k'²),      v = K' - c = F(atan √(P1/P3) | k'²),   x = πu/(2K)
//! ```
//!
//! and the attitude R, relative to axes whose third is along m, is the quaternion w + iz = A, x + iy = B of
//!
//! ```text
//! A : B = e^(iΩt/2) (θ4(z | q²) : θ1(z | q²)),    z = x - iπc/(2K),    q = exp(-πK'/K)
//! Ω = G/I3 + G α13 (P3/P1) J/K,  or  G/I1 + G |α13| Π/K  for α13 < 0, where no part of a sum cancels another
//! J = ∫ sin²/((cos² + p sin²) √(cos² + k'² sin²)),  Π the same of 1 instead of sin²,  from 0 to π/2,  p = α13 G²/P1
//! Q(t) = Q0 p⁻¹ R(0)⁻¹ R(t) p,      p from BF to the relabelled axes
//! ```
//!
//! # The filter
//! All is in plain f64: the series of theta functions at all nomes, and no
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

use std::ops::Range;

use dynamics::{Body, Error, Outcome, Tosses};
use numerics::lanes::{Real, Simd, WithSimd};

use super::Batch;
use super::kernel::{Columns, whole_registers};
use super::proving::Filter;
use crate::certificate::ProvenCounts;
use constants::Constants;
pub use filter::BodyFilter;
use landing::{Begun, Height};

/// Number of tosses in a tile, a multiple of the number of lanes of every SIMD level.
const TILE: usize = 64;

/// Number of columns between the two loops over a tile.
const BETWEEN: usize = 18;

impl Batch<'_, Body> {
    /// Writes the proven outcome of each toss, that of [`certify`](crate::certify). Fails for the first toss that has no
    /// outcome; the contents of `out` are then unspecified. Panics if `out` does not have one entry per toss.
    pub fn outcomes(&self, out: &mut [Outcome]) -> Result<(), Error> {
        self.outcomes_by(&Constants::new(&self.tosses), out)
    }

    /// Counts the outcomes. All of them are proven: nearly all by the filter in f64, the others by
    /// [`certify`](crate::certify). Fails for the first toss that has no outcome.
    pub fn count(&self) -> Result<ProvenCounts, Error> {
        self.counts_by(&Constants::new(&self.tosses))
    }

    /// As [`Batch::count`], by a filter that other batches may share. The counts are the same for every filter; one that was
    /// made for another body, attitude or gravity saves no time.
    pub fn count_by(&self, filter: &BodyFilter) -> Result<ProvenCounts, Error> {
        self.counts_by(&filter.constants_of(&self.tosses))
    }
}

/// The constants of a filter, if the body has one.
impl Filter<Body> for Option<Constants> {
    fn heights(&self, batch: &Batch<'_, Body>, range: Range<usize>, heights: &mut [f64]) -> Result<(), Error> {
        match self {
            Some(constants) => batch.level.run(BatchRun { constants, tosses: batch.tosses.part(range), out: heights }),
            None => heights.fill(0.0),
        }
        Ok(())
    }
}

/// The filter, run over tosses.
struct BatchRun<'a, 'out> {
    constants: &'a Constants,
    tosses: Tosses<'a, Body>,
    /// Receives a number with the proven sign of cos θ, and 0 where none is proven.
    out: &'out mut [f64],
}

impl WithSimd for BatchRun<'_, '_> {
    type Output = ();

    /// Two short loops over a tile overlap the operations of more tosses than one long loop.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (mut padded, mut between) = (Columns::<4, TILE>::of(1.0), Columns::<BETWEEN, TILE>::of(0.0));
        for start in (0..self.tosses.len()).step_by(TILE) {
            let tile = start..(start + TILE).min(self.tosses.len());
            let columns = whole_registers(&self.tosses, tile.clone(), Real::<S>::LANES, &mut padded);
            for at in (0..columns[0].len()).step_by(Real::<S>::LANES) {
                let mut launch = [Real::splat(simd, 0.0); 4];
                for (part, column) in launch.iter_mut().zip(&columns) {
                    *part = Real::load(simd, &column[at..]);
                }
                between.store(&self.constants.begin(launch), at);
            }
            for at in (0..columns[0].len()).step_by(Real::<S>::LANES) {
                let written = self.constants.end(between.load(simd, at)).written();
                written.store_up_to(&mut self.out[start + at..tile.end]);
            }
        }
    }
}

impl Constants {
    /// The body of the first loop.
    #[inline(always)]
    fn begin<S: Simd>(&self, [x, y, z, speed]: [Real<S>; 4]) -> [Real<S>; BETWEEN] {
        let start = self.start([x, y, z], speed);
        let means = start.means();
        let [[a, b], [c, d], [e, f], [g, h]] = means.points;
        let ([cos, sin], [across, precession]) = (start.point, means.turns);
        let (is_c, side, upright, condition) = (start.is_c, start.side, start.upright, start.condition);
        let (decay, nome) = (means.decay, means.nome);
        [cos, sin, is_c, side, upright, condition, across, precession, decay, nome, a, b, c, d, e, f, g, h]
    }

    /// The body of the second loop.
    #[inline(always)]
    fn end<S: Simd>(&self, begun: [Real<S>; BETWEEN]) -> Height<S> {
        let [cos, sin, is_c, side, upright, condition, across, precession, decay, nome, a, b, c, d, e, f, g, h] = begun;
        let (point, turns, points) = ([cos, sin], [across, precession], [[a, b], [c, d], [e, f], [g, h]]);
        self.landing(&Begun { point, is_c, side, upright, condition, turns, decay, nome, points })
    }
}

#[cfg(test)]
mod tests;
