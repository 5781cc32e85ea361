//! Numbers of files: in the SI unit, or as a text with a unit. Coins, launches and settings share them.

use std::fmt;

use numerics::{AngleUnit, Quantity};
use serde::{Deserialize, Serialize};

use crate::error::InputError;
use crate::quantity::{Dimension, Given};

/// A number as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number in SI units, or a text with a unit like \"24mm\"")]
pub(super) enum Number {
    Si(f64),
    Text(String),
}

impl Number {
    /// The number in the unit that it is given in.
    pub(super) fn given(&self, field: &'static str, dimension: Dimension) -> Result<Given, InputError> {
        match self {
            Self::Si(value) => Ok(dimension.in_si(*value)),
            Self::Text(text) => dimension.given(field, text),
        }
    }

    /// The number in the SI unit, rounded once.
    pub(super) fn si(&self, field: &'static str, dimension: Dimension) -> Result<f64, InputError> {
        self.given(field, dimension).map(Given::si)
    }

    /// A number of an angle or of an angle per second, `value` times `unit`; `None` if the unit has no name.
    pub(super) fn in_angle_unit(value: f64, unit: AngleUnit, dimension: Dimension) -> Option<Self> {
        if unit == AngleUnit::RADIAN {
            return Some(Self::Si(value));
        }
        dimension.units().iter().find(|named| named.angle_unit() == unit).map(|named| named.times(value).into())
    }

    /// A quantity, converted to the SI unit if its unit has no name.
    pub(super) fn of_quantity(quantity: Quantity, dimension: Dimension) -> Self {
        let is_its_unit = |given: &Given| given.is_exact_quantity() && given.quantity() == quantity;
        let mut units = dimension.units()[1..].iter().map(|named| named.times(quantity.value()));
        units.find(is_its_unit).map_or_else(|| Self::Si(quantity.to_f64()), Self::from)
    }
}

impl From<Given> for Number {
    fn from(given: Given) -> Self {
        Self::Text(given.to_string())
    }
}

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Si(value) => value.fmt(f),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// `items` if there are N of them. An array of N would be read from a longer list, the rest of which is ignored.
pub(super) fn exactly<T: fmt::Debug, const N: usize>(
    field: &'static str,
    items: Vec<T>,
    expected: &'static str,
) -> Result<[T; N], InputError> {
    let malformed = |items| InputError::Malformed { field, value: format!("{items:?}"), expected };
    items.try_into().map_err(malformed)
}

/// The error of a quantity that is given by two fields.
pub(super) fn twice(field: &'static str, expected: &'static str) -> InputError {
    InputError::Malformed { field, value: "given twice".to_owned(), expected }
}
