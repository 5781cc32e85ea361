//! This file lists the four methods of choosing the launches of a space that are tried. A plan is plain data: the
//! sampler carries it out, and its number of launches is known before.

use dynamics::InputError;
use dynamics::error::require;

use crate::coordinate::Coordinate;
use crate::sobol;
use crate::space::{Cube, Space};

/// Default number of independent scrambles of Sobol's sequence in an estimate.
pub const SCRAMBLES: u64 = 8;

/// The method that chooses the launches of a space that are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plan {
    /// Method A: all launches of the space's grid.
    Grid,
    /// Method B: independent random launches.
    Random {
        /// Number of launches.
        points: u64,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Owen-scrambled points of Sobol's sequence, which fill the space more evenly than random ones.
    Sobol(Scrambled),
    /// All speeds in closed form, by the exact motion; the other coordinates as in [`Rest`].
    ExactSpeed(Rest),
}

/// Why [`Plan::ExactSpeed`] is refused for a space with a drop.
const NO_DROP: InputError = InputError::OutsideModel {
    field: "drop [m]",
    why: "exact-speed integrates over the speed in closed form, which needs a landing at the height of the launch; other \
          methods take a drop",
};

/// How [`Plan::ExactSpeed`] chooses the coordinates other than the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// By the space's grid. The axis of the speed needs no number of points.
    Grid,
    /// By Owen-scrambled points of Sobol's sequence.
    Sobol(Scrambled),
}

/// A number of Sobol points, divided evenly among independent scrambles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scrambled {
    /// Number of launches of all scrambles together. The points are most even if each scramble has a power of two.
    pub points: u64,
    /// Number of scrambles. A single one gives no error estimate.
    pub scrambles: u64,
    /// Seed of the random scrambles.
    pub seed: u64,
}

impl Scrambled {
    /// `points` launches, divided among [`SCRAMBLES`] scrambles.
    pub fn new(points: u64, seed: u64) -> Self {
        Self { points, scrambles: SCRAMBLES, seed }
    }

    /// Number of points of each scramble.
    pub(crate) fn points_each(&self) -> Result<u64, InputError> {
        let each = self.points / self.scrambles.max(1);
        if (1..=sobol::MOST_POINTS).contains(&each) && each * self.scrambles == self.points {
            return Ok(each);
        }
        Err(InputError::Malformed {
            field: "points",
            value: self.points.to_string(),
            expected: "a multiple of the number of scrambles (8 by default), at most 2^36 points for each",
        })
    }
}

impl Plan {
    /// Number of launches that the plan tries in `space`. For [`Plan::ExactSpeed`] each of them stands for all speeds;
    /// it is 1 if nothing but the speed varies.
    ///
    /// # Errors
    /// [`InputError`] if the plan does not fit the space.
    pub fn points(&self, space: &Space) -> Result<u64, InputError> {
        match *self {
            Plan::ExactSpeed(_) if space.drop().is_some() => Err(NO_DROP),
            Plan::Grid => space.grid_points(),
            Plan::Random { points, .. } =>
            {
                #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
                require("points", points as f64, "at least 1", points >= 1).map(|_| points)
            }
            Plan::Sobol(scrambled) => scrambled.points_each().map(|_| scrambled.points),
            Plan::ExactSpeed(Rest::Sobol(scrambled)) if cube_of_the_rest(space).dimensions() > 0 => {
                scrambled.points_each().map(|_| scrambled.points)
            }
            Plan::ExactSpeed(_) => space.grid_points_without_speed(),
        }
    }
}

/// The unit cube over the coordinates that vary, without the speed.
pub(crate) fn cube_of_the_rest(space: &Space) -> Cube {
    Cube::new(space, space.free().filter(|of| *of != Coordinate::Speed))
}
