//! This file integrates over all coordinates but the speed: over the first, of the integral over the second, and so on. At
//! each place the share of heads over all speeds is known in closed form.
//!
//! # Kinks
//! The phase at landing of the slowest and of the fastest launch changes along each line. Wherever one of them passes an edge
//! of the heads, cos θ = 0 at that landing, the share has a kink. Where the motion begins to show heads always or never,
//! for launches from horizontal at ψ = 45° and 135°, the share behaves like a square root.

use dynamics::{Coin, Error};
use exact::{HeadsPhases, TiltTerms};
#[cfg(feature = "rayon")]
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

use super::kronrod::NODES;
use super::line::{Integral, Integrand, Limits, MARKS, MARKS_EACH, Marks, Point, ROOT, integrate};
use super::rest::Rest;
use crate::axis::Distribution;
use crate::coordinate::Coordinate;
use crate::exact_speed::{Motion, Share};
use crate::space::{Space, Values};

/// Largest numbers of panels of the outermost and of the other lines.
const MOST_PANELS: [usize; 2] = [4096, 1024];

/// No panel of the outermost line is divided after this number of shares.
const MOST_SHARES: u64 = 1 << 24;

/// What is integrated: the share of a space over its other coordinates, from the outermost on.
pub(super) struct Nest<'a> {
    space: &'a Space,
    coin: Coin,
    rest: Vec<Rest>,
    accuracy: f64,
}

pub(super) fn failed((toss, source): (Box<dynamics::Toss>, dynamics::SolveError)) -> Error {
    Error::Launch { index: 0, toss: Box::new((*toss).into()), source }
}

impl<'a> Nest<'a> {
    /// Integrates over `rest`, which are in the order from the outermost line on.
    pub(super) fn new(space: &'a Space, coin: Coin, rest: Vec<Rest>, accuracy: f64) -> Self {
        Self { space, coin, rest, accuracy }
    }

    /// The mean share over all coordinates.
    pub(super) fn mean(&self) -> Result<Integral, Error> {
        let mut values = self.space.fixed_values();
        if self.rest.iter().any(Rest::is_across) {
            values[Coordinate::RateY as usize] = 0.0;
        }
        self.mean_from(0, values)
    }

    /// The mean share over the coordinates from number `level` on, with the others as in `values`.
    fn mean_from(&self, level: usize, values: Values) -> Result<Integral, Error> {
        let Some(rest) = self.rest.get(level) else {
            let Share { probability, error } = self.motion(&values)?.share(self.space).map_err(failed)?;
            return Ok(Integral { value: probability, rule_error: 0.0, rounding_error: error, shares: 1 });
        };
        let limits = Limits {
            // Each of two lines has half of the accuracy.
            tolerance: self.accuracy / if self.rest.len() > 1 { 2.0 } else { 1.0 },
            divides_at_kinks: level + 1 == self.rest.len(),
            most_panels: MOST_PANELS[usize::from(level > 0)],
            most_shares: MOST_SHARES,
        };
        integrate(&Line { nest: self, level, values }, &rest.parts, limits)
    }

    /// The integrand of line number `level` at `values`.
    fn point(&self, level: usize, values: Values) -> Result<Point, Error> {
        let rest = &self.rest[level];
        let weight = rest.density(values[rest.of as usize]);
        let (found, marks) = if level + 1 == self.rest.len() {
            let motion = self.motion(&values)?;
            let Share { probability, error } = motion.share(self.space).map_err(failed)?;
            let found = Integral { value: probability, rule_error: 0.0, rounding_error: error, shares: 1 };
            (found, self.marks_at([&motion].into_iter()))
        } else {
            (self.mean_from(level + 1, values)?, self.marks(level + 1, values)?)
        };
        let Integral { value, rule_error, rounding_error, shares } = found;
        Ok(Point { value: weight * value, errors: [weight * rule_error, weight * rounding_error], shares, marks })
    }

    /// The marks of the launch at `values`, or of those at both ends of the line number `level`.
    fn marks(&self, level: usize, values: Values) -> Result<Marks, Error> {
        let Some(rest) = self.rest.get(level) else {
            return Ok(self.marks_at([&self.motion(&values)?].into_iter()));
        };
        let end = |value: f64| {
            let mut values = values;
            values[rest.of as usize] = value;
            self.motion(&values)
        };
        let [lo, hi] = rest.bounds().map(end);
        Ok(self.marks_at([&lo?, &hi?].into_iter()))
    }

    fn motion(&self, values: &Values) -> Result<Motion, Error> {
        Motion::new(self.space, self.coin, values).map_err(failed)
    }

    fn marks_at<'m>(&self, motions: impl Iterator<Item = &'m Motion>) -> Marks {
        // The share over a normal distribution of speeds, which have no ends, has no kinks but square roots.
        let has_range = matches!(self.space.axis(Coordinate::Speed).distribution(), Distribution::Uniform { .. });
        let mut marks = [0.0; MARKS];
        for (marks, motion) in marks.chunks_mut(MARKS_EACH).zip(motions) {
            marks.copy_from_slice(&marks_of(motion, has_range));
        }
        marks
    }
}

struct Line<'a> {
    nest: &'a Nest<'a>,
    level: usize,
    values: Values,
}

impl Line<'_> {
    fn values(&self, position: f64) -> Values {
        let mut values = self.values;
        values[self.nest.rest[self.level].of as usize] = position;
        values
    }
}

impl Integrand for Line<'_> {
    fn points(&self, positions: [f64; NODES]) -> Result<[Point; NODES], Error> {
        let point = |position: f64| self.nest.point(self.level, self.values(position));
        let none = Point { value: 0.0, errors: [0.0; 2], shares: 0, marks: [0.0; MARKS] };
        let mut points = [none; NODES];
        #[cfg(feature = "rayon")]
        if self.level == 0 && self.nest.rest.len() > 1 {
            let all: Vec<Result<Point, Error>> = positions.into_par_iter().map(point).collect();
            for (point, found) in points.iter_mut().zip(all) {
                *point = found?;
            }
            return Ok(points);
        }
        for (found, position) in points.iter_mut().zip(positions) {
            *found = point(position)?;
        }
        Ok(points)
    }

    fn marks(&self, position: f64) -> Result<Marks, Error> {
        self.nest.marks(self.level + 1, self.values(position))
    }
}

/// The marks of the launches of a motion: those of the slowest and of the fastest one, if the speed has a range, and that of
/// the motion.
fn marks_of(motion: &Motion, has_range: bool) -> [f64; MARKS_EACH] {
    let TiltTerms { mean, cosine, sine, .. } = motion.terms;
    let amplitude = cosine.hypot(sine);
    let size = amplitude + mean.abs();
    let mut marks = [0.0; MARKS_EACH];
    marks[ROOT] = if size > 0.0 { (amplitude - mean.abs()) / size } else { 0.0 };
    let HeadsPhases { half_width, .. } = motion.heads;
    if has_range && half_width > 0.0 && half_width < PI {
        let [slowest, fastest] = motion.phases.map(|phase| edges_passed(&motion.heads, phase));
        [marks[0], marks[1]] = [slowest, fastest];
    }
    marks
}

/// The number of edges of the heads up to a phase, continued to a continuous function of it.
fn edges_passed(heads: &HeadsPhases, phase: f64) -> f64 {
    let turn = ((phase - heads.crest) / TAU).round();
    let from_crest = phase - heads.crest - TAU * turn;
    let beyond = from_crest.abs() - heads.half_width;
    let from_edge = if beyond <= 0.0 { beyond / heads.half_width } else { beyond / (PI - heads.half_width) };
    // ½ and -½ at the edges after and before the crest, and 0 at the crest.
    2.0 * turn + (0.5 + 0.5 * from_edge).copysign(from_crest) + 0.5
}
