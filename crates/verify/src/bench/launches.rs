//! This file times whole estimates of P(heads): launches are made, their outcomes proven and counted. The cost of
//! making and counting launches is not part of the times of the kernels.

use anyhow::Context;
use rayon::ThreadPoolBuilder;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::{Plan, Rest, Sampler, Scrambled, Space, named_space};
use toss::{Coin, InputError};

use super::contest::Contest;

const LAUNCH: &str = "launch of a space, made, proven and counted";

const ENCLOSURE: &str = "P(heads) by enclosure, a whole estimate";

/// The paper's coin with rates from 1 to 60 rad/s on each axis and speeds from 3 to 5 m/s.
pub(super) fn box_of_launches() -> Result<Space, InputError> {
    Space::parse(Coin::PAPER, &[(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5")])
}

/// Estimates by each method over the space of the paper's Fig. 4 and over the box of launches, on one thread and on all. Of
/// enclosure nobody chooses the number of shares, so that its times are those of whole estimates.
pub(super) fn contests<'a>() -> anyhow::Result<Vec<Contest<'a>>> {
    let boxed = box_of_launches()?.with_grid_of(1 << 21)?;
    let fig4 = named_space("paper-fig4")?;
    let plans = [
        ("grid", Plan::Grid),
        ("random", Plan::Random { points: 1 << 21, seed: 1 }),
        ("Sobol", Plan::Sobol(Scrambled::new(1 << 20, 1))),
        ("exact-speed", Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 17, 1)))),
    ];
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut contests = Vec::new();
    for (way, plan) in plans {
        for (name, space) in [("Fig. 4", fig4), ("box", boxed)] {
            for threads in [1, all] {
                let points = usize::try_from(plan.points(&space)?)?;
                contests.push(contest(LAUNCH, &format!("{name}, {way}"), points, (space, plan), threads)?);
            }
        }
    }
    for (name, space, accuracy) in [("Fig. 4", fig4, 1e-10), ("box", box_of_launches()?, 1e-3)] {
        let name = format!("{name}, to {accuracy:e}");
        contests.push(contest(ENCLOSURE, &name, 1, (space, Plan::Enclosure { accuracy }), 1)?);
    }
    Ok(contests)
}

fn contest<'a>(
    group: &'static str,
    name: &str,
    tosses: usize,
    (space, plan): (Space, Plan),
    threads: usize,
) -> anyhow::Result<Contest<'a>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start the threads")?;
    let run = move || {
        let found = pool.install(|| Sampler::exact().estimate(&space, plan));
        std::hint::black_box(found.expect("valid launches and an accuracy within reach"));
    };
    Ok(Contest { group, name: format!("{name}, threads: {threads}"), error: None, tosses, run: Box::new(run) })
}
