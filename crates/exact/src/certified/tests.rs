//! These tests cover exact ties, the agreement of the stages with each other, and the error bounds of the derivations.

use dynamics::{Attitude, Coin, Error, Launch, TimeOfFlight, Toss, Unit};
use nalgebra::Vector3;
use numerics::big::exactly;

use super::*;
use crate::certificate::ProvenCounts;
use crate::multiprecision::cos_tilt as in_more_digits;

fn toss(k: f64, rate: [f64; 3], attitude: Attitude, time: f64) -> CoinToss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
    CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch: launch.with_attitude(attitude) }
}

/// Digits by mpmath, from the tilt and the cylinder as exact numbers. The quaternion of the tilt and the moments of the
/// cylinder, rounded to f64, land tails.
#[test]
fn what_is_proven_is_the_toss_as_it_was_given() {
    let toss = |coin, rate: [f64; 3], speed| {
        let thrown = TimeOfFlight::Ballistic { speed, gravity: 9.81 };
        CoinToss { coin, launch: Launch::new(rate, thrown).unwrap() }
    };
    let rate = [-24.064_598_567_199_237, -26.566_903_895_330_363, 49.564_483_551_046_28];
    let flat = toss(Coin::PAPER, rate, 2.410_790_522_567_343_6);
    let tilted = CoinToss { launch: flat.launch.with_tilt(2.515_084_104_129_282_4).unwrap(), ..flat };
    let cylinder = Coin::from_cylinder(0.003, 0.018_74, 0.001_14).unwrap();
    let rate = [-3.217_900_789_583_893_6, 169.214_640_584_066_1, -44.331_380_741_625_6];
    let thick = toss(cylinder, rate, 2.050_038_069_869_439);
    for (given, cos) in [(tilted, 1.083_048_700_603_535_2e-17), (thick, 5.367_562_989_044_33e-16)] {
        assert_eq!(certify_coin(&given).unwrap().outcome(), Outcome::Heads);
        assert!((cos_tilt(&given).unwrap() - cos).abs() < 1e-31);
        let attitude = Attitude::from_components(given.launch.attitude().components()).unwrap();
        let coin = Coin::from_moments(given.coin.i1(), given.coin.i3()).unwrap();
        let rounded = CoinToss { coin, launch: given.launch.with_attitude(attitude) };
        assert_eq!(certify_coin(&rounded).unwrap().outcome(), Outcome::Tails);
    }
}

/// A coin exactly on edge: w = x, so that mz = w² - x² = 0 and the vertical m is along the body's y axis.
fn on_edge() -> Attitude {
    let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    assert_eq!(edge.components()[0], edge.components()[1]);
    edge
}

#[test]
fn exact_ties_are_undecided_and_nothing_else_is() {
    let certified = |k, rate, time| certify_coin(&toss(k, rate, on_edge(), time)).unwrap();
    let tie = Certificate::new(Outcome::Undecided, Stage::MoreDigits);
    // A coin at rest, one that lands at once, two in pure spin, and two whose S is vertical and in the coin's plane.
    for (k, rate, time) in [
        (1.5, [0.0; 3], 1.0),
        (1.5, [1.0, 2.0, 3.0], 0.0),
        (1.5, [0.0, 0.0, 7.0], 1.0),
        (0.0, [0.0, 0.0, 7.0], 1.0),
        (1.5, [0.0, 7.0, 0.0], 1.0),
        (0.0, [0.0, -7.0, 3.0], 1.0),
    ] {
        assert_eq!(certified(k, rate, time), tie, "{k} {rate:?} {time}");
    }
    // No tie if S has a part along the normal, even though m is parallel to the part across it.
    assert_ne!(by_multiprecision(&toss(1.5, [0.0, 7.0, 3.0], on_edge(), 1.0)), Outcome::Undecided);
    // No tie for a coin that is dropped from a height: it has speed 0, but does not land at once.
    let dropped = TimeOfFlight::BallisticTo { speed: 0.0, gravity: 9.81, drop: 1.0 };
    let launch = Launch::new(Vector3::new(1.0, 2.0, 3.0), dropped).unwrap().with_attitude(on_edge());
    assert_ne!(by_multiprecision(&CoinToss { coin: Coin::PAPER, launch }), Outcome::Undecided);
    // cos θ = (mx Ly - my Lx) t to first order, here -ωx t.
    for (rate, time, outcome) in [
        ([1e-300, 7.0, 0.0], 1.0, Outcome::Tails),
        ([-1e-300, 7.0, 0.0], 1.0, Outcome::Heads),
        ([1.0, 2.0, 0.0], 5e-324, Outcome::Tails),
        ([-1.0, 2.0, 3.0], 1e-310, Outcome::Heads),
    ] {
        let found = certified(1.5, rate, time);
        assert_eq!((found.outcome(), found.stage()), (outcome, Stage::MoreDigits), "{rate:?} {time}");
    }
}

#[test]
fn the_cheapest_stage_that_can_decides() {
    let stage = |rate, time| certify_coin(&toss(1.0, rate, Attitude::IDENTITY, time)).unwrap().stage();
    assert_eq!(stage([20.0, 3.0, 0.0], 0.6), Stage::F64);
    // cos θ is -10^-15, 6·10^-17, and 10^-20.
    let quarter = std::f64::consts::FRAC_PI_2;
    assert_eq!(stage([1.0, 0.0, 0.0], quarter + 1e-15), Stage::DoubleDouble);
    assert_eq!(stage([1.0, 0.0, 0.0], quarter), Stage::DoubleDouble);
    let near_edge = |tilt| certify_coin(&toss(1.0, [0.0; 3], Attitude::about_x(tilt), 1.0)).unwrap().stage();
    assert_eq!(near_edge(quarter), Stage::DoubleDouble);
    let tiny = toss(1.0, [1e-20, 7.0, 0.0], on_edge(), 1.0);
    assert_eq!(certify_coin(&tiny).unwrap().stage(), Stage::MoreDigits);
}

/// 40 neighbouring times around each of 200 landings on edge, and launches that are not flat or leave the range.
#[test]
fn a_flat_coin_without_spin_is_decided_by_one_cosine() {
    let flat = |rate: [f64; 3], tilt, time| toss(1.5, rate, Attitude::about_x(tilt), time);
    let mut undecided = 0;
    for quarter in 0..200 {
        let time = (f64::from(quarter) + 0.5) * std::f64::consts::PI / 7.0;
        for ulps in 0..40_u64 {
            let toss = flat([7.0, 0.0, 0.0], 0.0, f64::from_bits(time.to_bits() - 20 + ulps));
            assert!(flat_phase(&toss).is_some_and(|phase| (phase - 7.0 * time).abs() < 1e-11));
            match by_f64(&toss) {
                Some(outcome) => assert_eq!(outcome, by_multiprecision(&toss), "{toss:?}"),
                None => undecided += 1,
            }
        }
    }
    assert!(undecided > 100, "{undecided}");
    assert_eq!([[3.0, 4.0, 0.0], [4.0, -3.0, 0.0]].map(|rate| flat_phase(&flat(rate, 0.0, 2.0))), [Some(10.0); 2]);
    for (rate, tilt, time) in [
        ([7.0, 1.0, 1e-9], 0.0, 1.0),
        ([7.0, 1.0, 0.0], 1e-9, 1.0),
        ([1e-150, 0.0, 0.0], 0.0, 1.0),
        ([7.0, 1.0, 0.0], 0.0, 1e-200),
        ([1.0, 0.0, 0.0], 0.0, 0.99 * LARGEST_PHASE),
    ] {
        assert_eq!(flat_phase(&flat(rate, tilt, time)), None, "{rate:?} {tilt} {time}");
    }
}

/// Where f64 decides, which it does nearly always, so do they, alike. The bound of f64 is that of the derivation.
#[test]
fn balls_in_double_double_contain_those_of_more_digits() {
    assert_eq!([0.0, 2.0].map(f64_bound), [34.0, 48.0].map(|units: f64| units * UNIT_ROUNDOFF));
    let (mut largest, mut by_f64_too) = (0.0_f64, 0);
    for index in 1..=300 {
        let part = |irrational: f64| 2.0 * (f64::from(index) * irrational).fract() - 1.0;
        let rate = [2f64, 3.0, 5.0].map(|square| 40.0 * part(square.sqrt()));
        let attitude = Attitude::from_components([7f64, 11.0, 13.0, 17.0].map(|square| part(square.sqrt()))).unwrap();
        let launch = TimeOfFlight::Ballistic { speed: 10f64.powi(index % 14), gravity: 9.81 };
        let coin = Coin::from_cylinder(0.003, 0.018_74, 0.001_14).unwrap();
        let toss = CoinToss { coin, launch: Launch::new(rate, launch).unwrap().with_attitude(attitude) };
        let (ball, fine) = (cos_tilt_in_double_double(&toss).unwrap(), in_more_digits(&toss, 192));
        let off = (ball.to_big() - fine.to_big()).to_f64().value().abs();
        assert!(off <= ball.radius() && ball.radius() < 1e-11, "{toss:?}: {off:e} {:e}", ball.radius());
        largest = largest.max(off / ball.radius());
        if let Some(outcome) = by_f64(&toss) {
            by_f64_too += 1;
            assert_eq!((outcome, Outcome::of(ball.sign(), 0.0)), (by_multiprecision(&toss), outcome), "{toss:?}");
        }
    }
    assert!(largest > 1e-4 && by_f64_too > 250, "{largest:e} {by_f64_too}");
}

#[test]
fn the_stage_in_f64_decides_beyond_its_bound_in_parts_of_the_size() {
    // B keeps |A| below the amplitude.
    for (units, outcome) in [(101.0, None), (103.0, Some(Outcome::Heads)), (-103.0, Some(Outcome::Tails))] {
        assert_eq!(by_terms(&terms(1.0 + units * UNIT_ROUNDOFF, -1.0, 3.0), 0.0, 0.0), outcome, "{units}");
    }
    // Rates with an error add it, times the phase: at ½ rad 38 u in all, of a B that hardly changes.
    let turned = |units: f64| by_terms(&terms(units * UNIT_ROUNDOFF, 0.0, 1.0), 0.5, UNIT_ROUNDOFF);
    assert_eq!([37.5, 38.5].map(turned), [None, Some(Outcome::Heads)]);
}

/// A² - B² above 100 u size². At a phase of 2^52 the cosine decides nothing.
#[test]
fn a_coin_keeps_its_face_beyond_the_amplitude_alone() {
    let by_sign = |units: f64| {
        let terms = terms(1.0, 1.0 - units * UNIT_ROUNDOFF, 3.0);
        by_terms(&terms, 0.5 * LARGEST_PHASE, 0.0)
    };
    assert_eq!([448.0, 450.0, 452.0].map(by_sign), [None, None, Some(Outcome::Heads)]);
    // tan ψ = Ω/(k ωz), here just below 1, and upside down.
    let outcome = |rate, tilt| by_f64(&toss(2.0, rate, Attitude::about_x(tilt), 1e9));
    assert_eq!(outcome([1.999, 0.0, 1.0], 0.0), Some(Outcome::Heads));
    assert_eq!(outcome([1.0, 0.0, 9.0], 3.1), Some(Outcome::Tails));
    // Cones of nearly 45° that land at their lowest point.
    for index in 0..3000 {
        let part = |irrational: f64| 2.0 * (f64::from(index) * irrational).fract() - 1.0;
        let nearness = 10f64.powi(-(index % 17)) * part(13f64.sqrt());
        let (k, z) = (f64::from(1 + index % 4) * 0.5, 40.0 * part(5f64.sqrt()));
        let across = k * z * (1.0 + nearness);
        let time = std::f64::consts::PI / across.hypot(k * z);
        let toss = toss(k, [across, 0.0, z], Attitude::about_x(0.0), time);
        assert!(by_f64(&toss).is_none_or(|outcome| outcome == by_multiprecision(&toss)), "{toss:?}");
    }
}

/// Terms with C = 0 and these values instead of those of a toss.
fn terms(mean: f64, cosine: f64, size: f64) -> TiltTerms {
    let mut terms = TiltTerms::new(&toss(1.0, [1.0, 0.0, 0.0], Attitude::IDENTITY, 1.0));
    (terms.mean, terms.cosine, terms.sine, terms.size) = (mean, cosine, 0.0, size);
    terms
}

#[test]
fn f64_is_tried_for_phases_up_to_99_percent_of_the_largest() {
    let in_range = |k: f64, rate: [f64; 3], time: f64| {
        let toss = toss(k, rate, Attitude::IDENTITY, time);
        phase_in_range(&toss, &TiltTerms::new(&toss)).is_some()
    };
    for (part, taken) in [(0.985, true), (0.99, false), (0.995, false)] {
        let time = part * LARGEST_PHASE;
        assert_eq!(in_range(1.0, [1.0, 0.0, 0.0], time), taken, "precession {part}");
        assert_eq!(in_range(0.0, [0.0, 0.0, 1.0], time), taken, "spin {part}");
    }
    for (time, taken) in [(0.0, true), (1e-200, true), (0.99e-200, false)] {
        assert_eq!(in_range(1.0, [1.0, 0.0, 0.0], time), taken, "{time}");
    }
}

/// Rates of 1 to 30 rad/s about each axis turn the coin by up to some 60 rad; a part in a thousand of that decides a few
/// of a hundred tosses.
#[test]
fn an_outcome_that_holds_within_a_part_of_the_numbers_is_that_of_all_tosses_around() {
    const RELATIVE: f64 = 1e-3;
    let part = |index: u32, irrational: f64| (f64::from(index) * irrational).fract();
    let [mut held, mut changed] = [0, 0];
    for index in 1..2000 {
        let rate = [0.618_034, 0.732_051, 0.414_214].map(|of| 1.0 + 29.0 * part(index, of));
        let (k, time) = (0.1 + 1.8 * part(index, 0.236_068), 0.5 + 1.5 * part(index, 0.645_751));
        let attitude = Attitude::about_x(3.0 * part(index, 0.316_625));
        let outcome_of = |signs: [f64; 5]| {
            let [x, y, z, of_k, of_time] = signs.map(|sign| 1.0 + sign * RELATIVE);
            let rate = [rate[0] * x, rate[1] * y, rate[2] * z];
            certify_coin(&toss(k * of_k, rate, attitude, time * of_time)).unwrap().outcome()
        };
        let own = outcome_of([0.0; 5]);
        // The corners in which all numbers grow, all shrink, and each grows or shrinks against the others.
        let corners = (0..32_u32).map(|bits| [0, 1, 2, 3, 4].map(|bit| if bits >> bit & 1 == 1 { 1.0 } else { -1.0 }));
        let changes = corners.map(outcome_of).any(|outcome| outcome != own);
        let holds = holds_within(&toss(k, rate, attitude, time), RELATIVE).unwrap();
        assert!(!(holds && changes), "{index}");
        held += u32::from(holds);
        changed += u32::from(changes);
    }
    assert!(held > 1500 && changed > 20, "{held} hold, {changed} change");
}

/// In double-double its error would be up to 3e-16 at the largest phases. Half a unit in the last place is 2^-54.
#[test]
fn cos_tilt_is_the_nearest_f64_at_large_phases_and_of_rates_in_turns() {
    let turn = Unit::TURN;
    for (unit, phase) in [(Unit::ONE, 8.5e15), (Unit::ONE, 1.01e14), (turn, 8.5e15), (turn, 1e3)] {
        for index in 1..=100 {
            let part = |square: f64| (f64::from(index) * square.sqrt()).fract() - 0.5;
            let rate = [2.0, 3.0, 5.0].map(|square| 160.0 * part(square));
            let toss = |time| {
                let launch = Launch::in_unit(rate, unit, TimeOfFlight::Given(time)).unwrap();
                CoinToss { coin: Coin::DISC, launch: launch.with_tilt(0.3).unwrap() }
            };
            let toss = toss(phase / CoinMotion::new(&toss(1.0)).precession_rate());
            let exact = in_more_digits(&toss, 256).to_big();
            let off = (exactly(cos_tilt(&toss).unwrap()) - exact).to_f64().value().abs();
            assert!(off <= 1.001 * 2f64.powi(-54), "{toss:?}: {off:e}");
        }
    }
}

#[test]
fn tosses_are_counted_by_face_and_the_first_without_an_outcome_is_named() {
    let heads = toss(1.5, [1.0, 0.0, 0.0], Attitude::IDENTITY, 1.0);
    let tails = toss(1.5, [3.0, 0.0, 0.0], Attitude::IDENTITY, 1.0);
    let tie = toss(1.5, [0.0, 0.0, 7.0], on_edge(), 1.0);
    let counts = ProvenCounts::of([tails, heads, tie, heads, heads].map(Toss::from)).unwrap();
    assert_eq!((counts.heads, counts.tails, counts.undecided), (3, 1, 1));
    assert_eq!(counts.by(Stage::MoreDigits), 1);
    let too_long = toss(1.5, [1e16, 0.0, 0.0], Attitude::IDENTITY, 1.0);
    let error = ProvenCounts::of([heads, too_long, too_long].map(Toss::from)).unwrap_err();
    assert!(matches!(error, Error::Launch { index: 1, .. }), "{error}");
}
