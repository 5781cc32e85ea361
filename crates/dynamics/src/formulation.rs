//! [`Formulation`], the choice of how the kinematics are set up for integration. The motion is the same in each
//! formulation, but the equations are singular at other points, and the guards at these points differ.

use std::fmt;
use std::str::FromStr;

use crate::error::{InputError, find_named};

/// The frame in which Euler angles α, β, γ are taken. Both move with the centre of mass, without turning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The frame with z along S or -S, the angular momentum, on the side of the coin's normal n. S is fixed, so that β
    /// is constant and at most π/2, and no flight runs into sin β = 0.
    Momentum,
    /// The frame with z up, as in the paper. It is singular whenever n is vertical. A horizontal launch is such a
    /// point, and the integration starts there on the regular solution; a later such point is a typed error.
    Vertical,
}

/// The frame of the Euler angles, and whether singular points are guarded. The quaternion solver uses the guard only,
/// since it needs no frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formulation {
    name: &'static str,
    frame: Frame,
    guarded: bool,
}

impl Formulation {
    /// The default: angles in [`Frame::Momentum`], with guards. Quaternions are projected onto unit norm.
    pub const MOMENTUM: Self = Self { name: "momentum", frame: Frame::Momentum, guarded: true };
    /// Angles in the paper's frame, [`Frame::Vertical`], with guards. Quaternions are projected onto unit norm.
    pub const VERTICAL: Self = Self { name: "vertical", frame: Frame::Vertical, guarded: true };
    /// The equations exactly as the paper prints them, with z up and without guards; quaternions are not projected. An
    /// answer may be wrong without an error. The formulation is kept to show where and how the paper's equations fail.
    pub const RAW: Self = Self { name: "raw", frame: Frame::Vertical, guarded: false };

    /// All formulations.
    pub const ALL: [Self; 3] = [Self::MOMENTUM, Self::VERTICAL, Self::RAW];

    /// The formulation called `name`.
    pub fn named(name: &str) -> Result<Self, InputError> {
        find_named("formulation", name, &Self::ALL, |formulation| formulation.name).copied()
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// The frame of its Euler angles.
    pub const fn frame(self) -> Frame {
        self.frame
    }

    /// Whether singular points are detected and quaternions are projected onto unit norm.
    pub const fn is_guarded(self) -> bool {
        self.guarded
    }
}

impl Default for Formulation {
    fn default() -> Self {
        Self::MOMENTUM
    }
}

/// Writes the name.
impl fmt::Display for Formulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name)
    }
}

/// Finds a formulation by its name.
impl FromStr for Formulation {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        Self::named(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulations_are_found_by_their_names() {
        for (formulation, name) in Formulation::ALL.into_iter().zip(["momentum", "vertical", "raw"]) {
            assert_eq!((formulation.name(), Formulation::named(name)), (name, Ok(formulation)));
            assert_eq!((formulation.to_string().as_str(), name.parse()), (name, Ok(formulation)));
        }
        assert_eq!(Formulation::named("spin").map_err(|error| error.field()), Err("formulation"));
        assert_eq!((Formulation::RAW.frame(), Formulation::RAW.is_guarded()), (Frame::Vertical, false));
    }
}
