//! Euler's equations (1) of the free coin. The integrators carry ωx and ωy in their state by these equations.
//!
//! For the body rate ω in the body frame (BF), with I1 = I2, k = I3/I1 and q = (k - 1) ωz:
//!
//! ```text
//! ωx' = -q ωy,   ωy' = q ωx,   ωz' = 0.                                                                  (1)
//! ```
//!
//! The equations do not contain the attitude. Their solution (2)-(4) is a turn of (ωx, ωy) by the angle q t. It is kept
//! out of this crate, in `exact`, so that no integrator can use it.

use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;

use crate::attitude::Attitude;
use crate::toss::CoinToss;

/// q = (k - 1) ωz (rad/s): the rate at which (ωx, ωy) turns in BF by (2)-(4). `inertia_ratio` is k, `rate_z` is ωz
/// (rad/s).
pub fn body_precession_rate(inertia_ratio: f64, rate_z: f64) -> f64 {
    (inertia_ratio - 1.0) * rate_z
}

/// Euler's equations (1): (ωx', ωy') (rad/s²) from (ωx, ωy) (rad/s) and q (rad/s).
pub fn transverse_acceleration(q: f64, rate_x: f64, rate_y: f64) -> (f64, f64) {
    (-q * rate_y, q * rate_x)
}

/// The body rate at landing (BF, rad/s) of a coin that lands with `attitude`: its component along n is that of the launch,
/// and with the others the angular momentum across n is that of the launch.
pub fn rate_by_momentum(toss: &CoinToss, attitude: &Attitude) -> Vector3<f64> {
    let launched = toss.launch.rate();
    // Of the largest finite rates, a sum of two may overflow.
    let scale = power_of_two_scale(launched.amax());
    let mut momentum = launched / scale;
    momentum.z *= toss.coin.inertia_ratio();
    let landed = attitude.lab_to_body(&toss.launch.attitude().body_to_lab(&momentum));
    Vector3::new(landed.x * scale, landed.y * scale, launched.z)
}
