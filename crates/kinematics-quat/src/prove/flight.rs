//! A bound of the error of a whole flight: the sum of the bounds of its steps, and what the rounding of
//! the toss itself adds. The theorem and its proof are in `docs/proofs/enclosure.md`, whose numbers of formulas stand here
//! in brackets.
//!
//! No step magnifies an error, because each one multiplies unit quaternions. The error of the rates is split in two parts.
//! An error of the direction of η is a turn of the coin about its own axis, which changes the flight no more than that turn
//! itself. An error of |η| is measured, because the true |η| never changes.

use dynamics::body_rate::body_precession_rate;
use dynamics::{CoinToss, Flight, Launch};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use crate::prove::coin_step::{StepBound, Steps};
use crate::prove::rigid_lanes::Bound;
use crate::taylor::coin::Record;

/// A |η| below which it turns the coin by less than can be told from no turn.
const NO_RATE: f64 = 1e-140;

/// More than underflow, and an |η| below [`NO_RATE`], can add to the error of an attitude.
const TINY: f64 = 1e-90;

/// The largest error of an attitude for which the bounds of second order hold.
const LARGEST: f64 = 1e-3;

/// More than the error of 25 u² of the inertia ratio and of the time, and of the operations on them.
const OF_DOUBLE_DOUBLE: f64 = 100.0 * UNIT_ROUNDOFF * UNIT_ROUNDOFF;

/// What the bound of the steps of a flight with this `record` depends on.
pub(crate) fn steps(toss: &CoinToss, flight: &Flight, record: &Record) -> Steps {
    let [least, most] = record.moduli;
    if record.steps == 0 {
        return Steps::default();
    }
    Steps {
        modulus: most,
        spread: if most > NO_RATE { (most - least) / most } else { 0.0 },
        half_z: 0.5 * flight.rate.z,
        q: body_precession_rate(toss.coin.inertia_ratio(), flight.rate.z),
        longest: record.longest,
    }
}

/// An upper bound of the distance between the computed quaternion P, divided by its norm, and that of the ideal flight;
/// infinite where the theorem does not apply. It is the formula (4).
pub(crate) fn attitude_bound(toss: &CoinToss, flight: &Flight, record: &Record, step: &StepBound) -> f64 {
    let rate = flight.rate;
    let modulus = modulus(flight);
    let has_rate = modulus.hi() > NO_RATE;
    let eta = if has_rate { step.eta } else { 0.0 };
    let steps = record.steps as f64;
    let of_steps = steps * (step.turn + step.rates + eta);
    let of_launch = Launched::new(toss, flight);
    let drift = if record.steps > 0 {
        let off = |measured: f64| (measured - modulus.hi()).abs();
        record.moduli.into_iter().map(off).fold(0.0, f64::max) + modulus.lo().abs()
    } else {
        0.0
    };
    let along = drift + of_launch.rate * (modulus.hi() + 0.5 * rate.z.abs()) + 2.0 * of_launch.q;
    let of_time = 0.5 * rate.norm() * of_launch.time;
    let sum = of_steps + along * flight.span() + of_launch.rate + of_time + TINY;
    whole(sum)
}

/// The bound of an attitude from the sum of all errors; infinite where the theorem does not apply. The steps multiply
/// quaternions whose norm is 1 to within the error itself, and the last factor covers the rounding of the sum.
pub(super) fn whole(sum: f64) -> f64 {
    let bound = sum * (1.0 + 4.0 * sum) * (1.0 + 1e-9);
    if bound < LARGEST { bound } else { f64::INFINITY }
}

/// [`attitude_bound`] of any body.
pub(crate) fn attitude_bound_of_body(launch: &Launch, flight: &Flight, bound: &Bound) -> f64 {
    whole(bound.turn + 0.5 * bound.fastest * time_error(launch, flight) + TINY)
}

/// |η| at launch, in the unit of the flight, to 12 u² of itself.
fn modulus(flight: &Flight) -> DoubleDouble {
    let square = |part: f64| DoubleDouble::product(part, part);
    (square(flight.rate.x) + square(flight.rate.y)).sqrt().half()
}

/// By how much the numbers of a flight differ from those of its toss.
struct Launched {
    /// Relative error of each rate.
    rate: f64,
    /// Of q, in the unit of the flight.
    q: f64,
    /// Of the time of flight, in the unit of the flight.
    time: f64,
}

impl Launched {
    fn new(toss: &CoinToss, flight: &Flight) -> Self {
        let (k, rate_z) = (toss.coin.exact_inertia_ratio(), flight.rate.z);
        let q = (k - 1.0.into()) * rate_z - body_precession_rate(k.hi(), rate_z).into();
        let rate = toss.launch.rate_error();
        Self {
            rate,
            q: q.hi().abs() * (1.0 + 4.0 * UNIT_ROUNDOFF) + (OF_DOUBLE_DOUBLE + 1.01 * rate) * 2.0 * rate_z.abs(),
            time: time_error(&toss.launch, flight),
        }
    }
}

/// By how much the time of a flight differs from that of its launch, in the unit of the flight.
fn time_error(launch: &Launch, flight: &Flight) -> f64 {
    let exact = launch.time_of_flight().exact();
    // The scale is a power of two, so that its mantissa is 1.
    let (_, exponent) = mantissa_and_exponent(power_of_two_scale(launch.rate().amax()));
    let time = exact.mantissa().times_power_of_two(exact.exponent() + exponent);
    (time - flight.span().into()).hi().abs() + OF_DOUBLE_DOUBLE * flight.span()
}

#[cfg(test)]
mod tests;
