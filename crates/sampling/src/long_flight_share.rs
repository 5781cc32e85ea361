//! This file compares the probability of heads in the limit of a long flight with the share of heads among flights that
//! are long but finite. The comparison shows that the formula of the limit holds.

use std::f64::consts::PI;

use dynamics::time_of_flight::DEFAULT_GRAVITY;
use dynamics::{Coin, Error, InputError};

use crate::estimate::Estimate;
use crate::long_flight::{long_flight_probability, require_turning_momentum};
use crate::plan::Plan;
use crate::sampler::Sampler;
use crate::space::Space;

/// ωL of the long flights (rad/s).
const PRECESSION: f64 = 100.0;

/// Smallest and largest speed of the long flights (m/s).
const SPEEDS: [f64; 2] = [300.0, 600.0];

/// Numbers of turns ωL T/2π of the slowest and of the fastest long flight, with the default gravity.
pub const LONG_FLIGHT_TURNS: [f64; 2] = [turns(SPEEDS[0]), turns(SPEEDS[1])];

/// Number of turns ωL T/2π of a long flight with this speed (m/s), where T = 2 v0/g.
const fn turns(speed: f64) -> f64 {
    PRECESSION * speed / (PI * DEFAULT_GRAVITY)
}

/// The share of heads among long flights from horizontal, beside the probability in the limit.
#[derive(Debug, Clone, PartialEq)]
pub struct LongFlightShare {
    /// ψ, the angle between the coin's normal and its angular momentum (rad).
    pub cone_angle: f64,
    /// p(ψ), the probability of heads in the limit; see [`long_flight_probability`].
    pub limit: f64,
    /// The estimate from random speeds.
    pub estimate: Estimate,
}

/// A [`LongFlightShare`] as plain data: ψ (rad), the limit, the number of flights, the share of heads among them with its 95 %
/// interval, and the number of undecided flights if any flight of a list is undecided.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LongFlightLine {
    cone_angle: f64,
    limit: f64,
    launches: u64,
    share: Option<f64>,
    share_lo: Option<f64>,
    share_hi: Option<f64>,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    undecided: Option<u64>,
}

impl LongFlightLine {
    /// The lines of `shares`.
    pub fn list(shares: &[LongFlightShare]) -> Vec<Self> {
        let is_undecided = shares.iter().any(|found| found.estimate.undecided() > 0);
        let line = |LongFlightShare { cone_angle, limit, estimate }: &LongFlightShare| Self {
            cone_angle: *cone_angle,
            limit: *limit,
            launches: estimate.points,
            share: estimate.is_known().then_some(estimate.probability),
            share_lo: estimate.interval.map(|interval| interval.lo),
            share_hi: estimate.interval.map(|interval| interval.hi),
            undecided: is_undecided.then(|| estimate.undecided()),
        };
        shares.iter().map(line).collect()
    }
}

/// The angles ψ (rad) for which shares are listed: 30° to 90° in steps of 2.5°. Beyond 90° the curve is the mirror image.
pub fn listed_cone_angles() -> Vec<f64> {
    (12..=36).map(|step| (2.5 * f64::from(step)).to_radians()).collect()
}

impl Sampler<'_> {
    /// Estimates, for each of `cone_angles` = ψ (rad), the share of heads among `points` flights of
    /// [`LONG_FLIGHT_TURNS`] at random speeds. Each angle has random numbers of its own: the seed is `seed` for the
    /// first angle, `seed` + 1 for the next, and so on.
    ///
    /// # Errors
    /// As [`Sampler::estimate`]; an [`InputError`] for an angle that is not finite, for zero points, and for a rod, as
    /// k = 0 means that ψ is 90° at any rate.
    pub fn long_flight_shares(
        &self,
        coin: Coin,
        cone_angles: &[f64],
        (points, seed): (u64, u64),
    ) -> Result<Vec<LongFlightShare>, Error> {
        let share = |(index, &cone_angle): (u64, &f64)| {
            let space = long_flights(coin, cone_angle)?;
            let estimate = self.estimate(&space, Plan::Random { points, seed: seed.wrapping_add(index) })?;
            Ok(LongFlightShare { cone_angle, limit: long_flight_probability(cone_angle, cone_angle), estimate })
        };
        let goes_on = |_: &_| !(self.stop)();
        (0..).zip(cone_angles).take_while(goes_on).map(share).collect()
    }
}

/// The space of long flights at one cone angle ψ: Ω = ωL sin ψ and k ωz = ωL cos ψ.
fn long_flights(coin: Coin, cone_angle: f64) -> Result<Space, InputError> {
    let [lo, hi] = SPEEDS;
    require_turning_momentum(coin.inertia_ratio())?;
    Space::builder(coin)
        .rate_x(PRECESSION * cone_angle.sin())
        .rate_y(0.0)
        .rate_z(PRECESSION * cone_angle.cos() / coin.inertia_ratio())
        .speed(lo..=hi)
        .build()
}

#[cfg(test)]
mod tests {
    use exact::CoinMotion;

    use super::*;
    use crate::{Coordinate, Found, clopper_pearson};

    #[test]
    fn the_limits_lie_within_the_intervals_of_the_shares() {
        let cones = [0.5, 0.9, 1.1, 1.3, 1.5, 1.9, 2.8];
        for coin in [Coin::PAPER, Coin::from_moments(5e-7, 9.9e-7).unwrap()] {
            for found in Sampler::exact().long_flight_shares(coin, &cones, (4000, 1)).unwrap() {
                let Found::Counts(counts) = found.estimate.found else { panic!("flights are counted") };
                // The last, incomplete turn may shift the share by 1e-3.
                let interval = clopper_pearson(counts.heads(), counts.points(), 1.0 - 1e-6);
                assert!(interval.lo - 1e-3 <= found.limit && found.limit <= interval.hi + 1e-3, "{found:?}");
            }
        }
    }

    #[test]
    fn long_flights_have_the_documented_numbers_of_turns() {
        let precessions = [300.0, 600.0].map(|speed| {
            let space = long_flights(Coin::PAPER, 1.0).unwrap().with_axis(Coordinate::Speed, speed).unwrap();
            let toss = space.toss(&space.fixed_values()).coin().unwrap();
            CoinMotion::new(&toss).precession_rate() * toss.launch.flight_time() / (2.0 * PI)
        });
        for (found, expected) in LONG_FLIGHT_TURNS.into_iter().zip(precessions) {
            assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
        }
    }

    #[test]
    fn rejects_a_rod() {
        let rod = Coin::from_moments(5e-7, 0.0).unwrap();
        let refused = Sampler::exact().long_flight_shares(rod, &[1.0], (10, 1));
        assert!(matches!(refused, Err(Error::Input(_))));
    }
}
