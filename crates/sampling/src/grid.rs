//! This file makes the launches of method A, a grid over a space. Launch number i is computed
//! directly from i, so that each thread can start anywhere in the grid.
//!
//! Along an axis from lo to hi the n points are lo + i (hi - lo)/(n - 1), i = 0 to n - 1, both ends included. The grid
//! is the product of its axes and contains every launch once.

use dynamics::InputError;

use crate::axis::Axis;
use crate::block::Block;
use crate::coordinate::Coordinate;
use crate::space::Space;

/// The coordinates from the slowest to the fastest varying. The speed is last, so that neighbouring launches differ in
/// their time of flight alone.
const ORDER: [Coordinate; Coordinate::COUNT] = [
    Coordinate::Tilt,
    Coordinate::Gravity,
    Coordinate::Drop,
    Coordinate::RateX,
    Coordinate::RateY,
    Coordinate::RateZ,
    Coordinate::Turn,
    Coordinate::Psi,
    Coordinate::Speed,
];

/// The grid over all coordinates of a space, or over all but the speed.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    /// The coordinates that vary, in the order of [`ORDER`].
    sides: Vec<Side>,
}

/// One coordinate of a grid.
#[derive(Debug, Clone)]
struct Side {
    of: Coordinate,
    axis: Axis,
    count: u64,
    /// The points, if they are few; else empty.
    points: Vec<f64>,
}

impl Side {
    /// Up to this number of points are stored; more are computed when they are needed.
    const FEW: u64 = 1 << 16;

    fn new(of: Coordinate, axis: Axis, count: u64) -> Self {
        let few = if count <= Self::FEW { count } else { 0 };
        Self { of, axis, count, points: (0..few).map(|index| axis.grid_point(index, count)).collect() }
    }

    fn point(&self, index: u64) -> f64 {
        let known = usize::try_from(index).ok().and_then(|index| self.points.get(index));
        known.copied().unwrap_or_else(|| self.axis.grid_point(index, self.count))
    }

    /// Writes the points from number `from` on into `to`.
    fn write(&self, from: u64, to: &mut [f64]) {
        let known = usize::try_from(from).ok().and_then(|from| self.points.get(from..)?.get(..to.len()));
        match known {
            Some(known) => to.copy_from_slice(known),
            None => to.iter_mut().zip(from..).for_each(|(to, index)| *to = self.axis.grid_point(index, self.count)),
        }
    }
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
        let (sides, _) = counts(space, includes)?;
        Ok(Self { sides: sides.into_iter().map(|(of, axis, count)| Side::new(of, axis, count)).collect() })
    }

    /// Writes the launches from number `start` on into `block`, in runs of launches that differ in the last coordinate
    /// alone.
    pub(crate) fn write(&self, start: u64, block: &mut Block) {
        let Some((last, others)) = self.sides.split_last() else { return };
        let mut done = 0;
        while done < block.len() {
            let at = start + done as u64;
            let (first, mut rest) = (at % last.count, at / last.count);
            let left = usize::try_from(last.count - first).unwrap_or(usize::MAX);
            let run = done..done + left.min(block.len() - done);
            last.write(first, &mut block.column_mut(last.of)[run.clone()]);
            for side in others.iter().rev() {
                block.column_mut(side.of)[run.clone()].fill(side.point(rest % side.count));
                rest /= side.count;
            }
            done = run.end;
        }
    }
}

/// A coordinate, its axis and its number of points.
type Count = (Coordinate, Axis, u64);

/// The coordinates that vary, in the order of [`ORDER`], with their numbers of points; and the number of all launches.
fn counts(space: &Space, includes: impl Fn(Coordinate) -> bool) -> Result<(Vec<Count>, u64), InputError> {
    let free: Vec<Coordinate> = space.free().collect();
    let (mut sides, mut points) = (Vec::new(), 1_u64);
    for of in ORDER.into_iter().filter(|of| free.contains(of) && includes(*of)) {
        let axis = space.axis(of);
        let refused = |expected| InputError::Malformed { field: of.field(), value: axis.to_string(), expected };
        let count = axis
            .points()
            .ok_or_else(|| refused("a number of points for a grid: LO:HI:POINTS or normal:MEAN:SD:POINTS"))?;
        points = points.checked_mul(count).ok_or_else(|| refused("a grid of fewer than 2^64 points in all"))?;
        sides.push((of, axis, count));
    }
    Ok((sides, points))
}

impl Space {
    /// Number of launches of the grid over all coordinates but the speed.
    ///
    /// # Errors
    /// As [`Space::grid_points`].
    pub(crate) fn grid_points_without_speed(&self) -> Result<u64, InputError> {
        counts(self, |of| of != Coordinate::Speed).map(|(_, points)| points)
    }

    /// Number of launches of the grid.
    ///
    /// # Errors
    /// [`InputError`] that names an axis without a number of points, or says that the grid is too large to count.
    pub fn grid_points(&self) -> Result<u64, InputError> {
        counts(self, |_| true).map(|(_, points)| points)
    }

    /// Sets the numbers of grid points of all free axes to about the same number, for a grid of at most `points`
    /// launches. `points` must be at least 2^n for n free coordinates.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names an axis for which too few points are left.
    pub fn with_grid_of(self, points: u64) -> Result<Self, InputError> {
        let free: Vec<Coordinate> = self.free().collect();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
        let nearly = ((points as f64).powf(1.0 / free.len().max(1) as f64) as u64).saturating_sub(1);
        let mut counts = vec![nearly.max(1); free.len()];
        // Adds a point to each axis in turn, as long as the grid stays within `points` launches.
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
            .try_fold(self, |space, (of, count)| space.with_axis(of, space.axis(of).with_points(count)))
    }
}

#[cfg(test)]
mod tests {
    use Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use dynamics::Coin;

    use super::*;

    fn space(texts: [&str; 4]) -> Space {
        let [x, y, z, speed] = texts;
        Space::parse(Coin::PAPER, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed)]).unwrap()
    }

    #[test]
    fn the_grid_covers_the_box_to_its_corners_and_varies_the_speed_fastest() {
        let space = space(["0:1:2", "5:6:2", "7:8:2", "3:5:3"]);
        let grid = Grid::new(&space).unwrap();
        assert_eq!(space.grid_points(), Ok(24));
        let values = |start: u64, end: u64| {
            let mut block = Block::new(&space);
            block.start((end - start) as usize);
            grid.write(start, &mut block);
            block.all_values().collect::<Vec<_>>()
        };
        let all = values(0, 24);
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
            assert_eq!(values(start, end), all[start as usize..end as usize]);
        }
    }

    #[test]
    fn a_grid_without_the_speed_needs_no_points_on_its_axis() {
        let space = space(["0:1:3", "x", "7", "3:5"]);
        assert!(Grid::new(&space).is_err());
        assert_eq!(space.grid_points_without_speed(), Ok(3));
        assert_eq!(Grid::without_speed(&space).unwrap().sides.len(), 1);
    }

    #[test]
    fn rejects_an_axis_without_points_and_a_grid_too_large_to_count() {
        let error = space(["0:1", "x", "7", "3"]).grid_points().unwrap_err().to_string();
        assert!(error.starts_with("rate x [rad/s] = '0:1'"), "{error}");
        let many = "0:1:5000000000";
        let error = space([many, many, "7", "3"]).grid_points().unwrap_err().to_string();
        assert!(error.contains("fewer than 2^64"), "{error}");
    }

    #[test]
    fn a_grid_of_a_given_size_spreads_its_points_evenly_over_the_axes() {
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
