//! The right-hand sides of the flights of a coin and of any other rigid body, for Runge-Kutta schemes.

use dynamics::body::principal_acceleration;
use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use nalgebra::SVector;

/// The system over the state (w, x, y, z, ωx, ωy), where (w, x, y, z) is P. Rates may be in any unit; its inverse is
/// the unit of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSystem {
    /// ωz.
    rate_z: f64,
    /// q = (k - 1) ωz, the rate at which (ωx, ωy) turns in the body frame.
    q: f64,
}

impl QuaternionSystem {
    /// The system for a coin with `inertia_ratio` k = I3/I1 and spin `rate_z` = ωz.
    pub fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        Self { rate_z, q: body_precession_rate(inertia_ratio, rate_z) }
    }
}

impl OdeSystem<6> for QuaternionSystem {
    fn derivative(&self, y: &SVector<f64, 6>) -> SVector<f64, 6> {
        let &[w, x, y, z, rate_x, rate_y] = &y.data.0[0];
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(self.q, rate_x, rate_y);
        let [w, x, y, z] = half_product([w, x, y, z], [rate_x, rate_y, self.rate_z]);
        SVector::from([w, x, y, z, rate_x_dot, rate_y_dot])
    }
}

/// The system over the state (w, x, y, z, ω1, ω2, ω3) in principal axes. Rates may be in any unit; its inverse is the
/// unit of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RigidSystem {
    /// The [couplings](dynamics::RigidBody::couplings) of Euler's equations.
    couplings: [f64; 3],
}

impl RigidSystem {
    /// The system for a body with these [couplings](dynamics::RigidBody::couplings).
    pub(crate) fn new(couplings: [f64; 3]) -> Self {
        Self { couplings }
    }
}

impl OdeSystem<7> for RigidSystem {
    fn derivative(&self, y: &SVector<f64, 7>) -> SVector<f64, 7> {
        let &[w, x, y, z, first, second, third] = &y.data.0[0];
        let rates = [first, second, third];
        let [w, x, y, z] = half_product([w, x, y, z], rates);
        let [first, second, third] = principal_acceleration(self.couplings, rates);
        SVector::from([w, x, y, z, first, second, third])
    }
}

/// ½ P ⊗ (0, ω).
#[inline(always)]
fn half_product([w, x, y, z]: [f64; 4], [rate_x, rate_y, rate_z]: [f64; 3]) -> [f64; 4] {
    let (half_x, half_y, half_z) = (0.5 * rate_x, 0.5 * rate_y, 0.5 * rate_z);
    [
        -(x * half_x + y * half_y + z * half_z),
        w * half_x + y * half_z - z * half_y,
        w * half_y + z * half_x - x * half_z,
        w * half_z + x * half_y - y * half_x,
    ]
}
