//! Method B: independent random launches.
//!
//! Launch i depends on the seed and on i only: the random numbers are the output of a block cipher in counter mode
//! (ChaCha with 8 rounds), read at a position that follows from i.

use std::ops::Range;

use dynamics::Toss;
use rand::distr::Open01;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::space::{Cube, Space, Values};

/// The launches `range` of the random sequence of `seed` over `cube`.
pub(crate) fn random_values(cube: &Cube, seed: u64, range: Range<u64>) -> Vec<Values> {
    const WORDS_PER_NUMBER: u128 = 2;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_word_pos(u128::from(range.start) * cube.dimensions() as u128 * WORDS_PER_NUMBER);
    range.map(|_| cube.values(|_| rng.sample::<f64, _>(Open01))).collect()
}

/// The launches `range` of the random sequence of `seed` over `space`.
pub fn random_tosses(space: &Space, seed: u64, range: Range<u64>) -> Vec<Toss> {
    let cube = Cube::new(space, space.free());
    random_values(&cube, seed, range).iter().map(|values| space.toss(values)).collect()
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed};

    #[test]
    fn launch_i_depends_on_seed_and_i_only() {
        let texts = [(RateX, "0:50"), (RateY, "normal:0:5"), (RateZ, "30"), (Speed, "3:5")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let all = random_tosses(&space, 7, 0..1000);
        for (start, end) in [(0, 1), (1, 4), (511, 513), (999, 1000)] {
            assert_eq!(random_tosses(&space, 7, start..end), all[start as usize..end as usize]);
        }
        assert_ne!(random_tosses(&space, 8, 0..1)[0], all[0]);
    }
}
