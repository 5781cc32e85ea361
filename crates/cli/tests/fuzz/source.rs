//! The source of random choices of a case. Case number i has the generator with the seed i, so that each can be made
//! again alone.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

pub(crate) struct Source {
    random: ChaCha8Rng,
    /// Whether the case is to be one that the program can answer, as far as that is known here.
    pub(crate) careful: bool,
    /// Whether the coordinates of a space are to have points for a grid.
    pub(crate) has_grid: bool,
}

impl Source {
    pub(crate) fn new(case: u64) -> Self {
        let mut source = Self { random: ChaCha8Rng::seed_from_u64(case), careful: false, has_grid: false };
        source.careful = source.chance(60);
        source.has_grid = source.careful && source.chance(50);
        source
    }

    /// A whole number below `end`.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.random.random_range(0..end)
    }

    /// True in `percent` of 100 cases.
    pub(crate) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// One of `choices`.
    pub(crate) fn pick<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }

    /// Any f64, by its bits.
    pub(crate) fn any_number(&mut self) -> f64 {
        f64::from_bits(self.random.random())
    }

    /// A number between 0 and 1.
    pub(crate) fn fraction(&mut self) -> f64 {
        self.random.random()
    }

    /// The items in another order.
    pub(crate) fn shuffled<T>(&mut self, mut items: Vec<T>) -> Vec<T> {
        for end in (1..items.len()).rev() {
            items.swap(end, self.below(end + 1));
        }
        items
    }
}
