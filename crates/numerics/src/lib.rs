//! Arithmetic that knows no mechanics.
//!
//! | what | module |
//! |---|---|
//! | numbers of twice the precision of f64, and the exact sums and products that they are made of | [`double_double`] |
//! | numbers of any precision | [`big`] |
//! | the operations that a formula needs, so that it is written once for all kinds of numbers | [`number`] |
//! | numbers as they were given, times an exact unit; angles, with sine and cosine in more digits | [`quantity`], [`angle`] |
//! | powers of two as units | [`scale`] |
//! | vectors of f64 in the machine's registers, with the same bits on every machine | [`lanes`] |
//!
//! Errors are bounded in units of u = 2^-53, the [`UNIT_ROUNDOFF`]; each bound stands where its operation does.

pub mod angle;
pub mod big;
pub mod double_double;
pub mod lanes;
pub mod number;
pub mod quantity;
pub mod scale;

pub use angle::{Angle, AngleUnit};
pub use big::Big;
pub use double_double::DoubleDouble;
pub use number::Number;
pub use quantity::{Quantity, Unit};

/// Half of ε: the largest relative error of one rounded operation.
pub const UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;
