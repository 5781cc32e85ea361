//! This file reads physical quantities that are typed with a unit, such as `15deg` or `24mm`, and converts them to SI
//! units. It holds the one table of units, so that the command line and files of spaces accept the same ones.
//!
//! A number without a unit is in the SI unit, which for angles is the radian. Every unit is a rational multiple of the
//! SI unit, or a rational part of a turn. A unit without a name is written as that number: `3.0@1/7` is 3/7 of the SI unit,
//! and `3.0@1/7turn` 3/7 of a turn.

use std::f64::consts::TAU;
use std::fmt;

use numerics::double_double::{DoubleDouble, two_sum};
use numerics::scale::mantissa_and_exponent;
use numerics::{Quantity, Unit};

use crate::error::InputError;

pub use typed::{read_count, read_fraction};

pub use crate::look_alike::look_alike;

/// The kind of a physical quantity, which decides the units that it may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// An angle, in rad.
    Angle,
    /// A rate of turning, in rad/s.
    TurnRate,
    /// A speed, in m/s.
    Speed,
    /// A time, in s.
    Time,
    /// An acceleration, in m/s².
    Acceleration,
    /// A length, in m.
    Length,
    /// A mass, in kg.
    Mass,
    /// A moment of inertia, in kg m².
    Inertia,
    /// A number without a unit.
    Number,
}

/// A unit and its name, which is empty if it has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NamedUnit {
    name: &'static str,
    /// Its size in the SI unit.
    size: Unit,
}

/// A number and the unit that it was given in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Given {
    value: f64,
    unit: NamedUnit,
}

const fn unit(name: &'static str, numerator: u16, denominator: u32) -> NamedUnit {
    NamedUnit { name, size: ratio(numerator, denominator) }
}

const fn part_of_turn(name: &'static str, denominator: u32) -> NamedUnit {
    NamedUnit { name, size: ratio(1, denominator).of_turn() }
}

const fn ratio(numerator: u16, denominator: u32) -> Unit {
    match Unit::ratio(numerator, denominator) {
        Some(unit) => unit,
        None => panic!("a unit of the table has a 0 in it"),
    }
}

/// What is expected of a quantity, in words, and its units, the first of which is the SI unit.
type Row = (&'static str, &'static [NamedUnit]);

/// The rows of [`Dimension::ALL`], in their order.
const ROWS: [Row; 9] = [
    (
        "an angle in rad, deg, ° or rev (rad without a unit)",
        &[unit("rad", 1, 1), part_of_turn("deg", 360), part_of_turn("°", 360), part_of_turn("rev", 1)],
    ),
    (
        "a rate in rad/s, deg/s, °/s, rev/s or rpm (rad/s without a unit)",
        &[
            unit("rad/s", 1, 1),
            part_of_turn("deg/s", 360),
            part_of_turn("°/s", 360),
            part_of_turn("rev/s", 1),
            part_of_turn("rpm", 60),
        ],
    ),
    (
        "a speed in m/s, cm/s, km/h, ft/s or mph (m/s without a unit)",
        &[
            unit("m/s", 1, 1),
            unit("cm/s", 1, 100),
            unit("km/h", 5, 18),
            unit("ft/s", 381, 1250),
            unit("mph", 1397, 3125),
        ],
    ),
    ("a time in s, ms or µs (s without a unit)", &[unit("s", 1, 1), unit("ms", 1, 1000), unit("µs", 1, 1_000_000)]),
    (
        "an acceleration in m/s², cm/s² or ft/s² (m/s² without a unit)",
        &[unit("m/s²", 1, 1), unit("cm/s²", 1, 100), unit("ft/s²", 381, 1250)],
    ),
    (
        "a length in m, cm, mm, in or ft (m without a unit)",
        &[unit("m", 1, 1), unit("cm", 1, 100), unit("mm", 1, 1000), unit("in", 127, 5000), unit("ft", 381, 1250)],
    ),
    ("a mass in kg, g or mg (kg without a unit)", &[unit("kg", 1, 1), unit("g", 1, 1000), unit("mg", 1, 1_000_000)]),
    (
        "a moment of inertia in kg·m², g·cm² or g·mm² (kg·m² without a unit)",
        &[unit("kg·m²", 1, 1), unit("g·cm²", 1, 10_000_000), unit("g·mm²", 1, 1_000_000_000)],
    ),
    ("a number", &[unit("", 1, 1)]),
];

/// The size of a unit without a name, such as `@1/7` or `@1/7turn`.
fn size(text: &str) -> Option<Unit> {
    let text = text.strip_prefix('@')?;
    let of_turn = text.strip_suffix("turn");
    let (numerator, denominator) = of_turn.unwrap_or(text).split_once('/')?;
    let ratio = Unit::ratio(numerator.parse().ok()?, denominator.parse().ok()?)?;
    Some(if of_turn.is_some() { ratio.of_turn() } else { ratio })
}

impl NamedUnit {
    /// So many of this unit.
    pub fn times(self, value: f64) -> Given {
        Given { value, unit: self }
    }

    /// The name, such as `rev/s`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// `value` of this unit in the SI unit, rounded once: the f64 nearest to the exact product.
    ///
    /// The product is computed in twice the precision of f64, where its error is below 40 u² with u = 2^-53.
    pub fn to_si(&self, value: f64) -> f64 {
        if !value.is_finite() {
            return value;
        }
        let (mantissa, exponent) = mantissa_and_exponent(value);
        let product = DoubleDouble::product(mantissa, f64::from(self.size.numerator()));
        // The difference between 2π and its nearest f64.
        const REST_OF_TURN: f64 = 2.449_293_598_294_706_4e-16;
        let product = if self.size.is_of_turn() { product * two_sum(TAU, REST_OF_TURN) } else { product };
        let si = product / DoubleDouble::from(f64::from(self.size.denominator()));
        si.times_power_of_two(exponent).hi()
    }

    /// Its size in the SI unit.
    pub fn size(&self) -> Unit {
        self.size
    }

    /// Whether `text` names this unit. Blanks, `·`, `*` and `^` between the parts of a unit make no difference, and
    /// neither does `2` in place of `²`, or `u` in place of `µ`.
    fn is_called(&self, text: &str) -> bool {
        fn plain(text: &str) -> impl Iterator<Item = char> {
            let parts = text.chars().filter(|part| !part.is_whitespace() && !['·', '*', '^'].contains(part));
            parts.map(|part| match part {
                '²' => '2',
                'µ' | 'μ' => 'u',
                same => same,
            })
        }
        plain(self.name).eq(plain(text))
    }
}

impl Given {
    /// The number in the SI unit, rounded once.
    pub fn si(self) -> f64 {
        self.unit.to_si(self.value)
    }

    /// Whether [`Given::si`] is the number that was given, without a rounding.
    pub fn is_exact_in_si(self) -> bool {
        let (given, si, size) = (self.value, self.si(), self.unit.size);
        if given == 0.0 || size == Unit::ONE {
            return true;
        }
        let product = |number: f64, factor: f64| DoubleDouble::product(number, factor);
        !size.is_of_turn() && product(given, f64::from(size.numerator())) == product(si, f64::from(size.denominator()))
    }

    /// The number in the SI unit. Nothing is rounded.
    pub fn quantity(self) -> Quantity {
        self.unit.size.times(self.value)
    }

    /// The number in its unit.
    pub fn value(self) -> f64 {
        self.value
    }

    /// The unit.
    pub fn unit(self) -> NamedUnit {
        self.unit
    }
}

/// Writes the number and its unit, as in `24.26mm`; it is read back as the same number in the same unit.
impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}{}", self.value, self.unit.name)?;
        let NamedUnit { name, size } = self.unit;
        if !name.is_empty() || size == Unit::ONE {
            return Ok(());
        }
        write!(f, "@{}/{}{}", size.numerator(), size.denominator(), if size.is_of_turn() { "turn" } else { "" })
    }
}

impl Dimension {
    /// The units that a quantity of this kind may have. The first one is the SI unit.
    pub fn units(self) -> &'static [NamedUnit] {
        ROWS[self as usize].1
    }

    /// What is expected, in words that name every unit.
    pub fn expected(self) -> &'static str {
        ROWS[self as usize].0
    }

    /// All kinds of quantities.
    pub const ALL: [Self; 9] = [
        Self::Angle,
        Self::TurnRate,
        Self::Speed,
        Self::Time,
        Self::Acceleration,
        Self::Length,
        Self::Mass,
        Self::Inertia,
        Self::Number,
    ];

    /// `value` in the SI unit.
    pub fn in_si(self, value: f64) -> Given {
        self.units()[0].times(value)
    }

    /// `value` in a unit of this size, by its name if it has one.
    pub fn in_unit(self, value: f64, size: Unit) -> Given {
        let named = self.units().iter().find(|unit| unit.size == size);
        Given { value, unit: named.copied().unwrap_or(NamedUnit { name: "", size }) }
    }

    /// Reads a quantity into its SI unit.
    pub fn read(self, field: &'static str, text: &str) -> Result<f64, InputError> {
        self.given(field, text).map(Given::si)
    }

    /// Reads a quantity in the unit that it is given in, which without one is the SI unit.
    pub fn given(self, field: &'static str, text: &str) -> Result<Given, InputError> {
        let unreadable = || InputError::unreadable(field, text, self.expected());
        self.parsed(text).map(|(given, _)| given).ok_or_else(unreadable)
    }

    /// The quantity, and whether it has a unit of its own; `None` if there is no number, or another unit.
    fn parsed(self, text: &str) -> Option<(Given, bool)> {
        let text = text.trim();
        if let Ok(value) = text.parse() {
            return Some((Given { value, unit: self.units()[0] }, false));
        }
        // The longest start of the text that is a number: `1e3` of `1e3m/s`.
        let (value, name) =
            text.char_indices().rev().find_map(|(end, _)| Some((text[..end].parse().ok()?, &text[end..])))?;
        let named = self.units().iter().find(|unit| unit.is_called(name)).map(|unit| unit.times(value));
        let has_turns = self.units().iter().any(|unit| unit.size.is_of_turn());
        let sized = || size(name).filter(|size| has_turns || !size.is_of_turn());
        let given = named.or_else(|| sized().map(|size| self.in_unit(value, size)))?;
        Some((given, true))
    }
}

/// The unit of all of these, or of the first if all are 0; any other 0 may have any unit. `None` if the units differ.
pub fn common_unit(given: &[Given]) -> Option<NamedUnit> {
    let mut units = given.iter().filter(|given| given.value != 0.0).map(|given| given.unit);
    let Some(first) = units.next() else { return given.first().map(|given| given.unit) };
    units.all(|unit| unit == first).then_some(first)
}

/// Reads several quantities that belong together. Either all of them have a unit or none has, since a unit after the last
/// number alone could be meant for all. A 0 needs no unit. Fails with [`InputError::Malformed`] that names `field`,
/// with `expected` for a text that is not a quantity of its kind.
pub fn read_quantities(
    field: &'static str,
    whole: &str,
    expected: &'static str,
    parts: &[(Dimension, &str)],
) -> Result<Vec<Given>, InputError> {
    let malformed = |expected| InputError::unreadable(field, whole, expected);
    let parsed = parts.iter().map(|(dimension, text)| dimension.parsed(text).ok_or_else(|| malformed(expected)));
    let parsed = parsed.collect::<Result<Vec<(Given, bool)>, _>>()?;
    let lacks_unit = |(given, has_unit): &(Given, bool)| !has_unit && given.value != 0.0;
    if parsed.iter().any(|(_, has_unit)| *has_unit) && parsed.iter().any(lacks_unit) {
        return Err(malformed("a unit after each of the numbers, or after none"));
    }
    Ok(parsed.into_iter().map(|(given, _)| given).collect())
}

#[cfg(test)]
mod tests;
mod typed;
