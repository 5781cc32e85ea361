//! These kernels compute cos θ at landing for all tosses of a batch. There are two, because a launch from horizontal
//! needs only one cosine. With the phase φ = |L| T, the terms A, B, C of [`TiltTerms`](crate::TiltTerms) and the
//! attitude quaternion Q at launch:
//!
//! ```text
//! cos θ = (Lz² + (Lx² + Ly²) cos φ)/|L|²              from horizontal
//! cos θ = (A + B cos φ + C sin φ)/(|Q|² |L|²)         from any attitude
//! ```

use dynamics::{CoinToss, Error, SolveError};
use numerics::lanes::{Real, Simd, cosine_as_sine, sin_cos, sin_of_turns};

use super::Batch;
use super::kernel::{BatchRun, Kernel};
use super::momentum::{Constants, Extent, TiltTerms, without_negligible};
use crate::compensated::compensated_cos_tilt;

impl Batch<'_> {
    /// Writes cos θ at landing of each toss. Fails for the first toss that has no cos θ; the contents of `out` are then
    /// unspecified. Panics if `out` does not have one entry per toss.
    pub fn cos_tilts(&self, out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), self.tosses.len(), "`out` must have one entry per toss");
        let constants = Constants::new(&self.tosses);
        if self.is_flat() {
            self.level.run(BatchRun { kernel: &Flat(constants), tosses: self.tosses, out: [out] })
        } else {
            let kernel = &Tilted::new(constants, TiltTerms::new(&self.tosses));
            self.level.run(BatchRun { kernel, tosses: self.tosses, out: [out] })
        }
    }
}

/// The kernel for launches from horizontal: (Lz² + Ω² cos φ)/|L|², where Ω² = Lx² + Ly².
struct Flat(Constants);

impl Kernel<4, 1> for Flat {
    fn constants(&self) -> &Constants {
        &self.0
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 4] {
        let motion = self.0.motion(rates, speed, extent);
        let [turns, rest] = motion.turns;
        [cosine_as_sine(turns, rest), motion.across_squared, motion.along_squared, motion.half_inverse]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [left, across_squared, along_squared, half_inverse]: [Real<S>; 4]) -> [Real<S>; 1] {
        let height = across_squared.mul_add(sin_of_turns(left), along_squared);
        [((height + height) * half_inverse).clamp_to_cosine()]
    }

    fn solve_one(&self, toss: &CoinToss) -> Result<[f64; 1], SolveError> {
        compensated_cos_tilt(toss).map(|cos| [cos])
    }
}

/// The kernel for launches from any attitude: (A + B cos φ + C sin φ)/(|Q|² |L|²).
struct Tilted(Constants, TiltTerms);

impl Tilted {
    /// Its phases are in quarters of a turn.
    fn new(constants: Constants, terms: TiltTerms) -> Self {
        Self(constants.with_phases_times(4.0), terms)
    }
}

impl Kernel<6, 1> for Tilted {
    fn constants(&self) -> &Constants {
        &self.0
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 6] {
        let motion = self.0.motion(rates, speed, extent);
        let [mean, cosine, sine] = self.1.terms(rates, motion.along, motion.across_squared, motion.size);
        let [quarters, rest] = [motion.turns[0], without_negligible(motion.turns[1])];
        [quarters, rest, mean, cosine, sine, motion.half_inverse * rest.constant(2.0 / self.1.norm)]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [quarters, rest, mean, cosine, sine, inverse]: [Real<S>; 6]) -> [Real<S>; 1] {
        let [sin, cos] = sin_cos(quarters, rest);
        [((mean + cosine.mul_add(cos, sine * sin)) * inverse).clamp_to_cosine()]
    }

    fn solve_one(&self, toss: &CoinToss) -> Result<[f64; 1], SolveError> {
        compensated_cos_tilt(toss).map(|cos| [cos])
    }
}
