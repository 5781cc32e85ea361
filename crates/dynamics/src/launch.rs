//! The launch: body rate ω, attitude Q0 and time of flight T when the coin leaves the hand.

use nalgebra::Vector3;
use numerics::{Angle, AngleUnit};
use serde::{Deserialize, Serialize};

use crate::attitude::Attitude;
use crate::coin::Coin;
use crate::error::{InputError, require};
use crate::state::State;
use crate::time_of_flight::TimeOfFlight;

/// What the hand gives the coin. Every component is finite; no other launch can be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Launch {
    rate: Vector3<f64>,
    /// The rate as it was given, where that was not in rad/s.
    given_rate: Option<(Vector3<f64>, AngleUnit)>,
    attitude: Attitude,
    time_of_flight: TimeOfFlight,
    /// T (s), which every flight needs.
    flight_time: f64,
}

impl Launch {
    /// A launch from horizontal, heads up (attitude = identity), with the body rate `rate` (BF, rad/s).
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a component of the rate that is not finite or a time of flight that makes no
    /// sense.
    #[inline]
    pub fn new(rate: Vector3<f64>, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        for (field, value) in [("rate x [rad/s]", rate.x), ("rate y [rad/s]", rate.y), ("rate z [rad/s]", rate.z)] {
            require(field, value, "finite", true)?;
        }
        let flight_time = time_of_flight.validated_seconds()?;
        Ok(Self { rate, given_rate: None, attitude: Attitude::IDENTITY, time_of_flight, flight_time })
    }

    /// As [`Launch::new`], with the body rate in a `unit` of angle per second.
    ///
    /// # Errors
    /// As [`Launch::new`].
    pub fn in_unit(rate: Vector3<f64>, unit: AngleUnit, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        let launch = Self::new(rate.map(|part| unit.times(part).radians()), time_of_flight)?;
        Ok(Self { given_rate: (unit != AngleUnit::RADIAN).then_some((rate, unit)), ..launch })
    }

    /// The launch that goes on from `state`.
    ///
    /// # Errors
    /// As [`Launch::new`].
    pub fn from_state(state: &State, time_of_flight: TimeOfFlight) -> Result<Self, InputError> {
        Ok(Self::new(state.rate, time_of_flight)?.with_attitude(state.attitude))
    }

    /// The same launch from another attitude (body to LF).
    #[must_use]
    pub fn with_attitude(self, attitude: Attitude) -> Self {
        Self { attitude, ..self }
    }

    /// The same launch from a coin turned by `tilt` about the lab's x axis (α = γ = 0, β = `tilt`); an f64 is in radians.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if `tilt` is not finite.
    pub fn with_tilt(self, tilt: impl Into<Angle>) -> Result<Self, InputError> {
        let tilt = tilt.into();
        require("tilt [rad]", tilt.radians(), "finite", true)?;
        Ok(self.with_attitude(Attitude::about_x(tilt)))
    }

    /// ω at launch as it was given, and in which unit of angle per second.
    #[inline]
    pub fn given_rate(&self) -> (Vector3<f64>, AngleUnit) {
        self.given_rate.unwrap_or((self.rate, AngleUnit::RADIAN))
    }

    /// ω at launch (BF, rad/s), to rounding where it was given in another unit.
    pub fn rate(&self) -> Vector3<f64> {
        self.rate
    }

    /// |ω| (rad/s), which does not overflow where a sum of squares would.
    pub fn turn_rate(&self) -> f64 {
        self.rate.x.hypot(self.rate.y).hypot(self.rate.z)
    }

    /// Attitude at launch.
    pub fn attitude(&self) -> Attitude {
        self.attitude
    }

    /// How the time of flight was given.
    pub fn time_of_flight(&self) -> TimeOfFlight {
        self.time_of_flight
    }

    /// T (s).
    #[inline]
    pub fn flight_time(&self) -> f64 {
        self.flight_time
    }
}

/// A coin and its launch: all that a flight depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Toss {
    /// The coin; [`Coin::PAPER`] where data does not say.
    #[serde(default = "Coin::paper")]
    pub coin: Coin,
    /// Its launch.
    pub launch: Launch,
}
