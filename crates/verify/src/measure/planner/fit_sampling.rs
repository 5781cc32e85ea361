//! This file measures the errors and costs of the sampling models by the number of launches N, as an error C N^-p and a
//! cost per launch. From these the planner finds how many launches an accuracy needs.

use anyhow::Context;
use rayon::ThreadPool;
use sampling::{Plan, Sampler, Space};
use toss::fitted::SamplingFit;
use toss::{Model, Scene, Want};

use super::clock::{median, nanoseconds};
use super::delivered::true_probability;
use super::figures::{SAFETY, SEED, SHARE, rounded};
use super::fit_bodies;
use super::scenes::{self, served};
use crate::slope::slope;

/// Name of the model that integrates over the speed in closed form and takes Sobol points for everything else.
const SHARE_SOBOL: &str = "share-sobol";

/// Names of those for bodies that are no coins.
const OF_BODIES: [&str; 2] = ["body-sobol", "body-random"];

/// Names of the models whose error falls with the number of launches.
const SAMPLES: [&str; 3] = [SHARE_SOBOL, "sobol", "random"];

pub(super) fn sampling() -> anyhow::Result<Vec<SamplingFit>> {
    let mut spaces = Vec::new();
    for index in 0..60 {
        let space = scenes::space(SEED, index)?;
        let samples = served(&Scene::new(Want::Probability(space), f64::MAX))?;
        if samples.iter().any(|choice| choice.model.name == SHARE) {
            continue;
        }
        let with_shares = samples.iter().any(|choice| choice.model.name == SHARE_SOBOL);
        spaces.push((space, with_shares, true_probability(&space, 1 << 19)?));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().context("cannot start a thread")?;
    let fit = |name: &str| {
        let model = Model::named(name).with_context(|| format!("no model {name}"))?;
        let spaces = spaces.iter().filter(|(_, with_shares, _)| *with_shares || name != SHARE_SOBOL);
        Sample { model, spaces: spaces.map(|(space, _, truth)| (*space, *truth)).collect() }.fit(&pool)
    };
    let mut fits = SAMPLES.into_iter().map(fit).collect::<anyhow::Result<Vec<_>>>()?;
    let of_bodies = (0..16).map(|index| {
        let space = fit_bodies::space(index)?;
        Ok((space, true_probability(&space, 1 << 17)?))
    });
    let of_bodies = of_bodies.collect::<anyhow::Result<Vec<(Space, f64)>>>()?;
    for name in OF_BODIES {
        let model = Model::named(name).with_context(|| format!("no model {name}"))?;
        fits.push(Sample { model, spaces: of_bodies.clone() }.fit(&pool)?);
    }
    Ok(fits)
}

/// A sampling model, and the spaces on which it is measured with their probabilities of heads.
struct Sample {
    model: &'static Model,
    spaces: Vec<(Space, f64)>,
}

impl Sample {
    fn plan(&self, points: u64) -> anyhow::Result<Plan> {
        self.model.plan(points, SEED).with_context(|| format!("{} is no sampling model", self.model.name))
    }

    fn fit(&self, pool: &ThreadPool) -> anyhow::Result<SamplingFit> {
        let [error, power] = self.error()?;
        let (few, many) = (self.cost_ns(16, pool)?, self.cost_ns(1 << 12, pool)?);
        let launch_ns = rounded((many - few) / f64::from((1 << 12) - 16));
        let cost_ns = rounded((few - 16.0 * launch_ns).max(0.0));
        let (error, power) = (rounded(SAFETY * error), rounded(power));
        Ok(SamplingFit { model: self.model.name.to_owned(), cost_ns, launch_ns, error, power })
    }

    /// C and p of the error C N^-p. For independent launches p is ½; otherwise it is fitted by least squares to the
    /// root mean square errors over the spaces. C is the smallest with which no measured error is above C N^-p.
    #[expect(clippy::cast_precision_loss, reason = "dozens of spaces, thousands of launches")]
    fn error(&self) -> anyhow::Result<[f64; 2]> {
        let mut points = Vec::new();
        let mut all = Vec::new();
        for size in [6, 8, 10, 12, 14].map(|power| 1_u64 << power) {
            let mut squares = 0.0;
            for (space, truth) in &self.spaces {
                let error = (Sampler::exact().estimate(space, self.plan(size)?)?.probability - truth).abs();
                squares += error * error;
                all.push((size, error));
            }
            points.push([(size as f64).ln(), 0.5 * (squares / self.spaces.len() as f64).ln()]);
        }
        let is_independent = matches!(self.plan(1)?, Plan::Random { .. });
        let power = if is_independent { 0.5 } else { -slope(&points) };
        let error = all.iter().map(|(size, error)| error * (*size as f64).powf(power)).fold(0.0, f64::max);
        Ok([error, power])
    }

    /// The median cost (ns) of an estimate by `launches` launches.
    fn cost_ns(&self, launches: u64, pool: &ThreadPool) -> anyhow::Result<f64> {
        let plan = self.plan(launches)?;
        let cost = |(space, _): &(Space, f64)| pool.install(|| nanoseconds(|| Sampler::exact().estimate(space, plan)));
        Ok(median(self.spaces.iter().take(12).map(cost).collect()))
    }
}
