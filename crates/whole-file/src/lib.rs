//! Reads and writes the texts of a program. Files are written whole or not at all, and standard output without a panic: a
//! program that is interrupted while it writes a report or a baseline must not leave half a file, which the next run would
//! read. Texts and [tables](Table) are read as editors and spreadsheets write them, and what others wrote is
//! [printed](printable()) without what it does to a terminal.
//!
//! An output is named by a path. What happens depends on what is there:
//!
//! | path | what is done |
//! |---|---|
//! | `-`, or the file that standard output leads to | printed |
//! | nothing, or a regular file | the content goes into a temporary neighbour, which then takes the name |
//! | a symbolic link | the same, for the file that it leads to; the link stays |
//! | a device, a pipe, a socket | written through |
//! | a read-only file, a folder | an error |

#[cfg(feature = "files")]
mod file;
mod printable;
#[cfg(feature = "files")]
mod standard;
mod table;
mod text;

#[cfg(feature = "files")]
use std::io;
#[cfg(feature = "files")]
use std::path::Path;

pub use printable::{is_hidden, printable, printable_lines};
#[cfg(feature = "files")]
pub use standard::{leads_to, print, report, unless_closed};
pub use table::{Row, Table, TableError};
pub use text::{NotText, text};

/// Writes `content` to the output at `path`, as [the table](self) says. A reader that has gone away is not an error.
///
/// # Errors
/// If the output can't be written. A regular file is then what it was, and nothing is left behind.
#[cfg(feature = "files")]
pub fn write(path: &Path, content: &str) -> io::Result<()> {
    if leads_to(path) { print(content) } else { unless_closed(file::write(path, content.as_bytes())) }
}
