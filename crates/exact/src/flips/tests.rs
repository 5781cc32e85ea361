use dynamics::{Body, Launch, TimeOfFlight, Toss};
use numerics::Elementary;
use numerics::big::exactly;

use super::*;
use crate::rigid::line::Input;

fn toss() -> Toss {
    let launch = Launch::new([3.0, 2.0, 5.0], TimeOfFlight::Given(0.8)).unwrap();
    Toss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch }
}

/// Of all inputs, in both directions, at and next to the separatrix, at rest, upright and on edge; with little of its
/// work left, which ends most of them.
#[test]
fn a_search_ends_within_its_work() {
    const LEFT: u32 = 2000;
    let mut spent = 0;
    let rates = [
        [5.276_195_533_573_627, 3.0, 3.046_212_911_605_835],
        [0.75, 1.0, 1.0],
        [1e-30, 5.0, 0.0],
        [0.0, 0.0, 300.0],
        [1e-300, 2.0, 1e200],
    ];
    for (rate, tilt) in
        rates.into_iter().flat_map(|rate| [0.0, 1.0, std::f64::consts::FRAC_PI_2].map(|tilt| (rate, tilt)))
    {
        let launch = Launch::new(rate, TimeOfFlight::Given(0.8)).unwrap().with_tilt(tilt).unwrap();
        let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch };
        for (input, limit) in [(Input::Time, 20.0), (Input::Rate(0), 1000.0), (Input::Rate(2), 1000.0)] {
            let line = Line::new(&toss, input);
            let outcome = line.outcome_at(0.0);
            for sense in [-1.0, 1.0] {
                let search = Flips::new(&line, outcome, sense, if sense < 0.0 { 0.8 } else { limit }, 0.0);
                let mut search = Flips { work: MOST_WORK - LEFT, ..search };
                let end = search.next();
                let most = MOST_WORK + 6 * line.work().iter().sum::<u32>();
                assert!(search.work <= most, "{rate:?} {tilt} {input:?}: {end:?} by {}", search.work);
                spent += u32::from(search.work > MOST_WORK);
            }
        }
    }
    assert!(spent > 20, "{spent}");
}

/// By exact arithmetic, and no wider than some roundings. The end of a step is rounded before the next one begins there.
#[test]
fn intervals_contain_their_steps() {
    let (toss, exact) = (toss(), exactly);
    let line = Line::new(&toss, Input::Time);
    let numbers = [0.0, 1e-20, 0.1, 0.7, 1.0, 3.3, 1e5];
    let origins = numbers.iter().flat_map(|origin| [-origin, *origin]);
    let cases = origins.flat_map(|origin| numbers.map(|distance| (origin, distance)));
    for ((origin, distance), step) in cases.flat_map(|case| [1e-13, 3e-9, 0.1, 7.0].map(|step| (case, step))) {
        for sense in [1.0, -1.0] {
            let start = Flips { distance, ..Flips::new(&line, Outcome::Heads, sense, 1e9, 0.0) }.starting_at(origin);
            let [middle, radius] = start.next_interval(step);
            for further in [exact(distance), exact(distance) + exact(step), exact(distance + step)] {
                let from_middle = exact(origin) + exact(sense) * further - exact(middle);
                let radius = exact(radius) + exact(f64::EPSILON * origin.abs());
                assert!(from_middle.magnitude() <= radius, "{origin} {distance} {step}");
            }
            let size = middle.abs() + step;
            assert!(radius <= 0.5 * step + 3.0 * f64::EPSILON * size, "{origin} {distance} {step}: {radius}");
        }
    }
}

#[test]
fn a_search_goes_on_while_it_has_work_a_sign_and_a_step() {
    let toss = toss();
    let line = Line::new(&toss, Input::Time);
    let sign = line.sign_at(0.0, &mut 0);
    for (limit, step, sign, work, goes_on) in [
        (1e-6, 1.0, sign, 0, true),
        (1e-6, 1.0, sign, MOST_WORK, true),
        (1e-6, 1.0, sign, MOST_WORK + 1, false),
        (1e-6, 1.0, sign, MOST_WORK + 2, false),
        (1e-6, 1.0, 0.0, 0, false),
        (f64::from_bits(2), f64::from_bits(1), sign, 0, true),
        (f64::from_bits(2), 0.0, sign, 0, false),
    ] {
        let mut search = Flips { step, sign, work, ..Flips::new(&line, Outcome::Heads, 1.0, limit, 0.0) };
        assert_eq!(search.next(), if goes_on { End::Limit } else { End::Spent(0.0) }, "{limit} {sign} {work}");
    }
}

/// No ball over 20 s has a sign, which takes an evaluation of the interval and one at its middle.
#[test]
fn an_interval_that_is_too_wide_is_given_up_after_its_middle() {
    let toss = toss();
    let line = Line::new(&toss, Input::Time);
    let mut search = Flips::new(&line, line.outcome_at(0.0), 1.0, 20.0, 0.0);
    assert_eq!((search.look(20.0), search.work), (Step::Open(0.0, 60.0), 2 * line.work()[0]));
}

/// As after a start that was rounded across it.
#[test]
fn a_flip_at_the_start_is_found_there() {
    let toss = toss();
    let line = Line::new(&toss, Input::Time);
    let other = if line.outcome_at(0.0) == Outcome::Heads { Outcome::Tails } else { Outcome::Heads };
    let found = Flips::new(&line, other, 1.0, 1e-3, 1.0).next();
    assert!(matches!(found, End::Flip(distance) if distance <= RESOLUTION), "{found:?}");
}

/// A body on edge with a rate of ½ rad/s about the horizontal axis: without the rate it stays there, and with the opposite
/// one it shows the other face.
#[test]
fn a_tie_is_passed_by_another_step() {
    let quarter = dynamics::Unit::TURN.times(0.25);
    let launch = Launch::new([0.5, 0.0, 0.0], TimeOfFlight::Given(0.8)).unwrap().with_tilt(quarter).unwrap();
    let toss = Toss { launch, ..toss() };
    let line = Line::new(&toss, Input::Rate(0));
    let sign = line.sign_at(0.0, &mut 0);
    let mut search = Flips::new(&line, line.outcome_at(0.0), -1.0, 1000.0, 0.0);
    let step = 0.5f64.times_power_of_two(-line.change_exponent());
    assert_eq!((sign, search.decided_after(step)), (-1.0, Some((2.0 * step, 1.0))));
}

/// With m along y and Φ along x, cos θ = -sin Φx: flips at each half turn, and the nearer one of both directions.
#[test]
fn flips_follow_each_other_and_the_nearer_one_is_the_margin() {
    use std::f64::consts::PI;
    let attitude = dynamics::Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    for (x, k) in [(0.4, 1.3), (-2.0, 0.0), (2.9, 2.0)] {
        let launch = Launch::new([x, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap().with_attitude(attitude);
        let toss = Toss { body: Body::Coin(dynamics::Coin::from_moments(1.0, k).unwrap()), launch };
        let line = Line::new(&toss, Input::Rate(0));
        let search = |sense| Flips::new(&line, line.outcome_at(0.0), sense, 100.0, 0.0);
        for sense in [1.0, -1.0] {
            let (mut up, first) = (search(sense), (sense * x / PI).floor() + 1.0);
            for turn in 0..20 {
                let expected = (first + f64::from(turn)) * PI - sense * x;
                let End::Flip(found) = up.next() else { panic!("{x} {turn}") };
                assert!((found - expected).abs() < RESOLUTION * expected, "{x} {sense} {turn}: {found} {expected}");
            }
        }
        let expected = (x / PI).round() * PI - x;
        let found = Flips::nearer([search(1.0), search(-1.0)]).unwrap().unwrap();
        assert!((found - expected).abs() < RESOLUTION * expected.abs(), "{x}: {found} {expected}");
        // Nothing is as near as half of that, and beyond the limit there is nothing.
        let short = |sense: f64| Flips::new(&line, line.outcome_at(0.0), sense, 0.5 * expected.abs(), 0.0);
        assert_eq!(Flips::nearer([short(1.0), short(-1.0)]), Ok(None));
        // A search without work may have passed a nearer one.
        let spent = Flips { work: MOST_WORK + 1, ..search(-1.0) };
        assert_eq!(Flips::nearer([search(1.0), spent]), Err(0.0));
    }
}
