//! The derivatives of the landing of any rigid body with respect to its launch, by evaluating the motion in numbers
//! with a derivative. Next to the separatrix they are huge: one ulp of a rate moves a flight off it by radians.
//!
//! Values and derivatives are balls. The radius of a derivative tells how many digits it has lost, as next to the
//! separatrix; more digits are taken until enough are left.

use dynamics::{Launch, SolveError, Toss};
use nalgebra::{Matrix3x4, Vector3, Vector4};
use numerics::{Elementary, Jet};

use super::given::Given;
use super::quaternion::{Quaternion, conjugate, norm_squared, product};
use super::special::Special;
use super::{ExactMotion, cos_tilt};
use crate::sensitivity::Sensitivity;

/// Relative error of a derivative.
const RELATIVE: f64 = 1.421_085_471_520_200_4e-14; // 2^-46

/// Digits of the stages after double-double.
const DIGITS: [usize; 3] = [320, 960, 3840];

/// Parts of the largest component of the rate below which balls of so many digits lose the derivatives, and the phase (rad)
/// up to which the derivatives are those without such a component: it grows by less than e^300.
const VANISHING: f64 = 1.499_696_813_895_631_2e-241; // 2^-800
const LARGEST_PHASE_WITHOUT: f64 = 300.0;

/// Part of the turn that a derivative of cos θ is above, or it may be 0.
const NO_SLOPE: f64 = 1e-60;

/// Turns (rad) below which a change δω of the rate turns the landing by T δω, to this relative error.
const SHORT: f64 = 1e-14;

/// A turn (BF at landing) and a change of cos θ.
type Change<N> = ([N; 3], N);

impl Sensitivity {
    /// The derivatives at the landing of `toss`. Of a body that is not a coin, each column of the attitude, and each derivative of cos θ by a
    /// rate, is right to 1e-13 of itself; a derivative of cos θ below 1e-60 of the column may be 0. Fails with
    /// [`SolveError::PhaseTooLarge`]; [`SolveError::NotFinite`] where a derivative leaves the range of f64, and of
    /// turns above 300 rad with a component of the rate below 1e-241 of the largest.
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        if let Some(toss) = toss.coin() {
            return Self::of_coin(&toss);
        }
        let (motion, at) = (ExactMotion::new(toss), toss.launch.time_of_flight());
        let landing = motion.state(at)?;
        if let Some(without) = without_vanishing(toss) {
            if motion.phase(at)? > LARGEST_PHASE_WITHOUT {
                return Err(SolveError::NotFinite { time: at.seconds() });
            }
            return Self::new(&without);
        }
        let up = landing.attitude.lab_to_body(&Vector3::z());
        let hardly_turns = motion.phase(at)? < SHORT;
        let found = if hardly_turns { Some((changes_of_rest(toss, &up), 1.0)) } else { changes(toss) };
        let (changes, unit) = found.ok_or(SolveError::NotFinite { time: at.seconds() })?;
        let (mut attitude, mut slopes) = (Matrix3x4::zeros(), Vector4::zeros());
        for (input, (turn, slope)) in changes.into_iter().enumerate() {
            attitude.set_column(input, &(Vector3::from(turn) / unit));
            slopes[input] = slope / unit;
        }
        attitude.set_column(3, &landing.rate);
        slopes[3] = Vector3::z().cross(&up).dot(&landing.rate);
        let is_finite = attitude.iter().chain(&slopes).all(|part| part.is_finite());
        if is_finite {
            Ok(Self { attitude, cos_tilt: slopes })
        } else {
            Err(SolveError::NotFinite { time: at.seconds() })
        }
    }
}

/// The toss without the components of its rate that vanish next to the largest; `None` if it has none.
fn without_vanishing(toss: &Toss) -> Option<Toss> {
    let (rate, unit) = toss.launch.given_rate();
    let vanishes = |part: f64| part != 0.0 && (part / rate.amax()).abs() < VANISHING;
    if !rate.iter().any(|part| vanishes(*part)) {
        return None;
    }
    let rest = rate.map(|part| if vanishes(part) { 0.0 } else { part });
    let launch = Launch::in_unit(rest, unit, toss.launch.time_of_flight()).ok()?;
    Some(Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}

/// The changes of the landing with each component of the rate, and the unit (rad/s) of these: by as many digits as it takes.
fn changes(toss: &Toss) -> Option<([Change<f64>; 3], f64)> {
    // A spin and the separatrix are left when the rate changes.
    let is_kept = |special: &Special| matches!(special, Special::Symmetric(_));
    let symmetric = Special::at_sight(toss).filter(is_kept);
    let fine = Given::in_double_double(toss, None);
    if let Some(found) = changes_in(&fine, symmetric).filter(|found| are_right(found, 0.0)) {
        return Some((in_f64(&found), 2f64.powi(fine.exponent)));
    }
    // Next to a spin a derivative may be as small as what is next to it; of a spin it is 0 then.
    let spins = Special::of(toss) == Some(Special::Spin);
    DIGITS.into_iter().find_map(|digits| {
        let given = Given::in_digits(toss, None, digits);
        let none_above = if spins || digits == DIGITS[2] { NO_SLOPE } else { 0.0 };
        let found = changes_in(&given, symmetric).filter(|found| are_right(found, none_above))?;
        Some((in_f64(&found), given.unit.times_power_of_two(given.exponent).to_f64()))
    })
}

/// The changes in one kind of number, of a motion that may be a `special` one; `None` if it has too few digits.
fn changes_in<N: Elementary>(given: &Given<N>, special: Option<Special>) -> Option<[Change<N>; 3]> {
    let mut inputs = given.map(|part| Jet::<N, 4>::constant(part.clone()));
    for (index, part) in given.rate.iter().enumerate() {
        inputs.rate[index] = Jet::variable(part.clone(), part.like(1.0), index);
    }
    Some(changes_of_turn(&inputs.turn(special)?, &inputs.vertical))
}

/// The changes that a turn with its derivatives by the rates makes.
fn changes_of_turn<N: Elementary>(turn: &Quaternion<Jet<N, 4>>, vertical: &[Jet<N, 4>; 3]) -> [Change<N>; 3] {
    let slopes = cos_tilt(turn, vertical);
    let values = turn.each_ref().map(|part| part.value().clone());
    let size = norm_squared(&values);
    let change = |input: usize| {
        let rises = turn.each_ref().map(|part| part.slopes()[input].clone());
        let [_, x, y, z] = product(&conjugate(&values), &rises).map(|part| (part.clone() + part) / size.clone());
        ([x, y, z], slopes.slopes()[input].clone())
    };
    [0, 1, 2].map(change)
}

/// Whether the radii leave enough digits, where a change of cos θ below the part `none_above` of the turn
/// counts as 0.
fn are_right<N: Elementary>(changes: &[Change<N>; 3], none_above: f64) -> bool {
    let is_right = |part: &N, size: f64, least: f64| part.error() <= (RELATIVE * size).max(least);
    changes.iter().all(|(turn, slope)| {
        let size = turn.iter().map(|part| part.to_f64().abs()).fold(0.0, f64::max);
        let is_known = is_right(slope, slope.to_f64().abs(), none_above * size);
        is_known && turn.iter().all(|part| is_right(part, size, 0.0))
    })
}

/// The midpoints; 0 for what might be.
fn in_f64<N: Elementary>(changes: &[Change<N>; 3]) -> [Change<f64>; 3] {
    let rounded = |part: &N| if part.has_known_sign() { part.to_f64() } else { 0.0 };
    changes.each_ref().map(|(turn, slope)| (turn.each_ref().map(N::to_f64), rounded(slope)))
}

/// The changes of a body at rest, or of one that has hardly turned yet, by a rate of 1 rad/s: it is turned by that times the time.
/// `up` is the vertical (BF) at landing.
fn changes_of_rest(toss: &Toss, up: &Vector3<f64>) -> [Change<f64>; 3] {
    [0, 1, 2].map(|input| {
        let turn = Vector3::ith(input, toss.launch.flight_time());
        (turn.into(), Vector3::z().cross(up).dot(&turn))
    })
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, TimeOfFlight};

    use super::*;

    #[test]
    fn derivatives_match_central_differences_of_the_exact_motion_in_every_regime() {
        const STEP: f64 = 1e-5;
        let moments = [
            ([1.0, 2.0, 2.5], 3e-8),
            ([2.5, 1.0, 2.0], 3e-8),
            ([1.0, 2.0, 2.25], 3e-8),
            ([1.0, 2.0, 2.0], 3e-8),
            ([1.0, 2.5, 2.0], 3e-8),
            ([2.0, 1.0, 2.5], 3e-8),
            ([1.0, 1.0, 1.3], 1e-8),
        ];
        let rates = [
            [0.5, -1.25, 2.0],
            [2.0, 0.5, -0.75],
            [0.75, 1.0, 1.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, -1.0],
            [2.0, 0.0, 0.0],
            [0.0; 3],
        ];
        let bodies = moments.into_iter().flat_map(|body| rates.map(|rate| (body, rate)));
        let cases = bodies.flat_map(|(body, rate)| [0.0, 0.6, 2.0, -1.1].map(|tilt| (body, rate, tilt)));
        for ((moments, error), rate, tilt) in cases {
            let toss = |change: Vector4<f64>| {
                let [x, y, z] = rate;
                let rate = Vector3::new(x + change.x, y + change.y, z + change.z);
                let launch = Launch::new(rate, TimeOfFlight::Given(1.7 + change.w)).unwrap().with_tilt(tilt).unwrap();
                Toss { body: Body::from_moments(moments).unwrap(), launch }
            };
            let landing = |change: Vector4<f64>| {
                let toss = toss(change);
                ExactMotion::new(&toss).state(toss.launch.time_of_flight()).unwrap().attitude
            };
            let found = Sensitivity::new(&toss(Vector4::zeros())).unwrap();
            for input in 0..4 {
                let step = Vector4::ith(input, STEP);
                let (before, after) = (landing(-step), landing(step));
                let [w, x, y, z] = (before.inverse() * after).components();
                let turn = Vector3::new(x, y, z) * (w.signum() / STEP);
                let off = (found.attitude.column(input) - turn).norm();
                assert!(off < error, "{moments:?} {rate:?} {tilt} {input}: {off:e}");
                let slope = (after.cos_tilt() - before.cos_tilt()) / (2.0 * STEP);
                let off = (found.cos_tilt[input] - slope).abs();
                assert!(off < error, "{moments:?} {rate:?} {tilt} {input}: {off:e}");
            }
        }
    }

    /// By differences of the Taylor series of the equations of motion in 240 digits.
    #[test]
    fn derivatives_keep_their_digits_for_components_of_any_ratio() {
        #[rustfmt::skip]
        let cases = [
            ([1.0, 2.0, 3.0], [1e-30, 5.0, 0.0], 0.0, 1.0, [7.514291607640379e-31, 0.9589242746631385, -1.578252002491573e-30]),
            ([1.0, 2.0, 3.0], [1e-16, 5.0, 0.0], 0.3, 1.0, [-0.4292404809797739, 0.916095349894001, 0.7723442658266834]),
            ([1.0, 2.0, 3.0], [1e-20, 5.0, 1e-25], 0.3, 2.0, [-8.216086367949599, 1.039446436174525, 14.333189472141502]),
            ([1.0, 3.0, 2.0], [5.0, 1e-30, -1e-28], 0.3, 2.0, [1.5353716195271638, -2.704447070874085e-29, -1.0392538452018462e-28]),
            ([1.0, 2.0, 2.5], [2.0, 1e-40, 0.001], 0.5, 2.0, [1.9550577666137408, -0.0014670239518761131, 0.0010663929351104168]),
            ([3.0, 1.0, 2.0], [0.0, 0.0, 5.0], 0.7, 3.0, [-607.0297777800084, 350.5332232818621, 0.0]),
            ([3.0, 1.0, 2.0], [0.0, -4.0, 0.0], 0.7, 3.0, [0.5946742628307183, -1.2311808127232196, 0.014419191837199198]),
        ];
        for (moments, rate, tilt, time, expected) in cases {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
            let toss = Toss { body: Body::from_moments(moments).unwrap(), launch };
            let found = Sensitivity::new(&toss).unwrap().cos_tilt;
            for (found, expected) in found.iter().zip(expected) {
                let off = (found - expected).abs();
                assert!(off <= 1e-13 * expected.abs(), "{moments:?} {rate:?} {tilt}: {found:e}, not {expected:e}");
            }
        }
    }

    /// Components that are too small for a ball leave the derivatives of the motion without them.
    #[test]
    fn derivatives_of_vanishing_components_are_those_of_the_motion_without_them() {
        let of = |rate: [f64; 3], time: f64| {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(0.3).unwrap();
            Sensitivity::new(&Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch })
        };
        for tiny in [1e-140, 1e-200, 1e-245, 1e-260, 1e-320] {
            for (rate, without) in [
                ([tiny, 5.0, -tiny], [0.0, 5.0, 0.0]),
                ([3.0, tiny, tiny], [3.0, 0.0, 0.0]),
                ([3.0, tiny, 2.0], [3.0, 0.0, 2.0]),
                ([tiny, 1.0, 2.0], [0.0, 1.0, 2.0]),
            ] {
                let [found, expected] = [of(rate, 1.7).unwrap(), of(without, 1.7).unwrap()];
                let off = (found.attitude - expected.attitude).norm() + (found.cos_tilt - expected.cos_tilt).norm();
                assert!(off < 1e-13, "{rate:?}: {found:?} {expected:?}");
            }
        }
        // A derivative by a rate is about the time.
        let shortest = of([13.0, -2e-185, 8e-320], 8e-320).unwrap();
        assert!((0..3).all(|axis| shortest.attitude[(axis, axis)] == 8e-320), "{shortest:?}");
        // By 1e-200 beside the middle axis, the motion is another one after 577 e-folds.
        let launch = Launch::new([1e-200, 5.0, 0.0], TimeOfFlight::Given(1000.0)).unwrap();
        let toss = Toss { body: Body::from_moments([1.0, 2.0, 3.0]).unwrap(), launch };
        let grown = Sensitivity::new(&toss).unwrap();
        // cos θ changes with the square of what has grown.
        let (column, slope) = (grown.attitude.column(0).norm(), grown.cos_tilt.x);
        assert!(column > 1e40 && (0.01..1.0).contains(&(slope / (column * column * 1e-200))), "{grown:?}");
        // Next to the middle axis, what is so small grows in 10^3 rad to a motion that is not that without it.
        assert_eq!(of([1e-320, 5.0, 0.0], 1000.0).unwrap_err().kind(), "not_finite");
    }
}
