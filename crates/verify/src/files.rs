//! Files: errors of reading and writing name the file, and what is written is written whole or not at all.

use std::path::Path;

use anyhow::Context;
use serde::de::DeserializeOwned;

/// The text of the file at `path`.
///
/// # Errors
/// If it can't be read.
pub fn read(path: &Path) -> anyhow::Result<String> {
    std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
}

/// What the TOML file at `path` describes.
///
/// # Errors
/// If it can't be read or describes something else.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> anyhow::Result<T> {
    toml::from_str(&read(path)?).with_context(|| format!("in {}", path.display()))
}

/// Writes a file, and the folder that it is in.
///
/// # Errors
/// If the folder can't be made or the file not be written.
pub fn write(path: &Path, content: &str) -> anyhow::Result<()> {
    let failed = || format!("cannot write {}", path.display());
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(failed)?;
    whole_file::write(path, content).with_context(failed)
}
