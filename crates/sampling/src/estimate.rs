//! Methods A and B: counts of outcomes over a grid, or over random launches.
//!
//! Launch i of method B depends on the seed and on i only (a block cipher as random number generator, read at a
//! position that follows from i), so no count depends on the number of threads.

use std::sync::atomic::{AtomicU64, Ordering};

use dynamics::error::require;
use dynamics::{InputError, Outcome, SolveError, Solver, Toss};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

use crate::space::Space;

/// Launches that one thread takes at a time.
const BLOCK: u64 = 512;

/// Which launches of a space are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plan {
    /// Method A: the space's grid.
    Grid,
    /// Method B: `points` launches at random, uniform over the space.
    Random {
        /// Number of launches.
        points: u64,
        /// Seed of the random numbers.
        seed: u64,
    },
}

/// Outcomes, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Launches that land heads.
    pub heads: u64,
    /// Launches that land tails.
    pub tails: u64,
    /// Launches nearer to the edge than the solver answers for.
    pub undecided: u64,
}

impl Counts {
    /// Number of launches.
    pub fn points(&self) -> u64 {
        self.heads + self.tails + self.undecided
    }

    /// Share of heads among all launches, from 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub fn probability(&self) -> f64 {
        self.heads as f64 / self.points() as f64
    }

    fn add(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.undecided += 1,
        }
    }

    fn merge(self, other: Self) -> Self {
        Self {
            heads: self.heads + other.heads,
            tails: self.tails + other.tails,
            undecided: self.undecided + other.undecided,
        }
    }
}

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

/// Counts the outcomes of all launches of `plan` in `space`, by `solver`, on the threads of the current pool.
///
/// `progress` is told the number of launches done since it was last called.
///
/// # Errors
/// [`SampleError`]; of several failing launches always the first.
pub fn estimate(
    space: &Space,
    plan: Plan,
    solver: &dyn Solver,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Counts, SampleError> {
    match plan {
        Plan::Grid => {
            let points = space.grid_points()?;
            let toss_at = space.grid()?;
            count(points, solver, progress, |range| range.map(&toss_at))
        }
        Plan::Random { points, seed } => {
            #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
            require("points", points as f64, "at least 1", points >= 1)?;
            count(points, solver, progress, |range| random_tosses(space, seed, range))
        }
    }
}

/// Launches `range` of the random sequence of `seed`: each depends on the seed and its own index only.
pub fn random_tosses(space: &Space, seed: u64, range: std::ops::Range<u64>) -> impl Iterator<Item = Toss> {
    const WORDS_PER_NUMBER: u128 = 2;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_word_pos(u128::from(range.start) * Space::DIMENSIONS as u128 * WORDS_PER_NUMBER);
    range.map(move |_| space.at(std::array::from_fn(|_| rng.random::<f64>())))
}

/// Index and toss of a launch that could not be solved, and why.
type Failure = (u64, Toss, SolveError);

/// Counts outcomes block by block. Blocks above the lowest failing launch so far are skipped: they can't be first.
fn count<I: Iterator<Item = Toss>>(
    points: u64,
    solver: &dyn Solver,
    progress: &(dyn Fn(u64) + Sync),
    tosses: impl Fn(std::ops::Range<u64>) -> I + Sync,
) -> Result<Counts, SampleError> {
    let lowest_failure = AtomicU64::new(u64::MAX);
    let block = |number: u64| -> Result<Counts, Failure> {
        let range = number * BLOCK..points.min((number + 1).saturating_mul(BLOCK));
        let mut counts = Counts::default();
        if range.start > lowest_failure.load(Ordering::Relaxed) {
            return Ok(counts);
        }
        for (index, toss) in range.clone().zip(tosses(range.clone())) {
            let outcome = solver.outcome(&toss).map_err(|error| {
                lowest_failure.fetch_min(index, Ordering::Relaxed);
                (index, toss, error)
            })?;
            counts.add(outcome);
        }
        progress(range.end - range.start);
        Ok(counts)
    };
    let first_failure_or_sum = |a: Result<Counts, Failure>, b: Result<Counts, Failure>| match (a, b) {
        (Ok(a), Ok(b)) => Ok(Counts::merge(a, b)),
        (Err(a), Ok(_)) => Err(a),
        (Ok(_), Err(b)) => Err(b),
        (Err(a), Err(b)) => Err(if a.0 < b.0 { a } else { b }),
    };
    (0..points.div_ceil(BLOCK))
        .into_par_iter()
        .map(block)
        .reduce(|| Ok(Counts::default()), first_failure_or_sum)
        .map_err(|(index, toss, source)| SampleError::Solve { index, toss: Box::new(toss), source })
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, ExactSolver, Propagation};

    use super::*;
    use crate::space::{named_space, parse_space};

    fn silent(_: u64) {}

    #[test]
    fn launch_i_depends_on_seed_and_i_only() {
        let space = parse_space(Coin::PAPER, ["0:50", "0:50", "0:50", "3:5"], 9.81).unwrap();
        let all: Vec<Toss> = random_tosses(&space, 7, 0..1000).collect();
        for (start, end) in [(0, 1), (1, 4), (511, 513), (999, 1000)] {
            let part: Vec<Toss> = random_tosses(&space, 7, start..end).collect();
            assert_eq!(part, all[start as usize..end as usize]);
        }
        assert_ne!(random_tosses(&space, 8, 0..1).next(), Some(all[0]));
    }

    #[test]
    fn counts_are_the_same_for_any_number_of_threads() {
        let space = named_space("paper-fig4").unwrap();
        for plan in [Plan::Grid, Plan::Random { points: 30_001, seed: 3 }] {
            let counts = [1, 2, 8].map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| estimate(&space, plan, &ExactSolver, &silent)).unwrap()
            });
            assert!(counts.iter().all(|count| *count == counts[0]), "{counts:?}");
        }
    }

    #[test]
    fn progress_adds_up_to_the_number_of_launches() {
        let done = AtomicU64::new(0);
        let space = named_space("tails").unwrap();
        let plan = Plan::Random { points: 1234, seed: 1 };
        let counts = estimate(&space, plan, &ExactSolver, &|more| _ = done.fetch_add(more, Ordering::Relaxed)).unwrap();
        assert_eq!((done.into_inner(), counts.points()), (1234, 1234));
    }

    #[test]
    fn no_points_are_refused() {
        let space = named_space("tails").unwrap();
        let plan = Plan::Random { points: 0, seed: 1 };
        assert!(matches!(estimate(&space, plan, &ExactSolver, &silent), Err(SampleError::Input(_))));
    }

    /// Fails on every speed above 4 m/s.
    struct Fragile;
    impl Solver for Fragile {
        fn name(&self) -> &'static str {
            "fragile"
        }
        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            let time = toss.launch.flight_time();
            if time > 8.0 / 9.81 { Err(SolveError::NotFinite { time }) } else { ExactSolver.propagate(toss) }
        }
    }

    #[test]
    fn the_first_failing_launch_is_named_and_no_count_given() {
        let space = parse_space(Coin::PAPER, ["1", "1", "1", "3:5:20001"], 9.81).unwrap();
        for threads in [1, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let error = pool.install(|| estimate(&space, Plan::Grid, &Fragile, &silent)).unwrap_err();
            assert!(matches!(error, SampleError::Solve { index: 10_001, .. }), "{error}");
        }
    }
}
