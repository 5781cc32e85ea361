//! This file draws the launches of method B, which are random and independent. Launch i depends on the seed and on i
//! alone, so that threads can draw any part of the sequence.
//!
//! The random numbers are the output of a cipher in counter mode (ChaCha with 8 rounds), read at a position that
//! follows from i.

use std::ops::Range;

use dynamics::Toss;
use numerics::lanes::SimdLevel;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::axis::Distribution;
use crate::block::{BLOCK, Block};
use crate::space::{Cube, Space};

/// Writes the launches from number `start` on of the random sequence with this `seed` over `cube` into `block`.
pub(crate) fn write_random(cube: &Cube, seed: u64, start: u64, block: &mut Block) {
    const WORDS_PER_NUMBER: u128 = 2;
    let dimensions = cube.dimensions();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_word_pos(u128::from(start) * dimensions as u128 * WORDS_PER_NUMBER);
    let numbers = block.len() * dimensions;
    block.words.resize(numbers, 0);
    rng.fill(&mut block.words[..]);
    for (dimension, (of, axis)) in cube.axes().iter().enumerate() {
        let (column, words) = block.column_and_words(*of);
        let row = Row { dimension, dimensions };
        match axis.distribution() {
            Distribution::Uniform { lo, hi } => row.uniform(words, column, [lo, hi]),
            Distribution::Normal { .. } => {
                row.uniform(words, column, [0.0, 1.0]);
                column.iter_mut().for_each(|part| *part = axis.quantile(*part));
            }
        }
    }
}

/// Position of a coordinate's random number among those of its launch.
#[derive(Clone, Copy)]
struct Row {
    dimension: usize,
    dimensions: usize,
}

impl Row {
    /// Fills `column` with uniform numbers in `range`, from one word of each row (launch) of `words`.
    fn uniform(self, words: &[u64], column: &mut [f64], range: [f64; 2]) {
        let Self { dimension, dimensions } = self;
        SimdLevel::widest().run(|| match dimensions {
            1 => uniform::<1>(words, column, dimension, range),
            2 => uniform::<2>(words, column, dimension, range),
            3 => uniform::<3>(words, column, dimension, range),
            4 => uniform::<4>(words, column, dimension, range),
            5 => uniform::<5>(words, column, dimension, range),
            _ => uniform::<6>(words, column, dimension, range),
        });
    }
}

/// As [`Row::uniform`], for a number of dimensions that is a constant, so that the compiler can vectorise the loop.
#[inline(always)]
fn uniform<const DIMENSIONS: usize>(words: &[u64], column: &mut [f64], dimension: usize, [lo, hi]: [f64; 2]) {
    for (value, row) in column.iter_mut().zip(words.as_chunks::<DIMENSIONS>().0) {
        *value = lo + between_0_and_1(row[dimension]) * (hi - lo);
    }
}

/// A number between 0 and 1 from the upper 52 bits of `word`: the middle of one of 2^52 equal parts, as in
/// [`rand::distr::Open01`].
#[inline(always)]
fn between_0_and_1(word: u64) -> f64 {
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    f64::from_bits(word >> 12 | ONE) - (1.0 - 0.5 * f64::EPSILON)
}

/// The launches with the numbers `range` of the random sequence with this `seed` over `space`.
pub fn random_tosses(space: &Space, seed: u64, range: Range<u64>) -> Vec<Toss> {
    let cube = Cube::new(space, space.free());
    let mut block = Block::new(space);
    let mut tosses = Vec::new();
    for start in range.clone().step_by(BLOCK) {
        block.start(usize::try_from(range.end - start).unwrap_or(BLOCK).min(BLOCK));
        write_random(&cube, seed, start, &mut block);
        tosses.extend(block.all_values().map(|values| space.toss(&values)));
    }
    tosses
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;
    use rand::distr::Open01;

    use super::*;
    use crate::coordinate::Coordinate::{self, RateX, RateY, RateZ, Speed};

    #[test]
    fn launch_i_depends_on_the_seed_and_i_alone() {
        let texts = [(RateX, "0:50"), (RateY, "normal:0:5"), (RateZ, "30"), (Speed, "3:5")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let all = random_tosses(&space, 7, 0..3000);
        for (start, end) in [(0, 1), (1, 4), (511, 513), (1000, 2100), (2999, 3000)] {
            assert_eq!(random_tosses(&space, 7, start..end), all[start as usize..end as usize]);
        }
        assert_ne!(random_tosses(&space, 8, 0..1)[0], all[0]);
    }

    #[test]
    fn draws_are_the_generators_numbers_in_their_order() {
        let ranges = ["0:50", "1:2", "-3:3", "3:5", "9:10", "0:1"];
        for free in 1..=Coordinate::COUNT {
            let fixed = |place: usize| if place < free { ranges[place] } else { "1" };
            let texts: Vec<_> = Coordinate::ALL.into_iter().map(|of| (of, fixed(of as usize))).collect();
            let space = Space::parse(Coin::PAPER, &texts).unwrap();
            let mut rng = ChaCha8Rng::seed_from_u64(9);
            for toss in random_tosses(&space, 9, 0..1500) {
                let values = Coordinate::ALL.map(|of| {
                    let [lo, hi] = space.axis(of).bounds();
                    if lo == hi { lo } else { lo + rng.sample::<f64, _>(Open01) * (hi - lo) }
                });
                assert_eq!(toss, space.toss(&values), "{free} free coordinates");
            }
        }
    }
}
