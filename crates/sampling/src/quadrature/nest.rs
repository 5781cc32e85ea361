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
            most_panels: MOST_PANELS[usize::from(level > 0)],
            most_shares: MOST_SHARES,
        };
        integrate(&Line { nest: self, level, values }, &rest.parts, limits)
    }

    /// The integrand of line number `level` at `values`.
    fn point(&self, level: usize, values: Values) -> Result<Point, Error> {
        let rest = &self.rest[level];
        let weight = rest.density(values[rest.of as usize]);
        let Integral { value, rule_error, rounding_error, shares } = self.mean_from(level + 1, values)?;
        let errors = [weight * rule_error, weight * rounding_error];
        Ok(Point { value: weight * value, errors, shares, density: weight })
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
        let mut marks = [0.0; MARKS];
        for (marks, motion) in marks.chunks_mut(MARKS_EACH).zip(motions) {
            marks.copy_from_slice(&marks_of(motion));
        }
        marks
    }

    /// The launches with coordinate number `level` between two positions, and the later coordinates anywhere.
    fn boxed(&self, level: usize, mut values: Values, from: f64, to: f64) -> Region {
        let mut sides = vec![(level, 0.5 * (to - from))];
        values[self.rest[level].of as usize] = 0.5 * (from + to);
        for (level, rest) in self.rest.iter().enumerate().skip(level + 1) {
            let [lo, hi] = rest.bounds();
            values[rest.of as usize] = 0.5 * (lo + hi);
            sides.push((level, 0.5 * (hi - lo)));
        }
        Region { values, sides }
    }

    /// The part, from 0 to 1, of the box that is not proven to show one face alone. At most `most` boxes are looked at.
    fn unproven(&self, whole: Region, most: usize) -> Result<f64, Error> {
        let (mut boxes, mut unproven, mut looked) = (std::collections::VecDeque::from([(whole, 1.0)]), 0.0, 0);
        while let Some((at, part)) = boxes.pop_front() {
            looked += 1;
            let clearance = Clearance::new(&self.motion(&at.values)?, &self.reach(&at), &at.values);
            if clearance.shows_one_face {
                continue;
            }
            if looked >= most {
                unproven += part;
                continue;
            }
            boxes.extend(self.halves(&at).into_iter().map(|half| (half, 0.5 * part)));
        }
        Ok(unproven)
    }

    /// The box, halved along the side over which the motion changes most.
    fn halves(&self, of: &Region) -> [Region; 2] {
        let change = |side: &(usize, f64)| {
            let Reach { momentum, tilt, gravity } = self.reach(&Region { values: of.values, sides: vec![*side] });
            let time = of.values[Coordinate::Speed as usize] / of.values[Coordinate::Gravity as usize];
            momentum * time + tilt + gravity
        };
        let longest = of.sides.iter().enumerate().max_by(|(_, one), (_, two)| change(one).total_cmp(&change(two)));
        let longest = longest.map_or(0, |(index, _)| index);
        [-0.5, 0.5].map(|side| {
            let mut half = of.clone();
            let (level, length) = half.sides[longest];
            half.values[self.rest[level].of as usize] += side * length;
            half.sides[longest].1 = 0.5 * length;
            half
        })
    }

    /// How far the launches of a box can be from the one in its middle.
    fn reach(&self, of: &Region) -> Reach {
        let mut reach = Reach::default();
        for (level, half) in &of.sides {
            let rest = &self.rest[*level];
            let follows = |coordinate: Coordinate| {
                if self.space.place(coordinate) == rest.of { *half } else { 0.0 }
            };
            let [x, y, z] = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(follows);
            reach.momentum += x.hypot(y).hypot(self.coin.inertia_ratio() * z);
            reach.tilt += follows(Coordinate::Tilt);
            reach.gravity += follows(Coordinate::Gravity);
        }
        reach
    }
}

/// Launches about those with these values.
#[derive(Clone)]
struct Region {
    values: Values,
    /// The numbers of the coordinates that vary, each with half of its range.
    sides: Vec<(usize, f64)>,
}

/// How far launches can be from a launch: the momentum by I1 (rad/s), the tilt (rad), and the gravity (m/s²).
#[derive(Default)]
struct Reach {
    momentum: f64,
    tilt: f64,
    gravity: f64,
}

/// What is the same for all launches within a [`Reach`] as for the one in their middle.
struct Clearance {
    /// Whether neither the slowest nor the fastest launch passes cos θ = 0 at its landing, and the motions all show both faces
    /// or all one.
    is_plain: bool,
    /// Whether the launches of all speeds show one face.
    shows_one_face: bool,
}

impl Clearance {
    /// The normal n at a time t is that at launch, turned by the vector L t, so that it moves by at most t |ΔL|, by the change of
    /// the tilt, and by |L| Δt. Whether a motion shows both faces depends on cos(φ ± ψ), with φ and ψ the angles of L with the
    /// vertical and with n, of which each changes by at most |ΔL|/|L|, and φ by the change of the tilt.
    fn new(motion: &Motion, reach: &Reach, values: &Values) -> Self {
        let TiltTerms { mean, cosine, sine, size, .. } = motion.terms;
        let momentum = motion.terms.phases(1.0)[0];
        let gravity = values[Coordinate::Gravity as usize];
        // The changes of times, as part of them, and of directions are infinite if they are not bounded.
        let longer = reach.gravity / (gravity - reach.gravity).max(0.0);
        let change = |phase: f64| {
            let time = if momentum > 0.0 { phase / momentum } else { motion.longest_time() };
            (1.0 + longer) * time * reach.momentum + reach.tilt + longer * phase
        };
        let heights = motion.phases.map(|phase| (motion.terms.height(phase) / size).abs());
        let [slowest, fastest] = motion.phases;
        let are_clear = heights[0] > change(slowest) && heights[1] > change(fastest);
        let turned = reach.momentum / (momentum - reach.momentum).max(0.0);
        // Positive if both faces are shown.
        let both = (cosine.hypot(sine) - mean.abs()) / size;
        let is_root_clear = both.abs() > 2.0 * turned + reach.tilt;
        // The least |cos θ| over all speeds, if they show one face: that of one of their ends, or the least of the motion.
        let HeadsPhases { half_width, .. } = motion.heads;
        let least = if half_width > 0.0 && half_width < PI {
            let [slowest, fastest] = motion.phases.map(|phase| edges_passed(&motion.heads, phase).floor());
            if slowest == fastest { heights[0].min(heights[1]) } else { 0.0 }
        } else {
            -both
        };
        let shows_one_face = least > change(fastest) || (is_root_clear && both < 0.0);
        Self { is_plain: shows_one_face || (are_clear && is_root_clear), shows_one_face }
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
        let none = Point { value: 0.0, errors: [0.0; 2], shares: 0, density: 0.0 };
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

    fn is_plain(&self, from: f64, to: f64) -> Result<bool, Error> {
        let Region { values, sides } = self.nest.boxed(self.level, self.values, from, to);
        let reach = self.nest.reach(&Region { values, sides: sides[..1].to_vec() });
        let is_plain =
            |values: &Values| Ok::<_, Error>(Clearance::new(&self.nest.motion(values)?, &reach, values).is_plain);
        let Some(rest) = self.nest.rest.get(self.level + 1) else { return is_plain(&values) };
        let [lo, hi] = rest.bounds().map(|end| {
            let mut values = values;
            values[rest.of as usize] = end;
            values
        });
        Ok(is_plain(&lo)? && is_plain(&hi)?)
    }

    fn unproven(&self, from: f64, to: f64) -> Result<f64, Error> {
        const MOST_BOXES: usize = 1 << 12;
        // The innermost line was divided where it is not plain.
        if self.level + 1 == self.nest.rest.len() {
            return Ok(0.0);
        }
        self.nest.unproven(self.nest.boxed(self.level, self.values, from, to), MOST_BOXES)
    }
}

/// The marks of the launches of a motion: those of the slowest and of the fastest one, and that of the motion. A normal
/// distribution of speeds has no ends, but between those of its reach the share is about constant, or has the width of the
/// distribution.
fn marks_of(motion: &Motion) -> [f64; MARKS_EACH] {
    let TiltTerms { mean, cosine, sine, .. } = motion.terms;
    let amplitude = cosine.hypot(sine);
    let size = amplitude + mean.abs();
    let mut marks = [0.0; MARKS_EACH];
    marks[ROOT] = if size > 0.0 { (amplitude - mean.abs()) / size } else { 0.0 };
    let HeadsPhases { half_width, .. } = motion.heads;
    if half_width > 0.0 && half_width < PI {
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
