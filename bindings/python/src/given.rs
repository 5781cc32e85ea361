//! Values as Python gives them: quantities, counts, texts, objects of our classes, and short vectors of numbers. A vector is
//! read by position, never by label. What is no such value is refused with the name of the argument, and with the position
//! in a vector: nothing is converted whose meaning would change by it, such as a mask, a truth value, a complex number or a
//! span of time.
//!
//! A quantity is a number in SI units, a text with a unit, or a value of a package that has units, which
//! `unfair_toss.units` converts.

use ::toss::Error;
use dynamics::Unit;
use dynamics::quantity::{Dimension, Given};
use dynamics::thrown::{Field, Holds};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::PyTypeInfo;
use pyo3::prelude::*;
use pyo3::pyclass::PyClass;
use pyo3::types::{
    PyBool, PyByteArray, PyBytes, PyComplex, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple,
};
use serde::de::DeserializeOwned;

use crate::errors::{Failure, refused};

/// What is said to be valid where a number is wanted.
const A_NUMBER: &str = "a real number";

/// The same of a count.
const A_COUNT: &str = "a whole number from 0 to 2^64 - 1";

/// The most characters of a value in a message.
const SHOWN: usize = 40;

/// What the argument `field` measures.
fn dimension(field: &str) -> Dimension {
    match field.split(" [").next().unwrap_or_default() {
        // Those that are no fields of a toss by themselves.
        "t" | "t_eval" | "dt" | "step" => Dimension::Time,
        "slowest" => Dimension::Speed,
        "mass" => Dimension::Mass,
        "radius" | "thickness" => Dimension::Length,
        "tensor" => Dimension::Inertia,
        name => match Field::named(name).map(|field| field.info().holds) {
            Ok(Holds::One(kind) | Holds::Several(kind) | Holds::List(&[kind, ..])) => kind,
            _ => Dimension::Number,
        },
    }
}

/// A value that an argument holds, by the name of the argument and its position if it is one of several.
#[derive(Clone, Copy)]
struct Place<'a> {
    field: &'a str,
    index: Option<usize>,
}

impl Place<'_> {
    fn refused(self, value: &Bound<'_, PyAny>, expected: &str) -> PyErr {
        let at = self.index.map_or_else(String::new, |index| format!("[{index}]"));
        let message = format!("{}{at} = {} can't be used: expected {expected}", self.field, shown(value));
        refused(value.py(), &message, self.field, self.index, expected)
    }

    /// The number in SI units.
    fn number(self, value: &Bound<'_, PyAny>) -> PyResult<f64> {
        if let Ok(number) = value.cast_exact::<PyFloat>() {
            return Ok(number.value());
        }
        let plain = without_unit(self.field, value, self.index)?;
        let number = if is_real(&plain) { plain.extract().ok() } else { None };
        number.ok_or_else(|| self.refused(value, A_NUMBER))
    }

    /// The number in the unit of its text; any other value is one in SI units.
    fn quantity(self, value: &Bound<'_, PyAny>) -> PyResult<Given> {
        let kind = dimension(self.field);
        let Ok(text) = value.cast::<PyString>() else { return Ok(kind.in_si(self.number(value)?)) };
        let text = text.to_cow().unwrap_or_default();
        // A text without a unit is more likely one that was never converted to a number.
        let given = if text.trim().parse::<f64>().is_ok() { None } else { kind.given("", &text).ok() };
        let expected = if kind == Dimension::Number { A_NUMBER.to_owned() } else { in_a_text(kind) };
        given.filter(|_| kind != Dimension::Number).ok_or_else(|| self.refused(value, &expected))
    }

    fn count(self, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<u64> {
        let plain = without_unit(self.field, value, self.index)?;
        let count = if is_real(&plain) && !plain.is_instance_of::<PyFloat>() { plain.extract().ok() } else { None };
        count.ok_or_else(|| self.refused(value, expected))
    }
}

/// What is expected of a quantity, as a number or a text.
fn in_a_text(kind: Dimension) -> String {
    let units: Vec<_> = kind.units().iter().map(|unit| format!("'3{}'", unit.name())).collect();
    format!("a real number, or a text such as {}", units.join(", "))
}

/// A value without its unit, in SI units if it has one.
fn without_unit<'py>(field: &str, value: &Bound<'py, PyAny>, index: Option<usize>) -> PyResult<Bound<'py, PyAny>> {
    if value.is_instance_of::<PyInt>() || value.is_instance_of::<PyString>() {
        return Ok(value.clone());
    }
    value.py().import("unfair_toss.units")?.call_method1("plain", (field, value, index))
}

/// The SI unit of an argument, as packages with units read it, and what is expected of it in words.
#[pyfunction]
pub(crate) fn unit_of(field: &str) -> (&'static str, &'static str) {
    let kind = dimension(field);
    let unit = match kind {
        Dimension::Acceleration => "m/s**2",
        Dimension::Inertia => "kg*m**2",
        _ => kind.units()[0].name(),
    };
    (unit, kind.expected())
}

/// Numbers in a unit that has a name here, in the SI unit of an argument; `None` for another unit.
#[pyfunction]
pub(crate) fn in_si<'py>(
    py: Python<'py>,
    field: &str,
    unit: &str,
    numbers: PyReadonlyArray1<'py, f64>,
) -> Option<Bound<'py, PyArray1<f64>>> {
    let kind = dimension(field);
    let unit = kind.given("", &format!("1{unit}")).ok().filter(|given| given.value() == 1.0)?.unit();
    let numbers = numbers.as_array();
    Some(PyArray1::from_iter(py, numbers.iter().map(|number| unit.to_si(*number))))
}

/// The quantity that an argument is.
pub(crate) fn quantity(field: &str, value: &Bound<'_, PyAny>) -> PyResult<Given> {
    Place { field, index: None }.quantity(value)
}

/// The real number in SI units that an argument is.
#[pyfunction]
pub(crate) fn number(field: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    quantity(field, value).map(Given::si)
}

/// The real number that an argument is, if it was given.
pub(crate) fn optional_number(field: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<f64>> {
    value.map(|value| number(field, value)).transpose()
}

/// The whole number, 0 or above, that an argument is.
#[pyfunction]
pub(crate) fn count(field: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    Place { field, index: None }.count(value, A_COUNT)
}

/// The whole numbers of a sequence, by position, or a single one.
pub(crate) fn counts(field: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<u64>> {
    let Some(elements) = elements(field, value)? else { return Ok(vec![count(field, value)?]) };
    let count =
        |(index, element): (usize, &Bound<'_, PyAny>)| Place { field, index: Some(index) }.count(element, A_COUNT);
    elements.iter().enumerate().map(count).collect()
}

/// The text that an argument is.
pub(crate) fn text(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<String> {
    value.extract().map_err(|_| refused_value(field, value, expected))
}

/// What a text of JSON describes. It may begin with the mark of UTF-8 that some editors put before a text.
pub(crate) fn from_json<T: DeserializeOwned>(value: &Bound<'_, PyAny>, expected: &str) -> PyResult<T> {
    let text = text("text", value, expected)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let read = serde_json::from_str(text);
    let wrong = |error: serde_json::Error| Error::in_json(text, (error.line(), error.column()), &error.to_string());
    Ok(read.map_err(|error| Failure::from(wrong(error)).of("text"))?)
}

/// The object of one of our classes that an argument is.
pub(crate) fn object<'a, 'py, T: PyClass>(
    field: &str,
    value: &'a Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<&'a Bound<'py, T>> {
    value.cast::<T>().map_err(|_| refused_value(field, value, expected))
}

/// The exception of a value that `field` can't have.
pub(crate) fn refused_value(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyErr {
    Place { field, index: None }.refused(value, expected)
}

/// The `N` numbers of a sequence, by position.
pub(crate) fn vector<const N: usize>(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<[f64; N]> {
    let numbers = numbers(field, value, expected)?;
    numbers.try_into().map_err(|_| refused_value(field, value, expected))
}

/// The numbers of a sequence, by position.
pub(crate) fn numbers(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<Vec<f64>> {
    let number = |(index, element): (usize, &Bound<'_, PyAny>)| Place { field, index: Some(index) }.number(element);
    several(field, value, expected)?.iter().enumerate().map(number).collect()
}

/// The quantities of a sequence, by position.
pub(crate) fn quantities(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<Vec<Given>> {
    let given = |(index, element): (usize, &Bound<'_, PyAny>)| Place { field, index: Some(index) }.quantity(element);
    several(field, value, expected)?.iter().enumerate().map(given).collect()
}

/// A quantity as it is written in Python: a number in SI units, or a text with its unit.
pub(crate) fn written<'py>(py: Python<'py>, given: Given) -> PyResult<Bound<'py, PyAny>> {
    if given.unit().size() == Unit::ONE {
        return Ok(given.value().into_pyobject(py)?.into_any());
    }
    Ok(given.to_string().into_pyobject(py)?.into_any())
}

/// The elements of what has to be a sequence.
fn several<'py>(field: &str, value: &Bound<'py, PyAny>, expected: &str) -> PyResult<Vec<Bound<'py, PyAny>>> {
    elements(field, value)?.ok_or_else(|| refused_value(field, value, expected))
}

/// The three rows of three numbers of a matrix, by position. An element that is no number is counted through all rows.
pub(crate) fn matrix(field: &str, value: &Bound<'_, PyAny>, expected: &str) -> PyResult<[[f64; 3]; 3]> {
    let malformed = || refused_value(field, value, expected);
    let mut matrix = [[0.0; 3]; 3];
    let rows = elements(field, value)?.filter(|rows| rows.len() == 3).ok_or_else(malformed)?;
    for (row, numbers) in rows.iter().enumerate() {
        let numbers = elements(field, numbers)?.filter(|numbers| numbers.len() == 3).ok_or_else(malformed)?;
        for (column, number) in numbers.iter().enumerate() {
            matrix[row][column] = Place { field, index: Some(3 * row + column) }.number(number)?;
        }
    }
    Ok(matrix)
}

/// The text from which an axis is read that is a text, a number, or a tuple of numbers: (lo, hi) or (lo, hi, points).
pub(crate) fn axis(field: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    const FORMS: &str = "a number, (lo, hi), (lo, hi, points) or a text";
    if let Ok(text) = value.extract() {
        return Ok(text);
    }
    let at = |index| Place { field, index: Some(index) };
    let plain = without_unit(field, value, None)?;
    let value = &plain;
    match elements(field, value)?.as_deref() {
        // Numbers are written so that they are read back to the bit.
        Some([lo, hi]) => Ok(format!("{}:{}", at(0).number(lo)?, at(1).number(hi)?)),
        Some([lo, hi, points]) => {
            let points = at(2).count(points, "a whole number of points")?;
            Ok(format!("{}:{}:{points}", at(0).number(lo)?, at(1).number(hi)?))
        }
        None if is_real(value) => {
            value.extract::<f64>().map(|value| value.to_string()).map_err(|_| refused_value(field, value, FORMS))
        }
        _ => Err(refused_value(field, value, FORMS)),
    }
}

/// The numbers of a sequence of any length, or a single one, as an array, for the Python layer.
#[pyfunction(name = "numbers")]
pub(crate) fn array_of_numbers<'py>(
    py: Python<'py>,
    field: &str,
    values: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let found = match elements(field, values)? {
        Some(_) => numbers(field, values, "real numbers")?,
        None => vec![number(field, values)?],
    };
    Ok(PyArray1::from_vec(py, found))
}

/// Refuses keywords that the class does not have, with a similar one that it has.
pub(crate) fn no_others<T: PyTypeInfo>(py: Python<'_>, others: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
    let Some((name, _)) = others.and_then(|others| others.iter().next()) else { return Ok(()) };
    let error = py.import("unfair_toss.given")?.call_method1("unexpected", (py.get_type::<T>(), name))?;
    Err(PyErr::from_value(error))
}

/// Whether a value is one real number, so far as its type tells.
fn is_real(value: &Bound<'_, PyAny>) -> bool {
    if value.is_instance_of::<PyBool>() || value.is_instance_of::<PyComplex>() {
        return false;
    }
    if value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>() {
        return true;
    }
    // A scalar of NumPy, or an array without dimensions, says what it is; 'i', 'u' and 'f' are real.
    let kind = value.getattr("dtype").and_then(|dtype| dtype.getattr("kind")).and_then(|kind| kind.extract::<char>());
    let is_masked = || value.getattr("mask").is_ok_and(|mask| mask.is_truthy().unwrap_or(true));
    // What has a length is a text or holds several values, even if it could be converted.
    kind.map_or(true, |kind| matches!(kind, 'i' | 'u' | 'f')) && value.len().is_err() && !is_masked()
}

/// The elements of a sequence by their positions, in SI units if it has a unit; `None` of what has no order, of texts, and of
/// single values.
fn elements<'py>(field: &str, value: &Bound<'py, PyAny>) -> PyResult<Option<Vec<Bound<'py, PyAny>>>> {
    if let Ok(tuple) = value.cast::<PyTuple>() {
        return Ok(Some(tuple.iter().collect()));
    }
    if let Ok(list) = value.cast::<PyList>() {
        return Ok(Some(list.iter().collect()));
    }
    Ok(elements_in_order(&without_unit(field, value, None)?))
}

/// The same of what is neither a list nor a tuple.
fn elements_in_order<'py>(value: &Bound<'py, PyAny>) -> Option<Vec<Bound<'py, PyAny>>> {
    // Those of pandas are known by labels as well.
    let values = value.call_method0("to_numpy").unwrap_or_else(|_| value.clone());
    let is_text = values.is_instance_of::<PyString>()
        || values.is_instance_of::<PyBytes>()
        || values.is_instance_of::<PyByteArray>();
    let sets = value.py().import("collections.abc").and_then(|module| module.getattr("Set"));
    let has_no_order =
        values.cast::<PyMapping>().is_ok() || sets.and_then(|sets| values.is_instance(&sets)).unwrap_or(true);
    if is_text || has_no_order || values.len().is_err() {
        return None;
    }
    values.try_iter().ok()?.collect::<PyResult<_>>().ok()
}

/// A value in a message: its type, and what it is unless that is long or holds other values.
fn shown(value: &Bound<'_, PyAny>) -> String {
    let class = value.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string());
    if value.is_none() {
        return class;
    }
    let is_text = value.is_instance_of::<PyString>() || value.is_instance_of::<PyBytes>();
    match value.len() {
        Ok(length) if !is_text => format!("{class} of {length}"),
        // An integer of very many digits has no text.
        _ => match value.repr() {
            Ok(text) if text.len().is_ok_and(|length| length <= SHOWN) => text.to_string(),
            _ => class,
        },
    }
}
