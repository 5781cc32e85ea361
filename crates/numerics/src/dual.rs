//! Numbers with a derivative: a value and its slope with respect to one input. A formula evaluated in them gives its
//! own derivative, without a second formula that could differ from the first.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::big::Big;
use crate::double_double::DoubleDouble;
use crate::elementary::Elementary;
use crate::number::Number;

/// A number and its derivative with respect to one input.
///
/// Decisions are made by the value: [`Elementary::to_f64`] and the like ignore the slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<N> {
    /// The value.
    pub value: N,
    /// Its derivative.
    pub slope: N,
}

impl<N: Elementary> Dual<N> {
    /// A number that does not depend on the input.
    pub fn constant(value: N) -> Self {
        let slope = value.like(0.0);
        Self { value, slope }
    }

    /// The input itself.
    pub fn input(value: N) -> Self {
        let slope = value.like(1.0);
        Self { value, slope }
    }
}

impl<N: Elementary> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<N: Elementary> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<N: Elementary> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<N: Elementary> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value.clone() + self.value.clone() * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl<N: Elementary> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value.clone();
        let slope = (self.slope - value.clone() * other.slope) / other.value;
        Self { value, slope }
    }
}

impl<N: Elementary> Number for Dual<N> {}

impl<N: Elementary> Elementary for Dual<N> {
    fn like(&self, value: f64) -> Self {
        Self::constant(self.value.like(value))
    }

    fn like_big(&self, value: &Big) -> Self {
        Self::constant(self.value.like_big(value))
    }

    fn with_value(&self, value: &Big) -> Self {
        Self { value: self.value.with_value(value), slope: self.slope.clone() }
    }

    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    fn to_double_double(&self) -> DoubleDouble {
        self.value.to_double_double()
    }

    fn to_big(&self) -> Big {
        self.value.to_big()
    }

    fn sign(&self) -> f64 {
        self.value.sign()
    }

    fn error(&self) -> f64 {
        self.value.error()
    }

    fn has_known_sign(&self) -> bool {
        self.value.has_known_sign()
    }

    fn digits(&self) -> i32 {
        self.value.digits()
    }

    fn is_in_range(&self) -> bool {
        self.value.is_in_range() && self.slope.is_in_range()
    }

    fn sqrt(&self) -> Self {
        let value = self.value.sqrt();
        // A slope around 0 with an error bound is not 0.
        let flat = self.slope.sign() == 0.0 && self.slope.error() == 0.0;
        let slope = if flat { self.slope.clone() } else { self.slope.clone() / (value.clone() + value.clone()) };
        Self { value, slope }
    }

    fn exp(&self) -> Self {
        let value = self.value.exp();
        Self { slope: value.clone() * self.slope.clone(), value }
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let [sin, cos] = self.value.sine_and_cosine();
        let rise = cos.clone() * self.slope.clone();
        let fall = -(sin.clone() * self.slope.clone());
        [Self { value: sin, slope: rise }, Self { value: cos, slope: fall }]
    }

    fn atan2(&self, x: &Self) -> Self {
        let product = |a: &N, b: &N| a.clone() * b.clone();
        let squared = product(&self.value, &self.value) + product(&x.value, &x.value);
        let turn = product(&x.value, &self.slope) - product(&self.value, &x.slope);
        Self { value: self.value.atan2(&x.value), slope: turn / squared }
    }

    fn pi(&self) -> Self {
        Self::constant(self.value.pi())
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        let [value, slope] = [&self.value, &self.slope].map(|part| part.times_power_of_two(exponent));
        Self { value, slope }
    }

    fn widened(self, error: f64) -> Self {
        Self { value: self.value.widened(error), slope: self.slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;

    fn formula<N: Elementary>(x: &N) -> N {
        let one = x.like(1.0);
        let [sin, cos] = (x.clone() * x.clone()).sine_and_cosine();
        let root = (x.clone() + one.exp()).sqrt() / (sin - x.like(3.0));
        root.atan2(&cos) * (-x.clone()).exp() - (x.clone() * x.pi()).times_power_of_two(-3)
    }

    #[test]
    fn slopes_are_those_of_differences_and_values_those_without_a_slope() {
        const STEP: f64 = 9.094_947_017_729_282e-13; // 2^-40
        for value in [-1.3, -0.2, 0.4, 2.1] {
            let found = formula(&Dual::input(DoubleDouble::from(value)));
            let at = |value: f64| formula(&DoubleDouble::from(value));
            let difference = (at(value + STEP) - at(value - STEP)) / (2.0 * STEP).into();
            assert!((found.slope - difference).hi().abs() < 1e-18, "{value}: {found:?} {difference:?}");
            assert_eq!(found.value, at(value));
            assert_eq!(formula(&Dual::constant(DoubleDouble::from(value))).slope, DoubleDouble::ZERO);
        }
    }

    /// Of a number with an error bound, so that each of these is a number of its own.
    #[test]
    fn everything_but_the_slope_is_that_of_the_value() {
        for midpoint in [-2.5, 0.0, 1e-3] {
            let value = Ball::new(DoubleDouble::quotient(midpoint, 3.0), 1e-3);
            let dual = Dual { value, slope: value.like(7.0) };
            assert_eq!((dual.to_f64(), dual.to_double_double()), (value.to_f64(), value.to_double_double()));
            assert_eq!((dual.to_big(), dual.digits()), (value.to_big(), value.digits()));
            assert_eq!((dual.sign(), dual.error()), (value.sign(), value.error()));
            assert_eq!(dual.has_known_sign(), value.has_known_sign());
            let big = value.to_big();
            assert_eq!(dual.like_big(&big), Dual::constant(value.like_big(&big)));
            assert_eq!(dual.with_value(&big), Dual { value: value.like_big(&big), slope: dual.slope });
            assert_eq!(dual.widened(0.5), Dual { value: value.widened(0.5), slope: dual.slope });
        }
        // The root of a constant 0 has no slope, where that of an input of 0 is infinite.
        assert_eq!(Dual::constant(0.0).sqrt(), Dual::constant(0.0));
    }

    /// The slope of √x is that of x by 2√x, also where no more is known of it than that it is around 0.
    #[test]
    fn the_root_of_a_slope_around_0_keeps_its_error_bound() {
        let [value, slope] = [(1e-4, 0.0), (0.0, 0.1)].map(|(midpoint, radius)| Ball::new(midpoint, radius));
        let found = Dual { value, slope }.sqrt().slope;
        assert!(found.midpoint().abs() + found.radius() >= 0.1 / (2.0 * 1e-2), "{found:?}");
        assert!(found.radius() < 5.1, "{found:?}");
    }

    #[test]
    fn a_dual_is_in_range_if_both_of_its_parts_are() {
        for (value, slope, expected) in [(1.0, 2.0, true), (f64::NAN, 2.0, false), (1.0, f64::INFINITY, false)] {
            assert_eq!(Dual { value, slope }.is_in_range(), expected);
        }
    }
}
