use dynamics::{Coin, Outcome};

use super::*;
use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};

fn share_of(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> Share {
    let [x, y, z] = rate;
    let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
    share(&space, coin, &space.fixed_values()).unwrap()
}

/// The same share, found by counting the proven outcomes at the medians of 40 000 parts of equal probability.
fn counted(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> f64 {
    const PARTS: u32 = 40_000;
    let [x, y, z] = rate;
    let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
    let heads = (0..PARTS).filter(|part| {
        let mut values = space.fixed_values();
        values[Speed as usize] = space.axis(Speed).quantile((f64::from(*part) + 0.5) / f64::from(PARTS));
        certify(&space.coin_toss(&values).unwrap()).is_ok_and(|found| found.outcome() == Outcome::Heads)
    });
    heads.count() as f64 / f64::from(PARTS)
}

#[test]
fn the_share_matches_counted_outcomes() {
    let rates = [["1", "1", "2.5"], ["20", "-31", "7"], ["0", "9", "0"], ["-3", "40", "-60"], ["2", "2", "0.5"]];
    let mut certain = 0;
    for coin in [Coin::PAPER, Coin::DISC, Coin::from_moments(1.0, 1.0).unwrap()] {
        for rate in rates {
            for tilt in ["0", "0.4", "1.5707963", "2.9", "-0.7"] {
                for speed in ["3:5", "0:0.2", "0:300", "4:4.0001", "normal:4:0.1", "normal:4:0.4", "normal:90:9"] {
                    let share = share_of(coin, rate, tilt, speed);
                    let counted = counted(coin, rate, tilt, speed);
                    // Each edge of an interval of heads may add an error of one part; 300 m/s are at most 800
                    // turns.
                    let within = if speed.ends_with("00") || speed.ends_with(":9") { 5e-2 } else { 5e-4 };
                    let error = (share.probability - counted).abs();
                    assert!(error < within, "{rate:?} {tilt} {speed}: {share:?}, {counted}");
                    // The largest error is that of a coin that turns end over end at a tilt of nearly 90°, where
                    // cos θ stays below 1e-7.
                    assert!(share.error < 2e-6, "{rate:?} {tilt} {speed}: {share:?}");
                    certain += u32::from(share.error == 0.0);
                }
            }
        }
    }
    assert!(certain > 20, "{certain}");
}

#[test]
fn the_share_of_a_single_speed_is_0_or_1() {
    for (speed, probability) in [("0", 1.0), ("3", 0.0), ("3:3", 0.0)] {
        let share = share_of(Coin::PAPER, ["2", "2", "0.5"], "0", speed);
        assert_eq!(share, Share { probability, error: 0.0 });
    }
    // A quarter of a turn end over end: cos θ = 0 to rounding, but not exactly.
    let speed = (9.81 * PI / 36.0).to_string();
    assert_eq!(share_of(Coin::PAPER, ["0", "9", "0"], "0", &speed).error, 0.0);
    assert_eq!(share_of(Coin::PAPER, ["0", "0", "0"], "0.3", "3:5").probability, 1.0);
}

#[test]
fn a_share_that_depends_on_rounding_has_an_error() {
    // Phases whose distance to the edge of the heads is about its rounding error.
    let heads = HeadsPhases { crest: 0.0, half_width: 2.0, crest_error: 1e-15, half_width_error: 1e-15 };
    for (from, to) in [(2.0 - 3e-15, 2.0 - 1e-15), (1.0, 2.0 - 1e-15), (2.0 + 1e-15, 2.0 + 3e-15)] {
        let share = uniform_share(&heads, from, to);
        assert!(share.error > 1e-15 / (to - from), "{from}, {to}: {share:?}");
    }
    assert_eq!(uniform_share(&heads, 1.0, 1.9), Share { probability: 1.0, error: 0.0 });
}

#[test]
fn a_share_is_certain_only_beyond_the_error_of_the_edge() {
    let (half_width_error, crest_error, rounding) = (f64::exp2(-40.0), f64::exp2(-41.0), f64::exp2(-49.0));
    // `rounding` is the error of the phase 1: 4 ε (1 + 1).
    let error = half_width_error + crest_error + rounding;
    let heads = |half_width| HeadsPhases { crest: 0.0, half_width, crest_error, half_width_error };
    assert!(uniform_share(&heads(1.0 + error), 0.5, 1.0).error > 0.0);
    assert_eq!(uniform_share(&heads((1.0 + error).next_up()), 0.5, 1.0).error, 0.0);
    assert!(uniform_share(&heads(1.0 - error), 1.0, 1.0 + f64::EPSILON).error > 0.0);
}

fn assert_share(found: Share, probability: f64, error: f64) {
    assert!((found.probability - probability).abs() < 1e-15, "{found:?}, not {probability}");
    assert!((found.error - error).abs() < 1e-10 * error, "{found:?}, not {error}");
}

#[test]
fn shares_and_errors_match_the_formulas() {
    let heads =
        |crest_error, half_width_error| HeadsPhases { crest: 0.5, half_width: 1.0, crest_error, half_width_error };
    let rounding = 4.0 * f64::EPSILON;
    // The range ends 0.25 rad after the fourth edge from the crest; it shows heads for 1, 2 and 0.25 rad.
    let to = 0.5 + 4.0 * PI - 0.75;
    assert_share(
        uniform_share(&heads(0.0, 0.0), 0.5, to),
        3.25 / (to - 0.5),
        rounding * (3.0 * (1.0 + to) / (to - 0.5) + 1.0),
    );
    assert_share(uniform_share(&heads(1e-2, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + 0.02) / (to - 0.5));
    assert_share(uniform_share(&heads(4.0, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + TAU) / (to - 0.5));
    // Φ((1.5 - 1)/0.5) - Φ((-0.5 - 1)/0.5); the crests of three turns lie within the reach of the distribution.
    let probability = 0.839_994_848_036_912_8;
    assert_share(normal_share(&heads(0.0, 0.0), 1.0, 0.5), probability, 6.0 * rounding * (6.15 * 0.8 + 1.0));
    assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 0.5), probability, 6.0 * 1.1e-3 * 0.8);
    assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 2.0), 0.381_985_954_673_481_5, 14.0 * 1.1e-3 * 0.2);
    // The crest of a single turn lies within reach.
    assert_share(normal_share(&heads(1e-4, 1e-3), 0.5, 0.1), 1.0, 2.0 * 1.1e-3 * 4.0);
}

#[test]
fn a_motion_that_is_always_heads_or_never_has_a_share_without_error() {
    for speed in ["3:5", "normal:4:0.1"] {
        for (tilt, probability) in [("0", 1.0), ("3.1", 0.0)] {
            let share = share_of(Coin::PAPER, ["1", "1", "60"], tilt, speed);
            assert_eq!(share, Share { probability, error: 0.0 });
        }
        // At ψ = 45° the motion only touches cos θ = 0, but within its rounding error it may cross it.
        let share = share_of(Coin::PAPER, ["30", "0", "60"], "0", speed);
        assert!(share.probability > 1.0 - 1e-7 && share.error > 0.0, "{share:?}");
    }
}

#[test]
fn a_wide_normal_speed_gives_the_long_flight_limit() {
    let wide = share_of(Coin::PAPER, ["20", "0", "3"], "0", "normal:1000:20");
    let cone = 20_f64.atan2(1.5);
    let limit = crate::long_flight_probability(cone, cone);
    assert!((wide.probability - limit).abs() < 1e-15);
    // Both formulas agree at σ = 9 rad, where the code changes from one to the other.
    let heads = TiltTerms::new(
        &Space::parse(Coin::PAPER, &[(RateX, "20"), (RateY, "0"), (RateZ, "3"), (Speed, "3")])
            .unwrap()
            .coin_toss(&[20.0, 0.0, 3.0, 3.0, 9.81, 0.0])
            .unwrap(),
    )
    .heads();
    let [below, above] = [9.0_f64.next_down(), 9.0].map(|sd| normal_share(&heads, 100.0, sd));
    assert!((below.probability - above.probability).abs() < 1e-14, "{below:?} {above:?}");
    assert_eq!(above.error, heads.half_width_error / PI);
}

#[test]
fn refuses_a_phase_above_two_to_the_53() {
    let texts = [(RateX, "1e9"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1e9")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    let (_, error) = share(&space, Coin::PAPER, &space.fixed_values()).unwrap_err();
    assert!(matches!(error, SolveError::PhaseTooLarge { .. }));
    // A phase of exactly 2^53 rad is accepted.
    let texts = [(RateX, "9007199254740992"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1"), (Gravity, "2")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    assert!(share(&space, Coin::PAPER, &space.fixed_values()).is_ok());
}
