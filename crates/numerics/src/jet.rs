//! Truncated Taylor series in one or three variables. A formula evaluated in them gives its own partial derivatives; over
//! [balls](crate::Ball) that contain a whole box, it bounds the derivatives within the box, and so the remainder of the
//! series about its middle.
//!
//! A function is composed by Horner's rule with its own Taylor coefficients, which follow from recurrences (A. Griewank and
//! A. Walther, Evaluating Derivatives, 2nd ed. 2008, chapter 13).

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::big::Big;
use crate::elementary::{Elementary, answered_by};
use crate::number::Number;

/// The largest number of variables.
pub const MOST_VARIABLES: usize = 3;

/// The number of variables and the order of a series with this many terms.
const fn shape(terms: usize) -> (usize, usize) {
    match terms {
        4 => (MOST_VARIABLES, 1),
        5 => (1, 4),
        _ => panic!("a series has 4 terms, of order 1 in three variables, or 5, of order 4 in one"),
    }
}

/// The pairs of terms of which each term of a product of two series in one variable is made, one after another, but for those with
/// the constant term; and where those of each term end.
const PAIRS: [[u8; 2]; 6] = [[1, 1], [1, 2], [2, 1], [1, 3], [2, 2], [3, 1]];
const ENDS: [usize; 5] = [0, 0, 1, 3, 6];

/// Of order 1 there are none.
const NO_ENDS: [usize; 4] = [0; 4];

/// A Taylor series with `TERMS` terms, by ascending degree: 4 of order 1 in three variables, or 5 of order 4 in one.
///
/// Decisions are made by the constant term: [`Elementary::to_f64`] and the like ignore the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet<N, const TERMS: usize> {
    terms: [N; TERMS],
}

impl<N: Elementary, const TERMS: usize> Jet<N, TERMS> {
    /// The number of variables.
    pub const VARIABLES: usize = shape(TERMS).0;
    /// The degree of the last terms.
    pub const ORDER: usize = shape(TERMS).1;

    /// A number that depends on no variable.
    pub fn constant(value: N) -> Self {
        let mut terms: [N; TERMS] = std::array::from_fn(|_| value.like(0.0));
        terms[0] = value;
        Self { terms }
    }

    /// The number `value` + `slope` × variable number `index` < [`Self::VARIABLES`].
    pub fn variable(value: N, slope: N, index: usize) -> Self {
        debug_assert!(index < Self::VARIABLES);
        let mut jet = Self::constant(value);
        jet.terms[1 + index] = slope;
        jet
    }

    /// The terms: first the constant, then the variables in their order, or the powers of the only one.
    pub fn terms(&self) -> impl Iterator<Item = &N> {
        self.terms.iter()
    }

    /// The constant term.
    pub fn value(&self) -> &N {
        &self.terms[0]
    }

    /// The coefficients of the variables.
    pub fn slopes(&self) -> &[N] {
        &self.terms[1..=Self::VARIABLES]
    }

    /// The same series with another constant term.
    pub fn with_constant(mut self, value: N) -> Self {
        self.terms[0] = value;
        self
    }

    /// The series of what `apply` makes of each term. In place, which is several times as fast as a new array.
    #[inline]
    fn each(mut self, apply: impl Fn(N) -> N) -> Self {
        for term in &mut self.terms {
            *term = apply(term.clone());
        }
        self
    }

    /// Whether it depends on no variable.
    pub(crate) fn is_constant(&self) -> bool {
        self.terms[1..].iter().all(|term| term.sign() == 0.0 && term.error() == 0.0)
    }

    /// The same series with the last term within `error` more.
    pub(crate) fn widened_last(mut self, error: f64) -> Self {
        self.terms[TERMS - 1] = self.terms[TERMS - 1].clone().widened(error);
        self
    }

    /// Every term over `divisor`.
    pub(crate) fn divided(self, divisor: &N) -> Self {
        self.each(|term| term / divisor.clone())
    }

    /// Every term times `factor`.
    pub fn scaled(self, factor: &N) -> Self {
        // What is exactly 0 stays so, whatever the factor is.
        let is_zero = |term: &N| term.sign() == 0.0 && term.error() == 0.0;
        self.each(|term| if is_zero(&term) { term } else { term * factor.clone() })
    }

    /// The function of this number with these Taylor coefficients, as many as the order and one, at the constant term.
    pub fn composed(&self, coefficients: &[N; 5]) -> Self {
        // A constant keeps no derivative of the function, which may be infinite.
        if self.is_constant() {
            return Self::constant(coefficients[0].clone());
        }
        let mut variable_part = self.clone();
        variable_part.terms[0] = self.terms[0].like(0.0);
        let mut sum = variable_part.clone().scaled(&coefficients[Self::ORDER]);
        for coefficient in coefficients[1..Self::ORDER].iter().rev() {
            sum.terms[0] = coefficient.clone();
            sum = sum.product(&variable_part);
        }
        sum.terms[0] = coefficients[0].clone();
        sum
    }

    /// The product, of which no series is moved.
    fn product(&self, other: &Self) -> Self {
        if other.is_constant() {
            return self.clone().scaled(&other.terms[0]);
        }
        if self.is_constant() {
            return other.clone().scaled(&self.terms[0]);
        }
        let (pairs, ends): (&[_], &[_]) = if Self::VARIABLES == 1 { (&PAIRS, &ENDS) } else { (&[], &NO_ENDS) };
        Self { terms: N::product_of_series(&self.terms, &other.terms, pairs, ends) }
    }

    /// The coefficients from the first one and a rule for the next of each.
    pub(crate) fn coefficients(first: &N, next: impl Fn(&N, f64) -> N) -> [N; 5] {
        let mut coefficients = std::array::from_fn(|_| first.clone());
        for index in 1..5 {
            let next = next(&coefficients[index - 1], index as f64);
            coefficients[index] = next;
        }
        coefficients
    }

    /// The coefficients of the square root about a number with this root and this inverse.
    pub(crate) fn of_root(root: &N, inverse: &N) -> [N; 5] {
        Self::coefficients(root, |last, k| last.clone() * inverse.clone() * last.like(1.5 - k) / last.like(k))
    }

    /// The coefficients of e^x about a number with this power.
    pub(crate) fn of_power(power: &N) -> [N; 5] {
        Self::coefficients(power, |last, k| last.clone() / last.like(k))
    }

    /// The coefficients of sine and cosine about a number with these.
    pub(crate) fn of_sine_and_cosine([sin, cos]: [N; 2]) -> [[N; 5]; 2] {
        let number = |part: &N, divisor: f64| part.clone() / part.like(divisor);
        let fall = -sin.clone();
        [[&sin, &cos], [&cos, &fall]].map(|[value, slope]| {
            [value.clone(), slope.clone(), -number(value, 2.0), -number(slope, 6.0), number(value, 24.0)]
        })
    }

    /// 1 over this number.
    pub fn reciprocal(&self) -> Self {
        let inverse = self.terms[0].like(1.0) / self.terms[0].clone();
        self.composed(&Self::coefficients(&inverse, |last, _| -(last.clone() * inverse.clone())))
    }

    /// The arctangent without its value at the constant term, which is left 0.
    fn arctangent_without_value(&self) -> Self {
        let at = &self.terms[0];
        let (zero, one) = (at.like(0.0), at.like(1.0));
        let inverse = one.clone() / (one + at.clone() * at.clone());
        let mut coefficients = std::array::from_fn(|_| zero.clone());
        let [mut before, mut last] = [zero, inverse.clone()];
        coefficients[1] = last.clone();
        // (1 + x²) k c_k = -2x (k - 1) c_{k-1} - (k - 2) c_{k-2}
        for (k, coefficient) in (2..=Self::ORDER).zip(&mut coefficients[2..]) {
            let less = |by: usize| at.like((k - by) as f64);
            let sum = (at.clone() + at.clone()) * less(1) * last.clone() + less(2) * before;
            [before, last] = [last, -(sum * inverse.clone()) / less(0)];
            *coefficient = last.clone();
        }
        self.composed(&coefficients)
    }
}

impl<N: Elementary, const TERMS: usize> Add for Jet<N, TERMS> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let mut sum = self;
        for (term, other) in sum.terms.iter_mut().zip(&other.terms) {
            *term = term.clone() + other.clone();
        }
        sum
    }
}

impl<N: Elementary, const TERMS: usize> Neg for Jet<N, TERMS> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.each(|term| -term)
    }
}

impl<N: Elementary, const TERMS: usize> Sub for Jet<N, TERMS> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        let mut difference = self;
        for (term, other) in difference.terms.iter_mut().zip(&other.terms) {
            *term = term.clone() - other.clone();
        }
        difference
    }
}

impl<N: Elementary, const TERMS: usize> Mul for Jet<N, TERMS> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.product(&other)
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "a series is divided by multiplying with the reciprocal")]
impl<N: Elementary, const TERMS: usize> Div for Jet<N, TERMS> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self * other.reciprocal()
    }
}

impl<N: Elementary, const TERMS: usize> Number for Jet<N, TERMS> {}

impl<N: Elementary, const TERMS: usize> Elementary for Jet<N, TERMS> {
    fn like(&self, value: f64) -> Self {
        Self::constant(self.terms[0].like(value))
    }

    fn like_big(&self, value: &Big) -> Self {
        Self::constant(self.terms[0].like_big(value))
    }

    answered_by!(self, self.terms[0]);

    fn error(&self) -> f64 {
        self.terms[0].error()
    }

    fn has_known_sign(&self) -> bool {
        self.terms[0].has_known_sign()
    }

    fn sqrt(&self) -> Self {
        let root = self.terms[0].sqrt();
        let inverse = self.terms[0].like(1.0) / self.terms[0].clone();
        self.composed(&Self::of_root(&root, &inverse))
    }

    fn exp(&self) -> Self {
        self.composed(&Self::of_power(&self.terms[0].exp()))
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        Self::of_sine_and_cosine(self.terms[0].sine_and_cosine()).map(|coefficients| self.composed(&coefficients))
    }

    /// The angle is continuous over all numbers that a ball contains, also across the cut at ±π.
    fn atan2(&self, x: &Self) -> Self {
        let value = self.terms[0].atan2(&x.terms[0]);
        let is_flat = self.to_f64().abs() <= x.to_f64().abs();
        let mut angle = if is_flat {
            (self.clone() / x.clone()).arctangent_without_value()
        } else {
            -(x.clone() / self.clone()).arctangent_without_value()
        };
        angle.terms[0] = value;
        angle
    }

    fn pi(&self) -> Self {
        Self::constant(self.terms[0].pi())
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        self.clone().each(|term| term.times_power_of_two(exponent))
    }

    fn widened(mut self, error: f64) -> Self {
        self.terms[0] = self.terms[0].clone().widened(error);
        self
    }

    fn widened_throughout(self, error: f64) -> Self {
        self.each(|term| term.widened(error))
    }

    fn bound(&self) -> f64 {
        self.terms.iter().map(N::bound).sum::<f64>() * (1.0 + 64.0 * f64::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DoubleDouble;
    use crate::ball::Ball;

    /// All operations and functions, of three numbers.
    fn formula<N: Elementary>([x, y, z]: [N; 3]) -> N {
        let [sin, cos] = (x.clone() * y.clone() + z.clone()).sine_and_cosine();
        let root = (x.clone() * x.clone() + y.clone().exp() + x.like(0.5)).sqrt();
        let [flat, steep] = [(sin.clone(), root.clone()), (root.clone() + x.like(3.0), cos - x.like(0.25))]
            .map(|(height, along)| height.atan2(&along));
        (flat * steep - z.clone() / (root + x.like(1.0))).times_power_of_two(1) + -y * x.pi() * z
    }

    /// Polynomials in the step, fitted by differences in double-double, have the coefficients of the series along a line.
    fn check<const TERMS: usize>(at: [f64; 3]) {
        let variables = Jet::<DoubleDouble, TERMS>::VARIABLES;
        let number = DoubleDouble::from;
        let found = formula(std::array::from_fn(|index| {
            if index < variables {
                Jet::<_, TERMS>::variable(number(at[index]), number(1.0), index)
            } else {
                Jet::constant(number(at[index]))
            }
        }));
        assert_eq!(found.terms().count(), TERMS);
        const STEP: f64 = 0.000_976_562_5; // 2^-10
        for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, -2.0, 0.0], [0.5, 1.0, -1.0], [-1.0, 0.5, 0.25]] {
            let value = |steps: f64| {
                let moved = std::array::from_fn(|index| {
                    let moves = if index < variables { direction[index] } else { 0.0 };
                    number(at[index] + moves * steps * STEP)
                });
                formula(moved)
            };
            let series = |steps: f64| {
                let along = |index: usize| direction[index] * steps * STEP;
                let power = |index: usize| if variables == 1 { along(0).powi(index as i32) } else { along(index - 1) };
                let parts = found.terms().enumerate().skip(1).map(|(index, term)| *term * number(power(index)));
                parts.fold(*found.value(), |sum, part| sum + part)
            };
            // What is left is the next term, which falls with the power of the step.
            let order = i32::try_from(Jet::<DoubleDouble, TERMS>::ORDER).unwrap();
            for steps in [-1.0, 1.0, 2.0] {
                let off = (value(steps) - series(steps)).hi().abs();
                let allowed = 2e3 * (steps.abs() * STEP).powi(order + 1);
                assert!(off <= allowed, "{TERMS} {at:?} {direction:?} {steps}: {off:e} > {allowed:e}");
            }
        }
    }

    #[test]
    fn a_series_is_that_of_the_formula_in_any_direction() {
        for at in [[0.3, -0.4, 0.7], [-1.1, 0.2, -0.5], [0.9, 0.8, 1.3]] {
            check::<4>(at);
            check::<5>(at);
        }
    }

    #[test]
    fn a_constant_keeps_no_infinite_derivative_and_a_constant_term_is_the_number() {
        assert_eq!(Jet::<f64, 5>::constant(0.0).sqrt(), Jet::constant(0.0));
        let jet = Jet::<f64, 5>::variable(4.0, 2.0, 0);
        assert_eq!((*jet.value(), jet.slopes(), jet.to_f64()), (4.0, &[2.0][..], 4.0));
        assert_eq!(*jet.with_constant(1.0).value(), 1.0);
        assert_eq!(jet.reciprocal().slopes(), [-0.125]);
    }

    #[test]
    fn what_is_exactly_0_stays_so_whatever_it_is_multiplied_with() {
        let [two, one] = [2.0, 1.0].map(|value| Ball::new(value, 0.0));
        let variable = Jet::<_, 4>::variable(two, one, 1);
        let [unknown, zero] = [f64::INFINITY, 0.0].map(|radius| Ball::new(0.0, radius));
        for found in [variable.scaled(&unknown), variable * Jet::constant(unknown), Jet::constant(unknown) * variable] {
            let radii: Vec<_> =
                found.terms().map(|term| Some(term.radius()).filter(|radius| radius.is_finite())).collect();
            assert_eq!(radii, [None, Some(0.0), None, Some(0.0)]);
        }
        // A number that is 0 within its error is none that is 0.
        let near = Jet::<_, 5>::variable(one, Ball::new(0.0, 0.5), 0);
        assert!(near.scaled(&two).slopes()[0].radius() >= 1.0 && (near * near).slopes()[0].radius() >= 1.0);
        assert_eq!(Jet::<_, 5>::variable(one, zero, 0).sqrt().slopes(), [zero]);
        let root = Jet::<_, 4>::variable(one, Ball::new(0.0, 0.5), 2).sqrt();
        assert!(root.slopes()[..2] == [zero; 2] && (0.25..0.26).contains(&root.slopes()[2].radius()), "{root:?}");
    }

    #[test]
    fn decisions_are_those_of_the_constant_term_and_the_range_is_that_of_all_terms() {
        let [value, slope] = [(-3.0, 0.5), (7.0, 20.0)].map(|(value, radius)| Ball::new(value, radius));
        let jet = Jet::<_, 5>::variable(value, slope, 0);
        assert_eq!((jet.to_f64(), jet.to_double_double().hi(), jet.sign(), jet.error()), (-3.0, -3.0, -1.0, 0.5));
        assert_eq!((jet.to_big(), jet.digits()), (value.to_big(), value.digits()));
        assert_eq!([-jet, jet - jet.with_constant(value)].map(|jet| jet.sign()), [1.0, 0.0]);
        assert!(jet.has_known_sign() && !jet.widened(4.0).has_known_sign());
        assert!((jet.pi().value().midpoint() - std::f64::consts::PI).abs() < 1e-15 && jet.pi().is_constant());
        let wide = jet.widened(4.0);
        assert!(wide.error() >= 4.5 && wide.slopes() == jet.slopes());
    }
}
