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

#[cfg(test)]
mod tests {
    use super::*;

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
