//! This file times whole estimates of P(heads): launches are made, their outcomes proven and counted. The cost of
//! making and counting launches is not part of the times of the kernels.

use anyhow::Context;
use rayon::ThreadPoolBuilder;
use sampling::{Coordinate, Plan, Sampler, Space, named_space};
use toss::Coin;

use super::contest::Contest;

const LAUNCH: &str = "launch of a space, made, proven and counted";

/// Estimates by a grid and by random launches, over the space of the paper's Fig. 4 and over the box of launches that
/// the other benchmarks solve, on one thread and on all.
pub(super) fn contests<'a>() -> anyhow::Result<Vec<Contest<'a>>> {
    use Coordinate::{RateX, RateY, RateZ, Speed};
    let texts = [(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5")];
    let boxed = Space::parse(Coin::PAPER, &texts)?.with_grid_of(1 << 21)?;
    let fig4 = named_space("paper-fig4")?;
    let random = Plan::Random { points: 1 << 21, seed: 1 };
    let cases =
        [("Fig. 4", fig4, Plan::Grid), ("box", boxed, Plan::Grid), ("Fig. 4", fig4, random), ("box", boxed, random)];
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut contests = Vec::new();
    for (name, space, plan) in cases {
        for threads in [1, all] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start the threads")?;
            let points = usize::try_from(plan.points(&space)?)?;
            let run = move || {
                let found = pool.install(|| Sampler::exact().estimate(&space, plan));
                std::hint::black_box(found.expect("valid launches"));
            };
            let way = if plan == Plan::Grid { "grid" } else { "random" };
            let name = format!("{name}, {way}, threads: {threads}");
            contests.push(Contest { group: LAUNCH, name, error: None, tosses: points, run: Box::new(run) });
        }
    }
    Ok(contests)
}
