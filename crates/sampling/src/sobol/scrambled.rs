//! This file scrambles one coordinate of many Sobol points at once. Points are computed in windows of 2^12 successive
//! ones, in which all digits from the 13th on are constant, so that most of the work is the same in every lane.
//!
//! Bit j of a point's index changes none of the digits after digit j + 1, because column j of the generator matrix ends
//! there. So the points of an aligned window of 2^12 differ in their first twelve digits alone. Let p be these, with a
//! leading 1 that tells prefixes of different lengths apart. The prefix of the group that follows after 6k further
//! digits is then 2^(6k) p + c with a constant c, and one product of p serves the hashes of all groups:
//!
//! ```text
//! key + GOLDEN (2^(6k) p + c) = 2^(6k) (GOLDEN p) + (key + GOLDEN c)      modulo 2^64
//! ```
//!
//! The path through the tree of a group is constant too: it says which six of the hash's 64 bits are the flips. The first
//! twelve digits have no constant path. They are looked up in a table of all 2^12 prefixes, or are scrambled one by one
//! if the points are too few to pay for the table.

use numerics::lanes::{Simd, SimdLevel, WithSimd};

use super::{DEPTH, DIGITS, Directions, GOLDEN, GROUP, GROUPS, Keys, hash, mixed};
use crate::random::between_0_and_1;

/// Number of groups of digits that vary within a window.
const VARYING: usize = 2;
/// Number of digits that vary within a window.
const VARYING_DIGITS: u32 = GROUP * VARYING as u32;
/// Number of points in a window.
pub(super) const WINDOW: u64 = 1 << VARYING_DIGITS;
/// Number of digits that are constant within a window.
const CONSTANT_DIGITS: u32 = DEPTH - VARYING_DIGITS;
/// Number of groups of such digits.
const CONSTANT: usize = GROUPS - VARYING;
/// Most points that are computed together.
pub(super) const PART: usize = 512;
/// Number of digits of a coordinate that do not come from the sequence.
const REST_DIGITS: u32 = DIGITS - DEPTH;
/// Place of the last digit in a word of which the first bit is the first digit.
const LAST: u32 = 64 - DIGITS;

/// The first twelve digits of a coordinate, scrambled, for each of their values.
type FirstDigits = [u16; WINDOW as usize];

/// One coordinate of a scrambled sequence.
#[derive(Debug, Clone)]
pub(super) struct ScrambledCoordinate {
    pub(super) directions: Directions,
    pub(super) keys: Keys,
    /// The table, if there is one.
    pub(super) first_digits: Option<Box<FirstDigits>>,
}

impl ScrambledCoordinate {
    /// Makes the table of the first digits.
    pub(super) fn prepare(&mut self) {
        let table: Vec<u16> = (0..WINDOW).map(|digits| self.first_scrambled(digits)).collect();
        self.first_digits = table.into_boxed_slice().try_into().ok();
    }

    /// Writes the points from number `start` on. They are at most [`PART`], and of one window.
    pub(super) fn write_part(&self, level: SimdLevel, start: u64, to: &mut [f64]) {
        let gray = start ^ (start >> 1);
        let bits = (0..DEPTH as usize).filter(|j| gray >> j & 1 == 1);
        let digits = bits.fold(0, |digits, j| digits ^ self.directions[j]);
        let (mut prefixes, mut first) = ([0; PART], [0; PART]);
        let (prefixes, first) = (&mut prefixes[..to.len()], &mut first[..to.len()]);
        let mut prefix = digits >> CONSTANT_DIGITS;
        for (number, (to, first)) in (start + 1..).zip(prefixes.iter_mut().zip(first.iter_mut())) {
            *to = prefix as u16;
            *first = match &self.first_digits {
                Some(table) => table[prefix as usize],
                None => self.first_scrambled(prefix),
            };
            // The step to the next window changes no digit that is used here.
            let column = number.trailing_zeros().min(VARYING_DIGITS - 1);
            prefix ^= self.directions[column as usize] >> CONSTANT_DIGITS;
        }
        let constants = WindowConstants::new(digits & ((1 << CONSTANT_DIGITS) - 1), &self.keys);
        level.run(Scramble { constants, prefixes, first, to });
    }

    /// The first twelve digits, scrambled.
    #[expect(clippy::cast_possible_truncation, reason = "twelve digits")]
    fn first_scrambled(&self, digits: u64) -> u16 {
        let (upper, lower) = (digits >> GROUP, digits & ((1 << GROUP) - 1));
        let upper_scrambled = flipped(upper, hash(self.keys[0], 1));
        (upper_scrambled << GROUP | flipped(lower, hash(self.keys[1], 1 << GROUP | upper))) as u16
    }
}

/// The digits of a group after their flips. Node 1 is the root of the tree; the digits before a digit, after a leading
/// 1, number the node of its flip.
pub(super) fn flipped(digits: u64, flips: u64) -> u64 {
    let path = (1 << GROUP) | digits;
    (1..=GROUP).fold(digits, |flipped, level| flipped ^ ((flips >> (path >> level) & 1) << (level - 1)))
}

/// What is the same for all points of a window.
struct WindowConstants {
    /// The constant digits, at their places in the word.
    digits: u64,
    /// For each group of constant digits, what is added to the multiple of the prefix in the hash.
    offsets: [u64; CONSTANT],
    /// The same for the digits that do not come from the sequence.
    rest_offset: u64,
    /// By how much the flips of each group are rotated to the right, to bring each flip to the place of its digit.
    rotations: [[u32; GROUP as usize]; CONSTANT],
}

impl WindowConstants {
    fn new(digits: u64, keys: &Keys) -> Self {
        // The group's own digits, and how many digits stand after it.
        let after = |group: usize| CONSTANT_DIGITS - GROUP * (group as u32 + 1);
        let path = |group: usize| 1 << GROUP | digits >> after(group) & ((1 << GROUP) - 1);
        let before = |group: usize| digits >> (after(group) + GROUP);
        let offset = |key: u64, constant: u64| key.wrapping_add(constant.wrapping_mul(GOLDEN));
        let rotation = |group: usize, level: u32| {
            let (node, place) = (path(group) >> level, LAST + REST_DIGITS + after(group) + level - 1);
            (node as u32).wrapping_sub(place) % 64
        };
        // The remaining digits have a prefix without a leading 1.
        let leading = 1_u64 << DEPTH;
        Self {
            digits: digits << (LAST + REST_DIGITS),
            offsets: std::array::from_fn(|group| offset(keys[VARYING + group], before(group))),
            rest_offset: offset(keys[GROUPS], digits.wrapping_sub(leading)),
            rotations: std::array::from_fn(|group| std::array::from_fn(|level| rotation(group, level as u32 + 1))),
        }
    }
}

/// The scramble of the points of a window, from their first digits to their coordinates. The loop is so plain that the
/// compiler vectorises it.
struct Scramble<'a> {
    constants: WindowConstants,
    prefixes: &'a [u16],
    first: &'a [u16],
    to: &'a mut [f64],
}

impl WithSimd for Scramble<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let WindowConstants { digits, offsets, rest_offset, rotations } = self.constants;
        for ((prefix, first), to) in self.prefixes.iter().zip(self.first).zip(self.to) {
            let product = (WINDOW | u64::from(*prefix)).wrapping_mul(GOLDEN);
            let mut word = u64::from(*first) << (64 - VARYING_DIGITS) ^ digits;
            for group in 0..CONSTANT {
                let flips = mixed((product << (GROUP * group as u32)).wrapping_add(offsets[group]));
                for level in 0..GROUP {
                    let place = LAST + REST_DIGITS + CONSTANT_DIGITS - GROUP * (group as u32 + 1) + level;
                    word ^= flips.rotate_right(rotations[group][level as usize]) & 1 << place;
                }
            }
            let rest = mixed((product << CONSTANT_DIGITS).wrapping_add(rest_offset));
            *to = between_0_and_1(word | rest >> (64 - REST_DIGITS) << LAST);
        }
    }
}
