//! This file proves the outcomes of Keller's coin, which is thrown flat and without spin about its normal, and so turns
//! end over end: cos θ = cos(Ω T). A single cosine decides it, which makes this the cheapest stage of the proof.
//!
//! Ω = √(ωx² + ωy²), T is the time of flight and φ = Ω T the phase. With u = 2^-53 the rounded Ω is right to 2u, T and
//! the product to u each, and std's cosine to 2u. Hence |Δ cos θ| ≤ 2u + 4u φ, which [`keller_bound`] rounds up.
//! Source: J. B. Keller, Am. Math. Mon. 93 (1986), 191.

use dynamics::{Attitude, Outcome, Toss};
use numerics::UNIT_ROUNDOFF;

/// Error bound of cos φ at a rounded `phase` φ (rad).
#[inline]
pub(crate) fn keller_bound(phase: f64) -> f64 {
    (3.0 + 5.0 * phase) * UNIT_ROUNDOFF
}

/// The phase Ω T (rad) at landing, for a toss without spin from horizontal. `None` for any other toss, and if a square,
/// the time or the phase is outside the range in which the error bound holds.
#[inline]
pub(crate) fn keller_phase(toss: &Toss) -> Option<f64> {
    const SQUARES: std::ops::Range<f64> = 1e-200..1e200;
    const TIMES: std::ops::Range<f64> = 1e-100..1e100;
    const LONGEST: f64 = 1e15;
    let rate = toss.launch.rate();
    let squared = rate.x * rate.x + rate.y * rate.y;
    let time = toss.launch.flight_time();
    let is_kellers = rate.z == 0.0 && toss.launch.attitude() == Attitude::IDENTITY;
    if !(is_kellers && SQUARES.contains(&squared) && TIMES.contains(&time)) {
        return None;
    }
    Some(squared.sqrt() * time).filter(|phase| *phase < LONGEST)
}

/// The proven outcome of a toss with this [phase](keller_phase) (rad). `None` if |cos θ| is within its error bound.
#[inline]
pub(crate) fn keller_outcome(phase: f64) -> Option<Outcome> {
    const BEFORE_THE_FIRST_FLIP: f64 = std::f64::consts::FRAC_PI_2 * (1.0 - 1e-9);
    if phase < BEFORE_THE_FIRST_FLIP {
        return Some(Outcome::Heads);
    }
    match Outcome::of(phase.cos(), keller_bound(phase)) {
        Outcome::Undecided => None,
        decided => Some(decided),
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;
    use crate::certified::certify;
    use crate::motion::ExactMotion;
    use crate::multiprecision::by_multiprecision;

    fn toss(rate: [f64; 3], tilt: f64, time: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss { coin: Coin::DISC, launch: launch.with_tilt(tilt).unwrap() }
    }

    #[test]
    fn the_cosine_matches_the_exact_motion_within_its_bound() {
        let mut decided = 0;
        for index in 0..3000 {
            let part = |irrational: f64| 2.0 * (f64::from(index) * irrational).fract() - 1.0;
            let rate = [300.0 * part(2f64.sqrt()), 300.0 * part(3f64.sqrt()), 0.0];
            let toss = toss(rate, 0.0, 10f64.powf(3.0 * part(5f64.sqrt())));
            let phase = keller_phase(&toss).unwrap();
            let exact = ExactMotion::new(&toss).cos_tilt(toss.launch.time_of_flight()).unwrap();
            assert!((phase.cos() - exact).abs() <= keller_bound(phase) + 2.0 * UNIT_ROUNDOFF);
            let Some(outcome) = keller_outcome(phase) else { continue };
            decided += 1;
            assert_eq!(outcome, certify(&toss).unwrap().outcome());
        }
        assert!(decided > 2990, "{decided}");
    }

    /// 40 neighbouring times around each of 200 landings on edge.
    #[test]
    fn near_an_edge_it_decides_rightly_or_not_at_all() {
        let mut undecided = 0;
        for quarter in 0..200 {
            let time = (f64::from(quarter) + 0.5) * std::f64::consts::PI / 7.0;
            for ulps in 0..40_u64 {
                let toss = toss([7.0, 0.0, 0.0], 0.0, f64::from_bits(time.to_bits() - 20 + ulps));
                match keller_outcome(keller_phase(&toss).unwrap()) {
                    Some(outcome) => assert_eq!(outcome, by_multiprecision(&toss), "{toss:?}"),
                    None => undecided += 1,
                }
            }
        }
        assert!(undecided > 100, "{undecided}");
    }

    #[test]
    fn rejects_a_launch_that_spins_is_tilted_or_leaves_the_range() {
        for other in [
            toss([7.0, 1.0, 1e-9], 0.0, 1.0),
            toss([7.0, 1.0, 0.0], 1e-9, 1.0),
            toss([0.0; 3], 0.0, 1.0),
            toss([1e-150, 0.0, 0.0], 0.0, 1.0),
            toss([7.0, 1.0, 0.0], 0.0, 1e-200),
            toss([7.0, 1.0, 0.0], 0.0, 1e30),
        ] {
            assert_eq!(keller_phase(&other), None, "{other:?}");
        }
    }

    #[test]
    fn the_bound_is_that_of_the_derivation_and_phases_stay_below_10_to_the_15() {
        assert_eq!([0.0, 2.0].map(keller_bound), [3.0 * UNIT_ROUNDOFF, 13.0 * UNIT_ROUNDOFF]);
        assert_eq!(keller_phase(&toss([1.0, 0.0, 0.0], 0.0, 0.99e15)), Some(0.99e15));
        assert_eq!(keller_phase(&toss([1.0, 0.0, 0.0], 0.0, 1e15)), None);
    }
}
