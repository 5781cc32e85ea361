//! Partial results of an estimate.

use ::toss::sampling::{Sampler, Space as AnySpace};
use pyo3::prelude::*;
use pyo3::types::{PyInt, PyTuple};

use crate::errors::{Failure, malformed};
use crate::estimate::Estimate;
use crate::given;
use crate::plans::{Plan, plan_of};
use crate::space::{Space, space_of};
use crate::threads::{self, threads_of};

/// The result of some launches of a plan, as ``tally`` returns it.
///
/// Two tallies of neighbouring launches add up with ``+``, in any order; a tally of all launches has the estimate.
/// All sums are integers, so that any partition of a plan gives the same. A tally that was pickled or read from
/// JSON has the same counts, but no longer counts as proven, because a file proves nothing.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Tally {
    tally: ::toss::sampling::Tally,
}

#[pymethods]
impl Tally {
    /// The space of the launches.
    #[getter]
    fn space(&self) -> Space {
        Space { space: *self.tally.space() }
    }

    /// The plan that chooses the launches.
    #[getter]
    fn plan(&self) -> Plan {
        self.tally.plan().into()
    }

    /// The numbers of the launches: the first one, and the one after the last.
    #[getter]
    fn range(&self) -> (u64, u64) {
        let range = self.tally.range();
        (range.start, range.end)
    }

    fn __add__(&self, other: &Self) -> PyResult<Self> {
        let tally = self.tally.clone().merge(other.tally.clone()).map_err(Failure::from)?;
        Ok(Self { tally })
    }

    /// Of the 0 that ``sum`` begins with.
    fn __radd__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        let py = other.py();
        let is_nothing = other.is_exact_instance_of::<PyInt>() && other.eq(0)?;
        if is_nothing { Ok(Py::new(py, self.clone())?.into_any()) } else { Ok(py.NotImplemented()) }
    }

    /// The tally as JSON: a part of the command line, which ``unfair-toss merge`` reads, too.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.tally).map_err(|error| malformed("tally", error, "a tally"))
    }

    /// Reads a tally from JSON, as ``unfair-toss probability --shard`` writes it.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     As ``to_json`` writes it.
    #[staticmethod]
    fn from_json(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { tally: given::from_json(text, "a part of an estimate as JSON")? })
    }

    /// The fields of the estimate from a tally of all launches.
    fn _estimate(&self) -> PyResult<Estimate> {
        Ok((&self.tally.estimate().map_err(Failure::from)?).into())
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Tally.from_json('{}')", self.to_json()?))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json()?,).into_pyobject(py)?))
    }
}

/// The tally of the launches from number `start` up to `end`.
#[pyfunction]
pub(crate) fn tally(
    py: Python<'_>,
    #[pyo3(from_py_with = space_of)] space: AnySpace,
    plan: &Bound<'_, PyAny>,
    start: u64,
    end: u64,
    #[pyo3(from_py_with = threads_of)] threads: Option<u64>,
) -> PyResult<Tally> {
    let plan = plan_of(plan, &space)?;
    let pool = threads::pool(threads)?;
    let tally = threads::aside(py, move |stop| {
        let progress = |_| stop.here();
        let sampler = Sampler::exact().on_progress(&progress);
        Ok(pool.install(|| sampler.tally(&space, plan, start..end))?)
    })?;
    Ok(Tally { tally })
}
