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

#[cfg(test)]
mod tests {
    use dynamics::Attitude;
    use numerics::lanes::{SimdLevel, WithSimd};

    use super::*;

    struct Turned([f64; 4], [Complex<f64>; 2]);

    impl WithSimd for Turned {
        type Output = [f64; 4];

        fn with_simd<S: Simd>(self, simd: S) -> [f64; 4] {
            let splat = |value| Real::splat(simd, value);
            turned(self.0.map(splat), self.1.map(|number| number.map(splat))).map(Real::first)
        }
    }

    #[test]
    fn a_turn_is_the_product_of_attitudes() {
        let of = |components: [f64; 4]| Attitude::from_components(components).unwrap();
        let (p, r) = (of([0.3, -0.7, 0.5, 0.4]), of([-0.2, 0.6, 0.1, 0.9]));
        let [w, x, y, z] = r.components();
        let found = of(SimdLevel::widest().run(Turned(p.components(), [[w, z], [x, y]])));
        assert!(found.angle_to(&(p * r)) < 1e-15);
    }
}
