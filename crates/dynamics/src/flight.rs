//! [`Flight`], a toss in dimensionless form for the integrators. Absolute tolerances then mean the same for slow and
//! fast coins, and no intermediate number overflows.
//!
//! Let σ be the power of two at or below the largest component of the body rate ω. Rates are divided by σ and times are
//! multiplied by σ, so that integrators solve dy/d(σ t) = f(y). A flight whose phase max(ωL, |q|) T exceeds 2^53 rad is
//! refused (ωL is the rate of the precession, q the rate at which ω turns in the body frame, T the time of flight).

#[cfg(feature = "integrators")]
use nalgebra::SVector;
use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;

use crate::error::SolveError;
#[cfg(feature = "integrators")]
use crate::integrate::{OdeSystem, Span, integrate_within};
use crate::launch::Launch;
use crate::phase::RoughPhases;
#[cfg(feature = "integrators")]
use crate::solver::Work;
#[cfg(any(feature = "integrators", doc))]
use crate::stepping::Stepping;
use crate::stepping::{LONG_FLIGHT, tightened};
use crate::toss::CoinToss;

/// The flight of a toss, with its rates divided by σ, a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// ω at launch (BF, the body frame), divided by σ.
    pub rate: Vector3<f64>,
    /// ωz (rad/s), which never changes. It is stored undivided, because a tiny ωz/σ may underflow and lose digits.
    rate_z: f64,
    /// σ (rad/s).
    scale: f64,
    /// T (s).
    duration: f64,
    /// The larger one of ωL T and |q| T (rad).
    phase: f64,
}

impl Flight {
    /// The dimensionless flight of `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] if the phase exceeds 2^53 rad.
    pub fn new(toss: &CoinToss) -> Result<Self, SolveError> {
        Self::turning_by(&toss.launch, |rate, time| {
            RoughPhases::dimensionless(toss.coin.inertia_ratio(), rate, time).largest()
        })
    }

    /// The flight from `launch`, with the phase (rad) that follows from the dimensionless rate and time.
    pub(crate) fn turning_by(
        launch: &Launch,
        phase: impl FnOnce(&Vector3<f64>, f64) -> Result<f64, SolveError>,
    ) -> Result<Self, SolveError> {
        let (launched, duration) = (launch.rate(), launch.flight_time());
        let scale = power_of_two_scale(launched.amax());
        let rate = launched / scale;
        let phase = phase(&rate, duration * scale)?;
        Ok(Self { rate, rate_z: launched.z, scale, duration, phase })
    }

    /// Integrates `system`, whose rates are in units of σ, from `start` to landing; see
    /// [`integrate`](crate::integrate::integrate). For a [long](Self::is_long) flight the tolerance is
    /// [tightened](Self::tightened), and no step turns by more than the system's
    /// [largest turn](OdeSystem::LARGEST_TURN).
    ///
    /// # Errors
    /// As [`integrate`](crate::integrate::integrate).
    #[cfg(feature = "integrators")]
    pub fn integrate<const N: usize, S: OdeSystem<N>>(
        &self,
        system: &S,
        start: SVector<f64, N>,
        stepping: &Stepping,
    ) -> Result<(SVector<f64, N>, Work), SolveError> {
        let stepping = stepping.tightened(self.phase / LONG_FLIGHT);
        integrate_within(system, start, self.span_of::<N, S>(), &stepping)
    }

    /// The time of an integration, with the longest step that the system allows.
    #[cfg(feature = "integrators")]
    fn span_of<const N: usize, S: OdeSystem<N>>(&self) -> Span {
        let longest = S::LARGEST_TURN / self.phase * self.span();
        Span { duration: self.duration, scale: self.scale, longest }
    }

    /// Dimensionless time σ T from launch to landing.
    pub fn span(&self) -> f64 {
        self.duration * self.scale
    }

    /// The dimensionless `time` σ t converted to t (s).
    pub fn in_seconds(&self, time: f64) -> f64 {
        time / self.scale
    }

    /// The phase (rad): of a coin the [largest](RoughPhases::largest), of another body how far it turns at most.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Whether the phase exceeds 100 rad, so that the tolerance is tightened.
    pub fn is_long(&self) -> bool {
        self.phase > LONG_FLIGHT
    }

    /// `tolerance` divided by phase/100, but at least ε = 2^-52. Flights of at most 100 rad keep their tolerance.
    pub fn tightened(&self, tolerance: f64) -> f64 {
        tightened(tolerance, self.phase / LONG_FLIGHT)
    }

    /// The body rate (BF, rad/s) whose transverse components are `x` and `y` in units of σ.
    pub fn rate_at(&self, x: f64, y: f64) -> Vector3<f64> {
        Vector3::new(x * self.scale, y * self.scale, self.rate_z)
    }

    /// The body rate (BF, rad/s) that is `rate` in units of σ.
    pub(crate) fn in_rad_per_s(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        rate * self.scale
    }

    /// The error for a landing state that is not finite.
    pub fn not_finite(&self) -> SolveError {
        SolveError::NotFinite { time: self.duration }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coin::Coin;
    use crate::integrate::integrate;
    use crate::launch::Launch;
    use crate::scheme::Scheme;
    use crate::time_of_flight::TimeOfFlight;

    fn flight(rate: [f64; 3], time: f64) -> Flight {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Flight::new(&CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch }).unwrap()
    }

    #[test]
    fn rates_are_divided_and_times_multiplied_by_the_power_of_two() {
        let flight = flight([60.0, -8.0, 0.1], 0.5);
        assert_eq!((flight.rate.x, flight.span(), flight.in_seconds(8.0)), (60.0 / 32.0, 16.0, 0.25));
        assert_eq!(flight.rate_at(1.5, -0.5), Vector3::new(48.0, -16.0, 0.1));
        assert_eq!(flight.in_rad_per_s(&Vector3::new(1.5, -0.5, 0.25)), Vector3::new(48.0, -16.0, 8.0));
        assert_eq!(flight.not_finite(), SolveError::NotFinite { time: 0.5 });
    }

    /// y' = i y, a turn by the dimensionless time.
    struct Circle;

    impl OdeSystem<2> for Circle {
        fn derivative(&self, y: &SVector<f64, 2>) -> SVector<f64, 2> {
            SVector::from([-y.y, y.x])
        }
    }

    /// y' = 0, which leaves an adaptive scheme free to take any step.
    struct Rest;

    impl OdeSystem<1> for Rest {
        const LARGEST_TURN: f64 = 0.5;

        fn derivative(&self, _y: &SVector<f64, 1>) -> SVector<f64, 1> {
            SVector::zeros()
        }
    }

    #[test]
    fn no_step_turns_by_more_than_the_system_allows() {
        let stepping = Stepping::adaptive(Scheme::DOP853, 1e-6).unwrap();
        for rate in [1.0, 0.75, 60.0] {
            let (_, work) =
                flight([rate, 0.0, 0.0], 20.0 / rate).integrate(&Rest, SVector::zeros(), &stepping).unwrap();
            // 40 of half a radian, after the first ones, which grow from 1e-6.
            assert!((41..52).contains(&work.accepted_steps), "{work:?}");
        }
        let (_, work) = flight([0.0; 3], 20.0).integrate(&Rest, SVector::zeros(), &stepping).unwrap();
        assert!(work.accepted_steps < 20, "{work:?}");
        let fixed = Stepping::fixed(Scheme::RK4, 10.0).unwrap();
        let (_, work) = flight([1.0, 0.0, 0.0], 20.0).integrate(&Rest, SVector::zeros(), &fixed).unwrap();
        assert_eq!(work.accepted_steps, 2);
    }

    #[test]
    fn above_a_hundred_radians_the_tolerance_of_the_steps_is_tightened() {
        let stepping = Stepping::adaptive(Scheme::DOPRI5, 1e-6).unwrap();
        for (time, tightened) in [(50.0, 1e-6), (100.0, 1e-6), (400.0, 0.25e-6)] {
            let flight = flight([1.0, 0.0, 0.0], time);
            assert_eq!(flight.is_long(), time > 100.0);
            let start = SVector::from([1.0, 0.0]);
            let by = Stepping::adaptive(Scheme::DOPRI5, tightened).unwrap();
            approx::assert_relative_eq!(flight.tightened(1e-6), tightened, max_relative = 1e-15);
            assert_eq!(flight.integrate(&Circle, start, &stepping), integrate(&Circle, start, time, 1.0, &by));
        }
    }
}
