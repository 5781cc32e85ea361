//! This file generates the points of Sobol's low-discrepancy sequence with Owen's scrambling. The points fill a cube
//! more evenly than random ones, so that estimates converge faster, and independent scrambles still give an error
//! estimate.
//!
//! All digits are binary; a coordinate has 52 of them. Every run of 2^m points that starts at a multiple of 2^m is a
//! (t, m, s)-net in base 2: each elementary interval of volume 2^(t-m) holds exactly 2^t of the points. In s dimensions
//! t = Σ (degree of the dimension's polynomial - 1), that is 0, 0, 1, 3, 5, 8, 11, 15 for s = 1 to 8.
//!
//! Owen's nested uniform scrambling flips digit d of a coordinate by a random bit that depends on the d - 1 digits
//! before it. Each point is then uniform over the cube, every run stays a net, and independent scrambles give
//! independent estimates, whose spread is the error. The random bits form a binary tree. Those for six successive
//! digits are 63 nodes of it, and one 64-bit hash of the digits before them gives all 63. From digit 37 on, at most one
//! point has any given prefix, so one hash gives all remaining digits.
//!
//! Sources: I. M. Sobol', USSR Comput. Math. Math. Phys. 7 (1967), 86 (the sequence, t); S. Joe and F. Y. Kuo, SIAM J.
//! Sci. Comput. 30 (2008), 2635 (direction numbers); A. B. Owen, in Monte Carlo and Quasi-Monte Carlo Methods in
//! Scientific Computing (1995), 299 (scrambling); D. Stafford, "Better bit mixing" (2011), variant 13 (the hash).

mod scrambled;

use numerics::lanes::SimdLevel;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

use scrambled::{PART, ScrambledCoordinate, WINDOW};

/// Number of dimensions.
pub const DIMENSIONS: usize = 8;

/// Number of digits of a coordinate that come from the sequence: 2^36 points differ in each coordinate.
const DEPTH: u32 = 36;
/// Number of digits of a coordinate in all.
const DIGITS: u32 = 52;
/// Number of digits whose flips come from one hash.
const GROUP: u32 = 6;
/// Number of such groups of digits.
const GROUPS: usize = (DEPTH / GROUP) as usize;

/// Number of points of the sequence.
pub const MOST_POINTS: u64 = 1 << DEPTH;

/// Primitive polynomial x^s + a_1 x^(s-1) + … + 1 of each dimension after the first, as its degree s, the coefficients
/// a_1 … a_(s-1) as a binary number, and the first s direction numbers: the set new-joe-kuo-6.21201 of Joe and Kuo.
const POLYNOMIALS: [(usize, u64, &[u64]); DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
];

/// A generator matrix. Column j holds the digits that bit j of the index adds modulo 2; the highest of its DEPTH bits
/// is the first digit.
type Directions = [u64; DEPTH as usize];

/// The generator matrix of a dimension, from its polynomial; that of dimension 0 is van der Corput's sequence.
fn directions(dimension: usize) -> Directions {
    let mut numbers = [1_u64; DEPTH as usize];
    if let Some(&(degree, coefficients, first)) = dimension.checked_sub(1).and_then(|index| POLYNOMIALS.get(index)) {
        numbers[..degree].copy_from_slice(first);
        for j in degree..DEPTH as usize {
            numbers[j] = numbers[j - degree] ^ (numbers[j - degree] << degree);
            for i in 1..degree {
                numbers[j] ^= ((coefficients >> (degree - 1 - i)) & 1) * (numbers[j - i] << i);
            }
        }
    }
    std::array::from_fn(|j| numbers[j] << (DEPTH as usize - 1 - j))
}

/// The random keys of the hash that scramble one coordinate: one for each group of digits, and one for the remaining
/// digits.
type Keys = [u64; GROUPS + 1];

/// A scrambled Sobol sequence.
#[derive(Debug, Clone)]
pub struct ScrambledSobol {
    coordinates: Vec<ScrambledCoordinate>,
}

impl ScrambledSobol {
    /// The sequence in `dimensions` dimensions with scramble number `scramble` of `seed`. `None` for more than
    /// [`DIMENSIONS`].
    pub fn new(dimensions: usize, seed: u64, scramble: u64) -> Option<Self> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(scramble);
        let coordinate = |dimension| ScrambledCoordinate {
            directions: directions(dimension),
            keys: std::array::from_fn(|_| rng.next_u64()),
            first_digits: None,
        };
        (dimensions <= DIMENSIONS).then(|| Self { coordinates: (0..dimensions).map(coordinate).collect() })
    }

    /// The same sequence, prepared for about `points` points: a table of scrambled digits is made if that many pay for
    /// it. It changes no point.
    #[must_use]
    pub fn prepared_for(mut self, points: u64) -> Self {
        if points > 2 * WINDOW {
            self.coordinates.iter_mut().for_each(ScrambledCoordinate::prepare);
        }
        self
    }

    /// Number of dimensions.
    pub fn dimensions(&self) -> usize {
        self.coordinates.len()
    }

    /// Writes one coordinate of the points from number `start` on into `to`, strictly between 0 and 1. The points come
    /// in the order of the Gray code, which permutes each aligned run of 2^m points.
    ///
    /// # Panics
    /// If there is no such `dimension`, or if a point has a number of [`MOST_POINTS`] or above.
    pub fn write(&self, dimension: usize, start: u64, to: &mut [f64]) {
        self.write_at(SimdLevel::widest(), dimension, start, to);
    }

    /// As [`ScrambledSobol::write`], at a SIMD level.
    fn write_at(&self, level: SimdLevel, dimension: usize, start: u64, to: &mut [f64]) {
        let coordinate = &self.coordinates[dimension];
        assert!(start <= MOST_POINTS && to.len() as u64 <= MOST_POINTS - start, "a point of the sequence");
        let mut done = 0;
        while done < to.len() {
            let at = start + done as u64;
            let left = usize::try_from(WINDOW - at % WINDOW).expect("a few thousand").min(PART);
            let end = to.len().min(done + left);
            coordinate.write_part(level, at, &mut to[done..end]);
            done = end;
        }
    }
}

/// 64 random bits for `prefix` under `key`.
fn hash(key: u64, prefix: u64) -> u64 {
    mixed(key.wrapping_add(prefix.wrapping_mul(GOLDEN)))
}

/// The factor of the prefix in [`hash`].
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The second part of [`hash`], a permutation of all numbers that changes half of the bits for any change.
#[inline(always)]
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests;
