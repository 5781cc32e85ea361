//! A toss as an integrator wants it: dimensionless, and known to be short enough to mean something.
//!
//! With σ the power of two at or below the largest component of ω, the rates are ω/σ and the time is σ t, so that
//! dy/d(σ t) = f(y) has neither large nor tiny numbers. The phase max(ωL, |q|) T is at most 2^53.

use nalgebra::{SVector, Vector3};
use numerics::scale::power_of_two_scale;

use crate::error::SolveError;
use crate::integrate::{OdeSystem, integrate};
use crate::launch::Toss;
use crate::phase::RoughPhases;
use crate::solver::Work;
use crate::stepping::{Stepping, tightened};

/// Above this phase (rad) the tolerance of the steps is tightened in proportion. The errors of the steps add up in |ω|,
/// and the phase adds up those of |ω|, so that the error at landing grows like tolerance × phase², with a factor of 0.14
/// in the worst case that was met. Tightened, it stays below 100 × tolerance × phase, the [error
/// estimate](Stepping::error_estimate).
const LONG_FLIGHT: f64 = 100.0;

/// The flight of a toss with its rates divided by a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// ω at launch (BF), divided by the scale.
    pub rate: Vector3<f64>,
    /// ωz (rad/s), which never changes; kept apart because a tiny one would lose digits below the scale.
    rate_z: f64,
    scale: f64,
    duration: f64,
    /// How far the motion turns (rad).
    phase: f64,
}

impl Flight {
    /// The flight of `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        let duration = toss.launch.flight_time();
        let launched = toss.launch.rate();
        let scale = power_of_two_scale(launched.amax());
        let rate = launched / scale;
        let phase = RoughPhases::dimensionless(toss.coin.inertia_ratio(), &rate, duration * scale).largest()?;
        Ok(Self { rate, rate_z: launched.z, scale, duration, phase })
    }

    /// Follows `system`, whose rates are in the flight's unit, from `start` to landing; see [`integrate`]. The tolerance of
    /// `stepping` is divided by the phase in units of 100 rad, where that is above 1.
    ///
    /// # Errors
    /// As [`integrate`].
    pub fn integrate<const N: usize>(
        &self,
        system: &impl OdeSystem<N>,
        start: SVector<f64, N>,
        stepping: &Stepping,
    ) -> Result<(SVector<f64, N>, Work), SolveError> {
        let stepping = stepping.tightened(self.phase / LONG_FLIGHT);
        integrate(system, start, self.duration, self.scale, &stepping)
    }

    /// Dimensionless time from launch to landing.
    pub fn span(&self) -> f64 {
        self.duration * self.scale
    }

    /// A dimensionless time in seconds.
    pub fn in_seconds(&self, time: f64) -> f64 {
        time / self.scale
    }

    /// Whether it turns so far that its tolerance is tightened.
    pub fn is_long(&self) -> bool {
        self.phase > LONG_FLIGHT
    }

    /// `tolerance` divided by the phase in units of 100 rad, where that is above 1; at least ε.
    pub fn tightened(&self, tolerance: f64) -> f64 {
        tightened(tolerance, self.phase / LONG_FLIGHT)
    }

    /// The body rate (BF, rad/s) of transverse components in the flight's unit.
    pub fn rate_at(&self, x: f64, y: f64) -> Vector3<f64> {
        Vector3::new(x * self.scale, y * self.scale, self.rate_z)
    }

    /// The error of a landing that is not finite.
    pub fn not_finite(&self) -> SolveError {
        SolveError::NotFinite { time: self.duration }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::scheme::Scheme;
    use crate::time_of_flight::TimeOfFlight;

    fn flight(rate: [f64; 3], time: f64) -> Flight {
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time)).unwrap();
        Flight::new(&Toss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch }).unwrap()
    }

    #[test]
    fn times_and_rates_are_in_the_unit_of_the_largest_rate() {
        let flight = flight([60.0, -8.0, 0.1], 0.5);
        assert_eq!((flight.rate.x, flight.span(), flight.in_seconds(8.0)), (60.0 / 32.0, 16.0, 0.25));
        assert_eq!(flight.rate_at(1.5, -0.5), Vector3::new(48.0, -16.0, 0.1));
        assert_eq!(flight.not_finite(), SolveError::NotFinite { time: 0.5 });
    }

    /// y' = i y, in dimensionless time.
    struct Circle;

    impl OdeSystem<2> for Circle {
        fn derivative(&self, y: &SVector<f64, 2>) -> SVector<f64, 2> {
            SVector::from([-y.y, y.x])
        }
    }

    #[test]
    fn above_a_hundred_radians_the_tolerance_of_the_steps_is_tightened() {
        let stepping = Stepping::adaptive(Scheme::DOPRI5, 1e-6).unwrap();
        for (time, tightened) in [(50.0, 1e-6), (100.0, 1e-6), (400.0, 0.25e-6)] {
            let flight = flight([1.0, 0.0, 0.0], time);
            assert_eq!(flight.is_long(), time > 100.0);
            let start = SVector::from([1.0, 0.0]);
            let by = Stepping::adaptive(Scheme::DOPRI5, tightened).unwrap();
            assert_eq!(flight.integrate(&Circle, start, &stepping), integrate(&Circle, start, time, 1.0, &by));
        }
    }
}
