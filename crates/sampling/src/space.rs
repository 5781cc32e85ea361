//! Configuration spaces as data: which launches a probability is about.

use dynamics::error::{find_named, require};
use dynamics::launch::DEFAULT_GRAVITY;
use dynamics::{Coin, InputError, Launch, TimeOfFlight, Toss, Vector3};

use crate::axis::Axis;

/// The y component of the rate: free, or tied to x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum YAxis {
    /// ωy has an axis of its own.
    Own(Axis),
    /// ωy = ωx.
    SameAsX,
}

/// Horizontal launches of one coin over a box of body rates and speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space {
    coin: Coin,
    rate_x: Axis,
    rate_y: YAxis,
    rate_z: Axis,
    speed: Axis,
    gravity: f64,
}

impl Space {
    /// Number of coordinates that a random launch draws; a fixed one draws too, so that fixing a coordinate leaves
    /// the others' values as they are.
    pub const DIMENSIONS: usize = 4;

    /// A space over the axes ωx, ωy, ωz (rad/s) and v0 (m/s), under `gravity` (m/s²).
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a range that includes negative speeds, and for a gravity that is not positive.
    pub fn new(
        coin: Coin,
        rate_x: Axis,
        rate_y: YAxis,
        rate_z: Axis,
        speed: Axis,
        gravity: f64,
    ) -> Result<Self, InputError> {
        require("speed [m/s]", speed.lo(), "a range of finite speeds >= 0", speed.lo() >= 0.0)?;
        require("gravity [m/s²]", gravity, "finite and > 0", gravity > 0.0)?;
        // The longest flight is the first to overflow.
        Launch::new(Vector3::zeros(), TimeOfFlight::Ballistic { speed: speed.hi(), gravity })?;
        Ok(Self { coin, rate_x, rate_y, rate_z, speed, gravity })
    }

    /// The same space for another coin.
    #[must_use]
    pub fn with_coin(self, coin: Coin) -> Self {
        Self { coin, ..self }
    }

    /// Number of grid points.
    ///
    /// # Errors
    /// [`InputError`] that names an axis without a number of points, or says that the grid is too large to count.
    pub fn grid_points(&self) -> Result<u64, InputError> {
        let counts = self.grid_shape()?;
        counts.iter().try_fold(1_u64, |product, &count| product.checked_mul(count)).ok_or(InputError::Malformed {
            field: "grid",
            value: format!("{counts:?}"),
            expected: "fewer than 2^64 points in all",
        })
    }

    fn grid_shape(&self) -> Result<[u64; 4], InputError> {
        let points = |field, axis: Axis| {
            axis.points().ok_or_else(|| InputError::Malformed {
                field,
                value: format!("{}:{}", axis.lo(), axis.hi()),
                expected: "LO:HI:POINTS for a grid",
            })
        };
        let own_y = match self.rate_y {
            YAxis::Own(axis) => points("rate y [rad/s]", axis)?,
            YAxis::SameAsX => 1,
        };
        Ok([
            points("rate x [rad/s]", self.rate_x)?,
            own_y,
            points("rate z [rad/s]", self.rate_z)?,
            points("speed [m/s]", self.speed)?,
        ])
    }

    /// The grid as a map from the index of a launch to the toss; the speed runs fastest.
    ///
    /// # Errors
    /// As [`Space::grid_points`].
    pub(crate) fn grid(&self) -> Result<impl Fn(u64) -> Toss + Sync, InputError> {
        let [count_x, count_y, count_z, count_speed] = self.grid_shape()?;
        let space = *self;
        Ok(move |index: u64| {
            let (rest, speed) = (index / count_speed, index % count_speed);
            let (rest, z) = (rest / count_z, rest % count_z);
            let (x, y) = (rest / count_y, rest % count_y);
            let rate_x = space.rate_x.grid_point(x, count_x);
            let rate_y = match space.rate_y {
                YAxis::Own(axis) => axis.grid_point(y, count_y),
                YAxis::SameAsX => rate_x,
            };
            space.toss(
                Vector3::new(rate_x, rate_y, space.rate_z.grid_point(z, count_z)),
                space.speed.grid_point(speed, count_speed),
            )
        })
    }

    /// The toss at the point `unit` of the unit cube: coordinates ωx, ωy, ωz, v0.
    pub(crate) fn at(&self, unit: [f64; Self::DIMENSIONS]) -> Toss {
        let rate_x = self.rate_x.at(unit[0]);
        let rate_y = match self.rate_y {
            YAxis::Own(axis) => axis.at(unit[1]),
            YAxis::SameAsX => rate_x,
        };
        self.toss(Vector3::new(rate_x, rate_y, self.rate_z.at(unit[2])), self.speed.at(unit[3]))
    }

    fn toss(&self, rate: Vector3<f64>, speed: f64) -> Toss {
        let time = TimeOfFlight::Ballistic { speed, gravity: self.gravity };
        let launch = Launch::new(rate, time).expect("every axis was checked when the space was made");
        Toss { coin: self.coin, launch }
    }
}

/// A space with a name.
#[derive(Debug, Clone, Copy)]
pub struct NamedSpace {
    /// Its name.
    pub name: &'static str,
    /// What it is, and what of it is the paper's.
    pub description: &'static str,
    /// ωx, ωy (`x` for ωy = ωx), ωz (rad/s) and v0 (m/s), as [`Axis::parse`] reads them.
    pub axes: [&'static str; 4],
}

impl NamedSpace {
    /// The space, for the coin `paper` under standard gravity.
    ///
    /// # Errors
    /// Never for the entries of [`NAMED_SPACES`], which a test makes sure of.
    pub fn space(&self) -> Result<Space, InputError> {
        let [x, y, z, speed] = self.axes;
        parse_space(Coin::PAPER, [x, y, z, speed], DEFAULT_GRAVITY)
    }
}

/// A space from the texts of its axes ωx, ωy (`x` ties it to ωx), ωz (rad/s) and v0 (m/s).
///
/// # Errors
/// [`InputError`] that names the axis.
pub fn parse_space(coin: Coin, axes: [&str; 4], gravity: f64) -> Result<Space, InputError> {
    let [x, y, z, speed] = axes;
    let rate_x = Axis::parse("rate x [rad/s]", x)?;
    let rate_y = if y.trim() == "x" { YAxis::SameAsX } else { YAxis::Own(Axis::parse("rate y [rad/s]", y)?) };
    let rate_z = Axis::parse("rate z [rad/s]", z)?;
    Space::new(coin, rate_x, rate_y, rate_z, Axis::parse("speed [m/s]", speed)?, gravity)
}

/// All spaces that can be named.
pub const NAMED_SPACES: &[NamedSpace] = &[
    // The paper's: the coin, 250 000 configurations by a grid (A) and at random (B), about 66 % heads, v0 of 3 to
    // 5 m/s. Ours: which axes run over what; the paper gives no range of ω, and many ranges give its figure.
    NamedSpace {
        name: "paper-fig4",
        description: "the paper's Fig. 4, reconstructed: 250 000 launches, about 66 % heads",
        axes: ["0:50:500", "x", "30", "3:5:500"],
    },
    // The paper's: ω, and speeds of 3 to 5 m/s. Ours: the number of speeds.
    NamedSpace {
        name: "cheated",
        description: "the paper's toss that always lands heads, ω = (1, 1, 2.5)",
        axes: ["1", "1", "2.5", "3:5:500"],
    },
    // The paper's: ω of its Fig. 3, and speeds of 3 to 5 m/s. Ours: the number of speeds.
    NamedSpace {
        name: "tails",
        description: "the paper's Fig. 3, ω = (2, 2, 0.5): tails at every speed of the range",
        axes: ["2", "2", "0.5", "3:5:500"],
    },
];

/// The space called `name`.
///
/// # Errors
/// [`InputError::UnknownName`] with the list of known names.
pub fn named_space(name: &str) -> Result<Space, InputError> {
    find_named("space", name, NAMED_SPACES, |space| space.name)?.space()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_spaces_exist_with_the_launches_they_promise() {
        let sizes: Vec<u64> = NAMED_SPACES.iter().map(|named| named.space().unwrap().grid_points().unwrap()).collect();
        assert_eq!(sizes, [250_000, 500, 500]);
    }

    #[test]
    fn the_grid_covers_the_box_corner_to_corner_with_the_speed_fastest() {
        let space = parse_space(Coin::PAPER, ["0:1:2", "5:6:2", "7:8:2", "3:5:3"], 9.81).unwrap();
        let grid = space.grid().unwrap();
        assert_eq!(space.grid_points(), Ok(24));
        assert_eq!(grid(0), space.toss(Vector3::new(0.0, 5.0, 7.0), 3.0));
        assert_eq!(grid(1), space.toss(Vector3::new(0.0, 5.0, 7.0), 4.0));
        assert_eq!(grid(3), space.toss(Vector3::new(0.0, 5.0, 8.0), 3.0));
        assert_eq!(grid(6), space.toss(Vector3::new(0.0, 6.0, 7.0), 3.0));
        assert_eq!(grid(23), space.toss(Vector3::new(1.0, 6.0, 8.0), 5.0));
    }

    #[test]
    fn a_tied_axis_follows_its_partner() {
        let space = named_space("paper-fig4").unwrap();
        let rate = space.at([0.25, 0.9, 0.0, 0.5]).launch.rate();
        assert_eq!((rate.x, rate.y, rate.z), (12.5, 12.5, 30.0));
    }

    #[test]
    fn a_range_without_points_is_no_grid() {
        let space = parse_space(Coin::PAPER, ["0:1", "x", "7", "3"], 9.81).unwrap();
        let error = space.grid_points().unwrap_err().to_string();
        assert!(error.starts_with("rate x [rad/s] = '0:1'"), "{error}");
    }

    #[test]
    fn invalid_physics_is_refused_by_axis() {
        for (axes, gravity, field) in [
            (["0", "0", "0", "-1:5"], 9.81, "speed"),
            (["0", "0", "0", "1:5"], 0.0, "gravity"),
            (["0", "0", "0", "1e300"], 1e-300, "time of flight"),
            (["0", "y", "0", "1"], 9.81, "rate y"),
        ] {
            let error = parse_space(Coin::PAPER, axes, gravity).unwrap_err().to_string();
            assert!(error.starts_with(field), "{error}");
        }
    }
}
