//! The attitude as Euler angles α, β, γ, which the paper's equations (5)-(11) use. Two of the integrators work with
//! them and convert them from and to quaternions here.
//!
//! # Conventions
//! - Sequence z-x-z about the body's own axes: `Q = z(α) x(β) z(γ)`; α precession, β nutation, γ spin (rad).
//! - With the quaternion's halves p = w + iz and r = x + iy: `p = cos(β/2) e^{i(α+γ)/2}`,
//!   `r = sin(β/2) e^{i(α-γ)/2}`.
//! - Not unique: (α, β, γ), (α + π, -β, γ + π) and all shifts by 2π are the same attitude. This freedom allows the
//!   angles to be continuous along a motion.
//! - Singular set: sin β = 0, where only α + γ (β = 0) or α - γ (β = π) is defined.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use crate::attitude::Attitude;

/// Euler angles z-x-z (rad). See the conventions of [this module](self).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerAngles {
    /// α, precession about the z axis of TF (transport frame).
    pub alpha: f64,
    /// β, nutation: the angle between n and TF's z axis, continued past 0 and π.
    pub beta: f64,
    /// γ, spin about n.
    pub gamma: f64,
}

impl EulerAngles {
    /// The attitude that these angles describe.
    pub fn attitude(&self) -> Attitude {
        Attitude::about_z(self.alpha)
            * Attitude::about_unit_axis(&Vector3::x(), (0.5 * self.beta).sin_cos())
            * Attitude::about_z(self.gamma)
    }

    /// The angles of `attitude` with 0 ≤ β ≤ π. Where sin β = 0, that one of α + γ and α - γ that is undefined is set
    /// to 0.
    pub fn principal(attitude: &Attitude) -> Self {
        let [w, x, y, z] = attitude.components();
        let (half_sum, half_difference) = (z.atan2(w), y.atan2(x));
        Self {
            alpha: half_sum + half_difference,
            beta: 2.0 * x.hypot(y).atan2(w.hypot(z)),
            gamma: half_sum - half_difference,
        }
    }

    /// The angles of `attitude` on the branch nearest to `reference`.
    ///
    /// At sin β = 0 exactly, that one of α + γ and α - γ that is undefined is taken from the reference.
    pub fn nearest(attitude: &Attitude, reference: &Self) -> Self {
        let [w, x, y, z] = attitude.components();
        let (half_sum, cos_half_beta) = nearest_polar(w, z, 0.5 * (reference.alpha + reference.gamma));
        let (half_difference, sin_half_beta) = nearest_polar(x, y, 0.5 * (reference.alpha - reference.gamma));
        let beta = 2.0 * sin_half_beta.atan2(cos_half_beta);
        Self {
            alpha: half_sum + half_difference,
            beta: beta + TAU * ((reference.beta - beta) / TAU).round(),
            gamma: half_sum - half_difference,
        }
    }
}

/// Polar form `radius · e^{i argument}` of (re, im) whose argument is within π/2 of `reference`: the radius is negative
/// where the nearer argument belongs to the opposite point.
fn nearest_polar(re: f64, im: f64, reference: f64) -> (f64, f64) {
    let (sin, cos) = reference.sin_cos();
    let (along, across) = (re * cos + im * sin, im * cos - re * sin);
    let radius = along.hypot(across).copysign(along);
    (reference + (along.signum() * across).atan2(along.abs()), radius)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const SAMPLES: [EulerAngles; 6] = [
        EulerAngles { alpha: 0.5, beta: 9.0, gamma: -1.0 },
        EulerAngles { alpha: -2.0, beta: -20.0, gamma: 0.7 },
        EulerAngles { alpha: 0.3, beta: 1.1, gamma: -2.0 },
        EulerAngles { alpha: -7.0, beta: -0.4, gamma: 9.5 },
        EulerAngles { alpha: 2.0, beta: 5.0, gamma: 40.0 },
        EulerAngles { alpha: 1.0, beta: 3.1, gamma: 1.0 },
    ];

    #[test]
    fn principal_angles_describe_the_same_attitude() {
        for angles in SAMPLES {
            let attitude = angles.attitude();
            let principal = EulerAngles::principal(&attitude);
            assert!((0.0..=PI).contains(&principal.beta));
            assert!(principal.attitude().angle_to(&attitude) < 1e-14);
        }
    }

    #[test]
    fn nearest_angles_recover_any_branch() {
        for angles in SAMPLES {
            let off = EulerAngles { alpha: angles.alpha + 0.2, beta: angles.beta - 0.1, gamma: angles.gamma - 0.3 };
            let found = EulerAngles::nearest(&angles.attitude(), &off);
            for (a, b) in [(found.alpha, angles.alpha), (found.beta, angles.beta), (found.gamma, angles.gamma)] {
                assert!((a - b).abs() < 1e-13, "{found:?} for {angles:?}");
            }
        }
    }
}
