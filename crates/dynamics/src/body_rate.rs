//! Euler's equations of the free coin (1) and what they conserve.
//!
//! In the body frame, with I1 = I2, k = I3/I1 and q = (k - 1) ωz:
//!
//! ```text
//! ωx' = -q ωy,   ωy' = q ωx,   ωz' = 0.                                                                  (1)
//! ```
//!
//! The rates never read the attitude. Their solution (2)-(4) is a turn of (ωx, ωy) by q t; it stands in
//! [`crate::exact`], and no numerical solver may use it.

use nalgebra::Vector3;

use crate::coin::Coin;
use crate::state::State;

/// q = (k - 1) ωz, the rate at which (ωx, ωy) turns in the body frame (rad/s), (2)-(4).
pub fn body_precession_rate(inertia_ratio: f64, rate_z: f64) -> f64 {
    (inertia_ratio - 1.0) * rate_z
}

/// Euler's equations (1): (ωx', ωy') (rad/s²) from (ωx, ωy) (rad/s) and q (rad/s).
pub fn transverse_acceleration(q: f64, rate_x: f64, rate_y: f64) -> (f64, f64) {
    (-q * rate_y, q * rate_x)
}

/// Angular momentum S of a coin with body rate `rate` (BF, kg m²/s). |S| is conserved.
pub fn angular_momentum(coin: &Coin, rate: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(coin.i1() * rate.x, coin.i1() * rate.y, coin.i3() * rate.z)
}

/// Angular momentum S of a moving coin (TF, kg m²/s). Conserved as a vector.
pub fn angular_momentum_tf(coin: &Coin, state: &State) -> Vector3<f64> {
    state.attitude.body_to_lab(&angular_momentum(coin, &state.rate))
}

/// Kinetic energy of the rotation (J). Conserved.
pub fn kinetic_energy(coin: &Coin, rate: &Vector3<f64>) -> f64 {
    0.5 * rate.dot(&angular_momentum(coin, rate))
}
