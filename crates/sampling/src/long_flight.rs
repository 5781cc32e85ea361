//! This file computes the probability of heads in the limit of a long flight, and the launch that has a wanted
//! probability. In this limit the probability does not depend on the distribution of the speed, so that a formula gives
//! it.
//!
//! Over many turns the phase ωL t becomes uniform. Let ψ be the angle between the coin's normal n and its angular
//! momentum S, and φ the angle between S and the vertical. Then cos θ = cos φ cos ψ + sin φ sin ψ cos(phase) is
//! positive with the probability
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

/// The probability p of heads for the angles `cone` = ψ and `momentum_tilt` = φ (rad), each from 0 to π.
pub fn long_flight_probability(cone: f64, momentum_tilt: f64) -> f64 {
    let along = cone.cos() * momentum_tilt.cos();
    let across = cone.sin() * momentum_tilt.sin();
    // atan2 keeps the digits near p = 1 that asin of a ratio near 1 would lose. If `second_side` is 0, p is 1 or 0.
    let second_side = ((across - along) * (across + along)).max(0.0).sqrt();
    0.5 + along.atan2(second_side) / PI
}

/// The angle ψ (rad) between n and S of a launch from horizontal whose long flights land heads with `probability`.
///
/// It is ψ = acot √sin(π (p - ½)), from 90° for p = ½ to 45° for p = 1, where every smaller angle has p = 1 too.
///
/// # Errors
/// [`InputError::OutOfRange`] for a probability below ½ or above 1, which no launch from horizontal has.
pub fn long_flight_cone(probability: f64) -> Result<f64, InputError> {
    require("probability", probability, "at least 1/2, at most 1", (0.5..=1.0).contains(&probability))?;
    Ok(1f64.atan2(cotangent(probability)))
}

/// The ratio Ω/ωz of a launch from horizontal whose long flights land heads with `probability`, for a coin with the
/// inertia ratio `k`. Ω = √(ωx² + ωy²).
///
/// It is Ω/ωz = k tan ψ, with ψ from [`long_flight_cone`]. For p = 1 it is k; every smaller ratio has p = 1 too.
///
/// # Errors
/// [`InputError::OutOfRange`] for a probability of ½, which needs ωz = 0, and for one below ½ or above 1, which no
/// launch from horizontal has; and for a rod (k = 0), which has no other than ½.
pub fn rate_ratio(probability: f64, k: f64) -> Result<f64, InputError> {
    require("probability", probability, "above 1/2, at most 1", probability > 0.5 && probability <= 1.0)?;
    require_turning_momentum(k)?;
    Ok(k / cotangent(probability))
}

/// # Errors
/// [`InputError::OutOfRange`] for a rod, k = 0: ψ is 90° at any rate, so that its long flights land heads half the time.
pub(crate) fn require_turning_momentum(k: f64) -> Result<(), InputError> {
    let valid = "> 0: the angular momentum of a rod is at 90° to its axis at any rate, so that P(heads) is 1/2";
    require("inertia ratio I3/I1", k, valid, k > 0.0).map(|_| ())
}

/// cot ψ = √sin(π (p - ½)), for p from ½ to 1, where the difference p - ½ is exact in f64.
fn cotangent(probability: f64) -> f64 {
    (PI * (probability - 0.5)).sin().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ratio_of_rates_has_the_wanted_probability() {
        for k in [0.5, 1.0, 1.98] {
            for probability in [0.5 + 1e-12, 0.507_696, 0.66, 0.95, 0.999, 1.0] {
                let cone = (rate_ratio(probability, k).unwrap() / k).atan();
                let found = long_flight_probability(cone, cone);
                // Just above 45°, p falls with the square root of the angle beyond 45°.
                let within = if probability == 1.0 { 1e-7 } else { 1e-12 };
                assert!((found - probability).abs() < within, "{k}, {probability}: {found}");
            }
        }
        for probability in [0.5, 0.3, 1.01, f64::NAN] {
            assert!(rate_ratio(probability, 0.5).is_err());
        }
    }

    #[test]
    fn the_cone_matches_the_reference_probabilities() {
        // p(ψ) computed with 50 digits and rounded to 16; the rounding of p changes ψ by dψ/dp times as much.
        for (degrees, probability) in [
            (50.0_f64, 0.748_644_041_020_130_9),
            (55.0, 0.663_109_352_400_508_2),
            (60.0, 0.608_173_447_969_392_7),
            (80.0, 0.509_898_232_792_768_8),
        ] {
            let (cone, found) = (degrees.to_radians(), long_flight_cone(probability).unwrap());
            let within = 1e-16 / slope(cone) + 2.0 * f64::EPSILON;
            assert!((found - cone).abs() < within, "{degrees}°: off by {:e}", found - cone);
        }
        assert_eq!(long_flight_cone(1.0), Ok(PI / 4.0));
        assert_eq!(long_flight_cone(0.5), Ok(PI / 2.0));
    }

    #[test]
    fn the_cone_has_the_wanted_probability() {
        for part in 0..1000 {
            let probability = 0.5 + 0.499 * f64::from(part) / 999.0;
            let cone = long_flight_cone(probability).unwrap();
            let found = long_flight_probability(cone, cone);
            // The effect on p of rounding the angle, and the rounding of p itself.
            let within = f64::EPSILON * (2.0 * cone * slope(cone) + 2.0);
            assert!((found - probability).abs() < within, "{probability}: off by {:e}", found - probability);
        }
    }

    #[test]
    fn rejects_probabilities_below_one_half_or_above_one() {
        for probability in [0.5_f64.next_down(), 0.0, -1.0, 1.0_f64.next_up(), f64::NAN, f64::INFINITY] {
            let error = long_flight_cone(probability).unwrap_err();
            assert!(matches!(error, InputError::OutOfRange { field: "probability", .. }), "{error}");
        }
    }

    /// |dp/dψ| = 2 cot ψ / (π sin²ψ √(1 - cot⁴ψ)) of the limit from horizontal (1/rad).
    fn slope(cone: f64) -> f64 {
        let cotangent = cone.tan().recip();
        2.0 * cotangent / (PI * cone.sin().powi(2) * (1.0 - cotangent.powi(4)).sqrt())
    }

    #[test]
    fn the_probability_of_a_tilted_momentum_matches_counted_phases() {
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
