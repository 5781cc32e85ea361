//! Standard output and standard error, without a panic where they can't be written.
//!
//! The macros of the standard library panic there. A reader that has gone away is not an error; a full device is one.

use std::fmt;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use crate::printable::printable_lines;

/// Prints `text` on standard output.
///
/// # Errors
/// If it can't be written, unless the reader has gone away.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    unless_closed(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints `error: ` and the error on standard error. There is nowhere left to say that this failed; the exit code still tells.
pub fn report(error: impl fmt::Display) {
    let _ = writeln!(io::stderr().lock(), "error: {}", printable_lines(&error.to_string()));
}

/// The same result, except that a reader that has gone away is not an error.
pub fn unless_closed(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        _ => written,
    }
}

/// Whether an output at `path` goes to standard output: if `path` is `-`, or names the file that standard output leads to.
/// Such a file must not be replaced, because what is printed would be lost.
pub fn leads_to(path: &Path) -> bool {
    path.as_os_str() == "-" || is_standard_output(path)
}

#[cfg(unix)]
fn is_standard_output(path: &Path) -> bool {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt;
    let printed = io::stdout().as_fd().try_clone_to_owned().and_then(|output| std::fs::File::from(output).metadata());
    match (printed, std::fs::metadata(path)) {
        (Ok(printed), Ok(named)) => (printed.dev(), printed.ino()) == (named.dev(), named.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_standard_output(_: &Path) -> bool {
    false
}
