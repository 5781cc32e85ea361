//! How far a coin turns in its flight: by the phase ωL T in its precession about the angular momentum S, and by |q| T
//! in its spin within the body frame. Error estimates grow with the phase, and above 2^53 rad no answer means anything.
//!
//! The symbols are those of the [crate]: ωL = |S|/I1, q = (k - 1) ωz, and T is the time of flight. Above 2^53
//! rad the phases of neighbouring f64 inputs are a radian or more apart. Every solver refuses such a toss by
//! [`require_phase`].

use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;

use crate::body::RigidBody;
use crate::body_rate::body_precession_rate;
use crate::error::SolveError;
use crate::toss::CoinToss;

/// The largest phase that solvers accept (rad), 2^53. Above it, neighbouring f64 numbers differ by 2 or more.
pub const LARGEST_PHASE: f64 = 9_007_199_254_740_992.0;

/// Returns `phase` (rad) if it is at most [`LARGEST_PHASE`].
///
/// # Errors
/// [`SolveError::PhaseTooLarge`], also if `phase` is NaN.
#[inline]
pub fn require_phase(phase: f64) -> Result<f64, SolveError> {
    if phase <= LARGEST_PHASE { Ok(phase) } else { Err(SolveError::PhaseTooLarge { phase }) }
}

/// An upper bound of the angle (rad) through which a `body` turns in a `time`, from the size of its `rate` at launch, which
/// never grows by more than [a factor](RigidBody::largest_growth_of_rate).
///
/// # Errors
/// [`SolveError::PhaseTooLarge`] if it exceeds 2^53.
pub(crate) fn turned_at_most(body: &RigidBody, rate: f64, time: f64) -> Result<f64, SolveError> {
    // Without a rate the angle is 0, also where the product would be 0 · ∞ = NaN.
    require_phase(if rate == 0.0 { 0.0 } else { body.largest_growth_of_rate() * rate * time })
}

/// The phases at landing, computed in f64 with an error of a few roundings. Integrators and error estimates need no
/// more; the exact motion computes its phases in twice the precision.
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
    pub fn new(toss: &CoinToss) -> Self {
        let rate = toss.launch.rate();
        let scale = power_of_two_scale(rate.amax());
        Self::dimensionless(toss.coin.inertia_ratio(), &(rate / scale), toss.launch.flight_time() * scale)
    }

    /// The phases after a dimensionless `time` at a dimensionless `rate` (BF), for a coin with the inertia ratio `k`.
    #[inline]
    pub(crate) fn dimensionless(k: f64, rate: &Vector3<f64>, time: f64) -> Self {
        let momentum = Vector3::new(rate.x, rate.y, k * rate.z).norm();
        // Without a rate the phase is 0, also where the product would be 0 · ∞ = NaN.
        let turned = |rate: f64| if rate == 0.0 { 0.0 } else { rate * time };
        Self { precession: turned(momentum), spin: turned(body_precession_rate(k, rate.z).abs()) }
    }

    /// The larger one of the two phases (rad), by which errors grow. The spin counts too, because a rod (k = 0) in pure
    /// spin has ωL = 0 and still accumulates errors.
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
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        RoughPhases::new(&CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch })
    }

    #[test]
    fn the_phases_are_the_rates_of_precession_and_spin_times_the_time() {
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
