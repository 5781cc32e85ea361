//! This file computes the derivatives of the attitude and of cos θ at landing with respect to the launch. They tell how
//! precisely a hand must throw: how far the landing moves if a rate or the time of flight changes a little.
//!
//! The landed coin is the launched one, Q0, turned by the rotation vector Φ = T L with L = (ωx, ωy, k ωz), and then by
//! -q T about n, where q = (k - 1) ωz. Let φ = |Φ|, ŝ = L/|L|, z(α) the rotation by α about the body's z axis, `[ŝ]×`
//! the matrix of the cross product, and v the vertical in the body frame (BF) at landing. A change δω of the rate and
//! δT of the time then turns the landed coin, in BF, by
//!
//! ```text
//! δϑ = T z(qT) Jr diag(1, 1, k) δω - (k - 1) T ẑ δωz + ω(T) δT
//! Jr = 1 - (1 - cos φ)/φ [ŝ]× + (1 - sin φ/φ) [ŝ]×²          the right Jacobian of the rotation group
//! δ cos θ = (ẑ × v)·δϑ
//! ```

use dynamics::{CoinToss, SolveError};
use nalgebra::{Matrix3, Matrix3x4, Rotation3, Vector3, Vector4};

use crate::motion::CoinMotion;

/// Derivatives of a landing with respect to ωx, ωy, ωz at launch (BF, rad/s) and the time of flight (s), in this order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Derivatives of the attitude: a column for each input, the turn δϑ (BF at landing, rad) per unit of the input.
    pub attitude: Matrix3x4<f64>,
    /// Derivatives of cos θ, per unit of each input.
    pub cos_tilt: Vector4<f64>,
}

/// The derivatives of cos θ: those with respect to ωx, ωy, ωz as `rate`, and that with respect to the `time`.
#[cfg(feature = "serde")]
impl serde::Serialize for Sensitivity {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let [x, y, z, time] = <[f64; 4]>::from(self.cos_tilt);
        let mut fields = to.serialize_struct("Sensitivity", 2)?;
        fields.serialize_field("rate", &[x, y, z])?;
        fields.serialize_field("time", &time)?;
        fields.end()
    }
}

impl Sensitivity {
    /// The derivatives at the landing of the toss of a coin.
    pub(crate) fn of_coin(toss: &CoinToss) -> Result<Self, SolveError> {
        let (k, rate, time) = (toss.coin.inertia_ratio(), toss.launch.rate(), toss.launch.flight_time());
        let motion = CoinMotion::new(toss);
        let landing = motion.state(toss.launch.time_of_flight())?;
        let (_, spin) = motion.phases(toss.launch.time_of_flight())?;
        let turn = Vector3::new(rate.x, rate.y, k * rate.z) * time;
        let unspun = Rotation3::from_axis_angle(&Vector3::z_axis(), spin.hi());
        let mut by_rate = unspun * right_jacobian(&turn) * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, k)) * time;
        by_rate[(2, 2)] -= (k - 1.0) * time;
        let mut attitude = Matrix3x4::zeros();
        attitude.fixed_columns_mut::<3>(0).copy_from(&by_rate);
        attitude.set_column(3, &landing.rate);
        let vertical = landing.attitude.lab_to_body(&Vector3::z());
        Ok(Self { attitude, cos_tilt: attitude.tr_mul(&Vector3::z().cross(&vertical)) })
    }
}

/// The right Jacobian Jr at the rotation vector Φ (rad).
fn right_jacobian(turn: &Vector3<f64>) -> Matrix3<f64> {
    let phase = turn.norm();
    if phase == 0.0 {
        return Matrix3::identity();
    }
    let across = (turn / phase).cross_matrix();
    let (sin_half, sin) = ((0.5 * phase).sin(), phase.sin());
    Matrix3::identity() - across * (2.0 * sin_half * sin_half / phase) + across * across * (1.0 - sin / phase)
}
