//! [`Real`], a vector of f64 with the operators of a number. A kernel written over it reads like a formula for one
//! number and computes one result in each lane.

use std::any::TypeId;
use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::{Scalar, Simd};

/// Smallest product whose error has no digit below the range of f64 if Dekker's splitting finds it.
const SMALLEST_SPLIT: f64 = f64::MIN_POSITIVE * 18_014_398_509_481_984.0; // 2^-968

/// A vector of as many f64 as a register of the instruction set `S` holds. Operations act on each lane separately.
#[derive(Debug, Clone, Copy)]
pub struct Real<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// The lanes in which a condition holds.
#[derive(Debug, Clone, Copy)]
pub struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

impl<S: Simd> Real<S> {
    /// Number of lanes.
    pub const LANES: usize = S::F64_LANES;

    /// `value` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// A vector for the same instruction set as `self`, with `value` in every lane.
    #[inline(always)]
    pub fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// The first [`Real::LANES`] numbers of `slice`.
    #[inline(always)]
    pub fn load(simd: S, slice: &[f64]) -> Self {
        Self { simd, value: S::as_simd_f64s(&slice[..Self::LANES]).0[0] }
    }

    /// Writes the numbers into the first [`Real::LANES`] of `slice`.
    #[inline(always)]
    pub fn store(self, slice: &mut [f64]) {
        S::as_mut_simd_f64s(&mut slice[..Self::LANES]).0[0] = self.value;
    }

    /// Writes as many of the numbers as `slice` has room for.
    #[inline(always)]
    pub fn store_up_to(self, slice: &mut [f64]) {
        if slice.len() >= Self::LANES {
            return self.store(slice);
        }
        self.simd.partial_store_f64s(slice, self.value);
    }

    /// The number in the first lane.
    #[inline(always)]
    pub fn first(self) -> f64 {
        let mut number = [0.0];
        self.store_up_to(&mut number);
        number[0]
    }

    /// Sum of all lanes.
    #[inline(always)]
    pub fn total(self) -> f64 {
        self.simd.reduce_sum_f64s(self.value)
    }

    /// √self.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    /// |self|.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { value: self.simd.abs_f64s(self.value), ..self }
    }

    /// `self` × `factor` + `term`, rounded once. It is a library call where the machine has no such instruction.
    #[inline(always)]
    pub fn mul_add(self, factor: Self, term: Self) -> Self {
        Self { value: self.simd.mul_add_f64s(self.value, factor.value, term.value), ..self }
    }

    /// `self` × `factor` exactly, as the rounded product and its error. Of a product below 2^-968, whose error may have
    /// digits below the range of f64, the error is rounded.
    #[inline(always)]
    pub fn product(self, factor: Self) -> [Self; 2] {
        let [product, error] = self.product_in_range(factor);
        // The comparison fails, too, where a part of the splitting has overflowed and the error is NaN.
        if Self::is_fused() || (error.abs() + error.constant(SMALLEST_SPLIT)).at_most(product.abs()).everywhere() {
            return [product, error];
        }
        [product, self.mul_add(factor, -product)]
    }

    /// As [`Real::product`], for products of at least 2^-968 of numbers up to 2^995. The error of a smaller product is
    /// below 2^-1021, and depends on the SIMD level. Where a fused multiply-add would be a library call, Dekker's
    /// splitting is used instead.
    #[inline(always)]
    pub fn product_in_range(self, factor: Self) -> [Self; 2] {
        let product = self * factor;
        if Self::is_fused() {
            return [product, self.mul_add(factor, -product)];
        }
        let ([a1, a2], [b1, b2]) = (self.split(), factor.split());
        [product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2]
    }

    /// `self` + `other` exactly, as the rounded sum and its error.
    #[inline(always)]
    pub fn sum(self, other: Self) -> [Self; 2] {
        let sum = self + other;
        let rounded = sum - self;
        [sum, (self - (sum - rounded)) + (other - rounded)]
    }

    /// The upper 26 binary digits and the rest (Dekker).
    #[inline(always)]
    fn split(self) -> [Self; 2] {
        let c = self.constant(134_217_729.0) * self; // 2^27 + 1
        let upper = c - (c - self);
        [upper, self - upper]
    }

    /// Whether the fused multiply-add is an instruction rather than a library call.
    #[inline(always)]
    fn is_fused() -> bool {
        cfg!(target_feature = "fma") || cfg!(target_arch = "aarch64") || TypeId::of::<S>() != TypeId::of::<Scalar>()
    }

    /// `self` times the sign of `other` (1 or -1, also of ±0).
    #[inline(always)]
    pub fn times_sign_of(self, other: Self) -> Self {
        let (one, two) = (self.simd.transmute_u64s_f64s(self.value), self.simd.transmute_u64s_f64s(other.value));
        let sign = self.simd.and_u64s(two, self.simd.splat_u64s(1 << 63));
        Self { value: self.simd.transmute_f64s_u64s(self.simd.xor_u64s(one, sign)), ..self }
    }

    /// A number whose sign bit is set where that of `self` or of `other` is. Only its sign means anything.
    #[inline(always)]
    pub fn either_sign(self, other: Self) -> Self {
        let (one, two) = (self.simd.transmute_u64s_f64s(self.value), self.simd.transmute_u64s_f64s(other.value));
        Self { value: self.simd.transmute_f64s_u64s(self.simd.or_u64s(one, two)), ..self }
    }

    /// The larger of `self` and `other`, neither of which is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { value: self.simd.max_f64s(self.value, other.value), ..self }
    }

    /// The smaller of `self` and `other`, neither of which is NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self { value: self.simd.min_f64s(self.value, other.value), ..self }
    }

    /// The number in [-1, 1] that is nearest to `self`, which is not NaN.
    #[inline(always)]
    pub fn clamp_to_cosine(self) -> Self {
        let at_least = self.max(self.constant(-1.0));
        Self { value: self.simd.min_f64s(at_least.value, self.simd.splat_f64s(1.0)), ..self }
    }

    /// The integer nearest to `self`, ties to even, for |self| < 2^51.
    #[inline(always)]
    pub fn round(self) -> Self {
        let magic = self.constant(6_755_399_441_055_744.0); // 1.5 · 2^52
        (self + magic) - magic
    }

    /// The lanes in which `self` < `other`; false where either is NaN.
    #[inline(always)]
    pub fn less_than(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f64s(self.value, other.value) }
    }

    /// The lanes in which `self` ≤ `other`; false where either is NaN.
    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_or_equal_f64s(self.value, other.value) }
    }
}

impl<S: Simd> Mask<S> {
    /// Whether the condition holds in every lane.
    #[inline(always)]
    pub fn everywhere(self) -> bool {
        self.simd.first_true_m64s(self.simd.not_m64s(self.value)) == S::F64_LANES
    }

    /// `yes` in the lanes in which the condition holds, `no` in the others.
    #[inline(always)]
    pub fn choose(self, yes: Real<S>, no: Real<S>) -> Real<S> {
        Real { simd: self.simd, value: self.simd.select_f64s(self.value, yes.value, no.value) }
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $of_lanes:ident;)*) => {$(
        impl<S: Simd> $operator for Real<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { value: self.simd.$of_lanes(self.value, other.value), ..self }
            }
        }
    )*};
}

operators! {
    Add, add, add_f64s;
    Sub, sub, sub_f64s;
    Mul, mul, mul_f64s;
    Div, div, div_f64s;
}

impl<S: Simd> Neg for Real<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: self.simd.neg_f64s(self.value), ..self }
    }
}

#[cfg(test)]
mod tests;
