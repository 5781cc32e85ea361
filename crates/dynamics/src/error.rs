//! The two kinds of errors: [`InputError`] for input that describes no toss, and [`SolveError`] for a flight that a
//! solver cannot finish. They are separate so that constructors and solvers can each return exactly what may happen;
//! [`Error`](crate::Error) holds either of them.

mod solve;

use thiserror::Error;

pub use solve::{Fault, Reason, Singularity, SolveError};

use crate::look_alike::look_alike;

/// An input value that describes no toss. It is found before anything is computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InputError {
    /// A number outside its valid range (or not a number at all).
    #[error("{field} = {value:?} is outside its valid range: {valid}")]
    OutOfRange {
        /// The field, with its unit.
        field: &'static str,
        /// What was given.
        value: f64,
        /// The valid range, in words or as an inequality.
        valid: &'static str,
    },
    /// Text that can't be read as a value of the field, or a combination of settings that contradict each other.
    #[error("{field} = '{value}' can't be used: expected {expected}")]
    Malformed {
        /// The field, with its unit.
        field: &'static str,
        /// What was given.
        value: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Text with a character that looks like one of a number or a unit, and is another.
    #[error(
        "{field} = '{value}' can't be used: '{found}' (U+{code:04X}) only looks like '{meant}'; expected {expected}",
        code = u32::from(*.found)
    )]
    LookAlike {
        /// The field, with its unit.
        field: &'static str,
        /// What was given.
        value: String,
        /// The character that was found.
        found: char,
        /// The character that it looks like.
        meant: char,
        /// What was expected.
        expected: &'static str,
    },
    /// A required value that was not given and has no default.
    #[error("{field} is missing: expected {expected}")]
    Missing {
        /// The field, with its unit.
        field: &'static str,
        /// What was expected.
        expected: &'static str,
    },
    /// A physical effect that the model leaves out. It is refused, because ignoring it would give a wrong answer.
    #[error("{field} is outside the model: {why}")]
    OutsideModel {
        /// The field.
        field: &'static str,
        /// The reason, in a sentence.
        why: &'static str,
    },
    /// A moment of inertia that is larger than the sum of the other two.
    #[error("{field} = {value:?} is larger than {limit} by {excess:?}: no body has such moments")]
    NoBody {
        /// The largest moment, with its unit.
        field: &'static str,
        /// What was given.
        value: f64,
        /// The sum that limits it.
        limit: &'static str,
        /// How far it is above that sum (kg m²).
        excess: f64,
    },
    /// A name that is not in the list of known names.
    #[error("{field} = '{value}' is unknown; known: {known}")]
    UnknownName {
        /// The field.
        field: &'static str,
        /// What was given.
        value: String,
        /// The known names, separated by commas.
        known: String,
    },
    /// A setting that would have no effect with the solver.
    #[error("{field} = '{value}' has no effect with {with}")]
    NoEffect {
        /// The setting.
        field: &'static str,
        /// What was given.
        value: String,
        /// The solver, and those with which it has an effect.
        with: String,
    },
}

impl InputError {
    /// The error of a text that can't be read as a value of the field.
    pub fn unreadable(field: &'static str, text: &str, expected: &'static str) -> Self {
        let value = text.to_owned();
        match look_alike(text) {
            Some((found, meant)) => Self::LookAlike { field, value, found, meant, expected },
            None => Self::Malformed { field, value, expected },
        }
    }

    /// The field that is at fault.
    pub fn field(&self) -> &'static str {
        match self {
            Self::OutOfRange { field, .. }
            | Self::Malformed { field, .. }
            | Self::LookAlike { field, .. }
            | Self::Missing { field, .. }
            | Self::OutsideModel { field, .. }
            | Self::NoBody { field, .. }
            | Self::UnknownName { field, .. }
            | Self::NoEffect { field, .. } => field,
        }
    }
}

/// Returns `value` if it is finite and `holds` is true, else the error that names the field and its `valid` range.
#[inline]
pub fn require(field: &'static str, value: f64, valid: &'static str, holds: bool) -> Result<f64, InputError> {
    if value.is_finite() && holds { Ok(value) } else { Err(InputError::OutOfRange { field, value, valid }) }
}

/// Returns the item of `items` called `value`, or the error that lists the known names.
pub fn find_named<'a, T>(
    field: &'static str,
    value: &str,
    items: &'a [T],
    name: impl Fn(&T) -> &str,
) -> Result<&'a T, InputError> {
    items.iter().find(|item| name(item) == value).ok_or_else(|| InputError::UnknownName {
        field,
        value: value.to_owned(),
        known: items.iter().map(name).collect::<Vec<_>>().join(", "),
    })
}

#[cfg(test)]
mod tests;
