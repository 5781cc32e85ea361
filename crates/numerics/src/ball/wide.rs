//! Balls whose radius has the range of [`Big`], for numbers of very different sizes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::big::{Big, exactly};
use crate::elementary::{Elementary, answered_by};
use crate::number::Number;

/// Digits of a radius.
const DIGITS: usize = 64;

/// A number that is within a radius of a midpoint, as a [`Ball`](crate::Ball), by the same formulas. Its radius has no
/// smallest size: nothing underflows, and no ball is larger for it. It takes some times longer.
#[derive(Debug, Clone, PartialEq)]
pub struct WideBall {
    midpoint: Big,
    /// `None` if nothing is known.
    radius: Option<Big>,
}

/// A non-negative number as part of a radius, to a relative 2^-63.
fn size(number: &Big) -> Big {
    number.magnitude().with_precision(DIGITS).value()
}

fn part(value: f64) -> Big {
    exactly(value).with_precision(DIGITS).value()
}

/// The propagated error of a product of numbers of these sizes with the radii `r` and `s`.
fn error_of_product([one, two]: [&Big; 2], (r, s): (Big, Big)) -> Big {
    one * &s + two * &r + r * s
}

/// The propagated error of a `quotient` by a number that is at least `least`.
fn error_of_quotient(quotient: &Big, least: &Big, (r, s): (Big, Big)) -> Big {
    (r + size(quotient) * s) / least
}

impl WideBall {
    /// The number `midpoint`, of limited precision, right to `radius` ≥ 0.
    pub fn new(midpoint: Big, radius: &Big) -> Self {
        Self::within(midpoint, Some(size(radius)))
    }

    /// The midpoint.
    pub fn midpoint(&self) -> &Big {
        &self.midpoint
    }

    /// Whether all numbers of the ball have the same sign, and are not 0.
    pub fn has_sign(&self) -> bool {
        self.radius.as_ref().is_some_and(|radius| self.midpoint.magnitude() > *radius)
    }

    /// Whether the radius is at most `part` of the midpoint.
    pub fn is_right_to(&self, part_of_midpoint: f64) -> bool {
        self.radius.as_ref().is_some_and(|radius| *radius <= size(&self.midpoint) * part(part_of_midpoint))
    }

    /// A ball of a radius that is right to some roundings, which the factor covers.
    fn within(midpoint: Big, radius: Option<Big>) -> Self {
        const GROWN: f64 = 1.0 + 8.0 * f64::EPSILON;
        Self { midpoint, radius: radius.map(|radius| radius * part(GROWN)) }
    }

    /// A result with the propagated error `error`, and rounding errors for a result of this size.
    fn rounded(midpoint: Big, error: Option<Big>, of_size: &Big) -> Self {
        let rounding = (size(of_size) << 8) >> midpoint.precision().cast_signed();
        Self::within(midpoint, error.map(|error| error + rounding))
    }

    fn anything(&self) -> Self {
        Self { midpoint: self.midpoint.like(0.0), radius: None }
    }

    /// Smallest and largest absolute value. The smallest is not positive if the ball may contain 0.
    fn sizes(&self) -> Option<[Big; 2]> {
        let (radius, middle) = (self.radius.as_ref()?, size(&self.midpoint));
        let least = &middle * part(1.0 - 8.0 * f64::EPSILON) - radius;
        Some([least, middle + radius])
    }

    /// Whether the midpoint is exact.
    fn is_exact(&self) -> bool {
        self.radius.as_ref().is_some_and(|radius| *radius == Big::ZERO)
    }
}

impl Add for WideBall {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let is_exact = self.is_exact() && other.is_exact();
        let sum = self.midpoint + other.midpoint;
        if is_exact && sum == Big::ZERO {
            return Self { midpoint: sum, radius: Some(part(0.0)) };
        }
        let error = self.radius.zip(other.radius).map(|(one, two)| one + two);
        let of_size = sum.clone();
        Self::rounded(sum, error, &of_size)
    }
}

impl Neg for WideBall {
    type Output = Self;
    fn neg(self) -> Self {
        Self { midpoint: -self.midpoint, ..self }
    }
}

impl Sub for WideBall {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for WideBall {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let [one, two] = [&self.midpoint, &other.midpoint].map(size);
        let error = self.radius.zip(other.radius).map(|radii| error_of_product([&one, &two], radii));
        let product = self.midpoint * other.midpoint;
        let of_size = product.clone();
        Self::rounded(product, error, &of_size)
    }
}

impl Div for WideBall {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let Some([least, _]) = other.sizes().filter(|[least, _]| *least > Big::ZERO) else { return self.anything() };
        let quotient = self.midpoint / other.midpoint;
        let of_size = quotient.clone();
        let error = self.radius.zip(other.radius).map(|radii| error_of_quotient(&quotient, &least, radii));
        Self::rounded(quotient, error, &of_size)
    }
}

impl Number for WideBall {}

impl Elementary for WideBall {
    fn like(&self, value: f64) -> Self {
        Self { midpoint: self.midpoint.like(value), radius: Some(part(0.0)) }
    }

    fn like_big(&self, value: &Big) -> Self {
        let midpoint = self.midpoint.like_big(value);
        if midpoint == *value {
            return Self { midpoint, radius: Some(part(0.0)) };
        }
        Self::rounded(midpoint, Some(part(0.0)), value)
    }

    answered_by!(self, self.midpoint);

    fn sqrt(&self) -> Self {
        let root = Elementary::sqrt(&self.midpoint);
        let error = self.sizes().zip(self.radius.as_ref()).map(|([least, largest], radius)| {
            if least > Big::ZERO { radius / Big::sqrt(&least) } else { Elementary::sqrt(&largest) }
        });
        let of_size = root.clone();
        Self::rounded(root, error, &of_size)
    }

    fn exp(&self) -> Self {
        let power = Elementary::exp(&self.midpoint);
        // e^r - 1 ≤ r + r² for r ≤ 1.
        let grown = self.radius.as_ref().and_then(|radius| {
            if *radius <= part(1.0) {
                return Some(radius + radius * radius);
            }
            Some(Elementary::to_f64(radius).exp_m1()).filter(|grown| grown.is_finite()).map(part)
        });
        let of_size = power.clone();
        Self::rounded(power, grown.map(|grown| grown * size(&of_size)), &of_size)
    }

    fn sine_and_cosine(&self) -> [Self; 2] {
        let [sin, cos] = self.midpoint.sine_and_cosine();
        let error = self.radius.clone();
        let [one, middle] = [part(1.0), size(&self.midpoint)];
        let of_sine = middle.min(one.clone());
        [Self::rounded(sin, error.clone(), &of_sine), Self::rounded(cos, error, &one)]
    }

    fn atan2(&self, x: &Self) -> Self {
        let angle = Elementary::atan2(&self.midpoint, &x.midpoint);
        let of_size = angle.clone();
        let [y_size, x_size] = [&self.midpoint, &x.midpoint].map(size);
        let off = self.radius.as_ref().zip(x.radius.as_ref()).map(|(r, s)| {
            let error = r + s;
            let squared = &y_size * &y_size + &x_size * &x_size;
            match () {
                () if error == Big::ZERO => error,
                () if part(64.0) * &error * error < squared => {
                    part(1.5) * ((x_size + s) * r + (y_size + r) * s) / squared
                }
                () => part(7.0),
            }
        });
        // It is an angle in any case.
        Self::rounded(angle, Some(off.unwrap_or_else(|| part(7.0))), &of_size)
    }

    fn pi(&self) -> Self {
        Self::rounded(self.midpoint.pi(), Some(part(0.0)), &part(4.0))
    }

    fn times_power_of_two(&self, exponent: i32) -> Self {
        let midpoint = self.midpoint.times_power_of_two(exponent);
        Self { midpoint, radius: self.radius.as_ref().map(|radius| radius.times_power_of_two(exponent)) }
    }

    /// Not below the radius, and 0 for an exact number alone.
    fn error(&self) -> f64 {
        let Some(radius) = &self.radius else { return f64::INFINITY };
        let rounded = Elementary::to_f64(radius);
        if *radius == Big::ZERO { 0.0 } else { rounded * (1.0 + 2.0 * f64::EPSILON) + f64::from_bits(1) }
    }

    fn has_known_sign(&self) -> bool {
        self.is_exact() || self.has_sign()
    }

    fn widened(self, error: f64) -> Self {
        let error = Some(error).filter(|error| error.is_finite()).map(part);
        Self::within(self.midpoint, self.radius.zip(error).map(|(radius, error)| radius + error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;

    const MANY: usize = 200;

    fn big(value: f64, digits: usize) -> Big {
        exactly(value).with_precision(digits).value()
    }

    /// Whether the ball contains `exact`.
    fn contains(ball: &WideBall, exact: &Big) -> bool {
        ball.radius.as_ref().is_none_or(|radius| (&ball.midpoint - exact).magnitude() <= *radius)
    }

    /// Balls of all sizes down to 10^-600, each with a number in it that is near its edge.
    fn samples() -> Vec<(WideBall, Big)> {
        let mut samples = vec![(WideBall::new(big(0.0, MANY), &part(0.0)), big(0.0, 900))];
        for exponent in [-2000, -70, 3] {
            for (index, share) in [0.0, 1e-55, 1e-20, 0.3, 0.99, 1.7, 1.7].into_iter().enumerate() {
                for mantissa in [1.618_033_988_749_895, -1.2] {
                    let midpoint = big(mantissa, MANY).times_power_of_two(exponent);
                    let radius = size(&midpoint) * part(share);
                    let sign = if index % 2 == 0 { 0.999 } else { -0.999 };
                    let inside = midpoint.clone().with_precision(900).value() + &radius * part(sign);
                    samples.push((WideBall::new(midpoint, &radius), inside));
                }
            }
        }
        samples
    }

    #[test]
    fn every_result_contains_that_of_every_number_in_its_balls() {
        for (a, exact_a) in samples() {
            assert!(contains(&a.exp(), &Elementary::exp(&exact_a)), "{a:?}");
            let [found, exact] = [a.sine_and_cosine(), exact_a.sine_and_cosine().map(|exact| a.like_big(&exact))];
            assert!((0..2).all(|part| contains(&found[part], &exact[part].midpoint)), "{a:?}");
            if exact_a > Big::ZERO {
                assert!(contains(&a.sqrt(), &Elementary::sqrt(&exact_a)), "{a:?}");
            }
            for (b, exact_b) in samples() {
                let of_two = |one: WideBall, exact: Big| assert!(contains(&one, &exact), "{a:?} {b:?}: {one:?}");
                of_two(a.clone() + b.clone(), &exact_a + &exact_b);
                of_two(a.clone() - b.clone(), &exact_a - &exact_b);
                of_two(a.clone() * b.clone(), &exact_a * &exact_b);
                if exact_b != Big::ZERO {
                    of_two(a.clone() / b.clone(), &exact_a / &exact_b);
                }
                // Across the cut an angle is one but for a turn.
                let (angle, turn) = (Elementary::atan2(&exact_a, &exact_b), Big::pi(900) * exactly(2.0));
                let found = a.atan2(&b);
                assert!(
                    [&angle + &turn, &angle - &turn, angle].iter().any(|angle| contains(&found, angle)),
                    "{a:?} {b:?}"
                );
            }
        }
    }

    /// Within the range of f64, the radii are those of [`Ball`], to the digits that it has.
    #[test]
    fn radii_are_those_of_the_ball_with_a_radius_in_f64() {
        for share in [0.0, 1e-50, 1e-9, 0.04] {
            for (x, y) in [(0.7, -2.1), (3.0, 0.4), (-0.2, -0.6)] {
                let of = |value: f64| {
                    let radius = share * f64::abs(value);
                    (WideBall::new(big(value, MANY), &part(radius)), Ball::new(big(value, MANY), radius))
                };
                let ((a, near_a), (b, near_b)) = (of(x), of(y));
                let [sin, cos] = a.sine_and_cosine();
                let [near_sin, near_cos] = near_a.sine_and_cosine();
                let pairs = [
                    (a.clone() + b.clone(), near_a.clone() + near_b.clone()),
                    (a.clone() * b.clone(), near_a.clone() * near_b.clone()),
                    (a.clone() / b.clone(), near_a.clone() / near_b.clone()),
                    (a.magnitude().sqrt(), near_a.magnitude().sqrt()),
                    (a.exp(), near_a.exp()),
                    (a.atan2(&b), near_a.atan2(&near_b)),
                    (sin, near_sin),
                    (cos, near_cos),
                    (a.pi(), near_a.pi()),
                    (a.times_power_of_two(-9), near_a.times_power_of_two(-9)),
                    (a.widened(1e-7), near_a.widened(1e-7)),
                ];
                for (number, (wide, near)) in pairs.into_iter().enumerate() {
                    assert!(wide.midpoint == *near.midpoint(), "{number}");
                    let [found, expected] = [wide.error(), near.radius()];
                    // e^r - 1 is bounded by r + r², for r = 0.12 by 5.4 % more; the others are the same formulas.
                    let most = if number == 4 { 1.06 } else { 1.001 };
                    assert!(
                        found >= 0.999_999 * expected - 1e-300 && found <= most * expected,
                        "{number}: {found:e} {expected:e}"
                    );
                }
            }
        }
    }

    /// The smallest value of such a ball is exactly 0.
    #[test]
    fn the_root_of_a_ball_that_reaches_0_is_that_of_its_largest_value() {
        let touching = WideBall::new(big(1.0, MANY), &part(1.0 - 8.0 * f64::EPSILON));
        let error = touching.sqrt().error();
        assert!((1.41..1.42).contains(&error), "{error}");
    }

    #[test]
    fn signs_are_known_below_the_range_of_f64() {
        let tiny = |radius: isize| WideBall::new(big(-1.0, MANY) >> 2000, &(part(1.0) >> radius));
        assert!(tiny(2001).has_sign() && tiny(2001).has_known_sign() && !tiny(1999).has_known_sign());
        assert!((tiny(2001).sign(), tiny(2001).to_f64()) == (-1.0, 0.0) && tiny(2001).error() > 0.0);
        let exact = tiny(2001).like(0.0);
        assert!(exact.has_known_sign() && !exact.has_sign() && exact.error() == 0.0);
        assert!(
            tiny(2001).is_right_to(0.6) && !tiny(2001).is_right_to(0.4) && !tiny(2001).widened(f64::NAN).has_sign()
        );
        // The angle of the origin itself is a convention, which has no error.
        assert_eq!(exact.atan2(&exact).error(), 0.0);
        assert_eq!(exact.clone() / exact, exact_less(MANY));
        let one = tiny(2001);
        assert_eq!((one.to_big(), one.digits()), (one.midpoint().clone(), Elementary::digits(one.midpoint())));
        assert_eq!(one.digits(), 200);
    }

    #[test]
    fn a_number_of_more_digits_is_right_to_its_rounding_and_one_of_as_many_is_exact() {
        let (like, fine) = (WideBall::new(big(0.0, MANY), &part(0.0)), big(1.0, 900) / big(3.0, 900));
        let found = like.like_big(&fine);
        assert!(contains(&found, &fine) && found.error() < 2f64.powi(-190), "{found:?}");
        assert_eq!(like.like_big(found.midpoint()).error(), 0.0);
        assert_eq!(found.to_f64(), 1.0 / 3.0);
    }

    /// A radius has 64 digits, and f64 has 53: to the nearest, it would be below every other radius.
    #[test]
    fn the_error_in_f64_is_not_below_the_radius_and_hardly_above_it() {
        for last in 1..40 {
            let radius = part(1.0) + (part(f64::from(last)) >> 57);
            let ball = WideBall::new(big(1.0, MANY), &radius);
            let radius = ball.radius.as_ref().unwrap();
            let error = exactly(ball.error());
            assert!(*radius <= error && error <= radius * part(1.0 + 8.0 * f64::EPSILON), "{last}: {radius:?}");
        }
    }

    /// The size of the divisor is rounded to 64 digits, and a difference magnifies that.
    #[test]
    fn a_quotient_by_a_ball_that_nearly_holds_0_allows_for_the_rounding_of_its_size() {
        let mut known = 0;
        for (power, last) in (20..64).flat_map(|power| [-1.0, 1.0].map(|last| (power, last))) {
            let divisor = big(1.3, MANY) + (big(0.49 * last, MANY) >> 63);
            let radius = size(&divisor) * (part(1.0) - (part(1.0) >> power));
            let found = WideBall::new(big(1.0, MANY), &part(0.0)) / WideBall::new(divisor.clone(), &radius);
            let nearest = big(1.0, 900) / (big(0.0, 900) + divisor - radius);
            assert!(contains(&found, &nearest), "{power}: {found:?}");
            known += usize::from(found.radius.is_some());
        }
        assert!(known >= 50, "{known}");
    }

    fn exact_less(digits: usize) -> WideBall {
        WideBall { midpoint: big(0.0, digits), radius: None }
    }
}
