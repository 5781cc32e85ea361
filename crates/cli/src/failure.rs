//! Why a command gave no answer, and the exit code that says so.

use chart::ChartError;
use sampling::SpaceFileError;
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
    /// A file that can't be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: String,
        /// Why not.
        source: std::io::Error,
    },
    /// A file that holds no space.
    #[error("{path}, {source}")]
    SpaceFile {
        /// The file.
        path: String,
        /// Where and why.
        source: SpaceFileError,
    },
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
    Chart(#[from] ChartError),
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
            Self::Input(_)
            | Self::Usage(_)
            | Self::Read { .. }
            | Self::SpaceFile { .. }
            | Self::Write { .. }
            | Self::Chart(_) => 2,
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Input(InputError::OutsideModel { .. }) => "outside_model",
            Self::Input(_) | Self::Usage(_) | Self::SpaceFile { .. } => "input",
            Self::Read { .. } => "read",
            Self::Write { .. } => "write",
            Self::Chart(_) => "chart",
            Self::Solve(source) | Self::Launch { source, .. } => source.kind(),
        }
    }

    /// `{"error":{"kind":..,"message":..,..}}` with what else is known of it.
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
            Self::Solve(source) => solve_details(source),
            Self::Launch { index, rate, flight_time, source } => {
                let mut details = solve_details(source);
                details["launch"] = json!({"index": index, "rate": rate, "flight_time": flight_time});
                details
            }
            Self::Input(InputError::OutOfRange { field, value, valid }) => {
                json!({"field": field, "value": value, "valid": valid})
            }
            Self::Input(InputError::Malformed { field, value, .. } | InputError::UnknownName { field, value, .. }) => {
                json!({"field": field, "value": value})
            }
            Self::Input(InputError::Missing { field, .. } | InputError::OutsideModel { field, .. }) => {
                json!({"field": field})
            }
            Self::SpaceFile { path, source } => json!({"path": path, "line": source.line, "column": source.column}),
            Self::Read { path, .. } => json!({"path": path}),
            Self::Usage(_) | Self::Write { .. } | Self::Chart(_) => json!({}),
        }
    }
}

fn solve_details(source: &SolveError) -> Value {
    match source {
        SolveError::PhaseTooLarge { phase } => json!({"phase": phase}),
        SolveError::Singular { point, time } => json!({"point": point.to_string(), "time": time}),
        SolveError::NotOffered { method } => json!({"method": method}),
        SolveError::StepLimit { time, limit } => json!({"time": time, "limit": limit}),
        SolveError::StepSizeUnderflow { time } | SolveError::NotFinite { time } => {
            json!({"time": time})
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

impl From<toss::SceneError> for Failure {
    fn from(error: toss::SceneError) -> Self {
        match error {
            toss::SceneError::Input(error) => error.into(),
            toss::SceneError::Solve(error) => error.into(),
            toss::SceneError::Sample(error) => error.into(),
            not_reached @ toss::SceneError::NotReached { .. } => Self::Usage(not_reached.to_string()),
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
