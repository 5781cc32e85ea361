//! Many tosses at once by the exact motion, in vectors: structures of arrays in, arrays out, nothing allocated.
//!
//! | wanted | kernel | error |
//! |---|---|---|
//! | cos θ at landing | [`Batch::cos_tilts`] | 4e-16 from horizontal, else 6e-16 |
//! | proven outcomes | [`Batch::outcomes`], [`Batch::count`] | none |
//! | attitude at landing | [`Batch::attitudes`] | 1e-15 rad |
//!
//! A kernel serves ordinary tosses: |L|² between 1e-100 and 1e100 (rad/s)², gravity between 1e-50 and 1e50 m/s², ωL T
//! below 2^40 turns, or k times that for a coin with a ratio k below 1. Others are solved one by one, as accurately.
//! Neither the instruction set nor the neighbours of a toss change a bit of its results.

mod attitude;
mod cos_tilt;
mod kernel;
mod momentum;
mod outcome;

use dynamics::{Attitude, Tosses};
use numerics::lanes::SimdLevel;

/// Tosses to be solved at once, and the SIMD level of their kernels.
#[derive(Debug, Clone, Copy)]
pub struct Batch<'a> {
    tosses: Tosses<'a>,
    level: SimdLevel,
}

impl<'a> Batch<'a> {
    /// A batch of `tosses`, solved at the widest SIMD level of the machine.
    pub fn new(tosses: Tosses<'a>) -> Self {
        Self { tosses, level: SimdLevel::widest() }
    }

    /// The same batch at another SIMD level. No bit of the results depends on it.
    #[must_use]
    pub fn on(self, level: SimdLevel) -> Self {
        Self { level, ..self }
    }

    /// Whether the tosses start from horizontal, heads up.
    fn is_flat(&self) -> bool {
        self.tosses.attitude() == Attitude::IDENTITY
    }
}
