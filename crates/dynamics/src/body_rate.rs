//! Euler's equations of the free coin (1) and what they conserve.
//!
//! In the body frame, with I1 = I2, k = I3/I1 and q = (k - 1) ωz:
//!
//! ```text
//! ωx' = -q ωy,   ωy' = q ωx,   ωz' = 0.                                                                  (1)
//! ```
//!
//! The rates never read the attitude. Their solution (2)-(4) is a turn of (ωx, ωy) by q t; it stands in
//! the crate `exact`, on which no integrator can depend.

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

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate and its transverse derivative, in an arbitrary unit, of a coin with I1 = 2 and I3 = 3.
    const RATE: Vector3<f64> = Vector3::new(0.5, -1.5, 4.0);

    fn coin() -> Coin {
        Coin::from_moments(2.0, 3.0).unwrap()
    }

    /// (1) as Euler has it: I ω' = I ω × ω, in each component.
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
