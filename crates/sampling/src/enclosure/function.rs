//! The arithmetic of the bounds of a mean: a function as a pair of series, one about the middle of a cell and one over the whole of
//! it, and bounds of its mean and of that of its positive part.

use numerics::positive_part::{self, Curved, Power};
use numerics::{Ball, Elementary};

use super::cell::MOST_DIRECTIONS;
use super::series::{Exponents, Series};

/// Bounds of a mean over a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) lo: f64,
    pub(super) hi: f64,
    /// How much each direction adds to the width, roughly.
    pub(super) by: [f64; MOST_DIRECTIONS],
}

impl Bounds {
    /// The width, infinite if nothing is known.
    pub(super) fn width(&self) -> f64 {
        let width = self.hi - self.lo;
        if width.is_nan() { f64::INFINITY } else { width }
    }

    fn of_ball(ball: &Ball<f64>, by: [f64; MOST_DIRECTIONS]) -> Self {
        let [lo, hi] = [lower(ball), upper(ball)];
        if lo.is_nan() || hi.is_nan() {
            return Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY, by };
        }
        Self { lo, hi, by }
    }

    /// The sum with a multiple `sign` = ±1 of other bounds.
    pub(super) fn plus(self, sign: f64, other: Self) -> Self {
        let [lo, hi] = if sign > 0.0 { [other.lo, other.hi] } else { [-other.hi, -other.lo] };
        let by = std::array::from_fn(|index| self.by[index] + other.by[index]);
        Self { lo: (self.lo + lo).next_down(), hi: (self.hi + hi).next_up(), by }
    }
}

pub(super) fn lower(ball: &Ball<f64>) -> f64 {
    (ball.midpoint() - ball.radius()).next_down()
}

pub(super) fn upper(ball: &Ball<f64>) -> f64 {
    (ball.midpoint() + ball.radius()).next_up()
}

pub(super) fn exactly(value: f64) -> Ball<f64> {
    Ball::new(value, 0.0)
}

/// The largest absolute value in a ball; infinite if nothing is known.
pub(super) fn magnitude(ball: &Ball<f64>) -> f64 {
    let size = (ball.midpoint().abs() + ball.radius()).next_up();
    if size.is_nan() { f64::INFINITY } else { size }
}

/// A function about the middle of a cell, in a series of the order 2, and over the whole of it, in one of the same or a higher order.
#[derive(Clone, Copy)]
pub(super) struct Function<const T: usize, const F: usize> {
    pub(super) middle: Series<T>,
    pub(super) whole: Series<F>,
}

impl<const T: usize, const F: usize> Function<T, F> {
    pub(super) fn constant(value: Ball<f64>) -> Self {
        Self { middle: Series::constant(value), whole: Series::constant(value) }
    }

    #[inline]
    pub(super) fn times(&self, other: &Self) -> Self {
        Self { middle: self.middle.times(&other.middle), whole: self.whole.times(&other.whole) }
    }

    #[inline]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { middle: self.middle.plus(&other.middle), whole: self.whole.plus(&other.whole) }
    }

    #[inline]
    pub(super) fn minus(&self, other: &Self) -> Self {
        Self { middle: self.middle.minus(&other.middle), whole: self.whole.minus(&other.whole) }
    }

    #[inline]
    pub(super) fn scaled(&self, factor: &Ball<f64>) -> Self {
        Self { middle: self.middle.scaled(factor), whole: self.whole.scaled(factor) }
    }

    #[inline]
    pub(super) fn shifted(&self, by: Ball<f64>) -> Self {
        let shifted = |value| value + by;
        Self {
            middle: self.middle.with_constant(shifted(self.middle.value())),
            whole: self.whole.with_constant(shifted(self.whole.value())),
        }
    }

    pub(super) fn reciprocal(&self) -> Self {
        Self { middle: self.middle.reciprocal(), whole: self.whole.reciprocal() }.narrowed()
    }

    /// 1 over the square root.
    pub(super) fn inverse_root(&self) -> Self {
        Self { middle: self.middle.inverse_root(), whole: self.whole.inverse_root() }.narrowed()
    }

    /// The angle of the point (`x`, `self`), with 1 over the square of its radius.
    pub(super) fn angle(&self, x: &Self, inverse: &Self) -> Self {
        let middle = self.middle.angle(&x.middle, &inverse.middle);
        Self { middle, whole: self.whole.angle(&x.whole, &inverse.whole) }.narrowed()
    }

    /// The same function in series of the order 2.
    #[inline]
    pub(super) fn of_order_2(&self) -> Function<T, T> {
        Function { middle: self.middle, whole: self.whole.truncated() }
    }

    /// The same function, whose values over the cell are bounded by the mean value theorem where that is narrower.
    #[inline]
    pub(super) fn narrowed(mut self) -> Self {
        let value = self.middle.value();
        let slopes = self.variation().iter().sum::<f64>();
        let reach = (value.radius() + slopes) * (1.0 + 4.0 * f64::EPSILON);
        if reach < self.whole.value().radius() || self.whole.value().radius().is_nan() {
            self.whole = self.whole.with_constant(Ball::new(*value.midpoint(), reach));
        }
        self
    }

    /// The values over the cell.
    pub(super) fn values(&self) -> Ball<f64> {
        self.whole.value()
    }

    /// The sign over the whole cell.
    pub(super) fn sign(&self) -> Option<f64> {
        self.values().has_known_sign().then(|| self.values().sign())
    }

    /// The largest absolute values of the slopes.
    pub(super) fn variation(&self) -> [f64; MOST_DIRECTIONS] {
        let slope = |index: usize| magnitude(&self.whole.term(1 + index));
        std::array::from_fn(|index| if index < Series::<F>::VARIABLES { slope(index) } else { 0.0 })
    }

    /// Bounds of the mean over the cell: the terms of even degree about the middle have means, and the last terms are
    /// known over the whole cell as far as their balls tell.
    pub(super) fn mean(&self) -> Bounds {
        let is_even = |exponents: &Exponents| exponents.iter().all(|exponent| exponent % 2 == 0);
        let mut sum = self.middle.value();
        for (exponents, term) in self.middle.of_degree(2).filter(|(exponents, _)| is_even(exponents)) {
            sum = sum + term * Ball::new(moment(exponents), f64::EPSILON);
        }
        let mut by = [0.0; MOST_DIRECTIONS];
        for (exponents, term) in self.whole.of_degree(Series::<F>::ORDER) {
            let moment = moment(exponents);
            if is_even(exponents) {
                sum = sum + exactly(*term.midpoint()) * Ball::new(moment, f64::EPSILON);
            }
            let part = term.radius() * moment * (1.0 + 4.0 * f64::EPSILON);
            sum = sum.widened(part);
            add_by(&mut by, part, exponents);
        }
        Bounds::of_ball(&sum, by)
    }

    /// Bounds of the mean of the positive part. The function is a polynomial of the second degree about the middle, but for the
    /// terms of the third over the whole cell.
    pub(super) fn mean_of_positive_part(&self) -> Bounds {
        let (mut by, mut off) = ([0.0; MOST_DIRECTIONS], 0.0);
        let mut curved = Curved { constant: *self.middle.value().midpoint(), ..Curved::default() };
        for (index, exponents) in Series::<T>::EXPONENTS.iter().enumerate() {
            let term = self.middle.term(index);
            off += term.radius() * moment(exponents);
            let mut variables = (0..MOST_DIRECTIONS).flat_map(|of| std::iter::repeat_n(of, exponents[of].into()));
            match (variables.next(), variables.next()) {
                (Some(one), Some(other)) => curved.curvature[one][other] = *term.midpoint(),
                (Some(one), None) => curved.slopes[one] = *term.midpoint(),
                _ => {}
            }
        }
        for (exponents, term) in self.whole.of_degree(3) {
            let part = magnitude(&term) * moment(exponents);
            off += part;
            add_by(&mut by, part, exponents);
        }
        // Each of some twenty parts has three roundings.
        let off = off * (1.0 + 32.0 * f64::EPSILON);
        if !(off.is_finite() && curved.is_finite()) {
            return Bounds { lo: 0.0, hi: f64::INFINITY, by: self.variation() };
        }
        let ([lo, hi], bent) = positive_part::mean_of_curved(&curved, off);
        let bend = curved.bend().max(f64::MIN_POSITIVE);
        for (exponents, term) in self.middle.of_degree(2) {
            add_by(&mut by, bent * (term.midpoint().abs() / bend), exponents);
        }
        Bounds { lo, hi, by }
    }

    /// Bounds of the mean of the positive part to a `power` below 1.
    pub(super) fn mean_of_power(&self, power: Power) -> Bounds {
        let value = self.middle.value();
        let (mut by, mut off, mut slopes) = ([0.0; MOST_DIRECTIONS], value.radius(), [0.0; MOST_DIRECTIONS]);
        for (exponents, term) in self.middle.of_degree(1) {
            off = (off + term.radius()).next_up();
            let index = exponents.iter().position(|exponent| *exponent > 0).unwrap_or(0);
            slopes[index] = *term.midpoint();
        }
        for (exponents, term) in self.whole.of_degree(2) {
            let part = magnitude(&term);
            off = (off + part).next_up();
            add_by(&mut by, part, exponents);
        }
        if !(off.is_finite() && value.midpoint().is_finite()) {
            return Bounds { lo: 0.0, hi: f64::INFINITY, by: self.variation() };
        }
        let [lo, hi] = positive_part::mean(*value.midpoint(), &slopes[..Series::<T>::VARIABLES], off, power);
        Bounds { lo, hi, by }
    }
}

/// Adds what a term contributes to a width to the directions, as its exponents say.
fn add_by(by: &mut [f64; MOST_DIRECTIONS], part: f64, exponents: &Exponents) {
    let of_degree = f64::from(exponents.iter().sum::<u8>());
    for (by, exponent) in by.iter_mut().zip(exponents) {
        *by += part * f64::from(*exponent) / of_degree;
    }
}

/// The mean of |t^exponents| over the box from -1 to 1.
fn moment(exponents: &Exponents) -> f64 {
    exponents.iter().map(|exponent| 1.0 / (1.0 + f64::from(*exponent))).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial<const T: usize>(exponents: Exponents, factor: Ball<f64>) -> Series<T> {
        let mut series = Series::constant(exactly(0.0));
        series.set(Series::<T>::EXPONENTS.iter().position(|of| *of == exponents).unwrap(), factor);
        series
    }

    fn function<const T: usize, const F: usize>(middle: Series<T>, whole: Series<F>) -> Function<T, F> {
        Function { middle, whole }
    }

    /// A coefficient of a last term may have the sign of the term everywhere, so that its mean is that of the absolute value.
    #[test]
    fn a_last_term_of_any_sign_is_within_the_mean_of_its_absolute_value() {
        fn reaches<const T: usize, const F: usize>(exponents: Exponents, expected: f64) {
            let zero = Series::<T>::constant(exactly(0.0));
            let found = function(zero, monomial::<F>(exponents, Ball::new(0.0, 1.0))).mean();
            let [least, most] = [-found.lo, found.hi];
            for reach in [least, most] {
                assert!(reach >= expected && reach < expected * (1.0 + 1e-12), "{exponents:?}: {found:?}");
            }
            // Each direction adds to it as its exponent says.
            for (by, exponent) in found.by.iter().zip(exponents) {
                let part = expected * f64::from(exponent) / f64::from(exponents.iter().sum::<u8>());
                assert!((by - part).abs() < 1e-12, "{exponents:?}: {found:?}");
            }
            // With room for the roundings of two products.
            let room = found.by.iter().sum::<f64>() / expected - 1.0;
            assert!((2.0 * f64::EPSILON..8.0 * f64::EPSILON).contains(&room), "{exponents:?}: {room:e}");
            // A known one has a mean of its own.
            let known = function(zero, monomial::<F>(exponents, exactly(1.0))).mean();
            let own = if exponents.iter().all(|exponent| exponent % 2 == 0) { expected } else { 0.0 };
            assert!((known.lo - own).abs() < 1e-14 && (known.hi - own).abs() < 1e-14, "{exponents:?}: {known:?}");
        }
        reaches::<3, 5>([4, 0, 0], 1.0 / 5.0);
        reaches::<6, 15>([4, 0, 0], 1.0 / 5.0);
        reaches::<6, 15>([3, 1, 0], 1.0 / 8.0);
        reaches::<6, 15>([2, 2, 0], 1.0 / 9.0);
        reaches::<10, 20>([3, 0, 0], 1.0 / 4.0);
        reaches::<10, 20>([0, 2, 1], 1.0 / 6.0);
        reaches::<10, 20>([1, 1, 1], 1.0 / 8.0);
    }

    /// Terms of even exponents have a mean, those of the second degree too.
    #[test]
    fn the_mean_of_a_polynomial_is_that_of_its_even_terms() {
        let middle = Series::<6>::constant(exactly(2.0))
            + monomial([1, 0, 0], exactly(7.0))
            + monomial([2, 0, 0], exactly(3.0))
            + monomial([1, 1, 0], exactly(5.0))
            + monomial([0, 2, 0], exactly(0.5));
        let found = function(middle, monomial::<15>([2, 2, 0], exactly(9.0))).mean();
        let expected = 2.0 + 3.0 / 3.0 + 0.5 / 3.0 + 9.0 / 9.0;
        assert!(found.lo <= expected && expected <= found.hi && found.width() < 1e-13, "{found:?}");
    }

    /// All second derivatives add to what a function to a power below 1 is off, at their largest.
    #[test]
    fn a_power_of_a_positive_part_allows_for_all_second_derivatives() {
        let linear = || monomial::<6>([1, 0, 0], exactly(0.5)) + monomial([0, 1, 0], exactly(0.25));
        for exponents in [[2, 0, 0], [1, 1, 0], [0, 2, 0]] {
            let curved = function(linear(), monomial::<15>(exponents, Ball::new(0.0, 0.01)));
            for power in [Power::Half, Power::Zero] {
                let found = curved.mean_of_power(power);
                let [lo, hi] = positive_part::mean(0.0, &[0.5, 0.25], 0.01, power);
                assert!(
                    found.lo <= lo && found.hi >= hi && found.width() < 1.001 * (hi - lo),
                    "{power:?} {exponents:?}"
                );
                let exact = function(linear(), Series::<15>::constant(exactly(0.0))).mean_of_power(power);
                assert!(exact.width() < 1e-14);
            }
        }
    }

    /// All third derivatives add to what a positive part is off, on average.
    #[test]
    fn a_positive_part_allows_for_all_third_derivatives() {
        let curvature = Curved {
            slopes: [0.5, 0.25, 0.0],
            curvature: [[0.0, 0.125, 0.0], [0.0; 3], [0.0; 3]],
            ..Curved::default()
        };
        let middle = monomial::<6>([1, 0, 0], exactly(0.5))
            + monomial([0, 1, 0], exactly(0.25))
            + monomial([1, 1, 0], exactly(0.125));
        for (exponents, on_average) in [([3, 0, 0], 0.25), ([2, 1, 0], 1.0 / 6.0), ([0, 3, 0], 0.25)] {
            let found = function(middle, monomial::<15>(exponents, Ball::new(0.0, 0.01))).mean_of_positive_part();
            let ([lo, hi], _) = positive_part::mean_of_curved(&curvature, 0.01 * on_average);
            assert!(found.lo <= lo && found.hi >= hi && found.width() < 1.001 * (hi - lo), "{exponents:?}: {found:?}");
        }
        let straight = monomial::<6>([1, 0, 0], exactly(0.5)) + monomial([0, 1, 0], exactly(0.25));
        let exact = function(straight, Series::<15>::constant(exactly(0.0))).mean_of_positive_part();
        assert!(exact.width() < 1e-13, "{exact:?}");
    }

    #[test]
    fn sums_and_differences_of_bounds_contain_those_of_the_ends() {
        let [one, other] = [[1.0, 2.0], [0.5, 0.75]].map(|[lo, hi]| Bounds { lo, hi, by: [1.0; MOST_DIRECTIONS] });
        for (sign, [lo, hi]) in [(1.0, [1.5, 2.75]), (-1.0, [0.25, 1.5])] {
            let found = one.plus(sign, other);
            assert!(found.lo < lo && hi < found.hi && found.width() < hi - lo + 1e-14, "{sign}: {found:?}");
            assert_eq!(found.by, [2.0; MOST_DIRECTIONS]);
        }
    }

    /// Coefficients that are known to be within balls add to what a function is off, by the means of their terms.
    #[test]
    fn a_positive_part_allows_for_unknown_coefficients() {
        let slopes = |one: Ball<f64>, other: Ball<f64>| monomial::<6>([1, 0, 0], one) + monomial([0, 1, 0], other);
        let middle = slopes(Ball::new(0.5, 0.01), Ball::new(0.25, 0.02))
            + Series::constant(Ball::new(0.125, 0.03))
            + monomial([1, 1, 0], Ball::new(0.0, 0.04));
        let found = function(middle, Series::<15>::constant(exactly(0.0))).mean_of_positive_part();
        let straight = Curved { constant: 0.125, slopes: [0.5, 0.25, 0.0], ..Curved::default() };
        let ([lo, hi], _) = positive_part::mean_of_curved(&straight, 0.005 + 0.01 + 0.03 + 0.01);
        assert!(found.lo <= lo && found.hi >= hi && found.width() < 1.001 * (hi - lo), "{found:?}");
        for unknown in [Ball::new(0.5, f64::INFINITY), Ball::new(f64::INFINITY, 0.0)] {
            let found = Function::<6, 15>::constant(unknown).mean_of_positive_part();
            assert_eq!((found.lo, found.hi), (0.0, f64::INFINITY), "{unknown:?}");
        }
    }

    /// A function that is known to be within a ball about the middle, and its slopes, is within the sum.
    #[test]
    fn values_are_within_the_slopes_of_the_middle() {
        let wide = Series::<6>::variable(Ball::new(2.0, 10.0), Ball::new(0.0, 0.5), 1);
        let found = function(Series::<6>::constant(Ball::new(2.0, 0.25)), wide).narrowed();
        assert_eq!(*found.values().midpoint(), 2.0);
        assert!((0.75..0.75 + 1e-12).contains(&found.values().radius()), "{:?}", found.values());
    }
}
