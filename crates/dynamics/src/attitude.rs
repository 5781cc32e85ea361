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
//!
//! An attitude keeps what it was made from, a tilt or the components of a quaternion, because the rounding of the unit
//! quaternion can change which face lands up. [`Attitude::vertical`] and its exact forms start from there.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numerics::big::exactly;
use numerics::scale::power_of_two_scale;
use numerics::{Angle, Big, DoubleDouble, Number};

use crate::error::{InputError, require};

/// Attitude of BF in LF as a unit quaternion. See the conventions of [this module](self).
///
/// Two attitudes are equal if they were made from the same numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    quaternion: UnitQuaternion<f64>,
    origin: Origin,
}

/// What an attitude was made from, exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Origin {
    /// From its quaternion as it is.
    Quaternion,
    /// From a quaternion of any norm but 0.
    Components([f64; 4]),
    /// By a turn about x.
    Tilt {
        /// The angle.
        angle: Angle,
        /// Its sine and cosine, to 2^-68.
        sin_cos: [DoubleDouble; 2],
    },
}

impl Attitude {
    /// Horizontal with heads up: the axes of BF are those of LF.
    pub const IDENTITY: Self = Self::of(UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.0, 0.0, 0.0)));

    /// The attitude of a quaternion as it is.
    const fn of(quaternion: UnitQuaternion<f64>) -> Self {
        Self { quaternion, origin: Origin::Quaternion }
    }

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
        if [x, y, z] == [0.0; 3] && w > 0.0 {
            return Ok(Self::IDENTITY);
        }
        let unit = Self::of(UnitQuaternion::new_normalize(Quaternion::new(w / size, x / size, y / size, z / size)));
        let is_unit = unit.components() == wxyz;
        Ok(if is_unit { unit } else { Self { origin: Origin::Components(wxyz), ..unit } })
    }

    /// A turn by a finite `angle` about the lab's x axis; an f64 is in radians.
    pub fn about_x(angle: impl Into<Angle>) -> Self {
        let angle = angle.into();
        if angle.is_zero() {
            return Self::IDENTITY;
        }
        let (sin, cos) = (0.5 * angle.radians()).sin_cos();
        let quaternion = UnitQuaternion::new_unchecked(Quaternion::new(cos, sin, 0.0, 0.0));
        Self { quaternion, origin: Origin::Tilt { angle, sin_cos: angle.sin_cos() } }
    }

    /// A turn by `angle` (rad) about z, the same axis in LF and in BF before the turn.
    pub fn about_z(angle: f64) -> Self {
        Self::about_unit_axis(&Vector3::z(), (0.5 * angle).sin_cos())
    }

    /// A turn about the unit vector `axis`, given by the sine and the cosine of half its angle.
    pub fn about_unit_axis(axis: &Vector3<f64>, (sin, cos): (f64, f64)) -> Self {
        Self::of(UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, axis * sin)))
    }

    /// Half a turn about the unit vector `axis`: the pure quaternion (0, axis).
    pub fn half_turn(axis: &Vector3<f64>) -> Self {
        Self::of(UnitQuaternion::new_unchecked(Quaternion::from_imag(*axis)))
    }

    /// Components (w, x, y, z) of the unit quaternion, to rounding.
    pub fn components(&self) -> [f64; 4] {
        let q = self.quaternion.quaternion();
        [q.w, q.i, q.j, q.k]
    }

    /// The turn about the lab's x axis that it was made by, if it was.
    pub fn tilt(&self) -> Option<Angle> {
        if let Origin::Tilt { angle, .. } = self.origin { Some(angle) } else { None }
    }

    /// Components (w, x, y, z) of the quaternion that it was made from, of any norm; of one made by a tilt, those of the
    /// unit quaternion.
    pub fn given_components(&self) -> [f64; 4] {
        if let Origin::Components(given) = self.origin { given } else { self.components() }
    }

    /// The lab's vertical in BF times |q|², and |q|², of the quaternion q that the attitude was made from. With u = 2^-53
    /// it is right to 2u |q|² in x and y, to 3u |q|² in z. For an attitude made by a tilt, |q|² is 1.
    #[inline]
    pub fn vertical(&self) -> ([f64; 3], f64) {
        match self.origin {
            Origin::Tilt { sin_cos: [sin, cos], .. } => ([0.0, sin.hi(), cos.hi()], 1.0),
            Origin::Quaternion => vertical_in_body(self.components()),
            Origin::Components(given) => vertical_in_body(in_a_power_of_two(given)),
        }
    }

    /// The lab's vertical in BF to 2^-67, as a unit vector.
    pub fn exact_vertical(&self) -> [DoubleDouble; 3] {
        let (vertical, norm) = match self.origin {
            Origin::Tilt { sin_cos: [sin, cos], .. } => return [DoubleDouble::ZERO, sin, cos],
            Origin::Quaternion if *self == Self::IDENTITY => return [0.0, 0.0, 1.0].map(DoubleDouble::from),
            Origin::Quaternion => vertical_in_body(self.components().map(DoubleDouble::from)),
            Origin::Components(given) => vertical_in_body(in_a_power_of_two(given).map(DoubleDouble::from)),
        };
        vertical.map(|part| part / norm)
    }

    /// As [`Attitude::vertical`], exactly, or for an attitude made by a tilt to so many binary `digits`. What is 0 is 0.
    pub fn vertical_in_digits(&self, digits: usize) -> ([Big; 3], Big) {
        match self.origin {
            Origin::Tilt { angle, .. } => {
                let [sin, cos] = angle.sin_cos_in_digits(digits);
                ([exactly(0.0), sin, cos], exactly(1.0))
            }
            Origin::Quaternion | Origin::Components(_) => vertical_in_body(self.given_components().map(exactly)),
        }
    }

    /// As [`Attitude::exact_vertical`], after a quarter of a turn about the lab's x axis.
    pub fn exact_quarter_turned_vertical(&self) -> [DoubleDouble; 3] {
        let (vertical, norm) = match self.origin {
            Origin::Tilt { sin_cos: [sin, cos], .. } => return [DoubleDouble::ZERO, cos, -sin],
            Origin::Quaternion => vertical_in_body(quarter_turned(self.components().map(DoubleDouble::from))),
            Origin::Components(given) => {
                vertical_in_body(quarter_turned(in_a_power_of_two(given).map(DoubleDouble::from)))
            }
        };
        vertical.map(|part| part / norm)
    }

    /// As [`Attitude::vertical_in_digits`], after a quarter of a turn about the lab's x axis.
    pub fn quarter_turned_vertical_in_digits(&self, digits: usize) -> ([Big; 3], Big) {
        if self.tilt().is_some() {
            let ([zero, sin, cos], norm) = self.vertical_in_digits(digits);
            return ([zero, cos, -sin], norm);
        }
        vertical_in_body(quarter_turned(self.given_components().map(exactly)))
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
        self.quaternion.transform_vector(body)
    }

    /// The components in BF of the vector `lab`, which is given in LF.
    pub fn lab_to_body(&self, lab: &Vector3<f64>) -> Vector3<f64> {
        self.quaternion.inverse_transform_vector(lab)
    }

    /// The inverse turn.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self::of(self.quaternion.inverse())
    }

    /// Angle of the turn from `self` to `other` (rad), between 0 and π.
    pub fn angle_to(&self, other: &Self) -> f64 {
        let turn = (self.inverse() * *other).quaternion;
        2.0 * turn.imag().norm().atan2(turn.w.abs())
    }
}

/// The quaternion (1, 1, 0, 0) q, of √2 times the norm of q: a quarter of a turn about the lab's x axis after q.
fn quarter_turned<N: Number>([w, x, y, z]: [N; 4]) -> [N; 4] {
    [w.clone() - x.clone(), w + x, y.clone() - z.clone(), y + z]
}

/// Components divided by a power of two near the largest of them, so that no square over- or underflows that counts.
#[inline]
fn in_a_power_of_two(components: [f64; 4]) -> [f64; 4] {
    let largest = components.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    let unit = power_of_two_scale(largest);
    components.map(|part| part / unit)
}

/// The vertical as seen in BF times |q|², and |q|², for a quaternion q = (w, x, y, z) that need not be of norm 1.
///
/// The vertical in BF is the third row of the direction cosine matrix. The components may be any kind of number.
#[inline(always)]
fn vertical_in_body<N: Number>([w, x, y, z]: [N; 4]) -> ([N; 3], N) {
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
        Self::of(UnitQuaternion::new_normalize(self.quaternion.quaternion() * body_turn.quaternion.quaternion()))
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
    #[test]
    fn the_vertical_in_the_body_is_normalised_in_double_double() {
        let given = [[0.3, -0.7, 0.5, 0.4], [3e200, 7e200, -5e200, 4e200], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]];
        let attitudes = given.map(|components| Attitude::from_components(components).unwrap());
        for attitude in attitudes.into_iter().chain([Attitude::about_x(2.5), Attitude::about_z(1.0)]) {
            let vertical = attitude.exact_vertical();
            let rounded = Vector3::from(vertical.map(DoubleDouble::hi));
            approx::assert_abs_diff_eq!(rounded, attitude.lab_to_body(&Vector3::z()), epsilon = 1e-15);
            let square = vertical.into_iter().fold(DoubleDouble::ZERO, |sum, part| sum + part * part);
            assert!((square - 1.0.into()).hi().abs() < 1e-20, "{square:?}");
            let (rough, norm) = attitude.vertical();
            approx::assert_abs_diff_eq!(Vector3::from(rough) / norm, rounded, epsilon = 1e-15);
            let (exact, norm) = attitude.vertical_in_digits(100);
            for (exact, found) in exact.iter().zip(vertical) {
                let error =
                    exact / norm.clone().with_precision(100).value() - exactly(found.hi()) - exactly(found.lo());
                assert!(error.to_f64().value().abs() < 1e-20, "{attitude:?}");
            }
        }
    }

    /// What a product rounds is not what was given.
    #[test]
    fn an_attitude_keeps_what_it_was_made_from() {
        let tilted = Attitude::about_x(0.7);
        assert_eq!((tilted.tilt(), Attitude::about_x(0.0)), (Some(0.7.into()), Attitude::IDENTITY));
        let given = [0.3, -0.7, 0.5, 0.4];
        assert_eq!(Attitude::from_components(given).unwrap().given_components(), given);
        assert_eq!((tilted * tilted).tilt(), None);
        assert_ne!(Attitude::from_components(tilted.components()).unwrap(), tilted);
        assert_eq!(Attitude::from_components([4.0, 0.0, 0.0, 0.0]), Ok(Attitude::IDENTITY));
    }
}
