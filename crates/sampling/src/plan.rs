//! Which launches of a space are tried, and how: the four methods.

use dynamics::InputError;
use dynamics::error::require;

use crate::coordinate::Coordinate;
use crate::sobol;
use crate::space::{Cube, Space};

/// Scrambles of Sobol's sequence that an estimate is made of, unless it is told otherwise.
pub const SCRAMBLES: u64 = 8;

/// Which launches of a space are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plan {
    /// Method A: the space's grid.
    Grid,
    /// Method B: `points` launches at random.
    Random {
        /// Number of launches.
        points: u64,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Owen-scrambled Sobol points.
    Sobol(Scrambled),
    /// The speed integrated in closed form, by the exact motion.
    ExactSpeed(Rest),
}

/// How the coordinates are chosen that are not integrated in closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// By the space's grid, whose speed axis needs no points.
    Grid,
    /// By Owen-scrambled Sobol points.
    Sobol(Scrambled),
}

/// Sobol points: so many in all, shared out evenly over independent scrambles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scrambled {
    /// Number of launches in all; a power of two for each scramble is best.
    pub points: u64,
    /// Number of scrambles. From a single one no error can be told.
    pub scrambles: u64,
    /// Seed of the scrambles.
    pub seed: u64,
}

impl Scrambled {
    /// `points` launches over [`SCRAMBLES`] scrambles.
    pub fn new(points: u64, seed: u64) -> Self {
        Self { points, scrambles: SCRAMBLES, seed }
    }

    /// Points of each scramble.
    pub(crate) fn points_each(&self) -> Result<u64, InputError> {
        let each = self.points / self.scrambles.max(1);
        if (1..=sobol::MOST_POINTS).contains(&each) && each * self.scrambles == self.points {
            return Ok(each);
        }
        Err(InputError::Malformed {
            field: "points",
            value: self.points.to_string(),
            expected: "a multiple of the number of scrambles (8), at most 2^36 for each",
        })
    }
}

impl Plan {
    /// Number of launches, or of launches without their speeds, that the plan tries in `space`: 1 for an exact answer.
    ///
    /// # Errors
    /// [`InputError`] if the plan does not fit the space.
    pub fn points(&self, space: &Space) -> Result<u64, InputError> {
        match *self {
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

/// The cube over what is free beside the speed.
pub(crate) fn cube_of_the_rest(space: &Space) -> Cube {
    Cube::new(space, space.free().filter(|of| *of != Coordinate::Speed))
}
