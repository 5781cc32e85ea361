//! The conditioning of a toss says how far its landing moves when its launch changes a little. An error that one
//! rounding of the inputs would cause is not a fault of the method, so both are reported together.

use std::panic::catch_unwind;

use anyhow::ensure;
use faer::Mat;
use serde::Serialize;
use toss::{Launch, Sensitivity, Toss};

/// Sizes of the derivative of a landing by relative changes of the launch: changes of ω are relative to |ω|, changes of
/// the time of flight to that time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Conditioning {
    /// Singular values of the attitude's derivative (rad), from the largest down. A relative change ε of the launch
    /// turns the landed coin by up to ε times the first one.
    pub attitude: [f64; 3],
    /// Norm of the derivative of cos θ, by the same relative changes.
    pub cos_tilt: f64,
}

impl Conditioning {
    /// The conditioning of `toss`; `None` if it cannot be solved, because its phase is too large or the library panics.
    ///
    /// # Errors
    /// If the singular values can't be found, which finite numbers never cause.
    pub fn new(toss: &Toss) -> anyhow::Result<Option<Self>> {
        let derivatives = catch_unwind(|| Sensitivity::new(toss).ok()).ok().flatten();
        derivatives.map(|derivatives| Self::by(&derivatives, &toss.launch)).transpose()
    }

    fn by(Sensitivity { attitude, cos_tilt }: &Sensitivity, launch: &Launch) -> anyhow::Result<Self> {
        let (rate, time) = (launch.turn_rate(), launch.flight_time());
        let unit = |column: usize| if column == 3 { time } else { rate };
        let scaled = Mat::from_fn(3, 4, |row, column| attitude[(row, column)] * unit(column));
        let values = scaled.singular_values().map_err(|error| anyhow::anyhow!("no singular values: {error:?}"))?;
        ensure!(
            values.len() == 3 && values.iter().all(|value| value.is_finite()),
            "singular values of {launch:?}: {values:?}"
        );
        let slope = |column: usize| cos_tilt[column] * unit(column);
        let cos_tilt = (0..4).map(|column| slope(column).powi(2)).sum::<f64>().sqrt();
        Ok(Self { attitude: [values[0], values[1], values[2]], cos_tilt })
    }

    /// The angle (rad) by which one rounding of the launch can turn the landed coin.
    pub fn rounding(&self) -> f64 {
        f64::EPSILON * self.attitude[0]
    }
}

#[cfg(test)]
mod tests {
    use toss::{Coin, TimeOfFlight, Vector3};

    use super::*;

    #[test]
    fn a_pure_spin_is_as_sensitive_as_its_angle_is_large() {
        // ω = (0, 0, 2) rad/s for 3 s turns by 6 rad. Relative changes of ωz and of the time have the same effect;
        // changes of ωx and ωy tip the coin over, by 6 |sin 3 / 3| rad per unit.
        let launch = Launch::new(Vector3::new(0.0, 0.0, 2.0), TimeOfFlight::Given(3.0)).unwrap();
        let sphere = Toss::new(Coin::from_moments(1.0, 1.0).unwrap(), launch);
        let found = Conditioning::new(&sphere).unwrap().unwrap();
        let tipped = 6.0 * (3.0_f64.sin() / 3.0).abs();
        for (value, expected) in found.attitude.into_iter().zip([6.0 * 2f64.sqrt(), tipped, tipped]) {
            assert!((value - expected).abs() < 1e-14, "{found:?}");
        }
        assert!(found.cos_tilt < 1e-15, "no first-order change tilts a coin that spins about the vertical");
    }
}
