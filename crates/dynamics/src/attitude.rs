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
use numerics::{Big, DoubleDouble, Number, Quantity};

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
        angle: Quantity,
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

    /// The attitude of the quaternion (w, x, y, z), which is divided by its norm. Fails with [`InputError::OutOfRange`]
    /// if the norm is zero or not finite.
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

    /// The attitude of the quaternion (w, x, y, z) as it is, without a division by its norm, which is 1 to rounding.
    pub(crate) fn from_unit_components([w, x, y, z]: [f64; 4]) -> Result<Self, InputError> {
        let quaternion = Quaternion::new(w, x, y, z);
        let norm = quaternion.norm();
        require("unit_quaternion (norm)", norm, "1 to within 1e-14", (norm - 1.0).abs() <= 1e-14)?;
        Ok(Self::of(UnitQuaternion::new_unchecked(quaternion)))
    }

    /// A turn by a finite `angle` about the lab's x axis; an f64 is in radians.
    pub fn about_x(angle: impl Into<Quantity>) -> Self {
        let angle = angle.into();
        if angle.value() == 0.0 {
            return Self::IDENTITY;
        }
        let (sin, cos) = (0.5 * angle.to_f64()).sin_cos();
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
    pub fn tilt(&self) -> Option<Quantity> {
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
        if *self == Self::IDENTITY { [0.0, 0.0, 1.0].map(DoubleDouble::from) } else { self.in_double_double(|q| q) }
    }

    /// As [`Attitude::exact_vertical`], after a quarter of a turn about the lab's x axis.
    pub fn exact_quarter_turned_vertical(&self) -> [DoubleDouble; 3] {
        match self.origin {
            Origin::Tilt { sin_cos: [sin, cos], .. } => [DoubleDouble::ZERO, cos, -sin],
            _ => self.in_double_double(quarter_turned),
        }
    }

    /// The vertical after a turn, of an attitude that was not made by a tilt.
    fn in_double_double(&self, turned: fn([DoubleDouble; 4]) -> [DoubleDouble; 4]) -> [DoubleDouble; 3] {
        let components = match self.origin {
            Origin::Tilt { sin_cos: [sin, cos], .. } => return [DoubleDouble::ZERO, sin, cos],
            Origin::Quaternion => self.components(),
            Origin::Components(given) => in_a_power_of_two(given),
        };
        let (vertical, norm) = vertical_in_body(turned(components.map(DoubleDouble::from)));
        vertical.map(|part| part / norm)
    }

    /// As [`Attitude::vertical`], exactly, or for an attitude made by a tilt to so many binary `digits`. What is 0 is 0.
    pub fn vertical_in_digits(&self, digits: usize) -> ([Big; 3], Big) {
        if let Origin::Tilt { angle, .. } = self.origin {
            let [sin, cos] = angle.sin_cos_in_digits(digits);
            return ([exactly(0.0), sin, cos], exactly(1.0));
        }
        vertical_in_body(self.given_components().map(exactly))
    }

    /// As [`Attitude::vertical_in_digits`], after a quarter of a turn about the lab's x axis.
    pub fn quarter_turned_vertical_in_digits(&self, digits: usize) -> ([Big; 3], Big) {
        if self.tilt().is_some() {
            let ([zero, sin, cos], norm) = self.vertical_in_digits(digits);
            return ([zero, cos, -sin], norm);
        }
        vertical_in_body(quarter_turned(self.given_components().map(exactly)))
    }

    /// The coin's normal n (LF), the direction of BF's z axis. Rounding takes no component beyond 1, so that its arc cosine
    /// is an angle.
    pub fn normal(&self) -> Vector3<f64> {
        self.body_to_lab(&Vector3::z()).map(|part| part.clamp(-1.0, 1.0))
    }

    /// cos θ = n · ẑ, from -1 to 1: positive when heads is up.
    pub fn cos_tilt(&self) -> f64 {
        let [w, x, y, z] = self.components();
        ((w * w + z * z) - (x * x + y * y)).clamp(-1.0, 1.0)
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
        // The squares of a turn below 1e-154 rad would be 0.
        let unit = power_of_two_scale(turn.imag().amax());
        let sine = (turn.imag() / unit).norm() * unit;
        2.0 * sine.atan2(turn.w.abs())
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
        Self::of(UnitQuaternion::new_normalize(self.quaternion.quaternion() * body_turn.quaternion.quaternion()))
    }
}

#[cfg(test)]
mod tests;
