//! Tests of the random launches: which numbers they are made of, and that these are independent and uniform.

use std::convert::Infallible;

use dynamics::Coin;
use rand::distr::Open01;
use rand::{Rng, RngExt, TryRng};

use super::*;

const RANGES: [&str; Coordinate::COUNT] = ["0:50", "1:2", "-3:3", "3:5", "9:10", "0:1"];
const NORMALS: [&str; Coordinate::COUNT] =
    ["normal:0:5", "normal:1:2", "normal:-3:3", "normal:4:0.2", "normal:9:0.1", "normal:0:1"];

/// The space in which the coordinates of `free` vary as in `texts`.
fn space(free: &[Coordinate], texts: [&str; Coordinate::COUNT]) -> Space {
    let text = |of: Coordinate| if free.contains(&of) { texts[of as usize] } else { "1" };
    let texts: Vec<_> = Coordinate::ALL.into_iter().map(|of| (of, text(of))).collect();
    Space::parse(Coin::PAPER, &texts).unwrap()
}

/// The words of one coordinate as a generator of rand, launch by launch, computed one by one.
struct Stream {
    seed: u64,
    launch: u64,
    of: Coordinate,
}

impl TryRng for Stream {
    type Error = Infallible;

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let pair = PAIRS.iter().position(|pair| pair.contains(&self.of)).unwrap();
        let block = Philox::new(self.seed).block([self.launch, pair as u64]);
        self.launch += 1;
        Ok(block[usize::from(PAIRS[pair][1] == self.of)])
    }

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.try_next_u64().map(|word| (word >> 32) as u32)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for chunk in bytes.chunks_mut(8) {
            chunk.copy_from_slice(&self.try_next_u64()?.to_le_bytes()[..chunk.len()]);
        }
        Ok(())
    }
}

fn stream(seed: u64, of: Coordinate) -> Stream {
    Stream { seed, launch: 0, of }
}

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

/// All 64 sets of free coordinates: a coordinate has the same values whichever others vary.
#[test]
fn draws_are_quantiles_of_the_generators_numbers_as_rand_makes_them_uniform() {
    for (set, texts) in (0..1 << Coordinate::COUNT).flat_map(|set| [(set, RANGES), (set, NORMALS)]) {
        let free: Vec<Coordinate> = Coordinate::ALL.into_iter().filter(|of| set >> *of as usize & 1 == 1).collect();
        let space = space(&free, texts);
        let mut streams = Coordinate::ALL.map(|of| stream(9, of));
        for toss in random_tosses(&space, 9, 0..600) {
            let values = Coordinate::ALL.map(|of| {
                let part = streams[of as usize].sample::<f64, _>(Open01);
                space.axis(of).value().unwrap_or_else(|| space.axis(of).quantile(part))
            });
            assert_eq!(toss, space.toss(&values), "{free:?}");
        }
    }
}

#[test]
fn launches_have_the_same_bits_at_every_level_and_length() {
    let space = space(&Coordinate::ALL, RANGES);
    let cube = Cube::new(&space, space.free());
    let values = |level, start, length| {
        let mut block = Block::new(&space);
        block.start(length);
        write_at(level, &cube, 5, start, &mut block);
        block.all_values().collect::<Vec<_>>()
    };
    for level in SimdLevel::all() {
        // The number of the last launch exceeds 2^32, so that the counter has an upper half.
        for (start, length) in [(0, 0), (0, 1), (3, 7), (9, 31), ((1 << 32) - 100, BLOCK)] {
            assert_eq!(values(level, start, length), values(SimdLevel::all()[0], start, length), "{}", level.name());
        }
    }
}

/// Pairs of streams that must be independent: neighbouring launches of one coordinate, two coordinates (of one block and
/// of two), and two seeds, also those that differ in one high bit.
fn pairs_of_streams() -> Vec<(String, Stream, Stream)> {
    let mut pairs = Vec::new();
    for of in Coordinate::ALL {
        for lag in [1, 2, 512, 1 << 32] {
            pairs.push((format!("{of:?}, lag {lag}"), stream(1, of), Stream { launch: lag, ..stream(1, of) }));
        }
        for seed in [0, 2, 3, 1 << 32, 1 << 63] {
            pairs.push((format!("{of:?}, seeds 1 and {seed}"), stream(1, of), stream(seed, of)));
        }
        for other in Coordinate::ALL.into_iter().filter(|other| *other != of) {
            pairs.push((format!("{of:?} and {other:?}"), stream(1, of), stream(1, other)));
        }
    }
    pairs
}

/// Two independent uniform numbers fall into each of 256 cells with equal probability. For 255 degrees of freedom a χ²
/// above 400 has a probability below 1e-8, and one below 150 too.
#[test]
fn streams_are_independent_and_uniform() {
    const NUMBERS: u32 = 1 << 14;
    for (name, mut one, mut two) in pairs_of_streams() {
        let mut cells = [0_u32; 256];
        for _ in 0..NUMBERS {
            cells[(one.next_u64() >> 60 << 4 | two.next_u64() >> 60) as usize] += 1;
        }
        let expected = f64::from(NUMBERS) / 256.0;
        let chi_squared: f64 = cells.iter().map(|count| (f64::from(*count) - expected).powi(2) / expected).sum();
        assert!((150.0..400.0).contains(&chi_squared), "{name}: {chi_squared}");
    }
}

/// Among 2^18 different words of 64 bits, two equal ones have a probability of 2e-9.
#[test]
fn seeds_and_coordinates_share_no_numbers() {
    let mut words = Vec::new();
    for seed in 1..=8 {
        for of in Coordinate::ALL {
            let mut stream = stream(seed, of);
            words.extend((0..5_000).map(|_| stream.next_u64()));
        }
    }
    let number = words.len();
    words.sort_unstable();
    words.dedup();
    assert_eq!(words.len(), number);
}

/// Over 20 000 seeds the first number of a coordinate is uniform, and independent of that of the next seed.
#[test]
fn the_first_numbers_of_many_seeds_are_independent() {
    const SEEDS: u32 = 20_000;
    let first = |seed: u64, of| between_0_and_1(stream(seed, of).next_u64()) - 0.5;
    for of in Coordinate::ALL {
        let numbers: Vec<f64> = (0..=u64::from(SEEDS)).map(|seed| first(seed, of)).collect();
        let mean: f64 = numbers.iter().sum::<f64>() / f64::from(SEEDS);
        let lagged: f64 = numbers.windows(2).map(|pair| 12.0 * pair[0] * pair[1]).sum::<f64>() / f64::from(SEEDS);
        let deviation = f64::from(SEEDS).sqrt().recip();
        assert!(
            mean.abs() < 5.0 * deviation / 12.0_f64.sqrt() && lagged.abs() < 5.0 * deviation,
            "{of:?}: {mean}, {lagged}"
        );
    }
}
