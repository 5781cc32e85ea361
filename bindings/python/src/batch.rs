//! Many launches of one body, as columns of NumPy, on as many threads as are asked for.

use std::ops::Range;

use ::toss::{Attitude, Stage};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::body_of;
use crate::errors::{Failure, malformed};
use crate::launches::{Common, Counts, Launches};
use crate::solver::backend_of;
use crate::threads;
use crate::toss::{attitude_of, components_of};

/// What the launches of some columns have in common, and the threads that solve them.
#[pyclass(frozen, module = "unfair_toss._native")]
pub(crate) struct Batch {
    launches: Common,
    pool: Option<rayon::ThreadPool>,
}

/// The columns of some launches, in Python's memory.
type Column<'py> = Bound<'py, PyArray1<f64>>;

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (body, *, tilt, attitude, gravity, timed, solver, threads))]
    fn new(
        body: &Bound<'_, PyAny>,
        tilt: Option<f64>,
        attitude: Option<&Bound<'_, PyAny>>,
        gravity: f64,
        timed: bool,
        solver: Option<&Bound<'_, PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        dynamics::error::require("gravity [m/s²]", gravity, "finite and > 0", gravity > 0.0).map_err(Failure::from)?;
        let attitude = attitude_of(tilt, attitude.map(components_of).transpose()?)?.unwrap_or(Attitude::IDENTITY);
        let pool = if threads == Some(1) { None } else { Some(threads::pool(threads)?) };
        let solver = solver.map(backend_of).transpose()?;
        // With a gravity of 2 m/s², a speed is the time of flight.
        let gravity = if timed { 2.0 } else { gravity };
        let launches = Common { body: body_of(body)?.get().body, attitude, gravity, timed, solver };
        Ok(Self { launches, pool })
    }

    /// Whether the launches are solved by the kernels.
    #[getter]
    fn is_vectorised(&self) -> bool {
        self.launches.is_vectorised()
    }

    /// Writes cos θ at landing of the launches, whose first one has the index `first`.
    fn cos_tilts(&self, py: Python<'_>, columns: [Column<'_>; 4], out: &Column<'_>, first: u64) -> PyResult<()> {
        self.write(py, &columns, out, 1, first, |range, out, launches| launches.cos_tilts(range, out))
    }

    /// Writes 1 for heads, -1 for tails and 0 for undecided launches.
    fn outcomes(
        &self,
        py: Python<'_>,
        columns: [Column<'_>; 4],
        out: &Bound<'_, PyArray1<i8>>,
        first: u64,
    ) -> PyResult<()> {
        self.write(py, &columns, out, 1, first, |range, out, launches| launches.outcomes(range, out))
    }

    /// Writes w, x, y, z of the attitude at landing of each launch, one after the other.
    fn attitudes(&self, py: Python<'_>, columns: [Column<'_>; 4], out: &Column<'_>, first: u64) -> PyResult<()> {
        self.write(py, &columns, out, 4, first, |range, out, launches| launches.attitudes(range, out))
    }

    /// Counts the outcomes.
    fn count(&self, py: Python<'_>, columns: [Column<'_>; 4], first: u64) -> PyResult<Counts> {
        let columns = borrowed(&columns)?;
        let launches = self.launches(&columns, first)?;
        let number = launches.speeds.len();
        let counts = py.detach(|| threads::collect(self.pool.as_ref(), number, |range| launches.count(range)))?;
        Ok(counts.into_iter().fold((0, 0, 0, Some([0; Stage::ALL.len()])), added))
    }
}

/// The sum of counts; it is proven if both are.
fn added(one: Counts, two: Counts) -> Counts {
    let stages = one.3.zip(two.3).map(|(one, two)| std::array::from_fn(|stage| one[stage] + two[stage]));
    (one.0 + two.0, one.1 + two.1, one.2 + two.2, stages)
}

/// The columns, for reading.
fn borrowed<'py>(columns: &[Column<'py>; 4]) -> PyResult<[PyReadonlyArray1<'py, f64>; 4]> {
    let [x, y, z, speeds] = columns.each_ref().map(|column| column.try_readonly().map_err(in_use));
    Ok([x?, y?, z?, speeds?])
}

fn in_use(error: impl ToString) -> PyErr {
    malformed("out", error.to_string(), "an array that can be written and that nothing else uses")
}

fn no_column(error: impl ToString) -> PyErr {
    malformed("columns", error.to_string(), "contiguous columns")
}

impl Batch {
    /// Writes what `solve` finds of the launches, `width` numbers for each, without Python's lock.
    fn write<T: Element + Send>(
        &self,
        py: Python<'_>,
        columns: &[Column<'_>; 4],
        out: &Bound<'_, PyArray1<T>>,
        width: usize,
        first: u64,
        solve: impl Fn(Range<usize>, &mut [T], &Launches<'_>) -> Result<(), Failure> + Sync,
    ) -> PyResult<()> {
        let columns = borrowed(columns)?;
        let launches = self.launches(&columns, first)?;
        let mut out = out.try_readwrite().map_err(in_use)?;
        let out = launches.fitting(out.as_slice_mut().map_err(no_column)?, width)?;
        let pool = self.pool.as_ref();
        Ok(py.detach(|| threads::fill(pool, out, width, |range, out| solve(range, out, &launches)))?)
    }

    fn launches<'a>(&'a self, columns: &'a [PyReadonlyArray1<'_, f64>; 4], first: u64) -> PyResult<Launches<'a>> {
        let [x, y, z, speeds] = columns.each_ref().map(|column| column.as_slice().map_err(no_column));
        let (rates, speeds) = ([x?, y?, z?], speeds?);
        if rates.iter().any(|column| column.len() != speeds.len()) {
            return Err(malformed("columns", "of different lengths", "as many rates of each kind as speeds"));
        }
        Ok(Launches { of: &self.launches, rates, speeds, first })
    }
}
