//! Taylor models: a function on an interval as a polynomial of degree 4 with error bounds (K. Makino and M. Berz, Int. J.
//! Pure Appl. Math. 4 (2003), 379, describes the technique). A formula evaluated in them encloses its values over the whole
//! interval, and keeps how they depend on the variable: intervals can be far wider than for numbers that forget it.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::big::Big;
use crate::elementary::{Elementary, answered_by};
use crate::jet::Jet;
use crate::number::Number;

/// The number of terms.
const TERMS: usize = 5;

/// A factor that covers the roundings of a bound: a sum of a few products of f64.
const GROWN: f64 = 1.0 + 64.0 * f64::EPSILON;

/// A function of one variable x, |x| ≤ 1: for each x its value is Σ cₖ xᵏ for some numbers cₖ in the five balls. What
/// has a higher degree, at most the sum of its coefficients, is in the ball of the last.
#[derive(Debug, Clone, PartialEq)]
pub struct TaylorModel<N>(Jet<N, TERMS>);

impl<N: Elementary> TaylorModel<N> {
    /// A number that does not depend on x.
    pub fn constant(value: N) -> Self {
        Self(Jet::constant(value))
    }

    /// `value` + `slope` × x.
    pub fn variable(value: N, slope: N) -> Self {
        Self(Jet::variable(value, slope, 0))
    }

    /// A number that contains the values for all x.
    pub fn range(&self) -> N {
        self.0.value().clone().widened(self.change())
    }

    /// A polynomial, and a bound of how far the function is from it for |x| ≤ 1. A coefficient that is rounded is so to half
    /// an ulp.
    pub fn polynomial(&self) -> ([f64; TERMS], f64) {
        let mut polynomial = [0.0; TERMS];
        let mut error = 0.0;
        for (coefficient, term) in polynomial.iter_mut().zip(self.0.terms()) {
            *coefficient = term.to_f64();
            error += term.error() + f64::EPSILON * coefficient.abs() + f64::MIN_POSITIVE;
        }
        (polynomial, error * GROWN)
    }

    /// How far the value can be from that at x = 0.
    fn change(&self) -> f64 {
        self.0.terms().skip(1).map(N::bound).sum::<f64>() * GROWN
    }

    /// The function of this number with these Taylor coefficients at the constant term, and the part of the remainder that
    /// is not above `rest`.
    fn composed(&self, coefficients: &[N; TERMS], rest: f64) -> Self {
        let variable_part = Self(self.0.clone().with_constant(self.0.value().like(0.0)));
        let [low @ .., last] = coefficients;
        let sum = low.iter().rev().fold(Self::constant(last.clone()), |sum, coefficient| {
            let Self(product) = sum * variable_part.clone();
            let value = product.value().clone() + coefficient.clone();
            Self(product.with_constant(value))
        });
        sum.widened(rest)
    }

    /// 1 over this number: with z = change/|constant term| the remainder is at most z⁵/(1 - z) of the first coefficient.
    fn reciprocal(&self) -> Self {
        let inverse = self.0.value().like(1.0) / self.0.value().clone();
        let next = |last: &N, _: f64| -(last.clone() * inverse.clone());
        let rest = self.remainder(&inverse) * inverse.bound();
        self.composed(&Jet::<N, TERMS>::coefficients(&inverse, next), rest)
    }

    /// z⁵/(1 - z) for z = change times `inverse`; infinite from 1 on.
    fn remainder(&self, inverse: &N) -> f64 {
        let z = self.change() * inverse.bound() * GROWN;
        if z < 1.0 { z.powi(5) / (1.0 - z) * (GROWN * GROWN) } else { f64::INFINITY }
    }
}

impl<N: Elementary> Add for TaylorModel<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<N: Elementary> Neg for TaylorModel<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<N: Elementary> Sub for TaylorModel<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<N: Elementary> Mul for TaylorModel<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.0.is_constant() || other.0.is_constant() {
            return Self(self.0 * other.0);
        }
        let bounds = |jet: &Jet<N, TERMS>| {
            let mut bounds = [0.0; TERMS];
            bounds.iter_mut().zip(jet.terms()).for_each(|(bound, term)| *bound = term.bound());
            bounds
        };
        let [one, two] = [&self.0, &other.0].map(bounds);
        let beyond = |i: usize| two[TERMS - i..].iter().sum::<f64>();
        let rest: f64 = (1..TERMS).map(|i| one[i] * beyond(i)).sum();
        // What underflowed is below 2^-1000.
        Self((self.0 * other.0).widened_last(rest * GROWN + f64::MIN_POSITIVE))
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "a model is divided by multiplying with the reciprocal")]
impl<N: Elementary> Div for TaylorModel<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.0.is_constant() {
            let by = other.0.value().clone();
            return Self(self.0.divided(&by));
        }
        self * other.reciprocal()
    }
}

impl<N: Elementary> Number for TaylorModel<N> {}

impl<N: Elementary> Elementary for TaylorModel<N> {
    fn like(&self, value: f64) -> Self {
        Self(self.0.like(value))
    }

    fn like_big(&self, value: &Big) -> Self {
        Self(self.0.like_big(value))
    }

    answered_by!(self, self.0);

    fn error(&self) -> f64 {
        self.0.error() + self.change()
    }

    fn has_known_sign(&self) -> bool {
        self.range().has_known_sign()
    }

    /// With z = change/|constant term| the remainder is at most 7/256 z⁵/(1 - z) of the root: no coefficient of √(1 + z) from
    /// the fifth on is larger.
    fn sqrt(&self) -> Self {
        let root = self.0.value().sqrt();
        if self.0.is_constant() {
            return Self::constant(root);
        }
        let inverse = root.like(1.0) / self.0.value().clone();
        let rest = self.remainder(&inverse) * root.bound() * (7.0 / 256.0);
        self.composed(&Jet::<N, TERMS>::of_root(&root, &inverse), rest)
    }

    fn exp(&self) -> Self {
        let power = self.0.value().exp();
        let change = self.change();
        let rest = power.bound() * change.exp() * change.powi(5) / 120.0 * GROWN;
        self.composed(&Jet::<N, TERMS>::of_power(&power), rest)
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let rest = self.change().powi(5) / 120.0 * GROWN;
        let coefficients = Jet::<N, TERMS>::of_sine_and_cosine(self.0.value().sine_and_cosine());
        coefficients.map(|coefficients| self.composed(&coefficients, rest))
    }

    /// Of this function a model knows no more than that it is an angle.
    fn atan2(&self, _: &Self) -> Self {
        self.like(0.0).widened(4.0)
    }

    fn pi(&self) -> Self {
        Self(self.0.pi())
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        Self(self.0.times_power_of_two(exponent))
    }

    fn widened(self, error: f64) -> Self {
        Self(self.0.widened(error))
    }

    fn bound(&self) -> f64 {
        self.0.bound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DoubleDouble;
    use crate::ball::Ball;

    /// All operations and functions but atan2.
    fn formula<N: Elementary>(x: &N) -> N {
        let one = x.like(1.0);
        let [sin, cos] = (x.clone() * x.clone() + one.clone()).sine_and_cosine();
        let root = (x.clone().exp() + cos.clone()).sqrt();
        (sin * root.clone() - x.pi() * x.clone()) / (root + one) - x.times_power_of_two(-1) * cos
    }

    /// Values over the interval are in the range, which is no wider than some times what they are.
    #[test]
    fn a_range_contains_the_values_of_the_interval() {
        for (middle, width) in [(0.3, 1e-3), (0.3, 0.1), (1.0, 0.3), (-0.7, 0.02), (2.0, 1e-9)] {
            let number = |value: f64| Ball::new(DoubleDouble::exactly(value), 0.0);
            let model = formula(&TaylorModel::variable(number(middle), number(width)));
            let range = model.range();
            let (mut most, at_middle) = (0.0_f64, formula(&number(middle)));
            for step in -50..=50 {
                let at = number(middle) + Ball::new(DoubleDouble::product(width, f64::from(step) / 50.0), 0.0);
                let exact = formula(&at);
                let off = (exact - range).to_f64().abs();
                assert!(off <= range.error(), "{middle} {width} {step}: {off:e} {:e}", range.error());
                most = most.max((exact - at_middle).to_f64().abs());
            }
            assert!(range.error() < 1.5 * most + 5.0 * width.powi(2), "{middle} {width}: {:e} {most:e}", range.error());
        }
    }

    /// At each place the polynomial with its balls contains the value: also its ends, where the last ball counts.
    #[test]
    fn the_polynomial_with_its_balls_contains_the_function() {
        for width in [0.05, 0.2, 0.4] {
            let number = |value: f64| Ball::new(value, 0.0);
            let model = formula(&TaylorModel::variable(number(0.3), number(width)));
            let mut closest = f64::INFINITY;
            for step in -20..=20 {
                let x = f64::from(step) / 20.0;
                let exact = formula(&DoubleDouble::from(0.3 + width * x)).hi();
                let (mut sum, mut error) = (0.0, 0.0);
                for (index, term) in model.0.terms().enumerate() {
                    let power = x.powi(i32::try_from(index).unwrap());
                    sum += term.to_f64() * power;
                    error += term.error() * power.abs();
                }
                let (polynomial, bound) = model.polynomial();
                let value = polynomial.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient);
                assert!(error <= bound, "{width} {x}: {error:e} {bound:e}");
                assert!(x.abs() < 1.0 || bound < 40.0 * error.max(1e-16), "{width} {x}: {error:e} {bound:e}");
                assert!((value - exact).abs() <= bound + 1e-15, "{width} {x}: {value} {exact} {bound:e}");
                assert!((sum - exact).abs() <= error + 1e-15, "{width} {x}: {sum} {exact} {error:e}");
                closest = closest.min(error / (sum - exact).abs());
            }
            assert!(closest < 300.0, "{width}: {closest}");
        }
    }

    #[test]
    fn what_leaves_the_range_of_a_series_is_not_bounded() {
        let number = |value: f64| Ball::new(value, 0.0);
        let wide = TaylorModel::variable(number(1.0), number(1.0));
        assert!(!(wide.like(1.0) / wide.clone()).has_known_sign());
        assert!(wide.sqrt().range().error() == f64::INFINITY);
        let narrow = TaylorModel::variable(number(1.0), number(0.4));
        assert!((narrow.like(1.0) / narrow.clone()).has_known_sign() && narrow.sqrt().has_known_sign());
        assert!((4.0..4.0 + 1e-9).contains(&narrow.atan2(&wide).range().error()));
    }
}
