//! Distributions of launches.

use ::toss::sampling::{Axis, Coordinate, DescribedSpace, named_space, named_spaces};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::body::body_of;
use crate::errors::{Failure, malformed};
use crate::given::{self, axis, no_others, number, object, text};

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
/// turn, psi : float, tuple or str
///     In place of the rates: the rate in rad/s at which the normal n turns about the angular momentum S, and the angle in
///     rad between n and S.
/// speed : float, tuple or str
///     Upward speed at launch in m/s.
/// gravity : float, tuple or str, optional
///     In m/s²; 9.81 by default.
/// tilt : float, tuple or str, optional
///     Turn about the lab's x axis before the launch in rad; 0 by default.
/// drop : float, tuple or str, optional
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
    #[pyo3(signature = (*, rate_x=None, rate_y=None, rate_z=None, turn=None, psi=None, speed, gravity=None, tilt=None, drop=None, body=None, **others), text_signature = "(*, rate_x=None, rate_y=None, rate_z=None, turn=None, psi=None, speed, gravity=None, tilt=None, drop=None, body=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        rate_x: Option<&Bound<'_, PyAny>>,
        rate_y: Option<&Bound<'_, PyAny>>,
        rate_z: Option<&Bound<'_, PyAny>>,
        turn: Option<&Bound<'_, PyAny>>,
        psi: Option<&Bound<'_, PyAny>>,
        speed: &Bound<'_, PyAny>,
        gravity: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        drop: Option<&Bound<'_, PyAny>>,
        body: Option<&Bound<'_, PyAny>>,
        others: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        no_others::<Self>(speed.py(), others)?;
        let axes = [rate_x, rate_y, rate_z, Some(speed), gravity, tilt, turn, psi, drop];
        let given = Coordinate::ALL.into_iter().zip(axes).filter_map(|(of, given)| Some((of, given?)));
        let texts = given.map(|(of, given)| Ok((of, axis(of.name(), given)?))).collect::<PyResult<Vec<_>>>()?;
        let texts: Vec<(Coordinate, &str)> = texts.iter().map(|(of, text)| (*of, text.as_str())).collect();
        let body = body.map_or(Ok(::toss::Coin::PAPER.into()), |body| Ok::<_, PyErr>(body_of(body)?.get().body))?;
        Ok(Self { space: ::toss::sampling::Space::parse(body, &texts).map_err(Failure::from)? })
    }

    /// A space that comes with the package.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Such as ``"paper-fig4"``; ``spaces()`` lists them.
    #[staticmethod]
    fn named(name: &Bound<'_, PyAny>) -> PyResult<Self> {
        let name = text("name", name, "the name of a space")?;
        Ok(Self { space: named_space(&name).map_err(|error| Failure::from(error).of("name"))? })
    }

    /// A space from a file in TOML, as ``--space FILE.toml`` reads it.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     The text of the file.
    #[staticmethod]
    fn from_toml(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = self::text("text", text, "a space as TOML")?;
        let read = DescribedSpace::from_toml(&text).map_err(|error| Failure::from(error).of("text"));
        Ok(Self { space: read?.space })
    }

    /// The same space, thrown by a hand, as ``--spread`` has it.
    ///
    /// Parameters
    /// ----------
    /// spread : float
    ///     Each rate and the speed that has a single value is normal around it, with the standard deviation ``spread`` times the
    ///     value; from 0 to 0.12.
    fn with_spread(&self, spread: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { space: self.space.thrown_by_hand(number("spread", spread)?).map_err(Failure::from)? })
    }

    /// The same space with another height of landing.
    ///
    /// Parameters
    /// ----------
    /// drop : float, tuple or str
    ///     How far below their launch the coins land, in m.
    fn with_drop(&self, drop: &Bound<'_, PyAny>) -> PyResult<Self> {
        let axis = Axis::parse(Coordinate::Drop, &axis("drop", drop)?).map_err(Failure::from)?;
        Ok(Self { space: self.space.with_axis(Coordinate::Drop, axis).map_err(Failure::from)? })
    }

    /// The same space for another coin or body.
    ///
    /// Parameters
    /// ----------
    /// body : str or Body
    ///     A name of the catalogue, or a body.
    fn with_body(&self, body: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { space: self.space.with_body(body_of(body)?.get().body).map_err(Failure::from)? })
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
    fn from_json(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { space: given::from_json(text, "a space as JSON")? })
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Space.from_json('{}')", self.to_json()?))
    }

    fn __hash__(&self) -> PyResult<u64> {
        Ok(hash_of(&self.to_json()?))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json()?,).into_pyobject(py)?))
    }
}

/// The space that an argument is.
pub(crate) fn space_of(value: &Bound<'_, PyAny>) -> PyResult<::toss::sampling::Space> {
    Ok(object::<Space>("space", value, "a Space")?.get().space)
}

/// A hash of a value by its JSON. Equal values have the same JSON but for the sign of a 0.
pub(crate) fn hash_of(json: &str) -> u64 {
    let unsigned = json.replace("-0.0", "0.0");
    unsigned.bytes().fold(0, |hash: u64, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte)))
}

/// The names of the spaces that come with the package, each with its description.
#[pyfunction]
pub(crate) fn spaces() -> Vec<(&'static str, String)> {
    named_spaces().map(|(name, space)| (name, space.description)).collect()
}
