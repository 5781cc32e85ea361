//! Spaces against their enclosures: what is proven of P(heads) has to agree with launches drawn at random.

use sampling::{Plan, Sampler, Space, clopper_pearson};
use toss::{Coin, Outcome, certify};

/// The accuracy that is asked for, which most of these spaces reach in milliseconds.
const ACCURACY: f64 = 0.02;
const LAUNCHES: u64 = 512;
/// More cells, which take seconds, are a finding: halving has gone wrong.
const MOST_CELLS: u64 = 1 << 19;
/// Each range of rates makes a range of phases at landing (rad). Spaces in which the product of these, each with 1 rad more,
/// is larger are left out: they may need more cells though nothing is wrong.
const MOST_PHASES: f64 = 5000.0;

/// The proven interval holds the probability that it states, and it meets the interval of random launches with a confidence
/// of all but 1e-13. Where heads or tails is proven to be certain, each of these launches lands so. It takes a bounded number of
/// cells.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Some(space) = space(data) else { return };
    let plan = Plan::Enclosure { accuracy: ACCURACY };
    let proven = match Sampler::exact().estimate(&space, plan) {
        Ok(found) => found,
        Err(error) => return crate::assert_said(&error),
    };
    assert!(proven.points < MOST_CELLS, "{} cells of {space:?}", proven.points);
    let interval = proven.interval.expect("an enclosure has an interval");
    let is_as_narrow = interval.hi - interval.lo <= 2.0 * ACCURACY || proven.is_wider_than_asked();
    assert!(0.0 <= interval.lo && interval.hi <= 1.0 && is_as_narrow, "{proven:?}");
    assert!(interval.lo <= proven.probability && proven.probability <= interval.hi, "{proven:?}");
    let seed = data.iter().fold(1_u64, |seed, byte| seed.wrapping_mul(31).wrapping_add(u64::from(*byte)));
    let launches = space.drawn(Plan::Random { points: LAUNCHES, seed }).expect("a space of launches").flatten();
    let heads = launches
        .filter(|drawn| certify(&drawn.toss).expect("a short flight").outcome() == Outcome::Heads)
        .count() as u64;
    let sampled = clopper_pearson(heads, LAUNCHES, 1.0 - 1e-13);
    assert!(interval.lo <= sampled.hi && sampled.lo <= interval.hi, "{heads} of {LAUNCHES}: {proven:?} of {space:?}");
    assert!(interval.lo < 1.0 || heads == LAUNCHES, "{heads} of {LAUNCHES}: {proven:?} of {space:?}");
    assert!(interval.hi > 0.0 || heads == 0, "{heads} of {LAUNCHES}: {proven:?} of {space:?}");
}

/// The space that some bytes stand for: k, four ranges and the tilt. Its flights turn by 100 rad at most.
fn space(data: &[u8]) -> Option<Space> {
    let mut parts = data.as_chunks().0.iter().map(|bytes| f64::from(u16::from_le_bytes(*bytes)) / 65_535.0);
    let mut next = || parts.next();
    let coin = Coin::from_moments(1.0, 2.0 * next()?).ok()?;
    // The fourth power makes narrow ranges as likely as wide ones.
    let mut range = |least: f64, most: f64| {
        let (from, width) = (next()?, next()?.powi(4));
        let from = least + from * (most - least);
        Some(from..=from + width * (most - from))
    };
    let [x, y, z] = [range(-40.0, 40.0)?, range(-40.0, 40.0)?, range(-40.0, 40.0)?];
    let speed = range(0.0, 5.0)?;
    let phases = [&x, &y, &z].map(|rate| 1.0 + (rate.end() - rate.start()) * 2.0 * speed.end() / 9.81);
    if phases.iter().product::<f64>() > MOST_PHASES {
        return None;
    }
    let tilt = 3.2 * next()?;
    Space::builder(coin).rate_x(x).rate_y(y).rate_z(z).speed(speed).tilt(tilt).build().ok()
}
