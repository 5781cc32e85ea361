//! Why a command gave no answer, and the exit code that says so.

use serde_json::{Map, Value, json};
use toss::{InputError, SolveError};

/// Why a command gave no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Input outside its valid range, or a name that is unknown.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Options that do not go together.
    #[error("{0}")]
    Usage(String),
    /// A file or standard output that can't be written.
    #[error("cannot write {target}: {source}")]
    Write {
        /// What was to be written.
        target: String,
        /// Why it could not.
        source: std::io::Error,
    },
    /// A chart that can't be drawn.
    #[error("cannot draw the chart: {0}")]
    Chart(String),
    /// The solver failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The solver failed on one launch of a space.
    #[error("launch {index}: {source}")]
    Launch {
        /// Its index.
        index: u64,
        /// Its body rate (rad/s).
        rate: [f64; 3],
        /// Its time of flight (s).
        flight_time: f64,
        /// What the solver said.
        source: SolveError,
    },
}

impl Failure {
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Solve(_) | Self::Launch { .. } => 1,
            Self::Input(_) | Self::Usage(_) | Self::Write { .. } | Self::Chart(_) => 2,
        }
    }

    /// `{"error":{"kind":..,"message":..,..}}` with what else is known of it.
    pub(crate) fn to_json(&self) -> String {
        let mut error = Map::new();
        let kind = match self {
            Self::Input(_) | Self::Usage(_) => "input",
            Self::Write { .. } => "write",
            Self::Chart(_) => "chart",
            Self::Solve(source) | Self::Launch { source, .. } => source.kind(),
        };
        error.insert("kind".to_owned(), json!(kind));
        error.insert("message".to_owned(), json!(self.to_string()));
        match self {
            Self::Solve(source) | Self::Launch { source, .. } => insert_details(&mut error, source),
            Self::Input(InputError::OutOfRange { field, value, valid }) => {
                error.insert("field".to_owned(), json!(field));
                error.insert("value".to_owned(), json!(value));
                error.insert("valid".to_owned(), json!(valid));
            }
            Self::Input(InputError::Malformed { field, value, .. } | InputError::UnknownName { field, value, .. }) => {
                error.insert("field".to_owned(), json!(field));
                error.insert("value".to_owned(), json!(value));
            }
            Self::Usage(_) | Self::Write { .. } | Self::Chart(_) => {}
        }
        if let Self::Launch { index, rate, flight_time, .. } = self {
            error.insert("launch".to_owned(), json!({"index": index, "rate": rate, "flight_time": flight_time}));
        }
        Value::Object(Map::from_iter([("error".to_owned(), Value::Object(error))])).to_string()
    }
}

fn insert_details(error: &mut Map<String, Value>, source: &SolveError) {
    let mut insert = |key: &str, value: Value| _ = error.insert(key.to_owned(), value);
    match source {
        SolveError::PhaseTooLarge { phase } => insert("phase", json!(phase)),
        SolveError::Singular { point, time } => {
            insert("point", json!(point.to_string()));
            insert("time", json!(time));
        }
        SolveError::StepLimit { time, limit } => {
            insert("time", json!(time));
            insert("limit", json!(limit));
        }
        SolveError::StepSizeUnderflow { time } | SolveError::Stiff { time } | SolveError::NotFinite { time } => {
            insert("time", json!(time));
        }
    }
}

impl From<toss::trace::TraceError> for Failure {
    fn from(error: toss::trace::TraceError) -> Self {
        match error {
            toss::trace::TraceError::Input(error) => error.into(),
            toss::trace::TraceError::Solve(error) => error.into(),
        }
    }
}

impl From<sampling::SampleError> for Failure {
    fn from(error: sampling::SampleError) -> Self {
        match error {
            sampling::SampleError::Input(error) => error.into(),
            sampling::SampleError::Solve { index, toss, source } => {
                Self::Launch { index, rate: toss.launch.rate().into(), flight_time: toss.launch.flight_time(), source }
            }
        }
    }
}
