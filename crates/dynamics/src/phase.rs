//! How far a body turns in its flight, and by how much a disturbance of its rate grows. Error estimates grow with both, and
//! above 2^53 rad no answer means anything: the phases of neighbouring f64 inputs are a radian or more apart there. Every
//! solver refuses such a toss by [`require_phase`].
//!
//! # A coin
//! It turns by ωL T in its precession about the angular momentum S, and by |q| T in its spin within the body frame, with
//! ωL = |S|/I1, q = (k - 1) ωz and the time of flight T; see the symbols of the [crate]. The spin counts too, because a rod
//! (k = 0) in pure spin has ωL = 0 and still accumulates errors. A disturbance grows no more than in any steady turn.
//!
//! # Any other body
//! The principal moments are I1 ≤ I2 ≤ I3, the rates about these axes ω1, ω2, ω3, and T is the time of flight. With
//! a = (I3 - I2)/I1, b = (I3 - I1)/I2 and c = (I2 - I1)/I3, none below 0, Euler's equations are
//!
//! ```text
//! ω1' = -a ω2 ω3,   ω2' = b ω3 ω1,   ω3' = -c ω1 ω2.
//! ```
//!
//! The moments fulfil a - b + c = abc, and so (ω1² + ω2² + ω3²)' = -2 abc ω1 ω2 ω3, while (ω2²)' = 2 b ω1 ω2 ω3.
//! Therefore |ω|² + ac ω2² is conserved, |ω| never exceeds √(1 + ac) times its value at launch, and the body turns by no
//! more than √(1 + ac) |ω| T. No coupling of a body is above 1, which makes √2; but a may be as large as 2 where the
//! moments of a thin plate are rounded.
//!
//! A turn about the middle axis is unstable: next to it a disturbance grows like exp(√(ac) |ω| t). Whatever the motion,
//! it never grows faster than the rate that belongs to the largest |ω|. After some turns another limit holds. The rate
//! is a periodic function of the time, whose period is that of elliptic functions with the complementary parameter m',
//! the distance from the separatrix on a scale of 0 to 1. A relative disturbance δ of the rate changes m' by a few δ,
//! and the period, -ln m' and a constant, by a few δ/m'. From then on the error grows with the phase like that of a
//! steady turn, 1/m' times as fast.

use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;

use crate::body::{Body, RigidBody};
use crate::body_rate::body_precession_rate;
use crate::error::SolveError;
use crate::toss::Toss;

/// The largest phase that solvers accept (rad), 2^53. Above it, neighbouring f64 numbers differ by 2 or more.
pub const LARGEST_PHASE: f64 = 9_007_199_254_740_992.0;

/// Returns `phase` (rad) if it is at most [`LARGEST_PHASE`].
#[inline]
pub fn require_phase(phase: f64) -> Result<f64, SolveError> {
    if phase <= LARGEST_PHASE { Ok(phase) } else { Err(SolveError::PhaseTooLarge { phase }) }
}

/// How far a body turns until it lands, and how a disturbance grows, in f64 with an error of some roundings. Integrators
/// and error estimates need no more; the exact motion computes its phases in twice the precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phases {
    /// The phase (rad) by which errors grow: of a coin the larger one of ωL T and |q| T, of another body an upper bound of
    /// the angle through which it turns, √2 |ω| T, or √(1 + ac) |ω| T where that is more.
    pub largest: f64,
    /// How many times as much as in a steady turn a disturbance grows, at least 1; infinite above the range of f64.
    pub growth: f64,
}

impl Phases {
    /// Those of the flight of `toss`.
    #[inline]
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        let launched = toss.launch.rate();
        let scale = power_of_two_scale(launched.amax());
        let rate = launched / scale;
        let largest = largest(&toss.body, &rate, toss.launch.flight_time() * scale)?;
        let growth = if let Body::Rigid(body) = &toss.body { growth(body, &rate, largest) } else { 1.0 };
        Ok(Self { largest, growth })
    }
}

/// The [largest](Phases::largest) phase (rad) after a dimensionless `time` at a dimensionless `rate` (BF) at launch.
#[inline]
pub(crate) fn largest(body: &Body, rate: &Vector3<f64>, time: f64) -> Result<f64, SolveError> {
    // Without a rate the phase is 0, also where the product would be 0 · ∞ = NaN.
    let turned = |rate: f64| if rate == 0.0 { 0.0 } else { rate * time };
    require_phase(match body {
        Body::Coin(coin) => {
            let k = coin.inertia_ratio();
            let momentum = Vector3::new(rate.x, rate.y, k * rate.z).norm();
            turned(momentum).max(turned(body_precession_rate(k, rate.z).abs()))
        }
        Body::Rigid(body) => turned(body.largest_growth_of_rate() * rate.norm()),
    })
}

/// The [growth](Phases::growth) of a disturbance of a body that turns by `angle` (rad) at most.
fn growth(body: &RigidBody, rate: &Vector3<f64>, angle: f64) -> f64 {
    let [a, _, c] = body.couplings();
    let fastest = ((a * c).abs().sqrt() * angle).exp();
    // Of a body at rest or with equal moments the distance is not a number, and the first limit is 1.
    fastest.min(1.0 + 1.0 / from_separatrix(body.couplings(), body.principal().rates(rate)))
}

/// The complementary parameter m' of the elliptic functions, which is 0 on the separatrix and 1 for a steady turn about
/// the first or the third axis.
fn from_separatrix(couplings: [f64; 3], rates: [f64; 3]) -> f64 {
    let [a, b, c] = couplings.map(f64::abs);
    let [first, second, third] = rates.map(|rate| rate * rate);
    let side = a * third - c * first;
    let about_axis = if side > 0.0 { a * (c * second + b * third) } else { c * (a * second + b * first) };
    b * side.abs() / about_axis
}

#[cfg(test)]
mod tests {
    use std::f64::consts::SQRT_2;

    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    fn of_body(body: impl Into<Body>, rate: [f64; 3], time: f64) -> Result<Phases, SolveError> {
        Phases::new(&Toss::new(body, Launch::new(rate, TimeOfFlight::Given(time)).unwrap()))
    }

    fn of_coin(k: f64, rate: [f64; 3], time: f64) -> Result<f64, SolveError> {
        let phases = of_body(Coin::from_moments(1.0, k).unwrap(), rate, time)?;
        assert_eq!(phases.growth, 1.0);
        Ok(phases.largest)
    }

    fn phases(moments: [f64; 3], rate: [f64; 3], time: f64) -> Result<Phases, SolveError> {
        of_body(Body::from_moments(moments).unwrap(), rate, time)
    }

    #[test]
    fn a_coin_turns_by_the_larger_one_of_precession_and_spin() {
        assert_eq!(of_coin(0.5, [30.0, 0.0, -80.0], 2.0), Ok(100.0));
        assert_eq!(of_coin(0.0, [3.0, 0.0, -80.0], 2.0), Ok(160.0));
        assert_eq!(of_coin(1.5, [0.0; 3], 1e300), Ok(0.0));
    }

    #[test]
    fn phases_above_two_to_the_53_are_refused() {
        assert_eq!(require_phase(LARGEST_PHASE), Ok(LARGEST_PHASE));
        for phase in [LARGEST_PHASE.next_up(), f64::INFINITY, f64::NAN] {
            assert!(matches!(require_phase(phase), Err(SolveError::PhaseTooLarge { .. })), "{phase}");
        }
        assert!(of_coin(1.0, [1.0, 0.0, 0.0], 1e16).is_err());
        assert_eq!(of_coin(0.0, [0.0, 0.0, 1e300], 1e300), Err(SolveError::PhaseTooLarge { phase: f64::INFINITY }));
    }

    #[test]
    fn the_angle_is_bounded_and_limited_as_the_phase_of_a_coin_is() {
        assert_eq!(phases([1.0, 2.0, 2.5], [3.0, 0.0, 4.0], 2.0).unwrap().largest, SQRT_2 * 10.0);
        assert_eq!(phases([1.0, 2.0, 2.5], [0.0; 3], 1e300), Ok(Phases { largest: 0.0, growth: 1.0 }));
        for (rate, time) in [(1.0, 1e16), (1e300, 1e300)] {
            let error = phases([1.0, 2.0, 2.5], [rate, 0.0, 0.0], time).unwrap_err();
            assert_eq!(error.kind(), "phase_too_large");
        }
    }

    /// 1.2e-16 + 1 is rounded to 1 + 2^-52: a = 1.85 and c = 1. From a turn about the middle axis |ω| grows to √(κ1 + κ3) =
    /// √(1 + ac) on the separatrix, where ω2 is 0.
    #[test]
    fn the_angle_of_a_plate_as_thin_as_rounding_is_bounded_by_its_own_couplings() {
        let moments = [1.2e-16, 1.0, 1.000_000_000_000_000_2];
        let growth = (1.0 + f64::EPSILON / 1.2e-16).sqrt();
        let found = phases(moments, [0.0, 1.0, 0.0], 2.0).unwrap().largest;
        assert!((found - 2.0 * growth).abs() < 1e-12 && growth > 1.68, "{found}");
        let [a, _, c] = Body::from_moments(moments).unwrap().rigid().couplings().map(f64::abs);
        let b = (a + c) / (1.0 + a * c);
        assert!((found / 2.0 - (a / b + c / b).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_disturbance_grows_next_to_the_separatrix_alone() {
        let growth = |rate| phases([1.0, 2.0, 2.25], rate, 1e3).unwrap().growth;
        assert_eq!(growth([1.0, 0.0, 0.0]), 2.0);
        assert_eq!(growth([0.0, 0.0, 1.0]), 2.0);
        // By ω1 = 3/4 ω3 ± d it is about 1/d.
        for distance in [1e-3, 1e-6, -1e-6, 1e-9] {
            let found = growth([0.75 + distance, 1.0, 1.0]) * distance.abs();
            assert!((0.1..10.0).contains(&found), "{distance}: {found}");
        }
        assert!(growth([0.75, 1.0, 1.0]) > 1e200 && growth([0.0, 1.0, 0.0]) > 1e200);
        let short = phases([1.0, 2.0, 2.25], [0.0, 1.0, 0.0], 1.0).unwrap();
        assert!((short.growth - (SQRT_2 * (0.25 / 2.25_f64).sqrt()).exp()).abs() < 1e-12);
    }

    /// With two equal moments nothing grows, whatever the rate.
    #[test]
    fn nothing_grows_in_a_symmetric_body() {
        for moments in [[2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [0.0, 1.0, 1.0], [3.0, 2.0, 2.0]] {
            for rate in [[1.0, 2.0, 3.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                assert_eq!(phases(moments, rate, 1e6).unwrap().growth, 1.0, "{moments:?}, {rate:?}");
            }
        }
    }
}
