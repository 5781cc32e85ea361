//! This file reads `validation/bounds.toml`, the only table of allowed deviations. Bounds stand in a file of their own,
//! with reasons, so that every change of one is visible in a review.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, ensure};
use serde::Deserialize;

use crate::files;

/// Allowed deviations by check and subject, with the reason for each check's bounds.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct Bounds(BTreeMap<String, CheckBounds>);

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckBounds {
    reason: String,
    allowed: BTreeMap<String, f64>,
}

impl Bounds {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If the file can't be read, or a bound is negative or not finite, or has no reason.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        Self::parse(&files::read(path)?).with_context(|| format!("in {}", path.display()))
    }

    /// Reads the table from its text.
    ///
    /// # Errors
    /// As [`Bounds::read`].
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let bounds: Self = toml::from_str(text)?;
        for (check, entry) in &bounds.0 {
            ensure!(!entry.reason.trim().is_empty(), "[{check}] gives no reason for its bounds");
            for (subject, bound) in &entry.allowed {
                ensure!(
                    bound.is_finite() && *bound >= 0.0,
                    "[{check}] {subject} = {bound}: a bound must be finite and at least 0"
                );
            }
        }
        Ok(bounds)
    }

    /// The bound of `subject` under `check`, in the unit of the check.
    pub fn get(&self, check: &str, subject: &str) -> Option<f64> {
        self.0.get(check)?.allowed.get(subject).copied()
    }

    /// All pairs of check and subject that have a bound.
    pub fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0
            .iter()
            .flat_map(|(check, entry)| entry.allowed.keys().map(move |subject| (check.as_str(), subject.as_str())))
    }
}
