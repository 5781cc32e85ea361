//! This file times whole estimates of P(heads): launches are made, their outcomes proven and counted. The cost of
//! making and counting launches is not part of the times of the kernels.

use anyhow::Context;
use rayon::ThreadPoolBuilder;
use sampling::{Plan, Rest, Sampler, Scrambled, Space, named_space};

use super::contest::Contest;
use crate::spaces::box_of_launches;

const LAUNCH: &str = "launch of a space, made, proven and counted";

const ENCLOSURE: &str = "P(heads) by enclosure, a whole estimate";

/// Estimates by each method over the space of the paper's Fig. 4 and over the box of launches, on one thread and on all.
pub(super) fn contests<'a>() -> anyhow::Result<Vec<Contest<'a>>> {
    let boxed = box_of_launches()?.with_grid_of(1 << 21)?;
    let fig4 = named_space("paper-fig4")?;
    let plans = [
        ("grid", Plan::Grid),
        ("random", Plan::Random { points: 1 << 21, seed: 1 }),
        ("Sobol", Plan::Sobol(Scrambled::new(1 << 20, 1))),
        ("exact-speed", Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 17, 1)))),
    ];
    let cases = plans.into_iter().flat_map(|(way, plan)| [("Fig. 4", fig4, way, plan), ("box", boxed, way, plan)]);
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut contests = Vec::new();
    for (name, space, way, plan) in cases {
        for threads in [1, all] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start the threads")?;
            let points = usize::try_from(plan.points(&space)?)?;
            let run = move || {
                let found = pool.install(|| Sampler::exact().estimate(&space, plan));
                std::hint::black_box(found.expect("valid launches"));
            };
            let name = format!("{name}, {way}, threads: {threads}");
            contests.push(Contest { group: LAUNCH, name, error: None, tosses: points, run: Box::new(run) });
        }
    }
    contests.extend(rules()?);
    Ok(contests)
}

/// Estimates by enclosure, whose number of shares nobody chooses, so that their times are those of whole estimates.
fn rules<'a>() -> anyhow::Result<Vec<Contest<'a>>> {
    let pool = || ThreadPoolBuilder::new().num_threads(1).build().context("cannot start the threads");
    let cases = [("Fig. 4", named_space("paper-fig4")?, 1e-10), ("box", box_of_launches()?, 1e-3)];
    let contest = |(name, space, accuracy): (&str, Space, f64)| {
        let (pool, plan) = (pool()?, Plan::Enclosure { accuracy });
        let run = move || {
            let found = pool.install(|| Sampler::exact().estimate(&space, plan));
            std::hint::black_box(found.expect("an accuracy within reach"));
        };
        let name = format!("{name}, to {accuracy:e}, threads: 1");
        Ok(Contest { group: ENCLOSURE, name, error: None, tosses: 1, run: Box::new(run) })
    };
    cases.into_iter().map(contest).collect()
}
