//! A block of launches in columns, as the batch kernels want them.

use dynamics::{Attitude, Tosses};

use crate::coordinate::Coordinate;
use crate::space::{Space, Values};

/// Launches that a thread takes at a time: their columns stay in the second-level cache.
pub(crate) const BLOCK: usize = 512;

/// Values of one coordinate, as registers are loaded best.
#[derive(Clone)]
#[repr(align(64))]
struct Column([f64; BLOCK]);

/// Room for up to [`BLOCK`] launches of a space, which a thread uses again and again.
pub(crate) struct Block {
    columns: Vec<Column>,
    length: usize,
    /// Random numbers on their way to the columns.
    pub(crate) words: Vec<u64>,
}

impl Block {
    /// A block whose coordinates have their fixed values of `space` until they are written.
    pub(crate) fn new(space: &Space) -> Self {
        let columns = space.fixed_values().map(|value| Column([value; BLOCK])).to_vec();
        Self { columns, length: 0, words: Vec::new() }
    }

    /// Makes room for `length` ≤ [`BLOCK`] launches.
    pub(crate) fn start(&mut self, length: usize) {
        self.length = length;
    }

    /// Number of launches.
    pub(crate) fn len(&self) -> usize {
        self.length
    }

    pub(crate) fn column(&self, of: Coordinate) -> &[f64] {
        &self.columns[of as usize].0[..self.length]
    }

    pub(crate) fn column_mut(&mut self, of: Coordinate) -> &mut [f64] {
        &mut self.columns[of as usize].0[..self.length]
    }

    /// A column, and the random numbers.
    pub(crate) fn column_and_words(&mut self, of: Coordinate) -> (&mut [f64], &[u64]) {
        (&mut self.columns[of as usize].0[..self.length], &self.words)
    }

    /// The values of launch number `index` of the block.
    pub(crate) fn values(&self, index: usize) -> Values {
        Coordinate::ALL.map(|of| self.column(of)[index])
    }

    /// The values of all launches.
    pub(crate) fn all_values(&self) -> impl Iterator<Item = Values> {
        (0..self.length).map(|index| self.values(index))
    }
}

impl Space {
    /// The tosses of a block, if none but rates and speed differ.
    pub(crate) fn tosses<'a>(&self, block: &'a Block) -> Option<Tosses<'a>> {
        let (gravity, tilt) = (self.axis(Coordinate::Gravity).value()?, self.axis(Coordinate::Tilt).value()?);
        let rates = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(|of| block.column(self.place(of)));
        let tosses = Tosses::new(self.coin(), Attitude::about_x(tilt), gravity, rates, block.column(Coordinate::Speed));
        Some(tosses.expect("every axis was checked when the space was made"))
    }
}
