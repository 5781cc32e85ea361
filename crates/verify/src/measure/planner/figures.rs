//! This file holds what the parts of the planner's table have in common: the seed, the safety factor, the name of a
//! model, and the number of digits. They are here so that the files that measure the parts do not depend on each other.

/// Seed of the tosses and spaces to which the table is fitted. The scenes that test it have another seed.
pub(super) const SEED: u64 = 11;

/// Safety factor: an expected error is the largest error that was met, times this.
pub(super) const SAFETY: f64 = 2.0;

/// Name of the model that integrates over the speed in closed form. Its error is rounding alone.
pub(super) const SHARE: &str = "share";

/// `value` rounded to three digits; more would suggest a precision that these measurements do not have.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
