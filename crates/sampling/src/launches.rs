//! The launches that a plan tries, by their index.

use std::ops::Range;

use crate::grid::Grid;
use crate::random::random_values;
use crate::sobol::ScrambledSobol;
use crate::space::{Cube, Values};

/// A sequence of launches; launch i does not depend on how many others are asked for.
#[derive(Debug, Clone)]
pub(crate) enum Launches {
    Grid(Grid),
    Random { cube: Cube, seed: u64 },
    Sobol { cube: Cube, sequence: ScrambledSobol },
}

impl Launches {
    /// One scramble of Sobol's sequence over `cube`.
    pub(crate) fn sobol(cube: Cube, seed: u64, scramble: u64) -> Self {
        let sequence = ScrambledSobol::new(cube.dimensions(), seed, scramble);
        Self::Sobol { cube, sequence: sequence.expect("a space has six coordinates, the sequence eight dimensions") }
    }

    /// The launches `range`.
    pub(crate) fn values(&self, range: Range<u64>) -> Vec<Values> {
        match self {
            Self::Grid(grid) => grid.values(range),
            Self::Random { cube, seed } => random_values(cube, *seed, range),
            Self::Sobol { cube, sequence } => {
                let mut all = Vec::new();
                sequence.for_each(range, |point| all.push(cube.values(|dimension| point[dimension])));
                all
            }
        }
    }
}
