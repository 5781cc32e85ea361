//! Roots, exponentials and angles of double-double numbers to nearly all of their 106 digits. The motion of a rigid
//! body needs them, because a phase of 10^9 rad keeps twenty digits after the point only if its rates have thirty.
//!
//! Each function reduces its argument by constants of more than 106 digits, and sums a Taylor series in double-double,
//! but for terms so small that their rounding to f64 does not count.
//! A test holds the errors against 300 bits: at most 2^-100 of the result, of sine and cosine 2^-100 and at small
//! angles 2^-100 of the angle.

use super::DoubleDouble;
use crate::angle::{QUARTER, sin_cos_of_parts};
use crate::big::{Big, exactly};
use crate::scale::mantissa_and_exponent;

/// ln 2 in three parts, to 2^-137.
const LN_2: [f64; 3] = [0.6931471803691238, 1.9082149292705877e-10, 1.1612227229362532e-26];

/// 1/n! for n = 0, 1, ..., 17.
#[rustfmt::skip]
const INVERSE_FACTORIALS: [DoubleDouble; 18] = [
    DoubleDouble { hi: 1.0, lo: 0.0 },
    DoubleDouble { hi: 1.0, lo: 0.0 },
    DoubleDouble { hi: 0.5, lo: 0.0 },
    DoubleDouble { hi: 0.16666666666666666, lo: 9.25185853854297e-18 },
    DoubleDouble { hi: 0.041666666666666664, lo: 2.3129646346357427e-18 },
    DoubleDouble { hi: 0.008333333333333333, lo: 1.1564823173178714e-19 },
    DoubleDouble { hi: 0.001388888888888889, lo: -5.300543954373577e-20 },
    DoubleDouble { hi: 0.0001984126984126984, lo: 1.7209558293420705e-22 },
    DoubleDouble { hi: 2.48015873015873e-05, lo: 2.1511947866775882e-23 },
    DoubleDouble { hi: 2.7557319223985893e-06, lo: -1.858393274046472e-22 },
    DoubleDouble { hi: 2.755731922398589e-07, lo: 2.3767714622250297e-23 },
    DoubleDouble { hi: 2.505210838544172e-08, lo: -1.448814070935912e-24 },
    DoubleDouble { hi: 2.08767569878681e-09, lo: -1.20734505911326e-25 },
    DoubleDouble { hi: 1.6059043836821613e-10, lo: 1.2585294588752098e-26 },
    DoubleDouble { hi: 1.1470745597729725e-11, lo: 2.0655512752830745e-28 },
    DoubleDouble { hi: 7.647163731819816e-13, lo: 7.03872877733453e-30 },
    DoubleDouble { hi: 4.779477332387385e-14, lo: 4.399205485834081e-31 },
    DoubleDouble { hi: 2.8114572543455206e-15, lo: 1.6508842730861433e-31 },
];

/// Arguments of the exponential below which the result is 0, and above which it is infinite.
const EXPONENTS: std::ops::RangeInclusive<f64> = -745.0..=709.0;

/// Angles (rad) up to which the number of quarters of a turn is known by f64.
const MOST_QUARTERS: f64 = 9_007_199_254_740_992.0; // 2^53

impl DoubleDouble {
    /// π, to 2^-107.
    pub const PI: Self = Self { hi: 2.0 * QUARTER[0], lo: 2.0 * QUARTER[1] };

    /// The nearest double-double number.
    pub fn nearest(value: &Big) -> Self {
        let hi = value.to_f64().value();
        if !hi.is_finite() {
            return Self::exactly(hi);
        }
        Self::exactly(hi) + (value - exactly(hi)).to_f64().value().into()
    }

    /// Sine and cosine of a finite angle (rad), to 2^-100, besides what the error of the angle itself does.
    pub fn exact_sin_cos(self) -> (Self, Self) {
        if self.hi.abs() > MOST_QUARTERS && (self.hi + self.lo).is_finite() {
            return self.sin_cos_of_large();
        }
        // The first number of quarters is off by one where it has nearly all digits of f64.
        let (rest, quarters) = self.less_quarters();
        let (rest, more) = rest.less_quarters();
        sin_cos_of_parts(rest, quarters + more, sin_cos_of_small).into()
    }

    /// Sine and cosine by as many digits as the largest f64 has before the point, and those of the result after it.
    #[cold]
    fn sin_cos_of_large(self) -> (Self, Self) {
        let angle = (exactly(self.hi) + exactly(self.lo)).with_precision(1280).value();
        let (sin, cos) = angle.sin_cos();
        (Self::nearest(&sin), Self::nearest(&cos))
    }

    /// The angle less a number of quarters of a turn, and that number.
    #[inline]
    pub(crate) fn less_quarters(self) -> (Self, f64) {
        let quarters = (self.hi * std::f64::consts::FRAC_2_PI).round_ties_even();
        (QUARTER.iter().fold(self, |rest, part| rest - Self::product(quarters, *part)), quarters)
    }

    /// e to this power; 0 below -745, infinite above 709, and NaN of NaN.
    pub fn exp(self) -> Self {
        const HALVINGS: i32 = 6;
        if !EXPONENTS.contains(&self.hi) {
            let beyond = if self.hi > 0.0 { f64::INFINITY } else { 0.0 };
            return Self::exactly(if self.hi.is_nan() { self.hi } else { beyond });
        }
        let twos = (self.hi * std::f64::consts::LOG2_E).round_ties_even();
        let rest = LN_2.iter().fold(self, |rest, part| rest - Self::product(twos, *part));
        let small = rest.times_power_of_two(-HALVINGS);
        // e^small - 1 from its series, whose last term is below 2^-120, and then e^2x - 1 = (e^x - 1) (e^x + 1).
        let series = series(small, (1..=13).rev(), 7);
        let grown = (0..HALVINGS).fold(small * series, |less_1, _| less_1 * (less_1 + 2.0.into()));
        (grown + 1.0.into()).times_power_of_two(twos as i32)
    }

    /// The angle (rad) of the point (`x`, `y`), from -π to π; 0 for the origin.
    pub fn atan2(y: Self, x: Self) -> Self {
        let (_, exponent) = mantissa_and_exponent(x.hi.abs().max(y.hi.abs()));
        let [x, y] = [x, y].map(|part| part.times_power_of_two(-exponent));
        let rounded = Self::exactly(y.hi.atan2(x.hi));
        if rounded.hi == 0.0 || (x.hi, y.hi) == (0.0, 0.0) {
            return if x.hi > 0.0 { y / x } else { Self::ZERO };
        }
        // What the rounded angle lacks is so small that it is its own tangent.
        let (sin, cos) = rounded.exact_sin_cos();
        rounded + (y * cos - x * sin) / (x * cos + y * sin)
    }
}

/// sin d and cos d - 1 of an angle up to 1/32.
fn sin_cos_of_small(d: DoubleDouble) -> [DoubleDouble; 2] {
    let square = -(d * d);
    // Terms up to the sixteenth and seventeenth power, of at most 2^-125.
    [d * series(square, (1..=17).rev().step_by(2), 9), square * series(square, (2..=16).rev().step_by(2), 10)]
}

/// The sum of the powers 0, 1, 2, ... of `at`, divided by the factorials of the numbers in `falling`, the last of which
/// belongs to the power 0. The terms from the number `rough` on are so small that f64 suffices for them.
fn series(at: DoubleDouble, falling: impl Iterator<Item = usize>, rough: usize) -> DoubleDouble {
    let (mut tail, mut sum) = (0.0, DoubleDouble::ZERO);
    for n in falling {
        let coefficient = INVERSE_FACTORIALS[n];
        if n >= rough {
            tail = coefficient.hi + at.hi * tail;
            sum = tail.into();
        } else {
            sum = coefficient + at * sum;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn big(value: DoubleDouble) -> Big {
        (exactly(value.hi) + exactly(value.lo)).with_precision(300).value()
    }

    /// Asserts an error of at most 2^-100 times `size`.
    #[track_caller]
    fn assert_right(found: DoubleDouble, exact: &Big, size: f64) {
        let error = (big(found) - exact).to_f64().value().abs();
        assert!(error <= 2f64.powi(-100) * size, "{found:?} is off by 2^{}", (error / size).log2());
    }

    /// Numbers with full mantissas, between -1 and 1.
    fn samples(number: u32) -> impl Iterator<Item = DoubleDouble> {
        (1..=number).map(|index| {
            let part = 2.0 * (f64::from(index) * 2f64.sqrt()).fract() - 1.0;
            DoubleDouble::exactly(part) + DoubleDouble::product(part, 2f64.powi(-53) * (f64::from(index) * 0.6).fract())
        })
    }

    #[test]
    fn the_constants_are_those_of_more_digits() {
        assert_eq!(DoubleDouble::PI, DoubleDouble::nearest(&Big::pi(300)));
        let sum = LN_2.iter().fold(exactly(0.0), |sum, part| sum + exactly(*part));
        let ln_2 = exactly(2.0).with_precision(300).value().ln();
        assert!((sum - ln_2).to_f64().value().abs() < 2f64.powi(-138));
    }

    #[test]
    fn sines_and_cosines_have_a_hundred_digits() {
        for part in samples(400) {
            for size in [1e-30, 0.01, 1.0, 4.0, 1e3, 1e9, 9e15] {
                let angle = part * size;
                let ((sin, cos), (exact_sin, exact_cos)) = (angle.exact_sin_cos(), big(angle).sin_cos());
                assert_right(sin, &exact_sin, size.min(1.0));
                assert_right(cos, &exact_cos, 1.0);
            }
        }
    }

    #[test]
    fn exponentials_have_a_hundred_digits() {
        for part in samples(400) {
            for size in [1e-30, 0.3, 1.0, 30.0, 600.0] {
                let exact = big(part * size).exp();
                assert_right((part * size).exp(), &exact, exact.to_f64().value());
            }
        }
        assert_eq!((DoubleDouble::exactly(-1e9).exp().hi, DoubleDouble::ZERO.exp().hi), (0.0, 1.0));
        assert_eq!(DoubleDouble::exactly(1e9).exp().hi, f64::INFINITY);
        assert!(DoubleDouble::exactly(f64::NAN).exp().hi.is_nan());
    }

    #[test]
    fn angles_have_a_hundred_digits_in_every_quadrant() {
        let (mut xs, mut ys) = (samples(200), samples(300).skip(77));
        while let (Some(x), Some(y)) = (xs.next(), ys.next()) {
            for [x, y] in [[x, y], [x * 1e-20, y], [x, y * 1e-20], [x * 1e200, y * 1e200]] {
                let exact = big(y).atan2(&big(x));
                assert_right(DoubleDouble::atan2(y, x), &exact, exact.to_f64().value().abs());
            }
        }
        let one = DoubleDouble::exactly(1.0);
        assert_eq!(DoubleDouble::atan2(DoubleDouble::ZERO, one), DoubleDouble::ZERO);
        assert_right(DoubleDouble::atan2(DoubleDouble::ZERO, -one), &Big::pi(300), 4.0);
        assert_right(DoubleDouble::atan2(-one, DoubleDouble::ZERO), &(Big::pi(300) / exactly(-2.0)), 2.0);
        assert_eq!(DoubleDouble::atan2(DoubleDouble::ZERO, DoubleDouble::ZERO), DoubleDouble::ZERO);
    }
}
