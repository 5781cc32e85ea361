//! Numbers with a bound of their error: a midpoint and a radius, together a ball that contains the true number. A
//! formula evaluated in balls has a bound that covers every rounding, and so proves what it decides.
//!
//! Sums, products and functions of balls contain the results for all numbers in the balls (F. Johansson, IEEE Trans.
//! Comput. 66 (2017), 1281, describes the technique). Let a, b be the midpoints, r, s the radii, and ε the rounding
//! error of one operation on midpoints. The radius of a result is at least
//!
//! ```text
//! a + b      r + s                                      + ε |a + b|
//! a b        |a| s + |b| r + r s                        + ε |a b|
//! a/b        (r + |a/b| s)/(|b| - s)                    + ε |a/b|     infinite for |b| ≤ s + 2^-1022
//! √a         r/√(a - r), or √(a + r) for a ≤ r          + ε √a
//! e^a        e^a (e^r - 1)                              + ε e^a
//! sin        r                                          + ε min(1, |a|)
//! cos        r                                          + ε
//! atan2      1.5 ((|b| + s) r + (|a| + r) s)/(a² + b²)   + ε |angle|   7 next to the origin; up to a turn at the cut
//! ```
//!
//! ε is 2^-52 for f64, whose operations are right to 2^-53 and whose functions, those of the platform (sine, cosine,
//! exponential and atan2), to less than 2^-52. The radius of an exponential takes the platform's e^r - 1, right to 2^-51.
//! ε is 2^-98 for double-double numbers, whose operations are right to 10 u² = 2^-102.6 and whose functions to 2^-100; and 2^(8-p) for numbers of p digits, which are rounded correctly. Radii are f64. Each is enlarged by some
//! roundings of its own and by 2^-1022, which is more than underflow can take away; so is the r of a quotient or a root.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::big::Big;
use crate::elementary::{Elementary, answered_by};
use crate::number::Number;

/// More than underflow can take away: from a result, and from the remainder by which a double-double quotient or root is
/// corrected. The rounding of a subnormal number takes at most 2^-1075, and no function rounds 2^50 times.
const TINY: f64 = f64::MIN_POSITIVE; // 2^-1022

/// A number that is within `radius` of `midpoint`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<N> {
    midpoint: N,
    radius: f64,
}

impl<N: Elementary> Ball<N> {
    /// The number `midpoint`, right to `radius` ≥ 0; nothing is known if a part of `midpoint` is not finite.
    pub fn new(midpoint: N, radius: f64) -> Self {
        Self::within(midpoint, radius)
    }

    /// The midpoint.
    pub fn midpoint(&self) -> &N {
        &self.midpoint
    }

    /// The largest distance of the true number from the midpoint; infinite or NaN if nothing is known.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether all numbers of the ball have the same sign, and are not 0.
    pub fn has_sign(&self) -> bool {
        self.midpoint.to_f64().abs() > self.radius
    }

    /// |midpoint|, rounded.
    fn distance(&self) -> f64 {
        self.midpoint.to_f64().abs()
    }

    /// |midpoint|, rounded, and not below it where that leaves the range of f64.
    fn size(&self) -> f64 {
        self.distance() + f64::MIN_POSITIVE
    }

    /// A result with the propagated error `error`, and rounding errors for a result of this size. Both are right to seven
    /// roundings, which the last factor covers.
    fn rounded(midpoint: N, error: f64, size: f64) -> Self {
        let rounding = midpoint.rounding();
        Self::within(midpoint, (error + rounding * size) * (1.0 + 8.0 * f64::EPSILON) + TINY)
    }

    /// A ball of this radius, or one about which nothing is known, because a part of its midpoint left the range of f64.
    fn within(midpoint: N, radius: f64) -> Self {
        let radius = if midpoint.is_in_range() { radius } else { f64::INFINITY };
        Self { midpoint, radius }
    }

    /// A ball about which nothing is known.
    fn anything(&self) -> Self {
        Self { midpoint: self.midpoint.like(0.0), radius: f64::INFINITY }
    }

    /// Smallest and largest absolute value; a smallest one below the range of f64 is 0.
    fn sizes(&self) -> [f64; 2] {
        // A difference magnifies the roundings of the distance, of the product and of the first difference.
        let least = self.distance() * (1.0 - 2.0 * f64::EPSILON) - f64::MIN_POSITIVE - self.radius;
        [least.max(0.0), self.size() + self.radius]
    }
}

impl<N: Elementary> Add for Ball<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.midpoint + other.midpoint;
        if self.radius + other.radius == 0.0 && sum.sign() == 0.0 {
            // No digit of a sum underflows, so that a difference of 0 is exact.
            return Self { midpoint: sum, radius: 0.0 };
        }
        let size = sum.to_f64().abs();
        Self::rounded(sum, self.radius + other.radius, size)
    }
}

impl<N: Elementary> Neg for Ball<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { midpoint: -self.midpoint, radius: self.radius }
    }
}

impl<N: Elementary> Sub for Ball<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<N: Elementary> Mul for Ball<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (size, other_size) = (self.size(), other.size());
        let error = size * other.radius + other_size * self.radius + self.radius * other.radius;
        Self::rounded(self.midpoint * other.midpoint, error, size * other_size)
    }
}

impl<N: Elementary> Div for Ball<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let [least, _] = other.sizes();
        if least == 0.0 {
            return self.anything();
        }
        let quotient = self.midpoint / other.midpoint;
        let size = quotient.to_f64().abs();
        let error = (self.radius + size * other.radius + TINY) / least;
        Self::rounded(quotient, error, size)
    }
}

impl<N: Elementary> Number for Ball<N> {
    /// All roundings of a term are added up once: n products and n - 1 sums, none of which is above the sum of the sizes. What
    /// every term has is computed for all at once, in registers.
    #[inline]
    fn product_of_series<const T: usize>(
        one: &[Self; T],
        other: &[Self; T],
        pairs: &[[u8; 2]],
        ends: &[usize],
    ) -> [Self; T] {
        let (mut sizes, mut other_sizes, mut largest) = ([0.0; T], [0.0; T], [0.0; T]);
        for term in 0..T {
            sizes[term] = one[term].size();
            other_sizes[term] = other[term].size();
            largest[term] = other_sizes[term] + other[term].radius;
        }
        let (mut product, mut errors, mut sum_of_sizes) = (other.clone(), [0.0; T], [0.0; T]);
        let zero = one[0].midpoint.like(0.0);
        for term in 0..T {
            product[term].midpoint = zero.clone() + one[0].midpoint.clone() * other[term].midpoint.clone();
            errors[term] = sizes[0] * other[term].radius + one[0].radius * largest[term];
            sum_of_sizes[term] = sizes[0] * other_sizes[term];
        }
        let mut start = 0;
        for (term, end) in (0..T).zip(ends) {
            for [i, j] in &pairs[std::mem::replace(&mut start, *end)..*end] {
                let (i, j) = (usize::from(*i), usize::from(*j));
                product[term].midpoint =
                    product[term].midpoint.clone() + one[i].midpoint.clone() * other[j].midpoint.clone();
                errors[term] += sizes[i] * other[j].radius + one[i].radius * largest[j];
                sum_of_sizes[term] += sizes[i] * other_sizes[j];
            }
        }
        for term in 1..T {
            product[term].midpoint =
                product[term].midpoint.clone() + one[term].midpoint.clone() * other[0].midpoint.clone();
            errors[term] += sizes[term] * other[0].radius + one[term].radius * largest[0];
            sum_of_sizes[term] += sizes[term] * other_sizes[0];
        }
        let mut start = 0;
        for (term, ball) in product.iter_mut().enumerate() {
            let number = ends[term] - std::mem::replace(&mut start, ends[term]) + if term == 0 { 1 } else { 2 };
            #[expect(clippy::cast_precision_loss, reason = "a series has few terms")]
            let operations = 2.0 * number as f64;
            // The sums of errors and sizes have three roundings for each pair.
            let error = errors[term] * (1.0 + 2.0 * operations * f64::EPSILON);
            *ball = Self::rounded(ball.midpoint.clone(), error, operations * sum_of_sizes[term]);
        }
        product
    }
}

impl<N: Elementary> Elementary for Ball<N> {
    fn like(&self, value: f64) -> Self {
        // Exact: no precision has fewer digits than f64.
        Self::within(self.midpoint.like(value), 0.0)
    }

    fn like_big(&self, value: &Big) -> Self {
        let midpoint = self.midpoint.like_big(value);
        let size = midpoint.to_f64().abs();
        Self::rounded(midpoint, 0.0, size)
    }

    answered_by!(self, self.midpoint);

    fn sqrt(&self) -> Self {
        let ([least, largest], root) = (self.sizes(), self.midpoint.sqrt());
        let size = root.to_f64();
        let error = if least > 0.0 { (self.radius + TINY) / least.sqrt() } else { largest.sqrt() };
        Self::rounded(root, error, size)
    }

    fn exp(&self) -> Self {
        let power = self.midpoint.exp();
        let size = power.to_f64();
        Self::rounded(power, (size + f64::MIN_POSITIVE) * self.radius.exp_m1(), size)
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let [sin, cos] = self.midpoint.sine_and_cosine();
        [Self::rounded(sin, self.radius, self.size().min(1.0)), Self::rounded(cos, self.radius, 1.0)]
    }

    fn atan2(&self, x: &Self) -> Self {
        let (distance, error) = (self.distance().hypot(x.distance()) - f64::MIN_POSITIVE, self.radius.hypot(x.radius));
        let angle = self.midpoint.atan2(&x.midpoint);
        let size = angle.to_f64().abs();
        let off = if error == 0.0 {
            0.0
        } else if distance.is_finite() && 8.0 * error < distance {
            let [y_error, x_error] = [self.radius, x.radius].map(|radius| radius / distance);
            1.5 * ((x.size() + x.radius) / distance * y_error + (self.size() + self.radius) / distance * x_error)
        } else {
            // Of NaN, and of a distance that overflows, nothing is known but that it is an angle.
            7.0
        };
        Self::rounded(angle, off, size)
    }

    fn pi(&self) -> Self {
        Self::rounded(self.midpoint.pi(), 0.0, 4.0)
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        if self.radius == 0.0 && self.sign() == 0.0 {
            return self.clone();
        }
        let (midpoint, radius) = (self.midpoint.times_power_of_two(exponent), self.radius.times_power_of_two(exponent));
        Self::within(midpoint, radius + TINY)
    }

    fn error(&self) -> f64 {
        self.radius
    }

    fn widened(self, error: f64) -> Self {
        Self { radius: (self.radius + error) * (1.0 + 2.0 * f64::EPSILON), ..self }
    }
}

mod wide;

pub use wide::WideBall;

#[cfg(test)]
mod tests;
