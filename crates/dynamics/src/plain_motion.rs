//! The exact motion in plain f64: seven times as fast as [`ExactMotion`](crate::ExactMotion), with an error that grows
//! with the phase like ½ ε φ.

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::error::SolveError;
use crate::exact::LARGEST_PHASE;
use crate::launch::Toss;
use crate::scale::power_of_two_scale;
use crate::state::State;
use crate::tilt_terms::SLOWEST_SQUARED;

/// State at landing by `Q0 ⊗ exp(½ ωL T ŝ) ⊗ exp(-½ q T ẑ)`, rounded to f64 in every operation.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
#[inline]
pub fn plain_landing(toss: &Toss) -> Result<State, SolveError> {
    let (k, rate) = (toss.coin.inertia_ratio(), toss.launch.rate());
    let unit = power_of_two_scale(&rate);
    let (x, y, z) = (rate.x / unit, rate.y / unit, rate.z / unit);
    let momentum = Vector3::new(x, y, k * z);
    // Slower than this counts as no precession, by the argument of `TiltTerms`.
    let squared = momentum.norm_squared();
    let precession = if squared < SLOWEST_SQUARED { 0.0 } else { squared.sqrt() };
    let time = unit * toss.launch.flight_time();
    // A motion without a rate has phase 0 at any time, also where the product would be 0 · ∞.
    let turned = |rate: f64| if rate == 0.0 { 0.0 } else { rate * time };
    let (phase, spin) = (turned(precession), turned((k - 1.0) * z));
    let largest = phase.max(spin.abs());
    let in_range = largest <= LARGEST_PHASE;
    if !in_range {
        return Err(SolveError::PhaseTooLarge { phase: largest });
    }
    let axis = if precession == 0.0 { Vector3::z() } else { momentum / precession };
    let turn = Attitude::about_unit_axis(&axis, (0.5 * phase).sin_cos());
    let spun = Attitude::about_unit_axis(&Vector3::z(), (-0.5 * spin).sin_cos());
    let (sin, cos) = spin.sin_cos();
    Ok(State {
        attitude: toss.launch.attitude() * turn * spun,
        rate: Vector3::new(rate.x * cos - rate.y * sin, rate.x * sin + rate.y * cos, rate.z),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coin::Coin;
    use crate::exact::ExactMotion;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    #[test]
    fn it_is_the_exact_motion_to_rounding() {
        let rates =
            [[1.0, 1.0, 2.5], [40.0, -31.0, 7.0], [0.0, 9.0, 0.0], [0.0, 0.0, 7.0], [0.0; 3], [5e-324, 0.0, 0.0]];
        for rate in rates {
            for (k, tilt) in [0.0, 0.5, 1.0, 2.0].into_iter().flat_map(|k| [0.0, 0.7, 3.0].map(|tilt| (k, tilt))) {
                let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(30.0)).unwrap();
                let toss = Toss { coin: Coin::from_moments(1.0, k).unwrap(), launch: launch.with_tilt(tilt).unwrap() };
                let (plain, motion) = (plain_landing(&toss).unwrap(), ExactMotion::new(&toss));
                let (exact, phase) = (motion.state(30.0).unwrap(), motion.phase(30.0).unwrap());
                let error = plain.attitude.angle_to(&exact.attitude);
                assert!(error < (4.0 + 2.0 * phase) * f64::EPSILON, "{rate:?} {k} {tilt}: {error:e}");
                let slip = (plain.rate - exact.rate).norm();
                assert!(slip <= (4.0 + 2.0 * phase) * f64::EPSILON * launch.turn_rate(), "{rate:?} {k}: {slip:e}");
            }
        }
    }

    #[test]
    fn a_phase_above_two_to_the_53_is_refused() {
        let launch = Launch::new(Vector3::new(0.0, 0.0, 1e300), TimeOfFlight::Given(1.0)).unwrap();
        let spinning = Toss { coin: Coin::from_moments(1.0, 0.0).unwrap(), launch };
        assert!(matches!(plain_landing(&spinning), Err(SolveError::PhaseTooLarge { .. })));
    }
}
