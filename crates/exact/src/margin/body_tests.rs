//! Tests of the margins of bodies: against dense scans of the exact motion, and at the flips.

use dynamics::{Attitude, Body, Launch, Vector3};

use super::*;
use crate::ExactMotion;

fn toss(moments: [f64; 3], rate: [f64; 3], flight: TimeOfFlight, tilt: f64) -> Toss {
    let launch = Launch::new(rate, flight).unwrap().with_attitude(Attitude::about_x(tilt));
    Toss { body: Body::from_moments(moments).unwrap(), launch }
}

fn tosses() -> impl Iterator<Item = Toss> {
    let bodies = [[1.0, 2.0, 2.5], [2.5, 1.0, 2.0], [1.0, 1.1, 2.0], [2.0, 3.0, 4.0]];
    (0..8_u32).map(move |index| {
        let part = |square: f64| (f64::from(index + 1) * square.sqrt()).fract();
        let rate = [2.0, 3.0, 5.0].map(|square| 30.0 * part(square) - 10.0);
        let flight = match index % 3 {
            0 => TimeOfFlight::Ballistic { speed: 1.0 + part(7.0), gravity: 9.81 },
            1 => TimeOfFlight::BallisticTo { speed: 1.0 + part(7.0), gravity: 9.81, drop: 0.2 },
            _ => TimeOfFlight::Given(0.4 * part(7.0)),
        };
        toss(bodies[index as usize % 4], rate, flight, 2.0 * part(11.0))
    })
}

fn with_rate(toss: &Toss, rate: Vector3<f64>) -> Toss {
    let launch = Launch::new(rate, toss.launch.time_of_flight()).unwrap().with_attitude(toss.launch.attitude());
    Toss { launch, ..*toss }
}

fn with_flight(toss: &Toss, flight: TimeOfFlight) -> Toss {
    let launch = Launch::new(toss.launch.rate(), flight).unwrap().with_attitude(toss.launch.attitude());
    Toss { launch, ..*toss }
}

/// The toss with a change of one of six inputs: the rates, the time, the speed, gravity.
fn changed(toss: &Toss, input: usize, change: f64) -> Toss {
    let flight = toss.launch.time_of_flight();
    match (input, flight) {
        (0..3, _) => with_rate(toss, toss.launch.rate() + Vector3::ith(input, change)),
        (3, _) => with_flight(toss, TimeOfFlight::Given(flight.seconds() + change)),
        (4, TimeOfFlight::Ballistic { speed, gravity }) => {
            with_flight(toss, TimeOfFlight::Ballistic { speed: speed + change, gravity })
        }
        (4, TimeOfFlight::BallisticTo { speed, gravity, drop }) => {
            with_flight(toss, TimeOfFlight::BallisticTo { speed: speed + change, gravity, drop })
        }
        (_, TimeOfFlight::Ballistic { speed, gravity }) => {
            with_flight(toss, TimeOfFlight::Ballistic { speed, gravity: gravity + change })
        }
        (_, TimeOfFlight::BallisticTo { speed, gravity, drop }) => {
            with_flight(toss, TimeOfFlight::BallisticTo { speed, gravity: gravity + change, drop })
        }
        _ => *toss,
    }
}

/// Checks that the outcome is the same up to a change of one input, and another one beyond it.
fn check_flip(toss: &Toss, input: usize, change: f64) {
    let outcome = certify(toss).unwrap().outcome();
    let at = |factor: f64| certify(&changed(toss, input, factor * change)).unwrap().outcome();
    assert_eq!(at(1.0 - 2e-12), outcome, "{input}: {change} {toss:?}");
    assert_ne!(at(1.0 + 2e-12), outcome, "{input}: {change} {toss:?}");
    for step in 0..400 {
        let factor = f64::from(step - 200) / 200.5;
        assert_eq!(at(factor), outcome, "{input}: {change} {factor} {toss:?}");
    }
}

#[test]
fn no_flip_in_time_is_nearer_than_the_margin_and_beyond_it_lands_the_other_face() {
    let mut flips = 0;
    for toss in tosses() {
        let outcome = certify(&toss).unwrap().outcome();
        let ([time, speed, gravity], range) = of_flight(&toss, outcome).unwrap();
        let [earlier, later] = range.unwrap();
        for (input, change) in (3..).zip([time, speed, gravity]) {
            let Some(change) = change else { continue };
            flips += 1;
            check_flip(&toss, input, change);
        }
        for step in 0..100 {
            let at = |end: f64| f64::from(step) / 100.5 * time.map_or(end, |time| end.min(time.abs()));
            let outcome = |change: f64| certify(&changed(&toss, 3, change)).unwrap().outcome();
            assert_eq!(outcome(-at(earlier)), outcome(at(later)), "{step}: {time:?} {toss:?}");
        }
        let tilt = of_tilt(&toss).unwrap();
        let cos_tilt = |further: f64| {
            let attitude = Attitude::about_x(further) * toss.launch.attitude();
            let launch = toss.launch.with_attitude(attitude);
            ExactMotion::new(&Toss { launch, ..toss }).cos_tilt(toss.launch.time_of_flight()).unwrap()
        };
        assert!(cos_tilt(tilt).abs() < 1e-15 && tilt.abs() <= std::f64::consts::FRAC_PI_2, "{tilt}");
    }
    assert!(flips >= 12, "{flips}");
}

/// Of tosses whose flips are near, so that the search is short.
#[test]
fn no_flip_by_a_rate_is_nearer_than_the_margin_and_beyond_it_lands_the_other_face() {
    for (index, axes) in [(0, 1..2), (1, 0..3), (4, 0..2), (6, 0..3)] {
        let toss = tosses().nth(index).unwrap();
        for axis in axes {
            let (change, range) = of_rate(&toss, axis, certify(&toss).unwrap().outcome());
            assert_eq!(range, 1000.0);
            check_flip(&toss, axis, change.unwrap());
        }
    }
}

#[test]
fn a_range_without_a_flip_has_none_and_the_separatrix_hides_no_flip() {
    // Next to the spin about the largest axis, the normal stays up for ever.
    let steady = toss([1.0, 2.0, 2.5], [0.1, 0.2, 30.0], TimeOfFlight::Given(0.5), 0.1);
    let ([time, speed, _], range) = of_flight(&steady, Outcome::Heads).unwrap();
    assert_eq!((time, speed), (None, None));
    assert!(range.is_some_and(|[earlier, later]| earlier >= 0.5 && later > 10.0), "{range:?}");
    // ω = (0.75, 1, 1) of this body is on the separatrix, and this rate is 0.01 above it.
    let near = toss([1.0, 2.0, 2.25], [0.76, 1.0, 1.0], TimeOfFlight::Given(0.3), 0.0);
    let outcome = |change: f64| certify(&changed(&near, 0, change)).unwrap().outcome();
    let change = of_rate(&near, 0, outcome(0.0)).0.unwrap();
    assert!(change.abs() > 1.0 && outcome(1.000_001 * change) != outcome(0.0), "{change}");
    for step in -99..=99 {
        assert_eq!(outcome(f64::from(step) * 1e-2 * change), outcome(0.0), "{step}");
    }
}

/// The search of earlier times ends at the launch, where the body is on edge: beyond, before its launch, it would flip.
#[test]
fn a_launch_on_edge_is_no_flip() {
    let quarter = numerics::Unit::TURN.times(0.25);
    for time in [0.05, 0.1, 0.2] {
        let upright = toss([1.0, 2.0, 3.0], [1.0, 5.0, 0.5], TimeOfFlight::Given(time), 0.0);
        let toss = Toss { launch: upright.launch.with_tilt(quarter).unwrap(), ..upright };
        let outcome = |change: f64| certify(&changed(&toss, 3, change)).unwrap().outcome();
        let ([found, ..], range) = of_flight(&toss, outcome(0.0)).unwrap();
        let found = found.unwrap();
        assert!(range.is_some_and(|[earlier, _]| earlier == time) && found > time, "{time}: {found} {range:?}");
        assert_ne!(outcome(found * (1.0 - 2e-12)), outcome(found * (1.0 + 2e-12)));
        for step in 0..100 {
            let part = f64::from(step) / 100.5;
            assert_eq!((outcome(-part * time), outcome(part * found)), (outcome(0.0), outcome(0.0)), "{time} {part}");
        }
    }
}

/// So near to the separatrix, E is 1e-15 of its terms, double-double decides no toss within 1e-9 s of the flip. The flip is by
/// bisection in 300 digits.
#[test]
fn the_margin_next_to_the_separatrix_is_the_nearest_flip_or_says_how_far_it_went() {
    let rate = [5.276_195_533_573_627_5, 3.0, 3.046_212_911_605_835];
    let next = toss([1.0, 2.0, 3.0], rate, TimeOfFlight::Given(0.8), 1.0);
    let found = margin(&next).unwrap();
    let time = found.time.unwrap();
    assert!((time - 0.152_854_524_666_798_52).abs() < 1e-12 * time, "{time:e}");
    let outcome = |axis: usize, change: f64| certify(&changed(&next, axis, change)).unwrap().outcome();
    for (axis, range) in found.rate_range.into_iter().enumerate() {
        assert!(found.rate[axis].is_none_or(|change| change.abs() <= range), "{axis}: {found:?}");
        for step in -20..=20 {
            let change = f64::from(step) / 20.5 * found.rate[axis].map_or(range, f64::abs);
            assert_eq!(outcome(axis, change), outcome(axis, 0.0), "{axis} {change:e}");
        }
    }
}

/// v/3 rad/s for 3 T is the motion of v rad/s for T, at a third of the rate. In rad/s a third is rounded, which after 4 × 10^5
/// turns moves a flip by some parts in 10^10 of its distance.
#[test]
fn rates_in_another_unit_have_the_margins_of_the_same_motion() {
    let thirds = dynamics::Unit::ratio(1, 3).unwrap();
    let (rate, time) = ([500.125, 311.5, -20.25], 4096.0);
    for moments in [[1.0, 1.0, 0.5], [1.0, 2.0, 2.5]] {
        let body = Body::from_moments(moments).unwrap();
        let plain = Toss { body, launch: Launch::new(rate, TimeOfFlight::Given(time)).unwrap() };
        let slow = Toss { body, launch: Launch::in_unit(rate, thirds, TimeOfFlight::Given(3.0 * time)).unwrap() };
        let landed = |toss: &Toss| ExactMotion::new(toss).state(toss.launch.flight_time()).unwrap().attitude;
        assert!(landed(&plain).angle_to(&landed(&slow)) < 2e-15, "{moments:?}");
        let [expected, found] = [&plain, &slow].map(|toss| margin(toss).unwrap());
        let near = |found: Option<f64>, expected: Option<f64>, factor: f64| match (found, expected) {
            (Some(found), Some(expected)) => (found / (factor * expected) - 1.0).abs() < 1e-11,
            (found, expected) => found == expected,
        };
        assert!(near(found.time, expected.time, 3.0), "{moments:?}: {found:?} {expected:?}");
        assert!(near(found.tilt, expected.tilt, 1.0), "{moments:?}: {found:?} {expected:?}");
        let mut flips = 0;
        for axis in 0..3 {
            assert!(near(found.rate[axis], expected.rate[axis], 1.0 / 3.0), "{moments:?}: {found:?} {expected:?}");
            flips += u32::from(found.rate[axis].is_some());
        }
        assert!(flips >= 2 && found.time.is_some(), "{moments:?}: {found:?}");
    }
}

/// A search that ran out of work may have missed a nearer flip.
#[test]
fn a_flip_is_the_nearest_one_only_if_both_searches_came_as_far() {
    let in_time = |earlier, later| nearest([earlier, later], 1.0, &Some);
    let (none, found) = (|end| (None, end), |flip: f64| (Some(flip), flip.abs()));
    assert_eq!(in_time(found(-0.3), found(0.5)), Some(-0.3));
    assert_eq!(in_time(found(-0.3), none(0.5)), Some(-0.3));
    assert_eq!(in_time(found(-0.3), none(0.1)), None);
    assert_eq!(in_time(none(0.2), found(0.5)), None);
    assert_eq!(in_time(none(0.6), found(0.5)), Some(0.5));
    // Nothing is earlier than the launch.
    assert_eq!(in_time(none(1.0), found(5.0)), Some(5.0));
    assert_eq!(in_time(none(0.9), found(5.0)), None);
    assert_eq!(in_time(none(1.0), none(9.0)), None);
}

/// A body that spins about its first axis from horizontal has cos θ = cos ωT: 2 rad are past the flip at π/2 and before that at
/// 3π/2.
#[test]
fn the_nearer_flip_of_a_rate_may_be_at_a_smaller_one() {
    let spinning = toss([1.0, 2.0, 2.5], [20.0, 0.0, 0.0], TimeOfFlight::Given(0.1), 0.0);
    let (change, range) = of_rate(&spinning, 0, Outcome::Tails);
    let expected = 10.0 * std::f64::consts::FRAC_PI_2 - 20.0;
    assert!((change.unwrap() - expected).abs() < 1e-11 && range == 1000.0, "{change:?} {range}");
}

#[test]
fn times_are_searched_up_to_a_number_of_turns() {
    let upright = toss([1.0, 2.0, 2.5], [0.0, 0.0, 2.0], TimeOfFlight::Given(0.5), 0.0);
    assert_eq!(of_flight(&upright, Outcome::Heads), Ok(([None; 3], Some([0.5, TURN_RANGE / 2.0]))));
}

#[test]
fn an_undecided_toss_alone_has_a_margin_of_0() {
    let quarter = numerics::Unit::TURN.times(0.25);
    let upright = toss([1.0, 2.0, 2.5], [0.0; 3], TimeOfFlight::Given(0.5), 0.0);
    let on_edge = Toss { launch: upright.launch.with_tilt(quarter).unwrap(), ..upright };
    assert_eq!(margin(&on_edge).unwrap(), Margin::on_edge(&on_edge.launch, 0.0, Some([0.0; 2])));
}
