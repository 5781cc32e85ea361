//! The reasons for which a command gives no answer, with their exit codes and their JSON. All of them go through one
//! type, so that every command reports a failure in the same way.

use std::io::Write;

use chart::ChartError;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use serde_json::{Map, Value, json};
use toss::{Error, InputError, SolveError};
use whole_file::{TableError, printable};

use crate::json::{SCHEMA, plain_json};
use crate::watch::Ended;

/// The reason why a command gives no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Invalid input, or a solver that failed.
    #[error("{}", counted_from_1(.0))]
    Unanswered(#[from] Error),
    /// Arguments that are not understood.
    #[error("{}", words(.0))]
    Arguments(clap::Error),
    /// An option that is missing, invalid or in conflict with another.
    #[error("{message}")]
    Usage {
        /// The option at fault.
        field: &'static str,
        /// What is wrong with it.
        message: String,
    },
    /// The value of an option from which a part follows that is invalid.
    #[error("--{option}: {source}")]
    Value {
        /// The option.
        option: &'static str,
        /// What is wrong with the part.
        source: Error,
    },
    /// A file that can't be read.
    #[error("{}: cannot read {path}: {source}{}", shown(.option), folder(.source))]
    Read {
        /// The option that names it.
        option: &'static str,
        /// The file.
        path: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A file whose text is not a valid description.
    #[error("{path}, {source}")]
    Text {
        /// The file.
        path: String,
        /// The error, with its line and column.
        source: Error,
    },
    /// A row of a file of which a value is invalid.
    #[error("{path}, line {line}, column {column}: {source}")]
    Row {
        /// The file.
        path: String,
        /// The line, from 1.
        line: u64,
        /// The cell in it, from 1.
        column: usize,
        /// What is wrong with it.
        source: InputError,
    },
    /// A file of a part that does not fit.
    #[error("{path}: {message}")]
    Part {
        /// The file.
        path: String,
        /// What is wrong with it.
        message: String,
    },
    /// Threads that the system does not start.
    #[error("cannot start {number} threads: {source}; try --threads 1")]
    Threads {
        /// How many.
        number: usize,
        /// Why not.
        source: rayon::ThreadPoolBuildError,
    },
    /// Work that ended before there was an answer.
    #[error("{} before there was an answer", .0.in_words())]
    Ended(Ended),
    /// A failure that the answer, which was begun, says already.
    #[error("{0}")]
    Said(Box<Failure>),
    /// Standard output that can't be written.
    #[error("cannot write standard output: {0}")]
    Print(std::io::Error),
    /// A file that can't be written.
    #[error("{}: cannot write {target}: {source}{}", shown(.option), folder(.source))]
    Write {
        /// The option that names it.
        option: &'static str,
        /// The file.
        target: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A chart that can't be drawn.
    #[error("cannot draw the chart: {0}")]
    Chart(#[from] ChartError),
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

impl Failure {
    /// An input of the option that `source` may not call by its name.
    pub(crate) fn value(option: &'static str, source: InputError) -> Self {
        if source.field() == option { source.into() } else { Self::Value { option, source: source.into() } }
    }

    /// The option `field` can't be used, as `message` says.
    pub(crate) fn usage(field: &'static str, message: impl Into<String>) -> Self {
        Self::Usage { field, message: message.into() }
    }

    /// The part in the file at `path` can't be used, as `message` says.
    pub(crate) fn part(path: &str, message: String) -> Self {
        Self::Part { path: path.to_owned(), message }
    }

    /// The place in the table at `path` that is at fault.
    pub(crate) fn table(path: &str, TableError { line, column, message }: TableError) -> Self {
        let line = usize::try_from(line).unwrap_or(usize::MAX);
        Self::Text { path: path.to_owned(), source: Error::Text { line, column, message } }
    }

    /// What is wrong, in one line: names and values that somebody gave stand as in a string of Rust.
    fn message(&self) -> String {
        printable(&self.to_string()).into_owned()
    }

    /// Says on `err` what is wrong. If that can't be written there is nowhere left to say so.
    pub(crate) fn report(&self, err: &mut dyn Write) {
        let _ = match self {
            // With colours and the usage.
            Self::Arguments(error) => write!(err, "{}", error.render().ansi()),
            _ => writeln!(err, "error: {}", self.message()),
        };
    }

    /// The exit code: 1 if the solver failed, the answer can't be printed or threads can't start, 2 for bad usage or input.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Print(_) | Self::Threads { .. } => 1,
            Self::Ended(ended) => ended.exit_code(),
            Self::Said(failure) => failure.exit_code(),
            Self::Unanswered(error) if !error.is_input() => 1,
            _ => 2,
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Unanswered(error) | Self::Value { source: error, .. } | Self::Text { source: error, .. } => {
                error.kind()
            }
            Self::Arguments(_) | Self::Usage { .. } | Self::Row { .. } | Self::Part { .. } => "input",
            Self::Threads { .. } => "threads",
            Self::Ended(_) => "ended",
            Self::Said(failure) => failure.kind(),
            Self::Read { .. } => "read",
            Self::Print(_) | Self::Write { .. } => "write",
            Self::Chart(_) => "chart",
        }
    }

    /// `{"error":{"kind":..,"message":..,..},..}` with further fields that depend on the kind, such as `field` or `time`.
    pub(crate) fn to_json(&self) -> String {
        plain_json(&json!({ "schema": SCHEMA, "error": self.json() }))
    }

    /// What is wrong, as the object `error` of an answer.
    pub(crate) fn json(&self) -> Value {
        let mut error = Map::new();
        error.insert("kind".to_owned(), json!(self.kind()));
        error.insert("message".to_owned(), json!(self.message()));
        if let Value::Object(details) = self.details() {
            error.extend(details);
        }
        error.into()
    }

    fn details(&self) -> Value {
        match self {
            Self::Unanswered(error) | Self::Value { source: error, .. } => details(error),
            Self::Text { path, source } => with(details(source), "path", json!(path)),
            Self::Row { path, line, column, source } => {
                let place = [("path", json!(path)), ("line", json!(line)), ("column", json!(column))];
                place.into_iter().fold(input_details(source), |details, (key, value)| with(details, key, value))
            }
            Self::Part { path, .. } => json!({"path": path}),
            Self::Read { option, path, .. } | Self::Write { option, target: path, .. } => {
                json!({"field": option, "path": path})
            }
            Self::Arguments(error) => argument_details(error),
            Self::Usage { field, .. } => json!({"field": field}),
            Self::Threads { .. } => json!({"field": "threads"}),
            Self::Ended(ended) => json!({"ended": ended.name()}),
            Self::Said(failure) => failure.details(),
            Self::Print(_) | Self::Chart(_) => json!({}),
        }
    }
}

/// What is wrong, with the number from 1 of the launch at fault: people count so, and the library by an index from 0.
fn counted_from_1(error: &Error) -> String {
    error.clone().after(1).to_string()
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

/// An option as it is typed; the files of parts have none.
fn shown(option: &str) -> String {
    if option == "parts" { "PART".to_owned() } else { format!("--{option}") }
}

/// What is valid in place of a file that is not there.
fn folder(error: &std::io::Error) -> &'static str {
    if error.kind() == std::io::ErrorKind::NotFound { "; expected a file in a folder that exists" } else { "" }
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
