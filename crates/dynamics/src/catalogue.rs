//! The coins that can be chosen by name: the paper's coin, a flat disc, and real coins with their published figures.
//! The real ones show how much of the paper's result holds for a coin in your pocket.
//!
//! The real coins are taken as homogeneous cylinders. A relief, a rim or a second metal changes k = I3/I1 by less than
//! the difference between two denominations, but no published figure says by how much. Coins with notches (20 euro
//! cent) or straight sides are left out. [`BODIES`] has bodies that are not symmetric about their normal, among them a
//! coin with a model of its relief.

mod bodies;

use std::str::FromStr;

use crate::coin::Coin;
use crate::error::{InputError, find_named};

pub use bodies::{BODIES, Entry, Relief, Shape, entries, named_body};

const US_MINT: &str = "United States Mint, Coin Specifications, \
                       https://www.usmint.gov/learn/coins-and-medals/circulating-coins/coin-specifications";
const EU_COUNCIL: &str = "Council Regulation (EU) No 729/2014, Annex I, Official Journal L 194, 2.7.2014, p. 1";
const PAPER: &str = "\"Modeling the unfair toss of an unbiased coin\": I1 = 5e-7, I3 = I1/2";
const FLAT: &str = "the limit h = 0 of a cylinder, I3 = 2 I1, with the paper's I1";

const fn preset(name: &'static str, description: &'static str, moments: [f64; 3], source: &'static str) -> Entry {
    Entry { name, description, shape: Shape::Moments(moments), source }
}

/// An entry for a real coin; `figures` are its mass (g), diameter (mm) and thickness (mm).
const fn real(
    name: &'static str,
    description: &'static str,
    (mass_g, diameter_mm, thickness_mm): (f64, f64, f64),
    source: &'static str,
) -> Entry {
    Entry { name, description, shape: Shape::Cylinder { mass_g, diameter_mm, thickness_mm }, source }
}

/// All coins that can be chosen by name.
pub const CATALOGUE: &[Entry] = &[
    preset("paper", "the paper's moments (a rod with h = 3 r)", [5e-7, 5e-7, 2.5e-7], PAPER),
    preset("disc", "a flat disc with the paper's I1", [5e-7, 5e-7, 1e-6], FLAT),
    real("us-cent", "1 US cent", (2.500, 19.05, 1.52), US_MINT),
    real("us-nickel", "5 US cents", (5.000, 21.21, 1.95), US_MINT),
    real("us-dime", "10 US cents", (2.268, 17.91, 1.35), US_MINT),
    real("us-quarter", "25 US cents", (5.670, 24.26, 1.75), US_MINT),
    real("us-half", "50 US cents", (11.340, 30.61, 2.15), US_MINT),
    real("us-dollar", "1 US dollar", (8.100, 26.49, 2.00), US_MINT),
    real("euro-1c", "1 euro cent", (2.30, 16.25, 1.67), EU_COUNCIL),
    real("euro-2c", "2 euro cent", (3.06, 18.75, 1.67), EU_COUNCIL),
    real("euro-5c", "5 euro cent", (3.92, 21.25, 1.67), EU_COUNCIL),
    real("euro-10c", "10 euro cent", (4.10, 19.75, 1.93), EU_COUNCIL),
    real("euro-50c", "50 euro cent", (7.80, 24.25, 2.38), EU_COUNCIL),
    real("euro-1", "1 euro", (7.50, 23.25, 2.33), EU_COUNCIL),
    real("euro-2", "2 euro", (8.50, 25.75, 2.20), EU_COUNCIL),
];

/// The coin called `name`. Fails with [`InputError::UnknownName`] with the list of known names;
/// [`InputError::OutsideModel`] for one of [`BODIES`].
pub fn named_coin(name: &str) -> Result<Coin, InputError> {
    if BODIES.iter().any(|entry| entry.name == name) {
        return Err(crate::coin::NO_COIN);
    }
    find_named("coin", name, CATALOGUE, |entry| entry.name)?.coin()
}

/// Finds a coin of the catalogue by its name.
impl FromStr for Coin {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        named_coin(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_a_coin_and_its_name_is_unique() {
        for (index, entry) in CATALOGUE.iter().enumerate() {
            assert_eq!(entry.coin(), entry.name.parse(), "{}", entry.name);
            assert!(CATALOGUE[..index].iter().all(|other| other.name != entry.name), "{}", entry.name);
        }
        assert_eq!(["paper", "disc"].map(str::parse), [Ok(Coin::PAPER), Ok(Coin::DISC)]);
        let unknown = named_coin("doubloon").unwrap_err().to_string();
        assert!(unknown.contains("known: paper, disc, us-cent, ") && unknown.ends_with(", euro-2"), "{unknown}");
    }

    #[test]
    fn has_at_least_twelve_real_coins_with_inertia_ratios_of_thin_discs() {
        let real = CATALOGUE.iter().filter(|entry| matches!(entry.shape, Shape::Cylinder { .. }));
        let ratios: Vec<f64> = real.map(|entry| entry.coin().unwrap().inertia_ratio()).collect();
        assert!(ratios.len() >= 12);
        assert!(ratios.iter().all(|ratio| (1.95..2.0).contains(ratio)), "{ratios:?}");
    }

    #[test]
    fn grams_and_millimetres_are_converted_to_si_units() {
        // 5.670 g, 24.26 mm: m r²/2 = 0.00567 · 0.01213² / 2 kg m²
        let quarter: Coin = "us-quarter".parse().unwrap();
        approx::assert_relative_eq!(quarter.i3(), 4.171_331_115e-7, epsilon = 0.0, max_relative = 1e-9);
    }
}
