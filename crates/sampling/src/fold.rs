//! Launches by blocks on many threads, with a result that does not depend on how many.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use dynamics::{InputError, SolveError, Toss};
use rayon::prelude::*;

use crate::block::{BLOCK, Block};
use crate::launches::Launches;
use crate::space::Space;

/// Why a probability could not be estimated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SampleError {
    /// The space or the plan makes no sense; no launch was tried.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The solver failed; the first failing launch is named, and no count is given.
    #[error("launch {index} (rate {}, {}, {} rad/s, {} s): {source}",
        toss.launch.rate().x, toss.launch.rate().y, toss.launch.rate().z, toss.launch.flight_time())]
    Solve {
        /// Index of the launch in the plan.
        index: u64,
        /// The toss.
        toss: Box<Toss>,
        /// What the solver said.
        source: SolveError,
    },
}

impl SampleError {
    /// The same error of a sequence that begins with launch number `first`.
    pub(crate) fn later(self, first: u64) -> Self {
        match self {
            Self::Input(_) => self,
            Self::Solve { index, toss, source } => Self::Solve { index: first + index, toss, source },
        }
    }
}

/// What launches add up to. Merging is associative and commutative to the last bit, which is why the tallies of this
/// crate are integers.
pub(crate) trait Tally: Default + Send {
    fn merge(self, other: Self) -> Self;
}

/// The index of a launch in its sequence, the toss, and why it could not be solved.
pub(crate) type Failure = (u64, Box<Toss>, SolveError);

/// Is told how many launches (or nodes of a map) were done since it was last called.
pub type Progress<'a> = &'a (dyn Fn(u64) + Sync);

/// Merges what `add` makes of all blocks of the launches `range` of `space`, on the threads of the current pool. It is told
/// the number of a block's first launch.
///
/// # Errors
/// [`SampleError::Solve`]; of several failing launches always the first.
pub(crate) fn fold<T: Tally>(
    space: &Space,
    launches: &Launches,
    range: Range<u64>,
    progress: Progress<'_>,
    add: impl Fn(u64, &Block) -> Result<T, Failure> + Sync,
) -> Result<T, SampleError> {
    const LENGTH: u64 = BLOCK as u64;
    let lowest_failure = AtomicU64::new(u64::MAX);
    let run = |block: &mut Block, number: u64| -> Result<T, Failure> {
        let start = range.start + number * LENGTH;
        // A block above the lowest failing launch so far can't hold the first.
        if start > lowest_failure.load(Ordering::Relaxed) {
            return Ok(T::default());
        }
        launches.write(start..range.end.min(start.saturating_add(LENGTH)), block);
        let tally = add(start, block).inspect_err(|(index, ..)| {
            lowest_failure.fetch_min(*index, Ordering::Relaxed);
        })?;
        progress(block.len() as u64);
        Ok(tally)
    };
    (0..(range.end - range.start).div_ceil(LENGTH))
        .into_par_iter()
        .map_init(|| Block::new(space), run)
        .reduce(
            || Ok(T::default()),
            |a, b| match (a, b) {
                (Ok(a), Ok(b)) => Ok(a.merge(b)),
                (Err(a), Err(b)) => Err(first(a, b)),
                (Err(failure), Ok(_)) | (Ok(_), Err(failure)) => Err(failure),
            },
        )
        .map_err(|(index, toss, source)| SampleError::Solve { index, toss, source })
}

/// The failure of the launch that comes first.
fn first(a: Failure, b: Failure) -> Failure {
    if a.0 < b.0 { a } else { b }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Vector3};

    use super::*;
    use crate::counts::Counts;
    use crate::space::Cube;
    use crate::space_file::named_space;

    #[test]
    fn of_two_failures_the_first_launch_counts() {
        let launch = Launch::new(Vector3::zeros(), TimeOfFlight::Given(0.0)).unwrap();
        let toss = Box::new(Toss { coin: Coin::PAPER, launch });
        let failure = |index| (index, toss.clone(), SolveError::NotFinite { time: 0.0 });
        assert_eq!((first(failure(3), failure(7)).0, first(failure(7), failure(3)).0), (3, 3));
    }

    #[test]
    fn nothing_is_tried_above_a_launch_that_failed() {
        let space = named_space("tails").unwrap();
        let launches = Launches::Random { cube: Cube::new(&space, space.free()), seed: 1 };
        let (tried, told) = (AtomicU64::new(0), AtomicU64::new(0));
        let toss = space.toss(&space.fixed_values());
        let add = |first: u64, _: &Block| match tried.fetch_add(1, Ordering::Relaxed) {
            1 => Err((first + 7, Box::new(toss), SolveError::NotFinite { time: 0.0 })),
            _ => Ok(Counts::default()),
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let progress = |more| _ = told.fetch_add(more, Ordering::Relaxed);
        let found = pool.install(|| fold(&space, &launches, 100..100_000, &progress, add));
        assert!(matches!(found, Err(SampleError::Solve { index: 619, .. })), "{found:?}");
        assert_eq!((tried.into_inner(), told.into_inner()), (2, 512));
    }
}
