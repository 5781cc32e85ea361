//! This file measures quadrature by the roughness of a space and the accuracy: how many shares it takes, and
//! what a share costs. From these the planner finds whether a sample is cheaper.

use anyhow::Context;
use rayon::ThreadPool;
use sampling::quadrature::{Roughness, roughness};
use sampling::{Plan, Sampler, Space};
use toss::Error;
use toss::fitted::QuadratureFit;

use super::clock::{median, nanoseconds};
use super::figures::{SEED, rounded};
use super::scenes;
use crate::slope::slope;
use crate::spaces::box_of_launches;

/// The accuracies that are asked for.
fn accuracies() -> impl Iterator<Item = f64> {
    (2..=11).map(|decade| 10_f64.powi(-decade))
}

/// One estimate: the space's parts, the accuracy, and the number of shares.
struct Run {
    parts: f64,
    accuracy: f64,
    shares: f64,
}

/// An entry for each kind of space that a plan can meet.
pub(super) fn quadrature() -> anyhow::Result<Vec<QuadratureFit>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().context("cannot start a thread")?;
    let mut spaces = vec![box_of_launches()?, sampling::named_space("paper-fig4")?];
    for index in 0..160 {
        spaces.push(scenes::space(SEED, index)?);
    }
    let rough = |space: Space| Some((roughness(&space).ok()?, space));
    let spaces: Vec<(Roughness, Space)> = spaces.into_iter().filter_map(rough).collect();
    let kinds = [(1, false), (1, true), (2, false), (2, true)];
    kinds.into_iter().map(|kind| fit(kind, &spaces, &pool)).collect()
}

fn fit(
    (coordinates, has_root): (usize, bool),
    spaces: &[(Roughness, Space)],
    pool: &ThreadPool,
) -> anyhow::Result<QuadratureFit> {
    let (mut runs, mut costs, mut finest) = (Vec::new(), Vec::new(), 0.0_f64);
    for (rough, space) in spaces.iter().filter(|(of, _)| (of.coordinates, of.has_root) == (coordinates, has_root)) {
        let (all, reached) = runs_over(space, rough.parts)?;
        if let Some(run) = all.first() {
            let plan = Plan::Quadrature { accuracy: run.accuracy };
            costs.push(pool.install(|| nanoseconds(|| Sampler::exact().estimate(space, plan))) / run.shares);
        }
        runs.extend(all);
        finest = finest.max(reached);
    }
    let logs: Vec<[f64; 2]> = runs.iter().map(|run| [run.accuracy.ln(), (run.shares / run.parts).ln()]).collect();
    let power = rounded((-slope(&logs)).max(0.0));
    let reduced: Vec<f64> = runs.iter().map(|run| run.shares / run.parts * run.accuracy.powf(power)).collect();
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    let shares = rounded(reduced.iter().sum::<f64>() / reduced.len() as f64);
    Ok(QuadratureFit { coordinates, has_root, share_ns: rounded(median(costs)), shares, power, finest })
}

/// The estimates of a space to all accuracies that are reached, and the finest of these.
fn runs_over(space: &Space, parts: f64) -> anyhow::Result<(Vec<Run>, f64)> {
    let (mut runs, mut finest) = (Vec::new(), 1.0);
    for accuracy in accuracies() {
        match Sampler::exact().estimate(space, Plan::Quadrature { accuracy }) {
            #[expect(clippy::cast_precision_loss, reason = "millions")]
            Ok(found) => runs.push(Run { parts, accuracy, shares: found.points as f64 }),
            Err(Error::NotReached { .. }) => break,
            Err(error) => return Err(error.into()),
        }
        finest = accuracy;
    }
    Ok((runs, finest))
}
