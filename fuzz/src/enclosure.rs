//! Spaces against their enclosures: what is proven of P(heads) has to agree with launches drawn at random.

use std::ops::RangeInclusive;

use sampling::{Plan, Sampler, Space, clopper_pearson};
use toss::{Coin, Error, Outcome, certify};

/// The accuracy that is asked for, which most of these spaces reach in milliseconds.
const ACCURACY: f64 = 0.02;
const LAUNCHES: u64 = 512;
/// From so many cells on they are compared with those of a single speed. Three wide ranges of rates take more than this.
const MANY_CELLS: u64 = 1 << 17;

/// The proven interval holds the probability that it states, and it meets the interval of random launches with a confidence
/// of all but 1e-13. Where heads or tails is proven to be certain, each of these launches lands so. A range of speeds takes no
/// more cells than its fastest speed alone, but for a factor of 2: a mean over speeds varies less than the outcome at one speed.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Some(space) = space_of(data, |speeds| speeds) else { return };
    let proven = match enclosed(&space) {
        Ok(found) => found,
        Err(error) => return crate::assert_said(&error),
    };
    if proven.points > MANY_CELLS {
        let fastest = space_of(data, |speeds| *speeds.end()..=*speeds.end()).expect("one of these speeds");
        let cells = enclosed(&fastest).map_or(u64::MAX, |found| found.points);
        assert!(proven.points / 2 <= cells, "{} cells, {cells} for one speed: {space:?}", proven.points);
    }
    let interval = proven.interval.expect("an enclosure has an interval");
    assert!(0.0 <= interval.lo && interval.hi <= 1.0 && interval.hi - interval.lo <= 2.0 * ACCURACY, "{proven:?}");
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

fn enclosed(space: &Space) -> Result<sampling::Estimate, Error> {
    Sampler::exact().estimate(space, Plan::Enclosure { accuracy: ACCURACY })
}

/// The space that some bytes stand for: k, four ranges and the tilt, with these of its speeds. Its flights turn by 100 rad at
/// most.
fn space_of(data: &[u8], of: fn(RangeInclusive<f64>) -> RangeInclusive<f64>) -> Option<Space> {
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
    let speed = of(range(0.0, 5.0)?);
    let tilt = 3.2 * next()?;
    Space::builder(coin).rate_x(x).rate_y(y).rate_z(z).speed(speed).tilt(tilt).build().ok()
}
