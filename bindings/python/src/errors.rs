//! Errors of the workspace as exceptions of Python: one class for each kind, all of them in `unfair_toss.errors`.

use ::toss::{Error, InputError, SolveError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An error, with the index of the launch that it is about.
pub(crate) struct Failure {
    pub(crate) error: Error,
    /// Counted from 0; `None` for what is no launch of many.
    pub(crate) index: Option<u64>,
    /// The argument that is at fault, where that is not called as the field of the error.
    argument: Option<&'static str>,
}

/// What an exception says beside its message.
#[derive(Default)]
struct Details {
    field: Option<&'static str>,
    valid: Option<String>,
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self { error: error.into(), index: None, argument: None }
    }
}

impl Failure {
    /// The same failure, of the launch with this index.
    pub(crate) fn at(self, index: u64) -> Self {
        Self { index: Some(index), ..self }
    }

    /// The same failure, of the launch that `place` puts in place of the one that it is of.
    pub(crate) fn moved(mut self, place: impl Fn(u64) -> u64) -> Self {
        match &mut self.error {
            Error::Launch { index, .. } | Error::BadLaunch { index, .. } => *index = place(*index),
            _ => self.index = self.index.map(place),
        }
        self
    }

    /// The same failure, of element `index` of the argument that is at fault.
    pub(crate) fn element(self, index: u64) -> Self {
        Self { index: Some(index), argument: self.argument.or(self.error.field().map(argument)), ..self }
    }

    /// The same failure, of what the argument called `argument` gave.
    pub(crate) fn of(self, argument: &'static str) -> Self {
        Self { argument: Some(argument), ..self }
    }

    /// The index of the launch, also where the error itself has it.
    pub(crate) fn launch(&self) -> Option<u64> {
        match &self.error {
            Error::Launch { index, .. } | Error::BadLaunch { index, .. } => Some(*index),
            _ => self.index,
        }
    }

    /// What the error says, with the argument in place of the field that it begins with.
    fn text(&self) -> String {
        let (text, field) = (self.error.to_string(), self.error.field().unwrap_or_default());
        let text = match text.strip_prefix(field) {
            Some(rest) => format!("{}{rest}", argument(field)),
            None => text,
        };
        match &self.error {
            Error::Input(InputError::OutOfRange { value, valid, .. }) => text.replace(valid, &in_python(valid, *value)),
            _ => text,
        }
    }

    fn message(&self) -> String {
        match (self.index, &self.error) {
            (_, Error::Launch { .. } | Error::BadLaunch { .. }) | (None, _) => self.text(),
            (Some(index), _) => match self.argument {
                Some(argument) => format!("{argument}[{index}]: {}", self.text()),
                None => format!("launch {index}: {}", self.text()),
            },
        }
    }

    fn exception(&self, py: Python<'_>) -> PyResult<PyErr> {
        let (class, Details { field, valid }) = class_of(&self.error);
        let field = self.argument.or(field.map(argument));
        let mut message = self.message();
        if let Error::Input(InputError::UnknownName { value, known, .. }) = &self.error {
            let known: Vec<_> = known.split(", ").collect();
            message += &py.import("unfair_toss.given")?.call_method1("close", (value, known))?.extract::<String>()?;
        }
        made(py, class, &message, field, self.launch(), valid.as_deref())
    }
}

/// What is valid, with Python's way to give the number that was refused in degrees.
fn in_python(valid: &str, refused: f64) -> String {
    const DEGREES: &str = "degrees have their unit, as in 15deg";
    valid.replace(DEGREES, &format!("{refused} degrees are np.radians({refused}) or '{refused}deg'"))
}

/// The exception of a class of `unfair_toss.errors`.
fn made(
    py: Python<'_>,
    class: &str,
    message: &str,
    field: Option<&str>,
    index: Option<u64>,
    valid: Option<&str>,
) -> PyResult<PyErr> {
    let kwargs = PyDict::new(py);
    kwargs.set_item("field", field)?;
    kwargs.set_item("index", index)?;
    kwargs.set_item("valid", valid)?;
    let class = py.import("unfair_toss.errors")?.getattr(class)?;
    Ok(PyErr::from_value(class.call((message,), Some(&kwargs))?))
}

/// The exception of a failure, or what kept it from being made.
impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| failure.exception(py).unwrap_or_else(|error| error))
    }
}

/// The exception of a value that is not what the argument `field` takes, for element `index` if it takes several.
pub(crate) fn refused(py: Python<'_>, message: &str, field: &str, index: Option<usize>, valid: &str) -> PyErr {
    let index = index.map(|index| index as u64);
    made(py, "MalformedError", message, Some(field), index, Some(valid)).unwrap_or_else(|error| error)
}

/// The argument of Python that a field is given by, with its unit.
fn argument(field: &'static str) -> &'static str {
    match field {
        "rate x [rad/s]" => "rate_x [rad/s]",
        "rate y [rad/s]" => "rate_y [rad/s]",
        "rate z [rad/s]" => "rate_z [rad/s]",
        "coin" => "body",
        "same" => "same_side",
        "tolerance" => "rtol",
        "scheme of this solver" => "scheme",
        field => field,
    }
}

/// The exception of an input that only the bindings refuse.
pub(crate) fn malformed(field: &'static str, value: impl ToString, expected: &'static str) -> PyErr {
    Failure::from(InputError::Malformed { field, value: value.to_string(), expected }).into()
}

/// The name of the class of an error, and the details of the exception.
fn class_of(error: &Error) -> (&'static str, Details) {
    match error {
        Error::Input(input) | Error::BadLaunch { source: input, .. } => class_of_input(input),
        Error::Solve(solve) | Error::Launch { source: solve, .. } => (class_of_solve(solve), Details::default()),
        Error::Text { .. } => ("TextError", Details::default()),
        Error::NotReached { .. } => ("NotReachedError", Details { field: Some("accuracy"), valid: None }),
        _ => ("TossError", Details { field: error.field(), valid: None }),
    }
}

fn class_of_input(error: &InputError) -> (&'static str, Details) {
    let (class, valid) = match error {
        InputError::OutOfRange { valid, value, .. } => ("OutOfRangeError", Some(in_python(valid, *value))),
        InputError::Malformed { expected, .. } | InputError::LookAlike { expected, .. } => {
            ("MalformedError", Some((*expected).to_owned()))
        }
        InputError::Missing { expected, .. } => ("MissingError", Some((*expected).to_owned())),
        InputError::OutsideModel { .. } => ("OutsideModelError", None),
        InputError::NoBody { limit, .. } => ("NoBodyError", Some(format!("at most {limit}"))),
        InputError::NoEffect { .. } => ("MalformedError", Some("None, or another solver".to_owned())),
        InputError::UnknownName { known, .. } => ("UnknownNameError", Some(known.clone())),
        _ => ("InputError", None),
    };
    (class, Details { field: Some(error.field()), valid })
}

fn class_of_solve(error: &SolveError) -> &'static str {
    match error {
        SolveError::PhaseTooLarge { .. } => "PhaseTooLargeError",
        SolveError::Singular { .. } => "SingularError",
        SolveError::NotOffered { .. } => "NotOfferedError",
        SolveError::NotSymmetric { .. } => "NotSymmetricError",
        SolveError::StepLimit { .. } => "StepLimitError",
        SolveError::StepSizeUnderflow { .. } => "StepSizeUnderflowError",
        SolveError::NotFinite { .. } => "NotFiniteError",
        SolveError::Misbehaved { .. } => "MisbehavedError",
        SolveError::Failed { .. } => "FailedError",
        _ => "SolveError",
    }
}
