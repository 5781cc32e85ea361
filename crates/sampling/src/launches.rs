//! This file computes the launches that a plan tries, as numbered sequences. Launch i depends on i alone, so that
//! threads can compute any part of a sequence.

use std::ops::Range;

use crate::block::Block;
use crate::grid::Grid;
use crate::random::write_random;
use crate::sobol::ScrambledSobol;
use crate::space::Cube;

/// A sequence of launches. Launch i does not depend on how many others are computed.
#[derive(Debug, Clone)]
pub(crate) enum Launches {
    Grid(Grid),
    Random { cube: Cube, seed: u64 },
    Sobol { cube: Cube, sequence: ScrambledSobol },
}

impl Launches {
    /// One scramble of Sobol's sequence over `cube`, prepared for about `points` launches.
    pub(crate) fn sobol(cube: Cube, seed: u64, scramble: u64, points: u64) -> Self {
        let sequence = ScrambledSobol::new(cube.dimensions(), seed, scramble);
        let sequence = sequence.expect("a space has six coordinates, the sequence eight dimensions");
        Self::Sobol { cube, sequence: sequence.prepared_for(points) }
    }

    /// Writes the launches with the numbers `range` into `block`.
    pub(crate) fn write(&self, range: Range<u64>, block: &mut Block) {
        block.start(usize::try_from(range.end - range.start).expect("a block at most"));
        match self {
            Self::Grid(grid) => grid.write(range.start, block),
            Self::Random { cube, seed } => write_random(cube, *seed, range.start, block),
            Self::Sobol { cube, sequence } => {
                for (dimension, (of, axis)) in cube.axes().iter().enumerate() {
                    let column = block.column_mut(*of);
                    sequence.write(dimension, range.start, column);
                    axis.to_quantiles(column);
                }
            }
        }
        block.finish();
    }
}
