//! Arithmetic for the solvers: numbers more precise than f64, powers of two as units, and SIMD vectors of f64. It is a
//! crate without any mechanics, so that each operation can be bounded and tested on its own.
//!
//! | what | module |
//! |---|---|
//! | numbers of twice the precision of f64, and the exact sums and products that they are made of | [`double_double`] |
//! | numbers of any precision | [`big`] |
//! | the trait over which a formula is written once for all kinds of numbers | [`number`] |
//! | numbers in exact units; angles, with sine and cosine to 2^-68 and beyond | [`quantity`] |
//! | the trait of the numbers that also have roots, exponentials and angles | [`elementary`] |
//! | numbers with a bound of their error, which grows with each operation | [`ball`] |
//! | Taylor series in up to three variables, whose terms are the derivatives of a formula | [`jet`] |
//! | functions on an interval as polynomials with error bounds | [`taylor_model`] |
//! | powers of two as units | [`scale`] |
//! | vectors of f64 in SIMD registers, with the same bits on every machine | [`lanes`] |
//!
//! Errors are bounded in units of u = 2^-53, the [`UNIT_ROUNDOFF`]. Each bound is stated at its operation.

mod angle;
pub mod ball;
pub mod big;
pub mod double_double;
pub mod elementary;
pub mod jet;
pub mod lanes;
pub mod number;
pub mod positive_part;
pub mod quantity;
pub mod scale;
pub mod taylor_model;

pub use ball::{Ball, WideBall};
pub use big::Big;
pub use double_double::DoubleDouble;
pub use elementary::Elementary;
pub use jet::Jet;
pub use number::Number;
pub use quantity::{Quantity, Unit};
pub use taylor_model::TaylorModel;

/// u = 2^-53, half of f64's ε: the largest relative error of one rounded operation.
pub const UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;
