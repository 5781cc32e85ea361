//! [`Error`], the one error type of functions that both take input and solve flights. Callers of this workspace handle
//! it alone, by its kind, its field and its source.

use crate::error::{InputError, SolveError};
use crate::toss::Toss;

/// The reason why a question has no answer: either its input is at fault, or the solver failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The input describes no toss. It was refused before anything was computed.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The solver failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The solver failed on one of many launches; this is the first one on which it failed.
    #[error("launch {index} (rate {:?}, {:?}, {:?} rad/s, {:?} s): {source}",
        toss.launch.rate().x, toss.launch.rate().y, toss.launch.rate().z, toss.launch.flight_time())]
    Launch {
        /// The index of the launch, from 0.
        index: u64,
        /// The toss.
        toss: Box<Toss>,
        /// Why the solver failed.
        source: SolveError,
    },
    /// One of many launches is invalid; this is the first such one.
    #[error("launch {index}: {source}")]
    BadLaunch {
        /// The index of the launch, from 0.
        index: u64,
        /// What is wrong with it.
        source: InputError,
    },
    /// A text, such as a file, that can't be read.
    #[error("line {line}, column {column}: {message}")]
    Text {
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong there, with the name of the field if there is one.
        message: String,
    },
    /// The largest allowed number of launches did not reach the wanted accuracy.
    #[error("after {launches} launches the probability is known to {reached:.1e}, not to {accuracy:e}")]
    NotReached {
        /// The number of launches solved.
        launches: u64,
        /// Half the width of the interval.
        reached: f64,
        /// The accuracy that was wanted.
        accuracy: f64,
    },
    /// It was time to end before there was an answer.
    #[error("ended before there was an answer")]
    Ended,
}

impl Error {
    /// The error of the solver on launch number `index` of many.
    pub fn of_launch(index: usize, toss: &Toss, source: SolveError) -> Self {
        Self::Launch { index: index as u64, toss: Box::new(*toss), source }
    }

    /// An error at the byte `offset` of `text`, or at the end of its last line: there is missed what is missing. A line
    /// ends by a line feed, a carriage return or both, as an editor shows it.
    pub fn in_text(text: &str, offset: Option<usize>, message: String) -> Self {
        let before = offset.and_then(|offset| text.get(..offset)).unwrap_or(text.trim_end());
        let is_within_an_end = text[before.len()..].starts_with('\n');
        let before = before.strip_suffix('\r').filter(|_| is_within_an_end).unwrap_or(before).replace("\r\n", "\n");
        let (line, last) = (1..).zip(before.split(['\n', '\r'])).last().unwrap_or((1, ""));
        Self::Text { line, column: last.chars().count() + 1, message }
    }

    /// What a reader of JSON says of `text`, with a place whose column is one of bytes. Its words are [those of people](crate::data::in_words).
    #[cfg(feature = "serde")]
    pub fn in_json(text: &str, (line, column): (usize, usize), message: &str) -> Self {
        let message = message.trim_end_matches(&format!(" at line {line} column {column}"));
        let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        // It may be the column of the second byte of a letter.
        let at = (before + column.saturating_sub(1)).min(text.len());
        let at = (0..=at).rev().find(|at| text.is_char_boundary(*at));
        Self::in_text(text, at, crate::data::in_words(message))
    }

    /// A short name of the kind of error, for machine-readable output.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Input(InputError::OutsideModel { .. }) => "outside_model",
            Self::Input(_) | Self::BadLaunch { .. } | Self::Text { .. } | Self::NotReached { .. } => "input",
            Self::Solve(source) | Self::Launch { source, .. } => source.kind(),
            Self::Ended => "ended",
        }
    }

    /// The input field that is at fault, if one is.
    pub fn field(&self) -> Option<&'static str> {
        match self {
            Self::Input(source) | Self::BadLaunch { source, .. } => Some(source.field()),
            Self::NotReached { .. } => Some("accuracy"),
            Self::Solve(_) | Self::Launch { .. } | Self::Text { .. } | Self::Ended => None,
        }
    }

    /// Whether the input is at fault, and not the solver.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Solve(_) | Self::Launch { .. } | Self::Ended)
    }

    /// The same error, with its index counted from the start of a longer sequence in which this one begins at `first`.
    #[must_use]
    pub fn after(mut self, first: u64) -> Self {
        if let Self::Launch { index, .. } | Self::BadLaunch { index, .. } = &mut self {
            *index += first;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use std::fmt;

    use super::*;

    #[test]
    fn places_in_a_text_are_those_that_an_editor_shows() {
        for end in ["\n", "\r\n", "\r"] {
            for (text, at, line, column) in [
                ("ab|cd", Some("c"), 2, 1),
                ("ab||é d|", Some("d"), 3, 3),
                ("ab|cd", Some("|"), 1, 3),
                ("ab|cd||", None, 2, 3),
                ("", None, 1, 1),
            ] {
                let [text, at] = [Some(text), at].map(|text| text.map(|text| text.replace('|', end)));
                let text = text.unwrap();
                let offset = at.map(|at| text.find(&at).unwrap() + usize::from(at == "\r\n"));
                let Error::Text { line: of, column: in_it, .. } = Error::in_text(&text, offset, String::new()) else {
                    panic!("{text:?}")
                };
                assert_eq!((of, in_it), (line, column), "{text:?}");
            }
        }
    }

    #[test]
    fn the_error_of_downstream_code_has_a_kind_a_field_and_a_source() {
        use std::error::Error as _;
        let input = InputError::OutOfRange { field: "speed [m/s]", value: -1.0, valid: ">= 0" };
        let bad = Error::BadLaunch { index: 3, source: input.clone() };
        assert_eq!((bad.kind(), bad.field(), bad.is_input()), ("input", Some("speed [m/s]"), true));
        assert_eq!(bad.source().map(ToString::to_string), Some(input.to_string()));
        assert_eq!(bad.after(4), Error::BadLaunch { index: 7, source: input });
        let solve = Error::from(SolveError::failed("own", fmt::Error));
        assert_eq!((solve.kind(), solve.field(), solve.is_input()), ("failed", None, false));
        assert_eq!(solve.clone().after(4), solve);
    }
}
