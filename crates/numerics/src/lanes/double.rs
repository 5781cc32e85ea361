//! Sums and products of SIMD vectors with twice as many digits, and complex numbers. The steps by Taylor series need
//! both: each step turns a complex rate by an angle, and its rounding errors would add up in long flights.
//!
//! A number stands beside its rounding error. Unlike [`DoubleDouble`](crate::DoubleDouble), the pair is not
//! renormalised after each operation, which saves time and costs little accuracy in a short chain of operations.

use pulp::Simd;

use super::real::Real;

/// A complex number: its real part and its imaginary part.
pub type Complex<R> = [R; 2];

/// A rounded number and its rounding error; their sum is the value.
pub type Double<R> = [R; 2];

/// 1/n with twice the digits of f64. The remainder 1 - n fl(1/n) is computed exactly, by multiplying the two halves of
/// the quotient's digits by n separately.
pub const fn inverse(n: usize) -> Double<f64> {
    let n = n as f64;
    let rounded = 1.0 / n;
    let upper = f64::from_bits(rounded.to_bits() & !0xffff_ffff);
    [rounded, ((1.0 - n * upper) - n * (rounded - upper)) / n]
}

/// `a` × `b`, with twice as many digits.
#[inline(always)]
pub fn times<S: Simd>(a: Double<Real<S>>, b: Double<Real<S>>) -> Double<Real<S>> {
    let [product, error] = a[0].product(b[0]);
    [product, a[0].mul_add(b[1], a[1].mul_add(b[0], error))]
}

/// `a` + `b`, with twice as many digits.
#[inline(always)]
pub fn sum<S: Simd>(a: Double<Real<S>>, b: Double<Real<S>>) -> Double<Real<S>> {
    let [sum, error] = a[0].sum(b[0]);
    [sum, error + (a[1] + b[1])]
}

/// `a` × `b`, rounded to f64.
#[inline(always)]
pub fn complex_product<S: Simd>(a: Complex<Real<S>>, b: Complex<Real<S>>) -> Complex<Real<S>> {
    [a[0].mul_add(b[0], -(a[1] * b[1])), a[0].mul_add(b[1], a[1] * b[0])]
}

/// `a` × `b` with twice as many digits; the parts of the result are renormalised.
#[inline(always)]
pub fn compensated_product<S: Simd>(
    a: Complex<Double<Real<S>>>,
    b: Complex<Double<Real<S>>>,
) -> Complex<Double<Real<S>>> {
    let minus = [-a[1][0], -a[1][1]];
    let [real, imaginary] = [sum(times(a[0], b[0]), times(minus, b[1])), sum(times(a[0], b[1]), times(a[1], b[0]))];
    [normal(real), normal(imaginary)]
}

/// Renormalises `a`, so that its error is at most half a unit in the last place of its number.
#[inline(always)]
fn normal<S: Simd>(a: Double<Real<S>>) -> Double<Real<S>> {
    let rounded = a[0] + a[1];
    [rounded, a[1] - (rounded - a[0])]
}

/// The modulus |z| and the direction z/|z| of z = x + iy. Where the square of the modulus is 0 or underflows to 0, the
/// modulus is 0 and the real part of the direction is 1.
#[inline(always)]
pub fn polar<S: Simd>([x, y]: Complex<Real<S>>) -> (Real<S>, Complex<Real<S>>) {
    let one = x.constant(1.0);
    let size = x.mul_add(x, y * y).sqrt();
    let turns = x.constant(0.0).less_than(size);
    let inverse = one / turns.choose(size, one);
    (size, [turns.choose(x * inverse, one), y * inverse])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DoubleDouble;
    use crate::lanes::{SimdLevel, WithSimd};

    #[test]
    fn inverses_have_twice_as_many_digits() {
        for n in 1..30 {
            let [rounded, error] = inverse(n);
            assert_eq!(rounded, 1.0 / n as f64);
            // 1 - n fl(1/n), rounded once.
            let remainder = (-(n as f64)).mul_add(rounded, 1.0);
            assert_eq!(error, remainder / n as f64);
        }
    }

    /// Numbers of either sign, each with a part below its last bit.
    fn doubles() -> [Double<f64>; 4] {
        [[0.7, 3.1e-17], [-1.9, 0.8e-16], [1.0 / 3.0, -2.2e-17], [0.01, 0.7e-18]]
    }

    /// Calls the closure with each pair of [`doubles`], their product and their sum.
    struct Doubles<'a>(&'a dyn Fn(Double<f64>, Double<f64>, [Double<f64>; 2]));

    impl WithSimd for Doubles<'_> {
        type Output = ();

        fn with_simd<S: Simd>(self, simd: S) {
            for a in doubles() {
                for b in doubles() {
                    let [x, y] = [a, b].map(|number| number.map(|part| Real::splat(simd, part)));
                    self.0(a, b, [times(x, y), sum(x, y)].map(|number| number.map(Real::first)));
                }
            }
        }
    }

    fn double_double([high, low]: Double<f64>) -> DoubleDouble {
        DoubleDouble::exactly(high) + DoubleDouble::exactly(low)
    }

    /// Absolute error in units of 2^-106, the rounding of a number near 1 with twice as many digits.
    fn error(found: Double<f64>, expected: DoubleDouble) -> f64 {
        (double_double(found) - expected).hi().abs() * f64::exp2(106.0)
    }

    #[test]
    fn products_and_sums_keep_twice_as_many_digits() {
        for level in SimdLevel::all() {
            level.run(Doubles(&|a, b, [product, sum]| {
                let (x, y) = (double_double(a), double_double(b));
                assert!(error(product, x * y) < 16.0, "{a:?} × {b:?}: {product:?}");
                assert!(error(sum, x + y) < 16.0, "{a:?} + {b:?}: {sum:?}");
            }));
        }
    }

    /// Computes the products, and the polar form, of two complex numbers that come with their errors.
    struct OfAStep([Complex<Double<f64>>; 2]);

    struct StepParts {
        product: Complex<f64>,
        compensated: Complex<Double<f64>>,
        modulus: f64,
        direction: Complex<f64>,
    }

    impl WithSimd for OfAStep {
        type Output = StepParts;

        fn with_simd<S: Simd>(self, simd: S) -> StepParts {
            let [a, b] = self.0.map(|number| number.map(|part| part.map(|value| Real::splat(simd, value))));
            let rough = |number: Complex<Double<Real<S>>>| number.map(|part| part[0]);
            let (modulus, direction) = polar(rough(a));
            StepParts {
                product: complex_product(rough(a), rough(b)).map(Real::first),
                compensated: compensated_product(a, b).map(|part| part.map(Real::first)),
                modulus: modulus.first(),
                direction: direction.map(Real::first),
            }
        }
    }

    #[test]
    fn complex_numbers_are_multiplied_and_have_a_modulus_and_a_direction() {
        let [a, b, c, d] = doubles();
        for [[x, y], [s, t]] in [[[a, b], [c, d]], [[b, c], [a, b]], [[d, a], [c, c]]] {
            let found = SimdLevel::widest().run(OfAStep([[x, y], [s, t]]));
            let [x, y, s, t] = [x, y, s, t].map(double_double);
            for (part, expected) in [x * s - y * t, x * t + y * s].into_iter().enumerate() {
                assert!((found.product[part] - expected.hi()).abs() < 4e-16);
                assert!(error(found.compensated[part], expected) < 64.0);
                let [rounded, rest] = found.compensated[part];
                assert_eq!(rounded + rest, rounded, "the rest is below half a bit");
            }
            let modulus = x.hi().hypot(y.hi());
            assert!((found.modulus - modulus).abs() < 4e-16);
            assert!((found.direction[0] - x.hi() / modulus).abs() < 4e-16);
            assert!((found.direction[1] - y.hi() / modulus).abs() < 4e-16);
        }
        for size in [0.0, 1e-200] {
            let found = SimdLevel::widest().run(OfAStep([[[size, 0.0], [-size, 0.0]], [a, b]]));
            assert_eq!((found.modulus, found.direction[0]), (0.0, 1.0));
            assert!(found.direction[1].abs() <= 1e-200);
        }
    }
}
