//! This file reads tables of allowed deviations. Limits stand in a file of their own, with reasons, so that every
//! change of one is visible in a review: `data/limits.toml` for the solvers of this workspace, and `limits.toml` in the
//! folder of a suite for others.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use anyhow::{Context, ensure};
use serde::Deserialize;

use crate::files;
use crate::measure::checks::CHECKS;

/// Allowed deviations by check and subject, with the reason for each check's limits.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct Limits(BTreeMap<String, CheckLimits>);

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckLimits {
    reason: String,
    allowed: BTreeMap<String, f64>,
}

/// The largest limit that a table may give under the check called `check`; infinite for a check that is not in
/// [`CHECKS`], whose rows its own ceiling still limits.
pub(crate) fn ceiling(check: &str) -> f64 {
    CHECKS.iter().find(|known| known.id == check).map_or(f64::INFINITY, |known| known.ceiling)
}

impl Limits {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If the file can't be read, or a limit is negative, not finite or above the ceiling of its check, or has no
    /// reason.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        Self::parse(&files::read(path)?).with_context(|| format!("in {}", path.display()))
    }

    /// Reads the table at `path`; empty if there is no such file.
    ///
    /// # Errors
    /// As [`Limits::read`].
    pub fn read_if_any(path: &Path) -> anyhow::Result<Self> {
        if path.exists() { Self::read(path) } else { Ok(Self(BTreeMap::new())) }
    }

    /// The limits of the solvers and libraries of this workspace.
    ///
    /// # Errors
    /// Never: tests read them.
    pub fn of_this_workspace() -> anyhow::Result<Self> {
        Self::parse(include_str!("../../data/limits.toml"))
    }

    /// These limits and, for each check and subject without one among them, that of `others`.
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
    /// As [`Limits::read`].
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let limits: Self = toml::from_str(text)?;
        for (check, entry) in &limits.0 {
            ensure!(!entry.reason.trim().is_empty(), "[{check}] gives no reason for its limits");
            for (subject, limit) in &entry.allowed {
                ensure!(
                    limit.is_finite() && *limit >= 0.0,
                    "[{check}] {subject} = {limit}: a limit must be finite and at least 0"
                );
                let ceiling = ceiling(check);
                ensure!(
                    *limit <= ceiling,
                    "[{check}] {subject} = {limit}: no limit of this check may be above {ceiling}, its ceiling"
                );
            }
        }
        Ok(limits)
    }

    /// The limit of `subject` under `check`, in the unit of the check.
    pub fn get(&self, check: &str, subject: &str) -> Option<f64> {
        self.0.get(check)?.allowed.get(subject).copied()
    }

    /// All pairs of check and subject that have a limit.
    pub fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0
            .iter()
            .flat_map(|(check, entry)| entry.allowed.keys().map(move |subject| (check.as_str(), subject.as_str())))
    }
}
