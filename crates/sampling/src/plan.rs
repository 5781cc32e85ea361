//! This file lists the methods of choosing the launches of a space that are tried. A plan is plain data: the
//! sampler carries it out, and its number of launches is known before.

use std::fmt;
use std::str::FromStr;

use dynamics::InputError;
use dynamics::error::{find_named, require};

use crate::coordinate::Coordinate;
use crate::sobol;
use crate::space::{Cube, Space};

/// Default number of independent scrambles of Sobol's sequence in an estimate.
pub const SCRAMBLES: u64 = 8;

/// Default seed of random launches and of scrambles.
pub const SEED: u64 = 1;

/// A method of choosing launches, without its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// A grid over the space, the paper's method A.
    Grid,
    /// Independent random launches, the paper's method B.
    Random,
    /// Owen-scrambled Sobol points.
    Sobol,
    /// All speeds in closed form.
    ExactSpeed,
    /// Bounds over cells of up to three coordinates besides the speed, which prove both ends.
    Enclosure,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 5] = [Self::Grid, Self::Random, Self::Sobol, Self::ExactSpeed, Self::Enclosure];

    /// The name in files and options, such as `exact-speed`.
    pub fn name(self) -> &'static str {
        ["grid", "random", "sobol", "exact-speed", "enclosure"][self as usize]
    }

    /// What it does, for the help text of an option.
    pub fn summary(self) -> &'static str {
        [
            "A grid over the space, whose axes have their numbers of points (the paper's method A)",
            "Independent random launches (the paper's method B)",
            "Owen-scrambled Sobol points, which fill the space more evenly",
            "Integrates over the speed in closed form; the other coordinates by their grid or by Sobol points",
            "Proves both ends of an interval: over the speed in closed form, over up to three other coordinates by bounds for \
             whole cells; from horizontal, uniform rates x and y count as one",
        ][self as usize]
    }
}

/// Writes the [name](Method::name).
impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Finds a method by its name.
impl FromStr for Method {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        find_named("method", name, &Self::ALL, |method| method.name()).copied()
    }
}

/// The method that chooses the launches of a space that are tried.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::data::PlanData", into = "crate::data::PlanData")
)]
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
    /// All speeds in closed form, and an [enclosure](crate::enclosure) of the mean over up to three other coordinates, with as many
    /// cells as the accuracy takes. Both ends of its interval are proven.
    Enclosure {
        /// The largest half-width of the interval, > 0.
        accuracy: f64,
    },
}

/// Why [`Plan::ExactSpeed`] is refused for a space with a drop.
const NO_DROP: InputError = InputError::OutsideModel {
    field: "drop [m]",
    why: "exact-speed integrates over the speed in closed form, which needs a landing at the height of the launch; other \
          methods take a drop",
};

/// Why [`Plan::ExactSpeed`] and [`Plan::Enclosure`] are refused for a body with I1 ≠ I2.
pub(crate) const ONLY_COINS: InputError = InputError::OutsideModel {
    field: "method",
    why: "exact-speed and enclosure integrate over the speed in closed form, which there is not for a body with I1 ≠ I2; grid, random and \
          sobol take it",
};

/// Why the launches of [`Plan::Enclosure`] have no numbers.
const UNNUMBERED: InputError = InputError::OutsideModel {
    field: "method",
    why: "an enclosure is of all launches, so that there are none to number, list or divide into parts; other \
          methods can",
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
    /// The method.
    pub fn method(&self) -> Method {
        match self {
            Self::Grid => Method::Grid,
            Self::Random { .. } => Method::Random,
            Self::Sobol(_) => Method::Sobol,
            Self::ExactSpeed(_) => Method::ExactSpeed,
            Self::Enclosure { .. } => Method::Enclosure,
        }
    }

    /// The seed; `None` if nothing is random.
    pub fn seed(&self) -> Option<u64> {
        match *self {
            Self::Grid | Self::ExactSpeed(Rest::Grid) | Self::Enclosure { .. } => None,
            Self::Random { seed, .. } => Some(seed),
            Self::Sobol(scrambled) | Self::ExactSpeed(Rest::Sobol(scrambled)) => Some(scrambled.seed),
        }
    }

    /// Number of launches that the plan tries in `space`. For [`Plan::ExactSpeed`] each of them stands for all speeds;
    /// it is 1 if nothing but the speed varies.
    ///
    /// # Errors
    /// [`InputError`] if the plan does not fit the space, and for [`Plan::Enclosure`], whose number of cells is only known
    /// afterwards.
    pub fn points(&self, space: &Space) -> Result<u64, InputError> {
        match *self {
            Plan::ExactSpeed(_) if space.coin().is_none() => Err(ONLY_COINS),
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
            Plan::Enclosure { .. } => Err(UNNUMBERED),
        }
    }
}

/// The unit cube over the coordinates that vary, without the speed.
pub(crate) fn cube_of_the_rest(space: &Space) -> Cube {
    Cube::new(space, space.free().filter(|of| *of != Coordinate::Speed))
}
