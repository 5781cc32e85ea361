//! Prints answers as text, JSON or CSV, reads and writes files, and writes charts. All commands use these functions, so that
//! their output has the same form. The JSON is the one that `docs/json.md` describes.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Command};
use dynamics::data::in_words;
use dynamics::quantity::Given;
use dynamics::thrown::{Field, Holds};
use dynamics::{Error, Thrown};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::failure::Failure;
use crate::json::{SCHEMA, plain_json};
use crate::watch::{Ended, Watch};

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

/// The option for the format of an answer.
#[derive(Debug, clap::Args)]
pub(crate) struct FormatArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

impl FormatArgs {
    /// The answer as JSON, or its `text`.
    pub(crate) fn print(&self, asked: &Asked, answer: &impl Serialize, text: impl FnOnce() -> String) -> String {
        match (self.format, asked.watch.ended()) {
            (Format::Json, _) => json(asked, answer),
            (Format::Text, None) => text(),
            (Format::Text, Some(ended)) => format!("{}\nended        {}", text(), ended.in_words()),
        }
    }
}

/// Whether programs would take the chart for a picture of another kind, and refuse it.
fn is_named_as_another_picture(path: &Path) -> bool {
    let kinds = ["png", "jpg", "jpeg", "gif", "webp", "pdf"];
    path.extension().is_some_and(|own| kinds.iter().any(|kind| own.eq_ignore_ascii_case(kind)))
}

/// Options of a command that prints a series of data.
#[derive(Debug, clap::Args)]
pub(crate) struct SeriesArgs {
    /// Output format of the data [default: csv]
    #[arg(long, value_enum)]
    format: Option<DataFormat>,
    #[command(flatten)]
    pub(crate) chart: ChartArgs,
}

/// The option that draws a chart.
#[derive(Debug, clap::Args)]
pub(crate) struct ChartArgs {
    /// Also draw a chart into this file; - draws it on standard output, in place of the data
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl ChartArgs {
    /// Refuses a format of data that will not be printed, and a chart in a folder that is not there, before anything is computed.
    pub(crate) fn validate(&self, has_format: bool) -> Result<(), Failure> {
        match &self.svg {
            Some(path) if has_format && whole_file::leads_to(path) => Err(Failure::usage(
                "format",
                "--format has no effect with --svg on standard output, where the chart stands in place of the data",
            )),
            Some(path) if is_named_as_another_picture(path) => Err(Failure::usage(
                "svg",
                format!("svg = '{}' can't be used: expected a name that ends in .svg", path.display()),
            )),
            Some(path) => require_folder("svg", path),
            None => Ok(()),
        }
    }

    /// Whether a chart is asked for.
    pub(crate) fn is_some(&self) -> bool {
        self.svg.is_some()
    }

    /// Draws a chart that is asked for: the chart if it stands in place of the data, `None` if it is in its file or if there is
    /// none.
    pub(crate) fn drawn(&self, draw: impl FnOnce() -> Result<String, Failure>) -> Result<Option<String>, Failure> {
        let Some(path) = &self.svg else { return Ok(None) };
        let chart = draw()?;
        // XML has no control characters, and the title may have the name of a file.
        let chart = whole_file::printable_lines(&chart);
        if whole_file::leads_to(path) {
            return Ok(Some(chart));
        }
        write("svg", path, &chart)?;
        Ok(None)
    }
}

impl SeriesArgs {
    /// As [`ChartArgs::validate`].
    pub(crate) fn validate(&self) -> Result<(), Failure> {
        self.chart.validate(self.format.is_some())
    }

    /// The format of the data.
    pub(crate) fn format(&self) -> DataFormat {
        self.format.unwrap_or(DataFormat::Csv)
    }

    /// What is to be printed: the `data`, or the chart in their place. A chart for a file is written there.
    pub(crate) fn answer(
        &self,
        data: impl FnOnce(DataFormat) -> String,
        draw: impl FnOnce() -> Result<String, Failure>,
    ) -> Result<String, Failure> {
        Ok(self.chart.drawn(draw)?.unwrap_or_else(|| data(self.format())))
    }

    /// As [`SeriesArgs::answer`], for lines of plain data.
    pub(crate) fn answer_lines(
        &self,
        asked: &Asked,
        series: &[impl Serialize],
        draw: impl FnOnce() -> Result<String, Failure>,
    ) -> Result<String, Failure> {
        #[derive(Serialize)]
        struct Lines<'a, T> {
            series: &'a [T],
        }
        let data = |format| match format {
            DataFormat::Csv => csv(series),
            DataFormat::Json => json(asked, &Lines { series }),
        };
        self.answer(data, draw)
    }
}

/// Whether a file is named as one of this kind, such as `.csv`, in large or small letters.
pub(crate) fn has_ending(name: &str, ending: &str) -> bool {
    let start = name.len().checked_sub(ending.len());
    start.and_then(|start| name.get(start..)).is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// The content of the file that an option names.
pub(crate) fn read_bytes(option: &'static str, path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| Failure::read(option, path, &error))
}

/// The text of the file that an option names.
pub(crate) fn read(option: &'static str, path: &Path) -> Result<String, Failure> {
    whole_file::text(read_bytes(option, path)?).map_err(|wrong| {
        let source = Error::in_text(&wrong.before, Some(wrong.before.len()), wrong.to_string());
        Failure::text(&path.display().to_string(), &source)
    })
}

/// What a text in JSON describes.
pub(crate) fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|error| Error::in_json(text, (error.line(), error.column()), &error.to_string()))
}

/// What a text in TOML describes.
pub(crate) fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    toml::from_str(text).map_err(|error: toml::de::Error| {
        Error::in_text(text, error.span().map(|span| span.start), in_words(error.message()))
    })
}

/// Writes the file that an option names.
pub(crate) fn write(option: &'static str, path: &Path, text: &str) -> Result<(), Failure> {
    whole_file::write(path, text).map_err(|error| Failure::write(option, path, &error))
}

/// Refuses a file for an answer whose folder is not there, before anything is computed.
pub(crate) fn require_folder(option: &'static str, path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let found = folder.map_or(Ok(()), |folder| std::fs::metadata(folder).map(drop));
    found.map_err(|error| Failure::write(option, path, &error))
}

/// Prints an answer as a whole. A pipe that the reader has closed is no failure.
/// Nothing is printed for an answer that is empty because its command has printed it already.
pub(crate) fn print(text: &str, out: &mut dyn Write) -> Result<(), Failure> {
    if text.is_empty() {
        return Ok(());
    }
    let written = out.write_all(format!("{}\n", text.trim_end()).as_bytes()).and_then(|()| out.flush());
    whole_file::unless_closed(written).map_err(Failure::print)
}

/// What a command is asked, and the watch over its work.
#[derive(Debug)]
pub(crate) struct Asked {
    /// The input as a JSON answer repeats it.
    pub(crate) input: Map<String, Value>,
    pub(crate) watch: Watch,
}

/// What does not change the answer, only where it goes, in which form, and how fast it is there.
const NO_INPUT: [&str; 5] = ["format", "svg", "threads", "help", "version"];

/// The options of `command` that were `given` or have a default, by their names, and the command's name.
pub(crate) fn input(command: &Command, given: &ArgMatches) -> Map<String, Value> {
    let names = command.get_arguments().map(|argument| argument.get_id().as_str());
    let options = names.filter(|name| !NO_INPUT.contains(name));
    let mut input: Map<String, Value> =
        options.filter_map(|name| Some((name.to_owned(), value(name, given)?))).collect();
    input.insert("command".to_owned(), command.get_name().into());
    input
}

/// An option as it was typed: a number, however it is written, or the text of a quantity with its unit and of anything else. A
/// flag that was not given is no input.
fn value(name: &str, given: &ArgMatches) -> Option<Value> {
    fn typed<T: Clone + Send + Sync + 'static>(name: &str, given: &ArgMatches) -> Option<T> {
        given.try_get_one::<T>(name).ok()?.cloned()
    }
    if let Ok(Some(flag)) = given.try_get_one::<bool>(name) {
        return flag.then(|| true.into());
    }
    let mut texts = given.try_get_raw(name).ok()??.map(|text| text.to_string_lossy().into_owned());
    if name == "parts" {
        return Some(texts.map(Value::from).collect());
    }
    let text = texts.next()?;
    let quantity = typed::<f64>(name, given).or_else(|| typed::<Given>(name, given).map(Given::si));
    let small = || typed::<u32>(name, given).map(u64::from).or_else(|| Some(typed::<usize>(name, given)? as u64));
    let whole = || typed::<u64>(name, given).or_else(small).map(whole);
    let number = quantity.map(|number| as_typed(&text, number)).or_else(whole);
    Some(number.or_else(|| list(name, &text)).unwrap_or_else(|| text.into()))
}

/// A number, or the `text` that it was read from if that has a unit. A percentage is a number as well.
fn as_typed(text: &str, number: f64) -> Value {
    let text = text.trim();
    let is_number = text.parse::<f64>().is_ok() || text.ends_with('%');
    if is_number { number.into() } else { text.into() }
}

/// An option that is a list of numbers.
fn list(name: &str, text: &str) -> Option<Value> {
    let field = Field::named(name).ok().filter(|of| matches!(of.info().holds, Holds::List(_) | Holds::Several(_)))?;
    let mut thrown = Thrown::default();
    thrown.set(field, text).ok()?;
    Some(text.split(',').zip(thrown.numbers(field)).map(|(text, number)| as_typed(text, number.si())).collect())
}

/// An answer, which has fields, as JSON. It says so if the work ended early.
pub(crate) fn json(asked: &Asked, answer: &impl Serialize) -> String {
    #[derive(Serialize)]
    struct Answered<'a, T> {
        schema: u32,
        input: &'a Map<String, Value>,
        #[serde(flatten)]
        answer: &'a T,
        #[serde(skip_serializing_if = "Option::is_none")]
        ended: Option<&'static str>,
    }
    plain_json(&Answered { schema: SCHEMA, input: &asked.input, answer, ended: asked.watch.ended().map(Ended::name) })
}

/// A whole number as JSON: its digits as a text above 2^53, because readers that take numbers for f64, as JavaScript does,
/// would round it.
fn whole(number: u64) -> Value {
    if number <= 1 << 53 { number.into() } else { number.to_string().into() }
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

/// Formats rows as a table with aligned columns. The first row is the heading.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let printable = |row: &Vec<String>| row.iter().map(|cell| whole_file::printable(cell)).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(printable).collect();
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// A row of a table.
pub(crate) fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}
