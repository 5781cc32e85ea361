//! Standard output and standard error, without a panic where they can't be written.
//!
//! The macros of the standard library panic there. A reader that has gone away is not an error; a full device is one. The crate
//! `whole-file` does the same for the other programs; this one depends on no crate of the workspace.

use std::fmt;
use std::io::{self, ErrorKind, Write};

/// Prints `text` on standard output.
///
/// # Errors
/// If it can't be written, unless the reader has gone away.
pub(crate) fn print(text: &str) -> Result<(), String> {
    let mut out = io::stdout().lock();
    printed(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// The same result in words, except that a reader that has gone away is not an error.
pub(crate) fn printed(result: io::Result<()>) -> Result<(), String> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!("cannot write standard output: {error}")),
        _ => Ok(()),
    }
}

/// Writes a line to standard error. There is nowhere left to say that this failed.
pub(crate) fn say(line: impl fmt::Display) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
