//! Prints answers as text, JSON or CSV, and writes charts. All commands use these functions, so that their output has
//! the same form.

use std::io::Write;
use std::path::PathBuf;

use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use serde::Serialize;

use crate::failure::Failure;

/// The format of an answer, for people or for programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Aligned text with units
    Text,
    /// One JSON value on standard output
    Json,
}

/// The format of a series of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum DataFormat {
    /// One line per point, with a heading
    Csv,
    /// One JSON value on standard output
    Json,
}

/// Options of a command that prints a series of data.
#[derive(Debug, clap::Args)]
pub(crate) struct SeriesArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    pub(crate) format: DataFormat,
    /// Also draw a chart into this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl SeriesArgs {
    /// Writes the chart that `draw` makes if `--svg` was given. The file is written whole or not at all.
    pub(crate) fn draw(&self, draw: impl FnOnce() -> Result<String, Failure>) -> Result<(), Failure> {
        let Some(path) = &self.svg else { return Ok(()) };
        whole_file::write(path, &draw()?)
            .map_err(|source| Failure::Write { target: path.display().to_string(), source })
    }

    /// Formats lines of plain data as `--format` says.
    pub(crate) fn data(&self, lines: &[impl Serialize]) -> String {
        match self.format {
            DataFormat::Csv => csv(lines),
            DataFormat::Json => json(&lines),
        }
    }
}

/// Prints an answer as a whole. A pipe that the reader has closed is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let written =
        out.write_all(text.trim_end().as_bytes()).and_then(|()| out.write_all(b"\n")).and_then(|()| out.flush());
    match written {
        Err(source) if source.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Write { target: "standard output".to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// Formats plain data as JSON.
pub(crate) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain data with string keys is always JSON")
}

/// Formats lines of plain data as CSV with a heading.
pub(crate) fn csv(lines: impl IntoIterator<Item = impl Serialize>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.serialize(line).expect("a line of plain data always fits into memory");
    }
    String::from_utf8(writer.into_inner().expect("memory takes every byte")).expect("CSV of UTF-8 is UTF-8")
}

/// A progress bar for `number` `things` on standard error, with the rate and the time left. It is hidden if standard
/// error is not a terminal.
pub(crate) fn progress_bar(number: u64, things: &'static str) -> ProgressBar {
    let rate = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        // An error of the terminal is ignored: the bar is not part of the answer.
        let _ = write!(out, "{}/s", HumanCount(state.per_sec() as u64));
    };
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} {msg}, {rate}, {eta} left")
        .expect("the template is valid")
        .with_key("rate", rate);
    ProgressBar::new(number).with_style(style).with_message(things)
}

/// Formats rows as a table with aligned columns. The first row is the heading.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
