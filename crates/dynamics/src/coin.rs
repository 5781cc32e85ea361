//! The coin: a rigid body of revolution, described by its principal moments of inertia I1 = I2 (about a diameter) and
//! I3 (about the normal). Nothing else about it matters in free flight, and of the moments only their ratio k = I3/I1.
//!
//! A cylinder of mass m, radius r and thickness h has the moments I1 = I2 = m/4 (r² + h²/3) and I3 = m r²/2. For a free
//! flight only the inertia ratio k = I3/I1 = 6 r²/(3 r² + h²) matters. A coin keeps what it was made from, because the
//! moments of a cylinder are rounded to f64, and so would be a k that is taken from them.

use numerics::big::exactly;
use numerics::double_double::DoubleDouble;
use numerics::scale::mantissa_and_exponent;
use numerics::{Big, Quantity, Unit};

use crate::body::is_rounding;
use crate::error::{InputError, require};

/// A coin with finite moments, I1 > 0 and 0 ≤ I3 ≤ 2 I1. No constructor makes any other coin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::body::Body", into = "crate::body::Body")
)]
pub struct Coin {
    i1: f64,
    i3: f64,
    /// k = I3/I1, stored because every flight needs it.
    ratio: DoubleDouble,
    origin: Origin,
}

/// What a coin was made from.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Origin {
    /// From I1 and I3.
    Moments,
    /// From mass (kg), radius (m) and thickness (m).
    Cylinder([Quantity; 3]),
}

/// Why a body with I1 ≠ I2 is refused where a coin is needed.
pub const NO_COIN: InputError = InputError::OutsideModel {
    field: "coin",
    why: "with I1 ≠ I2 the body is not symmetric about its normal, and this is a question about coins with I1 = I2",
};

impl Coin {
    /// The coin of the paper's figures, with the paper's own moments: I1 = 5e-7 kg m², I3 = I1/2.
    ///
    /// By the paper's formulas for a cylinder these are the moments of a rod with h = 3 r, not of a thin disc.
    pub const PAPER: Self = Self { i1: 5e-7, i3: 2.5e-7, ratio: DoubleDouble::exactly(0.5), origin: Origin::Moments };

    /// A flat disc with the transverse moment of [`Coin::PAPER`]: I3 = 2 I1.
    pub const DISC: Self = Self { i1: 5e-7, i3: 1e-6, ratio: DoubleDouble::exactly(2.0), origin: Origin::Moments };

    /// A homogeneous cylinder with a `mass` (kg) > 0, a `radius` (m) > 0 and a `thickness` (m) ≥ 0. Each of them is an f64,
    /// or a number in a unit. Fails with [`InputError::OutOfRange`] for a value outside its range, and for moments that
    /// leave the range of f64.
    pub fn from_cylinder(
        mass: impl Into<Quantity>,
        radius: impl Into<Quantity>,
        thickness: impl Into<Quantity>,
    ) -> Result<Self, InputError> {
        let given = [mass.into(), radius.into(), thickness.into()];
        let [mass, radius, thickness] = given.map(Quantity::to_f64);
        require("mass [kg]", mass, "finite and > 0", mass > 0.0)?;
        require("radius [m]", radius, "finite and > 0", radius > 0.0)?;
        require("thickness [m]", thickness, "finite and >= 0", thickness >= 0.0)?;
        let i1 = mass / 4.0 * (radius * radius + thickness * thickness / 3.0);
        let i3 = mass / 2.0 * (radius * radius);
        let rounded = Self::from_moments(i1, i3)?;
        Ok(Self { ratio: ratio_of_cylinder(given[1], given[2]), origin: Origin::Cylinder(given), ..rounded })
    }

    /// A body of revolution with the principal moments `i1` = I1 = I2 and `i3` = I3 (kg m²).
    ///
    /// I3 = 0 is a thin rod, I3 = 2 I1 a flat disc. No body has a larger I3, because I3 ≤ I1 + I2. An I3 that is larger by
    /// no more than the rounding of the two moments is taken as that of the flat disc, 2 I1.
    /// I1 has to be at least 2.3e-308, a normal f64, so that I3/I1 loses no digits.
    pub fn from_moments(i1: f64, i3: f64) -> Result<Self, InputError> {
        require("I1 [kg m²]", i1, "finite and > 0 (at least 2.3e-308)", i1 >= f64::MIN_POSITIVE)?;
        let i3 = if i3 > 2.0 * i1 && is_rounding([i1, i1, i3]) { 2.0 * i1 } else { i3 };
        require("I3 [kg m²]", i3, "0 <= I3 <= 2 I1", (0.0..=2.0 * i1).contains(&i3))?;
        let ((m1, e1), (m3, e3)) = (mantissa_and_exponent(i1), mantissa_and_exponent(i3));
        let ratio = DoubleDouble::quotient(m3, m1).times_power_of_two(e3 - e1);
        Ok(Self { i1, i3, ratio, origin: Origin::Moments })
    }

    /// Mass (kg), radius (m) and thickness (m) of the cylinder that it was made from, if it was.
    pub fn cylinder(&self) -> Option<[Quantity; 3]> {
        if let Origin::Cylinder(given) = self.origin { Some(given) } else { None }
    }

    /// I1 = I2, the moment about any axis in the coin's middle plane (kg m²).
    pub fn i1(&self) -> f64 {
        self.i1
    }

    /// I3, the moment about the coin's normal (kg m²).
    pub fn i3(&self) -> f64 {
        self.i3
    }

    /// The inertia ratio k of what the coin was made from. Its error is at most 25 u² with u = 2^-53. Multiplying both
    /// moments by a power of two does not change it.
    #[inline]
    pub fn exact_inertia_ratio(&self) -> DoubleDouble {
        self.ratio
    }

    /// The inertia ratio k = I3/I1, from 0 (rod) to 2 (flat disc).
    #[inline]
    pub fn inertia_ratio(&self) -> f64 {
        self.ratio.hi()
    }

    /// The inertia ratio k of what the coin was made from, in so many binary digits. It is 0 only for a rod of I3 = 0.
    pub fn inertia_ratio_in_digits(&self, digits: usize) -> Big {
        let round = |value: Big| value.with_precision(digits).value();
        match self.origin {
            Origin::Moments => round(exactly(self.i3)) / round(exactly(self.i1)),
            Origin::Cylinder([_, radius, thickness]) => {
                let [radius, thickness] = [radius, thickness].map(|length| length.in_digits(digits));
                let thrice = round(exactly(3.0)) * &radius * &radius;
                round(exactly(2.0)) * &thrice / (thrice + &thickness * &thickness)
            }
        }
    }
}

/// k = 6 r²/(3 r² + h²) of a cylinder to 25 u²: 7 u² of 3 r², 5 u² of h², 3 u² of their sum, 10 u² of the quotient.
fn ratio_of_cylinder(radius: Quantity, thickness: Quantity) -> DoubleDouble {
    let [(radius, e_radius), (thickness, e_thickness)] = in_one_unit(radius, thickness);
    // In units of the longer one, so that only what does not count can underflow.
    let exponent = if thickness.hi() == 0.0 { e_radius } else { e_radius.max(e_thickness) };
    let radius = radius.times_power_of_two(e_radius - exponent);
    let thickness = thickness.times_power_of_two(e_thickness - exponent);
    let thrice = radius * radius * 3.0;
    thrice * 2.0 / (thrice + thickness * thickness)
}

/// Two lengths in a unit of their own, exactly: numbers, and the exponents of the powers of two that they are multiplied by.
fn in_one_unit(radius: Quantity, thickness: Quantity) -> [(DoubleDouble, i32); 2] {
    let lengths = [radius, thickness].map(|length| mantissa_and_exponent(length.value()));
    if radius.unit() == thickness.unit() {
        return lengths.map(|(mantissa, exponent)| (mantissa.into(), exponent));
    }
    let factor = |unit: Unit, other: Unit| f64::from(unit.numerator()) * f64::from(other.denominator());
    let factors = [factor(radius.unit(), thickness.unit()), factor(thickness.unit(), radius.unit())];
    let scaled = |index: usize| (DoubleDouble::product(lengths[index].0, factors[index]), lengths[index].1);
    [scaled(0), scaled(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cylinder_with_h_3r_has_the_papers_inertia_ratio() {
        let rod = Coin::from_cylinder(0.002, 0.01, 0.03).unwrap();
        approx::assert_relative_eq!(rod.inertia_ratio(), 0.5, epsilon = 0.0, max_relative = 1e-15);
        approx::assert_relative_eq!(rod.i1(), 0.002 / 4.0 * (1e-4 + 9e-4 / 3.0), epsilon = 0.0, max_relative = 1e-15);
        approx::assert_relative_eq!(rod.i3(), 1e-7, epsilon = 0.0, max_relative = 1e-15);
    }

    #[test]
    fn the_inertia_ratio_is_that_of_the_cylinder_as_given() {
        let (mm, inch) = (Unit::ratio(1, 1000).unwrap(), Unit::ratio(127, 5000).unwrap());
        for (radius, thickness) in [
            (0.01874.into(), 0.00114.into()),
            (1e-150.into(), 3e-140.into()),
            (3e150.into(), 0.0.into()),
            (0.1.into(), 7.7.into()),
            (mm.times(12.13), mm.times(1.75)),
            (inch.times(0.955), mm.times(1.75)),
            (inch.times(0.955), 0.00175.into()),
        ] {
            let coin =
                Coin::from_cylinder(if radius.to_f64() < 1.0 { 1e30 } else { 1e-30 }, radius, thickness).unwrap();
            let [r, h] = [radius, thickness].map(|length: Quantity| length.in_digits(400));
            let big = |value: f64| exactly(value).with_precision(400).value();
            let exact = big(6.0) * &r * &r / (big(3.0) * &r * &r + &h * &h);
            let error = |found: Big| ((found - &exact) / &exact).to_f64().value().abs();
            let found = coin.exact_inertia_ratio();
            assert!(error(exactly(found.hi()) + exactly(found.lo())) <= 25.0 * 2f64.powi(-106), "{coin:?}");
            assert!(error(coin.inertia_ratio_in_digits(200)) < 2f64.powi(-195), "{coin:?}");
            assert_eq!(coin.cylinder().map(|[_, r, h]| [r, h]), Some([radius, thickness]));
        }
        assert_eq!(Coin::PAPER.cylinder(), None);
        let third = Coin::from_moments(3.0, 1.0).unwrap().inertia_ratio_in_digits(100);
        assert!((third.to_f64().value() - 1.0 / 3.0).abs() < 1e-16);
    }

    #[test]
    fn an_impossible_cylinder_is_refused_with_the_field_at_fault() {
        for ([mass, radius, thickness], field) in [
            ([0.0, 0.01, 0.001], "mass [kg]"),
            ([0.01, 0.0, 0.001], "radius [m]"),
            ([0.01, 0.01, -1e-9], "thickness [m]"),
            ([f64::NAN, 0.01, 0.001], "mass [kg]"),
            ([1e-300, 1e-10, 0.0], "I1 [kg m²]"),
            ([1e300, 1e300, 1.0], "I1 [kg m²]"),
        ] {
            assert_eq!(Coin::from_cylinder(mass, radius, thickness).unwrap_err().field(), field);
        }
    }

    #[test]
    fn moments_are_taken_up_to_the_ends_of_their_ranges() {
        for (i1, i3) in [(1.0, 2.0), (1.0, 0.0), (1.0, 1.0), (f64::MIN_POSITIVE, 0.0), (1e300, 2e300)] {
            assert!(Coin::from_moments(i1, i3).is_ok(), "{i1}, {i3}");
        }
        for (i1, i3) in [(1.0, 2.000_000_000_000_000_4), (0.1, 0.200_000_000_000_000_04), (1e-9, 2e-9_f64.next_up())] {
            let disc = Coin::from_moments(i1, i3).unwrap();
            assert_eq!((disc.i3(), disc.inertia_ratio(), Ok(disc)), (2.0 * i1, 2.0, Coin::from_moments(i1, 2.0 * i1)));
            assert_eq!(disc.inertia_ratio_in_digits(200), exactly(2.0));
        }
        for (i1, i3) in [(1.0, f64::NAN), (f64::NAN, 1.0), (1.0, f64::INFINITY), (f64::INFINITY, f64::INFINITY)] {
            assert!(Coin::from_moments(i1, i3).is_err(), "{i1}, {i3}");
        }
        for (i1, i3, message) in [
            (0.0, 0.0, "I1 [kg m²] = 0.0 is outside"),
            (-1.0, 1.0, "I1 [kg m²] = -1.0 is outside"),
            (1.0, -1e-300, "I3 [kg m²] = -1e-300 is outside its valid range: 0 <= I3 <= 2 I1"),
            (1.0, 2.000_000_000_000_001, "I3 [kg m²] = 2.000000000000001 is outside"),
        ] {
            let refused = Coin::from_moments(i1, i3).unwrap_err().to_string();
            assert!(refused.starts_with(message), "{refused}");
        }
    }
}
