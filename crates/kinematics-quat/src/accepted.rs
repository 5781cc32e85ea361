//! Bounds of the error of a coin's flight by a Runge-Kutta scheme. Each accepted step is compared with the Taylor series that
//! starts where the step does, and whose own error is bounded; what the step lands off it is measured. The theorem is in
//! `docs/proofs/enclosure.md`, section 8, whose numbers of formulas stand here in brackets.
//!
//! Once the ends of the steps are known, no step depends on another one, so that as many are compared at once as a vector
//! has lanes.

use dynamics::integrate::Accepted;
use dynamics::{Flight, SolveError, Toss, Work};
use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{Simd, SimdLevel, WithSimd};

use crate::coins::{Coins, End};
use crate::defect::bounds;
use crate::enclosure::{NO_RATE, Record, attitude_bound, steps};
use crate::integration::Integration;
use crate::jump::{Elapsed, Jump, OF_JUMP, lengths};
use crate::lockstep::{Clock, MOST_LANES, Motion, PerLane};
use crate::plan::Plan;
use crate::proven::IntegratedCertificate;
use crate::taylor::LARGEST_ORDER;
use crate::{Landed, QuaternionSolver, QuaternionSystem};

/// How far the fastest term of a series may turn in one piece of a step (rad). At the largest order the terms that are left
/// out are then below the rounding.
const LONGEST_PIECE: f64 = 2.3;

/// A step that takes more pieces than these turns by so much that it has no useful bound.
const MOST_PIECES: f64 = 64.0;

impl QuaternionSolver {
    /// The landing of `toss` by the solver's Runge-Kutta scheme with its bound.
    pub(crate) fn enclosed_by_steps(&self, toss: &Toss, level: SimdLevel) -> Result<IntegratedCertificate, SolveError> {
        let (flight, accepted) = self.accepted(toss)?;
        let compared = Compared::new(toss, &flight, &accepted, level);
        let end = accepted.states.last().ok_or_else(|| flight.not_finite())?;
        let landed = Landed::at(&flight, end, accepted.work + compared.work);
        self.stated(toss.launch.attitude(), &landed, compared.bound, Integration::AsConfigured)
    }

    /// The accepted steps of a flight by a Runge-Kutta scheme.
    fn accepted(&self, toss: &Toss) -> Result<(Flight, Accepted<6>), SolveError> {
        let flight = Flight::new(toss)?;
        let (system, start) = QuaternionSystem::launching(toss, &flight);
        Ok((flight, flight.integrate_steps(&system, start, &self.stepping)?))
    }
}

/// The bound of a flight, and the coefficients that it took.
struct Compared {
    /// As [`attitude_bound`].
    bound: f64,
    work: Work,
}

impl Compared {
    /// Compares the `accepted` steps of a flight with series.
    fn new(toss: &Toss, flight: &Flight, accepted: &Accepted<6>, level: SimdLevel) -> Self {
        let mut found = Self { bound: f64::INFINITY, work: Work::default() };
        let QuaternionSystem { rate_z, q } = QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z);
        let (half_z, lengths) = (0.5 * rate_z, lengths(accepted, flight.rate.amax() == 0.0));
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let turning = longest * fastest(flight, half_z, q);
        let pieces = (turning / LONGEST_PIECE).ceil().max(1.0);
        if pieces > MOST_PIECES {
            return found;
        }
        let plan = Plan::of_equal_steps(order(turning / pieces), longest / pieces);
        let record = level.run(Comparison { plan: &plan, accepted, lengths: &lengths, half_z, q, flight });
        let step = bounds(&plan, SimdLevel::for_one_lane(), &[steps(toss, flight, &record)]);
        found.bound = attitude_bound(toss, flight, &record, &step[0]);
        found.work.rhs_calls = record.steps * plan.order as u64;
        found
    }
}

/// The rate of the fastest terms of the series of a step.
fn fastest(flight: &Flight, half_z: f64, q: f64) -> f64 {
    let (x, y, z) = (0.5 * flight.rate.x, 0.5 * flight.rate.y, half_z + 0.5 * q);
    (x * x + y * y + z * z).sqrt() + 1.5 * q.abs()
}

/// The smallest even order from which on the terms xⁿ/n! are below the rounding, or the largest one.
fn order(x: f64) -> usize {
    let (mut order, mut term) = (0, 1.0);
    while order < LARGEST_ORDER && (term > 0.1 * UNIT_ROUNDOFF || order < 10) {
        #[expect(clippy::cast_precision_loss, reason = "an order")]
        let factor = ((order + 1) * (order + 2)) as f64;
        (order, term) = (order + 2, term * x * x / factor);
    }
    order
}

/// The comparison of all steps of a flight, with the same bits at every SIMD level.
struct Comparison<'a> {
    plan: &'a Plan,
    accepted: &'a Accepted<6>,
    lengths: &'a [f64],
    flight: &'a Flight,
    half_z: f64,
    q: f64,
}

impl WithSimd for Comparison<'_> {
    type Output = Record;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Record {
        let mut series = Coins::series(simd);
        let mut record = Record { moduli: [f64::INFINITY, 0.0], ..Record::default() };
        let mut elapsed = Elapsed::ZERO;
        for (chunk, lengths) in self.lengths.chunks(S::F64_LANES).enumerate() {
            let first = chunk * S::F64_LANES;
            let (mut coins, mut left) = (Coins::default(), PerLane::default());
            for (lane, length) in lengths.iter().enumerate() {
                coins.start(lane, &self.accepted.states[first + lane].data.0[0], [self.half_z, self.q]);
                left[lane] = *length;
            }
            let (mut clock, mut ends) = (Clock::of(left, 1.0), [End::default(); MOST_LANES]);
            while (0..lengths.len()).any(|lane| clock.left(lane) > 0.0) {
                let before = left;
                coins.advance(simd, self.plan, &mut series, &mut clock);
                for lane in 0..lengths.len() {
                    left[lane] = clock.left(lane);
                    // A step that has ended goes on with steps of no length.
                    if before[lane] > 0.0 {
                        ends[lane] = End { pieces: ends[lane].pieces + 1, ..coins.end(lane) };
                    }
                }
            }
            for (lane, end) in ends[..lengths.len()].iter().enumerate() {
                let (after, time) = (self.accepted.states[first + lane + 1], self.accepted.times[first + lane + 1]);
                let shift = end.compare(&after.data.0[0], self.flight.rate.z, self.q, time, &mut record);
                elapsed.add(lengths[lane], shift);
            }
        }
        Record { strayed: elapsed.off(self.flight.span()), ..record }
    }
}

impl End {
    /// Records the step that ends in the state `after` instead, and returns its shift.
    fn compare(&self, after: &[f64; 6], rate_z: f64, q: f64, time: f64, record: &mut Record) -> f64 {
        let &[w, x, y, z, rate_x, rate_y] = after;
        let [eta, lost] = self.eta;
        let jump = Jump::new(self.attitude, [2.0 * eta[0], 2.0 * eta[1], rate_z], [w, x, y, z], time);
        record.steps += self.pieces;
        record.moduli = [record.moduli[0].min(self.moduli[0]), record.moduli[1].max(self.moduli[1])];
        record.longest = record.longest.max(self.longest);
        record.jumps += jump.turn;
        let size = eta[0].abs().max(eta[1].abs());
        if size > NO_RATE {
            record.jumps += turned_off(eta, lost, [0.5 * rate_x, 0.5 * rate_y], q * jump.shift);
        }
        jump.shift
    }
}

/// A bound of the angle from η of the series, less its rounding error, turned by `further`, to η of the step.
fn turned_off(eta: [f64; 2], lost: [f64; 2], step: [f64; 2], further: f64) -> f64 {
    let off = [(step[0] - eta[0]) - lost[0], (step[1] - eta[1]) - lost[1]];
    let size = |of: [f64; 2]| (of[0] * of[0] + of[1] * of[1]).sqrt();
    let (size, off_by) = (size(eta), size(off) / size(eta));
    if off_by < 0.5 {
        let sine = (eta[0] * off[1] - eta[1] * off[0]) / (size * (step[0] * step[0] + step[1] * step[1]).sqrt());
        (sine - further).abs() + sine.abs().powi(3) + OF_JUMP * (off_by + further.abs())
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests;
