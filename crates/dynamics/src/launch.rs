//! [`Launch`]: the body rate ω, the attitude Q0 and the time of flight T of a body that leaves the hand.

use nalgebra::Vector3;
use numerics::{DoubleDouble, Quantity, UNIT_ROUNDOFF, Unit};

use crate::attitude::Attitude;
use crate::error::{InputError, require};
use crate::state::State;
use crate::time_of_flight::TimeOfFlight;

/// How the coin leaves the hand. Every number in it is finite, since no constructor makes any other launch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Launch {
    rate: Vector3<f64>,
    /// The rate as it was given, where that was not in rad/s.
    given_rate: Option<(Vector3<f64>, Unit)>,
    attitude: Attitude,
    time_of_flight: TimeOfFlight,
    /// T (s), stored because every flight needs it.
    flight_time: f64,
}

impl Launch {
    /// A launch from horizontal with heads up, with the body rate `rate` (BF, the body frame; rad/s), as a vector or as an
    /// array. Fails with [`InputError::OutOfRange`] for a component of the rate that is not finite, and for an
    /// impossible time of flight (see [`TimeOfFlight`] for the valid ranges).
    #[inline]
    pub fn new(rate: impl Into<Vector3<f64>>, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        let rate = rate.into();
        for (field, value) in [("rate x [rad/s]", rate.x), ("rate y [rad/s]", rate.y), ("rate z [rad/s]", rate.z)] {
            require(field, value, "finite", true)?;
        }
        // A speed or a time of -0 is valid, and is 0.
        let flight_time = time_of_flight.validated_seconds()? + 0.0;
        Ok(Self { rate, given_rate: None, attitude: Attitude::IDENTITY, time_of_flight, flight_time })
    }

    /// As [`Launch::new`], with the body rate in a `unit` of angle per second.
    pub fn in_unit(
        rate: impl Into<Vector3<f64>>,
        unit: Unit,
        time_of_flight: TimeOfFlight,
    ) -> Result<Self, InputError> {
        let rate = rate.into();
        let launch = Self::new(rate.map(|part| unit.times(part).to_f64()), time_of_flight)?;
        Ok(Self { given_rate: (unit != Unit::ONE).then_some((rate, unit)), ..launch })
    }

    /// A launch with the attitude and the body rate of `state`, to continue a flight.
    pub fn from_state(state: &State, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        Ok(Self::new(state.rate, time_of_flight)?.with_attitude(state.attitude))
    }

    /// The same launch with another time of flight. The body rate stays as it was given, in its unit. Fails with
    /// [`InputError::OutOfRange`] for an impossible time of flight.
    pub fn with_time_of_flight(self, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        // As in `new`, -0 is 0.
        let flight_time = time_of_flight.validated_seconds()? + 0.0;
        Ok(Self { time_of_flight, flight_time, ..self })
    }

    /// The same launch with this attitude (from BF to LF, the laboratory frame).
    #[must_use]
    pub fn with_attitude(self, attitude: Attitude) -> Self {
        Self { attitude, ..self }
    }

    /// The same launch with the horizontal coin turned by `tilt` about the x axis of LF (α = γ = 0, β = `tilt`). An f64 is in
    /// radians. Fails with [`InputError::OutOfRange`] if `tilt` is not finite.
    pub fn with_tilt(self, tilt: impl Into<Quantity>) -> Result<Self, InputError> {
        let tilt = tilt.into();
        require("tilt [rad]", tilt.to_f64(), "finite", true)?;
        Ok(self.with_attitude(Attitude::about_x(tilt)))
    }

    /// ω at launch as it was given, and in which unit of angle per second.
    #[inline]
    pub fn given_rate(&self) -> (Vector3<f64>, Unit) {
        self.given_rate.unwrap_or((self.rate, Unit::ONE))
    }

    /// ω at launch (BF, rad/s) as it was given: without an error if that was in rad/s, else to 16 u² of each component, with
    /// u = 2^-53, as far as none of its digits is below the range of f64. The leading parts are those of [`Launch::rate`].
    #[inline]
    pub fn exact_rate(&self) -> [DoubleDouble; 3] {
        match self.given_rate {
            None => <[f64; 3]>::from(self.rate).map(DoubleDouble::exactly),
            Some((rate, unit)) => <[f64; 3]>::from(rate).map(|part| unit.times(part).double_double()),
        }
    }

    /// ω at launch (BF, rad/s), to rounding where it was given in another unit. `<[f64; 3]>::from` makes an array of it.
    pub fn rate(&self) -> Vector3<f64> {
        self.rate
    }

    /// Bound of the relative error of [`Launch::rate`]: 0 if it was given in rad/s, and infinite where it may have lost
    /// digits below the range of f64.
    #[inline]
    pub fn rate_error(&self) -> f64 {
        const SLOWEST: f64 = 1e-200;
        match self.given_rate {
            None => 0.0,
            Some(_) if self.rate.amax() >= SLOWEST => 1.01 * UNIT_ROUNDOFF,
            Some(_) => f64::INFINITY,
        }
    }

    /// |ω| (rad/s), computed without the overflow of a sum of squares.
    pub fn turn_rate(&self) -> f64 {
        self.rate.x.hypot(self.rate.y).hypot(self.rate.z)
    }

    /// Attitude at launch.
    pub fn attitude(&self) -> Attitude {
        self.attitude
    }

    /// The turn about the x axis of LF (rad) by which the launch is tilted, 0 for a horizontal one; `None` for other
    /// attitudes.
    pub fn tilt(&self) -> Option<f64> {
        let horizontal = (self.attitude == Attitude::IDENTITY).then_some(0.0);
        self.attitude.tilt().map(Quantity::to_f64).or(horizontal)
    }

    /// How the time of flight was given.
    pub fn time_of_flight(&self) -> TimeOfFlight {
        self.time_of_flight
    }

    /// The time of flight T (s).
    #[inline]
    pub fn flight_time(&self) -> f64 {
        self.flight_time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error is judged by the rate in twice the digits.
    #[test]
    fn the_rate_is_within_its_error_of_what_was_given() {
        let unit = Unit::DEGREE;
        let degrees = |rate: [f64; 3]| Launch::in_unit(rate, unit, TimeOfFlight::Given(1.0)).unwrap();
        for size in [1e-190, 1.0, 12.3, 1e200] {
            let launch = degrees([size, -0.7 * size, 0.31 * size]);
            for (rounded, exact) in launch.rate().iter().zip(launch.exact_rate()) {
                let off = (exact - (*rounded).into()).hi().abs() / rounded.abs();
                assert!(off <= launch.rate_error() && launch.rate_error() < 2f64.powi(-52), "{off:e}");
            }
        }
        assert_eq!(degrees([1e-310, 0.0, 0.0]).rate_error(), f64::INFINITY);
        assert_eq!(Launch::new([1e-310, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap().rate_error(), 0.0);
    }
}
