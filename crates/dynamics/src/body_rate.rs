//! Euler's equations (1) of the free coin, and the momentum and energy that they conserve. The integrators carry ωx and
//! ωy in their state by these equations, and checks compare the conserved quantities at launch and at landing.
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
use crate::coin::Coin;
use crate::state::State;
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

/// Angular momentum S of a coin with body rate `rate` (BF, kg m²/s). |S| is conserved.
pub fn angular_momentum(coin: &Coin, rate: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(coin.i1() * rate.x, coin.i1() * rate.y, coin.i3() * rate.z)
}

/// Angular momentum S of a coin in this state (TF, kg m²/s). S is conserved as a vector.
pub fn angular_momentum_tf(coin: &Coin, state: &State) -> Vector3<f64> {
    state.attitude.body_to_lab(&angular_momentum(coin, &state.rate))
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

/// Kinetic energy of the rotation (J) of a coin with body rate `rate` (BF, rad/s). It is conserved.
pub fn kinetic_energy(coin: &Coin, rate: &Vector3<f64>) -> f64 {
    0.5 * rate.dot(&angular_momentum(coin, rate))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body rate (BF) in an arbitrary unit, for the coin below.
    const RATE: Vector3<f64> = Vector3::new(0.5, -1.5, 4.0);

    /// A coin with I1 = 2 and I3 = 3.
    fn coin() -> Coin {
        Coin::from_moments(2.0, 3.0).unwrap()
    }

    /// Compares (1) with Euler's equations for any rigid body, I ω' = I ω × ω, in each component.
    #[test]
    fn the_accelerations_are_those_of_eulers_equations() {
        let torque = angular_momentum(&coin(), &RATE).cross(&RATE);
        let (x, y) = transverse_acceleration(body_precession_rate(1.5, RATE.z), RATE.x, RATE.y);
        assert_eq!((2.0 * x, 2.0 * y, 0.0), (torque.x, torque.y, torque.z));
        assert_eq!((x, y), (3.0, 1.0));
    }

    #[test]
    fn momentum_and_energy_weigh_each_rate_with_its_moment() {
        let momentum = angular_momentum(&coin(), &RATE);
        assert_eq!(momentum, Vector3::new(1.0, -3.0, 12.0));
        assert_eq!(kinetic_energy(&coin(), &RATE), 0.5 * momentum.dot(&RATE));
        assert_eq!(kinetic_energy(&coin(), &RATE), 26.5);
    }
}
