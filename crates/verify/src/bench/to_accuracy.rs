//! This file compares the methods by the time that they take to an accuracy. A launch of one method is worth many of another, so
//! that times of launches alone do not say which method is best.
//!
//! Errors are measured against enclosure to 1e-9: root mean squares over some seeds, for grids over some numbers of points. Most
//! methods would take too long to the accuracy itself. Their numbers of launches are extrapolated from estimates with fewer
//! launches, by a power law whose exponent is known: ½ for independent launches, and (d + 1)/2d for even points in d
//! dimensions that are heads or tails on either side of a surface. That of exact-speed is fitted.

use std::fmt;

use anyhow::Context;
use rayon::{ThreadPool, ThreadPoolBuilder};
use sampling::{Estimate, Plan, Rest, Sampler, Scrambled, Space, named_space};
use toss::Error;
use toss::planner::Nanoseconds;

use super::launches::box_of_launches;
use crate::clock;
use crate::host::Host;
use crate::slope::slope;

/// How long each method takes to an accuracy, on one core.
pub(crate) struct ToAccuracy {
    host: Host,
    accuracy: f64,
    rows: Vec<Row>,
}

/// The time of a method over one space.
struct Row {
    space: &'static str,
    method: &'static str,
    /// The number of launches, or of shares.
    launches: f64,
    nanoseconds: f64,
    /// By which power of the number of launches the error falls, and whether this is known or fitted; `None` if the accuracy
    /// was reached.
    power: Option<(f64, &'static str)>,
}

/// A plan with a number of launches and the number of a replicate.
type Planned = fn(&Space, u64, u64) -> Result<(Space, Plan), Error>;

/// A method of choosing launches, and the numbers of launches with which its errors are measured.
struct Method {
    name: &'static str,
    sizes: [u64; 3],
    plan: Planned,
    /// The exponent of the error by the number of dimensions, if it is known.
    power: Option<fn(f64) -> f64>,
}

const EVEN: Option<fn(f64) -> f64> = Some(|dimensions| 0.5 * (dimensions + 1.0) / dimensions);

const METHODS: [Method; 4] = [
    Method {
        name: "grid",
        sizes: [1 << 14, 1 << 17, 1 << 20],
        // Grids of nearby sizes stand for seeds.
        plan: |space, points, seed| Ok((space.with_grid_of(points + points * seed / 16)?, Plan::Grid)),
        power: EVEN,
    },
    Method {
        name: "random",
        sizes: [1 << 14, 1 << 17, 1 << 20],
        plan: |space, points, seed| Ok((*space, Plan::Random { points, seed })),
        power: Some(|_| 0.5),
    },
    Method {
        name: "Sobol",
        sizes: [1 << 14, 1 << 17, 1 << 20],
        plan: |space, points, seed| Ok((*space, Plan::Sobol(Scrambled::new(points, seed)))),
        power: EVEN,
    },
    Method {
        name: "exact-speed",
        sizes: [1 << 13, 1 << 16, 1 << 19],
        plan: |space, points, seed| Ok((*space, Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, seed))))),
        power: None,
    },
];

impl ToAccuracy {
    /// Measures the times of all methods to `accuracy`, over Fig. 4's space and the box of four coordinates.
    pub(crate) fn measure(accuracy: f64) -> anyhow::Result<Self> {
        let pool = ThreadPoolBuilder::new().num_threads(1).build().context("cannot start a thread")?;
        let mut rows = Vec::new();
        for (name, space) in [("Fig. 4", named_space("paper-fig4")?), ("box", box_of_launches()?)] {
            let truth = timed(&pool, &space, Plan::Enclosure { accuracy: accuracy.min(1e-9) })?.0.probability;
            for method in &METHODS {
                rows.push(method.row(name, &space, truth, accuracy, &pool)?);
            }
            let (found, nanoseconds) = timed(&pool, &space, Plan::Enclosure { accuracy })?;
            #[expect(clippy::cast_precision_loss, reason = "millions")]
            let launches = found.points as f64;
            rows.push(Row { space: name, method: "enclosure", launches, nanoseconds, power: None });
        }
        Ok(Self { host: Host::here(), accuracy, rows })
    }
}

/// An estimate and its time (ns).
fn timed(pool: &ThreadPool, space: &Space, plan: Plan) -> Result<(Estimate, f64), Error> {
    const RUNS: usize = 3;
    let mut found = None;
    let mut run = || found = Some(pool.install(|| Sampler::exact().estimate(space, plan)));
    let times = clock::times(&mut run, |runs, _| runs < RUNS);
    Ok((found.expect("it was run")?, clock::nanoseconds(times[0])))
}

impl Method {
    #[expect(clippy::cast_precision_loss, reason = "millions")]
    fn row(
        &self,
        name: &'static str,
        space: &Space,
        truth: f64,
        accuracy: f64,
        pool: &ThreadPool,
    ) -> anyhow::Result<Row> {
        const SEEDS: u64 = 32;
        let (mut logs, mut launch_ns) = (Vec::new(), f64::INFINITY);
        for size in self.sizes {
            let (mut squares, mut points) = (0.0, 0);
            for seed in 0..SEEDS {
                let (space, plan) = (self.plan)(space, size, seed)?;
                let (found, nanoseconds) = timed(pool, &space, plan)?;
                squares += (found.probability - truth).powi(2);
                points += found.points;
                launch_ns = launch_ns.min(nanoseconds / found.points as f64);
            }
            logs.push([points as f64 / SEEDS as f64, (squares / SEEDS as f64).sqrt()].map(f64::ln));
        }
        let known = self.power.map(|power| (power(space.free().count() as f64), "known"));
        let power = known.unwrap_or_else(|| (-slope(&logs), "fitted"));
        // The mean of error × N^power over the sizes, on a logarithmic scale.
        let factor = logs.iter().map(|[points, error]| error + power.0 * points).sum::<f64>() / logs.len() as f64;
        let launches = ((factor - accuracy.ln()) / power.0).exp();
        Ok(Row { space: name, method: self.name, launches, nanoseconds: launches * launch_ns, power: Some(power) })
    }
}

/// A time (ns) in the unit that suits it, up to minutes.
fn long(nanoseconds: f64) -> String {
    let seconds = 1e-9 * nanoseconds;
    if seconds < 120.0 { Nanoseconds(nanoseconds).to_string() } else { format!("{:.1} min", seconds / 60.0) }
}

impl fmt::Display for ToAccuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Host { cpu, cores, rustc, commit, .. } = &self.host;
        writeln!(f, "host       {cpu}, {cores} cores, {rustc}, {commit}")?;
        writeln!(f, "\nP(heads) to {:<8e} {:<14} {:>10} {:>12}  error", self.accuracy, "", "launches", "one core")?;
        for Row { space, method, launches, nanoseconds, power } in &self.rows {
            let how =
                power.map_or("reached".to_owned(), |(power, how)| format!("as N^-{power:.2} ({how}), extrapolated"));
            let time = long(*nanoseconds);
            writeln!(f, "  {space:<18} {method:<14} {launches:>10.1e} {time:>12}  {how}")?;
        }
        Ok(())
    }
}
