//! How far the toss of any rigid body is from the other outcome, and the speeds with which it lands heads.
//!
//! A step of the search evaluates cos θ in a [`Ball`](numerics::Ball) that contains a whole interval of one input, so
//! that an interval whose ball has the sign of the launch holds no flip. Steps shrink towards a flip, and no flip is
//! passed over. Next to one they have more digits. On the separatrix no ball has a sign, because the motion has another
//! form there; cos θ of a given time is continuous, and a shortest step between two tosses that are decided passes it as it
//! passes a touch. A search that ends before its limit, for want of work or digits, says how far it went.

use dynamics::{Outcome, SolveError, Stage, TimeOfFlight, Toss};
use numerics::DoubleDouble;

use super::walk::{End, Input, Line, RESOLUTION, Walk};
use super::{certify, cos_tilt, turn_and_rate, turned_at_launch};
use crate::margin::{Margin, TURN_RANGE, margin_coin, rate_range, speed_and_gravity, thrown_speeds_of_heads};

/// The margin of the toss of any body. That of a coin is by [`margin`].
///
/// Two flips nearer to each other than 5e-13 of their distance may count as none. All inputs take some hundred
/// milliseconds, and each search takes less than a second: a range says where it ended.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub fn margin(toss: &Toss) -> Result<Margin, SolveError> {
    if let Some(toss) = toss.coin() {
        return margin_coin(&toss);
    }
    let outcome = certify(toss)?.outcome();
    if outcome == Outcome::Undecided {
        return Ok(Margin::on_edge(&toss.launch, 0.0, Some([0.0; 2])));
    }
    let (time, speed, gravity, time_range) = of_flight(toss, outcome);
    let rates = [0, 1, 2].map(|axis| of_rate(toss, axis, outcome));
    let (rate, rate_range) = (rates.map(|(change, _)| change), rates.map(|(_, range)| range));
    Ok(Margin { time, speed, gravity, tilt: of_tilt(toss)?, rate, rate_range, time_range: Some(time_range) })
}

/// A flip, if a search found one, and how far the search went.
type Found = (Option<f64>, f64);

/// The first flip in the direction of `sense` up to `limit`, and how far the search went.
fn first(line: &Line<'_>, outcome: Outcome, sense: f64, limit: f64) -> Found {
    let mut walk = Walk::new(line, outcome, sense, limit, 0.0);
    match walk.next_flip() {
        End::Flip(distance) => (Some(sense * distance), distance),
        End::Limit => (None, limit),
        End::Spent(distance) => (None, distance),
    }
}

/// Of the time of flight, the speed and gravity, and the range of times that was searched.
fn of_flight(toss: &Toss, outcome: Outcome) -> (Option<f64>, Option<f64>, Option<f64>, [f64; 2]) {
    let flight = toss.launch.time_of_flight();
    let turn_rate = toss.launch.turn_rate();
    if turn_rate == 0.0 {
        return (None, None, None, [f64::INFINITY; 2]);
    }
    let line = Line::new(toss, Input::Time);
    let limits = [flight.seconds(), TURN_RANGE / turn_rate];
    let [earlier, later] =
        [(-1.0, limits[0]), (1.0, limits[1])].map(|(sense, limit)| first(&line, outcome, sense, limit));
    let thrown = |change: f64| speed_and_gravity(flight, change);
    let by = |size: &dyn Fn(f64) -> Option<f64>| nearest([earlier, later], limits[0], size);
    (by(&Some), by(&|change| thrown(change)[0]), by(&|change| thrown(change)[1]), [earlier.1, later.1])
}

/// The `size` of the nearer flip in time, unless a search ended before it could have found one as near. An earlier flip is at
/// most `whole` earlier, the time of flight.
fn nearest([earlier, later]: [Found; 2], whole: f64, size: &dyn Fn(f64) -> Option<f64>) -> Option<f64> {
    let changes = [earlier.0, later.0].map(|flip| flip.and_then(size));
    let found = changes.into_iter().flatten().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let covers = |at: f64| size(at).is_none_or(|end| end.abs() >= found.abs());
    let has_all_earlier = earlier.0.is_none() && earlier.1 >= whole;
    ((has_all_earlier || covers(-earlier.1)) && covers(later.1)).then_some(found)
}

/// Of a rate, and the largest change that was searched.
fn of_rate(toss: &Toss, axis: usize, outcome: Outcome) -> Found {
    let line = Line::new(toss, Input::Rate(axis));
    let range = rate_range(&toss.launch);
    let up = first(&line, outcome, 1.0, range);
    nearest_rate(up, first(&line, outcome, -1.0, up.1), range)
}

/// The nearer flip of a rate, and the largest change that was searched: the whole `range` if there is a flip. The search
/// downwards goes no further than that upwards.
fn nearest_rate((up, up_range): Found, (down, down_range): Found, range: f64) -> Found {
    match (up, down) {
        (_, Some(down)) => (Some(down), range),
        // The search downwards has to reach as far as the flip upwards.
        (Some(up), None) if down_range >= up_range => (Some(up), range),
        _ => (None, down_range),
    }
}

/// Of the tilt: f(δ) = f cos δ + f(90°) sin δ.
fn of_tilt(toss: &Toss) -> Result<Option<f64>, SolveError> {
    // Heights near 0 lose digits of the turn.
    const WITHIN: f64 = 1.355_252_715_606_880_5e-20; // 2^-66
    let (turn, _) = turn_and_rate(toss, toss.launch.time_of_flight().into(), Stage::DoubleDouble, WITHIN)?;
    let attitude = toss.launch.attitude();
    let [height, turned]: [DoubleDouble; 2] = [attitude.exact_vertical(), attitude.exact_quarter_turned_vertical()]
        .map(|vertical| cos_tilt(&turn, &vertical));
    Ok(Some(-(height / turned).hi().atan()).filter(|change| change.is_finite()))
}

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if its time of flight
/// was given without a speed; none if `slowest` is not slower. Two flips nearer to each other than 1e-12 of the time of flight may count as none.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`]; [`SolveError::StepLimit`] if the motion stays so near to cos θ = 0, or so near to the
/// separatrix, that the search ended before the last speed.
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
    let mut flips = Walk::new(&line, first, 1.0, to - start, start).starting_at(start - to);
    let (mut intervals, mut begin) = (Vec::new(), (first == Outcome::Heads).then_some(slowest));
    loop {
        match flips.next_flip() {
            End::Flip(change) => {
                let at = speed_of(to + change);
                match begin.take() {
                    Some(begin) => intervals.push([begin, at]),
                    None => begin = Some(at),
                }
            }
            End::Limit => break,
            End::Spent(change) => {
                return Err(SolveError::StepLimit { time: to + change, limit: super::walk::MOST_WORK });
            }
        }
    }
    intervals.extend(begin.map(|begin| [begin, speed]));
    Ok(Some(intervals))
}

#[cfg(test)]
mod tests;
