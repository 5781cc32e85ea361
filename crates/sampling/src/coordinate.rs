//! What can vary from launch to launch: ωx, ωy, ωz, v0, g and the tilt at launch.

use dynamics::InputError;
use dynamics::error::find_named;

/// A coordinate of a configuration space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coordinate {
    /// ωx, body rate (rad/s).
    RateX,
    /// ωy, body rate (rad/s).
    RateY,
    /// ωz, body rate about the normal (rad/s).
    RateZ,
    /// v0, speed of the launch (m/s).
    Speed,
    /// g (m/s²).
    Gravity,
    /// Turn of the coin about the lab's x axis at launch (rad).
    Tilt,
}

impl Coordinate {
    /// Number of coordinates.
    pub const COUNT: usize = 6;

    /// All coordinates, in the order of their places in a space.
    pub const ALL: [Self; Self::COUNT] =
        [Self::RateX, Self::RateY, Self::RateZ, Self::Speed, Self::Gravity, Self::Tilt];

    /// Its name in files, as `rate_x`.
    pub fn name(self) -> &'static str {
        ["rate_x", "rate_y", "rate_z", "speed", "gravity", "tilt"][self as usize]
    }

    /// The coordinate called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] with the list of known names.
    pub fn named(name: &str) -> Result<Self, InputError> {
        find_named("coordinate", name, &Self::ALL, |of| of.name()).copied()
    }

    /// Its name and unit in messages, as `rate x [rad/s]`.
    pub fn field(self) -> &'static str {
        ["rate x [rad/s]", "rate y [rad/s]", "rate z [rad/s]", "speed [m/s]", "gravity [m/s²]", "tilt [rad]"]
            [self as usize]
    }

    /// The symbol and unit on charts, as `ωx/(rad/s)`.
    pub fn symbol(self) -> &'static str {
        ["ωx/(rad/s)", "ωy/(rad/s)", "ωz/(rad/s)", "v0/(m/s)", "g/(m/s²)", "tilt/rad"][self as usize]
    }

    /// How a tie to it is written; only rates can be tied to.
    pub(crate) fn letter(self) -> &'static str {
        self.name().trim_start_matches("rate_")
    }

    /// The coordinate that a tie written as `letter` follows: x, y or z.
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
    fn names_symbols_and_units_belong_together() {
        for of in Coordinate::ALL {
            assert_eq!(Coordinate::named(of.name()), Ok(of));
            let (name, unit) = of.field().split_once(' ').expect("a name and a unit");
            assert!(of.name().starts_with(name), "{of:?}");
            let (symbol, unit_on_charts) = of.symbol().split_once('/').expect("a symbol and a unit");
            assert!(!symbol.is_empty(), "{of:?}");
            let bare = unit_on_charts.trim_start_matches('(').trim_end_matches(')');
            assert!(unit.ends_with(&format!("[{bare}]")), "{of:?}: {unit}, {unit_on_charts}");
        }
    }
}
