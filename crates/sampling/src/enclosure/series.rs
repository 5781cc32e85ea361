//! Truncated Taylor series in one to three variables, whose coefficients are balls of f64. A formula evaluated in them gives its
//! own partial derivatives; over balls that contain a whole box it bounds the derivatives within the box.
//!
//! The rules are those of [`numerics::Ball`]. Midpoints and radii are kept apart, and the roundings of all products in a term are
//! bounded at once: n products and n - 1 sums of them are right to n u times the sum of their sizes.

use std::ops::{Add, Mul, Neg, Sub};

use numerics::{Ball, Elementary};

use super::function::exactly;

/// The largest number of variables.
const MOST_VARIABLES: usize = 3;

/// The exponents of the variables in one term.
pub(super) type Exponents = [u8; MOST_VARIABLES];

/// The largest number of products of two terms, neither of which is the constant one, that are kept in a product of series.
const MOST_PRODUCTS: usize = 45;

/// More than underflow can take away from a term.
const TINY: f64 = f64::MIN_POSITIVE;

/// More than the roundings of a radius, relative to it: at most 60 of 2^-53.
const ENLARGED: f64 = 1.0 + 32.0 * f64::EPSILON;

/// A Taylor series with `T` terms: 3 or 5 of the order 2 or 4 in one variable, 6 or 15 in two, and 10 or 20 of the order 2 or 3
/// in three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Series<const T: usize> {
    middles: [f64; T],
    radii: [f64; T],
}

/// The number of variables and the order of a series with this many terms.
const fn shape(terms: usize) -> (usize, usize) {
    match terms {
        3 => (1, 2),
        5 => (1, 4),
        6 => (2, 2),
        15 => (2, 4),
        10 => (3, 2),
        20 => (3, 3),
        _ => panic!("a series has 3, 5, 6, 10, 15 or 20 terms"),
    }
}

/// The exponents of all terms, by ascending degree: first the constant, then the variables.
const fn exponents<const T: usize>() -> [Exponents; T] {
    let (variables, order) = shape(T);
    let mut all = [[0; MOST_VARIABLES]; T];
    let (mut next, mut of_degree) = (0, 0);
    while of_degree <= order {
        let mut first = of_degree + 1;
        while first > 0 {
            first -= 1;
            let mut second = of_degree - first + 1;
            while second > 0 {
                second -= 1;
                let third = of_degree - first - second;
                if (variables > 1 || second == 0) && (variables > 2 || third == 0) {
                    all[next] = [first as u8, second as u8, third as u8];
                    next += 1;
                }
            }
        }
        of_degree += 1;
    }
    assert!(next == T);
    all
}

const fn degree(exponents: Exponents) -> u8 {
    exponents[0] + exponents[1] + exponents[2]
}

/// The term with these exponents, or `T`.
const fn place<const T: usize>(wanted: Exponents) -> usize {
    let all = exponents::<T>();
    let mut index = 0;
    while index < T {
        let of = all[index];
        if of[0] == wanted[0] && of[1] == wanted[1] && of[2] == wanted[2] {
            return index;
        }
        index += 1;
    }
    T
}

/// Products of two terms, neither of which is the constant one.
struct Products {
    /// Of the term in the first place, the factors in the others.
    all: [[u8; 3]; MOST_PRODUCTS],
    number: usize,
}

const fn products<const T: usize>() -> Products {
    let all = exponents::<T>();
    let mut found = Products { all: [[0; 3]; MOST_PRODUCTS], number: 0 };
    let mut one = 1;
    while one < T {
        let mut other = 1;
        while other < T {
            let (a, b) = (all[one], all[other]);
            let target = place::<T>([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
            if target < T {
                found.all[found.number] = [target as u8, one as u8, other as u8];
                found.number += 1;
            }
            other += 1;
        }
        one += 1;
    }
    found
}

/// The factors of a product: midpoints, their sizes, and radii.
struct Factor<const T: usize> {
    middles: [f64; T],
    sizes: [f64; T],
    radii: [f64; T],
}

/// The radius of a ball, infinite if nothing is known.
#[inline]
fn known(middle: f64, radius: f64) -> f64 {
    if middle.is_finite() && !radius.is_nan() { radius } else { f64::INFINITY }
}

impl<const T: usize> Series<T> {
    /// The number of variables.
    pub(super) const VARIABLES: usize = shape(T).0;
    /// The degree of the last terms.
    pub(super) const ORDER: usize = shape(T).1;
    pub(super) const EXPONENTS: [Exponents; T] = exponents::<T>();
    const DEGREES: [f64; T] = {
        let mut degrees = [0.0; T];
        let mut index = 0;
        while index < T {
            degrees[index] = degree(Self::EXPONENTS[index]) as f64;
            index += 1;
        }
        degrees
    };
    const PRODUCTS: Products = products::<T>();
    /// Bounds the rounding of a term of a product, in parts of the sum of the sizes: (n + 1) u for n products.
    const ROUNDING: f64 = {
        let (mut most, mut index) = (0, 0);
        while index < T {
            let [a, b, c] = Self::EXPONENTS[index];
            let number = (a as u32 + 1) * (b as u32 + 1) * (c as u32 + 1);
            if number > most {
                most = number;
            }
            index += 1;
        }
        (most + 1) as f64 * 0.5 * f64::EPSILON
    };

    /// A number that depends on no variable.
    #[inline]
    pub(super) fn constant(value: Ball<f64>) -> Self {
        let mut series = Self { middles: [0.0; T], radii: [0.0; T] };
        series.set(0, value);
        series
    }

    /// The number `value` + `slope` × variable number `index`.
    pub(super) fn variable(value: Ball<f64>, slope: Ball<f64>, index: usize) -> Self {
        let mut series = Self::constant(value);
        series.set(1 + index, slope);
        series
    }

    /// A series in one variable, of the order 4, as one in variable number `index`.
    pub(super) fn in_variable(series: &Series<5>, index: usize) -> Self {
        let mut found = Self::constant(series.value());
        if series.is_constant() {
            return found;
        }
        let mut exponents = [0; MOST_VARIABLES];
        for power in 1..=Self::ORDER {
            exponents[index] += 1;
            found.set(place::<T>(exponents), series.term(power));
        }
        found
    }

    /// The first terms, of a lower order.
    pub(super) fn truncated<const U: usize>(&self) -> Series<U> {
        debug_assert!(Series::<U>::VARIABLES == Self::VARIABLES && U <= T);
        let first = |from: &[f64; T]| std::array::from_fn(|index| from[index]);
        Series { middles: first(&self.middles), radii: first(&self.radii) }
    }

    /// Term number `index`.
    #[inline]
    pub(super) fn term(&self, index: usize) -> Ball<f64> {
        Ball::new(self.middles[index], self.radii[index])
    }

    /// The terms of one degree, with the exponents of their variables.
    pub(super) fn of_degree(&self, wanted: usize) -> impl Iterator<Item = (&Exponents, Ball<f64>)> {
        let is_wanted = move |of: &Exponents| usize::from(degree(*of)) == wanted;
        Self::EXPONENTS
            .iter()
            .enumerate()
            .filter(move |(_, of)| is_wanted(of))
            .map(|(index, of)| (of, self.term(index)))
    }

    #[inline]
    pub(super) fn set(&mut self, index: usize, value: Ball<f64>) {
        self.middles[index] = *value.midpoint();
        self.radii[index] = known(*value.midpoint(), value.radius());
    }

    /// The constant term.
    pub(super) fn value(&self) -> Ball<f64> {
        self.term(0)
    }

    /// The same series with another constant term.
    #[inline]
    pub(super) fn with_constant(mut self, value: Ball<f64>) -> Self {
        self.set(0, value);
        self
    }

    /// Whether it depends on no variable.
    #[inline]
    fn is_constant(&self) -> bool {
        self.middles[1..].iter().chain(&self.radii[1..]).all(|part| *part == 0.0)
    }

    /// A result from midpoints and the bounds of what they are off. Nothing is known of a midpoint that left the range of f64.
    #[inline]
    fn enlarged(middles: [f64; T], errors: [f64; T]) -> Self {
        let mut radii = errors;
        for (radius, middle) in radii.iter_mut().zip(&middles) {
            *radius = known(*middle, *radius * ENLARGED + TINY);
        }
        Self { middles, radii }
    }

    /// Every term times `factor`. What is exactly 0 stays so, whatever the factor is.
    #[inline]
    pub(super) fn scaled(&self, factor: &Ball<f64>) -> Self {
        let (by, off) = (*factor.midpoint(), factor.radius());
        let (near, far) = (off + f64::EPSILON * by.abs(), by.abs() + off);
        let (mut middles, mut radii) = (self.middles, self.radii);
        for (middle, radius) in middles.iter_mut().zip(&mut radii) {
            let is_zero = *middle == 0.0 && *radius == 0.0;
            let product = *middle * by;
            let error = (middle.abs() * near + *radius * far) * ENLARGED + TINY;
            *middle = if is_zero { 0.0 } else { product };
            *radius = if is_zero { 0.0 } else { known(product, error) };
        }
        Self { middles, radii }
    }

    /// Adds the products of terms of which none is the constant one.
    #[inline]
    fn add_products(middles: &mut [f64; T], errors: &mut [f64; T], one: &Self, other: &Factor<T>) {
        for [target, i, j] in &Self::PRODUCTS.all[..Self::PRODUCTS.number] {
            let (target, i, j) = (usize::from(*target), usize::from(*i), usize::from(*j));
            middles[target] += one.middles[i] * other.middles[j];
            errors[target] += one.middles[i].abs() * other.radii[j] + one.radii[i] * other.sizes[j];
        }
    }

    /// As the second factor of a product: the radii with the roundings, and the largest absolute values.
    #[inline]
    fn factor(&self) -> Factor<T> {
        let (mut radii, mut sizes) = (self.radii, self.radii);
        for index in 0..T {
            radii[index] += Self::ROUNDING * self.middles[index].abs();
            sizes[index] += self.middles[index].abs();
        }
        Factor { middles: self.middles, sizes, radii }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        if other.is_constant() {
            return self.scaled(&other.value());
        }
        if self.is_constant() {
            return other.scaled(&self.value());
        }
        let factor = other.factor();
        let (mut middles, mut errors) = ([0.0; T], [0.0; T]);
        let (first, off) = (self.middles[0], self.radii[0]);
        for term in 0..T {
            middles[term] = first * factor.middles[term];
            errors[term] = first.abs() * factor.radii[term] + off * factor.sizes[term];
        }
        for term in 1..T {
            middles[term] += self.middles[term] * factor.middles[0];
            errors[term] += self.middles[term].abs() * factor.radii[0] + self.radii[term] * factor.sizes[0];
        }
        Self::add_products(&mut middles, &mut errors, self, &factor);
        Self::enlarged(middles, errors)
    }

    /// The function of this number with these Taylor coefficients at the constant term, by Horner's rule.
    pub(super) fn composed(&self, coefficients: &[Ball<f64>; 5]) -> Self {
        // A constant keeps no derivative of the function, which may be infinite.
        if self.is_constant() {
            return Self::constant(coefficients[0]);
        }
        let variable_part = self.with_constant(exactly(0.0));
        let factor = variable_part.factor();
        let mut sum = variable_part.scaled(&coefficients[Self::ORDER]);
        for coefficient in coefficients[1..Self::ORDER].iter().rev() {
            let (mut middles, mut errors) = ([0.0; T], [0.0; T]);
            Self::add_products(&mut middles, &mut errors, &sum, &factor);
            sum = Self::enlarged(middles, errors).plus(&variable_part.scaled(coefficient));
        }
        sum.with_constant(coefficients[0])
    }

    /// The power -1, -½ or ½ of a number, whose value is `first`.
    fn power(&self, first: Ball<f64>, power: f64) -> Self {
        let inverse = exactly(1.0) / self.value();
        let mut coefficients = [first; 5];
        for index in 1..=Self::ORDER {
            let factor = (power + 1.0 - index as f64) / index as f64;
            coefficients[index] = coefficients[index - 1] * inverse * Ball::new(factor, f64::EPSILON);
        }
        self.composed(&coefficients)
    }

    /// 1 over this number.
    pub(super) fn reciprocal(&self) -> Self {
        self.power(exactly(1.0) / self.value(), -1.0)
    }

    pub(super) fn sqrt(&self) -> Self {
        self.power(self.value().sqrt(), 0.5)
    }

    /// 1 over the square root.
    pub(super) fn inverse_root(&self) -> Self {
        self.power(exactly(1.0) / self.value().sqrt(), -0.5)
    }

    pub(super) fn exp(&self) -> Self {
        let power = self.value().exp();
        self.composed(&[1.0, 1.0, 2.0, 6.0, 24.0].map(|factorial| power / exactly(factorial)))
    }

    pub(super) fn sine_and_cosine(&self) -> [Self; 2] {
        let [sin, cos] = self.value().sine_and_cosine();
        let of = |value: Ball<f64>, slope: Ball<f64>| {
            let over = |part: Ball<f64>, divisor: f64| part / exactly(divisor);
            [value, slope, over(-value, 2.0), over(-slope, 6.0), over(value, 24.0)]
        };
        [of(sin, cos), of(cos, -sin)].map(|coefficients| self.composed(&coefficients))
    }

    /// Each term times its degree: Σ t ∂/∂t, the derivative along the rays from the constant term.
    #[inline]
    pub(super) fn along_rays(mut self) -> Self {
        for (index, degree) in Self::DEGREES.iter().enumerate() {
            self.middles[index] *= degree;
            self.radii[index] = (self.radii[index] * degree + f64::EPSILON * self.middles[index].abs()) * ENLARGED;
        }
        self
    }

    /// The number of this value whose derivative along the rays is this one.
    #[inline]
    pub(super) fn integrated_along_rays(self, value: Ball<f64>) -> Self {
        let (mut middles, mut errors) = (self.middles, self.radii);
        for index in 1..T {
            middles[index] /= Self::DEGREES[index];
            errors[index] = errors[index] / Self::DEGREES[index] + f64::EPSILON * middles[index].abs();
        }
        Self::enlarged(middles, errors).with_constant(value)
    }

    /// The angle of the point (`x`, `self`), continuous also across the cut at ±π: its derivative along the rays is that of the
    /// angle, (x y' - y x')/(x² + y²), with the inverse of the square of the radius, `inverse`.
    pub(super) fn angle(&self, x: &Self, inverse: &Self) -> Self {
        let turned = x.times(&self.along_rays()).minus(&self.times(&x.along_rays()));
        turned.times(inverse).integrated_along_rays(self.value().atan2(&x.value()))
    }

    /// The angle of the point (`x`, `self`).
    pub(super) fn atan2(&self, x: &Self) -> Self {
        if self.is_constant() && x.is_constant() {
            return Self::constant(self.value().atan2(&x.value()));
        }
        self.angle(x, &x.times(x).plus(&self.times(self)).reciprocal())
    }

    #[inline]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for index in 0..T {
            let middle = self.middles[index] + other.middles[index];
            // No digit of a sum underflows, so that one of two zeros is exact.
            let error = self.radii[index] + other.radii[index] + f64::EPSILON * middle.abs();
            sum.middles[index] = middle;
            sum.radii[index] = known(middle, error * ENLARGED);
        }
        sum
    }

    #[inline]
    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&-*other)
    }
}

impl<const T: usize> Neg for Series<T> {
    type Output = Self;
    fn neg(mut self) -> Self {
        for middle in &mut self.middles {
            *middle = -*middle;
        }
        self
    }
}

impl<const T: usize> Add for Series<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(&other)
    }
}

impl<const T: usize> Sub for Series<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.minus(&other)
    }
}

impl<const T: usize> Mul for Series<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.times(&other)
    }
}

#[cfg(test)]
mod tests {
    use numerics::DoubleDouble;

    use super::*;

    /// A number from -1 to 1.
    fn part(index: usize, square: f64) -> f64 {
        2.0 * (index as f64 * square.sqrt()).fract() - 1.0
    }

    /// A formula with all functions, of up to three variables, at a point and its surroundings.
    fn formula<const T: usize>(at: [f64; 3], slope: f64, radius: f64) -> Series<T> {
        let variable = |index: usize| {
            let value = Ball::new(at[index], if index < Series::<T>::VARIABLES { radius } else { 0.0 });
            if index < Series::<T>::VARIABLES {
                Series::variable(value, exactly(slope), index)
            } else {
                Series::constant(value)
            }
        };
        let [x, y, z] = [0, 1, 2].map(variable);
        let one = Series::constant(exactly(1.0));
        let [sin, cos] = (x + y * z).sine_and_cosine();
        let root = (x * x + y.exp() + one).sqrt();
        let angle = sin.atan2(&(root + cos)) - root.atan2(&(cos - z));
        angle * z.times(&(one + y * y).inverse_root()) - cos * root.reciprocal()
            + (one + one).scaled(&Ball::new(0.3, 0.0))
    }

    /// The same formula at one point.
    fn value(at: [f64; 3]) -> f64 {
        let [x, y, z] = at;
        let (sin, cos) = (x + y * z).sin_cos();
        let root = (x * x + y.exp() + 1.0).sqrt();
        let angle = sin.atan2(root + cos) - root.atan2(cos - z);
        angle * z / (1.0 + y * y).sqrt() - cos / root + 0.6
    }

    fn check<const T: usize>(index: usize) {
        const STEP: f64 = 0.015_625; // 2^-6
        let at = [part(index, 2.0), part(index, 3.0), part(index, 5.0)];
        let exact = formula::<T>(at, STEP, 0.0);
        // The last terms that are left out fall with the power of the step.
        let order = i32::try_from(Series::<T>::ORDER).unwrap();
        let whole = formula::<T>(at, STEP, STEP);
        for number in 0..8 {
            let t: [f64; 3] = std::array::from_fn(|of| {
                if of < Series::<T>::VARIABLES { part(8 * index + number, 7.0 + of as f64) } else { 0.0 }
            });
            let moved: [f64; 3] = std::array::from_fn(|of| at[of] + t[of] * STEP);
            let power =
                |exponents: &Exponents| exponents.iter().zip(t).map(|(of, t)| t.powi((*of).into())).product::<f64>();
            let sum: f64 = Series::<T>::EXPONENTS.iter().zip(exact.middles).map(|(of, term)| term * power(of)).sum();
            let allowed = 300.0 * STEP.powi(order + 1);
            let off = (sum - value(moved)).abs();
            assert!(off < allowed, "{T} {index}: {off:e} > {allowed:e}");
            // The series at any point of a cell is within that over the whole of it.
            let there = formula::<T>(moved, STEP, 0.0);
            for term in 0..T {
                let (off, radius) = ((there.middles[term] - whole.middles[term]).abs(), whole.radii[term]);
                assert!(off <= radius + there.radii[term] && radius < 1.0, "{T} {index} {term}: {off:e} > {radius:e}");
            }
        }
    }

    #[test]
    fn a_series_is_that_of_the_formula_and_one_over_a_cell_contains_those_of_its_points() {
        for index in 1..20 {
            check::<3>(index);
            check::<5>(index);
            check::<6>(index);
            check::<15>(index);
            check::<10>(index);
            check::<20>(index);
        }
    }

    /// Every rounding is in the radius, and not many times more: the terms of products of exact numbers against double-double ones.
    #[test]
    fn the_radius_of_a_product_is_that_of_its_roundings_and_of_its_factors() {
        fn check<const T: usize>(index: usize, radius: f64) {
            let series = |square: f64| Series::<T> {
                middles: std::array::from_fn(|term| part(index + 7 * term, square)),
                radii: [radius; T],
            };
            let (one, other) = (series(2.0), series(3.0));
            let found = one.times(&other);
            for (target, exponents) in Series::<T>::EXPONENTS.iter().enumerate() {
                let (mut exact, mut sizes, mut error) = (DoubleDouble::ZERO, 0.0, 0.0);
                for (i, a) in Series::<T>::EXPONENTS.iter().enumerate() {
                    for (j, b) in Series::<T>::EXPONENTS.iter().enumerate() {
                        if (0..MOST_VARIABLES).all(|of| a[of] + b[of] == exponents[of]) {
                            let [x, y] = [one.middles[i], other.middles[j]];
                            exact = exact + DoubleDouble::from(x) * DoubleDouble::from(y);
                            sizes += (x * y).abs();
                            error += (x.abs() + y.abs()) * radius + radius * radius;
                        }
                    }
                }
                let off = (DoubleDouble::from(found.middles[target]) - exact).hi().abs();
                let room = found.radii[target] - error;
                assert!(off <= room + 1e-15 * error, "{T} {target}: {off:e} > {room:e}");
                assert!(
                    room <= 5.01 * f64::EPSILON * sizes + 1e-14 * error + 1e-300,
                    "{T} {target}: {room:e} of {sizes}"
                );
            }
        }
        for index in 1..20 {
            for radius in [0.0, 0.25] {
                check::<3>(index, radius);
                check::<5>(index, radius);
                check::<6>(index, radius);
                check::<15>(index, radius);
                check::<10>(index, radius);
                check::<20>(index, radius);
            }
        }
    }

    #[test]
    fn what_is_exactly_0_stays_so_and_what_left_the_range_of_f64_is_unknown() {
        let variable = Series::<6>::variable(exactly(2.0), exactly(1.0), 1);
        for unknown in [f64::INFINITY, f64::NAN].map(|radius| Ball::new(0.0, radius)) {
            for found in
                [variable.scaled(&unknown), variable * Series::constant(unknown), Series::constant(unknown) * variable]
            {
                assert!(!found.radii[0].is_finite() && !found.radii[2].is_finite(), "{found:?}");
                assert_eq!([1, 3, 4, 5].map(|term| found.term(term)), [exactly(0.0); 4]);
            }
        }
        // A constant keeps no derivative of a root, which may be infinite.
        assert_eq!(Series::<6>::constant(exactly(0.0)).sqrt(), Series::constant(exactly(0.0).sqrt()));
        let huge = Series::<3>::variable(exactly(1e200), exactly(1e200), 0);
        for found in [huge.times(&huge), huge.scaled(&exactly(1e200)), huge.plus(&huge).scaled(&exactly(1e108))] {
            assert!(found.radii[..2].iter().all(|radius| !radius.is_finite()), "{found:?}");
        }
    }
}
