//! The operations that a formula needs, so that it is written once for f64, double-double, registers and any precision.

use std::ops::{Add, Mul, Neg, Sub};

use pulp::Simd;

use crate::double_double::DoubleDouble;
use crate::lanes::Real;

/// A number with sums and products.
pub trait Number: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// `self` × `factor` + `term`: rounded once in a register, otherwise after the product and after the sum.
    #[inline(always)]
    #[must_use]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
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
