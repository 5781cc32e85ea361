//! This file draws the random flights on which solvers are measured. It shares no code with the random launches of the
//! crate `sampling`, which is measured itself, so that a change of these moves no measurement of a solver.

use dynamics::coin::NO_COIN;
use rand::distr::Open01;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use sampling::Coordinate::{self, Gravity, RateX, RateY, RateZ, Speed, Tilt};
use sampling::{AxisOrTie, Distribution, Space};
use toss::{CoinToss, InputError, Launch, TimeOfFlight, Vector3};

/// The first `number` independent launches of `space`, whose axes are ranges or single values.
///
/// # Errors
/// [`InputError`] for an axis with a normal distribution.
pub(crate) fn random_flights(space: &Space, seed: u64, number: u64) -> Result<Vec<CoinToss>, InputError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..number).map(|_| flight(space, &mut rng)).collect()
}

fn flight(space: &Space, rng: &mut ChaCha8Rng) -> Result<CoinToss, InputError> {
    let mut values = [0.0; Coordinate::COUNT];
    for of in Coordinate::ALL {
        if let AxisOrTie::Axis(axis) = space.axis_or_tie(of) {
            values[of as usize] = match axis.distribution() {
                Distribution::Uniform { lo, hi } if lo == hi => lo,
                Distribution::Uniform { lo, hi } => lo + rng.sample::<f64, _>(Open01) * (hi - lo),
                Distribution::Normal { .. } => {
                    let (field, value) = (of.field(), axis.to_string());
                    return Err(InputError::Malformed { field, value, expected: "a range or a single value" });
                }
            };
        }
    }
    let value = |of| match space.axis_or_tie(of) {
        AxisOrTie::Axis(_) => values[of as usize],
        AxisOrTie::SameAs(other) => values[other as usize],
    };
    let rate = Vector3::new(value(RateX), value(RateY), value(RateZ));
    let launch = Launch::new(rate, TimeOfFlight::thrown(value(Speed), value(Gravity), space.drop()))?;
    let launch = if value(Tilt) == 0.0 { launch } else { launch.with_tilt(value(Tilt))? };
    Ok(CoinToss { coin: space.coin().ok_or(NO_COIN)?, launch })
}
