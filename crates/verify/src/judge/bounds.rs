//! This file reads tables of allowed deviations. Bounds stand in a file of their own, with reasons, so that every
//! change of one is visible in a review: `data/bounds.toml` for the solvers of this workspace, and `bounds.toml` in the
//! folder of a suite for others.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use anyhow::{Context, ensure};
use serde::Deserialize;

use crate::measure::checks::CHECKS;
use crate::{data, files};

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

/// The largest bound that a table may give under the check called `check`; infinite for a check that is not in
/// [`CHECKS`], whose rows its own ceiling still limits.
pub(crate) fn ceiling(check: &str) -> f64 {
    CHECKS.iter().find(|known| known.id == check).map_or(f64::INFINITY, |known| known.ceiling)
}

impl Bounds {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If the file can't be read, or a bound is negative, not finite or above the ceiling of its check, or has no
    /// reason.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        Self::parse(&files::read(path)?).with_context(|| format!("in {}", path.display()))
    }

    /// Reads the table at `path`; empty if there is no such file.
    ///
    /// # Errors
    /// As [`Bounds::read`].
    pub fn read_if_any(path: &Path) -> anyhow::Result<Self> {
        if path.exists() { Self::read(path) } else { Ok(Self(BTreeMap::new())) }
    }

    /// The bounds of the solvers and libraries of this workspace.
    ///
    /// # Errors
    /// Never: tests read them.
    pub fn of_this_workspace() -> anyhow::Result<Self> {
        Self::parse(data::BOUNDS)
    }

    /// These bounds and, for each check and subject without one among them, that of `others`.
    #[must_use]
    pub fn over(self, others: Self) -> Self {
        let mut all = others.0;
        for (check, own) in self.0 {
            match all.entry(check) {
                Entry::Vacant(place) => drop(place.insert(own)),
                Entry::Occupied(mut place) => place.get_mut().allowed.extend(own.allowed),
            }
        }
        Self(all)
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
                let ceiling = ceiling(check);
                ensure!(
                    *bound <= ceiling,
                    "[{check}] {subject} = {bound}: no bound of this check may be above {ceiling}, its ceiling"
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
