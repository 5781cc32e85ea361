//! This file reads and writes files. Every error names the file, and a file is written as a whole or not at all, so
//! that an interrupted run leaves no half of a report or baseline. It prints, too, without a panic where nothing can be
//! printed.

use std::io::{ErrorKind, Write};
use std::path::Path;

use anyhow::Context;

/// Reads the text of the file at `path`. A byte order mark, with which some editors begin a file, is left out.
pub fn read(path: &Path) -> anyhow::Result<String> {
    let failed = || format!("cannot read {}", path.display());
    whole_file::text(std::fs::read(path).with_context(failed)?).with_context(failed)
}

/// As [`read`]; `None` if nothing has this path. A link to nothing is something, whose text can't be read.
pub fn read_if_any(path: &Path) -> anyhow::Result<Option<String>> {
    match path.symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        _ => read(path).map(Some),
    }
}

/// Prints `text` on standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> anyhow::Result<()> {
    printed(whole_file::print(text))
}

/// The same result with an error that says what could not be written.
pub fn printed(result: std::io::Result<()>) -> anyhow::Result<()> {
    result.context("cannot write standard output")
}

/// Writes `content` to the file at `path`, and makes its folder if there is none.
pub fn write(path: &Path, content: &str) -> anyhow::Result<()> {
    let failed = || format!("cannot write {}", path.display());
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(failed)?;
    whole_file::write(path, content).with_context(failed)
}

/// Adds `content` to the end of the file at `path`, and makes the file if there is none.
pub fn append(path: &Path, content: &str) -> anyhow::Result<()> {
    let open = std::fs::OpenOptions::new().append(true).create(true).open(path);
    open.and_then(|mut file| file.write_all(content.as_bytes()))
        .with_context(|| format!("cannot write {}", path.display()))
}

/// Writes `text` to standard error; there is nowhere left to say that this failed.
pub fn say(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
