//! Tests of the random launches: which numbers they are made of.

use std::convert::Infallible;

use dynamics::Coin;
use rand::distr::Open01;
use rand::{RngExt, TryRng};

use super::*;

const RANGES: [&str; 7] = ["0:50", "1:2", "-3:3", "3:5", "9:10", "0:1", "-0.04:1"];
const NORMALS: [&str; 7] =
    ["normal:0:5", "normal:1:2", "normal:-3:3", "normal:4:0.2", "normal:9:0.1", "normal:0:1", "normal:1:0.1"];

/// The coordinates of a space of rates.
const OF_RATES: [Coordinate; 7] = [RateX, RateY, RateZ, Speed, Gravity, Tilt, Drop];

/// The space in which the coordinates of `free` vary as in `texts`.
fn space(free: &[Coordinate], texts: [&str; 7]) -> Space {
    let text = |(of, text)| (of, if free.contains(&of) { text } else { "1" });
    let texts: Vec<_> = OF_RATES.into_iter().zip(texts).map(text).collect();
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
        let pair = PAIRS.iter().position(|pair| pair.contains(&Some(self.of))).unwrap();
        let block = Philox::new(self.seed).block([self.launch, pair as u64]);
        self.launch += 1;
        Ok(block[usize::from(PAIRS[pair][1] == Some(self.of))])
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

/// All 128 sets of free coordinates: a coordinate has the same values whichever others vary.
#[test]
fn draws_are_quantiles_of_the_generators_numbers_as_rand_makes_them_uniform() {
    for (set, texts) in (0..1 << OF_RATES.len()).flat_map(|set| [(set, RANGES), (set, NORMALS)]) {
        let free: Vec<Coordinate> =
            OF_RATES.into_iter().zip(0..).filter(|(_, place)| set >> place & 1 == 1).map(|(of, _)| of).collect();
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
    let space = space(&OF_RATES, RANGES);
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
