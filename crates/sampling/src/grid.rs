//! Method A: a grid over a space.

use std::ops::Range;

use dynamics::InputError;

use crate::axis::Axis;
use crate::coordinate::Coordinate;
use crate::space::{Space, Values};

/// The coordinates from the slowest to the fastest. With the speed last, neighbouring launches share their motion.
const ORDER: [Coordinate; Coordinate::COUNT] =
    [Coordinate::Tilt, Coordinate::Gravity, Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ, Coordinate::Speed];

/// The grid over a space, or over all its coordinates but the speed.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    fixed: Values,
    /// The coordinates that are not fixed, in the order of [`ORDER`], with their numbers of points.
    axes: Vec<(Coordinate, Axis, u64)>,
    points: u64,
}

impl Grid {
    /// The grid over every coordinate of `space`.
    ///
    /// # Errors
    /// [`InputError`] that names an axis without a number of points, or says that the grid is too large to count.
    pub(crate) fn new(space: &Space) -> Result<Self, InputError> {
        Self::over(space, |_| true)
    }

    /// The grid over every coordinate of `space` but the speed.
    ///
    /// # Errors
    /// As [`Grid::new`].
    pub(crate) fn without_speed(space: &Space) -> Result<Self, InputError> {
        Self::over(space, |of| of != Coordinate::Speed)
    }

    fn over(space: &Space, includes: impl Fn(Coordinate) -> bool) -> Result<Self, InputError> {
        let mut grid = Self { fixed: space.fixed_values(), axes: Vec::new(), points: 1 };
        let free: Vec<Coordinate> = space.free().collect();
        for of in ORDER.into_iter().filter(|of| free.contains(of) && includes(*of)) {
            let axis = space.axis(of);
            let refused = |expected| InputError::Malformed { field: of.field(), value: axis.to_string(), expected };
            let count = axis
                .points()
                .ok_or_else(|| refused("a number of points for a grid: LO:HI:POINTS or normal:MEAN:SD:POINTS"))?;
            let points = grid.points.checked_mul(count);
            grid.points = points.ok_or_else(|| refused("a grid of fewer than 2^64 points in all"))?;
            grid.axes.push((of, axis, count));
        }
        Ok(grid)
    }

    pub(crate) fn points(&self) -> u64 {
        self.points
    }

    /// The launches `range` of the grid.
    pub(crate) fn values(&self, range: Range<u64>) -> Vec<Values> {
        let mut values = self.fixed;
        let mut digits = vec![0; self.axes.len()];
        let mut rest = range.start;
        for (digit, (of, axis, count)) in digits.iter_mut().zip(&self.axes).rev() {
            (*digit, rest) = (rest % count, rest / count);
            values[*of as usize] = axis.grid_point(*digit, *count);
        }
        let next = |values: &mut Values| {
            for (digit, (of, axis, count)) in digits.iter_mut().zip(&self.axes).rev() {
                *digit = if *digit + 1 == *count { 0 } else { *digit + 1 };
                values[*of as usize] = axis.grid_point(*digit, *count);
                if *digit != 0 {
                    break;
                }
            }
        };
        collect(range, values, next)
    }
}

/// A launch for each index of `range`: `values`, and what `next` makes of it.
fn collect(range: Range<u64>, mut values: Values, mut next: impl FnMut(&mut Values)) -> Vec<Values> {
    range
        .map(|_| {
            let launch = values;
            next(&mut values);
            launch
        })
        .collect()
}

impl Space {
    /// Number of launches of its grid.
    ///
    /// # Errors
    /// [`InputError`] that names an axis without a number of points, or says that the grid is too large to count.
    pub fn grid_points(&self) -> Result<u64, InputError> {
        Grid::new(self).map(|grid| grid.points())
    }

    /// The same space with a grid of at most `points` ≥ 2^(free coordinates) launches, about as many on each axis.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names an axis for which too few points are left.
    pub fn with_grid_of(self, points: u64) -> Result<Self, InputError> {
        let free: Vec<Coordinate> = self.free().collect();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
        let nearly = ((points as f64).powf(1.0 / free.len().max(1) as f64) as u64).saturating_sub(1);
        let mut counts = vec![nearly.max(1); free.len()];
        // Each axis in turn gets a point more, as long as all together stay within the number.
        let mut growing = true;
        while growing {
            growing = false;
            for axis in 0..counts.len() {
                let others: u64 = counts.iter().product::<u64>() / counts[axis];
                if others.checked_mul(counts[axis] + 1).is_some_and(|all| all <= points) {
                    counts[axis] += 1;
                    growing = true;
                }
            }
        }
        free.into_iter()
            .zip(counts)
            .try_fold(self, |space, (of, count)| space.with_axis(of, space.axis(of).with_points(of, count)?))
    }
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;
    use Coordinate::{RateX, RateY, RateZ, Speed, Tilt};

    fn space(texts: [&str; 4]) -> Space {
        let [x, y, z, speed] = texts;
        Space::parse(Coin::PAPER, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed)]).unwrap()
    }

    #[test]
    fn the_grid_covers_the_box_corner_to_corner_with_the_speed_fastest() {
        let grid = Grid::new(&space(["0:1:2", "5:6:2", "7:8:2", "3:5:3"])).unwrap();
        assert_eq!(grid.points(), 24);
        let all = grid.values(0..24);
        for (index, rates_and_speed) in [
            (0, [0.0, 5.0, 7.0, 3.0]),
            (1, [0.0, 5.0, 7.0, 4.0]),
            (3, [0.0, 5.0, 8.0, 3.0]),
            (6, [0.0, 6.0, 7.0, 3.0]),
            (23, [1.0, 6.0, 8.0, 5.0]),
        ] {
            assert_eq!(all[index][..4], rates_and_speed);
        }
        for (start, end) in [(0, 1), (5, 9), (11, 24), (23, 24)] {
            assert_eq!(grid.values(start..end), all[start as usize..end as usize]);
        }
    }

    #[test]
    fn without_the_speed_its_axis_needs_no_points() {
        let space = space(["0:1:3", "x", "7", "3:5"]);
        assert!(Grid::new(&space).is_err());
        assert_eq!(Grid::without_speed(&space).unwrap().points(), 3);
    }

    #[test]
    fn a_range_without_points_is_no_grid_and_neither_is_one_too_large() {
        let error = space(["0:1", "x", "7", "3"]).grid_points().unwrap_err().to_string();
        assert!(error.starts_with("rate x [rad/s] = '0:1'"), "{error}");
        let many = "0:1:5000000000";
        let error = space([many, many, "7", "3"]).grid_points().unwrap_err().to_string();
        assert!(error.contains("fewer than 2^64"), "{error}");
    }

    #[test]
    fn a_grid_of_a_given_size_is_as_even_as_it_can_be() {
        let box_of_four = space(["1:60", "1:60", "1:60", "3:5"]);
        let counts = |points| {
            let space = box_of_four.with_grid_of(points).unwrap();
            [RateX, RateY, RateZ, Speed, Tilt].map(|of| space.axis(of).points().unwrap())
        };
        assert_eq!(counts(1 << 16), [16, 16, 16, 16, 1]);
        assert_eq!(counts(17 * 17 * 16 * 16), [17, 17, 16, 16, 1]);
        assert!(box_of_four.with_grid_of(10).is_err());
    }
}
