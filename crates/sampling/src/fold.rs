//! Launches by blocks on many threads, with a result that does not depend on how many.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use dynamics::Error;
use rayon::prelude::*;

use crate::block::{BLOCK, Block};
use crate::launches::Launches;
use crate::space::Space;

/// What launches add up to. Merging is associative and commutative to the last bit, which is why the tallies of this
/// crate are integers.
pub(crate) trait Tally: Default + Send {
    fn merge(self, other: Self) -> Self;
}

/// Is called with the number of launches (or nodes of a map) done since it was last called.
pub type Progress<'a> = &'a (dyn Fn(u64) + Sync);

/// Merges what `add` makes of all blocks of the launches `range` of `space`, on the threads of the current pool.
///
/// # Errors
/// [`Error`] of `add`, whose launch is counted from the start of the sequence; of several failing launches always the first.
pub(crate) fn fold<T: Tally>(
    space: &Space,
    launches: &Launches,
    range: Range<u64>,
    progress: Progress<'_>,
    add: impl Fn(&Block) -> Result<T, Error> + Sync,
) -> Result<T, Error> {
    const LENGTH: u64 = BLOCK as u64;
    let lowest_failure = AtomicU64::new(u64::MAX);
    let run = |block: &mut Block, number: u64| -> Result<T, Error> {
        let start = range.start + number * LENGTH;
        // A block above the lowest failing launch so far can't hold the first.
        if start > lowest_failure.load(Ordering::Relaxed) {
            return Ok(T::default());
        }
        launches.write(start..range.end.min(start.saturating_add(LENGTH)), block);
        let tally = add(block).map_err(|error| error.after(start)).inspect_err(|error| {
            lowest_failure.fetch_min(index_of(error), Ordering::Relaxed);
        })?;
        progress(block.len() as u64);
        Ok(tally)
    };
    (0..(range.end - range.start).div_ceil(LENGTH)).into_par_iter().map_init(|| Block::new(space), run).reduce(
        || Ok(T::default()),
        |a, b| match (a, b) {
            (Ok(a), Ok(b)) => Ok(a.merge(b)),
            (Err(a), Err(b)) => Err(first(a, b)),
            (Err(error), Ok(_)) | (Ok(_), Err(error)) => Err(error),
        },
    )
}

/// The error of the launch that comes first.
fn first(a: Error, b: Error) -> Error {
    if index_of(&a) < index_of(&b) { a } else { b }
}

/// Number of the launch that failed.
fn index_of(error: &Error) -> u64 {
    match error {
        Error::Launch { index, .. } | Error::BadLaunch { index, .. } => *index,
        // An error of no launch comes before all launches.
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, SolveError, TimeOfFlight, Toss, Vector3};

    use super::*;
    use crate::counts::Counts;
    use crate::space::Cube;
    use crate::space_file::named_space;

    fn failed(index: u64, toss: &Toss) -> Error {
        Error::Launch { index, toss: Box::new(*toss), source: SolveError::NotFinite { time: 0.0 } }
    }

    #[test]
    fn of_two_failures_the_first_launch_counts() {
        let launch = Launch::new(Vector3::zeros(), TimeOfFlight::Given(0.0)).unwrap();
        let failure = |index| failed(index, &Toss { coin: Coin::PAPER, launch });
        assert_eq!((first(failure(3), failure(7)), first(failure(7), failure(3))), (failure(3), failure(3)));
    }

    #[test]
    fn nothing_is_tried_above_a_launch_that_failed() {
        let space = named_space("tails").unwrap();
        let launches = Launches::Random { cube: Cube::new(&space, space.free()), seed: 1 };
        let (tried, told) = (AtomicU64::new(0), AtomicU64::new(0));
        let toss = space.toss(&space.fixed_values());
        let add = |_: &Block| match tried.fetch_add(1, Ordering::Relaxed) {
            1 => Err(failed(7, &toss)),
            _ => Ok(Counts::default()),
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let progress = |more| _ = told.fetch_add(more, Ordering::Relaxed);
        let found = pool.install(|| fold(&space, &launches, 100..100_000, &progress, add));
        assert!(matches!(found, Err(Error::Launch { index: 619, .. })), "{found:?}");
        assert_eq!((tried.into_inner(), told.into_inner()), (2, 512));
    }
}
