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

use std::ops::Range;

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

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
    coordinates: Vec<(Directions, Keys)>,
}

impl ScrambledSobol {
    /// The sequence in `dimensions` dimensions with scramble number `scramble` of `seed`. `None` for more than
    /// [`DIMENSIONS`].
    pub fn new(dimensions: usize, seed: u64, scramble: u64) -> Option<Self> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(scramble);
        let coordinate = |dimension| (directions(dimension), std::array::from_fn(|_| rng.next_u64()));
        (dimensions <= DIMENSIONS).then(|| Self { coordinates: (0..dimensions).map(coordinate).collect() })
    }

    /// Calls `each` with the points of the sequence with the numbers `range`, which ends at [`MOST_POINTS`] or before.
    /// All coordinates lie strictly between 0 and 1. The points come in the order of the Gray code, which permutes each
    /// aligned run of 2^m points.
    pub fn for_each(&self, range: Range<u64>, mut each: impl FnMut(&[f64])) {
        let gray = range.start ^ (range.start >> 1);
        let start = |directions: &Directions| {
            (0..DEPTH as usize).filter(|j| gray >> j & 1 == 1).fold(0, |digits, j| digits ^ directions[j])
        };
        let mut digits: Vec<u64> = self.coordinates.iter().map(|(directions, _)| start(directions)).collect();
        let mut point = vec![0.0; digits.len()];
        for index in range {
            for ((digits, coordinate), (directions, keys)) in digits.iter_mut().zip(&mut point).zip(&self.coordinates) {
                *coordinate = scrambled(*digits, keys);
                // After the last point of all there is no next one; its bit would lie outside of the matrix.
                *digits ^= directions.get((index + 1).trailing_zeros() as usize).copied().unwrap_or(0);
            }
            each(&point);
        }
    }
}

/// The coordinate that Owen's scrambling makes of `digits`: the middle of an interval of length 2^-52.
#[expect(clippy::cast_precision_loss, reason = "both numbers have at most 53 bits")]
fn scrambled(digits: u64, keys: &Keys) -> f64 {
    let mut scrambled = 0;
    for (group, key) in (0..GROUPS as u32).zip(keys) {
        let below = DEPTH - GROUP * (group + 1);
        // A leading 1 tells prefixes of different lengths apart.
        let flips = hash(key, (1 << (GROUP * group)) | (digits >> (below + GROUP)));
        let path = (1 << GROUP) | (digits >> below & ((1 << GROUP) - 1));
        // Node 1 is the root of the tree. The digits before a digit, after a leading 1, number the node of its flip.
        let flipped =
            (1..=GROUP).rev().fold(path, |flipped, level| flipped ^ ((flips >> (path >> level) & 1) << (level - 1)));
        scrambled = scrambled << GROUP | (flipped & ((1 << GROUP) - 1));
    }
    let rest = hash(&keys[GROUPS], digits) >> (64 - (DIGITS - DEPTH));
    let numerator = (scrambled << (DIGITS - DEPTH) | rest) as f64 + 0.5;
    numerator / (1_u64 << DIGITS) as f64
}

/// 64 random bits for `prefix` under `key`.
fn hash(key: &u64, prefix: u64) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let mut z = key.wrapping_add(prefix.wrapping_mul(GOLDEN));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(sequence: &ScrambledSobol, range: Range<u64>) -> Vec<Vec<f64>> {
        let mut points = Vec::new();
        sequence.for_each(range, |point| points.push(point.to_vec()));
        points
    }

    /// The first eight points before scrambling, in the order of the Gray code, as published by P. Bratley and B. L.
    /// Fox, ACM Trans. Math. Softw. 14 (1988), 88, Algorithm 659.
    #[test]
    fn the_sequence_begins_as_published() {
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
        ];
        let sequence = ScrambledSobol::new(3, 1, 0).unwrap();
        let found = points(&sequence, 0..8);
        for (index, point) in (0_u64..).zip(expected) {
            let gray = index ^ (index >> 1);
            for (dimension, coordinate) in point.into_iter().enumerate() {
                let columns = directions(dimension);
                let digits = (0..DEPTH as usize).filter(|j| gray >> j & 1 == 1).fold(0, |sum, j| sum ^ columns[j]);
                assert_eq!(digits as f64 / MOST_POINTS as f64, coordinate, "point {index}, dimension {dimension}");
                let (_, keys) = &sequence.coordinates[dimension];
                assert_eq!(found[index as usize][dimension], scrambled(digits, keys));
            }
        }
    }

    /// The expected direction numbers m_6 to m_9 of all dimensions are read off the points 2^5 to 2^8 of SciPy 1.17,
    /// scipy.stats.qmc.Sobol(8, scramble=False).
    #[test]
    fn direction_numbers_are_those_of_scipy() {
        let expected: [[u64; DIMENSIONS]; 4] = [
            [1, 51, 23, 29, 55, 9, 37, 9],
            [1, 85, 71, 81, 61, 43, 31, 9],
            [1, 255, 197, 147, 157, 251, 227, 45],
            [1, 257, 209, 433, 181, 449, 381, 237],
        ];
        for (column, numbers) in (5..).zip(expected) {
            let found: [u64; DIMENSIONS] = std::array::from_fn(|dimension| directions(dimension)[column]);
            assert_eq!(found.map(|digits| digits >> (DEPTH as usize - 1 - column)), numbers);
        }
    }

    /// All ways to write `digits` as an ordered sum of `parts` numbers ≥ 0.
    fn compositions(digits: u32, parts: usize) -> Vec<Vec<u32>> {
        if parts == 1 {
            return vec![vec![digits]];
        }
        (0..=digits)
            .flat_map(|first| {
                compositions(digits - first, parts - 1).into_iter().map(move |rest| [vec![first], rest].concat())
            })
            .collect()
    }

    /// The number of points in each elementary interval, if dimension i is cut into 2^cut[i] parts.
    fn occupancy(points: &[Vec<f64>], cut: &[u32]) -> Vec<u32> {
        let mut counts = vec![0; 1 << cut.iter().sum::<u32>()];
        for point in points {
            let cell = point.iter().zip(cut).fold(0, |cell, (coordinate, digits)| {
                (cell << digits) | (coordinate * f64::from(1 << digits)) as usize
            });
            counts[cell] += 1;
        }
        counts
    }

    #[test]
    fn every_aligned_run_is_a_net_of_the_published_quality() {
        const QUALITY: [u32; DIMENSIONS] = [0, 0, 1, 3, 5, 8, 11, 15];
        for (dimensions, t) in (1..=DIMENSIONS).zip(QUALITY) {
            let m = t + if dimensions <= 4 { 7 } else { 3 };
            let sequence = ScrambledSobol::new(dimensions, 5, dimensions as u64).unwrap();
            for run in [0, 1, 6] {
                let points = points(&sequence, run << m..(run + 1) << m);
                for cut in compositions(m - t, dimensions) {
                    let counts = occupancy(&points, &cut);
                    assert!(counts.iter().all(|count| *count == 1 << t), "s = {dimensions}, run {run}, {cut:?}");
                }
            }
        }
    }

    #[test]
    fn the_published_quality_is_not_exceeded_in_three_dimensions() {
        // t = 1 means that some interval with the volume of one point does not hold exactly one.
        let points = points(&ScrambledSobol::new(3, 5, 0).unwrap(), 0..1 << 6);
        assert!(compositions(6, 3).iter().any(|cut| occupancy(&points, cut).iter().any(|count| *count != 1)));
    }

    #[test]
    fn any_range_can_be_generated_up_to_the_last_point() {
        let sequence = ScrambledSobol::new(DIMENSIONS, 1, 0).unwrap();
        let all = points(&sequence, 1_000_000..1_000_100);
        assert_eq!(points(&sequence, 1_000_050..1_000_060), all[50..60]);
        let last = points(&sequence, MOST_POINTS - 3..MOST_POINTS);
        assert!(last.iter().flatten().all(|coordinate| 0.0 < *coordinate && *coordinate < 1.0));
        assert!(ScrambledSobol::new(DIMENSIONS + 1, 1, 0).is_none());
    }

    /// The expected numbers are outputs of S. Vigna's splitmix64.c for the seeds 0 and 1234567. It adds the constant
    /// `GOLDEN` before each hash, as a prefix of 1, 2, 3 does here.
    #[test]
    fn the_hash_is_that_of_splitmix64() {
        let outputs = |seed: u64| [1, 2, 3].map(|number| hash(&seed, number));
        assert_eq!(outputs(0), [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f]);
        assert_eq!(
            outputs(1_234_567),
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
    }

    /// The expected digits are computed one by one from Owen's definition.
    #[test]
    fn each_digit_is_flipped_by_a_bit_that_depends_on_the_digits_before_it() {
        let keys: Keys = std::array::from_fn(|index| hash(&3, index as u64));
        for digits in (0..500).map(|number| hash(&4, number) >> (64 - DEPTH)).chain([0, MOST_POINTS - 1]) {
            let first = |number: u32| digits >> (DEPTH - number);
            let flip = |digit: u32| {
                let (group, level) = (digit / GROUP, digit % GROUP);
                let flips = hash(&keys[group as usize], 1 << (GROUP * group) | first(GROUP * group));
                let within_group = first(digit) & ((1 << level) - 1);
                flips >> (1 << level | within_group) & 1
            };
            let flipped = (0..DEPTH).fold(0, |flipped, digit| flipped << 1 | (first(digit + 1) & 1 ^ flip(digit)));
            let numerator = flipped << 16 | hash(&keys[6], digits) >> 48;
            assert_eq!(scrambled(digits, &keys), (numerator as f64 + 0.5) / 2f64.powi(52));
        }
    }

    /// Over many scrambles one point is uniform. Two points that share exactly the first d digits always differ in the
    /// next one, and are independent in all digits after it.
    #[test]
    fn scrambles_are_uniform_and_nested() {
        const SCRAMBLES: u64 = 4096;
        let (mut bits, mut parted) = ([[0_u32; DIGITS as usize]; 2], 0);
        for scramble in 0..SCRAMBLES {
            let sequence = ScrambledSobol::new(1, 9, scramble).unwrap();
            // Points 1 and 2 in the order of the Gray code are 0.5 and 0.75, which share the first digit.
            let point = points(&sequence, 1..3);
            let digits = [point[0][0], point[1][0]].map(|coordinate| (coordinate * 2f64.powi(52)) as u64);
            assert_eq!((digits[0] ^ digits[1]) >> 50, 1, "one digit in common, the next one different");
            for (bits, digits) in bits.iter_mut().zip(digits) {
                for (place, count) in bits.iter_mut().enumerate() {
                    *count += (digits >> place & 1) as u32;
                }
            }
            parted += ((digits[0] ^ digits[1]) & ((1 << 50) - 1)).count_ones();
        }
        // Five standard deviations of a binomial count.
        let half = SCRAMBLES as f64 / 2.0;
        let within = 5.0 * (SCRAMBLES as f64 / 4.0).sqrt();
        assert!(bits.iter().flatten().all(|count| (f64::from(*count) - half).abs() < within), "{bits:?}");
        let within = 5.0 * (50.0 * SCRAMBLES as f64 / 4.0).sqrt();
        assert!((f64::from(parted) - 50.0 * half).abs() < within, "{parted}");
    }
}
