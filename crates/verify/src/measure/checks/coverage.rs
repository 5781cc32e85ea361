//! This check measures how often intervals for P(heads) contain it, over many spaces: coins and other bodies, 1 to 4
//! coordinates, and probabilities from 1e-4 to 1 - 1e-4. The probability of each is known from many more points.
//!
//! Each space is a random one, moved along one of its coordinates until its probability is in the range that is wanted. For
//! exact-speed there are also spaces with a smooth share that has a rare kink or jump, of which samples often meet none; their
//! probabilities are reference numbers from quadratures.

use std::collections::BTreeMap;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use sampling::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use sampling::{Axis, Coordinate, Plan, Rest, Sampler, Scrambled, Space, clopper_pearson};
use toss::{Body, Coin};

use super::probability::in_the_box_of_four;
use crate::measure::check::Basis::CrossMethod;
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::outside::ReferenceProbabilities;
use crate::measure::trial::Measurement;

pub(super) const CHECKS: &[Check] = &[Check::of_library("interval-coverage", Own(coverage)).by(CrossMethod).claims(
    "At least 94 % of the intervals for P(heads) at the 95 % level contain it, for each method, number of \
     coordinates, number of launches and range of probabilities, and in all sums of these. Measured: how far a \
     fraction is below 0.94 beyond chance, of which a fraction of 0.94 has 1e-7; any shortfall fails.",
)];

/// The least fraction of intervals that have to contain the probability.
const LEAST: f64 = 0.94;

/// The chance with which one fraction of 0.94 is called less.
const FALSE_ALARM: f64 = 1e-7;

/// The ranges of the probability of the rarer face.
const BANDS: [(&str, [f64; 2]); 4] = [
    ("1e-4 to 1e-3", [1e-4, 1e-3]),
    ("1e-3 to 0.01", [1e-3, 1e-2]),
    ("0.01 to 0.1", [1e-2, 0.1]),
    ("0.1 to 0.5", [0.1, 0.5]),
];

#[derive(Clone, Copy, PartialEq)]
enum Method {
    Random,
    Sobol,
    SobolOfBodies,
    ExactSpeed,
}

impl Method {
    const ALL: [(&str, Self); 4] = [
        ("random", Self::Random),
        ("sobol", Self::Sobol),
        ("sobol of bodies", Self::SobolOfBodies),
        ("exact-speed", Self::ExactSpeed),
    ];

    fn plan(self, points: u64, seed: u64) -> Plan {
        match self {
            Self::Random => Plan::Random { points, seed },
            Self::Sobol | Self::SobolOfBodies => Plan::Sobol(Scrambled::new(points, seed)),
            Self::ExactSpeed => Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, seed))),
        }
    }
}

/// How much is tried: spaces for each method, number of coordinates and range of probabilities; seeds for each space;
/// numbers of launches; and the launches from which the probability is known.
#[derive(Clone, Copy)]
struct Extent {
    spaces: usize,
    seeds: u64,
    points: &'static [u64],
    truth: u64,
}

impl Extent {
    fn of(effort: Effort) -> Self {
        const POINTS: [u64; 4] = [64, 1000, 4096, 65_536];
        let standard = Self { spaces: 1, seeds: 25, points: &POINTS, truth: 1 << 19 };
        let quick = Self { seeds: 12, points: &POINTS[..3], truth: 1 << 17, ..standard };
        effort.of([quick, standard, Self { spaces: 6, truth: 1 << 20, ..standard }])
    }
}

/// A random space: an axis for each coordinate, and which of them moves.
struct Random {
    body: Body,
    axes: Vec<(Coordinate, Axis)>,
    moves: usize,
    by: f64,
}

impl Random {
    fn new(rng: &mut ChaCha8Rng, method: Method, free: usize) -> anyhow::Result<Self> {
        const SCALES: [(Coordinate, f64); 6] =
            [(RateX, 60.0), (RateY, 60.0), (RateZ, 60.0), (Speed, 3.0), (Gravity, 2.0), (Tilt, 1.0)];
        let mut chosen = if method == Method::ExactSpeed { vec![3] } else { Vec::new() };
        while chosen.len() < free {
            // Gravity and tilt vary more rarely.
            let of = if rng.random_bool(0.85) { rng.random_range(0..4) } else { rng.random_range(4..6) };
            if !chosen.contains(&of) {
                chosen.push(of);
            }
        }
        let is_tilted = rng.random_bool(0.4);
        let mut axes = Vec::new();
        for (index, (of, scale)) in SCALES.into_iter().enumerate() {
            let value = match of {
                Speed => rng.random_range(1.0..5.0),
                Gravity => rng.random_range(9.0..10.0),
                Tilt if is_tilted => rng.random_range(0.0..3.0),
                Tilt => 0.0,
                _ => (if rng.random_bool(0.5) { scale } else { -scale }) * 10_f64.powf(rng.random_range(-1.5..0.0)),
            };
            let width = scale * 10_f64.powf(rng.random_range(-2.5..0.0));
            let is_normal = rng.random_bool(0.2);
            axes.push((
                of,
                match (chosen.contains(&index), is_normal) {
                    (false, _) => Axis::fixed(value),
                    (true, false) => Axis::range(value..=value + width),
                    (true, true) => Axis::normal(value, 0.05 * width),
                },
            ));
        }
        let moves = chosen[rng.random_range(0..chosen.len())];
        let by = SCALES[moves].1 * rng.random_range(-0.5..0.5);
        let body = if method == Method::SobolOfBodies {
            let [one, two] = [(); 2].map(|()| rng.random_range(0.3..1.0));
            let [least, most]: [f64; 2] = [f64::abs(one - two), one + two];
            Body::from_moments([one, two, least + rng.random_range(0.05..0.95) * (most - least)])?
        } else {
            Coin::from_moments(1.0, rng.random_range(0.3..2.0))?.into()
        };
        Ok(Self { body, axes, moves, by })
    }

    /// The space, moved by a part of the whole way; `None` if no launches are that far.
    fn space(&self, part: f64) -> Option<Space> {
        let mut builder = Space::builder(self.body);
        for (index, (of, axis)) in self.axes.iter().enumerate() {
            let axis = if index == self.moves { moved(*axis, part * self.by) } else { *axis };
            builder = builder.axis(*of, axis);
        }
        builder.build().ok()
    }
}

fn moved(axis: Axis, by: f64) -> Axis {
    match axis.distribution() {
        sampling::Distribution::Uniform { lo, hi } => Axis::range(lo + by..=hi + by),
        sampling::Distribution::Normal { mean, sd } => Axis::normal(mean + by, sd),
    }
}

/// P(heads) from so many launches.
fn probability(space: &Space, points: u64) -> anyhow::Result<f64> {
    let scrambled = Scrambled { points, scrambles: 1, seed: 77 };
    let has_shares = space.coin().is_some() && space.axis(Speed).value().is_none();
    let plan = if has_shares { Plan::ExactSpeed(Rest::Sobol(scrambled)) } else { Plan::Sobol(scrambled) };
    Ok(Sampler::exact().estimate(space, plan)?.probability)
}

/// A random space with a probability in the range, and the probability.
fn space_with(
    rng: &mut ChaCha8Rng,
    method: Method,
    free: usize,
    band: [f64; 2],
    truth: u64,
) -> anyhow::Result<(Space, f64)> {
    const ROUGH: u64 = 1 << 13;
    let rare = |probability: f64| probability.min(1.0 - probability);
    loop {
        let random = Random::new(rng, method, free)?;
        let target = band[0] * (band[1] / band[0]).powf(rng.random_range(0.2..0.8));
        let target = if rng.random_bool(0.5) { target } else { 1.0 - target };
        let (Some(first), Some(last)) = (random.space(0.0), random.space(1.0)) else { continue };
        let starts_below = probability(&first, ROUGH)? < target;
        if starts_below == (probability(&last, ROUGH)? < target) {
            continue;
        }
        let [mut from, mut to] = [0.0, 1.0];
        for _ in 0..30 {
            let middle = 0.5 * (from + to);
            let Some(space) = random.space(middle) else { break };
            let found = probability(&space, ROUGH)?;
            if (band[0]..band[1]).contains(&rare(found)) {
                let found = probability(&space, truth)?;
                if (band[0]..band[1]).contains(&rare(found)) {
                    return Ok((space, found));
                }
                break;
            }
            if (found < target) == starts_below { from = middle } else { to = middle }
        }
    }
}

/// Intervals that were tried and those of them that contained the probability, by what they have in common.
type Cells = BTreeMap<String, [u64; 2]>;

/// The intervals of `plan` for so many seeds, and those of them that contain the probability.
fn covered(space: &Space, probability: f64, seeds: u64, plan: impl Fn(u64) -> Plan) -> anyhow::Result<[u64; 2]> {
    let is_covered = |seed: u64| {
        let found = Sampler::exact().estimate(space, plan(seed))?;
        anyhow::Ok(u64::from(found.interval.is_some_and(|interval| interval.contains(probability))))
    };
    Ok([seeds, (1..=seeds).map(is_covered).sum::<anyhow::Result<u64>>()?])
}

/// The intervals over the spaces of one method, number of coordinates and range of probabilities.
fn tried(method: Method, free: usize, band: usize, extent: &Extent) -> anyhow::Result<Cells> {
    let (name, range) = BANDS[band];
    let mut rng = ChaCha8Rng::seed_from_u64(43);
    rng.set_stream((10 * (10 * (method as usize) + free) + band) as u64);
    let mut cells = Cells::new();
    for index in 0..extent.spaces {
        let (space, probability) = space_with(&mut rng, method, free, range, extent.truth)?;
        for points in extent.points {
            let plan = |seed| method.plan(*points, seed + 1000 * index as u64);
            let [tried, covered] = covered(&space, probability, extent.seeds, plan)?;
            let (by_points, by_free) = (format!("{points} launches"), format!("{free} coordinates"));
            let keys = [
                format!("{by_points}, {by_free}, P {name}"),
                format!("{by_points}, {by_free}"),
                format!("{by_points}, P {name}"),
                by_points,
                "all".to_owned(),
            ];
            for key in keys {
                let [all, of_them] = cells.entry(key).or_default();
                *all += tried;
                *of_them += covered;
            }
        }
    }
    Ok(cells)
}

/// Spaces whose share is smooth but for a kink or jump that few launches meet, by the names of their reference numbers: ωx, ωy, ωz,
/// speed and tilt.
const RARE: [(&str, [&str; 5]); 5] = [
    ("rare, tails of a tilt", ["0", "2.7:2.71", "0", "2:3", "normal:0:0.34"]),
    ("rare, tails of a tilt and of speeds", ["0", "normal:10:0.5", "0", "normal:2.4:0.12", "normal:0:20deg"]),
    ("rare, tails of a rate", ["0", "normal:10:0.35", "0", "2:3", "0"]),
    ("rare, tails of two rates", ["normal:8:0.37", "normal:6:0.37", "0", "2:3", "0"]),
    ("rare, a range beyond 45 degrees", ["20", "0", "39:40.001", "3:5", "0"]),
];

/// The intervals over one space with a rare kink.
fn tried_at_rare_kinks(name: &str, texts: [&str; 5], extent: &Extent) -> anyhow::Result<Cells> {
    let axes: Vec<(Coordinate, &str)> = [RateX, RateY, RateZ, Speed, Tilt].into_iter().zip(texts).collect();
    let space = Space::parse(Coin::from_moments(1.0, 0.5)?, &axes)?;
    let probability = ReferenceProbabilities::inside()?.figure(name)?;
    let cell = |points: &u64| {
        let cell = covered(&space, probability, extent.seeds, |seed| Method::ExactSpeed.plan(*points, seed))?;
        Ok((format!("{points} launches, {name}"), cell))
    };
    extent.points.iter().map(cell).collect()
}

/// How far the fraction is below [`LEAST`] beyond chance.
fn shortfall([all, covered]: [u64; 2]) -> f64 {
    (LEAST - clopper_pearson(covered, all, 1.0 - 2.0 * FALSE_ALARM).hi).max(0.0)
}

fn coverage(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let extent = Extent::of(context.effort);
    let of_method = |(name, method): (&str, Method)| {
        // With the speed alone exact-speed samples nothing.
        let least_free = if method == Method::ExactSpeed { 2 } else { 1 };
        let parts: Vec<(usize, usize)> =
            (least_free..=4).flat_map(|free| (0..BANDS.len()).map(move |band| (free, band))).collect();
        let found = parts.into_par_iter().map(|(free, band)| tried(method, free, band, &extent));
        let mut cells = Cells::new();
        for (key, [all, covered]) in found.collect::<anyhow::Result<Vec<Cells>>>()?.into_iter().flatten() {
            let cell = cells.entry(key).or_default();
            *cell = [cell[0] + all, cell[1] + covered];
        }
        if method == Method::ExactSpeed {
            let found = RARE.into_par_iter().map(|(name, texts)| tried_at_rare_kinks(name, texts, &extent));
            cells.extend(found.collect::<anyhow::Result<Vec<Cells>>>()?.into_iter().flatten());
        }
        if method != Method::SobolOfBodies {
            cells.insert(
                "the box of four".to_owned(),
                in_the_box_of_four(context, |points, seed| method.plan(points, seed))?,
            );
        }
        let share = |[all, covered]: [u64; 2]| covered as f64 / all as f64;
        let measured = cells.values().copied().map(shortfall).fold(0.0, f64::max);
        let tries = cells.get("all").map_or(0, |cell| cell[0]);
        let least = cells.iter().min_by(|(_, one), (_, two)| share(**one).total_cmp(&share(**two)));
        let input = least.map(|(key, cell)| format!("{:.4} of {} intervals: {key}", share(*cell), cell[0]));
        Ok(Measurement::figure(name, measured, tries, input.unwrap_or_default()))
    };
    Method::ALL.into_par_iter().map(of_method).collect()
}
