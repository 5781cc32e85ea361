//! Bounds of the error of a body's flight by a Runge-Kutta scheme, whose accepted steps are compared with Taylor series as
//! those of coins are. The theorem is in `docs/proofs/enclosure.md`, section 8.

use dynamics::body_rate::principal_acceleration;
use dynamics::integrate::Accepted;
use dynamics::{RigidFlight, RigidToss, StepControl, Stepping};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use super::enclosed::Bound;
use super::polhode::{Errors, Polhode, Step};
use super::{Bodies, RigidSeries};
use crate::jump::{self, Elapsed, Jump, OF_JUMP, lengths};
use crate::lockstep::{Clock, MOST_LANES, Motion, PerLane, store};
use crate::plan::Plan;

/// The part of the scheme's tolerance that is left to the series.
const OF_SERIES: f64 = 1e-3;

/// A step that turns the body by more than this (rad) has no useful bound.
const LONGEST_TURN: f64 = 64.0;

/// More than the part of second order that the rates change in the square of a shift, in the unit of the flight.
const OF_SQUARE: f64 = 64.0;

/// The bound of a flight, and the number of coefficients that it took. The bound is `None` for a flight that has none.
pub(crate) fn compared(
    toss: &RigidToss,
    flight: &RigidFlight,
    stepping: &Stepping,
    accepted: &Accepted<7>,
    level: SimdLevel,
) -> (Option<Bound>, u64) {
    let lengths = lengths(accepted, flight.rates == [0.0; 3]);
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let turning = longest * flight.rates.iter().map(|rate| rate * rate).sum::<f64>().sqrt();
    let polhode = Polhode::new(toss, flight).filter(|_| turning <= LONGEST_TURN);
    let Some(polhode) = polhode else { return (None, 0) };
    let tolerance = match stepping.control() {
        StepControl::Tolerance(tolerance) => (OF_SERIES * flight.timing().tightened(tolerance)).max(f64::EPSILON),
        StepControl::Step(_) => f64::EPSILON,
    };
    let plan = Plan::of_pieces_of_bodies(tolerance, turning);
    let errors = Errors::at_launch(polhode, flight.rates);
    let (bound, pieces) = level.run(Comparison { plan: &plan, accepted, lengths: &lengths, flight, errors });
    (Some(bound), pieces * plan.order as u64)
}

/// The comparison of all steps of a flight, with the same bits at every SIMD level.
struct Comparison<'a> {
    plan: &'a Plan,
    accepted: &'a Accepted<7>,
    lengths: &'a [f64],
    flight: &'a RigidFlight,
    errors: Errors,
}

impl WithSimd for Comparison<'_> {
    /// The bound, and the number of pieces.
    type Output = (Bound, u64);

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> (Bound, u64) {
        let (mut series, mut elapsed, mut pieces) = (Bodies::series(simd), Elapsed::ZERO, 0);
        let mut steps: [Vec<Step>; MOST_LANES] = Default::default();
        for (chunk, lengths) in self.lengths.chunks(S::F64_LANES).enumerate() {
            let first = chunk * S::F64_LANES;
            let mut bodies = Bodies::default();
            for (lane, _) in lengths.iter().enumerate() {
                bodies.start(lane, &self.accepted.states[first + lane].data.0[0], self.flight.couplings);
            }
            self.fly(simd, &mut bodies, lengths, &mut series, &mut steps);
            for (lane, steps) in steps[..lengths.len()].iter_mut().enumerate() {
                pieces += steps.len() as u64;
                let shift = self.jump(first + lane + 1, bodies.turn(lane), steps);
                elapsed.add(lengths[lane], shift);
                steps.drain(..).for_each(|step| self.errors.add(&step));
            }
        }
        let strayed = elapsed.off(self.flight.timing().span());
        (Bound { turn: self.errors.bound(), fastest: self.errors.fastest(), strayed }, pieces)
    }
}

impl Comparison<'_> {
    /// Flies the series of a step in each lane, in pieces, and lists them.
    #[inline(always)]
    fn fly<S: Simd>(
        &self,
        simd: S,
        bodies: &mut Bodies,
        lengths: &[f64],
        series: &mut RigidSeries<S>,
        steps: &mut [Vec<Step>; MOST_LANES],
    ) {
        let mut left = PerLane::default();
        left[..lengths.len()].copy_from_slice(lengths);
        let mut clock = Clock::of(left, 1.0 / self.plan.tolerance);
        let twice = bodies.twice.each_ref().map(|numbers| Real::load(simd, numbers));
        while (0..lengths.len()).any(|lane| clock.left(lane) > 0.0) {
            let is_flying: [bool; MOST_LANES] = std::array::from_fn(|lane| clock.left(lane) > 0.0);
            let h = bodies.step(simd, self.plan, series, &mut clock);
            let defect = series.defect(self.plan.order, h, twice);
            let mut stored: [PerLane; 4] = [[0.0; MOST_LANES]; 4];
            store([h, defect.turn, defect.rates, defect.rounding], &mut stored);
            for (lane, steps) in steps.iter_mut().enumerate().filter(|(lane, _)| is_flying[*lane]) {
                let [h, turn, rates, rounding] = stored.each_ref().map(|lanes| lanes[lane]);
                steps.push(Step { h, turn, rates, rounding, after: bodies.rates(lane) });
            }
        }
    }

    /// Adds the jump to the state with this `index`, after the last piece of its step, and returns its shift.
    fn jump(&self, index: usize, turn: [f64; 4], pieces: &mut [Step]) -> f64 {
        let (&[w, x, y, z, first, second, third], time) =
            (&self.accepted.states[index].data.0[0], self.accepted.times[index]);
        let (Some(last), after) = (pieces.last_mut(), [first, second, third]) else { return 0.0 };
        let jump = Jump::new(turn, last.after, [w, x, y, z], time);
        let size = |[a, b, c]: [f64; 3]| (a * a + b * b + c * c).sqrt();
        let moving = principal_acceleration(self.flight.couplings, last.after).map(|part| part * jump.shift);
        let off: [f64; 3] = std::array::from_fn(|axis| after[axis] - last.after[axis]);
        let left = std::array::from_fn(|axis| off[axis] - moving[axis]);
        // A shift backwards leaves out the end of the series, and with it at most what was counted for it.
        let (square, widest) = (jump.shift * jump.shift, self.errors.widest());
        let measured = size(left) + OF_JUMP * (size(off) + size(moving)) + OF_SQUARE * widest.powi(3) * square;
        last.rounding += measured + last.rates;
        last.turn = jump.turn + jump::OF_SQUARE * (widest * widest - 1.0) * square + 2.0 * last.turn;
        last.h += jump.shift.abs();
        last.after = after;
        jump.shift
    }
}

#[cfg(test)]
mod tests;
