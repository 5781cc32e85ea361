//! Tests of the Sobol points: known numbers, the scramble, and how evenly the points lie.

use std::ops::Range;

use super::scrambled::flipped;
use super::*;

/// Points 1 000 000 and 1 000 001 in four dimensions, seed 1, scramble 2.
const KEPT: [[f64; 4]; 2] = [
    [0.42793437597506256, 0.5582446034822034, 0.3635662184237979, 0.35454018352755223],
    [0.8447508215951883, 0.19657601741883746, 0.6592007104317813, 0.838205773919059],
];

fn points(sequence: &ScrambledSobol, range: Range<u64>) -> Vec<Vec<f64>> {
    let mut columns = vec![vec![0.0; (range.end - range.start) as usize]; sequence.dimensions()];
    for (dimension, column) in columns.iter_mut().enumerate() {
        sequence.write(dimension, range.start, column);
    }
    (0..columns.first().map_or(0, Vec::len)).map(|index| columns.iter().map(|column| column[index]).collect()).collect()
}

/// The digits of point number `index` before scrambling.
fn digits(directions: &Directions, index: u64) -> u64 {
    let gray = index ^ (index >> 1);
    (0..DEPTH as usize).filter(|j| gray >> j & 1 == 1).fold(0, |sum, j| sum ^ directions[j])
}

/// The coordinate that Owen's scrambling makes of `digits`, one group of digits after the other: the middle of an
/// interval of length 2^-52.
fn scrambled(digits: u64, keys: &Keys) -> f64 {
    let mut scrambled = 0;
    for (group, key) in (0..GROUPS as u32).zip(keys) {
        let below = DEPTH - GROUP * (group + 1);
        // A leading 1 tells prefixes of different lengths apart.
        let flips = hash(*key, (1 << (GROUP * group)) | (digits >> (below + GROUP)));
        scrambled = scrambled << GROUP | flipped(digits >> below & ((1 << GROUP) - 1), flips);
    }
    let rest = hash(keys[GROUPS], digits) >> (64 - (DIGITS - DEPTH));
    ((scrambled << (DIGITS - DEPTH) | rest) as f64 + 0.5) / (1_u64 << DIGITS) as f64
}

/// With and without the table of the first digits, at every SIMD level, over windows and parts of windows.
#[test]
fn points_in_lanes_are_those_of_the_scalar_form() {
    let plain = ScrambledSobol::new(DIMENSIONS, 11, 3).unwrap();
    let prepared = plain.clone().prepared_for(1 << 20);
    assert!(prepared.coordinates.iter().all(|coordinate| coordinate.first_digits.is_some()));
    assert!(plain.clone().prepared_for(1 << 13).coordinates.iter().all(|coordinate| coordinate.first_digits.is_none()));
    let ranges = [0..1, 0..700, 4000..4200, 8191..8193, 123_456_789..123_461_000, MOST_POINTS - 70..MOST_POINTS];
    for (dimension, coordinate) in plain.coordinates.iter().enumerate() {
        for range in &ranges {
            let expected: Vec<u64> = range
                .clone()
                .map(|index| scrambled(digits(&coordinate.directions, index), &coordinate.keys).to_bits())
                .collect();
            for (level, sequence) in
                SimdLevel::all().into_iter().flat_map(|level| [(level, &plain), (level, &prepared)])
            {
                let mut found = vec![f64::NAN; expected.len()];
                sequence.write_at(level, dimension, range.start, &mut found);
                let found: Vec<u64> = found.into_iter().map(f64::to_bits).collect();
                assert_eq!(found, expected, "dimension {dimension}, {range:?} at {}", level.name());
            }
        }
    }
}

/// These points were computed before the scramble was vectorised; estimates by Sobol points are made of them.
#[test]
fn points_have_kept_their_values() {
    let sequence = ScrambledSobol::new(4, 1, 2).unwrap();
    let found = points(&sequence, 1_000_000..1_000_002);
    assert_eq!(found, KEPT);
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
        for (dimension, coordinate) in point.into_iter().enumerate() {
            let digits = digits(&directions(dimension), index);
            assert_eq!(digits as f64 / MOST_POINTS as f64, coordinate, "point {index}, dimension {dimension}");
            let keys = &sequence.coordinates[dimension].keys;
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
        let cell = point
            .iter()
            .zip(cut)
            .fold(0, |cell, (coordinate, digits)| (cell << digits) | (coordinate * f64::from(1 << digits)) as usize);
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
    let outputs = |seed: u64| [1, 2, 3].map(|number| hash(seed, number));
    assert_eq!(outputs(0), [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f]);
    assert_eq!(outputs(1_234_567), [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
}

/// The expected digits are computed one by one from Owen's definition.
#[test]
fn each_digit_is_flipped_by_a_bit_that_depends_on_the_digits_before_it() {
    let keys: Keys = std::array::from_fn(|index| hash(3, index as u64));
    for digits in (0..500).map(|number| hash(4, number) >> (64 - DEPTH)).chain([0, MOST_POINTS - 1]) {
        let first = |number: u32| digits >> (DEPTH - number);
        let flip = |digit: u32| {
            let (group, level) = (digit / GROUP, digit % GROUP);
            let flips = hash(keys[group as usize], 1 << (GROUP * group) | first(GROUP * group));
            let within_group = first(digit) & ((1 << level) - 1);
            flips >> (1 << level | within_group) & 1
        };
        let flipped = (0..DEPTH).fold(0, |flipped, digit| flipped << 1 | (first(digit + 1) & 1 ^ flip(digit)));
        let numerator = flipped << 16 | hash(keys[6], digits) >> 48;
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
