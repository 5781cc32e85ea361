//! Sums and products that keep what rounding takes from them, and the complex numbers of a step.
//!
//! A number and its error stand beside each other, so that a long flight's rates do not drift: an error of |ω| adds up in the
//! phase, step after step, where one of the attitude does not.

use dynamics::lanes::{Real, Simd};

/// A complex number, as its real and imaginary part.
pub(crate) type Complex<R> = [R; 2];

/// A number and what rounding took from it.
pub(crate) type Double<R> = [R; 2];

/// 1/n. The halves of its digits are multiplied by n exactly, so that the remainder is exact.
pub(crate) const fn inverse(n: usize) -> Double<f64> {
    let n = n as f64;
    let rounded = 1.0 / n;
    let upper = f64::from_bits(rounded.to_bits() & !0xffff_ffff);
    [rounded, ((1.0 - n * upper) - n * (rounded - upper)) / n]
}

/// `a` × `b`.
#[inline(always)]
pub(crate) fn times<S: Simd>(a: Double<Real<S>>, b: Double<Real<S>>) -> Double<Real<S>> {
    let [product, error] = a[0].product(b[0]);
    [product, a[0].mul_add(b[1], a[1].mul_add(b[0], error))]
}

/// `a` + `b`.
#[inline(always)]
pub(crate) fn sum<S: Simd>(a: Double<Real<S>>, b: Double<Real<S>>) -> Double<Real<S>> {
    let [sum, error] = a[0].sum(b[0]);
    [sum, error + (a[1] + b[1])]
}

/// `a` × `b`.
#[inline(always)]
pub(crate) fn complex_product<S: Simd>(a: Complex<Real<S>>, b: Complex<Real<S>>) -> Complex<Real<S>> {
    [a[0].mul_add(b[0], -(a[1] * b[1])), a[0].mul_add(b[1], a[1] * b[0])]
}

/// `a` × `b`.
#[inline(always)]
pub(crate) fn compensated_product<S: Simd>(
    a: Complex<Double<Real<S>>>,
    b: Complex<Double<Real<S>>>,
) -> Complex<Double<Real<S>>> {
    let minus = [-a[1][0], -a[1][1]];
    let [real, imaginary] = [sum(times(a[0], b[0]), times(minus, b[1])), sum(times(a[0], b[1]), times(a[1], b[0]))];
    [normal(real), normal(imaginary)]
}

/// `a` with an error of at most half a bit of its number.
#[inline(always)]
fn normal<S: Simd>(a: Double<Real<S>>) -> Double<Real<S>> {
    let rounded = a[0] + a[1];
    [rounded, a[1] - (rounded - a[0])]
}

/// The modulus and the direction of `a`, which is 1 for 0, and where the square of the modulus underflows.
#[inline(always)]
pub(crate) fn polar<S: Simd>([x, y]: Complex<Real<S>>) -> (Real<S>, Complex<Real<S>>) {
    let one = x.constant(1.0);
    let size = x.mul_add(x, y * y).sqrt();
    let turns = x.constant(0.0).less_than(size);
    let inverse = one / turns.choose(size, one);
    (size, [turns.choose(x * inverse, one), y * inverse])
}

/// P ⊗ R of a quaternion and a turn by its u = w + i z and v = x + i y.
#[inline(always)]
pub(crate) fn turned<S: Simd>(p: [Real<S>; 4], [[w2, z2], [x2, y2]]: [Complex<Real<S>>; 2]) -> [Real<S>; 4] {
    let [w1, x1, y1, z1] = p;
    [
        w1.mul_add(w2, -z1.mul_add(z2, x1.mul_add(x2, y1 * y2))),
        w1.mul_add(x2, x1.mul_add(w2, y1.mul_add(z2, -(z1 * y2)))),
        w1.mul_add(y2, y1.mul_add(w2, z1.mul_add(x2, -(x1 * z2)))),
        w1.mul_add(z2, z1.mul_add(w2, x1.mul_add(y2, -(y1 * x2)))),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
