//! This file draws the launches of method B, which are random and independent. The random number of a coordinate is a
//! function of the seed, the number of the launch and the coordinate alone, so that threads can draw any part of the
//! sequence, and a coordinate keeps its numbers whichever others vary.
//!
//! The numbers are blocks of the counter-based generator [`Philox`], which has 128 bits for each counter: enough for two
//! coordinates.

use std::ops::Range;

use dynamics::Toss;
use numerics::lanes::{Philox, Simd, SimdLevel, WithSimd};

use crate::axis::{Axis, Distribution};
use crate::block::{BLOCK, Block};
use crate::coordinate::Coordinate::{self, Drop, Gravity, Psi, RateX, RateY, RateZ, Speed, Tilt, Turn};
use crate::space::{Cube, Space};

/// The coordinates that share a block of the generator; the number of the pair is the upper half of the counter. The
/// first rate and the speed come first, so that the many spaces in which only these vary take one block a launch.
const PAIRS: [[Option<Coordinate>; 2]; 5] = [
    [Some(RateX), Some(Speed)],
    [Some(RateY), Some(RateZ)],
    [Some(Gravity), Some(Tilt)],
    [Some(Turn), Some(Psi)],
    [Some(Drop), None],
];

/// Writes the launches from number `start` on of the random sequence with this `seed` over `cube` into `block`.
pub(crate) fn write_random(cube: &Cube, seed: u64, start: u64, block: &mut Block) {
    write_at(SimdLevel::widest(), cube, seed, start, block);
}

/// As [`write_random`], at a SIMD level.
fn write_at(level: SimdLevel, cube: &Cube, seed: u64, start: u64, block: &mut Block) {
    let generator = Philox::new(seed);
    for (number, pair) in (0..).zip(PAIRS) {
        let axes = pair.map(|of| cube.axes().iter().find(|(free, _)| Some(*free) == of).map(|(_, axis)| *axis));
        if axes == [None, None] {
            continue;
        }
        let free = [0, 1].map(|place| pair[place].filter(|_| axes[place].is_some()));
        let mut columns = block.two_columns_mut(free);
        level.run(Numbers { generator, start, pair: number, ranges: axes.map(range), columns: &mut columns });
        for (axis, column) in axes.into_iter().zip(columns) {
            if let Some(axis) = axis.filter(|axis| matches!(axis.distribution(), Distribution::Normal { .. })) {
                axis.to_quantiles(column);
            }
        }
    }
}

/// The range of the uniform numbers from which the values of an axis are made.
fn range(axis: Option<Axis>) -> [f64; 2] {
    match axis.map(|axis| axis.distribution()) {
        Some(Distribution::Uniform { lo, hi }) => [lo, hi],
        _ => [0.0, 1.0],
    }
}

/// Uniform random numbers for the columns of a pair of coordinates.
struct Numbers<'a, 'b> {
    generator: Philox,
    /// Number of the first launch.
    start: u64,
    /// Number of the pair.
    pair: u64,
    ranges: [[f64; 2]; 2],
    columns: &'a mut [&'b mut [f64]; 2],
}

impl WithSimd for Numbers<'_, '_> {
    type Output = ();

    /// The loop is so plain that the compiler vectorises it.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { generator, start, pair, ranges: [[lo, hi], [other_lo, other_hi]], columns: [one, two] } = self;
        for (launch, (one, two)) in (start..).zip(one.iter_mut().zip(two.iter_mut())) {
            let [first, second] = generator.block([launch, pair]);
            *one = lo + between_0_and_1(first) * (hi - lo);
            *two = other_lo + between_0_and_1(second) * (other_hi - other_lo);
        }
    }
}

/// A number between 0 and 1 from the upper 52 bits of `word`: the middle of one of 2^52 equal parts, as in
/// [`rand::distr::Open01`].
#[inline(always)]
pub(crate) fn between_0_and_1(word: u64) -> f64 {
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
mod tests;
