//! How launches of a space are chosen.

use ::toss::defaults::{LAUNCHES, Launches, SCRAMBLES, SEED, Wanted};
use ::toss::sampling::{Method, Rest, Space};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::{Failure, malformed};
use crate::given::{self, count, number, object};
use crate::space::space_of;

/// Which launches of a space are tried. Make one by ``grid``, ``random``, ``sobol``, ``exact_speed`` or
/// ``enclosure``. Numbers that are not given depend on the space, as those of the command line do.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Plan {
    wanted: Wanted,
}

impl From<::toss::sampling::Plan> for Plan {
    fn from(plan: ::toss::sampling::Plan) -> Self {
        Self { wanted: plan.into() }
    }
}

#[pymethods]
impl Plan {
    /// All launches of the grid of a space.
    #[staticmethod]
    fn grid() -> Self {
        Self { wanted: Wanted::new(Method::Grid) }
    }

    /// Independent random launches.
    ///
    /// Parameters
    /// ----------
    /// points : int, optional
    ///     Number of launches; 250000 by default, 65536 for a body that is not symmetric.
    /// seed : int, numpy.random.Generator or numpy.random.SeedSequence
    ///     Seed of the random numbers, 1 by default; a generator draws one.
    #[staticmethod]
    #[pyo3(signature = (points=None, *, seed=SEED))]
    fn random(points: Option<&Bound<'_, PyAny>>, #[pyo3(from_py_with = seed)] seed: u64) -> PyResult<Self> {
        let points = points.map(self::points).transpose()?;
        if points == Some(0) {
            return Err(malformed("points", 0, "at least 1"));
        }
        Ok(Self { wanted: Wanted { points, seed, ..Wanted::new(Method::Random) } })
    }

    /// Points of Sobol's sequence with Owen's scramble, which fill the space evenly.
    ///
    /// Parameters
    /// ----------
    /// points : int, optional
    ///     Number of launches of all scrambles together, best a power of two for each; 262144 by default, 65536 for a
    ///     body that is not symmetric.
    /// scrambles : int
    ///     Number of independent scrambles, from which the interval follows.
    /// seed : int, numpy.random.Generator or numpy.random.SeedSequence
    ///     Seed of the scrambles, 1 by default; a generator draws one.
    #[staticmethod]
    #[pyo3(signature = (points=None, *, scrambles=SCRAMBLES, seed=SEED))]
    fn sobol(
        points: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = scrambles)] scrambles: u64,
        #[pyo3(from_py_with = seed)] seed: u64,
    ) -> PyResult<Self> {
        Ok(Self { wanted: scrambled(Method::Sobol, points, scrambles, seed)? })
    }

    /// All speeds at once in closed form; the other coordinates by Sobol's sequence, or by their grid.
    ///
    /// Parameters
    /// ----------
    /// points : int, optional
    ///     Number of points of the other coordinates; by default their grid, if all of them have one, else as many as of
    ///     ``sobol``.
    /// scrambles : int
    ///     Number of independent scrambles, from which the interval follows.
    /// seed : int, numpy.random.Generator or numpy.random.SeedSequence
    ///     Seed of the scrambles, 1 by default; a generator draws one.
    #[staticmethod]
    #[pyo3(signature = (points=None, *, scrambles=SCRAMBLES, seed=SEED))]
    fn exact_speed(
        points: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = scrambles)] scrambles: u64,
        #[pyo3(from_py_with = seed)] seed: u64,
    ) -> PyResult<Self> {
        Ok(Self { wanted: scrambled(Method::ExactSpeed, points, scrambles, seed)? })
    }

    /// All launches, by bounds over whole cells of up to three coordinates beside the speed: both ends of the interval are proven.
    ///
    /// It has no parts. The number of points of its estimate is that of the cells.
    ///
    /// Parameters
    /// ----------
    /// accuracy : float, optional
    ///     The largest half-width of the interval, at least 2e-14; by default 1e-10, 1e-6 or 1e-3 with one, two or three
    ///     coordinates beside the speed.
    #[staticmethod]
    #[pyo3(signature = (accuracy=None))]
    fn enclosure(accuracy: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let accuracy = accuracy.map(self::accuracy).transpose()?;
        let accuracy =
            accuracy.map(::toss::sampling::enclosure::require_accuracy).transpose().map_err(Failure::from)?;
        Ok(Self { wanted: Wanted { accuracy, ..Wanted::new(Method::Enclosure) } })
    }

    /// The method: ``"grid"``, ``"random"``, ``"sobol"``, ``"exact-speed"`` or ``"enclosure"``.
    #[getter]
    fn method(&self) -> &'static str {
        self.wanted.method.name()
    }

    /// The same plan with the numbers that it has in a space.
    ///
    /// Parameters
    /// ----------
    /// space : Space
    ///     The space.
    fn of(&self, #[pyo3(from_py_with = space_of)] space: Space) -> PyResult<Self> {
        Ok(self.plan(&space)?.into())
    }

    /// The number of launches that the plan tries in a space.
    ///
    /// Parameters
    /// ----------
    /// space : Space
    ///     The space.
    fn points(&self, #[pyo3(from_py_with = space_of)] space: Space) -> PyResult<u64> {
        Ok(self.plan(&space)?.points(&space).map_err(Failure::from)?)
    }

    /// The plan as JSON, as the parts of an estimate have it. It has to have its numbers.
    fn to_json(&self) -> PyResult<String> {
        let Wanted { method, points, scrambles, seed, accuracy } = self.wanted;
        let sobol = |points| ::toss::sampling::Scrambled { points, scrambles, seed };
        let plan = match (method, points, accuracy) {
            (Method::Grid, ..) => ::toss::sampling::Plan::Grid,
            (Method::Random, Some(points), _) => ::toss::sampling::Plan::Random { points, seed },
            (Method::Sobol, Some(points), _) => ::toss::sampling::Plan::Sobol(sobol(points)),
            (Method::ExactSpeed, Some(points), _) => ::toss::sampling::Plan::ExactSpeed(Rest::Sobol(sobol(points))),
            (Method::ExactSpeed, None, _) if self.has_usual_scrambles() => {
                ::toss::sampling::Plan::ExactSpeed(Rest::Grid)
            }
            (Method::Enclosure, _, Some(accuracy)) => ::toss::sampling::Plan::Enclosure { accuracy },
            _ => return Err(malformed("plan", "without numbers", "one with numbers, as plan.of(space)")),
        };
        serde_json::to_string(&plan).map_err(|error| malformed("plan", error, "a plan"))
    }

    /// Reads a plan from JSON.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     As ``to_json`` writes it.
    #[staticmethod]
    fn from_json(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(given::from_json::<::toss::sampling::Plan>(text, "a plan as JSON")?.into())
    }

    fn __repr__(&self) -> String {
        let Wanted { method, points, scrambles, seed, accuracy } = self.wanted;
        let number = points.map(|points| points.to_string()).or(accuracy.map(|accuracy| format!("{accuracy:?}")));
        let scrambles = (scrambles != SCRAMBLES).then(|| format!("scrambles={scrambles}"));
        let seed = (seed != SEED).then(|| format!("seed={seed}"));
        let arguments: Vec<String> = number.into_iter().chain(scrambles).chain(seed).collect();
        format!("Plan.{}({})", method.name().replace('-', "_"), arguments.join(", "))
    }

    fn __hash__(&self) -> u64 {
        let Wanted { method, points, scrambles, seed, accuracy } = self.wanted;
        let numbers = [points.unwrap_or_default(), scrambles, seed, accuracy.unwrap_or_default().to_bits()];
        numbers.iter().fold(method as u64, |hash, number| hash.rotate_left(9) ^ number)
    }

    /// Makes a plan anew, in another process.
    #[staticmethod]
    fn _again(method: &str, points: Option<u64>, scrambles: u64, seed: u64, accuracy: Option<f64>) -> PyResult<Self> {
        let method = method.parse().map_err(Failure::from)?;
        Ok(Self { wanted: Wanted { method, points, scrambles, seed, accuracy } })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Wanted { method, points, scrambles, seed, accuracy } = self.wanted;
        let arguments = (method.name(), points, scrambles, seed, accuracy).into_pyobject(py)?;
        Ok((py.get_type::<Self>().getattr("_again")?, arguments))
    }
}

impl Plan {
    fn has_usual_scrambles(&self) -> bool {
        (self.wanted.scrambles, self.wanted.seed) == (SCRAMBLES, SEED)
    }

    /// A method without numbers.
    pub(crate) fn of_method(method: Method) -> Self {
        Self { wanted: Wanted::new(method) }
    }

    /// The plan for `space`.
    pub(crate) fn plan(&self, space: &Space) -> PyResult<::toss::sampling::Plan> {
        self.plan_of(space, LAUNCHES)
    }

    /// The same, with so many launches where none are given.
    pub(crate) fn plan_of(&self, space: &Space, usual: Launches) -> PyResult<::toss::sampling::Plan> {
        const NONE: &str = "none for this space: exact-speed draws no launches where a grid is enough";
        let plan = self.wanted.plan(space, usual);
        match (plan, self.wanted.points) {
            (::toss::sampling::Plan::ExactSpeed(Rest::Grid), Some(points)) => Err(malformed("points", points, NONE)),
            (::toss::sampling::Plan::ExactSpeed(Rest::Grid), None) if !self.has_usual_scrambles() => {
                let Wanted { scrambles, seed, .. } = self.wanted;
                let (field, value) = if seed == SEED { ("scrambles", scrambles) } else { ("seed", seed) };
                Err(malformed(field, value, NONE))
            }
            _ => Ok(plan),
        }
    }
}

/// A method of so many points, divided evenly among scrambles.
fn scrambled(method: Method, points: Option<&Bound<'_, PyAny>>, scrambles: u64, seed: u64) -> PyResult<Wanted> {
    let points = points.map(self::points).transpose()?;
    if scrambles == 0 {
        return Err(malformed("scrambles", 0, "at least 1"));
    }
    if let Some(points) = points.filter(|points| *points == 0 || !points.is_multiple_of(scrambles)) {
        return Err(malformed("points", points, "a multiple of the number of scrambles, and at least 1"));
    }
    Ok(Wanted { points, scrambles, seed, ..Wanted::new(method) })
}

fn points(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("points", value)
}

fn scrambles(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("scrambles", value)
}

/// The seed that an argument is or draws.
pub(crate) fn seed(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("seed", &value.py().import("unfair_toss.given")?.call_method1("drawn", (value,))?)
}

/// The accuracy that an argument is.
pub(crate) fn accuracy(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    number("accuracy", value)
}

/// The plan for `space` that an argument is.
pub(crate) fn plan_of(value: &Bound<'_, PyAny>, space: &Space) -> PyResult<::toss::sampling::Plan> {
    object::<Plan>("plan", value, "a Plan")?.get().plan(space)
}
