//! This file holds a block of launches as columns, one for each coordinate. This is the layout that the batch kernels
//! of the crate `exact` read, and threads reuse the memory from block to block.

use dynamics::precession::rates_of_precession;
use dynamics::{Attitude, Body, Tosses};

use crate::coordinate::Coordinate;
use crate::space::{Space, Values};

/// Number of launches that a thread processes at a time, so few that their columns stay in the second-level cache.
pub(crate) const BLOCK: usize = 512;

/// Values of one coordinate, aligned to whole cache lines for fast loads.
#[derive(Clone)]
#[repr(align(64))]
struct Column([f64; BLOCK]);

/// Memory for up to [`BLOCK`] launches of a space, which a thread reuses.
pub(crate) struct Block {
    /// A column for each coordinate, in the order of [`Coordinate::ALL`], and a spare one.
    columns: Vec<Column>,
    /// Number of launches that the columns hold now.
    length: usize,
    /// The inertia ratio for each launch, if the rates follow from a precession.
    ratios: Option<Column>,
}

/// The place of the spare column, for numbers that nobody reads.
const SPARE: usize = Coordinate::COUNT;

impl Block {
    /// A block in which every coordinate has its fixed value of `space`, until its column is written.
    pub(crate) fn new(space: &Space) -> Self {
        let values = space.fixed_values().into_iter().chain([0.0]);
        let coin = space.coin().filter(|_| space.is_of_precession());
        let ratios = coin.map(|coin| Column([coin.inertia_ratio(); BLOCK]));
        Self { columns: values.map(|value| Column([value; BLOCK])).collect(), length: 0, ratios }
    }

    /// Sets the number of launches to `length` ≤ [`BLOCK`].
    pub(crate) fn start(&mut self, length: usize) {
        self.length = length;
    }

    /// Number of launches.
    pub(crate) fn len(&self) -> usize {
        self.length
    }

    /// The values of the coordinate `of`.
    pub(crate) fn column(&self, of: Coordinate) -> &[f64] {
        &self.columns[of as usize].0[..self.length]
    }

    /// As [`Block::column`], to be written.
    pub(crate) fn column_mut(&mut self, of: Coordinate) -> &mut [f64] {
        &mut self.columns[of as usize].0[..self.length]
    }

    /// The columns of two different coordinates, to be written. The spare column stands for one that is `None`.
    pub(crate) fn two_columns_mut(&mut self, of: [Option<Coordinate>; 2]) -> [&mut [f64]; 2] {
        let places = of.map(|of| of.map_or(SPARE, |of| of as usize));
        let columns = self.columns.get_disjoint_mut(places).expect("two different columns");
        columns.map(|column| &mut column.0[..self.length])
    }

    /// Writes the rates that follow from a turn and ψ, once these are written.
    pub(crate) fn finish(&mut self) {
        let Some(ratios) = &self.ratios else { return };
        let places = [Coordinate::Turn, Coordinate::Psi, Coordinate::RateX, Coordinate::RateZ].map(|of| of as usize);
        let columns = self.columns.get_disjoint_mut(places).expect("different columns");
        let [turns, psis, x, z] = columns.map(|column| &mut column.0[..self.length]);
        let refused = rates_of_precession(&ratios.0[..self.length], turns, psis, [x, z]);
        assert_eq!(refused, None, "every axis was checked when the space was made");
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
    /// The launches of a block as tosses of `body` for a batch; `None` if gravity or tilt vary in this space, or if bodies
    /// land at another height than that of their launch.
    pub(crate) fn tosses_of<'a, B: Copy + Into<Body>>(&self, body: B, block: &'a Block) -> Option<Tosses<'a, B>> {
        if self.drop().is_some() {
            return None;
        }
        let (gravity, tilt) = (self.axis(Coordinate::Gravity).value()?, self.axis(Coordinate::Tilt).value()?);
        let rates = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(|of| block.column(self.place(of)));
        let tosses = Tosses::new(body, Attitude::about_x(tilt), gravity, rates, block.column(Coordinate::Speed));
        Some(tosses.expect("every axis was checked when the space was made"))
    }
}
