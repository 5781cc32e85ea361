//! What an accepted step of a Runge-Kutta scheme lands off the series that starts where the step does. The theorem is in
//! `docs/proofs/enclosure.md`, section 8, whose numbers of formulas stand here in brackets.

use dynamics::integrate::Accepted;
use numerics::double_double::two_sum;
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use crate::half_product;

/// The longest shift of the end of a step for which the bounds of second order hold, in the unit of the flight.
const LONGEST_SHIFT: f64 = 1e-10;

/// More than the part of second order that a turn changes in the square of a shift, in the unit of the flight.
pub(crate) const OF_SQUARE: f64 = 8.0;

/// The roundings of a measured jump, in units of u of what it is the difference of.
pub(crate) const OF_JUMP: f64 = 32.0 * UNIT_ROUNDOFF;

/// A jump from the end of a series to the end of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jump {
    /// An upper bound of the distance of the two quaternions P, each divided by its norm.
    pub(crate) turn: f64,
    /// How much later than its rounded time the step ends, in the unit of the flight.
    pub(crate) shift: f64,
}

impl Jump {
    /// The jump from the quaternion `series` with these `rates` to the quaternion `step`, at the rounded `time`.
    ///
    /// Times are sums that round, so that a step ends up to half an ulp earlier or later than they say. Within that, the
    /// shift is the one that leaves the least jump.
    pub(crate) fn new(series: [f64; 4], rates: [f64; 3], step: [f64; 4], time: f64) -> Self {
        let dot = |a: [f64; 4], b: [f64; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
        let less = |a: [f64; 4], b: [f64; 4], factor: f64| [0, 1, 2, 3].map(|part: usize| a[part] - factor * b[part]);
        let norm = dot(series, series);
        let jump = less(step, series, 1.0);
        // Along P the jump changes the norm alone, by which the rest is divided.
        let along = dot(jump, series) / norm;
        let across = less(jump, series, along).map(|part| part / (1.0 + along));
        let moving = half_product(series, rates);
        let (speed, reach) = (dot(moving, moving), (UNIT_ROUNDOFF * time).min(LONGEST_SHIFT));
        let shift = if speed > 0.0 { (dot(across, moving) / speed).clamp(-reach, reach) } else { 0.0 };
        let left = less(across, moving, shift);
        let rounded = OF_JUMP * (2.0 * dot(jump, jump).sqrt() + shift.abs() * speed.sqrt());
        let turn = (dot(left, left).sqrt() + rounded) / norm.sqrt() + OF_SQUARE * shift * shift;
        Self { turn: if along > -0.5 { turn } else { f64::INFINITY }, shift }
    }
}

/// The sum of the lengths of all steps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Elapsed {
    sum: DoubleDouble,
    steps: f64,
}

impl Elapsed {
    pub(crate) const ZERO: Self = Self { sum: DoubleDouble::ZERO, steps: 0.0 };

    /// Adds a step of the length `h` with its `shift`.
    pub(crate) fn add(&mut self, h: f64, shift: f64) {
        self.sum = self.sum + two_sum(h, shift);
        self.steps += 1.0;
    }

    /// A bound of how far the sum is from the time of the flight, `span`.
    pub(crate) fn off(&self, span: f64) -> f64 {
        let rounded = 8.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF * self.steps * span;
        (self.sum - span.into()).hi().abs() * (1.0 + 2.0 * UNIT_ROUNDOFF) + rounded
    }
}

/// The lengths of the steps, as the rounded times tell them. A body that `rests` takes none, as nothing changes.
pub(crate) fn lengths<const N: usize>(accepted: &Accepted<N>, rests: bool) -> Vec<f64> {
    let lengths = accepted.times.windows(2).map(|times| times[1] - times[0]);
    lengths.filter(|_| !rests).collect()
}

#[cfg(test)]
mod tests;
