//! Reads `validation/atlas.toml`: what every contestant is known to do at every hazard.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context;
use serde::Deserialize;

use crate::run::Answer;

/// The worst answer, by contestant and hazard.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Expected(BTreeMap<String, BTreeMap<String, Answer>>);

impl Expected {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If it can't be read.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        let failed = || format!("cannot read {}", path.display());
        let text = std::fs::read_to_string(path).with_context(failed)?;
        toml::from_str(&text).with_context(failed)
    }

    /// What `subject` is known to do at `hazard`.
    pub fn get(&self, subject: &str, hazard: &str) -> Option<Answer> {
        self.0.get(subject)?.get(hazard).copied()
    }
}
