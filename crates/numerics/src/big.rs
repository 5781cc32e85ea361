//! Binary numbers of any precision, rounded to nearest. The proofs of outcomes use them where double-double numbers are
//! not precise enough.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use crate::number::Number;

/// A binary number whose precision is a property of each value. Precision 0 means unlimited: sums and products are
/// exact.
pub type Big = FBig<HalfEven>;

/// Converts `value` to a number of unlimited precision, so that sums and products are exact. Panics if `value` is not
/// finite.
pub fn exactly(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(0).value()
}

impl Number for Big {}
