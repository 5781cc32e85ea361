//! This file estimates P(heads) of every named space by every sampling method.

use sampling::{Estimate, Plan, Rest, Sampler, Scrambled, named_spaces};

/// Number of independent random launches, the paper's method B.
const RANDOM_LAUNCHES: u64 = 250_000;
/// Seed of the random launches and of the scrambles.
const SEED: u64 = 1;

const METHODS: [(&str, Plan); 4] = [
    ("grid", Plan::Grid),
    ("random", Plan::Random { points: RANDOM_LAUNCHES, seed: SEED }),
    ("sobol", Plan::Sobol(Scrambled { points: 1 << 18, scrambles: 8, seed: SEED })),
    ("exact-speed", Plan::ExactSpeed(Rest::Grid)),
];

/// Estimates every named space by every method with the exact motion: the name of the space, that of the method, and what
/// it found.
pub fn tables() -> anyhow::Result<Vec<(&'static str, &'static str, Estimate)>> {
    let mut lines = Vec::new();
    for (space, named) in named_spaces() {
        for (method, plan) in METHODS {
            lines.push((space, method, Sampler::exact().estimate(&named.space, plan)?));
        }
    }
    Ok(lines)
}
