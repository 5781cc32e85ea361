//! Double-double numbers, which have twice the precision of f64: unevaluated sums hi + lo with |lo| ≤ ½ ulp(hi). The
//! exact motion needs them, because the phase of a long flight, rounded to f64, keeps too few digits after the point.
//!
//! With u = 2^-53 the relative errors are at most 3 u² (+), 5 u² (×), 10 u² (÷) and 4 u² (√), unless a product or its
//! rounding error leaves the range of f64, or a factor is above 2^996, where splitting it overflows. A result then has a
//! part that is not finite, or lost digits below 2^-1022; [`Ball`](crate::Ball) allows for both. Sources: T. J. Dekker, Numer. Math. 18 (1971), 224 (exact products);
//! M. Joldes, J.-M. Muller and V. Popescu, ACM Trans. Math. Softw. 44 (2017), 15 (algorithms 6, 12, 17 and their
//! bounds); V. Lefèvre et al., ACM Trans. Math. Softw. 49 (2023), 12 (√).

mod functions;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number hi + lo, where hi is the nearest f64 and lo the remainder.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// a + b exactly, as the rounded sum hi and its error lo.
#[inline]
pub fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let b_rounded = hi - a;
    DoubleDouble { hi, lo: (a - (hi - b_rounded)) + (b - b_rounded) }
}

/// a + b exactly, for |a| ≥ |b| or a = 0.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// Splits a number into its upper 26 binary digits and the rest, so that products of the parts are exact.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let c = SPLITTER * a;
    let upper = c - (c - a);
    (upper, a - upper)
}

/// a b exactly, by Dekker's splitting. A fused multiply-add is not used, because it is a slow library call in builds
/// for machines that may lack the instruction.
#[inline]
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    DoubleDouble { hi, lo: ((a1 * b1 - hi) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl DoubleDouble {
    /// 0.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The number `hi`, without an error.
    pub const fn exactly(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }

    /// Half of the number, exactly.
    #[inline]
    pub fn half(self) -> Self {
        Self { hi: 0.5 * self.hi, lo: 0.5 * self.lo }
    }

    /// The nearest f64.
    #[inline]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// The remainder: the number less its nearest f64.
    #[inline]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// `a` × `b` exactly, unless a digit leaves the range of f64. The remainder is NaN for a factor above 2^996.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        two_product(a, b)
    }

    /// `a`/`b`, for `b` ≠ 0.
    #[inline]
    pub fn quotient(a: f64, b: f64) -> Self {
        Self::from(a) / Self::from(b)
    }

    /// The square root; 0 for a number ≤ 0.
    #[inline]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        let rest = (self - two_product(root, root)).hi;
        quick_two_sum(root, rest / (2.0 * root))
    }

    /// Sine and cosine of a phase (rad) of any size. The absolute error is about 1.1 u, provided that the standard
    /// library rounds its sine and cosine well.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        let ((sin, cos), rest) = (self.hi.sin_cos(), self.lo);
        // Sine, and cosine less 1, of the rest. Its square matters for phases above 10^8.
        let (sin_rest, cos_rest_less_1) = if rest.abs() < 1e-3 {
            let square = rest * rest;
            (rest * (1.0 - square / 6.0), -0.5 * square * (1.0 - square / 12.0))
        } else {
            (rest.sin(), -2.0 * (0.5 * rest).sin().powi(2))
        };
        (two_sum(sin, cos * sin_rest + sin * cos_rest_less_1), two_sum(cos, cos * cos_rest_less_1 - sin * sin_rest))
    }

    /// Sine and cosine of a phase (rad), rounded to f64.
    #[inline]
    pub fn rounded_sin_cos(self) -> (f64, f64) {
        let (sin, cos) = self.sin_cos();
        (sin.hi, cos.hi)
    }

    /// The number divided by `unit`, a power of two. The result is exact as long as no digit leaves the range of f64.
    #[inline]
    pub fn in_unit(self, unit: f64) -> Self {
        Self { hi: self.hi / unit, lo: self.lo / unit }
    }

    /// The number times 2^`exponent`. The result is exact as long as no digit leaves the range of f64.
    #[inline]
    pub fn times_power_of_two(self, exponent: i32) -> Self {
        if (-1000..=1000).contains(&exponent) {
            let factor = f64::from_bits(u64::from((1023 + exponent).unsigned_abs()) << 52);
            return Self { hi: self.hi * factor, lo: self.lo * factor };
        }
        // In steps, because 2^exponent may leave the range of f64 although the result does not.
        let step = exponent.signum() * 1000;
        self.times_power_of_two(step).times_power_of_two(exponent - step)
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(hi: f64) -> Self {
        Self::exactly(hi)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let sum = quick_two_sum(high.hi, high.lo + low.hi);
        quick_two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        quick_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        let product = two_product(self.hi, other);
        quick_two_sum(product.hi, product.lo + self.lo * other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let rest = self - other * quotient;
        quick_two_sum(quotient, rest.hi / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use dashu_float::FBig;
    use dashu_float::round::mode::HalfEven;

    use super::*;

    type Big = FBig<HalfEven>;

    fn big(value: f64) -> Big {
        Big::try_from(value).unwrap().with_precision(300).value()
    }

    fn exact(value: DoubleDouble) -> Big {
        big(value.hi) + big(value.lo)
    }

    /// Asserts a relative error of at most `units` u².
    #[track_caller]
    fn assert_within(found: DoubleDouble, expected: &Big, units: f64) {
        assert_eq!(found.hi + found.lo, found.hi, "normalised");
        let error = (exact(found) - expected) / expected;
        let size = error.to_f64().value().abs() * 2f64.powi(106);
        assert!(size <= units, "{found:?} is off by {size} u²");
    }

    /// Numbers with full mantissas, of many sizes and both signs.
    fn samples() -> Vec<DoubleDouble> {
        let mut numbers = Vec::new();
        let mut state = 1_u64;
        for exponent in [-60, -20, -1, 0, 0, 1, 3, 40] {
            for _ in 0..4 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let unit = (state >> 11) as f64 / 2f64.powi(53) - 0.5;
                let hi = (1.0 + unit.abs()) * unit.signum() * 2f64.powi(exponent);
                numbers.push(quick_two_sum(hi, hi * 2f64.powi(-53) * unit));
            }
        }
        numbers
    }

    #[test]
    fn operations_are_right_to_their_bounds() {
        for a in samples() {
            for b in samples() {
                assert_within(a * b, &(exact(a) * exact(b)), 5.0);
                assert_within(a / b, &(exact(a) / exact(b)), 10.0);
                assert_within(a * b.hi(), &(exact(a) * big(b.hi())), 2.0);
                assert_within(DoubleDouble::quotient(a.hi(), b.hi()), &(big(a.hi()) / big(b.hi())), 10.0);
                if exact(a) + exact(b) != big(0.0) {
                    assert_within(a + b, &(exact(a) + exact(b)), 3.0);
                }
                assert_eq!(exact(DoubleDouble::product(a.hi(), b.hi())), big(a.hi()) * big(b.hi()));
            }
            let square = a * a;
            // The argument is a rounded product, but is taken as exact here: only the root's own error counts.
            assert_within(square.sqrt(), &exact(square).sqrt(), 4.0);
        }
        assert_eq!(DoubleDouble::ZERO.sqrt(), DoubleDouble::ZERO);
        assert_eq!((DoubleDouble::from(1.0) - DoubleDouble::from(1.0)), DoubleDouble::ZERO);
    }

    #[test]
    fn powers_of_two_are_exact_far_beyond_a_single_factor() {
        let third = DoubleDouble::quotient(1.0, 3.0);
        for exponent in [-900, -53, 0, 7, 1000] {
            let scaled = third.times_power_of_two(exponent);
            assert_eq!(scaled.times_power_of_two(-exponent), third, "{exponent}");
        }
        assert_eq!(DoubleDouble::from(2f64.powi(-1000)).times_power_of_two(2000).hi(), 2f64.powi(1000));
        assert_eq!(DoubleDouble::from(1.0).times_power_of_two(1500).hi(), f64::INFINITY);
        assert_eq!(DoubleDouble::from(1.0).times_power_of_two(-2500).hi(), 0.0);
    }

    /// Compares with 300 bits, for phases whose lo ranges from far below u to half a radian.
    #[test]
    fn sines_and_cosines_take_the_rest_of_a_phase_into_account() {
        for exponent in [-30, 0, 3, 20, 40, 43, 44, 45, 48, 52] {
            for part in [-0.99, -0.6, 0.0, 0.3, 0.9] {
                let hi = 1.234 * 2f64.powi(exponent);
                let phase = quick_two_sum(hi, part * 2f64.powi(exponent - 53));
                let ((sin, cos), (exact_sin, exact_cos)) = (phase.sin_cos(), exact(phase).sin_cos());
                for (found, expected) in [(sin, exact_sin), (cos, exact_cos)] {
                    let error = (exact(found) - expected).to_f64().value().abs();
                    assert!(error < 1.25e-16, "{phase:?} is off by {error:e}");
                }
                assert_eq!(phase.rounded_sin_cos(), (sin.hi, cos.hi));
            }
        }
    }
}
