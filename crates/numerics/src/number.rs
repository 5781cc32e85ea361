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

    /// The product of two series: term 0 is `one[0] other[0]`, and term t > 0 is `one[0] other[t]`, and `one[i] other[j]` over the
    /// pairs (i, j) that belong to it, and `one[t] other[0]`, added in this order. `ends[t]` is where its pairs end.
    #[inline(always)]
    fn product_of_series<const T: usize>(
        one: &[Self; T],
        other: &[Self; T],
        pairs: &[[u8; 2]],
        ends: &[usize],
    ) -> [Self; T] {
        let product = |i: usize, j: usize| one[i].clone() * other[j].clone();
        let mut start = 0;
        std::array::from_fn(|target| {
            let pairs = &pairs[std::mem::replace(&mut start, ends[target])..ends[target]];
            let pair = |[i, j]: &[u8; 2]| product(usize::from(*i), usize::from(*j));
            let last = (target > 0).then(|| product(target, 0));
            pairs.iter().map(pair).chain(last).fold(product(0, target), Self::add)
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
