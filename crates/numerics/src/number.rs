//! The trait [`Number`]: the operations that a polynomial formula needs. A formula written over it stands once in the
//! code and serves f64, double-double numbers, SIMD registers and numbers of any precision.

use std::ops::{Add, Mul, Neg, Sub};

use pulp::Simd;

use crate::double_double::DoubleDouble;
use crate::lanes::Real;

/// A number that can be added, subtracted, multiplied and negated.
pub trait Number: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// `self` × `factor` + `term`. In a register it is a fused multiply-add, which rounds once; other numbers are
    /// multiplied and then added.
    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// The sums `Σ one[i] other[j]` over the pairs (i, j) that belong to each of `N` results: `ends[k]` is where those of number k
    /// end, and each has at least one.
    #[inline(always)]
    fn sums_of_products<const N: usize>(
        one: &[Self; N],
        other: &[Self; N],
        pairs: &[[u8; 2]],
        ends: &[usize],
    ) -> [Self; N] {
        let product = |[i, j]: &[u8; 2]| one[usize::from(*i)].clone() * other[usize::from(*j)].clone();
        let mut start = 0;
        std::array::from_fn(|target| {
            let pairs = &pairs[std::mem::replace(&mut start, ends[target])..ends[target]];
            pairs[1..].iter().map(product).fold(product(&pairs[0]), Self::add)
        })
    }
}

impl Number for f64 {}

impl Number for DoubleDouble {}

impl<S: Simd> Number for Real<S> {
    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}
