//! Many launches of one body, as columns of NumPy, on as many threads as are asked for.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use ::toss::Attitude;
use dynamics::Thrown;
use dynamics::error::require;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::body_of;
use crate::errors::{Failure, malformed};
use crate::given::{count, optional_number};
use crate::launches::{Common, Counts, Launches, added};
use crate::solver::backend_of;
use crate::threads::{self, A_CALL, A_PROOF, SMALLEST_PART};
use crate::toss::put_attitude;

/// Most launches of a call if they are not solved by the kernels, so that work that is wanted no more ends soon.
const A_SLOW_CALL: usize = 1 << 6;

/// Launches for the kernels beyond which threads are worth their start.
const WORTH_THREADS: usize = 1 << 17;

/// What the launches of some columns have in common, and the threads that solve them. The columns are the rates about x, y
/// and z, the speeds, and where they vary gravity, the drop, the tilt, and w, x, y, z of the attitude.
#[pyclass(frozen, module = "unfair_toss._native")]
pub(crate) struct Batch {
    launches: Arc<Common>,
    threads: Option<u64>,
    /// Made at the first call that several threads are worth it for.
    pool: OnceLock<Arc<rayon::ThreadPool>>,
}

/// Writes what is found of the launches in a range.
type Solve<T> = fn(&Launches<'_>, Range<usize>, &mut [T]) -> Result<(), Failure>;

/// What is asked of launches: `width` numbers for each, of at most `a_call` launches at a time by the kernels.
struct Asked<T> {
    width: usize,
    a_call: usize,
    solve: Solve<T>,
}

/// The columns of some launches, in Python's memory.
type Column<'py> = Bound<'py, PyArray1<f64>>;

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (body, *, gravity, drop, tilt, attitude, varying, timed, solver, threads))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        body: &Bound<'_, PyAny>,
        gravity: Option<&Bound<'_, PyAny>>,
        drop: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        attitude: Option<&Bound<'_, PyAny>>,
        varying: [bool; 4],
        timed: bool,
        solver: Option<&Bound<'_, PyAny>>,
        threads: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let drop = optional_number("drop", drop)?;
        let gravity = optional_number("gravity", gravity)?.unwrap_or(DEFAULT_GRAVITY);
        require("gravity [m/s²]", gravity, "finite and > 0", gravity > 0.0).map_err(Failure::from)?;
        drop.map(|drop| require("drop [m]", drop, "finite", true)).transpose().map_err(Failure::from)?;
        let mut given = Thrown::default();
        put_attitude(&mut given, tilt, attitude)?;
        let attitude = given.attitude().map_err(Failure::from)?.unwrap_or(Attitude::IDENTITY);
        let threads = threads.map(|threads| count("threads", threads)).transpose()?;
        threads::require(threads)?;
        let solver = solver.map(backend_of).transpose()?;
        // With a gravity of 2 m/s², a speed is the time of flight.
        let gravity = if timed { 2.0 } else { gravity };
        let launches = Common { body: body_of(body)?.get().body, attitude, gravity, drop, varying, timed, solver };
        Ok(Self { launches: Arc::new(launches), threads, pool: OnceLock::new() })
    }

    /// Whether the launches are solved by the kernels.
    #[getter]
    fn is_vectorised(&self) -> bool {
        self.launches.is_vectorised()
    }

    /// Writes cos θ at landing of the launches, whose first one has the index `first`.
    fn cos_tilts(&self, py: Python<'_>, columns: Vec<Column<'_>>, out: &Column<'_>, first: u64) -> PyResult<()> {
        let solve: Solve<f64> = |launches, range, out| launches.cos_tilts(range, out);
        self.write(py, &columns, out, first, &Asked { width: 1, a_call: A_CALL, solve })
    }

    /// Writes 1 for heads, -1 for tails and 0 for undecided launches.
    fn outcomes(
        &self,
        py: Python<'_>,
        columns: Vec<Column<'_>>,
        out: &Bound<'_, PyArray1<i8>>,
        first: u64,
    ) -> PyResult<()> {
        let solve: Solve<i8> = |launches, range, out| launches.outcomes(range, out);
        self.write(py, &columns, out, first, &Asked { width: 1, a_call: A_PROOF, solve })
    }

    /// Writes w, x, y, z of the attitude at landing of each launch, one after the other.
    fn attitudes(&self, py: Python<'_>, columns: Vec<Column<'_>>, out: &Column<'_>, first: u64) -> PyResult<()> {
        let solve: Solve<f64> = |launches, range, out| launches.attitudes(range, out);
        self.write(py, &columns, out, first, &Asked { width: 4, a_call: A_CALL, solve })
    }

    /// Counts the outcomes: heads, tails, undecided, without a proof, and by the stage of the proof.
    fn count(&self, py: Python<'_>, columns: Vec<Column<'_>>, first: u64) -> PyResult<Counts> {
        let columns = borrowed(&columns)?;
        let launches = self.launches(&columns, first)?;
        let number = launches.len();
        let counts = if self.is_vectorised() {
            threads::collect(py, self.pool(number)?.as_deref(), number, |range| count_runs(&launches, range))?
        } else {
            let (mut own, pool) = (launches.owned(), self.pool(number)?);
            threads::aside(py, move |stop| {
                own.stop = Some(stop.clone());
                threads::collected(pool.as_deref(), stop, A_SLOW_CALL, number, |range| count_runs(&own, range))
            })?
        };
        Ok(counts.into_iter().fold(Counts::default(), added))
    }
}

fn count_runs(launches: &Launches<'_>, range: Range<usize>) -> Result<Counts, Failure> {
    launches
        .runs(range, launches.of.is_vectorised())
        .try_fold(Counts::default(), |sum, run| Ok(added(sum, launches.count(run)?)))
}

/// Writes what is found of the launches in a range, of those in a row at once that differ in rates and speeds only.
fn by_runs<T>(
    launches: &Launches<'_>,
    range: Range<usize>,
    out: &mut [T],
    width: usize,
    solve: Solve<T>,
) -> Result<(), Failure> {
    let start = range.start;
    let place = |index: usize| width * (index - start);
    // Of cos θ and outcomes of coins.
    let varies = width == 1 && launches.of.is_vectorised();
    launches
        .runs(range, varies)
        .try_for_each(|run| solve(launches, run.clone(), &mut out[place(run.start)..place(run.end)]))
}

/// The columns, for reading.
fn borrowed<'py>(columns: &[Column<'py>]) -> PyResult<Vec<PyReadonlyArray1<'py, f64>>> {
    columns.iter().map(|column| column.try_readonly().map_err(in_use)).collect()
}

fn in_use(error: impl ToString) -> PyErr {
    malformed("out", error.to_string(), "an array that can be written and that nothing else uses")
}

fn no_column(error: impl ToString) -> PyErr {
    malformed("columns", error.to_string(), "contiguous columns")
}

impl Batch {
    /// The threads for so many launches; `None` for this one alone. By default there is one per core, unless the launches are
    /// so few that threads take longer to start than one of them takes for all.
    fn pool(&self, launches: usize) -> PyResult<Option<Arc<rayon::ThreadPool>>> {
        let fewest = if self.is_vectorised() { WORTH_THREADS } else { SMALLEST_PART };
        if self.threads == Some(1) || (self.threads.is_none() && launches <= fewest) {
            return Ok(None);
        }
        if let Some(pool) = self.pool.get() {
            return Ok(Some(pool.clone()));
        }
        let pool = Arc::new(threads::pool(self.threads)?);
        Ok(Some(self.pool.get_or_init(|| pool).clone()))
    }

    /// Writes what is asked of the launches, without Python's lock. What is not solved by the kernels may take long for a
    /// single launch; that is found of a copy, which a signal can leave behind.
    fn write<T: Element + Default + Copy + Send + 'static>(
        &self,
        py: Python<'_>,
        columns: &[Column<'_>],
        out: &Bound<'_, PyArray1<T>>,
        first: u64,
        &Asked { width, a_call, solve }: &Asked<T>,
    ) -> PyResult<()> {
        let columns = borrowed(columns)?;
        let launches = self.launches(&columns, first)?;
        let mut out = out.try_readwrite().map_err(in_use)?;
        let out = launches.fitting(out.as_slice_mut().map_err(no_column)?, width)?;
        if self.is_vectorised() {
            let solve = |range: Range<usize>, out: &mut [T]| by_runs(&launches, range, out, width, solve);
            return threads::fill(py, self.pool(launches.len())?.as_deref(), a_call, out, width, solve);
        }
        let (mut own, pool, length) = (launches.owned(), self.pool(launches.len())?, out.len());
        let found = threads::aside(py, move |stop| {
            own.stop = Some(stop.clone());
            let mut found = vec![T::default(); length];
            let solve = |range: Range<usize>, out: &mut [T]| by_runs(&own, range, out, width, solve);
            threads::filled(pool.as_deref(), stop, A_SLOW_CALL, &mut found, width, solve)?;
            Ok(found)
        })?;
        out.copy_from_slice(&found);
        Ok(())
    }

    fn launches<'a>(&self, columns: &'a [PyReadonlyArray1<'_, f64>], first: u64) -> PyResult<Launches<'a>> {
        let slice = |column: &'a PyReadonlyArray1<'_, f64>| column.as_slice().map(Cow::Borrowed).map_err(no_column);
        let columns: Vec<_> = columns.iter().map(slice).collect::<PyResult<_>>()?;
        let [gravity, drop, tilt, attitude] = self.launches.varying.map(usize::from);
        let right = 4 + gravity + drop + tilt + 4 * attitude;
        if columns.len() != right || columns.iter().any(|column| column.len() != columns[0].len()) {
            return Err(malformed("columns", "of different lengths", "as many of each kind"));
        }
        Ok(Launches { of: self.launches.clone(), columns, first, stop: None })
    }
}
