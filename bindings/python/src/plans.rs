//! How launches of a space are chosen.

use ::toss::InputError;
use ::toss::sampling::plan::SCRAMBLES;
use ::toss::sampling::{Rest, Scrambled};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::{Failure, malformed};
use crate::given::{self, count, number, object};
use crate::space::{hash_of, space_of};

/// Which launches of a space are tried. Make one by ``grid``, ``random``, ``sobol``, ``exact_speed`` or
/// ``enclosure``.
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
    fn random(#[pyo3(from_py_with = points)] points: u64, #[pyo3(from_py_with = seed)] seed: u64) -> PyResult<Self> {
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
    fn sobol(
        #[pyo3(from_py_with = points)] points: u64,
        #[pyo3(from_py_with = scrambles)] scrambles: u64,
        #[pyo3(from_py_with = seed)] seed: u64,
    ) -> PyResult<Self> {
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
    fn exact_speed(
        points: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = scrambles)] scrambles: u64,
        #[pyo3(from_py_with = seed)] seed: u64,
    ) -> PyResult<Self> {
        let rest = match points.map(self::points).transpose()? {
            Some(points) => Rest::Sobol(scrambled(points, scrambles, seed)?),
            None if scrambles == SCRAMBLES && seed == 1 => Rest::Grid,
            None => return Err(malformed("points", "None", "a number of points, which are scrambled; a grid is not")),
        };
        Ok(::toss::sampling::Plan::ExactSpeed(rest).into())
    }

    /// All launches, by bounds over whole cells of up to three coordinates beside the speed: both ends of the interval are proven.
    ///
    /// It has no parts. The number of points of its estimate is that of the cells.
    ///
    /// Parameters
    /// ----------
    /// accuracy : float
    ///     The largest half-width of the interval, at least 2e-14.
    #[staticmethod]
    #[pyo3(signature = (accuracy=1e-6))]
    fn enclosure(#[pyo3(from_py_with = accuracy)] accuracy: f64) -> PyResult<Self> {
        let accuracy = ::toss::sampling::enclosure::require_accuracy(accuracy).map_err(Failure::from)?;
        Ok(::toss::sampling::Plan::Enclosure { accuracy }.into())
    }

    /// The method: ``"grid"``, ``"random"``, ``"sobol"``, ``"exact-speed"`` or ``"enclosure"``.
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
    fn points(&self, #[pyo3(from_py_with = space_of)] space: ::toss::sampling::Space) -> PyResult<u64> {
        Ok(self.plan.points(&space).map_err(Failure::from)?)
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
    fn from_json(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let read = serde_json::from_str::<::toss::sampling::Plan>(&given::json(text, "a plan as JSON")?);
        Ok(read.map_err(|error| malformed("text", error, "a plan as JSON"))?.into())
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Plan.from_json('{}')", self.to_json()?))
    }

    fn __hash__(&self) -> PyResult<u64> {
        Ok(hash_of(&self.to_json()?))
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

fn points(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("points", value)
}

fn scrambles(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("scrambles", value)
}

fn seed(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("seed", value)
}

/// The accuracy that an argument is.
pub(crate) fn accuracy(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    number("accuracy", value)
}

/// The plan that an argument is.
pub(crate) fn plan_of(value: &Bound<'_, PyAny>) -> PyResult<::toss::sampling::Plan> {
    Ok(object::<Plan>("plan", value, "a Plan")?.get().plan)
}
