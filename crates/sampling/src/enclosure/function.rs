//! The arithmetic of the bounds of a mean: a function as a pair of series, one about the middle of a cell and one over the whole of
//! it, and bounds of its mean and of that of its positive part.

use numerics::positive_part::{self, Power};
use numerics::{Ball, Elementary, Jet};

use super::cell::MOST_DIRECTIONS;

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
        Self { lo: lower(ball), hi: upper(ball), by }
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

/// A function about the middle of a cell, and over the whole of it.
#[derive(Clone, Copy)]
pub(super) struct Function<const T: usize> {
    pub(super) middle: Jet<Ball<f64>, T>,
    pub(super) whole: Jet<Ball<f64>, T>,
}

impl<const T: usize> Function<T> {
    pub(super) fn map(self, apply: impl Fn(Jet<Ball<f64>, T>) -> Jet<Ball<f64>, T>) -> Self {
        Self { middle: apply(self.middle), whole: apply(self.whole) }
    }

    pub(super) fn with(
        self,
        other: Self,
        apply: impl Fn(Jet<Ball<f64>, T>, Jet<Ball<f64>, T>) -> Jet<Ball<f64>, T>,
    ) -> Self {
        Self { middle: apply(self.middle, other.middle), whole: apply(self.whole, other.whole) }
    }

    pub(super) fn times(self, other: Self) -> Self {
        self.with(other, |one, other| one * other)
    }

    pub(super) fn plus(self, other: Self) -> Self {
        self.with(other, |one, other| one + other)
    }

    pub(super) fn minus(self, other: Self) -> Self {
        self.with(other, |one, other| one - other)
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        self.map(|jet| jet.scaled(&exactly(factor)))
    }

    /// The same function, whose values over the cell are bounded by the mean value theorem where that is narrower.
    pub(super) fn narrowed(mut self) -> Self {
        let value = self.middle.value();
        let reach =
            self.whole.slopes().iter().map(magnitude).fold(value.radius(), |sum, slope| (sum + slope).next_up());
        if reach < self.whole.value().radius() {
            self.whole = self.whole.with_constant(Ball::new(*value.midpoint(), reach));
        }
        self
    }

    /// The values over the cell.
    pub(super) fn values(&self) -> &Ball<f64> {
        self.whole.value()
    }

    /// The sign over the whole cell.
    pub(super) fn sign(&self) -> Option<f64> {
        self.values().has_known_sign().then(|| self.values().sign())
    }

    /// The largest absolute values of the slopes.
    pub(super) fn variation(&self) -> [f64; MOST_DIRECTIONS] {
        let mut by = [0.0; MOST_DIRECTIONS];
        for (by, slope) in by.iter_mut().zip(self.whole.slopes()) {
            *by = magnitude(slope);
        }
        by
    }

    /// Bounds of the mean over the cell: the terms of even degree about the middle have means, and the last terms are
    /// known over the whole cell as far as their balls tell.
    pub(super) fn mean(&self) -> Bounds {
        mean(&self.middle, &self.whole)
    }

    /// Bounds of the mean of the positive part to `power`.
    pub(super) fn mean_of_positive_part(&self, power: Power) -> Bounds {
        let (value, slopes) = (self.middle.value(), self.middle.slopes());
        let (mut by, mut off) = ([0.0; MOST_DIRECTIONS], value.radius());
        for slope in slopes {
            off = (off + slope.radius()).next_up();
        }
        for (exponents, term) in self.whole.terms().filter(|(exponents, _)| exponents.iter().sum::<u8>() == 2) {
            // The mean of |t_i t_j|, or its largest value.
            let moment = if power == Power::One { moment(exponents) } else { 1.0 };
            let part = magnitude(term) * moment;
            off = (off + part.next_up()).next_up();
            for (by, exponent) in by.iter_mut().zip(exponents) {
                *by += 0.5 * part * f64::from(*exponent);
            }
        }
        let mut middles = [0.0; MOST_DIRECTIONS];
        for (middle, slope) in middles.iter_mut().zip(slopes) {
            *middle = *slope.midpoint();
        }
        if !(off.is_finite() && value.midpoint().is_finite()) {
            return Bounds { lo: 0.0, hi: f64::INFINITY, by: self.variation() };
        }
        let [lo, hi] = positive_part::mean(*value.midpoint(), &middles[..slopes.len()], off, power);
        Bounds { lo, hi, by }
    }
}

/// The mean of |t^exponents| over the box from -1 to 1.
fn moment(exponents: &[u8; 3]) -> f64 {
    exponents.iter().map(|exponent| 1.0 / (1.0 + f64::from(*exponent))).product()
}

/// Whether there may be a number in both.
pub(super) fn meet(one: &Ball<f64>, other: &Ball<f64>) -> bool {
    let (apart, reach) = ((one.midpoint() - other.midpoint()).abs(), one.radius() + other.radius());
    // Nothing is said of what is not a number.
    apart.partial_cmp(&(reach * (1.0 + 1e-9))) != Some(std::cmp::Ordering::Greater)
}

/// Bounds of the mean of a function from its series about the middle, of order 2, and one over the whole cell.
pub(super) fn mean<const T: usize, const F: usize>(middle: &Jet<Ball<f64>, T>, whole: &Jet<Ball<f64>, F>) -> Bounds {
    let order = Jet::<Ball<f64>, F>::ORDER;
    let degree = |exponents: &[u8; 3]| exponents.iter().map(|exponent| usize::from(*exponent)).sum::<usize>();
    let is_even = |exponents: &[u8; 3]| exponents.iter().all(|exponent| exponent % 2 == 0);
    let mut sum = *middle.value();
    for (exponents, term) in middle.terms().filter(|(exponents, _)| degree(exponents) == 2 && order > 2) {
        if is_even(exponents) {
            sum = sum + *term * Ball::new(moment(exponents), f64::EPSILON);
        }
    }
    let mut by = [0.0; MOST_DIRECTIONS];
    for (exponents, term) in whole.terms().filter(|(exponents, _)| degree(exponents) == order) {
        let moment = moment(exponents);
        if is_even(exponents) {
            sum = sum + exactly(*term.midpoint()) * Ball::new(moment, f64::EPSILON);
        }
        let part = term.radius() * moment * (1.0 + 4.0 * f64::EPSILON);
        sum = sum.widened(part);
        for (by, exponent) in by.iter_mut().zip(exponents) {
            *by += part * f64::from(*exponent) / f64::from(u32::try_from(order).unwrap_or(4));
        }
    }
    Bounds::of_ball(&sum, by)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial<const T: usize>(exponents: [i32; 2], factor: Ball<f64>) -> Jet<Ball<f64>, T> {
        let [one, other] = [0, 1].map(|index| Jet::variable(exactly(0.0), exactly(1.0), index));
        let power = |variable: Jet<Ball<f64>, T>, exponent| {
            (0..exponent).fold(Jet::constant(exactly(1.0)), |all, _| all * variable)
        };
        (power(one, exponents[0]) * power(other, exponents[1])).scaled(&factor)
    }

    /// A coefficient of a last term may have the sign of the term everywhere, so that its mean is that of the absolute value.
    #[test]
    fn a_last_term_of_any_sign_is_within_the_mean_of_its_absolute_value() {
        fn reaches<const F: usize>(exponents: [i32; 2], expected: f64) {
            let unknown = monomial::<F>(exponents, Ball::new(0.0, 1.0));
            let found = mean(&Jet::<_, 6>::constant(exactly(0.0)), &unknown);
            let [least, most] = [-found.lo, found.hi];
            for reach in [least, most] {
                assert!(reach >= expected && reach < expected * (1.0 + 1e-12), "{exponents:?}: {found:?}");
            }
            // Each direction adds to it as its exponent says.
            for (by, exponent) in found.by.iter().zip(exponents) {
                let part = expected * f64::from(exponent) / f64::from(exponents.iter().sum::<i32>());
                assert!((by - part).abs() < 1e-12, "{exponents:?}: {found:?}");
            }
            // With room for the roundings of two products.
            let radius: f64 = unknown.terms().map(|(_, term)| term.radius()).sum();
            let room = found.by.iter().sum::<f64>() / (expected * radius) - 1.0;
            assert!((2.0 * f64::EPSILON..8.0 * f64::EPSILON).contains(&room), "{exponents:?}: {room:e}");
            // A known one has a mean of its own.
            let known = mean(&Jet::<_, 6>::constant(exactly(0.0)), &monomial::<F>(exponents, exactly(1.0)));
            let own = if exponents.iter().all(|exponent| exponent % 2 == 0) { expected } else { 0.0 };
            assert!((known.lo - own).abs() < 1e-14 && (known.hi - own).abs() < 1e-14, "{exponents:?}: {known:?}");
        }
        reaches::<6>([2, 0], 1.0 / 3.0);
        reaches::<6>([1, 1], 1.0 / 4.0);
        reaches::<15>([4, 0], 1.0 / 5.0);
        reaches::<15>([3, 1], 1.0 / 8.0);
        reaches::<15>([2, 2], 1.0 / 9.0);
    }

    /// Terms of even exponents have a mean, in series of four orders those of the second order too.
    #[test]
    fn the_mean_of_a_polynomial_is_that_of_its_even_terms() {
        let middle = Jet::<_, 6>::constant(exactly(2.0))
            + monomial([1, 0], exactly(7.0))
            + monomial([2, 0], exactly(3.0))
            + monomial([1, 1], exactly(5.0))
            + monomial([0, 2], exactly(0.5));
        let found = mean(&middle, &monomial::<15>([2, 2], exactly(9.0)));
        let expected = 2.0 + 3.0 / 3.0 + 0.5 / 3.0 + 9.0 / 9.0;
        assert!(found.lo <= expected && expected <= found.hi && found.width() < 1e-13, "{found:?}");
    }
    #[test]
    fn a_positive_part_allows_for_all_second_derivatives() {
        for (exponents, on_average) in [([2, 0], 1.0 / 3.0), ([1, 1], 1.0 / 4.0), ([0, 2], 1.0 / 3.0)] {
            let linear = monomial::<6>([1, 0], exactly(0.5)) + monomial::<6>([0, 1], exactly(0.25));
            let function = Function { middle: linear, whole: linear + monomial(exponents, Ball::new(0.0, 0.01)) };
            let exact = Function { middle: linear, whole: linear };
            for (power, off) in [(Power::One, 0.01 * on_average), (Power::Half, 0.01), (Power::Zero, 0.01)] {
                let found = function.mean_of_positive_part(power);
                let [lo, hi] = positive_part::mean(0.0, &[0.5, 0.25], off, power);
                assert!(
                    found.lo <= lo && found.hi >= hi && found.width() < 1.001 * (hi - lo),
                    "{power:?} {exponents:?}"
                );
                assert!(exact.mean_of_positive_part(power).width() < 1e-14);
            }
        }
    }

    #[test]
    fn balls_meet_unless_they_are_known_to_be_apart() {
        for (one, other, expected) in [(0.25, 0.5, false), (0.5, 0.5, true), (1.0, 0.25, true), (f64::NAN, 0.0, true)] {
            assert_eq!(meet(&Ball::new(-1.0, one), &Ball::new(0.0, other)), expected, "{one} {other}");
            assert_eq!(meet(&Ball::new(0.0, other), &Ball::new(-1.0, one)), expected, "{one} {other}");
        }
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

    /// Slopes that are known to be within balls add to what a function is off, and so does the value.
    #[test]
    fn a_positive_part_allows_for_unknown_slopes() {
        let slopes = |one: Ball<f64>, other: Ball<f64>| monomial::<6>([1, 0], one) + monomial([0, 1], other);
        let middle = slopes(Ball::new(0.5, 0.01), Ball::new(0.25, 0.02)) + Jet::constant(Ball::new(0.125, 0.03));
        let found = Function { middle, whole: slopes(exactly(0.5), exactly(0.25)) }.mean_of_positive_part(Power::One);
        let [lo, hi] = positive_part::mean(0.125, &[0.5, 0.25], 0.06, Power::One);
        assert!(found.lo <= lo && found.hi >= hi && found.width() < 1.001 * (hi - lo), "{found:?}");
        for unknown in [Ball::new(0.5, f64::INFINITY), Ball::new(f64::INFINITY, 0.0)] {
            let function = Function { middle: Jet::<_, 6>::constant(unknown), whole: Jet::constant(unknown) };
            let found = function.mean_of_positive_part(Power::One);
            assert_eq!((found.lo, found.hi), (0.0, f64::INFINITY), "{unknown:?}");
        }
    }

    /// A function that is known to be within a ball about the middle, and its slopes, is within the sum.
    #[test]
    fn values_are_within_the_slopes_of_the_middle() {
        let wide = |value: f64| Jet::<_, 6>::variable(Ball::new(value, 10.0), Ball::new(0.0, 0.5), 1);
        let function = Function { middle: Jet::constant(Ball::new(2.0, 0.25)), whole: wide(2.0) }.narrowed();
        assert_eq!(*function.values().midpoint(), 2.0);
        assert!((0.75..0.75 + 1e-12).contains(&function.values().radius()), "{:?}", function.values());
    }
}
