//! The speeds with which a toss lands heads.

use dynamics::{CoinToss, Outcome, SolveError, TimeOfFlight, Toss};

use crate::flips::{End, Flips, MOST_WORK, RESOLUTION};
use crate::heads::HeadsPhases;
use crate::motion::CoinMotion;
use crate::rigid::line::{Input, Line};
use crate::rigid::turned_at_launch;

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if its time of flight
/// was given without a speed; none if `slowest` is not slower. Two flips nearer to each other than 1e-12 of the time of
/// flight may count as none. Fails with [`SolveError::PhaseTooLarge`]; [`SolveError::StepLimit`] if the motion stays so
/// near to cos θ = 0, or so near to the separatrix, that the search ended before the last speed.
pub fn speeds_of_heads(toss: &Toss, slowest: f64) -> Result<Option<Vec<[f64; 2]>>, SolveError> {
    let (speed, gravity, drop) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity, 0.0),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => (speed, gravity, drop),
        TimeOfFlight::Given(_) => return Ok(None),
    };
    if let Some(toss) = toss.coin() {
        return thrown_speeds_of_heads(&toss, slowest);
    }
    turned_at_launch(toss, toss.launch.time_of_flight().into())?;
    let to = toss.launch.flight_time();
    let from = TimeOfFlight::BallisticTo { speed: slowest, gravity, drop }.seconds();
    let speed_of = |time: f64| (0.5 * gravity * time - drop / time).clamp(slowest.min(speed), speed);
    if from.is_nan() || from >= to {
        return Ok(Some(Vec::new()));
    }
    let line = Line::new(toss, Input::Time);
    // A toss that begins on edge, but for the rounding of the time, has the outcome of the one next to it.
    let skipped = (RESOLUTION * to).min(0.5 * (to - from));
    let (start, first) = (from + skipped, line.outcome_at(from - to + skipped));
    let mut flips = Flips::new(&line, first, 1.0, to - start, start).starting_at(start - to);
    let (mut intervals, mut begin) = (Vec::new(), (first == Outcome::Heads).then_some(slowest));
    loop {
        match flips.next() {
            End::Flip(change) => {
                let at = speed_of(to + change);
                match begin.take() {
                    Some(begin) => intervals.push([begin, at]),
                    None => begin = Some(at),
                }
            }
            End::Limit => break,
            End::Spent(change) => {
                return Err(SolveError::StepLimit { time: to + change, limit: MOST_WORK });
            }
        }
    }
    intervals.extend(begin.map(|begin| [begin, speed]));
    Ok(Some(intervals))
}

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if it was not thrown
/// and caught at the same height. A motion of many turns has as many intervals.
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
