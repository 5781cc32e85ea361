//! This file defines the space of launches that a probability refers to. A space is plain data without random numbers,
//! so that all methods of sampling can be applied to the same space.
//!
//! It is a product of independent distributions, one for each of ωx, ωy, ωz, v0, g and the tilt; a rate may also be
//! tied to another rate, and then has the same value. In place of the rates the turn and the angle ψ of the precession may
//! have distributions, from which the rates [follow](rate_of_precession). The coin is caught at the height of its launch,
//! T = 2 v0/g, or at a drop below it, which may have a distribution, too.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use dynamics::error::require;
use dynamics::precession::rate_of_precession;
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
    /// Those that are given: the rates, or the turn and ψ; a drop or none.
    axes: [Option<AxisOrTie>; Coordinate::COUNT],
    /// For each coordinate, the one that its value is taken from: itself, or the one that it is tied to.
    places: [Coordinate; Coordinate::COUNT],
}

impl Space {
    /// Makes and checks a space from the axes and ties of the coordinates that are given, in the order of
    /// [`Coordinate::ALL`].
    pub(crate) fn new(body: Body, axes: [Option<AxisOrTie>; Coordinate::COUNT]) -> Result<Self, InputError> {
        let mut places = Coordinate::ALL;
        for (of, axis) in Coordinate::ALL.into_iter().zip(axes) {
            match axis {
                None => {}
                Some(AxisOrTie::Axis(axis)) => _ = axis.validated(of)?,
                Some(AxisOrTie::SameAs(other)) => {
                    require_tie(of, other, matches!(axes[other as usize], Some(AxisOrTie::Axis(_))))?;
                    places[of as usize] = other;
                }
            }
        }
        let space = Self { body, axes, places }.with_body(body)?;
        if space.is_of_precession() {
            let [slowest, _] = space.axis(Coordinate::Turn).bounds();
            let valid = "turns >= 0 only, also 8.3 standard deviations below a normal mean";
            require(Coordinate::Turn.field(), slowest, valid, slowest >= 0.0)?;
            for end in space.axis(Coordinate::Psi).bounds() {
                let valid = "angles from 0 to π only, also 8.3 standard deviations from a normal mean";
                require(Coordinate::Psi.field(), end, valid, (0.0..=PI).contains(&end))?;
            }
        }
        let [slowest, _] = space.axis(Coordinate::Speed).bounds();
        let valid = "speeds >= 0 only, also 8.3 standard deviations below a normal mean";
        require(Coordinate::Speed.field(), slowest, valid, slowest >= 0.0)?;
        let [weakest, _] = space.axis(Coordinate::Gravity).bounds();
        let valid = "gravities > 0 only, also 8.3 standard deviations below a normal mean";
        require(Coordinate::Gravity.field(), weakest, valid, weakest > 0.0)?;
        space.require_landings()?;
        Ok(space)
    }

    /// Checks that every coin lands, after a time in the range of f64.
    fn require_landings(&self) -> Result<(), InputError> {
        let [speeds, gravities, drops] =
            [Coordinate::Speed, Coordinate::Gravity, Coordinate::Drop].map(|of| self.axis(of).bounds());
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
        // The lowest throw is the slowest one under the strongest gravity; the longest flight is the fastest one under
        // the weakest gravity.
        for (speed, gravity, drop) in [(speeds[0], gravities[1], drops[0]), (speeds[1], gravities[0], drops[1])] {
            let time = TimeOfFlight::thrown(speed, gravity, self.drop().map(|_| drop));
            Launch::new([0.0; 3], time).map_err(of_slowest)?;
        }
        Ok(())
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
        let values = Coordinate::OF_LAUNCH.into_iter().zip([x, y, z, speed, gravity, tilt]);
        values.fold(Self::builder(*body), |space, (of, value)| space.axis(of, value)).build()?.with_drop(flight.drop())
    }

    /// The same space for another coin or body.
    ///
    /// # Errors
    /// [`InputError::OutsideModel`] for a body without a precession, in a space of turns and angles ψ.
    pub fn with_body(self, body: impl Into<Body>) -> Result<Self, InputError> {
        let space = Self { body: body.into(), ..self };
        if space.is_of_precession() {
            let why = "n of a body with I1 ≠ I2 keeps no angle to S; give the rates";
            let coin = space.coin().ok_or(InputError::OutsideModel { field: "turn", why })?;
            rate_of_precession(&coin, 0.0, 0.0)?;
        }
        Ok(space)
    }

    /// Whether the rates follow from a turn and an angle ψ.
    pub fn is_of_precession(&self) -> bool {
        self.axes[Coordinate::Turn as usize].is_some()
    }

    /// The same space for coins that land `drop` (m) below their launch, or above it if `drop` is negative; `None` for a
    /// landing at the height of the launch.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if a coin does not reach the height of its landing, or if the time of a flight
    /// overflows.
    pub fn with_drop(self, drop: Option<f64>) -> Result<Self, InputError> {
        let mut axes = self.axes;
        axes[Coordinate::Drop as usize] = drop.map(|drop| AxisOrTie::Axis(Axis::fixed(drop)));
        Self::new(self.body, axes)
    }

    /// How far below their launch the coins land (m); `None` for a landing at the height of the launch.
    pub fn drop(&self) -> Option<Axis> {
        self.axes[Coordinate::Drop as usize].map(|_| self.axis(Coordinate::Drop))
    }

    /// The same space with another axis for one coordinate.
    ///
    /// # Errors
    /// As [`SpaceBuilder::build`](crate::SpaceBuilder::build).
    pub fn with_axis(self, of: Coordinate, axis: impl Into<Axis>) -> Result<Self, InputError> {
        let mut axes = self.axes;
        axes[of as usize] = Some(AxisOrTie::Axis(axis.into()));
        Self::new(self.body, axes)
    }

    /// The coin or other body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The coin; `None` for a body with I1 ≠ I2.
    pub fn coin(&self) -> Option<Coin> {
        self.body.coin()
    }

    /// The axis of a coordinate, or its tie; `None` if it is not given, as the rates of a precession.
    pub fn axis_or_tie(&self, of: Coordinate) -> Option<AxisOrTie> {
        self.axes[of as usize]
    }

    /// The axis that gives a coordinate its values. For a tied coordinate it is the axis of its partner, and for a rate that
    /// follows from a precession the range of its values. The turn and ψ of a space of rates are 0, and so is a drop that is
    /// not given.
    pub fn axis(&self, of: Coordinate) -> Axis {
        match self.axes[of as usize] {
            Some(AxisOrTie::Axis(axis)) => axis,
            Some(AxisOrTie::SameAs(other)) => self.axis(other),
            None if self.is_of_precession() => self.range_of_rate(of),
            None => Axis::fixed(0.0),
        }
    }

    /// The range of a rate that follows from a precession, but for roundings.
    fn range_of_rate(&self, of: Coordinate) -> Axis {
        let ([slowest, fastest], psi) = (self.axis(Coordinate::Turn).bounds(), self.axis(Coordinate::Psi).bounds());
        let factors = match of {
            Coordinate::RateX if psi[0] <= FRAC_PI_2 && FRAC_PI_2 <= psi[1] => [psi[0].sin().min(psi[1].sin()), 1.0],
            Coordinate::RateX => psi.map(f64::sin),
            Coordinate::RateZ => psi.map(|psi| psi.cos() / self.coin().map_or(1.0, |coin| coin.inertia_ratio())),
            _ => return Axis::fixed(0.0),
        };
        let products = factors.map(|factor| [slowest * factor, fastest * factor]);
        let ends = products.into_iter().flatten();
        let [lo, hi] = [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)];
        if lo < hi { Axis::range(lo..=hi) } else { Axis::fixed(lo) }
    }

    /// The coordinates that vary: those that are not tied and have more than one value.
    pub fn free(&self) -> impl Iterator<Item = Coordinate> {
        let own =
            |of: &Coordinate| matches!(self.axes[*of as usize], Some(AxisOrTie::Axis(axis)) if axis.value().is_none());
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

    /// The body rate that follows from a turn and ψ; `None` in a space of rates.
    pub(crate) fn rate_of(&self, turn: f64, psi: f64) -> Option<Vector3<f64>> {
        let coin = self.coin().filter(|_| self.is_of_precession())?;
        Some(rate_of_precession(&coin, turn, psi).expect("every axis was checked when the space was made"))
    }

    /// The toss of the body with these values. The value of a tied coordinate is taken from its partner.
    pub(crate) fn toss(&self, values: &Values) -> Toss {
        Toss { body: self.body, launch: self.launch(values) }
    }

    /// The launch with these values. The value of a tied coordinate is taken from its partner.
    pub(crate) fn launch(&self, values: &Values) -> Launch {
        let value = |of: Coordinate| values[self.place(of) as usize];
        let rate = match self.rate_of(value(Coordinate::Turn), value(Coordinate::Psi)) {
            Some(rate) => rate,
            None => Vector3::new(value(Coordinate::RateX), value(Coordinate::RateY), value(Coordinate::RateZ)),
        };
        let drop = self.drop().map(|_| value(Coordinate::Drop));
        let time = TimeOfFlight::thrown(value(Coordinate::Speed), value(Coordinate::Gravity), drop);
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
