//! Outcomes and cos θ in as many digits as it takes, from the numbers that coin and launch were made from.
//!
//! Digits are doubled until cos θ differs from 0 by more than its error. This ends, because cos θ is never 0 but for
//! ties that are found by exact arithmetic first. With the numbers of a toss algebraic, so are k, L, T and φ = |L| T.
//!
//! - From a quaternion, or a tilt that is a rational part of a turn, A, B and C are algebraic. e^(iφ) is transcendental
//!   for φ ≠ 0 (Lindemann), so that A + B cos φ + C sin φ = 0 needs φ = 0 and A + B = 0, or A = B = C = 0.
//! - From a tilt β in radians, there is no tie. With ŝ = L/|L| and Q = 1 - ŝz²,
//!
//!   ```text
//!   cos θ = ŝz² cos β + ŝy ŝz sin β + ½ (Q + ŝx) cos(β + φ) + ½ (Q - ŝx) cos(β - φ)
//!           - ½ ŝy ŝz sin(β + φ) - ½ ŝy ŝz sin(β - φ)
//!   ```
//!
//!   Sines and cosines of different algebraic angles |β|, |β + φ|, |β - φ| are linearly independent over the algebraic
//!   numbers (Lindemann and Weierstrass), so that each coefficient has to be 0. If the angles differ, Q = ±ŝx = 0 and
//!   ŝz = 0, against Q = 1 - ŝz². If φ = 2|β|, two of them are |β| and the third is 3|β|, whose coefficients are 0 if
//!   Q = ±ŝx and ŝy ŝz = 0; the cosine of β then has the coefficient ŝz² + Q = 1. If φ = |β|, one of them is 0 and
//!   another 2|β|; Q + ŝx = Q - ŝx = 0 leaves ŝz² = 1 for the cosine of β. If φ = 0, cos θ = cos β, and if β = 0,
//!   cos θ = ŝz² + Q cos φ: neither is 0.
//! - With rates in turns, φ is π times an algebraic number, and there are more ties: a coin that is flipped at one turn
//!   in a second is on edge after a quarter of a second. Such a toss counts as a tie if |cos θ| is below 2^-12000.

use std::iter::successors;

use dynamics::{CoinToss, Outcome};
use numerics::big::{Big, exactly};
use numerics::{Elementary, WideBall};

use crate::given::{in_digits, right_to_roundings};
use crate::tilt_terms::cos_tilt_in;

/// Digits to begin with.
const FEWEST_DIGITS: usize = 192;

/// Digits after which a toss with rates in turns counts as a tie.
const MOST_DIGITS_OF_TURNS: usize = 12_288;

/// The stage of a proof in as many digits as it takes. It always decides, but for exact ties.
pub(crate) fn by_multiprecision(toss: &CoinToss) -> Outcome {
    decided_cos_tilt(toss, WideBall::has_sign).map_or(Outcome::Undecided, |cos_tilt| Outcome::of(cos_tilt.sign(), 0.0))
}

/// cos θ at landing, rounded to f64 so that it keeps its sign. It is 0 for an exact tie alone.
pub(crate) fn rounded_cos_tilt(toss: &CoinToss) -> f64 {
    const SMALLEST: f64 = f64::from_bits(1);
    let Some(exact) = decided_cos_tilt(toss, has_digits_of_f64) else { return 0.0 };
    let rounded = exact.to_f64();
    if rounded == 0.0 { exact.sign() * SMALLEST } else { rounded }
}

/// Whether a ball is right to 60 bits, so that its midpoint may be rounded to f64.
pub(crate) fn has_digits_of_f64(ball: &WideBall) -> bool {
    ball.is_right_to(2f64.powi(-60))
}

/// The first ball with cos θ at landing that has enough digits; `None` for an exact tie.
fn decided_cos_tilt(toss: &CoinToss, has_enough: impl Fn(&WideBall) -> bool) -> Option<WideBall> {
    if is_tie(toss) {
        return None;
    }
    let may_be_0 = toss.launch.given_rate().1.is_of_turn();
    successors(Some(FEWEST_DIGITS), |digits| Some(2 * digits))
        .take_while(|digits| !may_be_0 || *digits <= MOST_DIGITS_OF_TURNS)
        .map(|digits| cos_tilt(toss, digits))
        .find(has_enough)
}

/// Whether cos θ = 0 exactly at landing.
fn is_tie(toss: &CoinToss) -> bool {
    // Digits do not matter here: what is 0 is 0 in any number of them.
    const DIGITS: usize = 80;
    let ([m_x, m_y, m_z], _) = toss.launch.attitude().vertical_in_digits(DIGITS);
    if m_z != Big::ZERO {
        // At a phase of 0, cos θ = mz. Without B and C, either Ω = 0 and cos θ = mz too, or m is along L, where A = 0
        // needs Lz = 0 and with it mz = 0.
        return false;
    }
    let (rate, _) = toss.launch.given_rate();
    let landed_at_once = !toss.launch.time_of_flight().is_positive();
    let precesses = rate.x != 0.0 || rate.y != 0.0;
    let level_momentum = rate.z == 0.0 || toss.coin.inertia_ratio_in_digits(DIGITS) == Big::ZERO;
    landed_at_once || !precesses || (level_momentum && m_x * exactly(rate.y) == m_y * exactly(rate.x))
}

/// A ball of `digits` binary digits with cos θ at landing.
pub(crate) fn cos_tilt(toss: &CoinToss, digits: usize) -> WideBall {
    let (time, vertical) = in_digits(&toss.launch, digits);
    cos_tilt_in(toss, &time, vertical, right_to_roundings(toss.coin.inertia_ratio_in_digits(digits), digits))
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Coin, Launch, TimeOfFlight, Unit};
    use nalgebra::Vector3;

    use super::*;
    use crate::certified::{certify_coin, cos_tilt as landed_cos_tilt};
    use crate::motion::CoinMotion;

    fn toss(coin: Coin, rate: [f64; 3], attitude: Attitude, time: f64) -> CoinToss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        CoinToss { coin, launch: launch.with_attitude(attitude) }
    }

    #[test]
    fn balls_of_few_digits_contain_cos_theta_of_more() {
        let coins = [Coin::from_moments(1.0, 0.7).unwrap(), Coin::from_cylinder(0.003, 0.01874, 0.00114).unwrap()];
        let attitudes = [Attitude::from_components([0.3, -0.7, 0.5, 0.4]).unwrap(), Attitude::about_x(2.5)];
        for (coin, attitude) in coins.into_iter().zip(attitudes) {
            for time in [1.0, 1e15] {
                let toss = toss(coin, [1.0, -2.0, 3.0], attitude, time);
                for digits in [192, 384] {
                    let (rough, fine) = (cos_tilt(&toss, digits), cos_tilt(&toss, 2 * digits));
                    let difference = (rough.midpoint() - fine.midpoint()).to_f64().value().abs();
                    assert!(difference <= rough.error(), "{digits}, {time}");
                    // And the radius is what the phase's loss of digits makes of the last ones.
                    assert!(rough.is_right_to(2f64.powi(90 - i32::try_from(digits).unwrap())), "{digits}, {time}");
                    let exact = CoinMotion::new(&toss).cos_tilt(time).unwrap();
                    assert!((Elementary::to_f64(&fine) - exact).abs() < 1e-15, "{digits}, {time}");
                }
            }
        }
    }

    fn degrees(value: f64) -> Attitude {
        Attitude::about_x(Unit::DEGREE.times(value))
    }

    #[test]
    fn a_coin_on_edge_ties_in_degrees_and_never_in_radians() {
        let landed = |rate, attitude, time| {
            let toss = toss(Coin::DISC, rate, attitude, time);
            (certify_coin(&toss).unwrap().outcome(), landed_cos_tilt(&toss).unwrap())
        };
        let rad = std::f64::consts::FRAC_PI_2;
        for (rate, time) in [([1.0, 2.0, 3.0], 0.0), ([0.0, 0.0, 7.0], 1.0), ([0.0; 3], 1.0), ([0.0, 7.0, 0.0], 1.0)] {
            for edge in [90.0, -90.0, 270.0, 36_090.0] {
                assert_eq!(landed(rate, degrees(edge), time), (Outcome::Undecided, 0.0), "{rate:?} {edge}");
            }
            let (outcome, cos_tilt) = landed(rate, Attitude::about_x(rad), time);
            // cos of the f64 next to π/2, as S is level and upright.
            assert_eq!(outcome, Outcome::Heads, "{rate:?}");
            assert!(cos_tilt > 0.0 && cos_tilt <= 6.123_233_995_736_766e-17, "{rate:?}: {cos_tilt:e}");
        }
        assert_eq!(landed([0.0, 7.0, 3.0], degrees(90.0), 1.0).0, Outcome::Heads);
    }

    #[test]
    fn cos_theta_keeps_its_sign_below_the_range_of_f64() {
        let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
        for (rate, outcome) in [(1e-300, Outcome::Tails), (-1e-300, Outcome::Heads)] {
            let toss = toss(Coin::DISC, [rate, 7.0, 0.0], edge, 1e-300);
            assert_eq!(certify_coin(&toss).unwrap().outcome(), outcome);
            assert_eq!(landed_cos_tilt(&toss), Ok(-rate.signum() * 5e-324));
        }
    }

    #[test]
    fn rates_in_turns_tie_at_quarters_of_a_turn_and_nowhere_near_them() {
        let turns = Unit::TURN;
        for (rate, time, outcome) in [
            (1.0, 0.25, Outcome::Undecided),
            (1.0, 0.25f64.next_up(), Outcome::Tails),
            (1f64.next_down(), 0.25, Outcome::Heads),
            (38.0, 38.75 / 38.0, Outcome::Tails),
            (40.0, 0.993_75, Outcome::Heads),
            (1024.0, 1024.75 / 1024.0, Outcome::Undecided),
        ] {
            let launch = Launch::in_unit(Vector3::new(rate, 0.0, 0.0), turns, TimeOfFlight::Given(time)).unwrap();
            let toss = CoinToss { coin: Coin::DISC, launch };
            assert_eq!(certify_coin(&toss).unwrap().outcome(), outcome, "{rate} {time}");
            assert_eq!(Outcome::of(landed_cos_tilt(&toss).unwrap(), 0.0), outcome, "{rate} {time}");
        }
    }

    /// On edge to rounding, which side it is on is decided by what normalising the quaternion rounds.
    #[test]
    fn a_quaternion_of_any_norm_is_taken_as_it_is() {
        let mut normalised_differs = 0;
        for index in 0..300 {
            let part = |irrational: f64| (f64::from(index) * irrational).fract();
            let [w, y, z] = [1.0 + part(2f64.sqrt()), part(3f64.sqrt()), part(5f64.sqrt())];
            let x = (w * w + z * z - y * y).sqrt();
            let cos_tilt = |[w, x, y, z]: [Big; 4]| &w * &w + &z * &z - &x * &x - &y * &y;
            let outcome = |components: [f64; 4]| match cos_tilt(components.map(exactly)) {
                zero if zero == Big::ZERO => Outcome::Undecided,
                cos_tilt if cos_tilt > Big::ZERO => Outcome::Heads,
                _ => Outcome::Tails,
            };
            for size in [1.0, 2f64.powi(1000), 2f64.powi(-1000)] {
                let given = [w, x, y, z].map(|part| size * part);
                let attitude = Attitude::from_components(given).unwrap();
                let landed = certify_coin(&toss(Coin::DISC, [0.0; 3], attitude, 1.0)).unwrap().outcome();
                assert_eq!(landed, outcome(given), "{given:?}");
                normalised_differs += u32::from(landed != outcome(attitude.components()));
            }
        }
        assert!(normalised_differs > 100, "{normalised_differs}");
    }
}
