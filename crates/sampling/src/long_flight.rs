//! The probability of heads in the limit of a long flight.
//!
//! Over many turns the phase ωL t is uniform, and with ψ the angle between n and S, φ the angle between S and the
//! vertical, cos θ = cos φ cos ψ + sin φ sin ψ cos(phase) is positive for the share
//!
//! ```text
//! p = ½ + asin(cot φ cot ψ)/π,   1 or 0 where |cot φ cot ψ| ≥ 1.
//! ```
//!
//! From horizontal φ = ψ: p(ψ) = ½ + asin(cot²ψ)/π for 45° ≤ ψ ≤ 135°, else 1. Source: P. Diaconis, S. Holmes and
//! R. Montgomery, "Dynamical bias in the coin toss", SIAM Review 49 (2007), 211.

use std::f64::consts::PI;

use dynamics::InputError;
use dynamics::error::require;

/// p for the angles `cone` = ψ and `momentum_tilt` = φ (rad), each from 0 to π.
pub fn long_flight_probability(cone: f64, momentum_tilt: f64) -> f64 {
    let along = cone.cos() * momentum_tilt.cos();
    let across = cone.sin() * momentum_tilt.sin();
    if across <= along.abs() {
        return if along > 0.0 { 1.0 } else { 0.0 };
    }
    // atan2 keeps the digits near p = 1 that asin of a ratio near 1 loses.
    0.5 + along.atan2(((across - along) * (across + along)).sqrt()) / PI
}

/// The ratio Ω/ωz of a launch from horizontal whose long flights land heads with `probability`, for a coin with the
/// inertia ratio `k`: cot²ψ = sin(π (p - ½)) and tan ψ = Ω/(k ωz). For p = 1 it is the largest such ratio, at ψ = 45°.
///
/// # Errors
/// [`InputError::OutOfRange`] for a probability that no launch from horizontal has: ½ needs ωz = 0, and none has less.
pub fn rate_ratio(probability: f64, k: f64) -> Result<f64, InputError> {
    require("probability", probability, "above 1/2, at most 1", probability > 0.5 && probability <= 1.0)?;
    Ok(k / (PI * (probability - 0.5)).sin().sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ratio_of_rates_has_the_probability_that_was_asked_for() {
        for k in [0.5, 1.0, 1.98] {
            for probability in [0.5 + 1e-12, 0.507_696, 0.66, 0.95, 0.999, 1.0] {
                let cone = (rate_ratio(probability, k).unwrap() / k).atan();
                let found = long_flight_probability(cone, cone);
                // Near p = 1 it falls with the square root of the angle beyond 45°.
                let within = if probability == 1.0 { 1e-7 } else { 1e-12 };
                assert!((found - probability).abs() < within, "{k}, {probability}: {found}");
            }
        }
        for probability in [0.5, 0.3, 1.01, f64::NAN] {
            assert!(rate_ratio(probability, 0.5).is_err());
        }
    }

    #[test]
    fn a_tilted_momentum_agrees_with_counting_phases() {
        for (cone, tilt) in [(1.0_f64, 1.2_f64), (0.4, 2.0), (2.5, 0.9), (1.4, 1.4), (0.3, 0.3), (0.3, 3.0)] {
            let phases = 100_000;
            let heads = (0..phases)
                .map(|i| 2.0 * PI * (f64::from(i) + 0.5) / f64::from(phases))
                .filter(|phase| cone.cos() * tilt.cos() + cone.sin() * tilt.sin() * phase.cos() > 0.0)
                .count();
            let share = heads as f64 / f64::from(phases);
            assert!((long_flight_probability(cone, tilt) - share).abs() < 2e-5, "{cone}, {tilt}: {share}");
        }
    }
}
