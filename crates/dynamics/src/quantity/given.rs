//! Quantities as texts with their unit, which tells what kind of quantity it is.

use std::fmt;
use std::str::FromStr;

use super::{Dimension, Given};
use crate::error::InputError;

/// Writes the number and its unit, as in `24.26mm`.
impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}{}", self.value, self.unit.name)
    }
}

/// Reads a number with a unit of any kind. A number without a unit is refused, because its kind is not known.
impl FromStr for Given {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
        let expected = "a number with a unit, such as 15deg, 38rev/s, 2.4m/s or 24mm";
        let read = Dimension::ALL.into_iter().find_map(|dimension| match dimension.parsed(text) {
            Some((given, true)) => Some(given),
            _ => None,
        });
        read.ok_or_else(|| InputError::unreadable("quantity", text, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantity_in_any_unit_is_written_and_read_back() {
        for unit in Dimension::ALL.into_iter().flat_map(Dimension::units) {
            for value in [24.26, -1.0 / 3.0, 1e-300, 6e22, 0.0] {
                let given = unit.times(value);
                assert_eq!(given.to_string().parse::<Given>().map(Given::si), Ok(given.si()), "{given}");
            }
        }
        assert_eq!("24.26 mm".parse::<Given>().unwrap().to_string(), "24.26mm");
        for text in ["3", "mm", "", "3 stone", "three mm"] {
            assert_eq!(text.parse::<Given>().unwrap_err().field(), "quantity", "{text}");
        }
    }
}
