//! What the parts of the planner's table share: the seed, the factor of safety, a model and the digits of its figures.

/// Seed of the tosses and spaces that the table is fitted to; the scenes that it is tried on have another.
pub(super) const SEED: u64 = 11;

/// Expected errors are the largest that were met, times this.
pub(super) const SAFETY: f64 = 2.0;

/// The model of shares over the speed, whose error is that of rounding.
pub(super) const SHARE: &str = "share";

/// Three digits are all that a measurement of this kind is good for.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
