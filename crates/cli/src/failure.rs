//! The reasons for which a command gives no answer, with their exit codes and their JSON. All of them go through one
//! type, so that every command reports a failure in the same way.

use chart::ChartError;
use serde_json::{Map, Value, json};
use toss::{Error, InputError, SolveError};

/// The reason why a command gives no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Invalid input, or a solver that failed.
    #[error(transparent)]
    Unanswered(#[from] Error),
    /// An option that is missing, invalid or in conflict with another.
    #[error("{0}")]
    Usage(String),
    /// A file that can't be read.
    #[error("cannot read {path}: {source}")]
    Read {
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
    /// A file or standard output that can't be written.
    #[error("cannot write {target}: {source}")]
    Write {
        /// The file, or "standard output".
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
    /// The exit code: 1 if the solver failed, 2 for bad usage or input.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Unanswered(error) if !error.is_input() => 1,
            _ => 2,
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Unanswered(error) | Self::Text { source: error, .. } => error.kind(),
            Self::Usage(_) => "input",
            Self::Read { .. } => "read",
            Self::Write { .. } => "write",
            Self::Chart(_) => "chart",
        }
    }

    /// `{"error":{"kind":..,"message":..,..}}`, with further fields that depend on the kind, such as `field` or `time`.
    pub(crate) fn to_json(&self) -> String {
        let mut error = Map::new();
        error.insert("kind".to_owned(), json!(self.kind()));
        error.insert("message".to_owned(), json!(self.to_string()));
        if let Value::Object(details) = self.details() {
            error.extend(details);
        }
        json!({ "error": error }).to_string()
    }

    fn details(&self) -> Value {
        match self {
            Self::Unanswered(error) => details(error),
            Self::Text { path, source } => with(details(source), "path", json!(path)),
            Self::Read { path, .. } => json!({"path": path}),
            Self::Usage(_) | Self::Write { .. } | Self::Chart(_) => json!({}),
        }
    }
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
        InputError::Malformed { field, value, .. } | InputError::UnknownName { field, value, .. } => {
            json!({"field": field, "value": value})
        }
        other => json!({"field": other.field()}),
    }
}

fn solve_details(source: &SolveError) -> Value {
    match source {
        SolveError::PhaseTooLarge { phase } => json!({"phase": phase}),
        SolveError::Singular { point, time } => json!({"point": point.to_string(), "time": time}),
        SolveError::NotOffered { scheme } => json!({"scheme": scheme}),
        SolveError::StepLimit { time, limit } => json!({"time": time, "limit": limit}),
        SolveError::StepSizeUnderflow { time } | SolveError::NotFinite { time } => json!({"time": time}),
        SolveError::Misbehaved { solver, .. } | SolveError::Failed { solver, .. } => json!({"solver": solver}),
        _ => json!({}),
    }
}

/// `details` with one more key.
fn with(mut details: Value, key: &str, value: Value) -> Value {
    details[key] = value;
    details
}
