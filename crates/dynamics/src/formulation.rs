//! How the kinematics are set up for integration. The motion is the same in each; what differs is where the equations
//! are singular, and what happens there.

use crate::error::{InputError, find_named};

/// The frame in which Euler angles are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The transport frame with z along ±S, the angular momentum, on the side of n: S is fixed in TF, so β is constant and
    /// at most π/2, and no flight is singular.
    Momentum,
    /// The transport frame with z up, as in the paper: singular whenever n is vertical, as at every horizontal launch,
    /// which starts on the regular solution, and at each return, which is a typed error.
    Vertical,
}

/// A frame, and whether singular points are guarded. A solver reads the part that it has: the quaternion has no frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formulation {
    name: &'static str,
    frame: Frame,
    guarded: bool,
}

impl Formulation {
    /// Angles along S, guarded; quaternions are projected onto unit norm. The default.
    pub const MOMENTUM: Self = Self { name: "momentum", frame: Frame::Momentum, guarded: true };
    /// Angles in the paper's frame, guarded; quaternions as above.
    pub const VERTICAL: Self = Self { name: "vertical", frame: Frame::Vertical, guarded: true };
    /// The equations exactly as the paper prints them, with z up and nothing to guard their singular points, and the
    /// quaternion without projection. Kept to show where that fails: an answer may be wrong without an error.
    pub const RAW: Self = Self { name: "raw", frame: Frame::Vertical, guarded: false };

    /// All formulations.
    pub const ALL: [Self; 3] = [Self::MOMENTUM, Self::VERTICAL, Self::RAW];

    /// The formulation called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`].
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

    /// Whether singular points are recognised, and quaternions projected onto unit norm.
    pub const fn is_guarded(self) -> bool {
        self.guarded
    }
}

impl Default for Formulation {
    fn default() -> Self {
        Self::MOMENTUM
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulations_are_found_by_their_names() {
        for (formulation, name) in Formulation::ALL.into_iter().zip(["momentum", "vertical", "raw"]) {
            assert_eq!((formulation.name(), Formulation::named(name)), (name, Ok(formulation)));
        }
        assert_eq!(Formulation::named("spin").map_err(|error| error.field()), Err("formulation"));
        assert_eq!((Formulation::RAW.frame(), Formulation::RAW.is_guarded()), (Frame::Vertical, false));
    }
}
