//! How far ways to sample a space are off and what they cost, by the number of launches.

use anyhow::Context;
use sampling::{Space, estimate};
use toss::fitted::SamplingFit;
use toss::space_plan::plan;
use toss::{ExactSolver, Model, Scene, Want};

use super::clock::{median, nanoseconds};
use super::delivered::true_probability;
use super::figures::{SAFETY, SEED, rounded};
use super::scenes::{self, served};
use crate::slope::slope;

pub(super) fn sampling() -> anyhow::Result<Vec<SamplingFit>> {
    let mut spaces = Vec::new();
    for index in 0..60 {
        let space = scenes::space(SEED, index)?;
        let samples = served(&Scene::new(Want::Probability(space), f64::MAX))?;
        if samples.iter().any(|choice| choice.model == Model::Share) {
            continue;
        }
        let with_shares = samples.iter().any(|choice| choice.model == Model::ShareSobol);
        spaces.push((space, with_shares, true_probability(&space, 1 << 19)?));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().context("one thread")?;
    [Model::ShareSobol, Model::Sobol, Model::Random]
        .map(|model| way_to_sample(model, &spaces, &pool))
        .into_iter()
        .collect()
}

/// The error C N^-p: p by least squares through the root mean squares over the spaces, C so that every error is below.
fn way_to_sample(model: Model, spaces: &[(Space, bool, f64)], pool: &rayon::ThreadPool) -> anyhow::Result<SamplingFit> {
    let spaces: Vec<_> = spaces.iter().filter(|(_, shares, _)| *shares || model != Model::ShareSobol).collect();
    let sizes = [6, 8, 10, 12, 14].map(|power| 1_u64 << power);
    let mut points = Vec::new();
    let mut all = Vec::new();
    for size in sizes {
        let mut squares = 0.0;
        for (space, _, truth) in &spaces {
            let error = (estimate(space, plan(model, size, SEED), &ExactSolver, &|_| {})?.probability - truth).abs();
            squares += error * error;
            all.push((size, error));
        }
        #[expect(clippy::cast_precision_loss, reason = "dozens of spaces, thousands of launches")]
        points.push([(size as f64).ln(), 0.5 * (squares / spaces.len() as f64).ln()]);
    }
    let power = if model == Model::Random { 0.5 } else { -slope(&points) };
    #[expect(clippy::cast_precision_loss, reason = "thousands of launches")]
    let error = all.iter().map(|(size, error)| error * (*size as f64).powf(power)).fold(0.0, f64::max);
    let cost = |size| {
        let costs = spaces.iter().take(12).map(|(space, ..)| {
            pool.install(|| nanoseconds(|| estimate(space, plan(model, size, SEED), &ExactSolver, &|_| {})))
        });
        median(costs.collect())
    };
    let (few, many) = (cost(16), cost(1 << 12));
    let launch_ns = rounded((many - few) / f64::from((1 << 12) - 16));
    let cost_ns = rounded((few - 16.0 * launch_ns).max(0.0));
    Ok(SamplingFit { model, cost_ns, launch_ns, error: rounded(SAFETY * error), power: rounded(power) })
}
