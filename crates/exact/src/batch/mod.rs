//! This module solves many tosses at once by the exact motion, in SIMD registers. It takes columns of launches and
//! writes columns of results without allocating, at a fraction of the cost of single tosses.
//!
//! | wanted | kernel | error |
//! |---|---|---|
//! | cos θ at landing | [`Batch::cos_tilts`] | 4e-16 from horizontal, else 6e-16 |
//! | proven outcomes | [`Batch::outcomes`], [`Batch::count`] | none |
//! | attitude at landing | [`Batch::attitudes`] | 1e-15 rad |
//! | cos θ, attitude, each toss with a coin, gravity, drop and attitude of its own | [`varying::Varying`] | 1e-15, 2e-15 rad |
//! | phases that show heads | [`Batch::heads`] | as stated with each |
//! | proven outcomes of any rigid body | `Batch<Body>`, by the same names | none |
//!
//! A kernel for coins solves *ordinary* tosses: |L|² between 1e-100 and 1e100 (rad/s)², gravity between 1e-50 and 1e50
//! m/s², and a phase ωL T below 2^40 turns (below k 2^40 turns for a coin with an inertia ratio k < 1). L = (ωx, ωy, k ωz) is the
//! angular momentum divided by I1; k is at least 1e-200. All other tosses are solved one by one, as accurately, or are left
//! to the caller ([`Batch::heads`]). Neither the instruction set
//! nor the other tosses of the batch change a bit of a result.

mod attitude;
mod bodies;
mod cos_tilt;
mod heads;
mod kernel;
mod momentum;
mod outcome;
mod proving;
pub mod varying;

pub use bodies::BodyFilter;
pub use heads::{HeadsColumns, UNSOLVED};

use dynamics::{Attitude, Coin, Tosses};
use numerics::lanes::SimdLevel;

/// Tosses of a coin, or of any [`Body`](dynamics::Body), to be solved together, and the SIMD level of the kernels.
#[derive(Debug, Clone, Copy)]
pub struct Batch<'a, B = Coin> {
    tosses: Tosses<'a, B>,
    level: SimdLevel,
}

impl<'a, B> Batch<'a, B> {
    /// Makes a batch of `tosses`, to be solved at the widest SIMD level of the machine.
    pub fn new(tosses: Tosses<'a, B>) -> Self {
        Self { tosses, level: SimdLevel::widest() }
    }

    /// Sets the SIMD level. The results are the same to the bit at every level.
    #[must_use]
    pub fn on(self, level: SimdLevel) -> Self {
        Self { level, ..self }
    }
}

impl Batch<'_> {
    /// Whether the tosses start from horizontal, heads up.
    fn is_flat(&self) -> bool {
        self.tosses.attitude() == Attitude::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// These have a shorter formula, with a smaller error.
    #[test]
    fn a_batch_is_flat_from_horizontal_alone() {
        let is_flat = |attitude| Batch::new(Tosses::new(Coin::PAPER, attitude, 9.81, [&[]; 3], &[]).unwrap()).is_flat();
        assert_eq!([0.0, 1e-9, 3.0].map(|tilt| is_flat(Attitude::about_x(tilt))), [true, false, false]);
    }
}
