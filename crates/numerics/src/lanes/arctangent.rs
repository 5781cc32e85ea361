//! The angle of a point, atan2, of SIMD vectors. Unlike the functions of the mathematical library it has no branches, and
//! the same bits on every machine.
//!
//! The angle is a multiple of π/4 plus or minus the arctangent of a number below tan π/8 = √2 - 1. That arctangent is the
//! polynomial with the least maximum relative error (found by the Remez algorithm), and the multiple is added last, as an
//! f64 and the rest that rounding took from it.

use pulp::Simd;

use super::real::Real;

/// (atan(x)/x - 1)/x² as a polynomial in x², for |x| ≤ √2 - 1, with an error of 1.3e-18 in atan(x)/x.
const ARCTANGENT: [f64; 11] = [
    -0.333_333_333_333_332,
    0.199_999_999_999_540_85,
    -0.142_857_142_802_487_54,
    0.111_111_107_861_479_8,
    -0.090_908_978_366_993_27,
    0.076_920_616_410_502_63,
    -0.066_631_204_242_902_56,
    0.058_480_091_862_618_92,
    -0.050_398_466_434_682_75,
    0.038_078_347_986_568_82,
    -0.017_922_307_320_442_24,
];

/// √2 - 1 = tan π/8.
const TAN_OF_EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;

/// π/4, and the rest of it.
const QUARTER: [f64; 2] = [std::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17];

/// Largest error of [`atan2`] (rad).
pub const ATAN2_ERROR: f64 = 3.0 * crate::UNIT_ROUNDOFF;

/// The angle of the point (`x`, `y`), from -π to π (rad), to [`ATAN2_ERROR`], for numbers whose squares stay within the
/// range of f64; 0 for the point (0, 0). An angle is 0 exactly if `y` is 0 and `x` is not negative.
#[inline(always)]
pub fn atan2<S: Simd>(y: Real<S>, x: Real<S>) -> Real<S> {
    let (zero, one, two) = (x.constant(0.0), x.constant(1.0), x.constant(2.0));
    let (across, along) = (y.abs(), x.abs());
    // The point in the first eighth of the turn: its angle, or what is missing to a quarter of the turn.
    let is_steep = along.less_than(across);
    let (near, far) = (is_steep.choose(along, across), is_steep.choose(across, along));
    // Above π/8 the angle is π/4 minus that of (far + near, far - near).
    let is_wide = (far * x.constant(TAN_OF_EIGHTH)).less_than(near);
    let (rise, run) = (is_wide.choose(far - near, near), is_wide.choose(far + near, far));
    let tangent = rise / zero.less_than(run).choose(run, one);
    let square = tangent * tangent;
    let mut sum = x.constant(ARCTANGENT[ARCTANGENT.len() - 1]);
    for coefficient in ARCTANGENT[..ARCTANGENT.len() - 1].iter().rev() {
        sum = sum.mul_add(square, x.constant(*coefficient));
    }
    let part = (tangent * square).mul_add(sum, tangent);
    // Each reflection takes the angle away from twice the angle of its axis, counted in quarters of π.
    let (mut quarters, mut sign) = (is_wide.choose(one, zero), is_wide.choose(-one, one));
    (quarters, sign) = (is_steep.choose(two - quarters, quarters), is_steep.choose(-sign, sign));
    let is_behind = x.less_than(zero);
    (quarters, sign) = (is_behind.choose(two + two - quarters, quarters), is_behind.choose(-sign, sign));
    let angle = quarters.mul_add(x.constant(QUARTER[0]), sign.mul_add(part, quarters * x.constant(QUARTER[1])));
    angle.times_sign_of(y)
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;
    use crate::DoubleDouble;

    fn found(y: f64, x: f64) -> f64 {
        let mut out = [f64::NAN];
        atan2(Real::splat(Scalar, y), Real::splat(Scalar, x)).store(&mut out);
        out[0]
    }

    /// Points all around, at many distances, and next to the edges between the parts of the formula.
    fn points() -> impl Iterator<Item = [f64; 2]> {
        let around = (0..40_000).map(|part| f64::from(part) * 1.570_796_33e-4);
        let edges = (0..=16).flat_map(|eighth| {
            let angle = f64::from(eighth) * std::f64::consts::FRAC_PI_8;
            (-20..=20).map(move |ulp| angle + f64::from(ulp) * 2e-16)
        });
        let angles = around.chain(edges);
        angles.zip([1.0, 1e-9, 3e-7, 0.7, 1e3, 1e100].into_iter().cycle()).map(|(angle, distance)| {
            let (sin, cos) = angle.sin_cos();
            [distance * sin, distance * cos]
        })
    }

    #[test]
    fn angles_are_right_to_three_roundings() {
        let mut largest = 0.0_f64;
        for [y, x] in points() {
            let expected = DoubleDouble::atan2(y.into(), x.into());
            let error = ((DoubleDouble::exactly(found(y, x))) - expected).hi().abs();
            assert!(error <= ATAN2_ERROR, "({x}, {y}): {error:e}");
            largest = largest.max(error);
        }
        // A bound that is far too large would make the bounds of shares weaker than need be.
        assert!(largest > 0.5 * ATAN2_ERROR, "{largest:e}");
    }

    #[test]
    fn axes_and_the_origin_have_their_angles() {
        use std::f64::consts::{FRAC_PI_2, PI};
        for (y, x, angle) in [
            (0.0, 1.0, 0.0),
            (0.0, 1e-300, 0.0),
            (0.0, 0.0, 0.0),
            (1.0, 0.0, FRAC_PI_2),
            (-1.0, 0.0, -FRAC_PI_2),
            (0.0, -1.0, PI),
        ] {
            assert_eq!(found(y, x), angle, "({x}, {y})");
        }
    }

    /// Small angles have a small relative error: the tangent of the angle is y/x.
    #[test]
    fn small_angles_keep_their_digits() {
        for y in [1e-300, 1e-100, 1e-20, 1e-9] {
            assert_eq!(found(y, 1.0), y - if y > 1e-10 { y * y * y / 3.0 } else { 0.0 });
        }
    }
}
