//! The checks of margins and of the speeds that land heads, of coins and of bodies for which no method has a simple case.
//! Flips of the outcome are searched for by the reference, in many tosses one by one: the library walks along the motion in
//! proven steps.

use std::f64::consts::TAU;

use dynamics::Toss;
use toss::{
    CoinMotion, Launch, Outcome, SolveError, TimeOfFlight, Vector3, level_speeds_of_heads, margin, speeds_of_heads,
};

use crate::measure::check::Fold::Largest;
use crate::measure::check::Measure::Tosses;
use crate::measure::check::{Check, Set, coin};
use crate::measure::context::Context;
use crate::measure::families::{Family, HARD, hard_number, hard_tosses_of};
use crate::measure::reference::{self, Reference};
use crate::measure::tosses::random;
use crate::measure::trial::Deviation;

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("margins", Tosses(|| of_coins(61, wrong_margins), Largest)).up_to(0.0, "inputs").claims(
        "Where a margin says that the outcome changes with one input, the 256-bit reference changes, to a relative \
         1e-9. None of twelve tosses on each side in between, nor of those for an input without a margin, has another \
         outcome: that is a sample, and a flip between two of them would not be seen. Measured: the number of inputs \
         of a toss with a wrong margin; one is enough to fail.",
    ),
    Check::of_library("speeds-of-heads", Tosses(|| of_coins(62, wrong_speeds), Largest)).up_to(0.0, "speeds").claims(
        "The outcome in 256 bits changes at both ends of each interval of speeds that land heads, to a relative 1e-9, \
         and is heads within and tails between them, also for a landing at another height. Measured: the number of \
         speeds of a toss with another outcome; one is enough to fail.",
    ),
    Check::of_library("hard-margins", Tosses(of_bodies, Largest)).up_to(0.0, "inputs").claims(
        "Where a margin of a body says that the outcome changes with one input, the reference changes there, to a \
         relative 1e-9. No toss that was looked at in between has another outcome, nor has any that was looked at for \
         an input without a margin: that is a sample, and a flip between two looks would not be seen. Measured: the \
         number of inputs of a toss with a wrong margin; one is enough to fail.",
    ),
];

/// Relative distance from a flip at which the outcome is asked for.
const CLOSE: f64 = 1e-9;

/// Number of tosses that are looked at between the launch and a flip, in each direction: of coins, and of other bodies.
const LOOKS: [u32; 2] = [12, 3];

/// Number of turns over which speeds of heads are compared.
const MOST_TURNS: f64 = 20.0;

fn of_coins(seed: u64, wrong: fn(&Toss, &Reference) -> Deviation) -> Vec<Set> {
    let tosses = move |context: &Context| random(context.effort.of([15, 150, 3000]), 1e2, seed);
    vec![Set::new("random", tosses, wrong).of_coins()]
}

fn of_bodies() -> Vec<Set> {
    let tosses = |family: &'static Family, context: &Context| hard_tosses_of(family, hard_number(context.effort) / 12);
    Set::of_families(&HARD, tosses, wrong_margins_of_bodies)
}

/// An input of a toss: its value, and the toss with `change` added to it, `None` if there is no such toss.
type Input = (fn(&Toss) -> f64, fn(&Toss, f64) -> Option<Toss>);

const SPEED: Input = (|toss| thrown(toss)[0], |toss, change| throw(toss, [change, 0.0]));
const GRAVITY: Input = (|toss| thrown(toss)[1], |toss, change| throw(toss, [0.0, change]));
const TILT: Input =
    (tilt, |toss, change| Some(Toss { launch: toss.launch.with_tilt(tilt(toss) + change).ok()?, ..*toss }));
const TIME: Input = (
    |toss| toss.launch.flight_time(),
    |toss, change| relaunched(toss, [0.0; 3], TimeOfFlight::Given(toss.launch.flight_time() + change)),
);
const RATE: [Input; 3] = [
    (|toss| toss.launch.rate().x, |toss, change| relaunched(toss, [change, 0.0, 0.0], toss.launch.time_of_flight())),
    (|toss| toss.launch.rate().y, |toss, change| relaunched(toss, [0.0, change, 0.0], toss.launch.time_of_flight())),
    (|toss| toss.launch.rate().z, |toss, change| relaunched(toss, [0.0, 0.0, change], toss.launch.time_of_flight())),
];

/// Speed and gravity.
fn thrown(toss: &Toss) -> [f64; 2] {
    match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } | TimeOfFlight::BallisticTo { speed, gravity, .. } => {
            [speed, gravity]
        }
        TimeOfFlight::Given(_) => [f64::NAN; 2],
    }
}

/// The angle of the turn about the laboratory's x axis (rad).
fn tilt(toss: &Toss) -> f64 {
    let [w, x, ..] = toss.launch.attitude().components();
    2.0 * x.atan2(w)
}

/// The same toss with `change` added to its rate (rad/s), and with this time of flight.
fn relaunched(toss: &Toss, change: [f64; 3], time_of_flight: TimeOfFlight) -> Option<Toss> {
    let launch = Launch::new(toss.launch.rate() + Vector3::from(change), time_of_flight).ok()?;
    Some(Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}

fn throw(toss: &Toss, [by_speed, by_gravity]: [f64; 2]) -> Option<Toss> {
    let [speed, gravity] = thrown(toss);
    let (speed, gravity) = (speed + by_speed, gravity + by_gravity);
    let time_of_flight = match toss.launch.time_of_flight() {
        TimeOfFlight::BallisticTo { drop, .. } => TimeOfFlight::BallisticTo { speed, gravity, drop },
        _ => TimeOfFlight::Ballistic { speed, gravity },
    };
    relaunched(toss, [0.0; 3], time_of_flight)
}

fn wrong_margins(toss: &Toss, reference: &Reference) -> Deviation {
    let found = margin(toss)?;
    // Beyond these changes no flip was searched for, or all values are tried.
    let [speed, gravity] = thrown(toss);
    let turn = TAU / toss.launch.flight_time().max(1e-3);
    let rate = |axis: usize| (RATE[axis], found.rate[axis], found.rate_range[axis].min(4.0 * turn));
    let thrown = [(SPEED, found.speed, speed), (GRAVITY, found.gravity, 0.99 * gravity), (TILT, found.tilt, 1.5)];
    Ok(number_of_wrong(toss, reference.outcome(), LOOKS[0], &[&thrown[..], &[0, 1, 2].map(rate)].concat()))
}

fn wrong_margins_of_bodies(toss: &Toss, reference: &Reference) -> Deviation {
    let (found, time) = (margin(toss)?, toss.launch.flight_time());
    // The rounding of a rate in another unit would move the toss.
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time));
    let launch = launch.map_err(|error| SolveError::failed("the check", error))?;
    let si = Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss };
    let rate = |axis: usize| (RATE[axis], found.rate[axis], found.rate_range[axis].min(3.0 / time));
    let later = [(TIME, found.time, found.time_range.map_or(time, |[earlier, _]| earlier.min(time)))];
    Ok(number_of_wrong(&si, reference.outcome(), LOOKS[1], &[&later[..], &[0, 1, 2].map(rate)].concat()))
}

/// The number of wrong margins among those of inputs, each with how far a flip was searched for.
fn number_of_wrong(toss: &Toss, outcome: Outcome, looks: u32, margins: &[(Input, Option<f64>, f64)]) -> f64 {
    let is_right = |((value, changed), margin, range): &&(Input, Option<f64>, f64)| {
        let stays = |change: f64| {
            let after = changed(toss, change).and_then(|toss| reference::of(&toss).ok());
            after.map(|after| after.outcome() == outcome)
        };
        let is_same_up_to = |range: f64| {
            looked_at(range, looks).all(|change| stays(change) != Some(false) && stays(-change) != Some(false))
        };
        let Some(margin) = margin else { return is_same_up_to(*range) };
        // The change is rounded when it is added to the value.
        let close = CLOSE.max(4.0 * f64::EPSILON * value(toss).abs() / margin.abs());
        // A flip after more turns than the reference can fly is not judged.
        let flips = changed(toss, margin * (1.0 + close))
            .is_some_and(|after| reference::of(&after).map_or(true, |after| after.outcome() != outcome));
        flips && is_same_up_to(margin.abs() * (1.0 - close))
    };
    (margins.len() - margins.iter().filter(is_right).count()) as f64
}

/// So many changes from 0 up to `range`, evenly spread.
fn looked_at(range: f64, number: u32) -> impl Iterator<Item = f64> {
    (1..=number).map(move |look| range * f64::from(look) / f64::from(number))
}

/// The number of speeds, at the ends of the intervals of heads and in between, whose outcome is another one: for a
/// landing at the height of the launch, below and above it.
fn wrong_speeds(toss: &Toss, _: &Reference) -> Deviation {
    let [speed, gravity] = thrown(toss);
    // Of a toss of many turns only the last ones, because each has an interval.
    let turns = CoinMotion::new(&coin(toss)?).phase(toss.launch.flight_time())? / TAU;
    let slowest = speed * (1.0 - MOST_TURNS / turns).max(0.4);
    let mut wrong = 0;
    for drop in [None, Some(0.3), Some(-0.01 * speed * speed / gravity)] {
        let flight = TimeOfFlight::thrown(speed, gravity, drop);
        let Some(toss) = relaunched(toss, [0.0; 3], flight) else { continue };
        let heads = speeds_of_heads(&toss, slowest)?.unwrap_or_default();
        if drop.is_none() {
            // Both functions answer the same question here.
            let level = level_speeds_of_heads(&coin(&toss)?, slowest)?.map(Iterator::collect::<Vec<_>>);
            wrong += usize::from(level.as_ref() != Some(&heads));
        }
        wrong += wrong_among(&toss, [slowest, speed], &heads);
    }
    Ok(wrong as f64)
}

fn wrong_among(toss: &Toss, [slowest, fastest]: [f64; 2], heads: &[[f64; 2]]) -> usize {
    let ends = heads.iter().flatten().flat_map(|end| [end * (1.0 - CLOSE), end * (1.0 + CLOSE)]);
    let between = looked_at(1.0, LOOKS[0]).map(|part| slowest + part * (fastest - slowest));
    // Next to an end of the range an interval may touch it within rounding.
    let inside = |speed: &f64| *speed > slowest * (1.0 + CLOSE) && *speed < fastest * (1.0 - CLOSE);
    let away = |speed: &f64| heads.iter().flatten().all(|end| (speed / end - 1.0).abs() > 0.5 * CLOSE);
    let speeds: Vec<f64> = ends.chain(between).filter(inside).filter(away).collect();
    let is_wrong = |speed: &&f64| {
        let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(*speed));
        let there = throw(toss, [**speed - thrown(toss)[0], 0.0]);
        let there = there.and_then(|there| reference::of(&there).ok());
        there.is_some_and(|there| (there.outcome() == Outcome::Heads) != expected)
    };
    speeds.iter().filter(is_wrong).count()
}
