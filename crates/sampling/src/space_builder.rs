//! This file builds a space axis by axis. Each axis is given by the name of its coordinate, and the space is checked as
//! a whole at the end.

use dynamics::time_of_flight::DEFAULT_GRAVITY;
use dynamics::{Body, InputError};

use crate::axis::Axis;
use crate::coordinate::Coordinate;
use crate::space::{AxisOrTie, Space, require_tie};

/// A builder of a [`Space`], with a method for the axis of each coordinate.
#[derive(Debug, Clone)]
#[must_use]
pub struct SpaceBuilder {
    body: Body,
    axes: [Option<AxisOrTie>; Coordinate::COUNT],
}

impl SpaceBuilder {
    /// Sets the axis of the coordinate `of`.
    pub fn axis(mut self, of: Coordinate, axis: impl Into<Axis>) -> Self {
        self.axes[of as usize] = Some(AxisOrTie::Axis(axis.into()));
        self
    }

    /// Sets the body rate ωx (rad/s): a value, a range, or any other [`Axis`].
    pub fn rate_x(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::RateX, axis)
    }

    /// Sets the body rate ωy (rad/s).
    pub fn rate_y(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::RateY, axis)
    }

    /// Sets the body rate ωz about the coin's normal (rad/s).
    pub fn rate_z(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::RateZ, axis)
    }

    /// Sets the upward speed v0 (m/s).
    pub fn speed(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::Speed, axis)
    }

    /// Sets gravity (m/s²). It is 9.81 if it is not given.
    pub fn gravity(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::Gravity, axis)
    }

    /// Sets the angle by which the coin is turned about the x axis of the laboratory frame at launch (rad). It is 0 if
    /// it is not given.
    pub fn tilt(self, axis: impl Into<Axis>) -> Self {
        self.axis(Coordinate::Tilt, axis)
    }

    /// Ties the rate `of` to the rate `to`, which has an axis of its own: both have the same value.
    pub fn tie(mut self, of: Coordinate, to: Coordinate) -> Self {
        self.axes[of as usize] = Some(AxisOrTie::SameAs(to));
        self
    }

    /// Ties ωy to ωx.
    pub fn tie_rate_y_to_x(self) -> Self {
        self.tie(Coordinate::RateY, Coordinate::RateX)
    }

    /// Sets the coordinate `of` from a text: `x`, `y` or `z` for a tie to that rate, else an [`Axis`].
    ///
    /// # Errors
    /// [`InputError::Malformed`] that names `of`.
    pub fn parse(self, of: Coordinate, text: &str) -> Result<Self, InputError> {
        Ok(match Coordinate::tied_to(text.trim()) {
            Some(other) => self.tie(of, other),
            None => {
                let axis = Axis::parse(of, text.trim())?;
                self.axis(of, axis)
            }
        })
    }

    /// Checks the axes and makes the space.
    ///
    /// # Errors
    /// [`InputError`] that names the coordinate (or the time of flight), for
    /// - an invalid axis, or speeds that may be negative or gravities that may not be positive,
    /// - times of flight beyond the range of f64,
    /// - a tie to anything but a rate with an axis of its own,
    /// - a rate or a speed that is not given.
    pub fn build(mut self) -> Result<Space, InputError> {
        for (of, default) in [(Coordinate::Gravity, DEFAULT_GRAVITY), (Coordinate::Tilt, 0.0)] {
            self.axes[of as usize].get_or_insert(AxisOrTie::Axis(Axis::fixed(default)));
        }
        // Checked before missing coordinates, because naming the tie is clearer than naming its missing partner.
        for of in Coordinate::ALL {
            if let Some(AxisOrTie::SameAs(other)) = self.axes[of as usize] {
                require_tie(of, other, matches!(self.axes[other as usize], Some(AxisOrTie::Axis(_))))?;
            }
        }
        let is_given = |of: &Coordinate| self.axes[*of as usize].is_some();
        let (rates, precession) = (&Coordinate::ALL[..3], Coordinate::OF_PRECESSION);
        let turns = precession.iter().any(is_given);
        if let Some(rate) = rates.iter().find(|rate| turns && is_given(rate)) {
            let expected = "either rates, or a turn with psi";
            return Err(InputError::Malformed { field: rate.field(), value: "given twice".to_owned(), expected });
        }
        let needed = if turns { &precession[..] } else { rates };
        if let Some(of) = needed.iter().chain(&[Coordinate::Speed]).find(|of| !is_given(of)) {
            return Err(InputError::Missing { field: of.field(), expected: "a value, a range or a tie" });
        }
        Space::new(self.body, self.axes)
    }
}

impl Space {
    /// A builder of a space of launches of `body`, a coin or any other; see [`SpaceBuilder`].
    ///
    /// ```
    /// use dynamics::Coin;
    /// use sampling::{Axis, Space};
    ///
    /// let space = Space::builder(Coin::PAPER)
    ///     .rate_x(0.0..=50.0)
    ///     .tie_rate_y_to_x()
    ///     .rate_z(Axis::normal(30.0, 2.0))
    ///     .speed(Axis::range(3.0..=5.0).with_points(500))
    ///     .build()?;
    /// assert_eq!(space.free().count(), 3);
    /// # Ok::<(), dynamics::InputError>(())
    /// ```
    pub fn builder(body: impl Into<Body>) -> SpaceBuilder {
        SpaceBuilder { body: body.into(), axes: [None; Coordinate::COUNT] }
    }

    /// Makes a space from texts, such as those of the command line and of files; see [`SpaceBuilder::parse`].
    ///
    /// # Errors
    /// As [`SpaceBuilder::build`].
    pub fn parse(body: impl Into<Body>, texts: &[(Coordinate, &str)]) -> Result<Self, InputError> {
        texts.iter().try_fold(Self::builder(body), |builder, (of, text)| builder.parse(*of, text))?.build()
    }
}
