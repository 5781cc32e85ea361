//! How far a motion turns: the phases ωL T of the precession about S and |q| T of the spin in the body.
//!
//! Phases above 2^53 rad mean nothing: neighbouring f64 inputs then differ by whole turns. Every solver refuses them by
//! [`require_phase`].

use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;

use crate::body_rate::body_precession_rate;
use crate::error::SolveError;
use crate::launch::Toss;

/// 2^53 (rad): above it, neighbouring f64 phases are more than a radian apart.
pub const LARGEST_PHASE: f64 = 9_007_199_254_740_992.0;

/// Returns `phase` (rad) if it is at most [`LARGEST_PHASE`].
///
/// # Errors
/// [`SolveError::PhaseTooLarge`], also for a phase that is not a number.
#[inline]
pub fn require_phase(phase: f64) -> Result<f64, SolveError> {
    if phase <= LARGEST_PHASE { Ok(phase) } else { Err(SolveError::PhaseTooLarge { phase }) }
}

/// The phases of a landing, right to some roundings; integrators and error estimates need no more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughPhases {
    /// ωL T (rad).
    pub precession: f64,
    /// |q| T (rad).
    pub spin: f64,
}

impl RoughPhases {
    /// The phases at the landing of `toss`.
    #[inline]
    pub fn new(toss: &Toss) -> Self {
        let rate = toss.launch.rate();
        let scale = power_of_two_scale(rate.amax());
        Self::dimensionless(toss.coin.inertia_ratio(), &(rate / scale), toss.launch.flight_time() * scale)
    }

    /// The phases after a dimensionless `time` at a dimensionless `rate` (BF), for a coin with the inertia ratio `k`.
    #[inline]
    pub(crate) fn dimensionless(k: f64, rate: &Vector3<f64>, time: f64) -> Self {
        let momentum = Vector3::new(rate.x, rate.y, k * rate.z).norm();
        // A motion without a rate has phase 0 at any time, also where the product would be 0 · ∞.
        let turned = |rate: f64| if rate == 0.0 { 0.0 } else { rate * time };
        Self { precession: turned(momentum), spin: turned(body_precession_rate(k, rate.z).abs()) }
    }

    /// The larger of both (rad): how far the motion turns. A rod in pure spin has ωL = 0 and still accumulates error.
    ///
    /// # Errors
    /// As [`require_phase`].
    #[inline]
    pub fn largest(self) -> Result<f64, SolveError> {
        require_phase(self.precession.max(self.spin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    fn phases(k: f64, rate: [f64; 3], time: f64) -> RoughPhases {
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time)).unwrap();
        RoughPhases::new(&Toss { coin: Coin::from_moments(1.0, k).unwrap(), launch })
    }

    #[test]
    fn phases_are_those_of_precession_and_spin() {
        assert_eq!(phases(0.5, [30.0, 0.0, -80.0], 2.0), RoughPhases { precession: 100.0, spin: 80.0 });
        assert_eq!(phases(1.5, [0.0; 3], 1e300), RoughPhases { precession: 0.0, spin: 0.0 });
        assert_eq!(phases(0.0, [0.0, 0.0, 1e300], 1e300), RoughPhases { precession: 0.0, spin: f64::INFINITY });
        assert_eq!(phases(0.5, [30.0, 0.0, -80.0], 2.0).largest(), Ok(100.0));
        assert_eq!(phases(0.0, [3.0, 0.0, -80.0], 2.0).largest(), Ok(160.0));
    }

    #[test]
    fn phases_above_two_to_the_53_are_refused() {
        assert_eq!(require_phase(LARGEST_PHASE), Ok(LARGEST_PHASE));
        for phase in [LARGEST_PHASE.next_up(), f64::INFINITY, f64::NAN] {
            assert!(matches!(require_phase(phase), Err(SolveError::PhaseTooLarge { .. })), "{phase}");
        }
        assert!(phases(1.0, [1.0, 0.0, 0.0], 1e16).largest().is_err());
    }
}
