//! Many launches of one body, as columns of NumPy. A coin is solved by the kernels of [`::toss::Batch`], in the widest
//! registers of the machine, and so are the outcomes of other bodies; what else is asked of these, and any body by a
//! solver, launch by launch.

use std::ops::Range;

use ::toss::{Attitude, Backend, Error, Launch, Outcome, RigidToss, Stage, TimeOfFlight, Tosses, certify_rigid};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::body::body_of;
use crate::errors::{Failure, malformed};
use crate::solver::backend_of;
use crate::threads;
use crate::toss::{attitude_of, components_of};

/// Launches whose attitudes are interleaved at a time, so that what is between stays in the cache.
const BLOCK: usize = 512;

/// The same for outcomes, which are a byte each: so many that the start of a batch does not count.
const OUTCOMES_BLOCK: usize = 1 << 13;

/// What the launches of some columns have in common.
#[pyclass(frozen, module = "unfair_toss._native")]
pub(crate) struct Batch {
    body: ::toss::Body,
    attitude: Attitude,
    gravity: f64,
    /// Whether the last column has times of flight instead of speeds.
    timed: bool,
    /// `None` for the kernels.
    solver: Option<Backend>,
    pool: Option<rayon::ThreadPool>,
}

/// Counts of outcomes: heads, tails, undecided, and by stage of the proof where they are proven.
type Counts = (u64, u64, u64, Option<[u64; Stage::ALL.len()]>);

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
        Ok(Self { body: body_of(body)?.get().body, attitude, gravity, timed, solver, pool })
    }

    /// Whether the launches are solved by the kernels.
    #[getter]
    fn is_vectorised(&self) -> bool {
        self.solver.is_none() && self.body.symmetric().is_some()
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
        Ok(Launches { of: self, rates, speeds, first })
    }
}

/// Launches whose columns are borrowed.
struct Launches<'a> {
    of: &'a Batch,
    rates: [&'a [f64]; 3],
    speeds: &'a [f64],
    first: u64,
}

impl Launches<'_> {
    /// `out` if it has `width` numbers for each launch.
    fn fitting<'b, T>(&self, out: &'b mut [T], width: usize) -> PyResult<&'b mut [T]> {
        if out.len() == width * self.speeds.len() {
            return Ok(out);
        }
        Err(malformed("out", out.len(), "as many results as launches"))
    }

    /// The launches in `range` as tosses of `body`.
    fn tosses<B: Copy>(&self, body: B, range: Range<usize>) -> Result<Tosses<'_, B>, Failure> {
        let rates = self.rates.map(|column| &column[range.clone()]);
        Ok(Tosses::new(body, self.of.attitude, self.of.gravity, rates, &self.speeds[range])?)
    }

    /// The launches in `range` for the kernels; `None` if they are solved one by one.
    fn batch(&self, range: Range<usize>) -> Result<Option<::toss::Batch<'_>>, Failure> {
        let coin = self.of.body.symmetric().filter(|_| self.of.solver.is_none());
        coin.map(|coin| self.tosses(coin, range).map(::toss::Batch::new)).transpose()
    }

    /// Writes the proven outcomes of the launches in `range`, of any body.
    fn prove(&self, range: Range<usize>, outcomes: &mut [Outcome]) -> Result<(), Failure> {
        let start = range.start;
        let done = match self.of.body.symmetric() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).outcomes(outcomes),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).outcomes(outcomes),
        };
        done.map_err(|error| self.failed(start, error))
    }

    /// Counts the proven outcomes of the launches in `range`, of any body.
    fn count_proven(&self, range: Range<usize>) -> Result<Counts, Failure> {
        let start = range.start;
        let counts = match self.of.body.symmetric() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).count(),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).count(),
        };
        let counts = counts.map_err(|error| self.failed(start, error))?;
        let stages = (counts.without_proof() == 0).then(|| Stage::ALL.map(|stage| counts.by(stage)));
        Ok((counts.heads(), counts.tails(), counts.ties(), stages))
    }

    /// The failure of the kernels in the part that starts at `start`, in the words of a single launch.
    fn failed(&self, start: usize, error: Error) -> Failure {
        let error = error.after(start as u64);
        if let Error::BadLaunch { index, .. } = error
            && self.of.timed
            && let Err(failure) = self.toss(usize::try_from(index).unwrap_or(usize::MAX))
        {
            return failure.at(self.first + index);
        }
        error.after(self.first).into()
    }

    fn toss(&self, index: usize) -> Result<RigidToss, Failure> {
        let Batch { body, attitude, gravity, timed, .. } = self.of;
        let speed = self.speeds[index];
        let time =
            if *timed { TimeOfFlight::Given(speed) } else { TimeOfFlight::Ballistic { speed, gravity: *gravity } };
        let launch = Launch::new(self.rates.map(|column| column[index]), time)?.with_attitude(*attitude);
        Ok(RigidToss { body: *body, launch })
    }

    /// The result of `solve` for each launch in `range`, with its place.
    fn each(
        &self,
        range: Range<usize>,
        mut solve: impl FnMut(usize, &dyn ::toss::Solver, &RigidToss) -> Result<(), Error>,
    ) -> Result<(), Failure> {
        let solver = self.of.solver.as_ref().map_or(&::toss::ExactSolver as &dyn ::toss::Solver, Backend::solver);
        for (place, index) in range.enumerate() {
            let at = |failure: Failure| failure.at(self.first + index as u64);
            let toss = self.toss(index).map_err(at)?;
            solve(place, solver, &toss).map_err(|error| at(error.into()))?;
        }
        Ok(())
    }

    fn cos_tilts(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        match self.batch(range.clone())? {
            Some(batch) => batch.cos_tilts(out).map_err(|error| self.failed(start, error)),
            None => self.each(range, |place, solver, toss| {
                out[place] = solver.cos_tilt_rigid(toss)?;
                Ok(())
            }),
        }
    }

    fn outcomes(&self, range: Range<usize>, out: &mut [i8]) -> Result<(), Failure> {
        if self.of.solver.is_some() {
            return self.each(range, |place, solver, toss| {
                out[place] = sign(solver.outcome_rigid(toss)?);
                Ok(())
            });
        }
        let mut block = [Outcome::Undecided; OUTCOMES_BLOCK];
        for (number, out) in out.chunks_mut(OUTCOMES_BLOCK).enumerate() {
            let from = range.start + number * OUTCOMES_BLOCK;
            let outcomes = &mut block[..out.len()];
            self.prove(from..from + out.len(), outcomes)?;
            out.iter_mut().zip(outcomes).for_each(|(out, outcome)| *out = sign(*outcome));
        }
        Ok(())
    }

    fn attitudes(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        let Some(_) = self.batch(0..0)? else {
            return self.each(range, |place, solver, toss| {
                let landing = solver.propagate_rigid(toss)?.state.attitude;
                out[4 * place..4 * place + 4].copy_from_slice(&landing.components());
                Ok(())
            });
        };
        let mut block = [[0.0; BLOCK]; 4];
        for (number, out) in out.chunks_mut(4 * BLOCK).enumerate() {
            let (from, length) = (start + number * BLOCK, out.len() / 4);
            let [w, x, y, z] = block.each_mut().map(|column| &mut column[..length]);
            if let Some(batch) = self.batch(from..from + length)? {
                batch.attitudes([w, x, y, z]).map_err(|error| self.failed(from, error))?;
            }
            for (index, out) in out.chunks_exact_mut(4).enumerate() {
                out.copy_from_slice(&block.each_ref().map(|column| column[index]));
            }
        }
        Ok(())
    }

    fn count(&self, range: Range<usize>) -> Result<Counts, Failure> {
        if self.of.solver.is_none() {
            return self.count_proven(range);
        }
        let mut faces = [0; 3];
        let mut stages = [0; Stage::ALL.len()];
        let by_exact = !matches!(self.of.solver, Some(Backend::Solver(_)));
        let mut proven = by_exact;
        self.each(range, |_, solver, toss| {
            let outcome = if by_exact {
                let certificate = certify_rigid(toss)?;
                proven &= certificate.is_proven();
                stages[certificate.stage() as usize] += 1;
                certificate.outcome()
            } else {
                solver.outcome_rigid(toss)?
            };
            faces[outcome as usize] += 1;
            Ok(())
        })?;
        Ok((faces[0], faces[1], faces[2], proven.then_some(stages)))
    }
}

/// The sign of cos θ.
fn sign(outcome: Outcome) -> i8 {
    // Not a match, which would not be vectorised.
    i8::from(outcome == Outcome::Heads) - i8::from(outcome == Outcome::Tails)
}
