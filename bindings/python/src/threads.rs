//! Work on as many threads as are asked for, while Ctrl-C is listened for. Each call has threads of its own, so that nothing
//! is left behind that a process which forks could inherit.
//!
//! Python's main thread alone can hear a signal, and only if it asks. Work on its own columns is cut into short calls, and
//! between them it asks. Other work is done by a thread beside it, while it asks from time to time. Such work owns what it
//! works on, so that Ctrl-C leaves it to itself: it ends at the next of its blocks, and its result is dropped.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::{Failure, malformed};
use crate::given::count;

/// The largest number of threads.
const MOST_THREADS: usize = 1024;

/// Fewest launches for which a thread is worth its start.
pub(crate) const SMALLEST_PART: usize = 1 << 10;

/// Most launches of a call that proves outcomes: so few that it takes less than half a second, even if each of them lands on
/// its edge and is decided with many digits.
pub(crate) const A_PROOF: usize = 1 << 10;

/// Most launches of a call that proves nothing, for each of which it takes about as long.
pub(crate) const A_CALL: usize = 1 << 16;

/// The time between two questions for signals.
const A_WHILE: Duration = Duration::from_millis(50);

/// Whether some work is wanted no more.
#[derive(Clone, Default)]
pub(crate) struct Stop(Arc<AtomicBool>);

impl Stop {
    fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Ends the work here if it is wanted no more: unwinds to where it was begun, on all of its threads.
    pub(crate) fn here(&self) {
        if self.is_set() {
            resume_unwind(Box::new("stopped"));
        }
    }
}

/// The number of threads that an argument is; `None` for all cores.
pub(crate) fn threads_of(value: &Bound<'_, PyAny>) -> PyResult<Option<u64>> {
    if value.is_none() { Ok(None) } else { count("threads", value).map(Some) }
}

/// This number of threads, if there can be so many; 0 for one per core.
pub(crate) fn require(threads: Option<u64>) -> PyResult<usize> {
    match threads.map(|number| (number, usize::try_from(number))) {
        None => Ok(0),
        Some((_, Ok(number @ 1..=MOST_THREADS))) => Ok(number),
        Some((number, _)) => Err(malformed("threads", number, "1 to 1024, or None for one per core")),
    }
}

/// The pool of this many threads; of all cores for `None`.
pub(crate) fn pool(threads: Option<u64>) -> PyResult<rayon::ThreadPool> {
    let number = require(threads)?;
    let build = rayon::ThreadPoolBuilder::new().num_threads(number).build();
    // As Python says of its own threads, because no argument is at fault.
    build.map_err(|error| {
        PyRuntimeError::new_err(match number {
            0 => format!("cannot start a thread per core: {error}; try threads=1"),
            1 => format!("cannot start a thread: {error}"),
            _ => format!("cannot start {number} threads: {error}; try threads=1"),
        })
    })
}

/// The result of `work`, which a thread of its own does; or the exception of a signal. Where no thread can start, it is done here,
/// and signals wait for its end.
pub(crate) fn aside<R: Send + 'static, W>(py: Python<'_>, work: W) -> PyResult<R>
where
    W: FnOnce(&Stop) -> Result<R, Failure> + Send + 'static,
{
    let (stop, found) = (Stop::default(), Arc::new(Mutex::new(None)));
    let (of_work, place) = (stop.clone(), found.clone());
    done_aside(py, &stop, Box::new(move || done(&place, || work(&of_work))))?;
    taken(&found)
}

/// Work that leaves its result somewhere. Without its type, the machinery of threads is compiled once.
type Job = Box<dyn FnOnce() + Send>;

/// Waits for a thread of its own that does `job`, or returns the exception of a signal.
fn done_aside(py: Python<'_>, stop: &Stop, job: Job) -> PyResult<()> {
    let ((told, done), (give, take)) = (mpsc::channel(), mpsc::channel::<Job>());
    let start = thread::Builder::new().spawn(move || {
        take.into_iter().for_each(|job| {
            job();
            // Nobody may be there to hear it.
            let _ = told.send(());
        });
    });
    let Ok(_) = start else {
        py.detach(job);
        return Ok(());
    };
    drop(give.send(job));
    drop(give);
    py.detach(move || listening(stop, done))
}

/// Where the result of some work is left, or what it panicked with.
type Place<R> = Mutex<Option<thread::Result<Result<R, Failure>>>>;

fn done<R>(place: &Place<R>, work: impl FnOnce() -> Result<R, Failure>) {
    let result = catch_unwind(AssertUnwindSafe(work));
    *place.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
}

fn taken<R>(place: &Place<R>) -> PyResult<R> {
    let result = place.lock().unwrap_or_else(PoisonError::into_inner).take();
    let result = result.unwrap_or_else(|| Err(Box::new("the work has no answer")));
    Ok(result.unwrap_or_else(|panic| resume_unwind(panic))?)
}

/// Runs the handlers of the signals that have come; the exception is that of one of them, such as `KeyboardInterrupt`.
fn ask_for_signals(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// Waits until the work is done; or returns the exception of a signal, after which the work is to stop. It is called without
/// Python's lock.
fn listening(stop: &Stop, done: Receiver<()>) -> PyResult<()> {
    while let Err(RecvTimeoutError::Timeout) = done.recv_timeout(A_WHILE) {
        Python::attach(ask_for_signals).inspect_err(|_| stop.set())?;
    }
    Ok(())
}

/// The result of `work` on the threads of `pool`, or the exception of a signal. `work` borrows, and is waited for.
fn in_pool<R: Send>(pool: &rayon::ThreadPool, work: impl FnOnce(&Stop) -> Result<R, Failure> + Send) -> PyResult<R> {
    let (stop, found) = (Stop::default(), Mutex::new(None));
    let (told, end) = mpsc::channel();
    pool.in_place_scope(|scope| {
        let (of_work, place) = (&stop, &found);
        scope.spawn(move |_| {
            done(place, || work(of_work));
            let _ = told.send(());
        });
        listening(&stop, end)
    })?;
    taken(&found)
}

/// The results of `work` for parts of `0..launches`, done here one after the other, while signals are listened for.
fn here<R>(
    launches: usize,
    a_call: usize,
    mut work: impl FnMut(Range<usize>) -> Result<R, Failure>,
) -> PyResult<Vec<R>> {
    let mut asked = Instant::now();
    let starts = (0..launches).step_by(a_call);
    let part = |start: usize| {
        let done = work(start..launches.min(start + a_call))?;
        if asked.elapsed() > A_WHILE {
            Python::attach(ask_for_signals)?;
            asked = Instant::now();
        }
        Ok(done)
    };
    starts.map(part).collect()
}

/// Calls `work` with the parts of `out` and the launches that they belong to, `width` numbers for each launch and at most
/// `a_call` launches at a time, on all threads of `pool`, or here without one. The error is that of the first launch that has one, or of a signal.
pub(crate) fn fill<T: Send>(
    py: Python<'_>,
    pool: Option<&rayon::ThreadPool>,
    a_call: usize,
    out: &mut [T],
    width: usize,
    work: impl Fn(Range<usize>, &mut [T]) -> Result<(), Failure> + Sync,
) -> PyResult<()> {
    let launches = out.len() / width;
    py.detach(|| match pool {
        None => {
            let part = |range: Range<usize>| work(range.clone(), &mut out[range.start * width..range.end * width]);
            here(launches, a_call, part).map(drop)
        }
        Some(pool) => in_pool(pool, |stop| filled(Some(pool), stop, a_call, out, width, &work)),
    })
}

/// As [`fill`], but collects the counts of proven outcomes that `work` returns for the parts of so many `launches`, in their order.
pub(crate) fn collect<R: Send>(
    py: Python<'_>,
    pool: Option<&rayon::ThreadPool>,
    launches: usize,
    work: impl Fn(Range<usize>) -> Result<R, Failure> + Sync,
) -> PyResult<Vec<R>> {
    py.detach(|| match pool {
        None => here(launches, A_PROOF, &work),
        Some(pool) => in_pool(pool, |stop| collected(Some(pool), stop, A_PROOF, launches, &work)),
    })
}

/// As [`fill`], until it is stopped. No signal is listened for.
pub(crate) fn filled<T: Send>(
    pool: Option<&rayon::ThreadPool>,
    stop: &Stop,
    a_call: usize,
    out: &mut [T],
    width: usize,
    work: impl Fn(Range<usize>, &mut [T]) -> Result<(), Failure> + Sync,
) -> Result<(), Failure> {
    let part = |start: usize, out: &mut [T]| -> Result<(), Failure> {
        out.chunks_mut(a_call * width).enumerate().try_for_each(|(call, out)| {
            stop.here();
            let start = start + call * a_call;
            work(start..start + out.len() / width, out)
        })
    };
    let Some(pool) = pool else { return part(0, out) };
    let size = part_of(pool, out.len() / width);
    let parts = out.par_chunks_mut(size * width).enumerate();
    let done: Vec<_> = pool.install(|| parts.map(|(number, out)| part(number * size, out)).collect());
    done.into_iter().collect()
}

/// As [`collect`], in calls of at most so many launches, until it is stopped. No signal is listened for.
pub(crate) fn collected<R: Send>(
    pool: Option<&rayon::ThreadPool>,
    stop: &Stop,
    a_call: usize,
    launches: usize,
    work: impl Fn(Range<usize>) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let starts = (0..launches).step_by(a_call);
    let part = |start: usize| {
        stop.here();
        work(start..(start + a_call).min(launches))
    };
    let Some(pool) = pool else { return starts.map(part).collect() };
    let starts: Vec<usize> = starts.collect();
    let done: Vec<_> = pool.install(|| starts.into_par_iter().map(part).collect());
    done.into_iter().collect()
}

/// The launches of a part, of which each thread has some.
fn part_of(pool: &rayon::ThreadPool, launches: usize) -> usize {
    launches.div_ceil(4 * pool.current_num_threads()).max(SMALLEST_PART)
}
