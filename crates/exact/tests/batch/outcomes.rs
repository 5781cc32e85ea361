//! Outcomes near an edge, and counts of outcomes.

use std::f64::consts::TAU;

use dynamics::{Coin, Outcome};
use exact::{Batch, Certificate, CoinMotion, Stage, certify};
use numerics::lanes::SimdLevel;

use super::columns::{Columns, attitudes, coins, mixed};

/// The phases at landing approach one that lands on edge, down to the last digit of the speeds, after few turns and
/// after many.
#[test]
fn near_an_edge_the_filter_decides_rightly_or_not_at_all() {
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        for (turns, fewest_left) in [(0.0, 300), (3.0, 300), (1e5, 400), (1e8, 900)] {
            let mut columns = Columns::new(4000, 60.0, 5.0);
            for index in 0..4000 {
                let toss = columns.tosses(coin, attitude).toss(index).unwrap();
                let motion = CoinMotion::new(&toss.coin().unwrap());
                let heads = motion.heads();
                let away = 10f64.powi(-2 - (index % 15) as i32) * if index % 2 == 0 { 1.0 } else { -1.0 };
                let edge = (heads.crest + heads.half_width).rem_euclid(TAU) + TAU * turns + away;
                let speed = 0.5 * 9.81 * edge / motion.precession_rate();
                if speed >= 0.0 {
                    columns.speeds[index] = speed;
                }
            }
            let tosses = columns.tosses(coin, attitude);
            let (mut outcomes, mut rest) = (vec![Outcome::Undecided; tosses.len()], 0);
            Batch::new(tosses).outcomes(&mut outcomes).unwrap();
            Batch::new(tosses).count_and(|_| rest += 1).unwrap();
            let certified = |index| certify(&tosses.toss(index).unwrap()).unwrap().outcome();
            assert!((0..tosses.len()).all(|index| outcomes[index] == certified(index)), "{turns} turns");
            assert!((fewest_left..3900).contains(&rest), "the filter left {rest} after {turns} turns");
        }
    }
}

#[test]
fn counts_match_the_outcomes_at_every_level_and_length() {
    let columns = mixed(2000);
    for (attitude, length) in
        attitudes().into_iter().flat_map(|attitude| (0..=20).chain([2000]).map(move |n| (attitude, n)))
    {
        let tosses = columns.tosses(Coin::PAPER, attitude).part(0..length);
        let mut outcomes = vec![Outcome::Undecided; length];
        Batch::new(tosses).outcomes(&mut outcomes).unwrap();
        let all = |of: Outcome| outcomes.iter().filter(|outcome| **outcome == of).count() as u64;
        for level in SimdLevel::all() {
            let (mut left, mut later) = (0, 0);
            let count = |certificate: Certificate| {
                left += 1;
                later += u64::from(certificate.stage() != Stage::F64);
            };
            let counts = Batch::new(tosses).on(level).count_and(count).unwrap();
            assert_eq!((counts.heads(), counts.tails()), (all(Outcome::Heads), all(Outcome::Tails)));
            assert_eq!((counts.ties(), counts.total()), (all(Outcome::Undecided), length as u64));
            assert_eq!(counts.by(Stage::F64), length as u64 - later);
            assert!(length < 2000 || (1..50).contains(&left), "the filter left {left}");
            assert_eq!(Batch::new(tosses).on(level).count(), Ok(counts));
        }
    }
}
