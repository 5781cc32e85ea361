//! Outcomes near an edge, and counts of outcomes.

use std::f64::consts::TAU;

use dynamics::{Coin, Outcome};
use exact::{Batch, CoinMotion, certify};
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
fn counts_match_the_outcomes() {
    let columns = mixed(2000);
    for attitude in attitudes() {
        let tosses = columns.tosses(Coin::PAPER, attitude);
        let mut outcomes = vec![Outcome::Undecided; tosses.len()];
        Batch::new(tosses).outcomes(&mut outcomes).unwrap();
        let all = |of: Outcome| outcomes.iter().filter(|outcome| **outcome == of).count() as u64;
        for level in SimdLevel::all() {
            let mut left = 0;
            let counts = Batch::new(tosses).on(level).count_and(|_| left += 1).unwrap();
            assert_eq!((counts.heads, counts.tails), (all(Outcome::Heads), all(Outcome::Tails)));
            assert_eq!((counts.undecided, counts.total()), (all(Outcome::Undecided), 2000));
            assert!((1..50).contains(&left), "the filter left {left}");
            assert_eq!(Batch::new(tosses).on(level).count(), Ok(counts));
        }
    }
}
