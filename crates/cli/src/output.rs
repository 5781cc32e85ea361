//! Prints answers as text, JSON or CSV, and writes charts. All commands use these functions, so that their output has
//! the same form.

use std::io::Write;
use std::path::{Path, PathBuf};

use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use serde::Serialize;

use crate::failure::Failure;
pub(crate) use crate::json::{Input, json, plain_json, whole, without_sign_of_zero};

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
    /// Output format of the data [default: csv]
    #[arg(long, value_enum)]
    format: Option<DataFormat>,
    /// Also draw a chart into this file; - draws it on standard output, in place of the data
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl SeriesArgs {
    /// Refuses a format of data that will not be printed, and a chart in a folder that is not there, before anything is computed.
    pub(crate) fn validate(&self) -> Result<(), Failure> {
        match (&self.svg, self.format) {
            (Some(path), Some(_)) if whole_file::leads_to(path) => Err(Failure::usage(
                "format",
                "--format has no effect with --svg on standard output, where the chart stands in place of the data",
            )),
            (Some(path), _) => require_folder("svg", path),
            _ => Ok(()),
        }
    }

    /// What is to be printed: the `data`, or the chart in their place. A chart for a file is written there.
    pub(crate) fn answer(
        &self,
        data: impl FnOnce(DataFormat) -> String,
        draw: impl FnOnce() -> Result<String, Failure>,
    ) -> Result<String, Failure> {
        if let Some(path) = &self.svg {
            let chart = draw()?;
            if whole_file::leads_to(path) {
                return Ok(chart);
            }
            whole_file::write(path, &chart).map_err(|source| Failure::Write {
                option: "svg",
                target: path.display().to_string(),
                source,
            })?;
        }
        Ok(data(self.format.unwrap_or(DataFormat::Csv)))
    }
}

/// Refuses a file for an answer whose folder is not there, before anything is computed.
pub(crate) fn require_folder(option: &'static str, path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let found = folder.map_or(Ok(()), |folder| std::fs::metadata(folder).map(drop));
    found.map_err(|source| Failure::Write { option, target: path.display().to_string(), source })
}

/// Lines of plain data in `format`.
pub(crate) fn series(input: &Input, format: DataFormat, series: &[impl Serialize]) -> String {
    #[derive(Serialize)]
    struct Answer<'a, T> {
        series: &'a [T],
    }
    match format {
        DataFormat::Csv => csv(series),
        DataFormat::Json => json(input, &Answer { series }),
    }
}

/// Prints an answer as a whole. A pipe that the reader has closed is no failure.
/// Nothing is printed for an answer that is empty because its command has printed it already.
pub(crate) fn print(text: &str, out: &mut dyn Write) -> Result<(), Failure> {
    if text.is_empty() {
        return Ok(());
    }
    let written = out.write_all(format!("{}\n", text.trim_end()).as_bytes()).and_then(|()| out.flush());
    whole_file::unless_closed(written).map_err(Failure::Print)
}

/// A number with its sign and so many decimal places; what is rounded to 0 has the sign of 0.
pub(crate) fn fixed(value: f64, places: usize) -> String {
    let text = format!("{value:+.places$}");
    if text.contains(|digit: char| matches!(digit, '1'..='9')) { text } else { text.replace('-', "+") }
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

/// A count of things whose number is not known before.
pub(crate) fn counter(things: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {human_pos} {msg}, {elapsed}").expect("the template is valid");
    ProgressBar::new_spinner().with_style(style).with_message(things)
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
