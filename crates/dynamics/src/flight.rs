//! A toss as an integrator wants it: dimensionless, and known to be short enough to mean something.

use nalgebra::{SVector, Vector3};

use crate::error::SolveError;
use crate::exact::ExactMotion;
use crate::integrate::{OdeSystem, integrate};
use crate::launch::Toss;
use crate::method::Method;
use crate::scale::power_of_two_scale;
use crate::solver::Work;

/// Above this phase (rad) the tolerance of the steps is tightened in proportion. The errors of the steps add up in |ω|,
/// and the phase adds up those of |ω|, so that the error at landing grows like tolerance × phase², with a factor of 0.14
/// in the worst case that was met. Tightened, it stays below 100 × tolerance × phase, which [`Method::resolution`] answers
/// for.
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
        let phase = ExactMotion::new(toss).phase(duration)?;
        let rate = toss.launch.rate();
        let scale = power_of_two_scale(&rate);
        Ok(Self { rate: rate / scale, rate_z: rate.z, scale, duration, phase })
    }

    /// Follows `system`, whose rates are in the flight's unit, from `start` to landing; see [`integrate`]. The tolerance of
    /// `method` is divided by the phase in units of 100 rad, where that is above 1.
    ///
    /// # Errors
    /// As [`integrate`].
    pub fn integrate<const N: usize>(
        &self,
        system: &impl OdeSystem<N>,
        start: SVector<f64, N>,
        method: &Method,
    ) -> Result<(SVector<f64, N>, Work), SolveError> {
        let method = method.tightened(self.phase / LONG_FLIGHT);
        integrate(system, start, self.duration, self.scale, &method)
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
