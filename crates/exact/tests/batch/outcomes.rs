//! Outcomes near an edge.

use std::f64::consts::TAU;

use dynamics::Outcome;
use exact::{Batch, CoinMotion, certify};

use super::columns::{Columns, attitudes, coins};

/// The phases at landing approach one that lands on edge, down to the last digit of the speeds, after few turns and
/// after many.
#[test]
fn near_an_edge_the_filter_decides_rightly_or_not_at_all() {
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        for turns in [0.0, 3.0, 1e5, 1e8] {
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
            let mut outcomes = vec![Outcome::Undecided; tosses.len()];
            Batch::new(tosses).outcomes(&mut outcomes).unwrap();
            let certified = |index| certify(&tosses.toss(index).unwrap()).unwrap().outcome();
            assert!((0..tosses.len()).all(|index| outcomes[index] == certified(index)), "{turns} turns");
        }
    }
}
