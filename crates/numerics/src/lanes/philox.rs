//! Philox4x32-10, a random number generator without a state: a block of random bits is a function of a counter and a
//! key alone. Any number of a sequence can therefore be computed on its own, in any lane and on any thread.
//!
//! The counter is a block of four words of 32 bits, the key has two. Each of ten rounds multiplies two words of the
//! block by constants, and mixes the upper halves of the products with the other two words and with the key of the
//! round. A change of the counter or of the key makes another block; two counters never give the same block under one
//! key, because each round can be undone.
//!
//! The code is plain Rust. It needs no other operations than 32-bit products, shifts and bitwise operations on words of
//! 64 bits, so the compiler turns a loop over counters into SIMD instructions by itself, and integers have the same
//! bits at every SIMD level.
//!
//! Source: J. K. Salmon, M. A. Moraes, R. O. Dror and D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3",
//! Proc. SC11 (2011), doi 10.1145/2063384.2063405.

/// Number of rounds. The authors found no statistical weakness from seven rounds on, and recommend ten for a margin.
const ROUNDS: usize = 10;

/// The factors of the first and the third word.
const FACTORS: [u64; 2] = [0xd251_1f53, 0xcd9e_8d57];

/// What is added to the two words of the key from round to round.
const KEY_STEPS: [u32; 2] = [0x9e37_79b9, 0xbb67_ae85];

/// The lower half of a word of 64 bits.
const LOWER: u64 = 0xffff_ffff;

/// The generator with a key, prepared for all its rounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Philox {
    keys: [[u32; 2]; ROUNDS],
}

impl Philox {
    /// The generator with this key, whose first word is the lower half of `key`.
    pub const fn new(key: u64) -> Self {
        let mut keys = [[key as u32, (key >> 32) as u32]; ROUNDS];
        let mut round = 1;
        while round < ROUNDS {
            let [first, second] = keys[round - 1];
            keys[round] = [first.wrapping_add(KEY_STEPS[0]), second.wrapping_add(KEY_STEPS[1])];
            round += 1;
        }
        Self { keys }
    }

    /// The random block of a counter. Blocks are written as two numbers of 64 bits; the first word of a block is the
    /// lower half of the first number, the second word its upper half.
    #[inline(always)]
    #[must_use]
    pub fn block(&self, counter: [u64; 2]) -> [u64; 2] {
        let [mut a, mut b, mut c, mut d] = [counter[0] & LOWER, counter[0] >> 32, counter[1] & LOWER, counter[1] >> 32];
        // The upper halves of all words are 0, which lets the compiler choose the short multiplication.
        for [first, second] in self.keys.map(|key| key.map(u64::from)) {
            let (one, two) = (a * FACTORS[0], c * FACTORS[1]);
            [a, b, c, d] = [(two >> 32) ^ b ^ first, two & LOWER, (one >> 32) ^ d ^ second, one & LOWER];
        }
        [a | b << 32, c | d << 32]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::SimdLevel;

    /// The answers that are published with the authors' library Random123, in its file `tests/kat_vectors`, lines
    /// `philox4x32 10`: four words of the counter, two of the key, and the four words of the block.
    const KNOWN: [([u32; 4], [u32; 2], [u32; 4]); 3] = [
        ([0; 4], [0; 2], [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]),
        ([u32::MAX; 4], [u32::MAX; 2], [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]),
        (
            [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344],
            [0xa409_3822, 0x299f_31d0],
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1],
        ),
    ];

    fn pair(low: u32, high: u32) -> u64 {
        u64::from(low) | u64::from(high) << 32
    }

    fn pairs([a, b, c, d]: [u32; 4]) -> [u64; 2] {
        [pair(a, b), pair(c, d)]
    }

    #[test]
    fn blocks_are_the_published_answers() {
        for (counter, [low, high], expected) in KNOWN {
            let found = Philox::new(pair(low, high)).block(pairs(counter));
            assert_eq!(found, pairs(expected), "{counter:x?} {low:x} {high:x}");
        }
    }

    /// A loop over counters, which the compiler vectorises differently at each level.
    #[test]
    fn blocks_in_lanes_are_the_same_at_every_level() {
        let (counter, key) = (pairs(KNOWN[2].0), 0x0123_4567_89ab_cdef);
        let generator = Philox::new(key);
        let expected: Vec<[u64; 2]> = (0..37).map(|i| generator.block([counter[0] + i, counter[1]])).collect();
        assert_eq!(Philox::new(pair(KNOWN[2].1[0], KNOWN[2].1[1])).block(counter), pairs(KNOWN[2].2));
        for level in SimdLevel::all() {
            let mut found = [[0; 37]; 2];
            level.run(|| {
                let [one, two] = &mut found;
                for (index, (one, two)) in (0_u64..).zip(one.iter_mut().zip(two)) {
                    [*one, *two] = generator.block([counter[0] + index, counter[1]]);
                }
            });
            for (index, expected) in expected.iter().enumerate() {
                assert_eq!([found[0][index], found[1][index]], *expected, "block {index} at {}", level.name());
            }
        }
    }
}
