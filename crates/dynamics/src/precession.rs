//! This file converts what can be seen of a toss into the body rate that the models take. What can be seen is the rate
//! at which the coin's normal n turns about the angular momentum S, and the angle ψ between the two.
//!
//! In the body frame S = I1 (ωx, ωy, k ωz), so that |S|/I1 = ωL gives Ω = √(ωx² + ωy²) = ωL sin ψ and ωz = ωL cos ψ/k.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::coin::Coin;
use crate::error::{InputError, require};

/// The body rate (BF, rad/s) of a coin whose normal turns about the angular momentum at `turn` = |S|/I1 ≥ 0 (rad/s) and
/// is at the angle `psi` = ψ to it, from 0 to π (rad). Its part across the normal is put along the body's x axis.
/// Fails for a number outside its range, and for a rod with I3 = 0, whose spin does not follow from ψ.
pub fn rate_of_precession(coin: &Coin, turn: f64, psi: f64) -> Result<Vector3<f64>, InputError> {
    require("turn [rad/s]", turn, "finite and >= 0", turn >= 0.0)?;
    require("psi [rad]", psi, "0 to π; degrees have their unit, as in 15deg", (0.0..=PI).contains(&psi))?;
    if coin.i3() == 0.0 {
        let why =
            "a rod with I3 = 0 has no angular momentum along its normal, so that its spin does not follow from it";
        return Err(InputError::OutsideModel { field: "psi [rad]", why });
    }
    let (sin, cos) = psi.sin_cos();
    Ok(Vector3::new(turn * sin, 0.0, turn * cos / coin.inertia_ratio()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angular_momentum_has_the_size_and_the_angle_that_were_asked_for() {
        for coin in [Coin::PAPER, Coin::DISC, Coin::from_moments(3.0, 4.0).unwrap()] {
            for psi in [0.0, 0.3, 1.5, 2.0, PI] {
                let rate = rate_of_precession(&coin, 40.0, psi).unwrap();
                let momentum = Vector3::new(rate.x, rate.y, coin.inertia_ratio() * rate.z);
                assert!((momentum.norm() - 40.0).abs() < 1e-13 && rate.x >= 0.0);
                assert!((momentum.z / 40.0 - psi.cos()).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn what_no_coin_does_is_refused() {
        let rod = Coin::from_moments(1.0, 0.0).unwrap();
        for (coin, turn, psi, field) in [
            (Coin::PAPER, -1.0, 1.0, "turn [rad/s]"),
            (Coin::PAPER, f64::NAN, 1.0, "turn [rad/s]"),
            (Coin::PAPER, 1.0, -0.1, "psi [rad]"),
            (Coin::PAPER, 1.0, 3.2, "psi [rad]"),
            (rod, 1.0, 1.0, "psi [rad]"),
        ] {
            assert_eq!(rate_of_precession(&coin, turn, psi).unwrap_err().field(), field);
        }
    }
}
