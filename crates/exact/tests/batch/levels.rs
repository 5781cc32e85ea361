//! Neither the SIMD level nor the other tosses of a batch change a bit of a result.

use dynamics::{Attitude, Coin, Outcome, Tosses};
use exact::Batch;
use numerics::lanes::SimdLevel;

use super::columns::{attitudes, coins, mixed};
use super::solved;

fn bits(tosses: Tosses<'_>, level: SimdLevel) -> (Vec<u64>, Vec<Outcome>) {
    let (cos_tilts, attitudes, outcomes) = solved(Batch::new(tosses).on(level), &tosses).expect("valid tosses");
    (cos_tilts.iter().chain(attitudes.iter().flatten()).map(|number| number.to_bits()).collect(), outcomes)
}

/// The neighbours are changed by solving parts of the batch, of several lengths and from several starts.
#[test]
fn neither_the_simd_level_nor_the_neighbours_change_a_bit() {
    let has_vectors = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));
    assert!(SimdLevel::all().len() > 1 || !has_vectors, "only the plain level was tried");
    let columns = mixed(700);
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        let tosses = columns.tosses(coin, attitude);
        let plain = bits(tosses, SimdLevel::all()[0]);
        for level in SimdLevel::all() {
            assert_eq!(bits(tosses, level), plain, "{}", level.name());
            for range in [0..1, 1..8, 17..34, 3..259, 444..700] {
                let rates = columns.rates.each_ref().map(|column| &column[range.clone()]);
                let some = Tosses::new(coin, attitude, 9.81, rates, &columns.speeds[range.clone()]).unwrap();
                let (cos_tilts, outcomes) = (&plain.0[range.clone()], &plain.1[range.clone()]);
                let found = bits(some, level);
                assert_eq!(
                    (&found.0[..range.len()], &found.1[..]),
                    (cos_tilts, outcomes),
                    "{range:?} {}",
                    level.name()
                );
            }
        }
    }
}

/// The fractional part of a multiple of the root of `square`.
fn part(index: usize, square: f64) -> f64 {
    (index as f64 * square.sqrt()).fract()
}

/// Ordinary numbers, zeros, and numbers so small that their products have digits below the range of f64.
fn with_tiny_ones(length: usize, square: f64, ordinary: f64) -> Vec<f64> {
    let number = |index: usize| match part(index, square + 4.0) {
        kind if kind < 0.15 => 0.0,
        kind if kind < 0.4 => ordinary * (part(index, square) + 0.01),
        _ => 5e-324 * (150.0 * part(index, square)).exp2(),
    };
    (1..=length).map(number).collect()
}

fn landings(tosses: Tosses<'_>, level: SimdLevel) -> Vec<u64> {
    let (mut cos_tilts, mut attitudes) = (vec![f64::NAN; tosses.len()], [(); 4].map(|()| vec![f64::NAN; tosses.len()]));
    let batch = Batch::new(tosses).on(level);
    batch.cos_tilts(&mut cos_tilts).expect("valid tosses");
    batch.attitudes(attitudes.each_mut().map(Vec::as_mut_slice)).expect("valid tosses");
    cos_tilts.iter().chain(attitudes.iter().flatten()).map(|number| number.to_bits()).collect()
}

#[test]
fn products_below_the_range_of_f64_have_the_same_bits_at_every_simd_level() {
    const LENGTH: usize = 30_000;
    let [x, y, z] = [2.0, 3.0, 5.0].map(|square| with_tiny_ones(LENGTH, square, 30.0));
    let upright = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).expect("valid");
    for (coin, attitude) in
        coins().into_iter().flat_map(|coin| [Attitude::IDENTITY, upright].map(|attitude| (coin, attitude)))
    {
        for gravity in [9.81, 2e-50, 9e49] {
            let speeds = with_tiny_ones(LENGTH, 7.0, gravity);
            let tosses = Tosses::new(coin, attitude, gravity, [&x, &y, &z], &speeds).expect("valid");
            let plain = landings(tosses, SimdLevel::all()[0]);
            for level in SimdLevel::all() {
                let found = landings(tosses, level);
                let differs = (0..found.len()).find(|index| found[*index] != plain[*index]);
                let toss =
                    differs.map(|index| tosses.columns(index % LENGTH..index % LENGTH + 1).map(|column| column[0]));
                assert_eq!(differs, None, "{toss:?} of {coin:?}, gravity {gravity:e}, on {}", level.name());
            }
        }
    }
}

/// The rate about the axis of a coin that is nearly a rod may be larger than a part of it that a product needs.
#[test]
fn rods_that_spin_extremely_fast_have_finite_landings() {
    let rod = Coin::from_moments(1.0, 1e-260).expect("valid");
    let (rates, speeds) = ([[3.0], [4.0], [1e305]], [1e-300]);
    let tosses =
        Tosses::new(rod, Attitude::about_x(0.7), 9.81, rates.each_ref().map(|rate| &rate[..]), &speeds).expect("valid");
    let plain = landings(tosses, SimdLevel::all()[0]);
    assert!(plain.iter().all(|number| f64::from_bits(*number).is_finite()), "{plain:?}");
    for level in SimdLevel::all() {
        assert_eq!(landings(tosses, level), plain, "{}", level.name());
    }
}
