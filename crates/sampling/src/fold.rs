//! This file processes launches in blocks and merges the results, on many threads with the feature `rayon` and on one
//! without it. It guarantees that result and error do not depend on the number of threads.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use dynamics::Error;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::block::{BLOCK, Block};
use crate::interval::Interval;
use crate::launches::Launches;
use crate::space::Space;

/// A sum over launches. Merging must be associative and commutative to the last bit, which is why the sums of this
/// crate are integers.
pub(crate) trait Sum: Default + Send {
    fn merge(self, other: Self) -> Self;
}

/// A function that is called with the number of launches (or nodes of a map) done since it was last called. It may unwind,
/// as by [`std::panic::resume_unwind`], which ends the work on all threads.
pub type Progress<'a> = &'a (dyn Fn(u64) + Sync);

/// A function that is called with each interval of an [enclosure](crate::enclosure) that is narrower than those before. It may
/// unwind as [`Progress`] may.
pub type Narrowed<'a> = &'a (dyn Fn(Interval) + Sync);

/// Whether to come to an end, which is asked again and again. What is known by then is the answer, where there is one.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// What watches over the launches of a sum.
pub(crate) type Watch<'a> = (Progress<'a>, Stop<'a>);

/// Calls `add` for all blocks of the launches with the numbers `range`, on the threads of the current pool if there are
/// threads, and merges the sums. After a stop no block is begun: the sum then is of fewer launches.
///
/// # Errors
/// The [`Error`] of `add`, with the launch numbered from the start of the sequence. If several launches fail, it is
/// always the error of the first.
pub(crate) fn fold<T: Sum>(
    space: &Space,
    launches: &Launches,
    range: Range<u64>,
    (progress, stop): Watch<'_>,
    add: impl Fn(&Block) -> Result<T, Error> + Sync,
) -> Result<T, Error> {
    const LENGTH: u64 = BLOCK as u64;
    let lowest_failure = AtomicU64::new(u64::MAX);
    let run = |block: &mut Block, number: u64| -> Result<T, Error> {
        let start = range.start + number * LENGTH;
        // A block that starts after a failing launch can't contain the first one.
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
    let blocks = 0..(range.end - range.start).div_ceil(LENGTH);
    #[cfg(feature = "rayon")]
    return blocks
        .into_par_iter()
        .take_any_while(|_| !stop())
        .panic_fuse()
        .map_init(|| Block::new(space), run)
        .reduce(|| Ok(T::default()), merged);
    #[cfg(not(feature = "rayon"))]
    {
        let mut block = Block::new(space);
        blocks.take_while(|_| !stop()).map(|number| run(&mut block, number)).fold(Ok(T::default()), merged)
    }
}

/// The sum of two tallies, or the error of the launch that comes first.
fn merged<T: Sum>(a: Result<T, Error>, b: Result<T, Error>) -> Result<T, Error> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok(a.merge(b)),
        (Err(a), Err(b)) => Err(first(a, b)),
        (Err(error), Ok(_)) | (Ok(_), Err(error)) => Err(error),
    }
}

/// The error of the launch that comes first.
fn first(a: Error, b: Error) -> Error {
    if index_of(&a) < index_of(&b) { a } else { b }
}

/// Number of the launch that failed.
fn index_of(error: &Error) -> u64 {
    match error {
        Error::Launch { index, .. } | Error::BadLaunch { index, .. } => *index,
        // An error without a launch takes precedence over those of launches.
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

    use dynamics::{Coin, CoinToss, Launch, SolveError, TimeOfFlight, Toss};

    use super::*;
    use crate::coordinate::Coordinate;
    use crate::counts::Counts;
    use crate::plan::{Plan, Rest, Scrambled};
    use crate::sampler::Sampler;
    use crate::space::Cube;
    use crate::space_file::named_space;

    fn failed(index: u64, toss: impl Into<Toss>) -> Error {
        Error::Launch { index, toss: Box::new(toss.into()), source: SolveError::NotFinite { time: 0.0 } }
    }

    #[test]
    fn of_two_failures_the_earlier_launch_is_reported() {
        let launch = Launch::new([0.0; 3], TimeOfFlight::Given(0.0)).unwrap();
        let failure = |index| failed(index, CoinToss { coin: Coin::PAPER, launch });
        assert_eq!((first(failure(3), failure(7)), first(failure(7), failure(3))), (failure(3), failure(3)));
    }

    #[test]
    fn a_progress_that_unwinds_ends_the_work() {
        let space = named_space("tails").unwrap();
        let launches = Launches::Random { cube: Cube::new(&space, space.free()), seed: 1 };
        let tried = AtomicU64::new(0);
        let add = |_: &Block| {
            tried.fetch_add(1, Ordering::Relaxed);
            Ok(Counts::default())
        };
        let progress = |_| {
            if tried.load(Ordering::Relaxed) >= 5 {
                resume_unwind(Box::new("enough"));
            }
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
        let work = || pool.install(|| fold(&space, &launches, 0..1 << 44, (&progress, &|| false), add));
        let end = catch_unwind(AssertUnwindSafe(work)).unwrap_err();
        assert_eq!(end.downcast_ref::<&str>(), Some(&"enough"));
        // Each thread may have begun a block before it knew.
        assert!((5..=9).contains(&tried.load(Ordering::Relaxed)), "{tried:?}");
    }

    /// Of independent launches, fewer are an answer as well; whatever else is counted has none before its end.
    #[test]
    fn a_stop_leaves_what_was_counted() {
        let space = named_space("tails").unwrap();
        let told = AtomicU64::new(0);
        let progress = |more| _ = told.fetch_add(more, Ordering::Relaxed);
        let stop = || told.load(Ordering::Relaxed) >= 5 * BLOCK as u64;
        let sampler = Sampler::exact().on_progress(&progress).until(&stop);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        let plan = |points| Plan::Random { points, seed: 1 };
        let found = pool.install(|| sampler.estimate(&space, plan(1 << 40))).unwrap();
        assert!((5 * BLOCK as u64..=8 * BLOCK as u64).contains(&found.points), "{found:?}");
        assert_eq!(found.plan, plan(found.points));
        let ended = |plan| assert_eq!(sampler.estimate(&space, plan), Err(Error::Ended), "{plan:?}");
        ended(Plan::Sobol(Scrambled::new(1 << 14, 1)));
        ended(Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 14, 1))));
        assert_eq!(sampler.tally(&space, plan(1 << 20), 0..1 << 20), Err(Error::Ended));
        // A grid of 600 launches, in steps of 200: a step that is cut short is left out.
        let grid = Space::parse(
            Coin::PAPER,
            &[
                (Coordinate::RateX, "1:60:3000"),
                (Coordinate::RateY, "4"),
                (Coordinate::RateZ, "7"),
                (Coordinate::Speed, "3"),
            ],
        )
        .unwrap();
        told.store(0, Ordering::Relaxed);
        let steps = pool.install(|| sampler.running_shares(&grid, 3, 1)).unwrap();
        assert_eq!(steps.iter().map(|step| step.launches).collect::<Vec<_>>(), [1000]);
    }

    #[test]
    fn blocks_after_a_failed_launch_are_skipped() {
        let space = named_space("tails").unwrap();
        let launches = Launches::Random { cube: Cube::new(&space, space.free()), seed: 1 };
        let (tried, told) = (AtomicU64::new(0), AtomicU64::new(0));
        let toss = space.toss(&space.fixed_values());
        let add = |_: &Block| match tried.fetch_add(1, Ordering::Relaxed) {
            1 => Err(failed(7, toss)),
            _ => Ok(Counts::default()),
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let progress = |more| _ = told.fetch_add(more, Ordering::Relaxed);
        let found = pool.install(|| fold(&space, &launches, 100..100_000, (&progress, &|| false), add));
        assert!(matches!(found, Err(Error::Launch { index: 619, .. })), "{found:?}");
        assert_eq!((tried.into_inner(), told.into_inner()), (2, 512));
    }
}
