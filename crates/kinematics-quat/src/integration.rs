//! [`Integration`], the kinds of flights that prove an outcome.

use std::fmt;

/// The arithmetic of the flight that proved an outcome, from the cheapest to the most accurate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integration {
    /// f64, by Taylor series with a tolerance of 1e-3, which outcomes of coins alone take first.
    Coarse,
    /// f64, with the solver's own steps.
    AsConfigured,
    /// f64, by Taylor series with the finest tolerance.
    Finest,
    /// Double-double arithmetic.
    DoubleDouble,
    /// 192 binary digits or more.
    MoreDigits,
}

impl Integration {
    /// All of them, from the cheapest to the most accurate.
    pub const ALL: [Self; 5] = [Self::Coarse, Self::AsConfigured, Self::Finest, Self::DoubleDouble, Self::MoreDigits];

    /// Its name, in words.
    pub fn name(self) -> &'static str {
        ["coarse", "f64", "finest tolerance", "double-double", "more digits"][self as usize]
    }
}

/// Writes the [name](Integration::name).
impl fmt::Display for Integration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
