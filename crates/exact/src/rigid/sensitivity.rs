//! The derivatives of the landing of any rigid body with respect to its launch, by evaluating the motion in numbers
//! with a derivative. Next to the separatrix they are huge: one ulp of a rate moves a flight off it by radians.

use dynamics::{RigidToss, SolveError};
use nalgebra::{Matrix3x4, Vector3, Vector4};
use numerics::big::exactly;
use numerics::{DoubleDouble, Dual, Elementary};

use super::curve::Curve;
use super::quaternion::{conjugate, norm_squared, product};
use super::{MANY_DIGITS, RigidMotion, cos_tilt, scaled};
use crate::sensitivity::Sensitivity;

/// How far, in units of the largest component, a launch is moved off the motions that have a form of their own. Their
/// derivatives across are those of the motions around them, which differ by this times the second derivatives.
const ASIDE: f64 = 7.888_609_052_210_118e-31; // 2^-100

/// A turn (BF at landing) and a change of cos θ.
type Change = (Vector3<f64>, f64);

impl Sensitivity {
    /// The derivatives at the landing of a toss of any body.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`]; [`SolveError::NotFinite`] where a derivative leaves the range of f64, as that of a time
    /// below 1e-308 s.
    pub fn of_rigid(toss: &RigidToss) -> Result<Self, SolveError> {
        if let Some(toss) = toss.symmetric() {
            return Self::new(&toss);
        }
        let (motion, at) = (RigidMotion::new(toss), toss.launch.time_of_flight());
        let landing = motion.state(at)?;
        let (time, unit) = motion.time_and_unit(at.into())?;
        let many = exactly(0.0).with_precision(MANY_DIGITS).value();
        let changes = changes(toss, &time).or_else(|| changes(toss, &many.like_big(&time.to_big())));
        let (mut attitude, mut slopes) = (Matrix3x4::zeros(), Vector4::zeros());
        // In many digits there is a regime, so that none is missing.
        let changes = changes.ok_or(SolveError::NotFinite { time: at.seconds() })?;
        for (input, (turn, slope)) in changes.into_iter().enumerate() {
            attitude.set_column(input, &(turn / unit));
            slopes[input] = slope / unit;
        }
        attitude.set_column(3, &landing.rate);
        let up = landing.attitude.lab_to_body(&Vector3::z());
        slopes[3] = Vector3::z().cross(&up).dot(&landing.rate);
        let is_finite = attitude.iter().chain(&slopes).all(|part| part.is_finite());
        if is_finite {
            Ok(Self { attitude, cos_tilt: slopes })
        } else {
            Err(SolveError::NotFinite { time: at.seconds() })
        }
    }
}

/// The changes of the landing with each component of the rate, in the unit of the curve. `None` if the numbers have too
/// few digits.
fn changes<N: Elementary>(toss: &RigidToss, time: &N) -> Option<[Change; 3]> {
    let (given, _) = toss.launch.given_rate();
    let rate = scaled(&given, time);
    if given == Vector3::zeros() {
        // A body at rest is turned by the change of its rate times the time.
        let [x, y, _] = toss.launch.attitude().exact_vertical().map(DoubleDouble::hi);
        let time = toss.launch.flight_time();
        let changes = [(Vector3::x(), -y), (Vector3::y(), x), (Vector3::z(), 0.0)];
        return Some(changes.map(|(axis, slope)| (axis * time, slope * time)));
    }
    let special = Curve::new(&toss.body, &rate)?.is_special();
    // So near a special motion, the period and the phase at launch have derivatives of 2^100 and more that cancel.
    if special && time.digits() < 400 {
        return None;
    }
    let aside = if special { [ASIDE, -0.7 * ASIDE, 0.6 * ASIDE] } else { [0.0; 3] };
    let vertical = toss.launch.attitude().exact_vertical().map(|part| Dual::constant(time.like_big(&part.to_big())));
    let mut changes = [(Vector3::zeros(), 0.0); 3];
    for (input, (turn_change, slope)) in changes.iter_mut().enumerate() {
        let mut inputs = [0, 1, 2].map(|axis: usize| Dual::constant(rate[axis].clone() + time.like(aside[axis])));
        inputs[input].slope = time.like(1.0);
        let turn = Curve::new(&toss.body, &inputs)?.turn(&Dual::constant(time.clone()));
        let [values, rises] = [turn.clone().map(|part| part.value), turn.clone().map(|part| part.slope)];
        let size = norm_squared(&values);
        let [_, x, y, z] = product(&conjugate(&values), &rises).map(|part| (part.clone() + part) / size.clone());
        *turn_change = Vector3::from([x, y, z].map(|part| part.to_f64()));
        *slope = cos_tilt(&turn, &vertical).slope.to_f64();
    }
    Some(changes)
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, Launch, TimeOfFlight};

    use super::*;

    #[test]
    fn derivatives_match_central_differences_of_the_exact_motion_in_every_regime() {
        const STEP: f64 = 1e-5;
        let bodies = [[1.0, 2.0, 2.5], [2.5, 1.0, 2.0], [1.0, 2.0, 2.25], [1.0, 2.0, 2.0]];
        let rates =
            [[0.5, -1.25, 2.0], [2.0, 0.5, -0.75], [0.75, 1.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0; 3]];
        for (moments, rate) in bodies.into_iter().flat_map(|moments| rates.map(|rate| (moments, rate))) {
            let toss = |change: Vector4<f64>| {
                let [x, y, z] = rate;
                let rate = Vector3::new(x + change.x, y + change.y, z + change.z);
                let launch = Launch::new(rate, TimeOfFlight::Given(1.7 + change.w)).unwrap().with_tilt(0.6).unwrap();
                RigidToss { body: Body::from_moments(moments).unwrap(), launch }
            };
            let landing = |change: Vector4<f64>| {
                let toss = toss(change);
                RigidMotion::new(&toss).state(toss.launch.time_of_flight()).unwrap().attitude
            };
            let found = Sensitivity::of_rigid(&toss(Vector4::zeros())).unwrap();
            for input in 0..4 {
                let step = Vector4::ith(input, STEP);
                let (before, after) = (landing(-step), landing(step));
                let [w, x, y, z] = (before.inverse() * after).components();
                let turn = Vector3::new(x, y, z) * (w.signum() / STEP);
                assert!(
                    (found.attitude.column(input) - turn).norm() < 3e-8,
                    "{moments:?} {rate:?} {input}: {found:?} {turn}"
                );
                let slope = (after.cos_tilt() - before.cos_tilt()) / (2.0 * STEP);
                assert!((found.cos_tilt[input] - slope).abs() < 3e-8, "{moments:?} {rate:?} {input}: {found:?}");
            }
        }
    }

    #[test]
    fn a_derivative_that_is_not_finite_is_an_error() {
        let launch = Launch::new(Vector3::new(13.0, -2e-185, 8e-320), TimeOfFlight::Given(8e-320)).unwrap();
        let toss = RigidToss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch };
        assert_eq!(Sensitivity::of_rigid(&toss).unwrap_err(), SolveError::NotFinite { time: 8e-320 });
    }

    /// One ulp of the rate, 1e-16, moves this flight off the separatrix by radians.
    #[test]
    fn the_derivative_next_to_the_separatrix_tells_that_an_ulp_counts() {
        let launch = Launch::new(Vector3::new(0.75, 1.0, 1.0), TimeOfFlight::Given(100.0)).unwrap();
        let toss = RigidToss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch };
        let found = Sensitivity::of_rigid(&toss).unwrap();
        assert!(found.attitude.column(0).norm() * f64::EPSILON > 1.0, "{found:?}");
    }
}
