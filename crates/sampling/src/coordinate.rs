//! This file names the coordinates that can vary from launch to launch: ωx, ωy, ωz, v0, g, the tilt and the drop; or in place of the
//! rates the turn and the angle ψ of the precession. Files, messages and charts each need a name of their own for them, and
//! all of these are kept together here.

use std::fmt;
use std::str::FromStr;

use dynamics::error::find_named;
use dynamics::{Dimension, InputError};

/// A coordinate of a space of launches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coordinate {
    /// ωx at launch (body frame, rad/s).
    RateX,
    /// ωy at launch (body frame, rad/s).
    RateY,
    /// ωz at launch, about the coin's normal (body frame, rad/s).
    RateZ,
    /// v0, the upward speed at launch (m/s).
    Speed,
    /// g, gravity (m/s²).
    Gravity,
    /// Angle by which the coin is turned about the x axis of the laboratory frame at launch (rad).
    Tilt,
    /// The rate |S|/I1 at which the normal n turns about the angular momentum S (rad/s), in place of the rates.
    Turn,
    /// The angle ψ between n and S, with the turn (rad).
    Psi,
    /// How far below its launch the coin lands (m). A coin without one is caught at the height of its launch.
    Drop,
}

/// Writes the [name](Coordinate::name).
impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Finds a coordinate by its name.
impl FromStr for Coordinate {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        Self::named(name)
    }
}

impl Coordinate {
    /// Number of coordinates.
    pub const COUNT: usize = 9;

    /// All coordinates, in the order in which a space stores them.
    pub const ALL: [Self; Self::COUNT] = [
        Self::RateX,
        Self::RateY,
        Self::RateZ,
        Self::Speed,
        Self::Gravity,
        Self::Tilt,
        Self::Turn,
        Self::Psi,
        Self::Drop,
    ];

    /// Those that may stand in place of the rates.
    pub const OF_PRECESSION: [Self; 2] = [Self::Turn, Self::Psi];

    /// The coordinates that every launch has, whether its rates are given or follow from a precession.
    pub const OF_LAUNCH: [Self; 6] = [Self::RateX, Self::RateY, Self::RateZ, Self::Speed, Self::Gravity, Self::Tilt];

    /// The name in files, such as `rate_x`.
    pub fn name(self) -> &'static str {
        ["rate_x", "rate_y", "rate_z", "speed", "gravity", "tilt", "turn", "psi", "drop"][self as usize]
    }

    /// The coordinate called `name`, which may also be written as the option of the command line, such as `rate-x`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] with the list of known names.
    pub fn named(name: &str) -> Result<Self, InputError> {
        Self::named_in("coordinate", name)
    }

    /// As [`Coordinate::named`], for a `field` of its own.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] that names `field`.
    pub fn named_in(field: &'static str, name: &str) -> Result<Self, InputError> {
        let by_option = Self::ALL.into_iter().find(|of| of.name().replace('_', "-") == name);
        by_option.map_or_else(|| find_named(field, name, &Self::ALL, |of| of.name()).copied(), Ok)
    }

    /// The name and unit in messages, such as `rate x [rad/s]`.
    pub fn field(self) -> &'static str {
        match self {
            Self::RateX => "rate x [rad/s]",
            Self::RateY => "rate y [rad/s]",
            Self::RateZ => "rate z [rad/s]",
            Self::Speed => "speed [m/s]",
            Self::Gravity => "gravity [m/s²]",
            Self::Tilt => "tilt [rad]",
            Self::Turn => "turn [rad/s]",
            Self::Psi => "psi [rad]",
            Self::Drop => "drop [m]",
        }
    }

    /// The kind of quantity that it is, which decides the units that its values may be typed with.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::RateX | Self::RateY | Self::RateZ | Self::Turn => Dimension::TurnRate,
            Self::Speed => Dimension::Speed,
            Self::Gravity => Dimension::Acceleration,
            Self::Tilt | Self::Psi => Dimension::Angle,
            Self::Drop => Dimension::Length,
        }
    }

    /// The symbol and unit on charts, such as `ωx/(rad/s)`.
    pub fn symbol(self) -> &'static str {
        [
            "ωx/(rad/s)",
            "ωy/(rad/s)",
            "ωz/(rad/s)",
            "v0/(m/s)",
            "g/(m/s²)",
            "tilt/rad",
            "turn/(rad/s)",
            "ψ/rad",
            "drop/m",
        ][self as usize]
    }

    /// The text that ties another rate to this one: `x`, `y` or `z`. Other coordinates cannot have ties.
    pub(crate) fn letter(self) -> &'static str {
        self.name().trim_start_matches("rate_")
    }

    /// The rate that a tie written as `letter` (x, y or z) refers to.
    pub(crate) fn tied_to(letter: &str) -> Option<Self> {
        match letter {
            "x" => Some(Self::RateX),
            "y" => Some(Self::RateY),
            "z" => Some(Self::RateZ),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fields_and_symbols_agree_in_name_and_unit() {
        for of in Coordinate::ALL {
            assert_eq!((Coordinate::named(of.name()), of.to_string().parse()), (Ok(of), Ok(of)));
            assert_eq!(Coordinate::named(&of.name().replace('_', "-")), Ok(of));
            let (name, unit) = of.field().split_once(' ').expect("a name and a unit");
            assert!(of.name().starts_with(name), "{of:?}");
            assert!(unit.ends_with(&format!("[{}]", of.dimension().units()[0].name())), "{of:?}");
            let (symbol, unit_on_charts) = of.symbol().split_once('/').expect("a symbol and a unit");
            assert!(!symbol.is_empty(), "{of:?}");
            let bare = unit_on_charts.trim_start_matches('(').trim_end_matches(')');
            assert!(unit.ends_with(&format!("[{bare}]")), "{of:?}: {unit}, {unit_on_charts}");
        }
        let unknown = Coordinate::named_in("up", "rate x").unwrap_err().to_string();
        assert_eq!(
            unknown,
            "up = 'rate x' is unknown; known: rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop"
        );
    }
}
