//! This file defines the space of launches that a probability refers to. A space is plain data without random numbers,
//! so that all methods of sampling can be applied to the same space.
//!
//! It is a product of independent distributions, one for each of ωx, ωy, ωz, v0, g and the tilt; a rate may also be
//! tied to another rate, and then has the same value. The coin is caught at the height of its launch, T = 2 v0/g, or at a
//! fixed drop below it.

use std::fmt;

use dynamics::error::require;
use dynamics::{Body, Coin, InputError, Launch, TimeOfFlight, Toss, Vector3};

use crate::axis::Axis;
use crate::coordinate::Coordinate;

/// The values of one launch, in the order of [`Coordinate::ALL`].
pub(crate) type Values = [f64; Coordinate::COUNT];

/// The axis of a coordinate, or its tie to another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxisOrTie {
    /// The coordinate has an axis of its own.
    Axis(Axis),
    /// The coordinate has the same value as this other rate, which is not tied itself.
    SameAs(Coordinate),
}

/// The text from which [`Space::parse`] reads the same.
impl fmt::Display for AxisOrTie {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axis(axis) => axis.fmt(f),
            Self::SameAs(other) => f.write_str(other.letter()),
        }
    }
}

/// The distribution of the launches of one coin or another rigid body. Its coordinates are independent of each other, except for ties.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::space_data::SpaceData", into = "crate::space_data::SpaceData")
)]
pub struct Space {
    body: Body,
    axes: [AxisOrTie; Coordinate::COUNT],
    /// For each coordinate, the one that its value is taken from: itself, or the one that it is tied to.
    places: [Coordinate; Coordinate::COUNT],
    /// How far below the launch the coins land (m); `None` for a landing at the height of the launch.
    drop: Option<f64>,
}

impl Space {
    /// Makes and checks a space from an axis or tie for every coordinate, in the order of [`Coordinate::ALL`].
    pub(crate) fn new(body: Body, axes: [AxisOrTie; Coordinate::COUNT]) -> Result<Self, InputError> {
        let mut places = Coordinate::ALL;
        for (of, axis) in Coordinate::ALL.into_iter().zip(axes) {
            match axis {
                AxisOrTie::Axis(axis) => _ = axis.validated(of)?,
                AxisOrTie::SameAs(other) => {
                    require_tie(of, other, matches!(axes[other as usize], AxisOrTie::Axis(_)))?;
                    places[of as usize] = other;
                }
            }
        }
        let space = Self { body, axes, places, drop: None };
        let [slowest, fastest] = space.axis(Coordinate::Speed).bounds();
        let valid = "speeds >= 0 only, also 8.3 standard deviations below a normal mean";
        require(Coordinate::Speed.field(), slowest, valid, slowest >= 0.0)?;
        let [weakest, _] = space.axis(Coordinate::Gravity).bounds();
        let valid = "gravities > 0 only, also 8.3 standard deviations below a normal mean";
        require(Coordinate::Gravity.field(), weakest, valid, weakest > 0.0)?;
        // If the time of any flight overflows, that of the longest does.
        Launch::new([0.0; 3], TimeOfFlight::Ballistic { speed: fastest, gravity: weakest })?;
        Ok(space)
    }

    /// The space that consists of `toss` alone.
    ///
    /// # Errors
    /// [`InputError::Malformed`] for a time of flight that does not come from a speed, and for an attitude that is no tilt.
    pub fn of(toss: &Toss) -> Result<Self, InputError> {
        let Toss { body, launch } = toss;
        let other = |field, value, expected| InputError::Malformed { field, value, expected };
        let flight = launch.time_of_flight();
        let hand = "a speed in place of the time of flight: a hand spreads in its speed";
        let of_time = || other("time", format!("{:?}", flight.seconds()), hand);
        let [speed, gravity] = flight.throw().ok_or_else(of_time)?;
        let components = || format!("{:?}", launch.attitude().components());
        let tilt = launch.tilt().ok_or_else(|| other("attitude", components(), "a tilt about the x axis"))?;
        let [x, y, z] = launch.rate().into();
        Self::new(*body, [x, y, z, speed, gravity, tilt].map(|value| AxisOrTie::Axis(value.into())))?
            .with_drop(flight.drop())
    }

    /// The same space for another coin or body.
    #[must_use]
    pub fn with_body(self, body: impl Into<Body>) -> Self {
        Self { body: body.into(), ..self }
    }

    /// The same space for coins that land `drop` (m) below their launch, or above it if `drop` is negative.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if a coin does not reach the height of its landing, or if the time of a flight
    /// overflows.
    pub fn with_drop(self, drop: Option<f64>) -> Result<Self, InputError> {
        let [speeds, gravities] = [Coordinate::Speed, Coordinate::Gravity].map(|of| self.axis(of).bounds());
        // The lowest throw is the slowest one under the strongest gravity; the longest flight is the fastest one under
        // the weakest gravity.
        let of_slowest = |error| match error {
            InputError::OutOfRange { field: field @ "drop [m]", value, .. } if value.is_finite() => {
                InputError::OutOfRange {
                    field,
                    value,
                    valid: ">= -v0²/(2 g), the height that the slowest launch reaches; that of a normal speed is 8.3 deviations below \
                        the mean",
                }
            }
            other => other,
        };
        for (speed, gravity) in [(speeds[0], gravities[1]), (speeds[1], gravities[0])] {
            Launch::new([0.0; 3], TimeOfFlight::thrown(speed, gravity, drop)).map_err(of_slowest)?;
        }
        Ok(Self { drop, ..self })
    }

    /// How far below their launch the coins land (m); `None` for a landing at the height of the launch.
    pub fn drop(&self) -> Option<f64> {
        self.drop
    }

    /// The same space with another axis for one coordinate.
    ///
    /// # Errors
    /// As [`SpaceBuilder::build`](crate::SpaceBuilder::build).
    pub fn with_axis(self, of: Coordinate, axis: impl Into<Axis>) -> Result<Self, InputError> {
        let mut axes = self.axes;
        axes[of as usize] = AxisOrTie::Axis(axis.into());
        Self::new(self.body, axes)?.with_drop(self.drop)
    }

    /// The coin or other body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The coin; `None` for a body with I1 ≠ I2.
    pub fn coin(&self) -> Option<Coin> {
        self.body.coin()
    }

    /// The axis of a coordinate, or its tie.
    pub fn axis_or_tie(&self, of: Coordinate) -> AxisOrTie {
        self.axes[of as usize]
    }

    /// The axis that gives a coordinate its values. For a tied coordinate it is the axis of its partner.
    pub fn axis(&self, of: Coordinate) -> Axis {
        match self.axes[of as usize] {
            AxisOrTie::Axis(axis) => axis,
            AxisOrTie::SameAs(other) => self.axis(other),
        }
    }

    /// The coordinates that vary: those that are not tied and have more than one value.
    pub fn free(&self) -> impl Iterator<Item = Coordinate> {
        let own = |of: &Coordinate| matches!(self.axes[*of as usize], AxisOrTie::Axis(axis) if axis.value().is_none());
        Coordinate::ALL.into_iter().filter(own)
    }

    /// The values of the fixed coordinates. A coordinate that varies has the lower end of its range here.
    pub(crate) fn fixed_values(&self) -> Values {
        Coordinate::ALL.map(|of| self.axis(of).bounds()[0])
    }

    /// The coordinate that the value of `of` is taken from: itself, or the one that it is tied to.
    pub(crate) fn place(&self, of: Coordinate) -> Coordinate {
        self.places[of as usize]
    }

    /// The toss of the body with these values. The value of a tied coordinate is taken from its partner.
    pub(crate) fn toss(&self, values: &Values) -> Toss {
        Toss { body: self.body, launch: self.launch(values) }
    }

    /// The launch with these values. The value of a tied coordinate is taken from its partner.
    pub(crate) fn launch(&self, values: &Values) -> Launch {
        let value = |of: Coordinate| values[self.place(of) as usize];
        let rate = Vector3::new(value(Coordinate::RateX), value(Coordinate::RateY), value(Coordinate::RateZ));
        let time = TimeOfFlight::thrown(value(Coordinate::Speed), value(Coordinate::Gravity), self.drop);
        let launch = Launch::new(rate, time).expect("every axis was checked when the space was made");
        let tilt = value(Coordinate::Tilt);
        let tilted = if tilt == 0.0 { Ok(launch) } else { launch.with_tilt(tilt) };
        tilted.expect("every axis was checked when the space was made")
    }
}

/// Checks that `of` and `to` are rates and that `to` has an axis of its own.
pub(crate) fn require_tie(of: Coordinate, to: Coordinate, partner_has_an_axis: bool) -> Result<(), InputError> {
    let is_rate = |of| of <= Coordinate::RateZ;
    if is_rate(of) && is_rate(to) && partner_has_an_axis {
        return Ok(());
    }
    Err(InputError::Malformed {
        field: of.field(),
        value: to.letter().to_owned(),
        expected: "a tie of a rate to another rate that is given and not tied itself",
    })
}

/// The unit cube over some coordinates of a space. Each point of it stands for a launch, by the quantiles of the axes.
#[derive(Debug, Clone)]
pub(crate) struct Cube {
    axes: Vec<(Coordinate, Axis)>,
}

impl Cube {
    /// The cube over the coordinates `free` of `space`.
    pub(crate) fn new(space: &Space, free: impl Iterator<Item = Coordinate>) -> Self {
        Self { axes: free.map(|of| (of, space.axis(of))).collect() }
    }

    pub(crate) fn dimensions(&self) -> usize {
        self.axes.len()
    }

    /// The coordinate and axis of each dimension.
    pub(crate) fn axes(&self) -> &[(Coordinate, Axis)] {
        &self.axes
    }
}

#[cfg(test)]
mod tests;
