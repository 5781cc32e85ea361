//! How far a toss is from the other outcome: for each input alone, the nearest value that lands the other way.
//!
//! The search walks along the exact motion in steps that are proven free of flips (`margin/search.rs`), so that it passes
//! none over. What it walks along is the turn of the coin, Φ = (ωx, ωy, k ωz) T, on which cos θ depends so smoothly
//! (`margin/height.rs`) that one value and one slope exclude a flip for up to some radians. A cone that does not reach the
//! horizontal excludes one for good (`margin/line.rs`).
//!
//! | input | line of turns | searched |
//! |---|---|---|
//! | ωx, ωy, ωz | parallel to an axis | changes up to [`Margin::rate_range`] |
//! | time of flight | none: a closed form (`margin/time.rs`) | all |
//! | speed, gravity | none: each time of flight has one of each | all |
//! | tilt | none: f(δ) = f cos δ + f(90°) sin δ | all |

mod digits;
mod flight;
mod height;
mod line;
mod search;
mod time;

use dynamics::phase::LARGEST_PHASE;
use dynamics::time_of_flight::ExactTime;
use dynamics::{CoinToss, Launch, Outcome, SolveError, TimeOfFlight};
use numerics::DoubleDouble;

pub(crate) use self::flight::speed_and_gravity;
use self::height::Height;
use self::line::Line;
use self::search::{MOST_WORK, Walk};
use crate::certified::certify_coin;
use crate::heads::HeadsPhases;
use crate::motion::CoinMotion;

/// The changes of one input alone, with their signs, to the nearest value that lands the other way; each is right to a
/// relative 1e-12.
///
/// `None` where no value does, or, of a rate, none in the range. An undecided toss is on the edge: all its margins are 0. A
/// motion that touches the edge and turns back does not flip there, nor, along a rate, does one that is beyond it for less
/// than 5e-13 of its distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Margin {
    /// Of the time of flight (s).
    pub time: Option<f64>,
    /// Of the speed (m/s); `None` also where the time was given instead.
    pub speed: Option<f64>,
    /// Of gravity (m/s²); `None` also where the time was given instead.
    pub gravity: Option<f64>,
    /// Of the tilt at launch: a further turn about the lab's x axis (rad), from -π/2 to π/2.
    pub tilt: Option<f64>,
    /// Of ωx, ωy, ωz (rad/s).
    pub rate: [Option<f64>; 3],
    /// The largest changes of ωx, ωy, ωz that were searched (rad/s): 1000, or ten times the largest rate of the launch if
    /// that is more, but no further turn than 2000 rad and no phase that is too large to have an outcome. Less where the
    /// motion touches the edge so often that the search was ended.
    pub rate_range: [f64; 3],
    /// The largest changes of the time of flight that were searched: earlier, down to 0 at most, and later (s). `None`
    /// for a coin, of which all times are searched. Of another body the changes of the time, the speed and gravity are
    /// `None` also where no flip is in the range, or where the nearest of them might lie beyond it.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub time_range: Option<[f64; 2]>,
}

/// Changes of a rate that are searched (rad/s): 160 turns a second, four times what a hand gives a coin.
const RATE_RANGE: f64 = 1000.0;

/// Changes of the turn that are searched (rad), which bounds the work. Flips further away than some turns are rare.
pub(crate) const TURN_RANGE: f64 = 2000.0;

/// The margin of the toss of a coin.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub(crate) fn margin_coin(toss: &CoinToss) -> Result<Margin, SolveError> {
    let outcome = match certify_coin(toss)?.outcome() {
        Outcome::Heads => 1.0,
        Outcome::Tails => -1.0,
        Outcome::Undecided => return Ok(Margin::on_edge(&toss.launch, rate_range(&toss.launch), None)),
    };
    let turn = line::turn(toss);
    let [time, speed, gravity] = of_flight(toss, outcome)?;
    let rates = [0, 1, 2].map(|axis| of_rate(toss, axis, turn, outcome));
    let (rate, rate_range) = (rates.map(|(change, _)| change), rates.map(|(_, range)| range));
    Ok(Margin { time, speed, gravity, tilt: of_tilt(toss, turn), rate, rate_range, time_range: None })
}

/// The largest change of a rate that is searched (rad/s).
pub(crate) fn rate_range(launch: &Launch) -> f64 {
    (10.0 * launch.rate().amax()).max(RATE_RANGE).min(TURN_RANGE / launch.flight_time()).min(f64::MAX)
}

impl Margin {
    /// The margin of an undecided toss, with these ranges.
    pub(crate) fn on_edge(launch: &Launch, rate_range: f64, time_range: Option<[f64; 2]>) -> Self {
        let zero = Some(0.0);
        let thrown = if matches!(launch.time_of_flight(), TimeOfFlight::Given(_)) { None } else { zero };
        Self {
            time: zero,
            speed: thrown,
            gravity: thrown,
            tilt: zero,
            rate: [zero; 3],
            rate_range: [rate_range; 3],
            time_range,
        }
    }
}

/// Of the time of flight, the speed and gravity.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
fn of_flight(toss: &CoinToss, outcome: f64) -> Result<[Option<f64>; 3], SolveError> {
    let motion = CoinMotion::new(toss);
    let flight = toss.launch.time_of_flight();
    let (phase, _) = motion.phases(flight)?;
    if motion.precession_rate() == 0.0 {
        return Ok([None; 3]);
    }
    let Some([later, earlier]) = time::flips(toss, phase) else { return Ok([None; 3]) };
    let time_of = |phase: f64| Some(motion.time_of(phase)).filter(|change| change.is_finite());
    let later = time_of(later).filter(|_| later < LARGEST_PHASE - phase.hi());
    let earlier = time_of(earlier).filter(|_| {
        // Next to the launch, the phase does not tell whether the flip is after it. It is if the face then was the other.
        let [.., at_launch] = toss.launch.attitude().exact_vertical();
        let from_launch = earlier + phase.hi();
        let is_near = from_launch.abs() <= 1e-12 * phase.hi();
        if is_near { at_launch.hi() * outcome < 0.0 } else { from_launch.is_sign_positive() }
    });
    let thrown =
        [later, earlier].map(|change| change.map_or([None; 2], |change| flight::speed_and_gravity(flight, change)));
    let [later_thrown, earlier_thrown] = thrown;
    Ok([
        smaller(later, earlier),
        smaller(later_thrown[0], earlier_thrown[0]),
        smaller(later_thrown[1], earlier_thrown[1]),
    ])
}

/// The smaller of two changes.
fn smaller(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    [a, b].into_iter().flatten().min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Of a rate, with the `turn` Φ of the landing; and the largest change that was searched.
fn of_rate(toss: &CoinToss, axis: usize, turn: [DoubleDouble; 3], outcome: f64) -> (Option<f64>, f64) {
    let flight = toss.launch.time_of_flight();
    let (time, range) = (ExactTime::from(flight), rate_range(&toss.launch));
    let ratio = ratio(toss, axis);
    if ratio.hi() == 0.0 || !flight.is_positive() {
        return (None, range);
    }
    let line = Line::of_rate(toss, axis, turn);
    let walk = |sense: f64| Walk::new(&line, outcome, sense, limit(toss, axis, &line, sense), MOST_WORK);
    let rate_of =
        |turn: f64| (DoubleDouble::from(turn) / time.mantissa() / ratio).times_power_of_two(-time.exponent()).hi();
    match Walk::nearer([walk(1.0), walk(-1.0)]) {
        Ok(change) => (change.map(rate_of).filter(|change| change.is_finite()), range),
        Err(distance) => (None, rate_of(distance)),
    }
}

/// The change of Φ with a change of a rate, in units of the time of flight.
fn ratio(toss: &CoinToss, axis: usize) -> DoubleDouble {
    if axis == 2 { toss.coin.exact_inertia_ratio() } else { 1.0.into() }
}

/// The largest change of Φ (rad) that is searched along a rate: neither phase gets too large.
fn limit(toss: &CoinToss, axis: usize, line: &Line<'_>, sense: f64) -> f64 {
    let (ratio, across) = (ratio(toss, axis).hi(), line.across());
    let phase_limit = ((LARGEST_PHASE - across) * (LARGEST_PHASE + across)).max(0.0).sqrt();
    // Of Φz, by which the phase of the spin stays below its limit.
    let spin_limit = if axis == 2 { LARGEST_PHASE * ratio / (ratio - 1.0).abs() } else { LARGEST_PHASE };
    let reach = rate_range(&toss.launch) * ratio * toss.launch.flight_time();
    reach.min(phase_limit.min(spin_limit) - sense * line.along().hi())
}

/// Of the tilt.
fn of_tilt(toss: &CoinToss, turn: [DoubleDouble; 3]) -> Option<f64> {
    let by_line = (0..2).map(|stage| line::tilted_heights(toss, turn, stage));
    let change = by_line.filter_map(tilt_to_flip).next().unwrap_or_else(|| tilt_to_0(&digits::tilted_heights(toss)));
    Some(change).filter(|change| change.is_finite())
}

/// The change δ of the tilt for which cos θ = f cos δ + f(90°) sin δ is 0.
fn tilt_to_0([height, turned]: &[Height; 2]) -> f64 {
    -(height.value / turned.value).atan()
}

/// That change if the errors leave it right to a relative 4e-13.
fn tilt_to_flip(heights: [Height; 2]) -> Option<f64> {
    let change = tilt_to_0(&heights);
    let [height, turned] = heights;
    let size = height.value.abs().max(turned.value.abs());
    (height.error + turned.error < 4e-13 * size * change.abs()).then_some(change)
}

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if it was not thrown
/// and caught at the same height. A motion of many turns has as many intervals.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub fn level_speeds_of_heads(
    toss: &CoinToss,
    slowest: f64,
) -> Result<Option<impl Iterator<Item = [f64; 2]> + use<>>, SolveError> {
    let TimeOfFlight::Ballistic { speed, gravity } = toss.launch.time_of_flight() else { return Ok(None) };
    let motion = CoinMotion::new(toss);
    let fastest_phase = motion.phases(toss.launch.time_of_flight())?.0.hi();
    let slowest_phase = motion.phases(TimeOfFlight::Ballistic { speed: slowest, gravity })?.0.hi();
    // Without a precession every speed has the outcome of the launch, and a phase of 0 no length.
    let still = fastest_phase == slowest_phase;
    let span = if still { [slowest, speed] } else { [slowest_phase, fastest_phase] };
    let heads = if still { HeadsPhases::constant(motion.cos_tilt(0.0)?) } else { motion.heads() };
    let speed_of = move |phase: f64| {
        if still { phase } else { slowest + (phase - span[0]) / (span[1] - span[0]) * (speed - slowest) }
    };
    Ok(Some(heads.intervals(span[0], span[1]).map(move |interval| interval.map(speed_of))))
}

/// As [`level_speeds_of_heads`], for a landing at any height; `None` if the time of flight was given without a speed.
///
/// A landing at h below the launch has the time T = (v0 + √(v0² + 2 g h))/g, which a throw at u = g T/2 has without the
/// drop; back from it, v0 = u - g h/(2 u).
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub(crate) fn thrown_speeds_of_heads(toss: &CoinToss, slowest: f64) -> Result<Option<Vec<[f64; 2]>>, SolveError> {
    let TimeOfFlight::BallisticTo { speed, gravity, drop } = toss.launch.time_of_flight() else {
        return Ok(level_speeds_of_heads(toss, slowest)?.map(Iterator::collect));
    };
    let level = |speed: f64| 0.5 * gravity * TimeOfFlight::BallisticTo { speed, gravity, drop }.seconds();
    let (from, to) = (level(slowest), level(speed));
    let as_level = TimeOfFlight::Ballistic { speed: to, gravity };
    // The time of flight is that of the valid launch to rounding, so that only the largest of all f64 can be too large.
    let too_large = |_| SolveError::PhaseTooLarge { phase: f64::MAX };
    let level_toss = CoinToss { launch: toss.launch.with_time_of_flight(as_level).map_err(too_large)?, ..*toss };
    let speed_of = |level: f64| match level {
        end if end <= from => slowest,
        end if end >= to => speed,
        level => (level - 0.5 * gravity * drop / level).clamp(slowest, speed),
    };
    Ok(level_speeds_of_heads(&level_toss, from)?.map(|heads| heads.map(|interval| interval.map(speed_of)).collect()))
}

#[cfg(test)]
mod tests;
