//! Flips by the proven outcome, touches, and inputs of any size. The dense scan is in `tests/margins`.

use dynamics::{Attitude, Coin, Launch};
use nalgebra::Vector3;

use super::*;
use crate::certified::certify_coin;
use crate::motion::CoinMotion;

fn margin_coin(toss: &CoinToss) -> Result<Margin, SolveError> {
    margin(&(*toss).into())
}

fn toss(rate: Vector3<f64>, tilt: f64, speed: f64) -> CoinToss {
    let thrown = TimeOfFlight::Ballistic { speed, gravity: 9.81 };
    let launch = Launch::new(rate, thrown).unwrap().with_tilt(tilt).unwrap();
    CoinToss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch }
}

/// The first two figures are those of `docs/paper-audit.md`; to first order the changes would be 2.1266 and -49.9486.
#[test]
fn the_cheated_toss_flips_where_the_exact_motion_does() {
    let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
    let cheated = CoinToss { coin: Coin::PAPER, launch: Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown).unwrap() };
    let Margin { rate, rate_range, gravity, tilt, .. } = margin_coin(&cheated).unwrap();
    let digits = |value: Option<f64>| value.map(|value| format!("{value:+.4}"));
    let found = [rate[0], rate[1], gravity, tilt].map(digits).map(Option::unwrap);
    assert_eq!(found, ["+1.4587", "+1.4587", "-5.2204", "+1.1783"]);
    assert_eq!((rate[2], rate_range), (None, [1000.0; 3]));
    assert_eq!(rate[0], rate[1]);
}

#[test]
fn margins_of_any_size_flip_the_outcome_and_none_smaller_does() {
    // Nearer and nearer to an edge, down to the last bit of the speed.
    let start = toss(Vector3::new(2.0, 3.0, 1.0), 0.4, 3.0);
    let edge = 3.0 + margin_coin(&start).unwrap().speed.unwrap();
    for from_edge in [0.3, 1e-4, 1e-8, 1e-12, 4e-16] {
        let near = toss(Vector3::new(2.0, 3.0, 1.0), 0.4, edge - from_edge);
        let outcome = certify_coin(&near).unwrap().outcome();
        let Margin { rate, gravity, tilt, .. } = margin_coin(&near).unwrap();
        assert!(
            [rate[0], rate[1], rate[2], gravity, tilt].iter().all(|change| change.unwrap().abs() < 40.0 * from_edge)
        );
        for (axis, change) in rate.into_iter().enumerate() {
            let changed = |part: f64| near.launch.rate() + Vector3::ith(axis, part * change.unwrap());
            let outcome_of = |part| certify_coin(&toss(changed(part), 0.4, edge - from_edge)).unwrap().outcome();
            // Where the change is some bits of the rate, so is what is tried.
            let slack = 1e-12 + 1e-15 / change.unwrap().abs();
            assert_eq!(outcome_of((1.0 - slack).max(0.0)), outcome, "{axis} {from_edge}");
            assert_ne!(outcome_of(1.0 + slack), outcome, "{axis} {from_edge}");
        }
        let tilt = tilt.unwrap();
        let body = near.into();
        let lines = [Line::new(&body, Input::Time), Line::quarter_turned(&body)];
        let expected = tilt_to_0(&lines.map(|line| line.enclosure(2, 0.0, 0.0)));
        assert!((tilt - expected).abs() <= 1e-12 * expected.abs(), "{from_edge}: {tilt:e} {expected:e}");
        let tilted = |part: f64| toss(Vector3::new(2.0, 3.0, 1.0), 0.4 + part * tilt, edge - from_edge);
        let slack = 1e-12 + 1e-16 / tilt.abs();
        assert_eq!(certify_coin(&tilted((1.0 - slack).max(0.0))).unwrap().outcome(), outcome, "{from_edge}");
        assert_ne!(certify_coin(&tilted(1.0 + slack)).unwrap().outcome(), outcome, "{from_edge}");
    }
}

#[test]
fn what_never_flips_has_no_margin_in_speed() {
    let certain = margin_coin(&toss(Vector3::new(1.0, 0.0, 9.0), 0.0, 3.0)).unwrap();
    assert_eq!((certain.speed, certain.time), (None, None));
    let launch = Launch::new(Vector3::new(9.0, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
    let given = margin_coin(&CoinToss { coin: Coin::PAPER, launch }).unwrap();
    assert_eq!(given.speed, None);
    assert!((given.time.unwrap() - (std::f64::consts::FRAC_PI_2 / 9.0 - 0.1)).abs() < 1e-15);
}

/// The change of the time to the nearest flip.
fn time_margin(toss: &CoinToss) -> Option<f64> {
    of_flight(&(*toss).into(), certify_coin(toss).unwrap().outcome()).unwrap().0[0]
}

/// cos θ = -ωx sin φ/|L| has its flips at half turns of φ = |L| T, however small ωx is: a search along the time took minutes.
#[test]
fn a_coin_next_to_its_edge_has_its_flips_in_time_in_closed_form() {
    use std::f64::consts::PI;
    let quarter = numerics::Unit::TURN.times(0.25);
    let times = (0..12).map(|step| 0.3 + 0.123 * f64::from(step)).chain([1.9, 7.9]);
    for (exponent, time) in
        [-10, -40, -80, -300].into_iter().flat_map(|exponent| times.clone().map(move |time| (exponent, time)))
    {
        let launch = Launch::new(Vector3::new(10f64.powi(exponent), 0.0, 2.0), TimeOfFlight::Given(time)).unwrap();
        let toss = CoinToss { coin: Coin::from_moments(1.0, 0.5).unwrap(), launch: launch.with_tilt(quarter).unwrap() };
        let [later, earlier] = [(time / PI).ceil() * PI - time, time - (time / PI).floor() * PI];
        // At the launch itself the coin is on edge, which is not a flip.
        let expected = if earlier < later && time > PI { -earlier } else { later };
        let found = time_margin(&toss).unwrap();
        assert!((found - expected).abs() < 1e-12, "1e{exponent} {time}: {found}, not {expected}");
    }
}

/// A tilt of π/2 in f64 is 6e-17 rad short of the edge, and turning on flips the coin at once, but turning back does not.
#[test]
fn a_flip_at_once_after_the_launch_is_one() {
    for time in (1..15).map(|step| 0.031 * f64::from(step)) {
        let toss = |rate: f64| {
            let launch = Launch::new(Vector3::new(rate, 0.0, 0.0), TimeOfFlight::Given(time)).unwrap();
            CoinToss { coin: Coin::DISC, launch: launch.with_tilt(std::f64::consts::FRAC_PI_2).unwrap() }
        };
        let found = [3.0, -3.0].map(|rate| time_margin(&toss(rate)).unwrap());
        let expected = [-time, std::f64::consts::PI / 3.0 - time];
        assert!(
            (found[0] - expected[0]).abs() < 1e-12 && (found[1] - expected[1]).abs() < 1e-12,
            "{found:?} {expected:?}"
        );
    }
}

/// L along (1e-7, 1, 1) takes the normal from 6e-17 above the edge to below it and back within 3e-7 rad: cos θ is that less
/// 7e-8 φ and more by φ²/4.
#[test]
fn a_dip_below_the_edge_between_launch_and_landing_is_two_flips() {
    let toss = |time| {
        let launch = Launch::new(Vector3::new(1e-7, 1.0, 1.0), TimeOfFlight::Given(time)).unwrap();
        let launch = launch.with_tilt(std::f64::consts::FRAC_PI_2).unwrap();
        CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch }
    };
    for time in [2.5e-7, 4e-7] {
        let found = time_margin(&toss(time)).unwrap();
        assert!((time + found - 2e-7).abs() < 1e-9, "{time:e}: {found:e}");
    }
}

/// The phase may be 2^53 rad, of the precession and of the spin, and no more than the range is searched.
#[test]
fn rates_are_searched_up_to_their_range_and_to_the_largest_phase() {
    let toss = |k: f64, rate: [f64; 3], time: f64| {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch }
    };
    let limits =
        |toss: &CoinToss, axis: usize| [1.0, -1.0].map(|sense| limit(toss, axis, sense).min(rate_range(&toss.launch)));
    for (axis, rate) in [0, 1, 2].into_iter().flat_map(|axis| [[3.0, 2.0, -4.0], [300.0, 2.0, 4.0]].map(|r| (axis, r)))
    {
        let toss = toss(1.3, rate, 0.7);
        let range = rate_range(&toss.launch);
        assert!(limits(&toss, axis).iter().all(|limit| (limit / range - 1.0).abs() < 1e-15), "{axis} {rate:?}");
    }
    // Up to its last rad.
    let near = LARGEST_PHASE - 600.0;
    for (k, axis, rate) in [
        (1.0, 0, [near, 0.0, 0.0]),
        (1.0, 1, [0.0, -near, 0.0]),
        (2.0, 2, [0.0, 0.0, 0.5 * near]),
        (1.0, 0, [0.8 * near, 0.6 * near, 0.0]),
        (1.0, 2, [-0.6 * near, 0.0, -0.8 * near]),
        (0.25, 2, [0.0, 0.0, near / 0.75]),
        (0.25, 2, [0.1 * near, 0.0, -near / 0.75]),
        (0.5, 2, [0.6 * near, 0.0, 1.6 * near]),
    ] {
        let start = toss(k, rate, 1.0);
        let moved = |axis: usize, change: f64| {
            let mut rate = rate;
            rate[axis] += change;
            CoinMotion::new(&toss(k, rate, 1.0)).phase(TimeOfFlight::Given(1.0)).is_ok()
        };
        let sense = f64::signum(rate[axis]);
        let limits = limits(&start, axis);
        let [outwards, inwards] = if sense > 0.0 { limits } else { [limits[1], limits[0]] };
        assert!(outwards > 100.0 && outwards < 1900.0 && inwards > 1999.0, "{k} {rate:?}: {limits:?}");
        assert!(moved(axis, sense * (outwards - 8.0)), "{k} {rate:?}: {outwards}");
        assert!(!moved(axis, sense * (outwards + 8.0)), "{k} {rate:?}: {outwards}");
    }
}

/// Of an angle δ = -atan(f/f(90°)) the errors move it by a part of what they move the point (f(90°), f).
#[test]
fn a_change_of_the_tilt_is_taken_where_the_errors_leave_it_its_digits() {
    let height = |value: f64, error: f64| Enclosure::of_ball(&numerics::Ball::new(value, error));
    for (value, turned) in [(0.3, 0.9), (-0.9, 0.2), (1e-6, -0.5), (-0.8, -1e-3), (0.1, 0.1)] {
        let change = -f64::atan(value / turned);
        let size = f64::hypot(value, turned);
        let allowed = 4e-13 * change.abs() * size * size;
        for part in [0.0, 0.5, 1.0] {
            let found = |size: f64| {
                let errors =
                    [part * size * allowed / f64::abs(turned), (1.0 - part) * size * allowed / f64::abs(value)];
                tilt_to_flip([height(value, errors[0]), height(turned, errors[1])])
            };
            assert_eq!((found(0.9), found(1.01)), (Some(change), None), "{value} {turned} {part}");
        }
    }
}

/// Caught 1.5 m below, no flight is shorter than the fall from rest, 0.553 s: of the flips at 0.5 s and 1.5 s only the
/// later one can be had. Caught 1.5 m above, none at 6 m/s is shorter than 0.5 s, whatever gravity is: of the flips at 0.45 s
/// and 1.35 s only the later one.
#[test]
fn a_flip_before_the_shortest_flight_is_none() {
    let toss = |[speed, gravity, drop]: [f64; 3], flip: f64| {
        let launch = Launch::new(
            [std::f64::consts::FRAC_PI_2 / flip, 0.0, 0.0],
            TimeOfFlight::BallisticTo { speed, gravity, drop },
        );
        CoinToss { coin: Coin::DISC, launch: launch.unwrap() }
    };
    let of_speed = margin_coin(&toss([0.1, 9.81, 1.5], 0.5)).unwrap().speed.unwrap();
    let of_gravity = margin_coin(&toss([6.0, 9.81, -1.5], 0.45)).unwrap().gravity.unwrap();
    for (changed, flip) in [([0.1 + of_speed, 9.81, 1.5], 0.5), ([6.0, 9.81 + of_gravity, -1.5], 0.45)] {
        let flight = toss(changed, flip).launch.flight_time();
        assert!((flight - 3.0 * flip).abs() < 1e-12, "{changed:?}: {flight}");
    }
}

/// On the edge by exact arithmetic: w = x.
fn on_edge(rate: [f64; 3], time: f64) -> CoinToss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
    let attitude = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    CoinToss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch: launch.with_attitude(attitude) }
}

#[test]
fn an_undecided_toss_has_a_margin_of_0() {
    for (rate, time) in [([0.0; 3], 1.0), ([0.0, 0.0, 7.0], 1.0), ([1.0, 2.0, 3.0], 0.0)] {
        let Margin { time, tilt, rate, speed, .. } = margin_coin(&on_edge(rate, time)).unwrap();
        assert_eq!((time, tilt, rate, speed), (Some(0.0), Some(0.0), [Some(0.0); 3], None));
    }
}

/// With m along y and S in the plane of y and z, cos θ = my V Φy Φz never changes its sign, and is 0 at each whole turn.
#[test]
fn a_touch_is_no_flip() {
    for [y, z] in [[5.0, 3.0], [-5.0, 3.0], [0.1, 60.0]] {
        let found = margin_coin(&on_edge([0.0, y, z], 1.0)).unwrap();
        assert_eq!(found.time, None, "{y} {z}");
        for (axis, rate) in [(1, y), (2, z)] {
            let change = found.rate[axis].unwrap_or_else(|| panic!("{y} {z}: {found:?}"));
            assert!((change + rate).abs() <= 1e-12 * rate.abs(), "{y} {z}: {found:?}");
        }
    }
}

#[test]
fn what_cannot_flip_has_no_margin() {
    // A rod's spin does not matter, nor does any rate to a coin that lands at once.
    let rod = Coin::from_moments(1.0, 0.0).unwrap();
    let launch = Launch::new(Vector3::new(3.0, 0.0, 9.0), TimeOfFlight::Given(1.0)).unwrap();
    let found = margin_coin(&CoinToss { coin: rod, launch }).unwrap();
    assert!(found.rate[2].is_none() && found.rate[0].is_some(), "{found:?}");
    let found = margin_coin(&toss(Vector3::new(3.0, 2.0, 1.0), 0.3, 0.0)).unwrap();
    assert_eq!((found.rate, found.gravity), ([None; 3], None));
    assert!(found.time.is_some() && found.speed.is_some());
    // At rest, time does not matter, and half a turn about x or y is as good as any.
    let found = margin_coin(&toss(Vector3::zeros(), 0.3, 3.0)).unwrap();
    assert_eq!((found.time, found.speed, found.gravity, found.rate[2]), (None, None, None, None));
    assert!((found.tilt.unwrap() - (std::f64::consts::FRAC_PI_2 - 0.3)).abs() < 1e-15);
    let expected = found.tilt.unwrap() / (6.0 / 9.81);
    assert!((found.rate[0].unwrap() - expected).abs() < 1e-12, "{found:?}");
    // Of two that are as near, the flip of the higher rate.
    let found = margin_coin(&toss(Vector3::zeros(), 0.0, 3.0)).unwrap();
    let expected = std::f64::consts::FRAC_PI_2 / (6.0 / 9.81);
    assert!(found.rate[..2].iter().all(|change| (change.unwrap() - expected).abs() < 1e-12), "{found:?}");
}

#[test]
fn inputs_of_any_size_have_finite_margins() {
    let sizes = [0.0, 5e-324, 1e-300, 1e-30, 1.0, 1e15, 1e150, 1e300];
    for (size, time) in sizes.into_iter().flat_map(|size| sizes.map(|time| (size, time))) {
        for rate in [[1.0, 0.0, 0.0], [1.0, -1.0, 1.0], [0.0, 0.0, 1.0], [1e-20, 1.0, 1e-3]] {
            for (k, tilt) in [(0.0, 0.0), (1e-300, 1.0), (1.0, 1e-300), (2.0, 1e15), (0.5, std::f64::consts::FRAC_PI_2)]
            {
                // A coin that stays next to its edge takes all the work of a search, for which one time is enough.
                let stays_on_edge = k == 0.5 && (size < 1.0 || rate[0] < 1.0) && time >= 1.0;
                // So does the smallest rate, which has to be doubled most often before the coin flips.
                let doubles_for_long = size == 5e-324 && rate[0] != 1e-20;
                if (stays_on_edge && (size, time) != (1e-30, 1.0)) || doubles_for_long {
                    continue;
                }
                let launch = Launch::new(Vector3::from(rate) * size, TimeOfFlight::Given(time)).unwrap();
                let launch = launch.with_tilt(tilt).unwrap();
                let toss = CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch };
                let Ok(Margin { time, tilt, rate, rate_range: range, .. }) = margin_coin(&toss) else { continue };
                let all = [time, tilt, rate[0], rate[1], rate[2], Some(range[0]), Some(range[1]), Some(range[2])];
                assert!(all.iter().flatten().all(|value| value.is_finite()), "{toss:?}: {all:?}");
                let within = |axis: usize| rate[axis].is_none_or(|change| change.abs() <= 1.000_001 * range[axis]);
                assert!((0..3).all(within), "{toss:?}: {rate:?}");
            }
        }
    }
}

#[test]
fn a_scaled_toss_has_scaled_margins() {
    let scaled = |scale: f64| {
        let launch = Launch::new(Vector3::new(2e3, -5e3, 1e3) * scale, TimeOfFlight::Given(1e-3 / scale)).unwrap();
        let found = margin_coin(&CoinToss { coin: Coin::PAPER, launch: launch.with_tilt(1.2).unwrap() }).unwrap();
        (found.rate.map(|change| change.unwrap() / scale), found.time.unwrap() * scale, found.tilt)
    };
    assert_eq!(scaled(1.0), scaled(f64::exp2(900.0)));
}
