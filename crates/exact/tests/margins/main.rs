//! Margins against a dense scan of the exact motion in 160 binary digits: no flip is nearer than the one that is reported, and
//! that one is where it is said to be, to a relative 1e-12.

mod reference;
mod tosses;

use dynamics::{CoinToss, TimeOfFlight};
use exact::{CoinMotion, Margin, margin};

use reference::{Input, big, cos_tilt};
use tosses::random_tosses;

/// How densely a scan looks.
struct Scan {
    /// Turn between two looks (rad).
    step: f64,
    /// Looks in each direction.
    least: f64,
    most: f64,
}

const INPUTS: [Input; 7] =
    [Input::Rate(0), Input::Rate(1), Input::Rate(2), Input::Time, Input::Speed, Input::Gravity, Input::Tilt];

fn of(margin: &Margin, input: Input) -> Option<f64> {
    match input {
        Input::Rate(axis) => margin.rate[axis],
        Input::Time => margin.time,
        Input::Speed => margin.speed,
        Input::Gravity => margin.gravity,
        Input::Tilt => margin.tilt,
    }
}

/// Values of an input (least, launch, most) that exist and are searched, and by how many radians one unit of it turns the coin.
fn domain(toss: &CoinToss, input: Input, range: [f64; 3]) -> ([f64; 3], f64) {
    let time = toss.launch.flight_time();
    let phase = CoinMotion::new(toss).phase(time).expect("a small phase");
    let turn = 1.05 * std::f64::consts::TAU * time / phase.max(1e-300);
    let (speed, gravity, drop) = match toss.launch.time_of_flight() {
        TimeOfFlight::Given(_) => (f64::NAN, f64::NAN, 0.0),
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity, 0.0),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => (speed, gravity, drop),
    };
    // A little inside of what exists, for rounding.
    let slowest = if drop < 0.0 { (1.0 + 1e-9) * (-2.0 * gravity * drop).sqrt() } else { 0.0 };
    let steepest = if drop < 0.0 { (1.0 - 1e-9) * (-0.5 * speed * speed / drop) } else { f64::INFINITY };
    match input {
        Input::Rate(axis) => {
            let ratio = if axis == 2 { toss.coin.inertia_ratio() } else { 1.0 };
            ([-range[axis], 0.0, range[axis]], ratio * time)
        }
        Input::Time => ([(time - turn).max(0.0), time, time + turn], phase / time),
        Input::Speed => ([slowest, speed, f64::INFINITY], 2.0 * phase / speed),
        Input::Gravity => ([1e-2 * gravity, gravity, steepest], 2.0 * phase / gravity),
        Input::Tilt => ([-1.6, 0.0, 1.6], 1.0),
    }
}

/// Checks one input of a toss; says what is wrong.
fn check(toss: &CoinToss, input: Input, found: &Margin, scan: &Scan) -> Result<(), String> {
    let wrong = |what: &str, change: f64| Err(format!("{input:?} of {toss:?}: {what} at {change:e}; {found:?}"));
    let height = |change: f64| cos_tilt(toss, input, &big(change));
    let heads = height(0.0) > big(0.0);
    let flipped = |height: &numerics::Big| (*height > big(0.0)) != heads;
    let ([least, launch, most], turn) = domain(toss, input, found.rate_range);
    let change = of(found, input);
    if let Some(change) = change {
        let at = |part: f64| cos_tilt(toss, input, &(big(change) * (big(1.0) + big(part))));
        if flipped(&at(-1e-12)) || !flipped(&at(1e-12)) {
            return wrong("no flip", change);
        }
    } else if launch.is_nan() || most.is_infinite() {
        // No speed was given, or the time says the same.
        return if launch.is_nan() || found.time.is_none() { Ok(()) } else { wrong("none found, though in time", 0.0) };
    }
    for sense in [1.0, -1.0] {
        let end = if sense > 0.0 { most - launch } else { launch - least };
        let distance = change.map_or(end, |change| (change.abs() * (1.0 - 1e-12)).min(end));
        let looks = (distance * turn / scan.step).ceil().clamp(scan.least, scan.most);
        let mut seen = [None, None];
        for look in 0..=looks as u32 {
            let here = sense * distance * f64::from(look) / looks;
            let size = height(here);
            if flipped(&size) {
                return wrong("a nearer flip", here);
            }
            let size = size.to_f64().value().abs();
            if let [Some(before), Some(last)] = seen
                && last < before
                && last <= size
                && let Some(dip) = flip_in_a_dip(here, sense * distance / looks, &height, heads)
            {
                return wrong("a nearer flip in a dip", dip);
            }
            seen = [seen[1], Some(size)];
        }
    }
    Ok(())
}

/// A flip where the height comes nearest to 0 in the two steps up to `end`, by ternary search.
fn flip_in_a_dip(end: f64, step: f64, height: &impl Fn(f64) -> numerics::Big, heads: bool) -> Option<f64> {
    let above = |change: f64| if heads { height(change) } else { -height(change) };
    let [mut from, mut to] = [end - 2.0 * step, end];
    while (to - from).abs() > 1e-7 * step.abs() {
        let [a, b] = [1.0, 2.0].map(|part| from + (to - from) * part / 3.0);
        let [at_a, at_b] = [a, b].map(above);
        for (change, height) in [(a, &at_a), (b, &at_b)] {
            if *height < big(0.0) {
                return Some(change);
            }
        }
        // Far from 0 a dip needs no closer look than that.
        if at_a > big(1e-2) && (to - from).abs() < 1e-2 * step.abs() {
            return None;
        }
        if at_a < at_b { to = b } else { from = a }
    }
    None
}

/// Checks all inputs; returns how many flip and how many do not.
fn check_all(tosses: impl Iterator<Item = CoinToss>, scan: &Scan) -> [u32; 2] {
    let mut counts = [0; 2];
    for toss in tosses {
        let found = margin(&toss.into()).expect("small phases");
        for input in INPUTS {
            counts[usize::from(of(&found, input).is_none())] += 1;
            if let Err(wrong) = check(&toss, input, &found, scan) {
                panic!("{wrong}");
            }
        }
    }
    counts
}

#[test]
fn no_flip_is_nearer_than_the_margin() {
    let [flips, none] = check_all(random_tosses().take(100), &Scan { step: 0.3, least: 6.0, most: 150.0 });
    assert!(flips > 500 && none > 40, "{flips} {none}");
}
