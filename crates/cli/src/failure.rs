//! The reasons for which a command gives no answer, with their exit codes and their JSON. All of them are of one type, so that
//! every command reports a failure in the same way.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;

use chart::ChartError;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use serde_json::{Map, Value, json};
use toss::{Error, InputError, SolveError};
use whole_file::{TableError, printable};

use crate::json::{SCHEMA, plain_json};
use crate::watch::Ended;

/// The reason why a command gives no answer.
#[derive(Debug)]
pub(crate) struct Failure {
    /// Its name in JSON, such as `input`.
    kind: &'static str,
    /// What is wrong, in one line: names and values that somebody gave stand as in a string of Rust.
    message: String,
    /// Further fields of its JSON, such as `field` or `time`.
    details: Value,
    /// The exit code: 1 if the solver failed, the answer can't be printed or threads can't start, 2 for bad usage or input.
    pub(crate) exit_code: u8,
    /// The message as clap prints it, with colours and the usage.
    of_arguments: Option<String>,
    /// Whether the answer, which was begun, says it already.
    pub(crate) is_said: bool,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let exit_code = if error.is_input() { 2 } else { 1 };
        // People count launches from 1, and the library by an index from 0.
        Self { exit_code, ..Self::new(error.kind(), error.clone().after(1), details(&error)) }
    }
}

impl From<InputError> for Failure {
    fn from(source: InputError) -> Self {
        Error::from(source).into()
    }
}

impl From<SolveError> for Failure {
    fn from(source: SolveError) -> Self {
        Error::from(source).into()
    }
}

impl From<ChartError> for Failure {
    fn from(error: ChartError) -> Self {
        Self::new("chart", format!("cannot draw the chart: {error}"), json!({}))
    }
}

impl From<Ended> for Failure {
    /// Work that ended before there was an answer.
    fn from(ended: Ended) -> Self {
        let message = format!("{} before there was an answer", ended.in_words());
        Self { exit_code: ended.exit_code(), ..Self::new("ended", message, json!({"ended": ended.name()})) }
    }
}

impl Failure {
    /// Bad usage or input.
    fn new(kind: &'static str, message: impl Display, details: Value) -> Self {
        let message = printable(&message.to_string());
        Self { kind, message, details, exit_code: 2, of_arguments: None, is_said: false }
    }

    /// Arguments that are not understood.
    pub(crate) fn arguments(error: &clap::Error) -> Self {
        let of_arguments = Some(error.render().ansi().to_string());
        Self { of_arguments, ..Self::new("input", words(error), argument_details(error)) }
    }

    /// An input of the option that `source` may not call by its name.
    pub(crate) fn value(option: &'static str, source: InputError) -> Self {
        if source.field() == option {
            return source.into();
        }
        let error = Error::from(source);
        Self::new(error.kind(), format!("--{option}: {error}"), details(&error))
    }

    /// The option `field` can't be used, as `message` says.
    pub(crate) fn usage(field: &'static str, message: impl Display) -> Self {
        Self::new("input", message, json!({"field": field}))
    }

    /// The part in the file at `path` can't be used, as `message` says.
    pub(crate) fn part(path: &str, message: impl Display) -> Self {
        Self::new("input", format!("{path}: {message}"), json!({"path": path}))
    }

    /// The file at `path`, whose text is not a valid description.
    pub(crate) fn text(path: &str, source: &Error) -> Self {
        Self::new(source.kind(), format!("{path}, {source}"), with(details(source), "path", json!(path)))
    }

    /// The place in the table at `path` that is at fault.
    pub(crate) fn table(path: &str, TableError { line, column, message }: TableError) -> Self {
        Self::text(path, &Error::Text { line: usize::try_from(line).unwrap_or(usize::MAX), column, message })
    }

    /// A row of the table at `path` of which a value is invalid; the line and the cell in it are counted from 1.
    pub(crate) fn row(path: &str, [line, column]: [u64; 2], source: &InputError) -> Self {
        let place = [("path", json!(path)), ("line", json!(line)), ("column", json!(column))];
        let details = place.into_iter().fold(input_details(source), |details, (key, value)| with(details, key, value));
        Self::new("input", format!("{path}, line {line}, column {column}: {source}"), details)
    }

    /// The file that an option names, which can't be read.
    pub(crate) fn read(option: &'static str, path: &Path, error: &std::io::Error) -> Self {
        Self::of_file("read", option, path, error)
    }

    /// The file that an option names, which can't be written.
    pub(crate) fn write(option: &'static str, path: &Path, error: &std::io::Error) -> Self {
        Self::of_file("write", option, path, error)
    }

    fn of_file(kind: &'static str, option: &'static str, path: &Path, error: &std::io::Error) -> Self {
        // The files of parts have no option.
        let shown = if option == "parts" { "PART".to_owned() } else { format!("--{option}") };
        let is_missing = error.kind() == std::io::ErrorKind::NotFound;
        let expected = if is_missing { "; expected a file in a folder that exists" } else { "" };
        let path = path.display().to_string();
        let message = format!("{shown}: cannot {kind} {path}: {error}{expected}");
        Self::new(kind, message, json!({"field": option, "path": path}))
    }

    /// Threads that the system does not start.
    pub(crate) fn threads(number: usize, error: &rayon::ThreadPoolBuildError) -> Self {
        let message = format!("cannot start {number} threads: {error}; try --threads 1");
        Self { exit_code: 1, ..Self::new("threads", message, json!({"field": "threads"})) }
    }

    /// Standard output that can't be written.
    #[expect(clippy::needless_pass_by_value, reason = "map_err passes it so")]
    pub(crate) fn print(error: std::io::Error) -> Self {
        Self { exit_code: 1, ..Self::new("write", format!("cannot write standard output: {error}"), json!({})) }
    }

    /// The same failure, which the answer says already.
    #[must_use]
    pub(crate) fn said(self) -> Self {
        Self { is_said: true, ..self }
    }

    /// Whether work has ended early, whose answer was not known yet.
    pub(crate) fn is_of_ended_work(&self) -> bool {
        self.kind == Error::Ended.kind()
    }

    /// Says on `err` what is wrong. If that can't be written there is nowhere left to say so.
    pub(crate) fn report(&self, err: &mut dyn Write) {
        let _ = match &self.of_arguments {
            Some(rendered) => write!(err, "{rendered}"),
            None => writeln!(err, "error: {}", self.message),
        };
    }

    /// `{"error":{"kind":..,"message":..,..},..}` with further fields that depend on the kind, such as `field` or `time`.
    pub(crate) fn to_json(&self) -> String {
        plain_json(&json!({ "schema": SCHEMA, "error": self.json() }))
    }

    /// What is wrong, as the object `error` of an answer.
    pub(crate) fn json(&self) -> Value {
        let mut error = Map::new();
        error.insert("kind".to_owned(), json!(self.kind));
        error.insert("message".to_owned(), json!(self.message));
        error.extend(self.details.as_object().cloned().unwrap_or_default());
        error.into()
    }
}

/// What clap says is wrong, in a line, without the usage.
fn words(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "a command is needed; --help lists them".to_owned();
    }
    let text = error.to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let end = ["\n\nUsage:", "\n\nFor more information"].iter().filter_map(|rest| text.find(rest)).min();
    text[..end.unwrap_or(text.len())].split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The option that clap complains about, and its value.
fn argument_details(error: &clap::Error) -> Value {
    let mut details = json!({});
    if let Some(field) = option_of(error) {
        details["field"] = json!(field);
    }
    if let Some(ContextValue::String(value)) = error.get(ContextKind::InvalidValue) {
        details["value"] = json!(value);
    }
    details
}

/// The option that clap complains about, without dashes and value.
fn option_of(error: &clap::Error) -> Option<String> {
    let argument = match error.get(ContextKind::InvalidArg)? {
        ContextValue::String(argument) => argument,
        ContextValue::Strings(arguments) => arguments.first()?,
        _ => return None,
    };
    argument.trim_start_matches('-').split([' ', '=']).next().map(str::to_owned)
}

fn details(error: &Error) -> Value {
    match error {
        Error::Input(source) => input_details(source),
        Error::BadLaunch { index, source } => with(input_details(source), "launch", json!({"index": index})),
        Error::Solve(source) => solve_details(source),
        Error::Launch { index, toss, source } => {
            let (rate, flight_time) = (<[f64; 3]>::from(toss.launch.rate()), toss.launch.flight_time());
            let launch = json!({"index": index, "rate": rate, "flight_time": flight_time});
            with(solve_details(source), "launch", launch)
        }
        Error::Text { line, column, .. } => json!({"line": line, "column": column}),
        other => other.field().map_or_else(|| json!({}), |field| json!({"field": field})),
    }
}

fn input_details(source: &InputError) -> Value {
    match source {
        InputError::OutOfRange { field, value, valid } => json!({"field": field, "value": value, "valid": valid}),
        InputError::Malformed { field, value, .. }
        | InputError::LookAlike { field, value, .. }
        | InputError::UnknownName { field, value, .. }
        | InputError::NoEffect { field, value, .. } => json!({"field": field, "value": value}),
        other => json!({"field": other.field()}),
    }
}

fn solve_details(source: &SolveError) -> Value {
    match source {
        SolveError::PhaseTooLarge { phase } => json!({"phase": phase}),
        SolveError::Singular { point, time } => json!({"point": point.to_string(), "time": time}),
        SolveError::StepLimit { time, limit } => json!({"time": time, "limit": limit}),
        SolveError::StepSizeUnderflow { time } | SolveError::NotFinite { time } => json!({"time": time}),
        _ => json!({}),
    }
}

/// `details` with one more key.
fn with(mut details: Value, key: &str, value: Value) -> Value {
    details[key] = value;
    details
}
