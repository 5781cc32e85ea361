//! Tests of the exact motion: attitudes, angles and cos θ at special launches and at large phases.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use dynamics::quantity::Dimension;
use dynamics::{Coin, Launch, TimeOfFlight};

use super::*;

fn motion(coin: Coin, rate: [f64; 3], tilt: f64) -> CoinMotion {
    let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
    CoinMotion::new(&CoinToss { coin, launch })
}

fn samples() -> Vec<CoinMotion> {
    let rates = [[1.0, 1.0, 2.5], [2.0, 2.0, 0.5], [3.0, -4.0, 0.0], [0.0, 0.0, 7.0], [-5.0, 2.0, -9.0]];
    let tilts = [0.0, 1e-9, 0.7, FRAC_PI_2, 2.8];
    let coins = [0.5, 2.0, 1.0, 0.0].map(|k| Coin::from_moments(1.0, k).unwrap());
    let launches = rates.iter().flat_map(|rate| tilts.map(|tilt| (*rate, tilt)));
    launches.flat_map(|(rate, tilt)| coins.map(|coin| motion(coin, rate, tilt))).collect()
}

#[test]
fn attitude_tilt_and_euler_angles_agree() {
    for motion in samples() {
        for step in 0..60 {
            let time = 0.05 * f64::from(step);
            let attitude = motion.state(time).unwrap().attitude;
            let angles = motion.euler_angles(time).unwrap();
            assert!((motion.cos_tilt(time).unwrap() - attitude.cos_tilt()).abs() < 1e-14);
            assert!(angles.attitude().angle_to(&attitude) < 1e-13, "{motion:?} at {time}: {angles:?}");
        }
    }
}

#[test]
fn euler_angles_start_at_the_limit_of_a_horizontal_launch() {
    for rate in [[1.0, 1.0, 2.5], [3.0, -4.0, 0.0], [-5.0, 2.0, -9.0]] {
        let start = motion(Coin::PAPER, rate, 0.0).euler_angles(0.0).unwrap();
        assert!((start.alpha - rate[1].atan2(rate[0])).abs() < 1e-15);
        assert_eq!((start.beta, start.gamma), (0.0, -start.alpha));
    }
}

#[test]
fn euler_angles_are_continuous_for_many_turns() {
    let horizontal = [[1.0, 1.0, 2.5], [2.0, 2.0, 0.5], [3.0, -4.0, 0.0], [-5.0, 2.0, -9.0]].map(|rate| (rate, 0.0));
    // Tilted coins that turn end over end in both senses, and cones that do and do not enclose the vertical.
    let tilted = [([3.0, 0.0, 0.0], 0.7), ([-3.0, 0.0, 0.0], 0.7), ([0.8, 1.6, 0.9], 1.3), ([0.3, 0.3, 5.0], 1.0)];
    for (rate, tilt) in horizontal.into_iter().chain(tilted) {
        let motion = motion(Coin::PAPER, rate, tilt);
        let mut last = motion.euler_angles(0.0).unwrap();
        for step in 1..20_000 {
            let time = 1e-3 * f64::from(step);
            let next = motion.euler_angles(time).unwrap();
            for (a, b) in [(next.alpha, last.alpha), (next.beta, last.beta), (next.gamma, last.gamma)] {
                assert!((a - b).abs() < 0.05, "{rate:?}, {tilt} at step {step}: {last:?} → {next:?}");
            }
            assert!(next.attitude().angle_to(&motion.state(time).unwrap().attitude) < 1e-12);
            last = next;
        }
    }
}

#[test]
fn the_face_changes_at_the_first_flip_and_not_before() {
    for motion in samples() {
        let launch = motion.cos_tilt(0.0).unwrap();
        if launch.abs() < 1e-9 {
            continue;
        }
        let until = motion.first_flip().unwrap_or(50.0);
        for part in 1..100 {
            assert!(motion.cos_tilt(until * f64::from(part) / 100.0).unwrap() * launch > 0.0, "{motion:?}");
        }
        if motion.first_flip().is_some() {
            assert!(motion.cos_tilt(until * (1.0 + 1e-9)).unwrap() * launch < 0.0, "{motion:?}");
        }
    }
}

#[test]
fn cone_angle_and_momentum_tilt_are_45_degrees_for_equal_components() {
    // Ω = k ωz: n and S enclose 45°.
    let motion = motion(Coin::DISC, [2.0, 0.0, 1.0], 0.0);
    assert!([motion.cone_angle(), motion.momentum_tilt()].iter().all(|angle| (angle - FRAC_PI_4).abs() < 1e-15));
}

#[test]
fn refuses_a_phase_above_two_to_the_53_but_no_coin_at_rest() {
    let fast = motion(Coin::PAPER, [1e10, 0.0, 0.0], 0.0);
    assert!(matches!(fast.cos_tilt(1e6), Err(SolveError::PhaseTooLarge { .. })));
    let spinning_sphere = motion(Coin::from_moments(1.0, 0.0).unwrap(), [0.0, 0.0, 1e300], 0.0);
    assert!(matches!(spinning_sphere.state(1.0), Err(SolveError::PhaseTooLarge { .. })));
    assert_eq!(motion(Coin::PAPER, [0.0; 3], 0.0).cos_tilt(1e308), Ok(1.0));
}

#[test]
fn huge_and_subnormal_rates_give_accurate_results() {
    let slow = motion(Coin::PAPER, [5e-324, 0.0, 5e-324], 0.3).cos_tilt(1e300).unwrap();
    assert!((slow - 0.3f64.cos()).abs() < 1e-15);
    let fast = motion(Coin::PAPER, [1e300, 1e300, 2.5e300], 0.0);
    let paper = motion(Coin::PAPER, [1.0, 1.0, 2.5], 0.0);
    assert!((fast.cos_tilt(1e-300).unwrap() - paper.cos_tilt(1.0).unwrap()).abs() < 1e-15);
}

/// After 10^8 turns the rounding of these rates to rad/s turns the coin by 3.8e-8 rad. Right values by mpmath, in 60 digits
/// from the rates as they are given.
#[test]
fn rates_in_degrees_are_taken_as_they_were_given() {
    let degrees = Dimension::TurnRate.given("", "1deg/s").unwrap().unit().size();
    let launch = Launch::in_unit([36_000.1, 200.3, 300.7], degrees, TimeOfFlight::Given(1e6)).unwrap();
    let toss = CoinToss { coin: Coin::from_moments(1.0, 0.5).unwrap(), launch };
    let motion = CoinMotion::new(&toss);
    for (time, expected) in [
        (1e6, [-0.541_482_405_829_914_6, 0.765_601_124_820_789_9, 0.283_489_819_344_987_1, 0.200_711_843_640_417_8]),
        (5e5, [0.156_108_869_475_303_09, -0.082_330_976_949_412_4, 0.452_195_387_255_056_8, 0.874_283_113_671_393_8]),
        (2.5e5, [0.155_145_838_650_316_78, 0.620_392_021_365_843_4, 0.747_764_454_218_116_2, -0.178_582_836_753_635_4]),
    ] {
        let expected = Attitude::from_components(expected).unwrap();
        let found = motion.state(time).unwrap().attitude;
        assert!(found.angle_to(&expected) < 1e-15, "{time}: {found:?}");
        let landed = CoinToss { launch: launch.with_time_of_flight(TimeOfFlight::Given(time)).unwrap(), ..toss };
        let compensated = crate::compensated_landing(&landed).unwrap().attitude;
        assert!(compensated.angle_to(&expected) < 1e-15, "{time}: {compensated:?}");
        assert!((crate::compensated_cos_tilt(&landed).unwrap() - expected.cos_tilt()).abs() < 1e-15, "{time}");
    }
    assert!((motion.cos_tilt(1e6).unwrap() + 0.333_023_119_998_224_26).abs() < 2e-16);
    let change = crate::margin(&toss.into()).unwrap().time.unwrap();
    assert!((change / 5.403_405_092_509_659e-4 - 1.0).abs() < 1e-12, "{change}");
}
