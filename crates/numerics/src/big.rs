//! Numbers of any precision, rounded to nearest.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use crate::number::Number;

/// A binary number with as many digits as its context says; 0 means that no digit is ever lost.
pub type Big = FBig<HalfEven>;

/// `value` with unlimited precision, so that sums and products are exact.
///
/// # Panics
/// For a value that is not finite.
pub fn exactly(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(0).value()
}

impl Number for Big {}
