//! A check that gave no row, and why. A run that passes should say what it does not speak of.

use serde::Serialize;

use crate::measure::check::Check;

/// A check that gave no row.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The id of the check.
    pub check: &'static str,
    /// The reason, in words.
    pub why: &'static str,
}

impl LeftOut {
    /// The check has no subject among the solvers of the registry.
    pub fn without_a_subject(check: &Check) -> Self {
        Self { check: check.id, why: "as the registry has no solver, or no pair of solvers, that they measure" }
    }

    /// The check judges the library, and the suite is about solvers.
    pub fn about_the_library(check: &Check) -> Self {
        Self { check: check.id, why: "as they judge the library and not a solver" }
    }
}
