//! Numbers of files: in the SI unit, or as a text with a unit.

use std::fmt;

use numerics::Unit;
use serde::{Deserialize, Serialize};

use crate::quantity::Given;

/// A number as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number in SI units, or a text with a unit like \"24mm\"")]
pub(super) enum Number {
    Si(f64),
    Text(String),
}

impl From<&Given> for Number {
    fn from(given: &Given) -> Self {
        let is_si = given.unit().size() == Unit::ONE;
        if is_si { Self::Si(given.value()) } else { Self::Text(given.to_string()) }
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
