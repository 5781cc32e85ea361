//! How answers leave the program.

use std::io::Write;
use std::path::PathBuf;

use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use serde::Serialize;

use crate::failure::Failure;

/// For people or for programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Aligned text with units
    Text,
    /// One JSON value on standard output
    Json,
}

/// Series of data for programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum DataFormat {
    /// A line a point, with a heading
    Csv,
    /// JSON
    Json,
}

/// How a series of data is wanted.
#[derive(Debug, clap::Args)]
pub(crate) struct SeriesArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    pub(crate) format: DataFormat,
    /// Also draw it into this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl SeriesArgs {
    /// Writes the chart that `draw` makes, if one is wanted: whole or not at all.
    pub(crate) fn draw(&self, draw: impl FnOnce() -> Result<String, Failure>) -> Result<(), Failure> {
        let Some(path) = &self.svg else { return Ok(()) };
        whole_file::write(path, &draw()?)
            .map_err(|source| Failure::Write { target: path.display().to_string(), source })
    }

    /// Lines of plain data in the format asked for.
    pub(crate) fn data(&self, lines: &[impl Serialize]) -> String {
        match self.format {
            DataFormat::Csv => csv(lines),
            DataFormat::Json => json(&lines),
        }
    }
}

/// Prints an answer as one piece; a reader that has gone away (a closed pipe) is no failure.
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

/// Plain data as JSON.
pub(crate) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain data with string keys is always JSON")
}

/// Lines of plain data as CSV, with a heading.
pub(crate) fn csv(lines: impl IntoIterator<Item = impl Serialize>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.serialize(line).expect("a line of plain data always fits into memory");
    }
    String::from_utf8(writer.into_inner().expect("memory takes every byte")).expect("CSV of UTF-8 is UTF-8")
}

/// A bar over as many `things` with rate and time left, on standard error; hidden unless that is a terminal.
pub(crate) fn progress_bar(number: u64, things: &'static str) -> ProgressBar {
    let rate = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        // An error would be one of the terminal, which shows the bar or does not.
        let _ = write!(out, "{}/s", HumanCount(state.per_sec() as u64));
    };
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} {msg}, {rate}, {eta} left")
        .expect("the template is valid")
        .with_key("rate", rate);
    ProgressBar::new(number).with_style(style).with_message(things)
}

/// A table with aligned columns; the first row is the heading.
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
