//! The product of quaternions in SIMD registers. It is written with fused multiply-adds, so that it is fast and has the
//! same bits at every SIMD level.

use numerics::lanes::{Complex, Real, Simd};

/// The product P ⊗ R of the quaternion P = (w, x, y, z) and the turn R, given as the complex numbers u = w + i z and
/// v = x + i y.
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
