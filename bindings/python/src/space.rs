//! Distributions of launches.

use ::toss::sampling::{Coordinate, named_space, named_spaces};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::body::body_of;
use crate::errors::{Failure, malformed};

/// A distribution of the launches of one coin: each coordinate is independent of the others, or tied to one.
///
/// A coordinate is a number (a fixed value), a tuple (lo, hi) for a uniform distribution or (lo, hi, points) with a
/// grid, or a text as on the command line: ``"normal:20:2"``, ``"3:5:500"``, ``"38rev/s"``, and for a rate that
/// equals another one the letter ``"x"``, ``"y"`` or ``"z"`` of that.
///
/// Parameters
/// ----------
/// rate_x, rate_y, rate_z : float, tuple or str
///     Angular velocity at launch in rad/s, along the axes of the body.
/// speed : float, tuple or str
///     Upward speed at launch in m/s.
/// gravity : float, tuple or str, optional
///     In m/s²; 9.81 by default.
/// tilt : float, tuple or str, optional
///     Turn about the lab's x axis before the launch in rad; 0 by default.
/// drop : float, optional
///     How far below their launch the coins land, in m; at the same height by default.
/// body : str or Body
///     A name of the catalogue, or a body; the paper's coin by default.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Space {
    pub(crate) space: ::toss::sampling::Space,
}

#[pymethods]
impl Space {
    #[new]
    #[pyo3(signature = (*, rate_x, rate_y, rate_z, speed, gravity=None, tilt=None, drop=None, body=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        rate_x: &Bound<'_, PyAny>,
        rate_y: &Bound<'_, PyAny>,
        rate_z: &Bound<'_, PyAny>,
        speed: &Bound<'_, PyAny>,
        gravity: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        drop: Option<f64>,
        body: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let axes = [Some(rate_x), Some(rate_y), Some(rate_z), Some(speed), gravity, tilt];
        let given = Coordinate::ALL.into_iter().zip(axes).filter_map(|(of, axis)| Some((of, axis?)));
        let texts = given.map(|(of, axis)| Ok((of, text_of(of, axis)?))).collect::<PyResult<Vec<_>>>()?;
        let texts: Vec<(Coordinate, &str)> = texts.iter().map(|(of, text)| (*of, text.as_str())).collect();
        let body = body.map_or(Ok(::toss::Coin::PAPER.into()), |body| Ok::<_, PyErr>(body_of(body)?.get().body))?;
        let space = ::toss::sampling::Space::parse(body, &texts).and_then(|space| space.with_drop(drop));
        Ok(Self { space: space.map_err(Failure::from)? })
    }

    /// A space that comes with the package.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Such as ``"paper-fig4"``; ``spaces()`` lists them.
    #[staticmethod]
    fn named(name: &str) -> PyResult<Self> {
        Ok(Self { space: named_space(name).map_err(Failure::from)? })
    }

    /// The same space for another coin or body.
    ///
    /// Parameters
    /// ----------
    /// body : str or Body
    ///     A name of the catalogue, or a body.
    fn with_body(&self, body: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { space: self.space.with_body(body_of(body)?.get().body) })
    }

    /// The space as JSON, as the parts of an estimate have it.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.space).map_err(|error| malformed("space", error, "a space"))
    }

    /// Reads a space from JSON.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     As ``to_json`` writes it.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let read = serde_json::from_str(text);
        Ok(Self { space: read.map_err(|error| malformed("space", error, "a space as JSON"))? })
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Space.from_json('{}')", self.to_json()?))
    }

    fn __hash__(&self) -> PyResult<u64> {
        Ok(self.to_json()?.bytes().fold(0, |hash: u64, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte))))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json()?,).into_pyobject(py)?))
    }
}

/// The text that the library reads an axis from. Numbers are written so that they are read back to the bit.
fn text_of(of: Coordinate, axis: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(text) = axis.extract::<String>() {
        return Ok(text);
    }
    if let Ok(value) = axis.extract::<f64>() {
        return Ok(value.to_string());
    }
    if let Ok((lo, hi)) = axis.extract::<(f64, f64)>() {
        return Ok(format!("{lo}:{hi}"));
    }
    if let Ok((lo, hi, points)) = axis.extract::<(f64, f64, u64)>() {
        return Ok(format!("{lo}:{hi}:{points}"));
    }
    Err(malformed(of.field(), axis.repr()?, "a number, (lo, hi), (lo, hi, points) or a text"))
}

/// The names of the spaces that come with the package, each with its description.
#[pyfunction]
pub(crate) fn spaces() -> Vec<(&'static str, String)> {
    named_spaces().map(|(name, space)| (name, space.description)).collect()
}
