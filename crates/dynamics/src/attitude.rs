//! The attitude of the coin, as the unit quaternion Q = (w, x, y, z) that takes a vector from the body frame (BF) to
//! the laboratory frame (LF): `v_lab = Q v_body Q*`. A quaternion has no singular attitude, and cos θ = w² + z² - x² -
//! y².
//!
//! # Conventions
//! - Algebra: Hamilton's (ij = k), scalar part first wherever components are listed: (w, x, y, z).
//! - Active: the attitude Q turns the body from the axes of LF to where it is.
//! - Composition: `a * b` turns by b about the body's own axes after a; right factors act in BF, left factors in LF.
//! - Double cover: Q and -Q are the same attitude; no function of this crate depends on the sign.
//! - Singular set: none.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numerics::Number;

use crate::error::{InputError, require};

/// Attitude of BF in LF as a unit quaternion. See the conventions of [this module](self).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude(UnitQuaternion<f64>);

impl Attitude {
    /// Horizontal with heads up: the axes of BF are those of LF.
    pub const IDENTITY: Self = Self(UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.0, 0.0, 0.0)));

    /// The attitude of the quaternion (w, x, y, z), which is divided by its norm.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if the norm is zero or not finite.
    pub fn from_components(wxyz: [f64; 4]) -> Result<Self, InputError> {
        let [w, x, y, z] = wxyz;
        // The components are divided by the largest one first, so that no square over- or underflows.
        let largest = wxyz.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        let finite = wxyz.iter().all(|part| part.is_finite());
        let size = if finite { largest } else { f64::NAN };
        require("attitude (largest component)", size, "finite and > 0", largest > 0.0)?;
        Ok(Self(UnitQuaternion::new_normalize(Quaternion::new(w / size, x / size, y / size, z / size))))
    }

    /// A turn by `angle` (rad) about the lab's x axis.
    pub fn about_x(angle: f64) -> Self {
        let (sin, cos) = (0.5 * angle).sin_cos();
        Self(UnitQuaternion::new_unchecked(Quaternion::new(cos, sin, 0.0, 0.0)))
    }

    /// A turn by `angle` (rad) about z, the same axis in LF and in BF before the turn.
    pub fn about_z(angle: f64) -> Self {
        Self::about_unit_axis(&Vector3::z(), (0.5 * angle).sin_cos())
    }

    /// A turn about the unit vector `axis`, given by the sine and the cosine of half its angle.
    pub fn about_unit_axis(axis: &Vector3<f64>, (sin, cos): (f64, f64)) -> Self {
        Self(UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, axis * sin)))
    }

    /// Half a turn about the unit vector `axis`: the pure quaternion (0, axis).
    pub fn half_turn(axis: &Vector3<f64>) -> Self {
        Self(UnitQuaternion::new_unchecked(Quaternion::from_imag(*axis)))
    }

    /// Components (w, x, y, z).
    pub fn components(&self) -> [f64; 4] {
        let q = self.0.quaternion();
        [q.w, q.i, q.j, q.k]
    }

    /// The coin's normal n (LF), the direction of BF's z axis.
    pub fn normal(&self) -> Vector3<f64> {
        self.body_to_lab(&Vector3::z())
    }

    /// cos θ = n · ẑ: positive when heads is up.
    pub fn cos_tilt(&self) -> f64 {
        let [w, x, y, z] = self.components();
        (w * w + z * z) - (x * x + y * y)
    }

    /// The components in LF of the vector `body`, which is given in BF.
    pub fn body_to_lab(&self, body: &Vector3<f64>) -> Vector3<f64> {
        self.0.transform_vector(body)
    }

    /// The components in BF of the vector `lab`, which is given in LF.
    pub fn lab_to_body(&self, lab: &Vector3<f64>) -> Vector3<f64> {
        self.0.inverse_transform_vector(lab)
    }

    /// The inverse turn.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }

    /// Angle of the turn from `self` to `other` (rad), between 0 and π.
    pub fn angle_to(&self, other: &Self) -> f64 {
        let turn = (self.inverse() * *other).0;
        2.0 * turn.imag().norm().atan2(turn.w.abs())
    }
}

/// The vertical as seen in BF times |q|², and |q|², for a quaternion q = (w, x, y, z) that need not be of norm 1.
///
/// The vertical in BF is the third row of the direction cosine matrix. The components may be any kind of number.
#[inline(always)]
pub fn vertical_in_body<N: Number>([w, x, y, z]: [N; 4]) -> ([N; 3], N) {
    let product = |a: &N, b: &N| a.clone() * b.clone();
    let twice = |half: N| half.clone() + half;
    let (upright, inverted) = (product(&w, &w) + product(&z, &z), product(&x, &x) + product(&y, &y));
    let level = [product(&x, &z) - product(&w, &y), product(&y, &z) + product(&w, &x)].map(twice);
    let [across_x, across_y] = level;
    ([across_x, across_y, upright.clone() - inverted.clone()], upright + inverted)
}

impl std::ops::Mul for Attitude {
    type Output = Self;

    fn mul(self, body_turn: Self) -> Self {
        // The product is normalised, so that rounding errors do not add up in a long chain of turns.
        Self(UnitQuaternion::new_normalize(self.0.quaternion() * body_turn.0.quaternion()))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn a_quarter_turn_about_x_takes_the_normal_to_minus_y() {
        let quarter = Attitude::about_x(FRAC_PI_2);
        approx::assert_abs_diff_eq!(quarter.normal(), -Vector3::y(), epsilon = 1e-15);
        approx::assert_abs_diff_eq!(quarter.cos_tilt(), 0.0, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(quarter.lab_to_body(&-Vector3::y()), Vector3::z(), epsilon = 1e-15);
    }

    #[test]
    fn right_factors_turn_about_the_bodys_axes() {
        let tipped_then_spun = Attitude::about_x(FRAC_PI_2) * Attitude::about_z(1.0);
        approx::assert_abs_diff_eq!(tipped_then_spun.normal(), -Vector3::y(), epsilon = 1e-15);
        let spun_then_tipped = Attitude::about_z(FRAC_PI_2) * Attitude::about_x(FRAC_PI_2);
        approx::assert_abs_diff_eq!(spun_then_tipped.normal(), Vector3::x(), epsilon = 1e-15);
    }

    #[test]
    fn the_sign_of_the_quaternion_does_not_matter() {
        let [w, x, y, z] = (Attitude::about_x(1.2) * Attitude::about_z(0.4)).components();
        let [plus, minus] = [[w, x, y, z], [-w, -x, -y, -z]].map(|q| Attitude::from_components(q).unwrap());
        assert_eq!(plus.cos_tilt(), minus.cos_tilt());
        approx::assert_abs_diff_eq!(plus.angle_to(&minus), 0.0, epsilon = 1e-15);
    }

    #[test]
    fn the_angle_between_attitudes_is_precise_for_small_and_large_turns() {
        for angle in [1e-300, 1e-12, 0.3, PI] {
            approx::assert_relative_eq!(
                Attitude::IDENTITY.angle_to(&Attitude::about_z(angle)),
                angle,
                max_relative = 1e-15
            );
        }
    }

    #[test]
    fn components_are_normalised_without_over_or_underflow() {
        for size in [1e-320, 1.0, 1e300] {
            let attitude = Attitude::from_components([size, 0.0, 0.0, size]).unwrap();
            approx::assert_abs_diff_eq!(attitude.angle_to(&Attitude::about_z(FRAC_PI_2)), 0.0, epsilon = 1e-15);
        }
        for bad in [[0.0; 4], [f64::NAN, 0.0, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0, 1.0]] {
            assert!(Attitude::from_components(bad).is_err());
        }
    }

    /// An arbitrary attitude, as components whose norm is not 1.
    const ANY: [f64; 4] = [0.3, -0.7, 0.5, 0.4];

    #[test]
    fn components_are_divided_by_their_norm() {
        let norm = ANY.iter().map(|part| part * part).sum::<f64>().sqrt();
        let found = Attitude::from_components(ANY.map(|part| 5.0 * part)).unwrap().components();
        for (found, part) in found.into_iter().zip(ANY) {
            approx::assert_abs_diff_eq!(found, part / norm, epsilon = 1e-15);
        }
    }

    #[test]
    fn the_vertical_in_the_body_comes_times_the_square_of_the_norm() {
        for components in [ANY, [0.3, 0.7, -0.5, 0.4], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]] {
            let attitude = Attitude::from_components(components).unwrap();
            let (vertical, norm) = vertical_in_body(components);
            let vertical = Vector3::from(vertical) / norm;
            approx::assert_abs_diff_eq!(vertical, attitude.lab_to_body(&Vector3::z()), epsilon = 1e-15);
        }
    }
}
