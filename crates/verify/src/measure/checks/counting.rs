//! This check counts the launches of a grid again: from the grid's definition, and with outcomes in 256 bits. Counting is
//! what every probability rests on, and a rule that was changed for the better still gives other counts than the ones that
//! were published.

use sampling::{Coordinate, Counts, Found, Plan, Sampler, Space};
use toss::{Coin, InputError, Launch, Outcome, TimeOfFlight, Toss, Vector3};

use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::reference;
use crate::measure::trial::Measurement;

pub(super) const CHECKS: &[Check] =
    &[Check::of_library("grid-counts", Own(grid_counts)).up_to(0.0, "launches").claims(
        "On a grid as many launches land heads and tails as the 256-bit reference counts over the grid's definition. \
         Measured: the sum of the differences; one launch is enough to fail.",
    )];

/// The axes of a grid as (coordinate, lo, hi, n), from the slowest to the fastest varying.
type Axes = [(Coordinate, f64, f64, u32)];

/// Axes of few, of even and of odd numbers of points, of which the last fill no whole register.
const AXES: [&Axes; 3] = [
    &[(Coordinate::RateX, 0.0, 50.0, 12), (Coordinate::RateZ, -30.0, 30.0, 5), (Coordinate::Speed, 3.0, 5.0, 7)],
    &[(Coordinate::Tilt, 0.25, 2.0, 3), (Coordinate::RateY, 1.0, 31.0, 6), (Coordinate::Speed, 2.0, 4.5, 19)],
    &[(Coordinate::Gravity, 1.6, 9.8, 4), (Coordinate::RateX, -9.0, 9.0, 3), (Coordinate::RateY, 1.0, 40.0, 11)],
];

/// The values of the coordinates that do not vary.
const FIXED: [(Coordinate, f64); 6] = [
    (Coordinate::RateX, 11.0),
    (Coordinate::RateY, 3.0),
    (Coordinate::RateZ, 5.0),
    (Coordinate::Speed, 3.5),
    (Coordinate::Gravity, 9.81),
    (Coordinate::Tilt, 0.0),
];

/// The ranges of the axes, as the command line reads them.
fn ranges(axes: &Axes) -> impl Iterator<Item = (Coordinate, String)> {
    axes.iter().map(|(of, lo, hi, points)| (*of, format!("{lo:?}:{hi:?}:{points}")))
}

fn space(axes: &Axes) -> anyhow::Result<Space> {
    let fixed = FIXED.iter().filter(|(of, _)| axes.iter().all(|(varies, ..)| varies != of));
    let fixed = fixed.map(|(of, value)| (*of, format!("{value:?}")));
    let texts: Vec<(Coordinate, String)> = fixed.chain(ranges(axes)).collect();
    let texts: Vec<(Coordinate, &str)> = texts.iter().map(|(of, text)| (*of, text.as_str())).collect();
    Ok(Space::parse(Coin::PAPER, &texts)?)
}

/// The values of launch number `index` of the grid over `axes`, by the definition of the grid.
fn values(axes: &Axes, index: u32) -> [f64; 6] {
    let mut values = [f64::NAN; 6];
    for (of, value) in FIXED {
        values[of as usize] = value;
    }
    let mut rest = index;
    for (of, lo, hi, points) in axes.iter().rev() {
        values[*of as usize] = lo + f64::from(rest % points) * (hi - lo) / f64::from(points - 1);
        rest /= points;
    }
    values
}

/// The toss of the paper's coin with these values.
fn toss([x, y, z, speed, gravity, tilt]: [f64; 6]) -> Result<Toss, InputError> {
    let launch = Launch::new(Vector3::new(x, y, z), TimeOfFlight::Ballistic { speed, gravity })?.with_tilt(tilt)?;
    Ok(Toss::new(Coin::PAPER, launch))
}

fn grid_counts(_: &Context) -> anyhow::Result<Vec<Measurement>> {
    let (mut difference, mut launches, mut inputs) = (0, 0, Vec::new());
    let mut running = 0.0_f64;
    for axes in AXES {
        let space = space(axes)?;
        let found = counts(&space, &Sampler::exact(), Plan::Grid)?;
        let points: u32 = axes.iter().map(|(.., points)| points).product();
        let mut expected = [0_u64; 3];
        for index in 0..points {
            match reference::of(&toss(values(axes, index))?)?.outcome() {
                Outcome::Heads => expected[0] += 1,
                Outcome::Tails => expected[1] += 1,
                Outcome::Undecided => expected[2] += 1,
            }
        }
        let counted = [found.heads(), found.tails(), found.undecided()];
        difference += counted.iter().zip(expected).map(|(found, expected)| found.abs_diff(expected)).sum::<u64>();
        let last = Sampler::exact().running_shares(&space, 1, 1)?.pop();
        let all: u64 = expected.iter().sum();
        running += last
            .and_then(|last| last.grid)
            .map_or(f64::INFINITY, |grid| (grid * all as f64 - expected[0] as f64).abs());
        launches += all;
        inputs.push(format!("{} of {} heads, expected {}", found.heads(), found.points(), expected[0]));
    }
    let figure = |subject, measured| Measurement::figure(subject, measured, launches, inputs.join("; "));
    Ok(vec![figure("grid", difference as f64), figure("running shares", running.round())])
}

pub(super) fn counts(space: &Space, sampler: &Sampler<'_>, plan: Plan) -> anyhow::Result<Counts> {
    match sampler.estimate(space, plan)?.found {
        Found::Counts(counts) => Ok(counts),
        Found::Shares { .. } | Found::Enclosed { .. } => {
            anyhow::bail!("a plan of launches gave a share instead of counts")
        }
    }
}
