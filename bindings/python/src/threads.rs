//! Work on as many threads as are asked for. Each call has threads of its own, so that nothing is left behind that a
//! process which forks could inherit.

use std::ops::Range;

use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::{Failure, malformed};

/// The largest number of threads.
const MOST_THREADS: usize = 1024;

/// Fewest launches for which a thread is worth its start.
const SMALLEST_PART: usize = 1 << 10;

/// The pool of this many threads; of all cores for `None`.
pub(crate) fn pool(threads: Option<usize>) -> PyResult<rayon::ThreadPool> {
    let number = match threads {
        None => 0,
        Some(number @ 1..=MOST_THREADS) => number,
        Some(number) => return Err(malformed("threads", number, "1 to 1024, or None for one per core")),
    };
    let build = rayon::ThreadPoolBuilder::new().num_threads(number).build();
    build.map_err(|error| malformed("threads", error, "as many threads as the system can start"))
}

/// Calls `work` with the parts of `out` and the launches that they belong to, `width` numbers for each launch, on all
/// threads of `pool`, or here without one. The error is that of the first launch that has one.
pub(crate) fn fill<T: Send>(
    pool: Option<&rayon::ThreadPool>,
    out: &mut [T],
    width: usize,
    work: impl Fn(Range<usize>, &mut [T]) -> Result<(), Failure> + Sync,
) -> Result<(), Failure> {
    let launches = out.len() / width;
    let Some(pool) = pool else { return work(0..launches, out) };
    let size = launches.div_ceil(4 * pool.current_num_threads()).max(SMALLEST_PART);
    let parts = out.par_chunks_mut(size * width).enumerate();
    let done: Vec<_> =
        pool.install(|| parts.map(|(part, out)| work(part * size..part * size + out.len() / width, out)).collect());
    done.into_iter().collect()
}

/// As [`fill`], but collects what `work` returns for each part of this many `launches`, in their order.
pub(crate) fn collect<R: Send>(
    pool: Option<&rayon::ThreadPool>,
    launches: usize,
    work: impl Fn(Range<usize>) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let Some(pool) = pool else { return work(0..launches).map(|one| vec![one]) };
    let size = launches.div_ceil(4 * pool.current_num_threads()).max(SMALLEST_PART);
    let starts: Vec<usize> = (0..launches).step_by(size).collect();
    let done: Vec<_> =
        pool.install(|| starts.into_par_iter().map(|start| work(start..(start + size).min(launches))).collect());
    done.into_iter().collect()
}
