//! These checks search for flips of the outcome in 256 bits, and compare what they find with the margins and with the
//! speeds of heads that the library reports. The searches of the library walk along the motion in proven steps; these
//! look at many tosses one by one, each solved by the reference alone.

use rayon::prelude::*;
use toss::{
    CoinMotion, CoinToss, Launch, Outcome, SolveError, TimeOfFlight, Vector3, level_speeds_of_heads, margin,
    speeds_of_heads,
};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::hard_cases::random;
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

pub(super) const MARGINS: Check = Check {
    id: "margins",
    claim: "Where a margin says that the outcome changes with one input, the 256-bit reference changes, to a relative \
            1e-9; no toss in between, and none at all for an input without a margin, has another outcome. Measured: \
            the number of inputs of a toss with a wrong margin; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "inputs",
    measure: |context| Ok(vec![largest("random", &cases(context, 61)?, wrong_margins)]),
};

pub(super) const SPEEDS: Check = Check {
    id: "speeds-of-heads",
    claim: "The outcome in 256 bits changes at both ends of each interval of speeds that land heads, to a relative \
            1e-9, and is heads within and tails between them, also for a landing at another height. Measured: the \
            number of speeds of a toss with another outcome; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "speeds",
    measure: |context| Ok(vec![largest("random", &cases(context, 62)?, wrong_speeds)]),
};

/// Relative distance from a flip at which the outcome is asked for.
const CLOSE: f64 = 1e-9;

/// Largest number of tosses that are looked at between the launch and a flip, in each direction.
const MOST_LOOKS: u32 = 12;

/// Number of turns over which speeds of heads are compared.
const MOST_TURNS: f64 = 20.0;

fn cases(context: &Context, seed: u64) -> anyhow::Result<Vec<Case>> {
    let number = match context.effort {
        Effort::Quick => 15,
        Effort::Standard => 150,
        Effort::Deep => 3000,
    };
    random(number, 1e2, seed)
}

fn largest(name: &str, cases: &[Case], deviation: fn(&CoinToss, &Reference) -> Deviation) -> Measurement {
    let found: Vec<_> = cases.par_iter().map(|case| deviation(&case.toss, &Reference::new(&case.toss))).collect();
    Measurement::of_set(name, &found, |index| cases[index])
}

/// The value of an input.
type Value = fn(&CoinToss) -> f64;

/// A toss with `change` added to one of its inputs; `None` if there is no such toss.
type Changed = fn(&CoinToss, f64) -> Option<CoinToss>;

/// The inputs whose margins are compared: speed, gravity, tilt, ωx, ωy, ωz.
const INPUTS: [(Value, Changed); 6] = [
    (|toss| thrown(toss)[0], |toss, change| toss_thrown(toss, [change, 0.0])),
    (|toss| thrown(toss)[1], |toss, change| toss_thrown(toss, [0.0, change])),
    (tilt, |toss, change| Some(CoinToss { launch: toss.launch.with_tilt(tilt(toss) + change).ok()?, ..*toss })),
    (|toss| toss.launch.rate().x, |toss, change| toss_with_rate(toss, Vector3::new(change, 0.0, 0.0))),
    (|toss| toss.launch.rate().y, |toss, change| toss_with_rate(toss, Vector3::new(0.0, change, 0.0))),
    (|toss| toss.launch.rate().z, |toss, change| toss_with_rate(toss, Vector3::new(0.0, 0.0, change))),
];

/// Speed and gravity.
fn thrown(toss: &CoinToss) -> [f64; 2] {
    match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } | TimeOfFlight::BallisticTo { speed, gravity, .. } => {
            [speed, gravity]
        }
        TimeOfFlight::Given(_) => [f64::NAN; 2],
    }
}

/// The angle of the turn about the laboratory's x axis (rad).
fn tilt(toss: &CoinToss) -> f64 {
    let [w, x, ..] = toss.launch.attitude().components();
    2.0 * x.atan2(w)
}

fn relaunched(toss: &CoinToss, rate: Vector3<f64>, time_of_flight: TimeOfFlight) -> Option<CoinToss> {
    let launch = Launch::new(rate, time_of_flight).ok()?;
    Some(CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}

fn toss_with_rate(toss: &CoinToss, change: Vector3<f64>) -> Option<CoinToss> {
    relaunched(toss, toss.launch.rate() + change, toss.launch.time_of_flight())
}

fn toss_thrown(toss: &CoinToss, [by_speed, by_gravity]: [f64; 2]) -> Option<CoinToss> {
    let [speed, gravity] = thrown(toss);
    let (speed, gravity) = (speed + by_speed, gravity + by_gravity);
    let time_of_flight = match toss.launch.time_of_flight() {
        TimeOfFlight::BallisticTo { drop, .. } => TimeOfFlight::BallisticTo { speed, gravity, drop },
        _ => TimeOfFlight::Ballistic { speed, gravity },
    };
    relaunched(toss, toss.launch.rate(), time_of_flight)
}

/// The number of inputs whose margin is wrong.
pub(super) fn wrong_margins(toss: &CoinToss, reference: &Reference) -> Deviation {
    let (found, outcome) = (margin(&(*toss).into())?, reference.outcome());
    let [rate_x, rate_y, rate_z] = found.rate;
    let margins = [found.speed, found.gravity, found.tilt, rate_x, rate_y, rate_z];
    // Beyond these changes no flip was searched for, or all values are tried.
    let [speed, gravity] = thrown(toss);
    let turn = std::f64::consts::TAU / toss.launch.flight_time().max(1e-3);
    let near = found.rate_range.map(|range| range.min(4.0 * turn));
    let ranges = [speed, 0.99 * gravity, 1.5, near[0], near[1], near[2]];
    let wrong = INPUTS.iter().zip(margins).zip(ranges).filter(|(((value, changed), margin), range)| {
        let outcome_after = |change: f64| changed(toss, change).map(|toss| Reference::new(&toss).outcome());
        !is_right(value(toss), *margin, *range, outcome, outcome_after)
    });
    Ok(wrong.count() as f64)
}

/// Whether no toss up to a margin, and the one beyond it, has another outcome than `outcome`.
fn is_right(
    value: f64,
    margin: Option<f64>,
    range: f64,
    outcome: Outcome,
    outcome_after: impl Fn(f64) -> Option<Outcome>,
) -> bool {
    let stays = |change: f64| outcome_after(change).is_none_or(|after| after == outcome);
    let Some(margin) = margin else { return looks(range).all(|change| stays(change) && stays(-change)) };
    // The change is rounded when it is added to the value.
    let close = CLOSE.max(4.0 * f64::EPSILON * value.abs() / margin.abs());
    let beyond = outcome_after(margin * (1.0 + close));
    beyond.is_some_and(|beyond| beyond != outcome)
        && stays(margin * (1.0 - close))
        && looks(margin.abs() * (1.0 - close)).all(|change| stays(change) && stays(-change))
}

/// Changes from 0 up to `range`, evenly spread.
fn looks(range: f64) -> impl Iterator<Item = f64> {
    (1..=MOST_LOOKS).map(move |look| range * f64::from(look) / f64::from(MOST_LOOKS))
}

/// The number of speeds, at the ends of the intervals of heads and in between, whose outcome is another one: for a
/// landing at the height of the launch, below and above it.
pub(super) fn wrong_speeds(toss: &CoinToss, _: &Reference) -> Deviation {
    let [speed, gravity] = thrown(toss);
    // Of a toss of many turns only the last ones, because each has an interval.
    let turns = CoinMotion::new(toss).phase(toss.launch.flight_time())? / std::f64::consts::TAU;
    let slowest = speed * (1.0 - MOST_TURNS / turns).max(0.4);
    let mut wrong = 0;
    for drop in [None, Some(0.3), Some(-0.01 * speed * speed / gravity)] {
        let time_of_flight = drop.map_or(TimeOfFlight::Ballistic { speed, gravity }, |drop| {
            TimeOfFlight::BallisticTo { speed, gravity, drop }
        });
        let Some(toss) = relaunched(toss, toss.launch.rate(), time_of_flight) else { continue };
        let heads = speeds_of_heads(&toss.into(), slowest)?.unwrap_or_default();
        if drop.is_none() {
            // Both functions answer the same question here.
            let level = level_speeds_of_heads(&toss, slowest)?.map(Iterator::collect::<Vec<_>>);
            wrong += usize::from(level.as_ref() != Some(&heads));
        }
        wrong += wrong_among(&toss, [slowest, speed], &heads)?;
    }
    Ok(wrong as f64)
}

fn wrong_among(toss: &CoinToss, [slowest, fastest]: [f64; 2], heads: &[[f64; 2]]) -> Result<usize, SolveError> {
    let ends = heads.iter().flatten().flat_map(|end| [end * (1.0 - CLOSE), end * (1.0 + CLOSE)]);
    let between = looks(1.0).map(|part| slowest + part * (fastest - slowest));
    // Next to an end of the range an interval may touch it within rounding.
    let inside = |speed: &f64| *speed > slowest * (1.0 + CLOSE) && *speed < fastest * (1.0 - CLOSE);
    let away = |speed: &f64| heads.iter().flatten().all(|end| (speed / end - 1.0).abs() > 0.5 * CLOSE);
    let speeds: Vec<f64> = ends.chain(between).filter(inside).filter(away).collect();
    let is_wrong = |speed: &&f64| {
        let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(*speed));
        let there = toss_thrown(toss, [**speed - thrown(toss)[0], 0.0]);
        there.is_some_and(|there| (Reference::new(&there).outcome() == Outcome::Heads) != expected)
    };
    Ok(speeds.iter().filter(is_wrong).count())
}
