//! The trait [`Elementary`]: numbers that can also be divided and that have roots, exponentials and angles. A formula
//! with such functions is written over it once, and evaluated in double-double, in any precision, or with error bounds.

use std::ops::Div;

use crate::UNIT_ROUNDOFF;
use crate::big::{Big, exactly};
use crate::double_double::DoubleDouble;
use crate::number::Number;

/// A real number of some precision with the elementary functions.
///
/// A function takes the precision of its result from `self`, because it is a property of the value for some numbers.
pub trait Elementary: Number + Div<Output = Self> {
    /// The finite number `value` in the precision of `self`.
    fn like(&self, value: f64) -> Self;

    /// The number `value` in the precision of `self`.
    fn like_big(&self, value: &Big) -> Self;

    /// The nearest f64; of a number with an error bound, the one nearest to its midpoint.
    fn to_f64(&self) -> f64;

    /// The nearest double-double number; of a number with an error bound, the one nearest to its midpoint.
    fn to_double_double(&self) -> DoubleDouble;

    /// The number exactly; of a number with an error bound, its midpoint.
    fn to_big(&self) -> Big;

    /// The number of binary digits that operations keep.
    fn digits(&self) -> i32;

    /// A bound of the relative rounding error of an operation or a function; at least 2^-1000, however many the digits.
    fn rounding(&self) -> f64 {
        2f64.powi((8 - self.digits()).max(-1000))
    }

    /// The square root; 0 for a number ≤ 0.
    fn sqrt(&self) -> Self;

    /// e to this power.
    fn exp(&self) -> Self;

    /// Sine and cosine of an angle (rad).
    fn sine_and_cosine(&self) -> [Self; 2];

    /// The angle (rad) of the point (`x`, `self`), from -π to π.
    fn atan2(&self, x: &Self) -> Self;

    /// π in the precision of `self`.
    fn pi(&self) -> Self;

    /// The number times 2^`exponent`.
    fn times_power_of_two(&self, exponent: i32) -> Self;

    /// The same number with an error bound that is larger by `error` ≥ 0, for numbers that have one.
    fn widened(self, _error: f64) -> Self {
        self
    }

    /// The same as [`widened`](Elementary::widened). Of a series in some variables, each coefficient is widened: what is
    /// added is then any function that is at most `error` where every variable, a complex number, is within 1 of 0, for no
    /// coefficient of such a function is larger (Cauchy's estimate).
    fn widened_throughout(self, error: f64) -> Self {
        self.widened(error)
    }

    /// A bound of the absolute value; of a series, where every variable is within 1 of 0. Infinite or NaN if nothing is known.
    fn bound(&self) -> f64 {
        (self.to_f64().abs() + self.error()) * (1.0 + 4.0 * f64::EPSILON)
    }

    /// Whether all parts of the number are in the range of f64: of a double-double number, the remainder too.
    fn is_in_range(&self) -> bool {
        self.to_f64().is_finite()
    }

    /// -1, 0 or 1, also of a number that is below the range of f64; of a number with an error bound, that of its
    /// midpoint.
    fn sign(&self) -> f64 {
        let value = self.to_f64();
        if value == 0.0 { 0.0 } else { value.signum() }
    }

    /// The error bound; 0 for a number that has none.
    fn error(&self) -> f64 {
        0.0
    }

    /// Whether the sign is known: the number is further from 0 than its error bound, or exactly 0.
    fn has_known_sign(&self) -> bool {
        self.error() == 0.0 || self.to_f64().abs() > self.error()
    }

    /// The absolute value; of a number with an error bound, the number with the sign that its midpoint has not.
    fn magnitude(&self) -> Self {
        if self.sign() < 0.0 { -self.clone() } else { self.clone() }
    }

    /// Half of the number.
    fn halved(&self) -> Self {
        self.times_power_of_two(-1)
    }
}

/// The questions of [`Elementary`] that one part of a number answers: of a ball its midpoint, of a series its constant.
macro_rules! answered_by {
    ($number:ident, $part:expr) => {
        fn to_f64(&$number) -> f64 {
            $crate::Elementary::to_f64(&$part)
        }

        fn to_double_double(&$number) -> $crate::DoubleDouble {
            $crate::Elementary::to_double_double(&$part)
        }

        fn to_big(&$number) -> $crate::Big {
            $crate::Elementary::to_big(&$part)
        }

        fn digits(&$number) -> i32 {
            $crate::Elementary::digits(&$part)
        }

        fn sign(&$number) -> f64 {
            $crate::Elementary::sign(&$part)
        }
    };
}
pub(crate) use answered_by;

/// Functions are those of the platform: sine, cosine, exponential and atan2 by the standard library.
impl Elementary for f64 {
    #[inline]
    fn like(&self, value: f64) -> Self {
        value
    }

    fn like_big(&self, value: &Big) -> Self {
        value.to_f64().value()
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        *self
    }

    #[inline]
    fn to_double_double(&self) -> DoubleDouble {
        (*self).into()
    }

    fn to_big(&self) -> Big {
        exactly(*self)
    }

    #[inline]
    fn digits(&self) -> i32 {
        53
    }

    #[inline]
    fn rounding(&self) -> f64 {
        2.0 * UNIT_ROUNDOFF
    }

    #[inline]
    fn sqrt(&self) -> Self {
        if *self > 0.0 { f64::sqrt(*self) } else { 0.0 }
    }

    fn exp(&self) -> Self {
        f64::exp(*self)
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let (sin, cos) = self.sin_cos();
        [sin, cos]
    }

    fn atan2(&self, x: &Self) -> Self {
        f64::atan2(*self, *x)
    }

    #[inline]
    fn pi(&self) -> Self {
        std::f64::consts::PI
    }

    #[inline]
    fn times_power_of_two(&self, exponent: i32) -> Self {
        DoubleDouble::exactly(*self).times_power_of_two(exponent).hi()
    }
}

impl Elementary for DoubleDouble {
    #[inline]
    fn like(&self, value: f64) -> Self {
        value.into()
    }

    fn like_big(&self, value: &Big) -> Self {
        Self::nearest(value)
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        self.hi()
    }

    #[inline]
    fn to_double_double(&self) -> DoubleDouble {
        *self
    }

    fn to_big(&self) -> Big {
        exactly(self.hi()) + exactly(self.lo())
    }

    fn digits(&self) -> i32 {
        106
    }

    #[inline]
    fn is_in_range(&self) -> bool {
        self.hi().is_finite() && self.lo().is_finite()
    }

    fn sqrt(&self) -> Self {
        DoubleDouble::sqrt(*self)
    }

    fn exp(&self) -> Self {
        DoubleDouble::exp(*self)
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let (sin, cos) = self.exact_sin_cos();
        [sin, cos]
    }

    fn atan2(&self, x: &Self) -> Self {
        DoubleDouble::atan2(*self, *x)
    }

    fn pi(&self) -> Self {
        Self::PI
    }

    #[inline]
    fn times_power_of_two(&self, exponent: i32) -> Self {
        DoubleDouble::times_power_of_two(*self, exponent)
    }
}

/// A number of limited precision. A sum or product keeps the larger precision of its two parts. Functions are given the
/// precision of their argument, because dashu's e^0 is a 1 of unlimited precision, of which no quotient exists.
impl Elementary for Big {
    fn like(&self, value: f64) -> Self {
        self.like_big(&exactly(value))
    }

    fn like_big(&self, value: &Big) -> Self {
        value.clone().with_precision(self.precision()).value()
    }

    fn to_f64(&self) -> f64 {
        Big::to_f64(self).value()
    }

    fn to_double_double(&self) -> DoubleDouble {
        DoubleDouble::nearest(self)
    }

    fn to_big(&self) -> Big {
        self.clone().with_precision(0).value()
    }

    fn sign(&self) -> f64 {
        self.partial_cmp(&Big::ZERO).map_or(0.0, |order| f64::from(order as i8))
    }

    fn digits(&self) -> i32 {
        i32::try_from(self.precision()).unwrap_or(i32::MAX)
    }

    fn sqrt(&self) -> Self {
        if *self <= Big::ZERO { self.like(0.0) } else { self.like_big(&Big::sqrt(self)) }
    }

    fn exp(&self) -> Self {
        self.like_big(&Big::exp(self))
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let (sin, cos) = self.sin_cos();
        [sin, cos].map(|part| self.like_big(&part))
    }

    fn atan2(&self, x: &Self) -> Self {
        if *x == Big::ZERO && *self == Big::ZERO { self.like(0.0) } else { self.like_big(&Big::atan2(self, x)) }
    }

    fn pi(&self) -> Self {
        Big::pi(self.precision())
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        let shift = exponent as isize;
        self.clone() << shift
    }
}

#[cfg(test)]
mod tests;
