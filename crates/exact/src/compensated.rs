//! This file computes cos θ and the state at landing in f64 with compensated phases. It is three times as fast as
//! [`CoinMotion`], and nearly as accurate at any phase.
//!
//! In plain f64 the phases ωL T and q T are off by a few roundings, and the error of cos θ grows with them. Here the
//! rounding error of each operation is carried along to first order. For products and sums it is computed exactly; for
//! the quotient and the root it follows from the residual of multiplying them out. The phases φ are then right to a few
//! u² φ, with u = 2^-53, and the rounding of sine, cosine and the result is what remains. Rates that were not given in rad/s
//! are left to the exact motion, which takes them as they were given.

use dynamics::phase::require_phase;
use dynamics::{Attitude, CoinToss, SolveError, State};
use nalgebra::Vector3;
use numerics::DoubleDouble;
use numerics::double_double::two_sum;
use numerics::scale::power_of_two_scale;

use crate::motion::CoinMotion;
use crate::tilt_terms::{SLOWEST_SQUARED, TiltTerms};

/// The angular momentum divided by I1, L = (ωx, ωy, k ωz), in the body frame (BF).
struct Momentum {
    /// L, in `unit`.
    vector: Vector3<f64>,
    /// |L|², in the square of `unit`.
    squared: f64,
    /// |L| = ωL and its rounding error, in `unit`.
    rate: [f64; 2],
    /// Unit of the rates (rad/s), a power of two.
    unit: f64,
}

impl Momentum {
    #[inline]
    fn new(toss: &CoinToss) -> Self {
        let (k, rate) = (toss.coin.exact_inertia_ratio(), toss.launch.rate());
        let unit = power_of_two_scale(rate.amax());
        let (x, y, z) = (rate.x / unit, rate.y / unit, rate.z / unit);
        let along = DoubleDouble::product(k.hi(), z);
        let along_rest = along.lo() + k.lo() * z;
        let squares = [x, y, along.hi()].map(|part| DoubleDouble::product(part, part));
        let across = two_sum(squares[0].hi(), squares[1].hi());
        let sum = two_sum(across.hi(), squares[2].hi());
        let rest = (sum.lo() + across.lo())
            + (squares[0].lo() + squares[1].lo() + squares[2].lo())
            + 2.0 * along.hi() * along_rest;
        let vector = Vector3::new(x, y, along.hi());
        Self { vector, squared: sum.hi(), rate: root(sum.hi(), rest), unit }
    }
}

/// √(`square` + `rest`) and its rounding error. 0 for a precession that is too slow to matter, as [`TiltTerms`]
/// explains.
#[inline]
pub(crate) fn root(square: f64, rest: f64) -> [f64; 2] {
    if square < SLOWEST_SQUARED {
        return [0.0, 0.0];
    }
    let root = square.sqrt();
    let product = DoubleDouble::product(root, root);
    [root, (((square - product.hi()) - product.lo()) + rest) / (2.0 * root)]
}

/// The phase (rad) that a rate and its rounding error, both in the `unit` (rad/s), reach in the time of flight of
/// `toss`.
#[inline]
pub(crate) fn turned([rate, rest]: [f64; 2], toss: &CoinToss, unit: f64) -> Result<DoubleDouble, SolveError> {
    // A rate of 0 gives phase 0 at any time, also where the product would be 0 · ∞.
    if rate == 0.0 {
        return Ok(DoubleDouble::ZERO);
    }
    let [time, time_rest] = toss.launch.time_of_flight().compensated().map(|part| unit * part);
    let product = DoubleDouble::product(rate, time);
    require_phase(product.hi().abs())?;
    Ok(two_sum(product.hi(), product.lo() + (rate * time_rest + rest * time)))
}

/// cos θ at landing.
#[inline]
pub fn compensated_cos_tilt(toss: &CoinToss) -> Result<f64, SolveError> {
    if toss.launch.rate_error() != 0.0 {
        return CoinMotion::new(toss).cos_tilt(toss.launch.time_of_flight());
    }
    let Momentum { vector, squared, rate, unit } = Momentum::new(toss);
    let phase = turned(rate, toss, unit)?;
    let spin = (toss.coin.inertia_ratio() - 1.0) * toss.launch.rate().z;
    if spin != 0.0 {
        require_phase(spin.abs() * toss.launch.flight_time())?;
    }
    let TiltTerms { mean, cosine, sine, size, .. } = TiltTerms::of_momentum(toss, &vector, squared, rate[0], unit);
    let (sin, cos) = phase.rounded_sin_cos();
    Ok(((mean + (cosine * cos + sine * sin)) / size).clamp(-1.0, 1.0))
}

/// State at landing. The attitude is `Q0 ⊗ exp(½ ωL T ŝ) ⊗ exp(-½ q T ẑ)`.
#[inline]
pub fn compensated_landing(toss: &CoinToss) -> Result<State, SolveError> {
    if toss.launch.rate_error() != 0.0 {
        return CoinMotion::new(toss).state(toss.launch.time_of_flight());
    }
    let Momentum { vector, rate: precession_rate, unit, .. } = Momentum::new(toss);
    let phase = turned(precession_rate, toss, unit)?;
    let spin = turned(spin_rate(toss, unit), toss, unit)?;
    let axis = if precession_rate[0] == 0.0 { Vector3::z() } else { vector / precession_rate[0] };
    let turn = Attitude::about_unit_axis(&axis, phase.half().rounded_sin_cos());
    let (sin_half, cos_half) = spin.half().rounded_sin_cos();
    let spun = Attitude::about_unit_axis(&Vector3::z(), (-sin_half, cos_half));
    let (sin, cos) = (2.0 * sin_half * cos_half, (cos_half - sin_half) * (cos_half + sin_half));
    let rate = toss.launch.rate();
    Ok(State {
        attitude: toss.launch.attitude() * turn * spun,
        rate: Vector3::new(rate.x * cos - rate.y * sin, rate.x * sin + rate.y * cos, rate.z),
    })
}

/// q = (k - 1) ωz and its rounding error, in the `unit` (rad/s).
#[inline]
fn spin_rate(toss: &CoinToss, unit: f64) -> [f64; 2] {
    let (k, z) = (toss.coin.exact_inertia_ratio(), toss.launch.rate().z / unit);
    let less_one = two_sum(k.hi(), -1.0);
    let rate = DoubleDouble::product(less_one.hi(), z);
    [rate.hi(), rate.lo() + (less_one.lo() + k.lo()) * z]
}

#[cfg(test)]
mod tests {
    use dynamics::phase::LARGEST_PHASE;
    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;

    /// The bounds are the same after 3 s and after 10^7 s.
    #[test]
    fn landings_match_the_exact_motion_to_the_last_bits() {
        let rates =
            [[1.0, 1.0, 2.5], [40.0, -31.0, 7.0], [0.0, 9.0, 0.0], [0.0, 0.0, 7.0], [0.0; 3], [5e-324, 0.0, 0.0]];
        let times = [3.0, 1e7].map(TimeOfFlight::Given).into_iter().chain([
            TimeOfFlight::thrown(3.1e6, 9.81, None),
            TimeOfFlight::thrown(3.1, 9.81, Some(0.7)),
            TimeOfFlight::thrown(1e-300, 9.81, None),
        ]);
        for (time, rate) in times.flat_map(|time| rates.map(|rate| (time, rate))) {
            for (k, tilt) in [0.0, 0.3, 1.0, 1.9].into_iter().flat_map(|k| [0.0, 0.7, 3.0].map(|tilt| (k, tilt))) {
                let launch = Launch::new(rate, time).unwrap().with_tilt(tilt).unwrap();
                // The inertia ratio k/1.1 has no exact f64, except for k = 0.
                let toss = CoinToss { coin: Coin::from_moments(1.1, k).unwrap(), launch };
                let (landing, motion) = (compensated_landing(&toss).unwrap(), CoinMotion::new(&toss));
                let exact = motion.state(time).unwrap();
                let error = landing.attitude.angle_to(&exact.attitude);
                assert!(error < 5.0 * f64::EPSILON, "{rate:?} {time:?} {k} {tilt}: {error:e}");
                let slip = (landing.rate - exact.rate).norm();
                assert!(slip <= 4.0 * f64::EPSILON * launch.turn_rate(), "{rate:?} {k}: {slip:e}");
                let error = compensated_cos_tilt(&toss).unwrap() - motion.cos_tilt(time).unwrap();
                assert!(error.abs() < 2.5 * f64::EPSILON, "{rate:?} {time:?} {k} {tilt}: {error:e}");
            }
        }
    }

    /// Just below and just above 2^53, where ωL T is the larger phase and where |q| T is.
    #[test]
    fn accepts_phases_up_to_two_to_the_53() {
        for (k, z, part, taken) in [
            (0.5, 2.0, 0.999, true),
            (0.5, 2.0, 1.001, false),
            (0.25, 4.0, 0.33, true),
            (0.25, 4.0, 0.34, false),
            (1.5, 2.0, 0.333, true),
            (1.5, 2.0, 0.334, false),
        ] {
            let time = TimeOfFlight::Given(part * LARGEST_PHASE);
            let launch = Launch::new(Vector3::new(0.0, 0.0, z), time).unwrap();
            let toss = CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch };
            assert_eq!(compensated_cos_tilt(&toss).is_ok(), taken, "{k}, {part}");
            assert_eq!(compensated_landing(&toss).is_ok(), taken, "{k}, {part}");
        }
    }

    #[test]
    fn a_precession_below_1e_100_counts_as_none() {
        assert_eq!([0.0, 0.99e-200].map(|square| root(square, 0.0)), [[0.0; 2]; 2]);
        assert!(root(1e-200, 0.0)[0] > 0.0);
    }
}
