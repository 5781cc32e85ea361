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

use crate::body::body_at;
use crate::errors::{Failure, malformed};
use crate::given::{count, optional_number};
use crate::launches::{BLOCK, Common, Counts, Launches, added};
use crate::solver::backend_of;
use crate::threads::{self, A_CALL, A_PROOF, SMALLEST_PART, Stop};
use crate::toss::put_attitude;

/// Most launches of a call if they are not solved by the kernels of coins, so that work that is wanted no more ends soon, and
/// what a filter of a body's outcomes begins with, as long as some hundred launches, counts little.
const A_SLOW_CALL: usize = BLOCK;

/// Launches for the kernels beyond which threads are worth their start.
const WORTH_THREADS: usize = 1 << 17;

/// What the launches of some columns have in common, and the threads that solve them. The columns are those of
/// [`Launches::columns`].
#[pyclass(frozen, module = "unfair_toss._native")]
pub(crate) struct Batch {
    launches: Arc<Common>,
    /// Whether there are a turn and ψ instead of rates.
    precesses: bool,
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
    #[pyo3(signature = (bodies, *, gravity, drop, tilt, attitude, varying, precesses, timed, solver, threads))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        bodies: Vec<(Bound<'_, PyAny>, Option<u64>)>,
        gravity: Option<&Bound<'_, PyAny>>,
        drop: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        attitude: Option<&Bound<'_, PyAny>>,
        varying: [usize; 5],
        precesses: bool,
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
        let bodies = bodies.iter().map(|(body, index)| Ok(body_at(body, *index)?.get().body));
        let bodies = bodies.collect::<PyResult<_>>()?;
        let launches = Common { bodies, attitude, gravity, drop, varying, timed, solver };
        Ok(Self { launches: Arc::new(launches), precesses, threads, pool: OnceLock::new() })
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
            let (pool, order) = (self.pool(number)?, launches.in_order());
            let own = launches.taken(&order);
            threads::aside(py, move |stop| {
                first_failing(own, order, stop, first, |own| {
                    threads::collected(pool.as_deref(), stop, A_SLOW_CALL, own.len(), |range| count_runs(own, range))
                })
            })?
        };
        Ok(counts.into_iter().fold(Counts::default(), added))
    }
}

/// What `solve` finds of `launches`, which were taken in this order from those whose first one has the index `first`; or the
/// failure of the one with the lowest index, which need not be the first one that is met.
fn first_failing<R>(
    mut launches: Launches<'static>,
    mut order: Vec<usize>,
    stop: &Stop,
    first: u64,
    solve: impl Fn(&Launches<'static>) -> Result<R, Failure>,
) -> Result<R, Failure> {
    let mut lowest = None;
    loop {
        launches.stop = Some(stop.clone());
        let failure = match (solve(&launches), lowest) {
            (Ok(found), None) => return Ok(found),
            (Ok(_), Some(failure)) => return Err(failure),
            (Err(failure), _) => failure,
        };
        let Some(place) = failure.launch().and_then(|index| order.get(usize::try_from(index).ok()?).copied()) else {
            return Err(failure);
        };
        lowest = Some(failure.moved(|_| first + place as u64));
        let before: Vec<usize> = (0..order.len()).filter(|index| order[*index] < place).collect();
        launches = launches.taken(&before);
        order.retain(|of| *of < place);
    }
}

fn count_runs(launches: &Launches<'_>, range: Range<usize>) -> Result<Counts, Failure> {
    let mut sum = Counts::default();
    launches.by_runs(range, |launches, run| {
        sum = added(sum, launches.count(run)?);
        Ok(())
    })?;
    Ok(sum)
}

/// Writes what is found of the launches in a range.
fn write_runs<T>(
    launches: &Launches<'_>,
    range: Range<usize>,
    out: &mut [T],
    width: usize,
    solve: Solve<T>,
) -> Result<(), Failure> {
    let mut rest = out;
    launches.by_runs(range, |launches, run| {
        let (out, others) = std::mem::take(&mut rest).split_at_mut(width * run.len());
        rest = others;
        solve(launches, run, out)
    })
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
            let solve = |range: Range<usize>, out: &mut [T]| write_runs(&launches, range, out, width, solve);
            return threads::fill(py, self.pool(launches.len())?.as_deref(), a_call, out, width, solve);
        }
        let (pool, order) = (self.pool(launches.len())?, launches.in_order());
        let (own, places) = (launches.taken(&order), order.clone());
        let found = threads::aside(py, move |stop| {
            first_failing(own, order, stop, first, |own| {
                let mut found = vec![T::default(); width * own.len()];
                let solve = |range: Range<usize>, out: &mut [T]| write_runs(own, range, out, width, solve);
                threads::filled(pool.as_deref(), stop, A_SLOW_CALL, &mut found, width, solve)?;
                Ok(found)
            })
        })?;
        for (found, place) in found.chunks_exact(width).zip(places) {
            out[width * place..width * (place + 1)].copy_from_slice(found);
        }
        Ok(())
    }

    fn launches<'a>(&self, columns: &'a [PyReadonlyArray1<'_, f64>], first: u64) -> PyResult<Launches<'a>> {
        let slice = |column: &'a PyReadonlyArray1<'_, f64>| column.as_slice().map(Cow::Borrowed).map_err(no_column);
        let columns: Vec<_> = columns.iter().map(slice).collect::<PyResult<_>>()?;
        let right = 4 + self.launches.varying.iter().sum::<usize>();
        if columns.len() != right || columns.iter().any(|column| column.len() != columns[0].len()) {
            return Err(malformed("columns", "of different lengths", "as many of each kind"));
        }
        Ok(Launches { of: self.launches.clone(), columns, precesses: self.precesses, first, stop: None })
    }
}
