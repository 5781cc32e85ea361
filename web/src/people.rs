//! What the counts of people's flips say, by the reader and in the words of the command line.

use sampling::{Counted, CountsError, people};
use serde::Serialize;
use toss::Error;

/// The answer.
#[derive(Debug, Serialize)]
pub(crate) struct Answer {
    #[serde(flatten)]
    counted: Counted,
    /// The share of all flips.
    share: f64,
    /// ψ of the mean over people (rad).
    cone_angle: Option<f64>,
}

/// What the table in `text` says.
pub(crate) fn counted(text: &str) -> Result<Answer, Error> {
    let counted = Counted::of(&people(text.as_bytes()).map_err(at_its_place)?)?;
    Ok(Answer { share: counted.found.share, cone_angle: counted.found.cone.map(|cone| cone.angle), counted })
}

fn at_its_place(wrong: CountsError) -> Error {
    let (line, column, message) = match wrong {
        CountsError::Table(error) => (error.line, error.column, error.message),
        CountsError::Cell { line, column, source } => (line, column, source.to_string()),
    };
    Error::Text { line: usize::try_from(line).unwrap_or(usize::MAX), column, message }
}
