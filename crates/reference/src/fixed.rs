//! Numbers of fixed point, with 348 binary digits, 290 of them behind the point. They hold the Taylor coefficients of the
//! [ground truth](super::taylor). Nothing in this file knows any mechanics.
//!
//! A number is the sum of six digits in base 2^58. A digit is from -2^57 to 2^57, so that numbers need no sign, and small
//! ones of either sign begin with zeros. Sums of many products carry nothing until they are complete, and products of two
//! small numbers, as at the end of a series, are left out where no digit of theirs counts.

use super::Big;

/// Digits of a number, the least significant first.
const PLACES: usize = 6;

/// Digits behind the point.
const FRACTION: usize = 5;

/// Binary digits of a digit.
const BITS: usize = 58;

/// Binary digits behind the point.
pub(super) const DIGITS: usize = BITS * FRACTION;

/// Half of the base.
const HALF: i64 = 1 << (BITS - 1);

/// A number from -2^57 to 2^57, a multiple of 2^-[`DIGITS`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Fixed {
    digits: [i64; PLACES],
    /// Digits up to the last one that is not 0.
    len: usize,
}

impl Fixed {
    pub(super) const ZERO: Self = Self::of([0; PLACES]);
    pub(super) const ONE: Self = Self::of([0, 0, 0, 0, 0, 1]);

    const fn of(digits: [i64; PLACES]) -> Self {
        let mut len = PLACES;
        while len > 0 && digits[len - 1] == 0 {
            len -= 1;
        }
        Self { digits, len }
    }

    /// The nearest number; `None` if `value` is too large.
    pub(super) fn new(value: &Big) -> Option<Self> {
        let (mut left, mut digits) = (value.clone().with_precision(0).value(), [0; PLACES]);
        for (place, digit) in digits.iter_mut().enumerate().rev() {
            let shift = BITS.cast_signed() * (FRACTION.cast_signed() - place.cast_signed());
            *digit =
                i64::try_from((left.clone() << shift).to_int().value()).ok().filter(|digit| digit.abs() <= HALF)?;
            left -= Big::from(*digit).with_precision(0).value() >> shift;
        }
        Some(Self::of(digits))
    }

    pub(super) fn to_big(self) -> Big {
        let exactly = |digit: i64| Big::from(digit).with_precision(0).value();
        let whole =
            self.digits.iter().rev().fold(exactly(0), |whole, digit| (whole << BITS.cast_signed()) + exactly(*digit));
        whole.with_precision(BITS * PLACES).value() >> DIGITS.cast_signed()
    }

    /// The size to some roundings.
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    pub(super) fn size(&self) -> f64 {
        let base = 2f64.powi(BITS as i32);
        let whole = self.digits[..self.len].iter().rev().fold(0.0, |whole, digit| whole * base + *digit as f64);
        (whole * 2f64.powi(-(DIGITS as i32))).abs()
    }

    /// `value` without what is behind its first 20 digits, a number from 0 to 1.
    #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 21 digits")]
    pub(super) fn of_few_digits(value: f64) -> Self {
        let millionths = (value.min(1.0) * 2f64.powi(20)) as i64;
        Self::of([0, 0, 0, 0, 0, millionths >> 20])
            .plus(Self::of([0, 0, 0, 0, (millionths & 0xf_ffff) << 37, 0]).twice())
    }

    pub(super) fn minus(self) -> Self {
        Self { digits: self.digits.map(|digit| -digit), ..self }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self::carried(std::array::from_fn(|place| self.digits[place] + other.digits[place]))
    }

    pub(super) fn twice(self) -> Self {
        self.plus(self)
    }

    pub(super) fn times(self, other: Self) -> Self {
        let mut sum = Sum::default();
        sum.add(&self, &other);
        sum.rounded()
    }

    /// From digits of twice the size.
    fn carried(mut digits: [i64; PLACES]) -> Self {
        for place in 0..PLACES - 1 {
            let carry = (digits[place] + HALF) >> BITS;
            digits[place] -= carry << BITS;
            digits[place + 1] += carry;
        }
        Self::of(digits)
    }
}

/// Products of digits below this place are left out: at most four in a product of numbers, each below 2^-292.
const LEAST: usize = FRACTION - 1;

/// A sum of up to 2000 products, by the places of their digits from [`LEAST`] on.
#[derive(Default)]
pub(super) struct Sum([i128; 2 * PLACES - 1 - LEAST]);

impl Sum {
    #[inline]
    pub(super) fn add(&mut self, a: &Fixed, b: &Fixed) {
        // Only places from LEAST on count.
        if a.len + b.len < LEAST + 2 {
            return;
        }
        if a.len.max(b.len) == PLACES {
            return self.add_whole(a, b);
        }
        for i in 0..FRACTION {
            for j in LEAST - i..FRACTION {
                self.0[i + j - LEAST] += i128::from(a.digits[i]) * i128::from(b.digits[j]);
            }
        }
    }

    /// Adds a product of numbers with digits before the point.
    #[cold]
    fn add_whole(&mut self, a: &Fixed, b: &Fixed) {
        for i in 0..PLACES {
            for j in LEAST.saturating_sub(i)..PLACES {
                self.0[i + j - LEAST] += i128::from(a.digits[i]) * i128::from(b.digits[j]);
            }
        }
    }

    pub(super) fn subtract(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(sum, other)| *sum -= other);
    }

    /// The sum, rounded to a number.
    #[expect(clippy::cast_possible_truncation, reason = "what is left is a digit")]
    pub(super) fn rounded(&self) -> Fixed {
        let (half, mut carry, mut digits) = (i128::from(HALF), 0, [0; PLACES]);
        for (place, column) in self.0[..=PLACES].iter().enumerate() {
            let sum = column + carry;
            carry = (sum + half) >> BITS;
            if place > 0 {
                digits[place - 1] = (sum - (carry << BITS)) as i64;
            }
        }
        Fixed::of(digits)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{big, to_f64};
    use super::*;

    #[test]
    fn its_arithmetic_is_that_of_dashu_float_to_the_last_digits() {
        let numbers = [0.0, 1.0, -1.0, 0.1, -7.3, 1e-60, -3e-30, 12345.678, -2.5e-19, 2f64.powi(-290)];
        let numbers = numbers.map(|number| big(number) / big(3.0));
        // Those numbers have 256 digits themselves.
        let off = |found: Fixed, exact: Big| {
            to_f64(&(found.to_big() - &exact)).abs() / (2f64.powi(-288) + 2f64.powi(-254) * to_f64(&exact).abs())
        };
        for a in &numbers {
            let fixed = Fixed::new(a).unwrap();
            assert!(
                off(fixed, a.clone()) < 1.0 && (fixed.size() / to_f64(a).abs() - 1.0).abs() < 1e-9 || fixed.len < 2
            );
            assert!(off(fixed.minus(), -a) < 1.0);
            for b in &numbers {
                let other = Fixed::new(b).unwrap();
                assert!(off(fixed.plus(other), a + b) < 1.0 && off(fixed.times(other), a * b) < 1e5, "{a} {b}");
                let [mut sum, mut less] = [Sum::default(), Sum::default()];
                sum.add(&fixed, &other);
                less.add(&other, &fixed);
                sum.subtract(&less);
                assert_eq!(sum.rounded().len, 0);
            }
        }
        assert_eq!(Fixed::new(&big(1e19)), None);
        for value in [0.0, 0.25, 0.75, 0.999, 1.0, 7.0] {
            let exact = (value * 2f64.powi(20)).floor().min(2f64.powi(20)) * 2f64.powi(-20);
            assert_eq!(Fixed::of_few_digits(value).to_big(), big(exact));
        }
    }
}
