//! A cell of parameters of launches: a box of dyadic intervals that is halved until the mean share over it is known.

use numerics::Ball;

use super::directions::Direction;
use super::series::Series;

/// The largest number of coordinates that a cell has.
pub(super) const MOST_DIRECTIONS: usize = 3;
/// A box of parameters s from 0 to 1, each a dyadic interval.
#[derive(Debug, Clone)]
pub(super) struct Cell<'a> {
    pub(super) directions: [Option<&'a Direction>; MOST_DIRECTIONS],
    /// The interval in each direction: from `place` 2^-`level` to (`place` + 1) 2^-`level`.
    place: [u64; MOST_DIRECTIONS],
    pub(super) level: [u32; MOST_DIRECTIONS],
}

/// The finest level of an interval, whose middle is still an f64.
const FINEST: u32 = 51;

impl<'a> Cell<'a> {
    pub(super) fn whole(directions: [Option<&'a Direction>; MOST_DIRECTIONS]) -> Self {
        Self { directions, place: [0; MOST_DIRECTIONS], level: [0; MOST_DIRECTIONS] }
    }

    /// The volume is 2^-`halvings`.
    pub(super) fn halvings(&self) -> u32 {
        self.level.iter().sum()
    }

    /// Whether its middle in direction number `index` is an f64.
    pub(super) fn can_be_halved(&self, index: usize) -> bool {
        self.level[index] < FINEST
    }

    /// Both halves in direction number `index`; `None` if it cannot be halved.
    pub(super) fn halves(&self, index: usize) -> Option<[Self; 2]> {
        self.can_be_halved(index).then(|| {
            [0, 1].map(|half| {
                let mut cell = self.clone();
                cell.level[index] += 1;
                cell.place[index] = 2 * cell.place[index] + half;
                cell
            })
        })
    }

    /// The ends of the interval in direction number `index`.
    #[cfg(test)]
    #[expect(clippy::cast_precision_loss, reason = "below 2^52")]
    pub(super) fn interval(&self, index: usize) -> [f64; 2] {
        [0, 1].map(|end| (self.place[index] + end) as f64 * (-f64::from(self.level[index])).exp2())
    }

    /// The parameter in direction number `index`, about the middle: with t from -1 to 1 as the one variable of the series. Its
    /// constant term is the middle, or for a `whole` cell a ball that contains the interval.
    pub(super) fn parameter(&self, index: usize, whole: bool) -> Series<5> {
        let half = 0.5 * (-f64::from(self.level[index])).exp2();
        #[expect(clippy::cast_precision_loss, reason = "below 2^52")]
        let middle = (2.0 * self.place[index] as f64 + 1.0) * half;
        Series::variable(Ball::new(middle, if whole { half } else { 0.0 }), Ball::new(half, 0.0), 0)
    }
}
