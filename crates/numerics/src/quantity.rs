//! Numbers as they were given: an f64 times an exact unit.
//!
//! 24 mm are 24/1000 m, which no f64 holds. What is derived from such a number in more digits starts from the two exact
//! factors, so that the conversion loses nothing.

use crate::big::{Big, exactly};
use crate::double_double::DoubleDouble;
use crate::scale::mantissa_and_exponent;

/// A positive rational factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unit {
    pub(crate) numerator: u16,
    pub(crate) denominator: u32,
}

impl Unit {
    /// The factor 1.
    pub const ONE: Self = Self { numerator: 1, denominator: 1 };

    /// `numerator`/`denominator`; `None` if one of them is 0.
    pub const fn ratio(numerator: u16, denominator: u32) -> Option<Self> {
        if numerator == 0 || denominator == 0 { None } else { Some(Self { numerator, denominator }) }
    }

    /// Its numerator.
    pub fn numerator(self) -> u16 {
        self.numerator
    }

    /// Its denominator.
    pub fn denominator(self) -> u32 {
        self.denominator
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
    /// `value` times `unit`.
    pub fn new(value: f64, unit: Unit) -> Self {
        Self { value, unit }
    }

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

    /// The number to 10 u², unless it leaves the range of f64.
    #[inline]
    pub fn double_double(self) -> DoubleDouble {
        let Unit { numerator, denominator } = self.unit;
        if self.unit == Unit::ONE || !self.value.is_finite() {
            return self.value.into();
        }
        let (mantissa, exponent) = mantissa_and_exponent(self.value);
        let scaled = DoubleDouble::product(mantissa, numerator.into()) / f64::from(denominator).into();
        scaled.times_power_of_two(exponent)
    }

    /// The number, rounded to so many binary digits. Panics for a value that is not finite.
    pub fn in_digits(self, digits: usize) -> Big {
        let product = exactly(self.value) * exactly(self.unit.numerator.into());
        product.with_precision(digits).value() / exactly(self.unit.denominator.into()).with_precision(digits).value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_its_value_times_its_unit() {
        let inch = Unit::ratio(127, 5000).unwrap();
        for value in [0.955, -3.0, 1e300, 1e-305] {
            let (length, found) = (Quantity::new(value, inch), Quantity::new(value, inch).double_double());
            let exact = exactly(value) * exactly(127.0) / exactly(5000.0).with_precision(300).value();
            let error = |found: Big| ((found - &exact) / &exact).to_f64().value().abs();
            let units = error(exactly(found.hi()) + exactly(found.lo())) * 2f64.powi(106);
            assert!(units <= 10.0 || value == 1e-305, "{value}: {units} u²");
            assert!(error(length.in_digits(200)) < 2f64.powi(-198), "{value}");
            assert_eq!(length.to_f64(), exact.to_f64().value());
        }
        assert_eq!(Quantity::new(f64::MAX, Unit::ratio(2, 1).unwrap()).to_f64(), f64::INFINITY);
        assert!(Quantity::new(f64::NAN, inch).to_f64().is_nan());
        assert_eq!((Unit::ratio(0, 1), Unit::ratio(1, 0)), (None, None));
    }
}
