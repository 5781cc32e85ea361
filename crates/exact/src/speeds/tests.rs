use dynamics::{Attitude, Body, Launch};

use super::*;
use crate::certify;

fn toss(moments: [f64; 3], rate: [f64; 3], flight: TimeOfFlight, tilt: f64) -> Toss {
    let launch = Launch::new(rate, flight).unwrap().with_attitude(Attitude::about_x(tilt));
    Toss { body: Body::from_moments(moments).unwrap(), launch }
}

fn with_flight(toss: &Toss, flight: TimeOfFlight) -> Toss {
    let launch = Launch::new(toss.launch.rate(), flight).unwrap().with_attitude(toss.launch.attitude());
    Toss { launch, ..*toss }
}

/// Checks that a toss lands heads within the intervals of speeds and nowhere else, and returns their number.
fn check_intervals(toss: &Toss, [slowest, fastest]: [f64; 2], drop: Option<f64>) -> usize {
    let thrown = |speed| with_flight(toss, TimeOfFlight::thrown(speed, 9.81, drop));
    let lands_heads = |speed| certify(&thrown(speed)).unwrap().outcome() == Outcome::Heads;
    let intervals_from = |slowest| speeds_of_heads(&thrown(fastest), slowest).unwrap().unwrap();
    let heads = intervals_from(slowest);
    assert!(heads.iter().flatten().is_sorted_by(|slow, fast| slow < fast), "{toss:?}, {drop:?}: {heads:?}");
    let speeds = (0..).map(|step| slowest + f64::from(step) * 1e-3);
    for speed in speeds.clone().take_while(|speed| *speed <= fastest) {
        let nearest = heads.iter().flatten().map(|end| (end - speed).abs()).fold(f64::MAX, f64::min);
        let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(&speed));
        assert!(lands_heads(speed) == expected || nearest < 1e-11, "{toss:?}, {drop:?}, {speed} m/s");
    }
    for end in heads.iter().flatten().filter(|end| ![slowest, fastest].contains(*end)) {
        assert_ne!(lands_heads(end - 1e-10), lands_heads(end + 1e-10), "{toss:?}, {drop:?}, {end} m/s");
    }
    // The first interval begins with the range where that lands heads, wherever it begins.
    for slowest in speeds.step_by(110).take(12) {
        let begins = intervals_from(slowest).iter().any(|[slow, _]| *slow == slowest);
        assert_eq!(begins, lands_heads(slowest), "{toss:?}, {drop:?}, {slowest} m/s");
    }
    heads.len()
}

#[test]
fn the_outcome_changes_at_the_ends_of_the_intervals_and_nowhere_else() {
    let toss = |moments, rate, tilt| toss(moments, rate, TimeOfFlight::Given(1.0), tilt);
    let body = toss([1.0, 2.0, 2.5], [18.0, 9.0, 12.0], 0.4);
    for drop in [None, Some(0.4)] {
        assert!(check_intervals(&body, [1.0, 3.0], drop) > 1);
    }
    let coin = toss([1.0, 1.0, 2.0], [20.0, 5.0, 3.0], 0.4);
    for drop in [Some(1.3), Some(-0.4), Some(0.0), None] {
        assert!(check_intervals(&coin, [3.0, 9.0], drop) > 2);
    }
    for rate in [[1.0, 1.0, 2.5], [20.0, -31.0, 7.0], [0.0, 9.0, 0.0], [-3.0, 4.0, -6.0], [2.0, 2.0, 0.5], [0.0; 3]] {
        for tilt in [0.0, 0.6, 2.0, -1.1] {
            check_intervals(&toss([1.0, 1.0, 1.3], rate, tilt), [1.0, 9.0], None);
        }
    }
    for toss in [body, coin] {
        assert_eq!(speeds_of_heads(&toss, 0.0), Ok(None));
    }
}

/// Two neighbouring speeds between which the outcome changes, next to `speed`.
fn flip_next_to(speed: f64, lands_heads: impl Fn(f64) -> bool) -> [f64; 2] {
    let [mut before, mut after] = [speed * (1.0 - 1e-11), speed * (1.0 + 1e-11)];
    assert_ne!(lands_heads(before), lands_heads(after));
    while before.next_up() < after {
        let middle = f64::midpoint(before, after);
        *(if lands_heads(middle) == lands_heads(before) { &mut before } else { &mut after }) = middle;
    }
    [before, after]
}

/// Also of a range of speeds that is shorter than the resolution of the search, and of flights of a millisecond.
#[test]
fn ranges_next_to_a_flip_have_the_faces_of_their_ends() {
    for (scale, drop) in [(1.0, None), (300.0, None), (1.0, Some(0.4))] {
        let body = toss([1.0, 2.0, 2.5], [18.0, 9.0, 12.0].map(|part| scale * part), TimeOfFlight::Given(1.0), 0.4);
        let thrown = |speed| with_flight(&body, TimeOfFlight::thrown(speed, 9.81, drop));
        let lands_heads = |speed| certify(&thrown(speed)).unwrap().outcome() == Outcome::Heads;
        let heads = |slowest, fastest| speeds_of_heads(&thrown(fastest), slowest).unwrap().unwrap();
        let (slowest, fastest) = (1.0 / scale, 3.0 / scale);
        let ends = heads(slowest, fastest).into_iter().flatten().filter(|end| ![slowest, fastest].contains(end));
        for end in ends {
            let [before, after] = flip_next_to(end, lands_heads);
            for (slower, faster) in [(1.5e-13, 0.5e-13), (8e-13, 2e-14)] {
                let [slow, fast] = [before * (1.0 - slower), before * (1.0 - faster)];
                let expected: &[_] = if lands_heads(before) { &[[slow, fast]] } else { &[] };
                assert_eq!(heads(slow, fast), expected, "{scale} {drop:?} {end}");
                let [slow, fast] = [after * (1.0 + faster), after * (1.0 + slower)];
                let expected: &[_] = if lands_heads(after) { &[[slow, fast]] } else { &[] };
                assert_eq!(heads(slow, fast), expected, "{scale} {drop:?} {end}");
            }
            let (slow, fast) = (before * (1.0 - 1e-11), after * 1.001);
            let [[from, to]] = heads(slow, fast)[..] else { panic!("{scale} {drop:?} {end}") };
            let (bound, flip) = if lands_heads(before) { (from == slow, to) } else { (to == fast, from) };
            assert!(bound && (flip / before - 1.0).abs() < 1e-12, "{scale} {drop:?} {end}: {from} {to}");
        }
    }
}

/// Where all speeds land heads, that is one interval with the very ends of the range, and of no range there is none.
#[test]
fn the_ends_of_a_range_that_lands_heads_are_those_given() {
    for moments in [[1.0, 1.0, 2.0], [1.0, 2.0, 2.5]] {
        let steady = toss(moments, [0.1, 0.2, 30.0], TimeOfFlight::Given(1.0), 0.1);
        for (drop, step) in
            [None, Some(0.4), Some(-0.4)].into_iter().flat_map(|drop| (0..20).map(move |step| (drop, step)))
        {
            let [slow, fast] = [3.1 + 0.07 * f64::from(step), 5.3 + 0.11 * f64::from(step)];
            let heads = |slowest, fastest| {
                speeds_of_heads(&with_flight(&steady, TimeOfFlight::thrown(fastest, 9.81, drop)), slowest).unwrap()
            };
            assert_eq!(heads(slow, fast), Some(vec![[slow, fast]]), "{moments:?} {drop:?}");
            if moments[1] != 1.0 {
                assert_eq!([heads(fast, fast), heads(fast, slow)], [Some(vec![]), Some(vec![])], "{drop:?}");
            }
        }
    }
}

/// At the speed 0 the body is on edge, which is not a flip and does not end the search.
#[test]
fn intervals_may_begin_on_edge() {
    let quarter = numerics::Unit::TURN.times(0.25);
    let upright = toss([1.0, 2.0, 3.0], [1.0, 5.0, 0.5], TimeOfFlight::thrown(9.0, 9.81, None), 0.0);
    let launch = upright.launch.with_tilt(quarter).unwrap();
    let toss = Toss { launch, ..upright };
    let heads = speeds_of_heads(&toss, 0.0).unwrap().unwrap();
    for speed in (1..=200).map(|step| f64::from(step) * 0.0449) {
        let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(&speed));
        let launch = Launch::new(launch.rate(), TimeOfFlight::thrown(speed, 9.81, None)).unwrap();
        let thrown = Toss { launch: launch.with_tilt(quarter).unwrap(), ..toss };
        assert_eq!(certify(&thrown).unwrap().outcome() == Outcome::Heads, expected, "{speed} {heads:?}");
    }
}

/// A body that spins about its normal on edge stays there, so that the search ends near where it began.
#[test]
fn a_search_along_an_edge_says_how_far_it_came() {
    let quarter = numerics::Unit::TURN.times(0.25);
    let upright = toss([1.0, 2.0, 2.5], [0.0, 0.0, 5.0], TimeOfFlight::thrown(3.0, 9.81, None), 0.0);
    let toss = Toss { launch: upright.launch.with_tilt(quarter).unwrap(), ..upright };
    let Err(SolveError::StepLimit { time, .. }) = speeds_of_heads(&toss, 1.0) else { panic!("it has no outcome") };
    assert!((2.0 / 9.81 - 1e-9..6.0 / 9.81).contains(&time), "{time}");
}
