//! Elliptic integrals of the first and third kind and theta functions, in double-double, in any precision, or with error bounds.
//! The motion of a rigid body without symmetry is made of them.
//!
//! | what | symbol | function | source |
//! |---|---|---|---|
//! | complete integral of the first kind | K(m) = π/(2 AGM(1, k')) | [`incomplete_and_complete_first`] | DLMF 19.8.5 |
//! | incomplete integral of the first kind | F(φ \| m) | [`incomplete_first`] | DLMF 19.2.4, 22.20(ii) |
//! | complete integral of the third kind | cel(k', p, a, b) | [`complete_first_and_third`] | DLMF 19.2.11 |
//! | nome | q = exp(-π K'/K) | [`nome`] | DLMF 22.2.1 |
//! | θ4 and θ1 of a complex argument, nome q² | | [`ThetaPair`] | DLMF 20.2.1, 20.2.4 |
//! | the same by Jacobi's imaginary transformation | | [`GaussianPair`] | DLMF 20.7.30 to 20.7.33 |
//!
//! DLMF is the NIST Digital Library of Mathematical Functions, <https://dlmf.nist.gov>.
//!
//! # Conventions
//! - The parameter is m = k², with k the modulus. Functions take the complementary modulus k' = √(1 - m), because m
//!   next to 1 has lost the digits on which they depend, and 1 - m may underflow where k' does not.
//! - K' = K(1 - m). An amplitude φ from 0 to π/2 is given by any positive multiple of its sine and cosine, because both
//!   of them may be small against rounding in a formula for the angle.
//! - Numbers are of any type that implements [`Elementary`]. Of k' = 0 the integral K diverges; results are then
//!   infinite or, in balls, of infinite radius.
//!
//! # Errors
//! Largest errors in double-double at the arguments of `validation/reference/elliptic.toml`, where mpmath and Arb agree
//! to 60 digits. They are relative to the result, and in units of u² = 2^-106; half an ulp of f64 is 2^53 of them. The
//! test `tests/elliptic.rs` prints them and holds twice as much. In balls the last column is the largest radius.
//!
//! | function | arguments | error | radius |
//! |---|---|---|---|
//! | K | k' from 1e-300 to 1 | 2.8 u² | 4.9e4 u² |
//! | cel, weights 0, 1 and 1, 1 | k' from 0.05 to 1, p from 1 to 900 | 3.0 u² | 5.8e4 u² |
//! | F | tan φ from 1e-12 to 1/k', k' from 1e-300 to 1 - 1e-15 | 5.9 u² | 5.6e5 u² (absolute for F < 1, k' ≥ 1e-30) |
//! | q | k' from 1e-300 to 1 - 1e-15 | 25 u² | 5.4e3 u² (absolute) |
//! | θ4, θ1 by series | K'/K from 0.53 to 30, in units of √(\|θ4\|² + \|θ1\|²) | 3.2 u² | 1.4e4 u² |
//! | θ4, θ1 by Gaussians | K'/K from 0.0017 to 0.51, in the same units | 2.6 u² | 7.1e4 u² |

mod first_kind;
mod gaussian;
mod theta;

pub use first_kind::{complete_first_and_third, incomplete_and_complete_first, incomplete_first, nome};
pub use gaussian::GaussianPair;
pub use theta::ThetaPair;

use crate::elementary::Elementary;

/// A complex number: real and imaginary part.
pub type Complex<N> = [N; 2];

/// The product of two complex numbers.
fn times<N: Elementary>([a, b]: &Complex<N>, [c, d]: &Complex<N>) -> Complex<N> {
    let product = |x: &N, y: &N| x.clone() * y.clone();
    [product(a, c) - product(b, d), product(a, d) + product(b, c)]
}

/// Below this size, a term does not count next to 1 (in the precision of `like`).
fn negligible<N: Elementary>(like: &N) -> f64 {
    2f64.powi(-like.digits() - 6)
}

/// Terms after which a series ends in any case: of wide balls it need not converge.
const MOST_TERMS: usize = 200;

/// The largest size of all numbers of a ball.
fn largest<N: Elementary>(number: &N) -> f64 {
    number.to_f64().abs() + number.error()
}

/// Whether a series can end with a term of this size: it is below `small`, or NaN.
fn is_below(size: f64, small: f64) -> bool {
    size.is_nan() || size <= small
}
