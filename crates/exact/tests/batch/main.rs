//! These tests compare batches with single tosses: the outcomes must be the same, the landings must agree to the last
//! bits, and the results of a batch must be the same to the bit at every SIMD level.

mod columns;
mod invalid;
mod levels;
mod outcomes;

use dynamics::{Attitude, Error, Outcome, Tosses};
use exact::{Batch, CoinMotion, certify};

use columns::{Columns, attitudes, coins, mixed};

/// cos θ, the four columns of the attitude, and the outcomes.
type Solved = (Vec<f64>, [Vec<f64>; 4], Vec<Outcome>);

fn solved(batch: Batch<'_>, tosses: &Tosses<'_>) -> Result<Solved, Error> {
    let (mut cos_tilts, mut outcomes) = (vec![f64::NAN; tosses.len()], vec![Outcome::Undecided; tosses.len()]);
    let mut attitudes: [Vec<f64>; 4] = std::array::from_fn(|_| vec![f64::NAN; tosses.len()]);
    batch.cos_tilts(&mut cos_tilts)?;
    batch.attitudes(attitudes.each_mut().map(Vec::as_mut_slice))?;
    batch.outcomes(&mut outcomes)?;
    Ok((cos_tilts, attitudes, outcomes))
}

#[test]
fn a_batch_matches_its_single_tosses_to_the_last_bits() {
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        for columns in
            [Columns::new(5000, 60.0, 5.0), Columns::new(1000, 60.0, 0.0), Columns::new(1000, 1e4, 1e4), mixed(700)]
        {
            let tosses = columns.tosses(coin, attitude);
            let (cos_tilts, attitudes, outcomes) = solved(Batch::new(tosses), &tosses).unwrap();
            for index in 0..tosses.len() {
                let toss = tosses.toss(index).unwrap();
                let (motion, time) = (CoinMotion::new(&toss.coin().unwrap()), toss.launch.time_of_flight());
                assert!(cos_tilts[index].abs() <= 1.0, "{toss:?}: {}", cos_tilts[index]);
                let error = cos_tilts[index] - motion.cos_tilt(time).unwrap();
                assert!(error.abs() <= 2.75 * f64::EPSILON, "{toss:?}: cos θ is off by {error:e}");
                let landing = Attitude::from_components(attitudes.each_ref().map(|column| column[index])).unwrap();
                let error = landing.angle_to(&motion.state(time).unwrap().attitude);
                assert!(error <= 7.0 * f64::EPSILON, "{toss:?}: the attitude is off by {error:e}");
                assert_eq!(outcomes[index], certify(&toss).unwrap().outcome(), "{toss:?}");
            }
        }
    }
}
