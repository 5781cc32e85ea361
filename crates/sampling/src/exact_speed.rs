//! This file computes the share of heads over all speeds in closed form. It replaces the sampling of one coordinate by
//! a formula, which makes this method far more accurate than the others.
//!
//! With everything but the speed fixed, the phase at landing ωL T = 2 ωL v0/g is proportional to v0. The coin lands
//! heads while this phase is within the half-width w of a crest c + 2π n ([`HeadsPhases`]). So the probability of heads
//! is that of these intervals under the distribution of the phase:
//!
//! ```text
//! v0 uniform, phase from a to b:    P = (H(b) - H(a))/(b - a),   H(x) = 2 w n + clamp(x - c - 2π n, -w, w)
//! v0 normal, phase with μ and σ:    P = Σ Φ((c + 2π n + w - μ)/σ) - Φ((c + 2π n - w - μ)/σ)
//! ```
//!
//! where n is the turn whose crest is nearest to x, and Φ the normal distribution function. For σ ≥ 9 the phase is
//! uniform on the circle within (2/π) exp(-σ²/2) < 2e-18, and P = w/π.

pub(crate) mod lanes;

use std::f64::consts::{PI, SQRT_2, TAU};

use dynamics::phase::require_phase;
use dynamics::{Coin, CoinToss, Outcome, SolveError, Toss};
use exact::{HeadsPhases, TiltTerms, certify};
use numerics::UNIT_ROUNDOFF;

use crate::axis::{Distribution, NORMAL_REACH};
use crate::coordinate::Coordinate;
use crate::space::{Space, Values};

/// Error of the distance of a phase φ ≥ 0, at an end of a uniform distribution, from an edge of the heads, in units of 2 + φ.
///
/// With u the [unit roundoff](UNIT_ROUNDOFF), and without the errors of crest and half-width, which are known:
///
/// ```text
/// φ = |L| T                  6u φ            PHASE_ERROR: 4u from |L|, u from T, u from the product
/// φ - crest                  u φ + 3.2u      |crest| ≤ π
/// TAU n                      1.4u φ + 8.5u   0.35u from TAU, u from the product; TAU n ≤ φ + 2π
/// their difference           2u              half a unit of the last place of π: crest n is the nearest
/// its distance to an edge    2u              the same
/// all together               8.4u φ + 15.7u  less than 9u (2 + φ)
/// ```
///
/// The measure of heads has this error, less 2u, from each of its two ends, and 2u φ + 13.5u from its own three operations.
/// Its quotient by the range of phases has the errors of T and of the products, 4u φ, once more. All together, 22.8u φ + 41u is
/// less than three times 9u (2 + φ). What |L|, the range and the quotient add is relative to the share, and 7u at most.
const ROUNDING: f64 = 9.0 * UNIT_ROUNDOFF;

/// The same for an edge under a normal distribution of phases, in units of 2 + φ with the largest φ within its reach.
///
/// ```text
/// mean phase                 8.5u φ          PHASE_ERROR, 1.5u for the ends of the reach, u for their mean
/// crest + TAU n ± width      3.4u φ + 12u
/// standard deviation         0.6u φ          15u φ in 16.6 deviations, as |z| times the density is 0.6 of the highest density
/// all together               12.5u φ + 12u   less than 13u (2 + φ)
/// ```
const NORMAL_ROUNDING: f64 = 13.0 * UNIT_ROUNDOFF;

/// A probability with a bound on its rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Probability of heads, from 0 to 1.
    pub probability: f64,
    /// Bound on the rounding error, from 0 to 1. It is an estimate, not a proof.
    pub error: f64,
}

/// Nothing is known of this share.
const UNKNOWN: Share = Share { probability: 0.5, error: 0.5 };

impl Share {
    pub(crate) fn new(probability: f64, error: f64) -> Self {
        Self { probability: probability.clamp(0.0, 1.0), error: error.min(1.0) }
    }

    /// The share of a single toss: 1 for heads, 0 for tails, and 0.5 ± 0.5 for an exact tie.
    fn of_one(toss: &Toss) -> Result<Self, SolveError> {
        Ok(match certify(toss)?.outcome() {
            Outcome::Heads => Self::new(1.0, 0.0),
            Outcome::Tails => Self::new(0.0, 0.0),
            Outcome::Undecided => UNKNOWN,
        })
    }
}

/// The motion of all launches that differ in their speed alone.
pub(crate) struct Motion {
    pub(crate) heads: HeadsPhases,
    /// The phases at landing of the slowest and of the fastest launch (rad).
    pub(crate) phases: [f64; 2],
    fastest: CoinToss,
}

impl Motion {
    /// The motion of the launches of `space`, which is of `coin`, with all coordinates but the speed as in `values`.
    pub(crate) fn new(space: &Space, coin: Coin, values: &Values) -> Result<Self, (Box<CoinToss>, SolveError)> {
        let toss = |speed: f64| {
            let mut values = *values;
            values[Coordinate::Speed as usize] = speed;
            CoinToss { coin, launch: space.launch(&values) }
        };
        let [slowest, fastest] = space.axis(Coordinate::Speed).bounds().map(toss);
        let terms = TiltTerms::new(&fastest);
        let [to, spin] = terms.phases(fastest.launch.flight_time());
        let [from, _] = terms.phases(slowest.launch.flight_time());
        require_phase(to.max(spin)).map_err(|error| (Box::new(fastest), error))?;
        Ok(Self { heads: terms.heads(), phases: [from, to], fastest })
    }

    /// The share of heads over the speeds of `space`.
    pub(crate) fn share(&self, space: &Space) -> Result<Share, (Box<CoinToss>, SolveError)> {
        let Self { heads, phases: [from, to], fastest, .. } = self;
        // There is but one launch, or none turns.
        if space.axis(Coordinate::Speed).value().is_some() || *to == 0.0 {
            return Share::of_one(&(*fastest).into()).map_err(|error| (Box::new(*fastest), error));
        }
        // The coin shows heads always or never.
        if heads.half_width_error == 0.0 {
            return Ok(Share::new(if heads.half_width > 0.0 { 1.0 } else { 0.0 }, 0.0));
        }
        if from == to {
            return Ok(share_of_one_phase(heads, *to));
        }
        Ok(match space.axis(Coordinate::Speed).distribution() {
            Distribution::Uniform { .. } => uniform_share(heads, *from, *to),
            Distribution::Normal { .. } => {
                let sd = (to - from) / (2.0 * NORMAL_REACH);
                normal_share(heads, 0.5 * (from + to), sd)
            }
        })
    }
}

/// The share of heads over the speeds of `space`, which is of `coin`, with all other coordinates as in `values`.
pub(crate) fn share(space: &Space, coin: Coin, values: &Values) -> Result<Share, (Box<CoinToss>, SolveError)> {
    Motion::new(space, coin, values)?.share(space)
}

/// The share of speeds that differ, and whose phases all round to `phase` (rad). Next to an edge of the heads it is unknown.
fn share_of_one_phase(heads: &HeadsPhases, phase: f64) -> Share {
    let Place { interval, to_edge, .. } = Place::of(heads, phase);
    // Each phase is within one error of the rounded one, and this within one of the edge.
    let edge_error = heads.half_width_error + heads.crest_error + 2.0 * NORMAL_ROUNDING * (2.0 + phase);
    if to_edge > edge_error { Share::new(if interval % 2.0 == 0.0 { 1.0 } else { 0.0 }, 0.0) } else { UNKNOWN }
}

/// The fraction of the phases from `from` to `to` > `from` (rad) that show heads.
fn uniform_share(heads: &HeadsPhases, from: f64, to: f64) -> Share {
    let (begin, end) = (Place::of(heads, from), Place::of(heads, to));
    let turns = end.turn - begin.turn;
    let end_error = ROUNDING * (2.0 + to);
    let edge_error = heads.half_width_error + heads.crest_error + end_error;
    if begin.interval == end.interval && begin.to_edge.min(end.to_edge) > edge_error {
        return Share::new(if begin.interval % 2.0 == 0.0 { 1.0 } else { 0.0 }, 0.0);
    }
    let measure = 2.0 * heads.half_width * turns + (end.within - begin.within);
    let edges = 2.0 * (turns + 1.0) * heads.half_width_error + 2.0 * heads.crest_error.min(PI);
    Share::new(measure / (to - from), (edges + 3.0 * end_error) / (to - from) + ROUNDING)
}

/// The position of a phase among the intervals of heads and tails.
struct Place {
    /// Number of the nearest crest.
    turn: f64,
    /// Phase relative to the nearest crest, clamped to the interval of heads about it (rad).
    within: f64,
    /// Number of the interval: even for heads, odd for tails.
    interval: f64,
    /// Distance to the nearer edge of that interval (rad).
    to_edge: f64,
}

impl Place {
    fn of(heads: &HeadsPhases, phase: f64) -> Self {
        let turn = ((phase - heads.crest) / TAU).round();
        let from_crest = phase - heads.crest - TAU * turn;
        let within = from_crest.clamp(-heads.half_width, heads.half_width);
        let beyond = if from_crest == within { 0.0 } else { from_crest.signum() };
        let to_edge = (from_crest.abs() - heads.half_width).abs();
        Self { turn, within, interval: 2.0 * turn + beyond, to_edge }
    }
}

/// The probability of heads for a normally distributed phase with `mean` and `sd` > 0 (rad).
fn normal_share(heads: &HeadsPhases, mean: f64, sd: f64) -> Share {
    let width = heads.half_width;
    if sd >= 9.0 {
        return Share::new(width / PI, heads.half_width_error / PI);
    }
    let turn_of = |phase: f64| ((phase - heads.crest) / TAU).round();
    let [first, last] = [turn_of(mean - NORMAL_REACH * sd), turn_of(mean + NORMAL_REACH * sd)];
    let below = |phase: f64| 0.5 * libm::erfc((mean - phase) / (sd * SQRT_2));
    let (mut probability, mut turn) = (0.0, first);
    while turn <= last {
        let crest = heads.crest + TAU * turn;
        probability += below(crest + width) - below(crest - width);
        turn += 1.0;
    }
    let highest_density = 0.4 / sd;
    let edge = heads.half_width_error + heads.crest_error + NORMAL_ROUNDING * (2.0 + mean.abs() + NORMAL_REACH * sd);
    Share::new(probability, 2.0 * (last - first + 1.0) * (edge * highest_density + ROUNDING))
}

#[cfg(test)]
mod tests;
