//! How far a toss is from the other outcome: for each input alone, the nearest value that lands the other way.
//!
//! | input | found by | searched |
//! |---|---|---|
//! | ωx, ωy, ωz | steps that are proven free of flips (`flips.rs`) | changes up to [`Margin::rate_range`] |
//! | time of flight | the same; of a coin in closed form (`margin/time.rs`) | changes up to [`Margin::time_range`]; of a coin all |
//! | speed, gravity | the flips in time: each time of flight has one of each | as the time |
//! | tilt | cos θ = f cos δ + f(90°) sin δ | all |

mod flight;
mod time;

use dynamics::phase::LARGEST_PHASE;
use dynamics::{CoinToss, Launch, Outcome, SolveError, TimeOfFlight, Toss};
use numerics::Elementary;

use crate::flips::{Enclosure, End, Flips};
use crate::rigid::certify;
use crate::rigid::line::{Input, Line};

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
const TURN_RANGE: f64 = 2000.0;

/// Changes of the time of flight, the speed and gravity, and the range of times that was searched.
type InFlight = ([Option<f64>; 3], Option<[f64; 2]>);

/// A flip, if a search found one, and how far the search went.
type Found = (Option<f64>, f64);

/// The margin of a toss. Those of a coin take some hundred microseconds.
///
/// Two flips nearer to each other than 5e-13 of their distance may count as none, but for those of a coin in time. All
/// inputs of another body take some hundred milliseconds, and each search at most about half a second: a range says where
/// it ended.
pub fn margin(toss: &Toss) -> Result<Margin, SolveError> {
    let (outcome, range) = (certify(toss)?.outcome(), rate_range(&toss.launch));
    if outcome == Outcome::Undecided {
        let (range, time_range) = if toss.coin().is_some() { (range, None) } else { (0.0, Some([0.0; 2])) };
        return Ok(Margin::on_edge(&toss.launch, range, time_range));
    }
    let ([time, speed, gravity], time_range) = of_flight(toss, outcome)?;
    let rates = [0, 1, 2].map(|axis| of_rate(toss, axis, outcome));
    let (rate, rate_range) = (rates.map(|(change, _)| change), rates.map(|(_, range)| range));
    Ok(Margin { time, speed, gravity, tilt: of_tilt(toss), rate, rate_range, time_range })
}

/// The largest change of a rate that is searched (rad/s).
fn rate_range(launch: &Launch) -> f64 {
    (10.0 * launch.rate().amax()).max(RATE_RANGE).min(TURN_RANGE / launch.flight_time()).min(f64::MAX)
}

impl Margin {
    /// The margin of an undecided toss, with these ranges.
    fn on_edge(launch: &Launch, rate_range: f64, time_range: Option<[f64; 2]>) -> Self {
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

/// Of the time of flight, the speed and gravity, and the range of times that was searched.
fn of_flight(toss: &Toss, outcome: Outcome) -> Result<InFlight, SolveError> {
    let flight = toss.launch.time_of_flight();
    let turn_rate = toss.launch.turn_rate();
    if turn_rate == 0.0 {
        return Ok(([None; 3], toss.coin().is_none().then_some([f64::INFINITY; 2])));
    }
    let found = match toss.coin() {
        Some(coin) => time::flips(&coin, outcome)?.map(|flip| (flip, f64::INFINITY)),
        None => {
            let line = Line::new(toss, Input::Time);
            let limits = [(-1.0, flight.seconds()), (1.0, TURN_RANGE / turn_rate)];
            limits.map(|(sense, limit)| first(&line, outcome, sense, limit))
        }
    };
    let thrown = |change: f64| flight::speed_and_gravity(flight, change);
    let by = |size: &dyn Fn(f64) -> Option<f64>| nearest(found, flight.seconds(), size);
    let changes = [by(&Some), by(&|change| thrown(change)[0]), by(&|change| thrown(change)[1])];
    Ok((changes, toss.coin().is_none().then_some(found.map(|(_, range)| range))))
}

/// The first flip in the direction of `sense` up to `limit`, and how far the search went.
fn first(line: &Line<'_>, outcome: Outcome, sense: f64, limit: f64) -> Found {
    match Flips::new(line, outcome, sense, limit, 0.0).next() {
        End::Flip(distance) => (Some(sense * distance), distance),
        End::Limit => (None, limit),
        End::Spent(distance) => (None, distance),
    }
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

/// Of a rate, and the largest change that was searched: the whole range if there is a flip.
fn of_rate(toss: &Toss, axis: usize, outcome: Outcome) -> Found {
    let line = Line::new(toss, Input::Rate(axis));
    let range = rate_range(&toss.launch);
    let limits = [1.0, -1.0].map(|sense| toss.coin().map_or(range, |toss| limit(&toss, axis, sense).min(range)));
    let searches = [(1.0, limits[0]), (-1.0, limits[1])].map(|(sense, limit)| {
        Flips::new(&line, outcome, sense, limit.times_power_of_two(-line.change_exponent()), 0.0)
    });
    let rate = |change: f64| change.times_power_of_two(line.change_exponent());
    match Flips::nearer(searches) {
        Ok(change) => (change.map(rate), range),
        Err(distance) => (None, rate(distance)),
    }
}

/// The largest change of a coin's rate in the direction of `sense`, after which neither phase is too large (rad/s).
fn limit(toss: &CoinToss, axis: usize, sense: f64) -> f64 {
    let (rate, ratio, time) = (toss.launch.rate(), toss.coin.inertia_ratio(), toss.launch.flight_time());
    // The turns Φ = L T (rad), without and with the one that the rate makes.
    let turn = [rate.x, rate.y, ratio * rate.z].map(|part| part * time);
    let across = turn[(axis + 1) % 3].hypot(turn[(axis + 2) % 3]);
    let by_precession = ((LARGEST_PHASE - across) * (LARGEST_PHASE + across)).max(0.0).sqrt();
    let (ratio, by_spin) =
        if axis == 2 { (ratio, LARGEST_PHASE * ratio / (ratio - 1.0).abs()) } else { (1.0, f64::INFINITY) };
    (by_precession.min(by_spin) - sense * turn[axis]) / time / ratio
}

/// Of the tilt, by cos θ and what it becomes after a quarter of a turn of the launch about the lab's x axis.
fn of_tilt(toss: &Toss) -> Option<f64> {
    let lines = [Line::new(toss, Input::Time), Line::quarter_turned(toss)];
    let heights = |stage: usize| lines.each_ref().map(|line| line.enclosure(stage, 0.0, 0.0));
    let stages = 1..lines[0].work().len();
    let last = stages.end - 1;
    let change = stages.map(heights).find_map(tilt_to_flip).unwrap_or_else(|| tilt_to_0(&heights(last)));
    Some(change).filter(|change| change.is_finite())
}

/// The change δ of the tilt for which cos θ = f cos δ + f(90°) sin δ is 0.
fn tilt_to_0([height, turned]: &[Enclosure; 2]) -> f64 {
    // Without the sign of a 0.
    -(height.middle() / (turned.middle() + 0.0)).atan()
}

/// That change if the errors leave it right to a relative 4e-13.
fn tilt_to_flip(heights: [Enclosure; 2]) -> Option<f64> {
    let change = tilt_to_0(&heights);
    let [[height, error], [turned, turned_error]] = heights.map(|height| [height.middle().abs(), height.error()]);
    let size = height.hypot(turned);
    let off = turned / size * (error / size) + height / size * (turned_error / size);
    (off < 4e-13 * change.abs()).then_some(change)
}

#[cfg(test)]
mod body_tests;
#[cfg(test)]
mod tests;
