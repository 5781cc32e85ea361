//! How launches of a space are chosen.

use ::toss::InputError;
use ::toss::sampling::plan::SCRAMBLES;
use ::toss::sampling::{Rest, Scrambled};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::{Failure, malformed};
use crate::space::Space;

/// Which launches of a space are tried. Make one by ``grid``, ``random``, ``sobol``, ``exact_speed`` or
/// ``quadrature``.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Plan {
    pub(crate) plan: ::toss::sampling::Plan,
}

impl From<::toss::sampling::Plan> for Plan {
    fn from(plan: ::toss::sampling::Plan) -> Self {
        Self { plan }
    }
}

#[pymethods]
impl Plan {
    /// All launches of the grid of a space.
    #[staticmethod]
    fn grid() -> Self {
        ::toss::sampling::Plan::Grid.into()
    }

    /// Independent random launches.
    ///
    /// Parameters
    /// ----------
    /// points : int
    ///     Number of launches.
    /// seed : int
    ///     Seed of the random numbers.
    #[staticmethod]
    #[pyo3(signature = (points, *, seed=1))]
    fn random(points: u64, seed: u64) -> PyResult<Self> {
        if points == 0 {
            return Err(malformed("points", points, "at least 1"));
        }
        Ok(::toss::sampling::Plan::Random { points, seed }.into())
    }

    /// Points of Sobol's sequence with Owen's scramble, which fill the space evenly.
    ///
    /// Parameters
    /// ----------
    /// points : int
    ///     Number of launches of all scrambles together; best a power of two for each.
    /// scrambles : int
    ///     Number of independent scrambles, from which the interval follows.
    /// seed : int
    ///     Seed of the scrambles.
    #[staticmethod]
    #[pyo3(signature = (points, *, scrambles=SCRAMBLES, seed=1))]
    fn sobol(points: u64, scrambles: u64, seed: u64) -> PyResult<Self> {
        Ok(::toss::sampling::Plan::Sobol(scrambled(points, scrambles, seed)?).into())
    }

    /// All speeds at once in closed form; the other coordinates by Sobol's sequence, or by their grid.
    ///
    /// Parameters
    /// ----------
    /// points : int, optional
    ///     Number of points of the other coordinates; by their grid if there is none.
    /// scrambles : int
    ///     Number of independent scrambles, from which the interval follows.
    /// seed : int
    ///     Seed of the scrambles.
    #[staticmethod]
    #[pyo3(signature = (points=None, *, scrambles=SCRAMBLES, seed=1))]
    fn exact_speed(points: Option<u64>, scrambles: u64, seed: u64) -> PyResult<Self> {
        let rest = match points {
            Some(points) => Rest::Sobol(scrambled(points, scrambles, seed)?),
            None if scrambles == SCRAMBLES && seed == 1 => Rest::Grid,
            None => return Err(malformed("points", "None", "a number of points, which are scrambled; a grid is not")),
        };
        Ok(::toss::sampling::Plan::ExactSpeed(rest).into())
    }

    /// All speeds at once in closed form, at the nodes of a rule over one or two other coordinates.
    ///
    /// Its shares are chosen as it goes, so that it has no parts.
    ///
    /// Parameters
    /// ----------
    /// accuracy : float
    ///     The largest acceptable error estimate.
    #[staticmethod]
    #[pyo3(signature = (accuracy=1e-10))]
    fn quadrature(accuracy: f64) -> PyResult<Self> {
        let valid = "finite and > 0";
        dynamics::error::require("accuracy", accuracy, valid, accuracy > 0.0).map_err(Failure::from)?;
        Ok(::toss::sampling::Plan::Quadrature { accuracy }.into())
    }

    /// The method: ``"grid"``, ``"random"``, ``"sobol"``, ``"exact-speed"`` or ``"quadrature"``.
    #[getter]
    fn method(&self) -> &'static str {
        self.plan.method().name()
    }

    /// The number of launches that the plan tries in a space.
    ///
    /// Parameters
    /// ----------
    /// space : Space
    ///     The space.
    fn points(&self, space: &Space) -> PyResult<u64> {
        Ok(self.plan.points(&space.space).map_err(Failure::from)?)
    }

    /// The plan as JSON, as the parts of an estimate have it.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.plan).map_err(|error| malformed("plan", error, "a plan"))
    }

    /// Reads a plan from JSON.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     As ``to_json`` writes it.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let read = serde_json::from_str::<::toss::sampling::Plan>(text);
        Ok(read.map_err(|error| malformed("plan", error, "a plan as JSON"))?.into())
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Plan.from_json('{}')", self.to_json()?))
    }

    fn __hash__(&self) -> PyResult<u64> {
        Ok(self.to_json()?.bytes().fold(0, |hash: u64, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte))))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json()?,).into_pyobject(py)?))
    }
}

/// A number of points, divided evenly among scrambles.
fn scrambled(points: u64, scrambles: u64, seed: u64) -> Result<Scrambled, Failure> {
    if scrambles == 0 || points == 0 || !points.is_multiple_of(scrambles) {
        let expected = "a multiple of the number of scrambles, which is at least 1";
        return Err(InputError::Malformed { field: "points", value: points.to_string(), expected }.into());
    }
    Ok(Scrambled { points, scrambles, seed })
}
