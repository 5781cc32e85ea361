//! This module encloses P(heads): it computes two numbers between which the probability is proven to lie.
//!
//! The share of heads over all speeds is known in closed form, so that a probability is the mean of a function of one to
//! three other coordinates. Their box is divided into cells. Over a cell the function is replaced by one whose mean is known,
//! and the difference is bounded by derivatives over the whole cell. Everything is computed in balls, so that all roundings are
//! bounded, too. `docs/proofs/probability.md` has the theorem.
//!
//! A cell is halved while its bounds differ by more than a threshold; then the threshold is lowered, until the sum of all
//! cells is as narrow as was asked for. What is known of a cell is kept, some 32 bytes. Neither the cells nor their sum depend on the number of threads.

mod cell;
mod directions;
mod function;
mod means;
mod roots;
mod series;

use std::sync::atomic::{AtomicU64, Ordering};

use crate::axis::Distribution;
use crate::coordinate::Coordinate;
use crate::estimate::Estimate;
use crate::fold::{Narrowed, Progress, Stop};
use crate::interval::Interval;
use crate::space::Space;
use cell::{Cell, MOST_DIRECTIONS};
use directions::{Direction, directions_of};
use dynamics::error::require;
use dynamics::{Coin, Error, InputError};
use function::Bounds;
use means::Problem;
use numerics::{Ball, DoubleDouble, Elementary};

/// The largest number of cells of one sum.
pub(crate) const MOST_CELLS: u64 = 1 << 24;

/// So many cells are reported together.
const REPORTED: u64 = 256;

/// The finest accuracy that can be asked for. The roundings of the closed form over the speeds are about half of it.
const FINEST: f64 = 2e-14;

/// A first pass that would take more cells than these is begun again with a higher threshold, so that there soon is a width from
/// which the number of cells follows that an accuracy takes.
const FIRST_PASS: u64 = 1 << 18;

/// No pass follows one that took more than half of the cells that are allowed.
const LAST_PASS: u64 = 2;

/// 2^53 rad.
const LARGEST_PHASE: f64 = 9_007_199_254_740_992.0;

/// What a normal distribution has beyond its reach of 8.3 standard deviations, on both sides: 1.04e-16.
const BEYOND_REACH: f64 = 1.1e-16;

/// An enclosure, and how many cells it took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Enclosure {
    pub(crate) interval: Interval,
    pub(crate) cells: u64,
    /// Whether another pass would have taken more cells than are allowed.
    pub(crate) is_spent: bool,
}

/// Why a space without a closed form over the speeds is refused.
fn refused(field: &'static str, why: &'static str) -> InputError {
    InputError::OutsideModel { field, why }
}

/// Whether P(heads) of `space` can be enclosed.
///
/// # Errors
/// [`InputError::OutsideModel`] if it cannot: for a body with I1 ≠ I2, a drop, a normal distribution of speeds, more than three
/// coordinates besides the speed, and a space in which nothing varies.
pub fn require_enclosable(space: &Space) -> Result<(), InputError> {
    if space.coin().is_none() {
        let why = "enclosure needs the closed form over all speeds, which there is not for a body with I1 ≠ I2; grid, random and sobol take it";
        return Err(refused("method", why));
    }
    if space.drop().is_some() {
        let why = "enclosure needs a landing at the height of the launch; grid, random and sobol take a drop";
        return Err(refused("drop [m]", why));
    }
    if matches!(space.axis(Coordinate::Speed).distribution(), Distribution::Normal { .. }) {
        let why = "enclosure takes a range of speeds or a single one; exact-speed takes a normal distribution";
        return Err(refused(Coordinate::Speed.field(), why));
    }
    if space.free().next().is_none() {
        let why =
            "nothing varies in this space, so that there is no probability: a single toss is proven by its outcome";
        return Err(refused("space", why));
    }
    if largest_phase(space) > LARGEST_PHASE {
        let why = "enclosure takes flights whose phase is below 2^53 rad: shorten the flight or turn more slowly";
        return Err(refused(Coordinate::Speed.field(), why));
    }
    if directions_of(space).0.len() > MOST_DIRECTIONS {
        let why = "enclosure takes at most three coordinates beside the speed (of launches from horizontal, uniform rates x and y count as \
                   one); exact-speed takes more";
        return Err(refused("method", why));
    }
    Ok(())
}

/// A bound of the phases at landing (rad) in a space of launches that land at their height, but for some roundings.
pub fn largest_phase(space: &Space) -> f64 {
    let most = |of: Coordinate| space.axis(of).bounds().into_iter().fold(0.0_f64, |most, end| most.max(end.abs()));
    let size = most(Coordinate::RateX).hypot(most(Coordinate::RateY)).hypot(2.0 * most(Coordinate::RateZ));
    let [weakest, _] = space.axis(Coordinate::Gravity).bounds();
    if size == 0.0 { 0.0 } else { size * (2.0 * most(Coordinate::Speed) / weakest) }
}

/// Returns an `accuracy` that can be asked for.
///
/// # Errors
/// [`InputError::OutOfRange`] for one that roundings do not allow.
pub fn require_accuracy(accuracy: f64) -> Result<f64, InputError> {
    require("accuracy", accuracy, "at least 2e-14, finite", accuracy >= FINEST)
}

/// The number of coordinates that an enclosure divides into cells in `space`, the speed not included.
pub fn coordinates(space: &Space) -> usize {
    directions_of(space).0.len()
}

/// An accuracy that an enclosure of `space` reaches within seconds, unless its phases are large.
pub fn usual_accuracy(space: &Space) -> f64 {
    match coordinates(space) {
        0 | 1 => 1e-10,
        2 => 1e-6,
        _ => 1e-3,
    }
}

/// Where cells that are done, and narrower intervals, are reported, and what says that it is time to end.
pub(crate) type Reports<'a> = (Progress<'a>, Narrowed<'a>, Stop<'a>);

/// Encloses P(heads) of `space` to ± `accuracy`, or as narrowly as `most_cells` cells allow.
///
/// # Errors
/// As [`require_enclosable`]; [`InputError::OutOfRange`] for an `accuracy` below 2e-14.
pub(crate) fn estimate(reports: Reports<'_>, space: &Space, accuracy: f64, most_cells: u64) -> Result<Estimate, Error> {
    require_accuracy(accuracy)?;
    require_enclosable(space)?;
    let coin = space.coin().ok_or_else(|| refused("method", "enclosure takes coins"))?;
    let found = enclosed(reports, (space, coin), accuracy, most_cells);
    Ok(Estimate::of_enclosure(accuracy, found))
}

/// The narrowest enclosure that `most_cells` cells give, or the first that is right to ± `accuracy`.
///
/// Where a sum takes too many cells, `cells` are all that are allowed.
fn enclosed(
    (progress, narrowed, stop): Reports<'_>,
    (space, coin): (&Space, Coin),
    accuracy: f64,
    most_cells: u64,
) -> Enclosure {
    let (directions, roundings) = directions_of(space);
    let is_across = directions.iter().flatten().any(Direction::is_across);
    let left_out = left_out(space, roundings);
    let work = Work { problem: Problem::new(space, coin, is_across), roots: roots(&directions), progress, stop };
    let mut best: Option<Enclosure> = None;
    let (mut known, mut done) = (work.nothing(), 0);
    // A first threshold from which few cells result, and lower ones as the last width asks for.
    let mut passes = Passes {
        goal: 2.0 * accuracy,
        power: [1.5, 1.5, 1.35, 1.7][directions.len()],
        most_cells,
        threshold: 0.05 * accuracy.powf(0.8),
        narrowest: None,
    };
    loop {
        let is_first = best.is_none() && passes.threshold < 1.0;
        let most = if is_first { most_cells.min(FIRST_PASS) } else { most_cells };
        let found = work.pass(&mut known, passes.threshold, (done, most));
        if found.is_none() && is_first && FIRST_PASS < most_cells {
            known = work.nothing();
            passes.threshold *= 16.0;
            continue;
        }
        let Some((sum, cells)) = found else {
            let interval = best.map_or(Interval { lo: 0.0, hi: 1.0 }, |best| best.interval);
            return Enclosure { interval, cells: most_cells, is_spent: true };
        };
        done = cells;
        let interval = ends(&sum.widened(left_out));
        let now = interval.width();
        let narrower = best.filter(|best| best.interval.width() <= now);
        let found = narrower.unwrap_or(Enclosure { interval, cells, is_spent: false });
        if narrower.is_none() {
            narrowed(interval);
        }
        best = Some(found);
        if stop() || !passes.is_next(now, cells) {
            return Enclosure { is_spent: most_cells < LAST_PASS * cells, ..found };
        }
    }
}

/// What no cell sees: `roundings`, and what normal distributions have beyond their reach.
fn left_out(space: &Space, roundings: f64) -> f64 {
    let is_normal = |of: &Coordinate| matches!(space.axis(*of).distribution(), Distribution::Normal { .. });
    roundings + BEYOND_REACH * space.free().filter(is_normal).count() as f64
}

/// The threshold of one pass after another.
#[derive(Debug, Clone, Copy)]
struct Passes {
    /// The width that is wanted.
    goal: f64,
    /// With the threshold the cells grow roughly to the power of -1/`power`.
    power: f64,
    most_cells: u64,
    threshold: f64,
    /// The last width that was clearly narrower than those before, and its threshold.
    narrowest: Option<[f64; 2]>,
}

impl Passes {
    /// Whether another pass follows one that gave the width `now`. If so, lowers the threshold.
    fn is_next(&mut self, now: f64, cells: u64) -> bool {
        let is_narrower = self.narrowest.is_none_or(|[before, _]| now < 0.9 * before);
        if is_narrower {
            self.narrowest = Some([now, self.threshold]);
        }
        // If far smaller cells add up to the same width, roundings make it, and no pass helps. Nor is another begun if it would
        // take too many cells.
        let is_in_vain = self.narrowest.is_some_and(|[_, at]| self.threshold < 1e-3 * at);
        // The same of many cells that are not far smaller.
        let is_stuck = !is_narrower && cells > FIRST_PASS / 4;
        if now <= self.goal || is_in_vain || is_stuck || self.most_cells < LAST_PASS * cells {
            return false;
        }
        let wanted = 0.8 * (self.goal / now).powf(self.power);
        let affordable = (self.most_cells as f64 / (LAST_PASS * cells) as f64).powf(-self.power);
        self.threshold *= wanted.max(affordable).clamp(0.05, if is_narrower { 0.7 } else { 0.05 });
        true
    }
}

/// The enclosure of a number from 0 to 1 as two f64.
fn ends(sum: &Ball<DoubleDouble>) -> Interval {
    let (middle, radius) = (sum.midpoint(), sum.radius() + sum.midpoint().lo().abs());
    let [lo, hi] = [(middle.hi() - radius).next_down(), (middle.hi() + radius).next_up()];
    if lo.is_nan() || hi.is_nan() {
        return Interval { lo: 0.0, hi: 1.0 };
    }
    Interval { lo: lo.clamp(0.0, 1.0), hi: hi.clamp(0.0, 1.0) }
}

/// The first cells: one for each choice of a part of every direction.
fn roots(directions: &[Vec<Direction>]) -> Vec<Cell<'_>> {
    let mut chosen = vec![[None; MOST_DIRECTIONS]];
    for (index, parts) in directions.iter().enumerate() {
        let with = |part| {
            move |mut cell: [Option<_>; MOST_DIRECTIONS]| {
                cell[index] = Some(part);
                cell
            }
        };
        chosen = parts.iter().flat_map(|part| chosen.iter().copied().map(with(part))).collect();
    }
    chosen.into_iter().map(Cell::whole).collect()
}

/// What is known of a cell. A pass goes on with what the passes before it found.
enum Known {
    Nothing,
    /// Bounds of its mean, and the direction in which it would be halved, if it can be.
    Bounds {
        lo: f64,
        hi: f64,
        next: Option<u8>,
    },
    /// Its halves in this direction.
    Halves(u8, Box<[Known; 2]>),
}

struct Work<'a> {
    problem: Problem<'a>,
    roots: Vec<Cell<'a>>,
    progress: Progress<'a>,
    stop: Stop<'a>,
}

/// Cells that were looked at in a pass, those before it, and how many may be.
struct Count {
    done: AtomicU64,
    before: u64,
    most: u64,
}

impl<'a> Work<'a> {
    /// What is known of the roots before the first pass.
    fn nothing(&self) -> Vec<Known> {
        self.roots.iter().map(|_| Known::Nothing).collect()
    }

    /// The sum over cells that are halved until the bounds of each, times its volume, differ by at most `threshold`, and how many
    /// cells were looked at with those of the passes `before`; `None` if these are more than `most`.
    fn pass(
        &self,
        known: &mut [Known],
        threshold: f64,
        (before, most): (u64, u64),
    ) -> Option<(Ball<DoubleDouble>, u64)> {
        let (count, nothing) = (Count { done: AtomicU64::new(0), before, most }, Ball::new(DoubleDouble::ZERO, 0.0));
        let mut sums = self.roots.iter().zip(known).map(|(root, known)| self.sum(root, known, threshold, &count));
        let sum = sums.try_fold(nothing, |sum, part| Some(sum + part?))?;
        let cells = count.done.into_inner();
        (self.progress)(cells % REPORTED);
        Some((sum, before + cells))
    }

    /// The sum over a cell. Its halves are given to two threads, wherever they are, and added in their order. After a stop no
    /// cell is halved any more.
    fn sum(&self, cell: &Cell<'a>, known: &mut Known, threshold: f64, count: &Count) -> Option<Ball<DoubleDouble>> {
        let volume = (-f64::from(cell.halvings())).exp2();
        if matches!(known, Known::Nothing) {
            let done = count.done.fetch_add(1, Ordering::Relaxed) + 1;
            if count.before + done > count.most {
                return None;
            }
            if done.is_multiple_of(REPORTED) {
                (self.progress)(REPORTED);
            }
            let found = bounds_in(&self.problem, cell, cell.directions.iter().flatten().count(), threshold / volume);
            *known = Known::Bounds { lo: found.lo, hi: found.hi, next: direction(cell, &found) };
        }
        if let Known::Bounds { lo, hi, next } = *known {
            let width = hi - lo;
            let is_wide = width.is_nan() || width > threshold / volume;
            match next.filter(|_| is_wide && !(self.stop)()) {
                Some(direction) => *known = Known::Halves(direction, Box::new([Known::Nothing, Known::Nothing])),
                None => {
                    let middle = 0.5 * (lo + hi);
                    let radius = (0.5 * (hi - lo)).next_up() + f64::EPSILON * middle.abs();
                    return Some(Ball::new(DoubleDouble::from(middle * volume), radius.next_up() * volume));
                }
            }
        }
        let Known::Halves(direction, parts) = known else { return None };
        let [lower, upper] = cell.halves(usize::from(*direction))?;
        let [first, second] = &mut **parts;
        let one = || self.sum(&lower, first, threshold, count);
        let other = || self.sum(&upper, second, threshold, count);
        #[cfg(feature = "rayon")]
        let (one, other) = rayon::join(one, other);
        #[cfg(not(feature = "rayon"))]
        let (one, other) = {
            let (mut one, mut other) = (one, other);
            (one(), other())
        };
        Some(one? + other?)
    }
}

/// The bounds of a cell with this number of directions, by series of the order 2 about its middle and, over the whole of it, of the order 4, or 3 in three.
fn bounds_in<'a>(problem: &Problem<'a>, cell: &Cell<'a>, directions: usize, enough: f64) -> Bounds {
    match directions {
        0 | 1 => problem.bounds::<3, 5>(cell, enough),
        2 => problem.bounds::<6, 15>(cell, enough),
        _ => problem.bounds::<10, 20>(cell, enough),
    }
}

/// The direction that adds most to the width of a cell, of those in which it can be halved.
fn direction(cell: &Cell<'_>, found: &Bounds) -> Option<u8> {
    let open = (0..cell.directions.iter().flatten().count()).filter(|index| cell.can_be_halved(*index));
    // The first of those that add as much.
    let most = open.rev().max_by(|one, other| found.by[*one].total_cmp(&found.by[*other]));
    most.and_then(|index| u8::try_from(index).ok())
}

#[cfg(test)]
mod tests;
