//! These checks count launches again, one by one and by other means: the launches of a grid from its definition, their
//! outcomes in 256 bits, and the counts of whole plans from single tosses. Counting is what every probability rests on,
//! and a rule that was changed for the better still gives other counts than the ones that were published.

use sampling::{Coordinate, Counts, Found, Plan, Sampler, Scrambled, Space, random_tosses};
use toss::{
    Attitude, Batch, Coin, ExactSolver, Formulation, InputError, Launch, Outcome, Scheme, SimdLevel, SolveError,
    SolverEntry, Tilt, TimeOfFlight, Toss, Tosses, Vector3, certify,
};

use crate::measure::check::Basis::CrossMethod;
use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::reference::Reference;
use crate::measure::subject::{Subject, usual};
use crate::measure::trial::Measurement;

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("grid-launches", Own(|_| Ok(vec![grid_launches()?]))).up_to(1e-12, "1").claims(
        "A grid holds the launches of its definition in their order, and no others: along an axis from lo to hi the n \
         points lo + i (hi - lo)/(n - 1), both ends included, the speed varying fastest. Measured: the largest \
         distance of a coordinate from its place, divided by hi - lo.",
    ),
    Check::of_library("grid-counts", Own(grid_counts)).up_to(0.0, "launches").claims(
        "On a grid as many launches land heads and tails as the 256-bit reference counts over the grid's definition. \
         Measured: the sum of the differences; one launch is enough to fail.",
    ),
    Check::of_solvers("counts-one-by-one", Own(one_by_one)).up_to(0.0, "launches").by(CrossMethod).claims(
        "A plan counts as many heads, tails and undecided launches as its launches give one by one, for numbers of \
         launches that fill no whole block or register. Measured: the sum of the differences over all plans; one \
         launch is enough to fail.",
    ),
];

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

fn points(axes: &Axes) -> u32 {
    axes.iter().map(|(.., points)| points).product()
}

fn grid_launches() -> anyhow::Result<Measurement> {
    let (mut worst, mut launches) = ((0.0, String::new()), 0);
    for axes in AXES {
        let drawn: Vec<_> = space(axes)?.drawn(Plan::Grid)?.flatten().collect();
        launches += drawn.len() as u64;
        if drawn.len() != points(axes) as usize {
            worst = (f64::INFINITY, format!("{} launches instead of {}", drawn.len(), points(axes)));
        }
        for (index, found) in (0..).zip(&drawn) {
            let expected = values(axes, index);
            for (of, lo, hi, _) in axes {
                let away = (found.values[*of as usize] - expected[*of as usize]).abs() / (hi - lo);
                if away > worst.0 || away.is_nan() {
                    let ranges: Vec<String> = ranges(axes).map(|(of, text)| format!("{}={text}", of.name())).collect();
                    worst = (away, format!("{} of launch {index} of {}", of.name(), ranges.join(" ")));
                }
            }
        }
    }
    Ok(Measurement::figure("grid", worst.0, launches, worst.1))
}

fn grid_counts(_: &Context) -> anyhow::Result<Vec<Measurement>> {
    let (mut difference, mut launches, mut inputs) = (0, 0, Vec::new());
    let mut running = 0.0_f64;
    for axes in AXES {
        let space = space(axes)?;
        let found = counts(&space, &Sampler::exact(), Plan::Grid)?;
        let tosses = (0..points(axes)).map(|index| toss(values(axes, index))).collect::<Result<Vec<_>, _>>()?;
        let expected = tally(tosses, |toss| Ok(Reference::new(&toss.coin().expect("a coin")).outcome()))?;
        difference += distance(of_each(&found), expected);
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

/// Numbers of launches around those of a register, of a tile of the kernels and of a block of launches.
const SIZES: [u64; 12] = [1, 3, 7, 8, 9, 127, 129, 511, 512, 513, 1023, 1100];

/// The axes of the launches that are counted.
const DRAWN: [(Coordinate, &str); 4] =
    [(Coordinate::RateX, "1:40"), (Coordinate::RateY, "-9:9"), (Coordinate::RateZ, "5"), (Coordinate::Speed, "2:3")];

fn one_by_one(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let sizes = &SIZES[..context.effort.of([10, SIZES.len(), SIZES.len()])];
    let exact = counted(ExactSolver::NAME, &Sampler::exact(), sizes, |toss| Ok(certify(toss)?.outcome()))?;
    let mut rows = vec![exact.of_the_library(), batches(sizes)?.of_the_library()];
    for entry in context.registry.iter().filter(|entry| entry.integrates()) {
        // The last scheme, because that of the quaternion solves many launches at once.
        let scheme = entry.schemes().iter().rev().find(|scheme| scheme.is_adaptive()).or(entry.schemes().first());
        rows.push(by_solver(entry, scheme, &sizes[..sizes.len() - 4])?);
    }
    Ok(rows)
}

/// The difference between the counts of batches at every SIMD level and single proofs.
fn batches(sizes: &[u64]) -> anyhow::Result<Measurement> {
    let space = Space::parse(Coin::PAPER, &DRAWN)?;
    let (mut difference, mut launches, mut inputs) = (0, 0, Vec::new());
    for points in sizes {
        let each = random_tosses(&space, 7, 0..*points);
        let column = |of: fn(&Vector3<f64>) -> f64| each.iter().map(|toss| of(&toss.launch.rate())).collect::<Vec<_>>();
        let rates = [column(|rate| rate.x), column(|rate| rate.y), column(|rate| rate.z)];
        let speeds: Vec<f64> = each.iter().map(|toss| 4.905 * toss.launch.flight_time()).collect();
        let tosses =
            Tosses::new(Coin::PAPER, Attitude::about_x(0.2), 9.81, rates.each_ref().map(Vec::as_slice), &speeds)?;
        let singles = (0..each.len()).map(|index| tosses.toss(index)).collect::<Result<Vec<_>, _>>()?;
        let expected = tally(singles, |toss| Ok(certify(toss)?.outcome()))?;
        for level in SimdLevel::all() {
            let found = Batch::new(tosses).on(level).count()?;
            let found = [found.heads, found.tails, found.undecided];
            if found != expected {
                let level = level.name();
                inputs.push(format!(
                    "{points} tosses at {level}: {found:?} heads, tails and undecided, not {expected:?}"
                ));
            }
            difference += distance(found, expected);
            launches += points;
        }
    }
    Ok(Measurement::figure("batches", difference as f64, launches, inputs.join("; ")))
}

fn by_solver(entry: &SolverEntry, scheme: Option<&Scheme>, sizes: &[u64]) -> anyhow::Result<Measurement> {
    let subject = Subject::new(entry, scheme.map(|scheme| usual(*scheme)).transpose()?, Formulation::default());
    let solver = subject.solver.as_ref();
    counted(&subject.name, &Sampler::by(solver), sizes, |toss| solver.tilt(toss).map(Tilt::outcome))
        .map(|row| row.claiming(Some(0.0)))
}

/// The difference between the counts of `sampler` and those of `outcome`, over plans of each of these sizes.
fn counted(
    subject: &str,
    sampler: &Sampler<'_>,
    sizes: &[u64],
    outcome: impl Fn(&Toss) -> Result<Outcome, SolveError>,
) -> anyhow::Result<Measurement> {
    let (mut difference, mut launches, mut first) = (0.0, 0, "none".to_owned());
    for points in sizes {
        for (tilt, gravity) in [("0", "9.81"), ("0.3", "9.81"), ("0:1", "9:10")] {
            let rest = [(Coordinate::Tilt, tilt), (Coordinate::Gravity, gravity)];
            let space = Space::parse(Coin::PAPER, &[&DRAWN[..], &rest].concat())?;
            let scrambled = Scrambled { scrambles: 3, ..Scrambled::new(3 * points.next_power_of_two(), 5) };
            for plan in [Plan::Random { points: *points, seed: 5 }, Plan::Sobol(scrambled)] {
                let tosses = space.drawn(plan)?.flatten().map(|drawn| drawn.toss);
                let expected = tally(tosses, &outcome)?;
                // A sampler that fails where single launches do not has counted nothing.
                let found = counts(&space, sampler, plan);
                let differs = found.map_or(f64::INFINITY, |found| distance(of_each(&found), expected) as f64);
                if differs > 0.0 && difference == 0.0 {
                    first = format!("{} with {points} launches, tilt {tilt}", plan.method());
                }
                difference += differs;
                launches += expected.iter().sum::<u64>();
            }
        }
    }
    let input = format!("first that differs: {first}");
    Ok(Measurement::figure(subject, difference, launches, input))
}

pub(super) fn counts(space: &Space, sampler: &Sampler<'_>, plan: Plan) -> anyhow::Result<Counts> {
    match sampler.estimate(space, plan)?.found {
        Found::Counts(counts) => Ok(counts),
        Found::Shares { .. } => anyhow::bail!("a plan of launches gave a share instead of counts"),
    }
}

/// The numbers of heads, tails and undecided.
fn of_each(counts: &Counts) -> [u64; 3] {
    [counts.heads(), counts.tails(), counts.undecided()]
}

fn tally(
    tosses: impl IntoIterator<Item = Toss>,
    outcome: impl Fn(&Toss) -> Result<Outcome, SolveError>,
) -> Result<[u64; 3], SolveError> {
    let mut numbers = [0; 3];
    for toss in tosses {
        match outcome(&toss)? {
            Outcome::Heads => numbers[0] += 1,
            Outcome::Tails => numbers[1] += 1,
            Outcome::Undecided => numbers[2] += 1,
        }
    }
    Ok(numbers)
}

fn distance(found: [u64; 3], expected: [u64; 3]) -> u64 {
    found.iter().zip(expected).map(|(found, expected)| found.abs_diff(expected)).sum()
}
