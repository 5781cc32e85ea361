//! This file converts what can be seen of a toss into the body rate that the models take. What can be seen is the rate
//! at which the coin's normal n turns about the angular momentum S, and the angle ψ between the two.
//!
//! In the body frame S = I1 (ωx, ωy, k ωz), so that |S|/I1 = ωL gives Ω = √(ωx² + ωy²) = ωL sin ψ and ωz = ωL cos ψ/k.

use std::f64::consts::PI;

use nalgebra::Vector3;
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd, sin_cos_of_half_turn};

use crate::coin::Coin;
use crate::error::{InputError, require};

/// The body rate (BF, rad/s) of a coin whose normal turns about the angular momentum at `turn` = |S|/I1 ≥ 0 (rad/s) and
/// is at the angle `psi` = ψ to it, from 0 to π (rad). Its part across the normal is put along the body's x axis.
/// Sine and cosine of ψ are off by up to 0.55 of the distance between neighbouring f64, by measurement, and the same on every
/// machine.
/// Fails for a number outside its range, and for a rod with I3 = 0, whose spin does not follow from ψ.
pub fn rate_of_precession(coin: &Coin, turn: f64, psi: f64) -> Result<Vector3<f64>, InputError> {
    require("turn [rad/s]", turn, "finite and >= 0", turn >= 0.0)?;
    require("psi [rad]", psi, "0 to π; degrees have their unit, as in 15deg", (0.0..=PI).contains(&psi))?;
    if coin.i3() == 0.0 {
        let why =
            "a rod with I3 = 0 has no angular momentum along its normal, so that its spin does not follow from it";
        return Err(InputError::OutsideModel { field: "psi [rad]", why });
    }
    let ([mut x], [mut z]) = ([0.0], [0.0]);
    SimdLevel::for_one_lane().run(Rates {
        columns: [&[coin.inertia_ratio()], &[turn], &[psi]],
        out: [std::slice::from_mut(&mut x), std::slice::from_mut(&mut z)],
    });
    Ok(Vector3::new(x, 0.0, z))
}

/// The same of many coins with the inertia ratios k > 0: writes their ωx and ωz, and ωy is 0. They have the same bits as those
/// of single coins. Returns the index of the first turn or ψ outside its range, behind which nothing is written that means
/// anything. Panics if a column does not have one entry per coin.
pub fn rates_of_precession(ratios: &[f64], turns: &[f64], psis: &[f64], out: [&mut [f64]; 2]) -> Option<usize> {
    let lengths = [ratios, turns, psis, &*out[0], &*out[1]].map(<[f64]>::len);
    assert_eq!(lengths, [ratios.len(); 5], "a column must have one entry per coin");
    SimdLevel::widest().run(Rates { columns: [ratios, turns, psis], out });
    turns.iter().zip(psis).position(|(turn, psi)| !((0.0..=f64::MAX).contains(turn) && (0.0..=PI).contains(psi)))
}

/// The kernel of the rates, with its columns and where its results go.
struct Rates<'a, 'out> {
    columns: [&'a [f64]; 3],
    out: [&'out mut [f64]; 2],
}

/// The most lanes of a register.
const LANES: usize = 8;

impl WithSimd for Rates<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let ([ratios, turns, psis], [x, z]) = (self.columns, self.out);
        for start in (0..ratios.len()).step_by(Real::<S>::LANES) {
            let end = ratios.len().min(start + Real::<S>::LANES);
            let mut tile = [[1.0; LANES]; 3];
            tile[0][..end - start].copy_from_slice(&ratios[start..end]);
            tile[1][..end - start].copy_from_slice(&turns[start..end]);
            tile[2][..end - start].copy_from_slice(&psis[start..end]);
            let [ratio, turn] = [Real::load(simd, &tile[0]), Real::load(simd, &tile[1])];
            let [sin, cos] = sin_cos_of_half_turn(Real::load(simd, &tile[2]));
            (turn * sin).store_up_to(&mut x[start..end]);
            ((turn * cos) / ratio).store_up_to(&mut z[start..end]);
        }
    }
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
    fn columns_have_the_bits_of_single_coins_at_every_simd_level() {
        let ratio = |index: usize| 2.0 / (1.0 + index as f64);
        let spread =
            |root: f64, to: f64| (0..1003).map(|index| to * (f64::from(index) * root).fract()).collect::<Vec<f64>>();
        let ratios: Vec<f64> = (0..1003).map(ratio).collect();
        let (turns, mut psis) = (spread(2f64.sqrt(), 400.0), spread(3f64.sqrt(), PI));
        psis[..5].copy_from_slice(&[0.0, PI, 0.5 * PI, 5e-324, 1e-200]);
        let (mut x, mut z) = ([0.0; 1003], [0.0; 1003]);
        assert_eq!(rates_of_precession(&ratios, &turns, &psis, [&mut x, &mut z]), None);
        for index in 0..1003 {
            let coin = Coin::from_moments(1.0, ratio(index)).unwrap();
            let single = rate_of_precession(&coin, turns[index], psis[index]).unwrap();
            assert_eq!(
                [x[index], 0.0, z[index]].map(f64::to_bits),
                <[f64; 3]>::from(single).map(f64::to_bits),
                "{index}"
            );
            let (sin, cos) = psis[index].sin_cos();
            let others = [turns[index] * sin, turns[index] * cos / ratio(index)];
            assert!(
                (x[index] - others[0]).abs() <= 4e-16 * x[index].abs()
                    && (z[index] - others[1]).abs() <= 4e-16 * z[index].abs()
            );
        }
        for level in SimdLevel::all() {
            let (mut other_x, mut other_z) = ([0.0; 1003], [0.0; 1003]);
            level.run(Rates { columns: [&ratios, &turns, &psis], out: [&mut other_x, &mut other_z] });
            assert_eq!(
                (x.map(f64::to_bits), z.map(f64::to_bits)),
                (other_x.map(f64::to_bits), other_z.map(f64::to_bits)),
                "{}",
                level.name()
            );
        }
        for (turn, psi) in [(-1.0, 1.0), (f64::INFINITY, 1.0), (1.0, f64::NAN), (1.0, PI.next_up())] {
            let (mut turns, mut psis) = (turns.clone(), psis.clone());
            (turns[700], psis[700]) = (turn, psi);
            assert_eq!(rates_of_precession(&ratios, &turns, &psis, [&mut x, &mut z]), Some(700));
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
