//! [`Flight`], a toss in dimensionless form for the integrators. Absolute tolerances then mean the same for slow and
//! fast bodies, and no intermediate number overflows.
//!
//! Let σ be the power of two at or below the largest component of the body rate ω. Rates are divided by σ and times are
//! multiplied by σ, so that integrators solve dy/d(σ t) = f(y). A flight whose [phase](crate::Phases::largest) exceeds 2^53
//! rad is refused.
//!
//! # Axes
//! A coin is integrated in the axes of the body frame (BF), any other body about its principal axes, where Euler's
//! equations are three products, and its state is turned back at the end. The axes are known in twice the precision of f64,
//! so that each turn costs one rounding. In the axes of BF each evaluation of Euler's equations would turn forth and back
//! with rounded axes, which is slower, and moves a body whose tensor is not quite the one that was given. Of a body that
//! was given by its moments, the turn exchanges components and signs, without any rounding.

#[cfg(feature = "integrators")]
use nalgebra::SVector;
use nalgebra::Vector3;
use numerics::DoubleDouble;
use numerics::scale::power_of_two_scale;

use crate::body::Body;
use crate::error::SolveError;
#[cfg(feature = "integrators")]
use crate::integrate::{OdeSystem, Span, integrate_within};
use crate::phase::largest;
#[cfg(feature = "integrators")]
use crate::solver::Work;
#[cfg(any(feature = "integrators", doc))]
use crate::stepping::Stepping;
use crate::stepping::{LONG_FLIGHT, tightened};
use crate::toss::Toss;

/// The flight of a toss, with its rates divided by σ, a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// ω at launch along the [axes](self#axes) of the integration, divided by σ.
    pub rate: Vector3<f64>,
    /// ω at launch (BF, rad/s).
    launched: Vector3<f64>,
    /// σ (rad/s).
    scale: f64,
    /// T (s).
    duration: f64,
    /// The [largest](crate::Phases::largest) phase (rad).
    phase: f64,
    /// The directions (BF) of the axes of the integration, where they are not those of BF.
    axes: Option<[[f64; 3]; 3]>,
}

impl Flight {
    /// The dimensionless flight of `toss`.
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        let (launched, duration) = (toss.launch.rate(), toss.launch.flight_time());
        let scale = power_of_two_scale(launched.amax());
        let rate = launched / scale;
        let phase = largest(&toss.body, &rate, duration * scale)?;
        let flight = Self { rate, launched, scale, duration, phase, axes: None };
        Ok(match &toss.body {
            Body::Coin(_) => flight,
            Body::Rigid(body) => {
                let principal = body.principal();
                let axes = principal.axes.map(|axis| axis.map(DoubleDouble::hi));
                Self { rate: principal.rates(&rate).into(), axes: Some(axes), ..flight }
            }
        })
    }

    /// Integrates `system`, whose rates are in units of σ, from `start` to landing; see
    /// [`integrate`](crate::integrate::integrate). For a [long](Self::is_long) flight the tolerance is
    /// [tightened](Self::tightened), and no step turns by more than the system's
    /// [largest turn](OdeSystem::LARGEST_TURN).
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

    /// The [largest](crate::Phases::largest) phase (rad).
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

    /// The `rate` (BF, rad/s) in units of σ.
    pub fn in_units(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        rate / self.scale
    }

    /// The vector (BF) with these components along the axes of the integration.
    pub fn in_body(&self, vector: [f64; 3]) -> Vector3<f64> {
        let Some([first, second, third]) = &self.axes else { return vector.into() };
        let [a, b, c] = vector;
        Vector3::from([0, 1, 2].map(|part: usize| first[part] * a + second[part] * b + third[part] * c))
    }

    /// The quaternion (w, x, y, z) in BF of a turn about the axes of the integration.
    pub fn turn_in_body(&self, [w, x, y, z]: [f64; 4]) -> [f64; 4] {
        let vector = self.in_body([x, y, z]);
        [w, vector.x, vector.y, vector.z]
    }

    /// The body rate (BF, rad/s) whose components along the axes of the integration are `rate` in units of σ. A spin of a
    /// coin, and all rates of another body, that are still those of the launch keep all their digits, also where a component
    /// underflows in units of σ.
    pub fn rate_at(&self, rate: [f64; 3]) -> Vector3<f64> {
        let found = self.in_body(rate) * self.scale;
        match self.axes {
            None if rate[2] == self.rate.z => Vector3::new(found.x, found.y, self.launched.z),
            Some(_) if rate == <[f64; 3]>::from(self.rate) => self.launched,
            _ => found,
        }
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

    fn of_body(body: impl Into<Body>, rate: [f64; 3], time: f64) -> Flight {
        Flight::new(&Toss::new(body, Launch::new(rate, TimeOfFlight::Given(time)).unwrap())).unwrap()
    }

    fn flight(rate: [f64; 3], time: f64) -> Flight {
        of_body(Coin::from_moments(1.0, 1.0).unwrap(), rate, time)
    }

    #[test]
    fn rates_are_divided_and_times_multiplied_by_the_power_of_two() {
        let flight = flight([60.0, -8.0, 0.1], 0.5);
        assert_eq!((flight.rate.x, flight.span(), flight.in_seconds(8.0)), (60.0 / 32.0, 16.0, 0.25));
        assert_eq!(flight.rate_at([1.5, -0.5, flight.rate.z]), Vector3::new(48.0, -16.0, 0.1));
        assert_eq!(flight.rate_at([1.5, -0.5, 0.25]), Vector3::new(48.0, -16.0, 8.0));
        assert_eq!(flight.in_units(&Vector3::new(48.0, -16.0, 8.0)), Vector3::new(1.5, -0.5, 0.25));
        assert_eq!(flight.turn_in_body([0.9, 0.1, 0.2, 0.3]), [0.9, 0.1, 0.2, 0.3]);
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

    #[test]
    fn moments_in_any_order_exchange_rates_without_rounding() {
        for moments in [[1.0, 2.0, 2.5], [2.0, 2.5, 1.0], [2.5, 1.0, 2.0], [2.0, 1.0, 2.5], [1.0, 2.5, 2.0]] {
            let flight = of_body(Body::from_moments(moments).unwrap(), [60.1, -8.3, 0.7], 0.5);
            let sizes = <[f64; 3]>::from(flight.rate).map(|rate| rate.abs() * 32.0);
            let mut order = [0, 1, 2];
            order.sort_by(|a: &usize, b: &usize| moments[*a].total_cmp(&moments[*b]));
            assert_eq!(sizes, order.map(|axis| [60.1, 8.3, 0.7][axis]));
            assert_eq!(flight.in_body(flight.rate.into()), flight.in_units(&flight.launched));
            assert_eq!(flight.rate_at([0.0; 3]), Vector3::zeros());
            let along = flight.in_body([0.1, 0.2, 0.3]);
            assert_eq!(flight.turn_in_body([0.9, 0.1, 0.2, 0.3]), [0.9, along.x, along.y, along.z]);
        }
    }

    #[test]
    fn rates_of_the_launch_are_returned_as_they_were_given() {
        for rate in [[1e15, 2.0, 1e-300], [1e-300, 2e-310, 5e-324], [0.0; 3]] {
            let flight = of_body(Body::from_moments([1.0, 2.0, 2.5]).unwrap(), rate, 0.5);
            assert_eq!(flight.rate_at(flight.rate.into()), Vector3::from(rate));
        }
    }
}
