//! Numbers as they were given: an f64 times an exact unit; of angles, in radians or in turns.
//!
//! 24 mm are 24/1000 m, which no f64 holds. What is derived from such a number in more digits starts from the two exact
//! factors, so that the conversion loses nothing.

use crate::big::{Big, exactly};
use crate::double_double::DoubleDouble;
use crate::scale::mantissa_and_exponent;

/// 2π.
const TURN: [f64; 2] = [std::f64::consts::TAU, 2.449_293_598_294_706_4e-16];

/// What a number is counted in: a rational part of one, or of a turn of 2π.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unit {
    numerator: u16,
    denominator: u32,
    of_turn: bool,
}

impl Unit {
    /// The factor 1, which of angles is the radian.
    pub const ONE: Self = Self { numerator: 1, denominator: 1, of_turn: false };

    /// A turn of 2π.
    pub const TURN: Self = Self { of_turn: true, ..Self::ONE };

    /// A turn by 360.
    pub const DEGREE: Self = Self { denominator: 360, ..Self::TURN };

    /// `numerator`/`denominator`; `None` if one of them is 0.
    pub const fn ratio(numerator: u16, denominator: u32) -> Option<Self> {
        if numerator == 0 || denominator == 0 { None } else { Some(Self { numerator, denominator, of_turn: false }) }
    }

    /// This part of a turn.
    #[must_use]
    pub const fn of_turn(self) -> Self {
        Self { of_turn: true, ..self }
    }

    /// Its numerator.
    pub fn numerator(self) -> u16 {
        self.numerator
    }

    /// Its denominator.
    pub fn denominator(self) -> u32 {
        self.denominator
    }

    /// Whether it is a part of a turn.
    pub fn is_of_turn(self) -> bool {
        self.of_turn
    }

    /// The unit, rounded to so many binary digits.
    pub fn in_digits(self, digits: usize) -> Big {
        self.times(1.0).in_digits(digits)
    }

    /// So many of this unit.
    #[inline]
    pub fn times(self, value: f64) -> Quantity {
        Quantity { value, unit: self }
    }
}

/// A number: an f64 times a [`Unit`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    value: f64,
    unit: Unit,
}

impl From<f64> for Quantity {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, unit: Unit::ONE }
    }
}

impl Quantity {
    /// The f64.
    #[inline]
    pub fn value(self) -> f64 {
        self.value
    }

    /// What it is multiplied by.
    #[inline]
    pub fn unit(self) -> Unit {
        self.unit
    }

    /// The nearest f64, or infinite.
    #[inline]
    pub fn to_f64(self) -> f64 {
        if self.unit == Unit::ONE { self.value } else { self.double_double().hi() }
    }

    /// The number to 10 u², and of turns to 16 u², unless it leaves the range of f64. Above 1e290 turns it is rounded to
    /// f64.
    #[inline]
    pub fn double_double(self) -> DoubleDouble {
        if !self.unit.of_turn {
            return self.in_its_factor();
        }
        let turns = self.in_its_factor();
        // Splitting a number of this size for an exact product would overflow.
        if turns.hi().abs() > 1e290 {
            (turns.hi() * TURN[0]).into()
        } else {
            turns * (DoubleDouble::exactly(TURN[0]) + TURN[1].into())
        }
    }

    /// The number to 10 u², without the factor of a turn.
    #[inline]
    fn in_its_factor(self) -> DoubleDouble {
        let Unit { numerator, denominator, .. } = self.unit;
        if (numerator, denominator) == (1, 1) || !self.value.is_finite() {
            return self.value.into();
        }
        let (mantissa, exponent) = mantissa_and_exponent(self.value);
        let scaled = DoubleDouble::product(mantissa, numerator.into()) / f64::from(denominator).into();
        scaled.times_power_of_two(exponent)
    }

    /// The number, rounded to so many binary digits. Panics for a value that is not finite.
    pub fn in_digits(self, digits: usize) -> Big {
        let product = exactly(self.value) * exactly(self.unit.numerator.into());
        let denominator = exactly(self.unit.denominator.into()).with_precision(digits).value();
        let ratio = product.with_precision(digits).value() / denominator;
        if self.unit.of_turn { ratio * Big::pi(digits) * exactly(2.0) } else { ratio }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_its_value_times_its_unit() {
        let inch = Unit::ratio(127, 5000).unwrap();
        for value in [0.955, -3.0, 1e300, 1e-305] {
            let (length, found) = (inch.times(value), inch.times(value).double_double());
            let exact = exactly(value) * exactly(127.0) / exactly(5000.0).with_precision(300).value();
            let error = |found: Big| ((found - &exact) / &exact).to_f64().value().abs();
            let units = error(exactly(found.hi()) + exactly(found.lo())) * 2f64.powi(106);
            assert!(units <= 10.0 || value == 1e-305, "{value}: {units} u²");
            assert!(error(length.in_digits(200)) < 2f64.powi(-198), "{value}");
            assert_eq!(length.to_f64(), exact.to_f64().value());
        }
        assert_eq!(Unit::ratio(2, 1).unwrap().times(f64::MAX).to_f64(), f64::INFINITY);
        assert!(inch.times(f64::NAN).to_f64().is_nan());
        assert_eq!((Unit::ratio(0, 1), Unit::ratio(1, 0)), (None, None));
        for unit in [Unit::ratio(1, 60).unwrap().of_turn(), Unit::DEGREE, Unit::ratio(3, 1000).unwrap(), Unit::TURN] {
            assert_eq!(unit.in_digits(200).to_f64().value(), unit.times(1.0).to_f64(), "{unit:?}");
        }
        assert_eq!((Unit::DEGREE.times(180.0).to_f64(), Unit::ONE.times(0.3)), (std::f64::consts::PI, 0.3.into()));
    }
}
