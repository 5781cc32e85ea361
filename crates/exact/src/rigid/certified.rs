//! This file proves the outcome of the toss of any rigid body: the closed form is evaluated in [`Ball`]s, which contain
//! the true numbers, first in f64, then in double-double and then in more and more digits, until cos θ has a sign.
//!
//! The numbers as given are the moments or the tensor, the rates in their unit, the attitude, and the time or the
//! speed, gravity and drop. They are exact, or balls contain them. A body given by its moments takes elliptic functions
//! about its principal axes, whose formula the exact sign of E tells. One given by a tensor takes doubling in the frame of
//! the tensor, which has no cases.

use dynamics::{Error, Outcome, SolveError, Toss};
use numerics::{Ball, Elementary, WideBall};

use super::tensor_toss::{Landed, Question, climb, climb_from_double_double};
use super::{ExactMotion, TO_F64, cos_tilt};
use crate::certificate::{Certificate, ProvenCounts, Stage};
use crate::certified::{self, certify_coin};
use crate::given::{in_digits, in_double_double, rounded, scaled};
use crate::motion::{COS_TILT_ERROR, LARGEST_PHASE_IN_DOUBLE_DOUBLE};
use crate::multiprecision::has_digits_of_f64;
use crate::rigid::curve::Curve;

/// Digits of the stages after double-double. The last are for rates that differ by more than 1e135.
const DIGITS: [usize; 3] = [256, 448, 960];

/// Phases (rad) from which on f64 is not tried.
const LARGEST_PHASE_IN_F64: f64 = 1e12;

/// Error of cos θ in double-double at phases from [`LARGEST_PHASE_IN_DOUBLE_DOUBLE`] to 2^53 rad, 90 u² of the phase.
const ERROR_AT_LARGE_PHASES: f64 = 1e-14;

/// Proves the outcome of a toss.
///
/// An outcome is undecided, without a proof, if cos θ is 0 as far as 960 digits can tell, or 12 288 for a tensor. No ratio of
/// rates leaves it undecided, and no gap between two moments.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`] for a phase above 2^53 rad.
pub fn certify(toss: &Toss) -> Result<Certificate, SolveError> {
    if let Some(toss) = toss.coin() {
        return certify_coin(&toss);
    }
    if toss.body.moments().is_none() {
        return certify_tensor(toss);
    }
    if let Some(outcome) = by_f64(toss) {
        return Ok(Certificate::new(outcome, Stage::F64));
    }
    ExactMotion::new(toss).phase(toss.launch.time_of_flight())?;
    if let Some(outcome) = by_double_double(toss) {
        return Ok(Certificate::new(outcome, Stage::DoubleDouble));
    }
    let outcome = DIGITS.iter().find_map(|digits| by_digits(toss, *digits));
    let proven = |outcome| Certificate::new(outcome, Stage::Multiprecision);
    Ok(outcome.map_or_else(Certificate::without_proof, proven))
}

/// Proves the outcome of a body that was given by a tensor. Where the body does not move, exact arithmetic decides, and an
/// outcome that is undecided is a tie.
///
/// # Errors
/// As [`certify`].
fn certify_tensor(toss: &Toss) -> Result<Certificate, SolveError> {
    ExactMotion::new(toss).phase(toss.launch.time_of_flight())?;
    if let Some(sign) = sign_at_rest(toss) {
        return Ok(Certificate::new(Outcome::of(sign, 0.0), Stage::Multiprecision));
    }
    let found = climb(toss, &Sign);
    Ok(found.map_or_else(Certificate::without_proof, |(outcome, stage)| Certificate::new(outcome, stage)))
}

/// The sign of cos θ, by exact arithmetic, of a body that does not turn; `None` of one that does.
fn sign_at_rest(toss: &Toss) -> Option<f64> {
    let turns = toss.launch.rate().amax() > 0.0 && toss.launch.time_of_flight().is_positive();
    // Digits do not matter to the sign: what is 0 is 0 in any number of them.
    (!turns).then(|| Elementary::sign(&toss.launch.attitude().vertical_in_digits(DIGITS[0]).0[2]))
}

/// cos θ in the numbers of a landing.
fn cos_tilt_of<N: Elementary>(landed: &Landed<N>) -> N {
    cos_tilt(&landed.turn, &landed.given.vertical)
}

/// Which face is up.
struct Sign;

impl Question for Sign {
    type Answer = Outcome;

    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<Outcome> {
        let cos_tilt = cos_tilt_of(landed);
        (cos_tilt.sign() != 0.0 && cos_tilt.has_known_sign()).then(|| Outcome::of(cos_tilt.sign(), 0.0))
    }
}

/// cos θ to 2^-58 of itself.
struct Rounded;

impl Question for Rounded {
    type Answer = f64;

    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<f64> {
        let cos_tilt = cos_tilt_of(landed);
        let value = cos_tilt.to_f64();
        (cos_tilt.error() <= TO_F64 * value.abs() && value != 0.0).then_some(value)
    }
}

/// That |cos θ| is at most [`COS_TILT_ERROR`].
struct Near0;

impl Question for Near0 {
    type Answer = ();

    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<()> {
        (cos_tilt_of(landed).bound() <= COS_TILT_ERROR).then_some(())
    }
}

/// cos θ at landing and a bound of its error. cos θ has the sign of the proven outcome, and where an outcome is proven the
/// bound is smaller than |cos θ|: near 0, where f64 would lose the leading digits, cos θ is rounded from more digits. A body
/// of which the last number of digits does not give 58 bits of cos θ has 0.
///
/// # Errors
/// As [`certify`]; [`SolveError::NotFinite`] for a tensor of whose cos θ the last number of digits tells nothing.
pub(crate) fn cos_tilt_with_error(toss: &Toss) -> Result<(f64, f64), SolveError> {
    let rounded = |cos_tilt: f64| (cos_tilt, COS_TILT_ERROR.min(f64::EPSILON * cos_tilt.abs()));
    if let Some(toss) = toss.coin() {
        return certified::cos_tilt(&toss).map(|cos_tilt| match cos_tilt.abs() > COS_TILT_ERROR {
            true => (cos_tilt, COS_TILT_ERROR),
            false => rounded(cos_tilt),
        });
    }
    let (motion, time) = (ExactMotion::new(toss), toss.launch.time_of_flight());
    if toss.body.moments().is_none() {
        motion.phase(time)?;
        if sign_at_rest(toss) == Some(0.0) {
            return Ok((0.0, 0.0));
        }
        if let Some((cos_tilt, _)) = climb_from_double_double(toss, None, &Rounded) {
            return Ok(rounded(cos_tilt));
        }
        // That the digits ran out says nothing of the size of cos θ, but a ball about 0 does.
        let is_near_0 = climb_from_double_double(toss, None, &Near0).is_some();
        return if is_near_0 { Ok((0.0, COS_TILT_ERROR)) } else { Err(SolveError::NotFinite { time: time.seconds() }) };
    }
    let (cos_tilt, phase) = (motion.cos_tilt(time)?, motion.phase(time)?);
    let error = if phase <= LARGEST_PHASE_IN_DOUBLE_DOUBLE { COS_TILT_ERROR } else { ERROR_AT_LARGE_PHASES };
    if cos_tilt.abs() > error {
        return Ok((cos_tilt, error));
    }
    let with_digits = DIGITS.iter().find_map(|digits| cos_tilt_in_digits(toss, *digits).filter(has_digits_of_f64));
    Ok(with_digits.map_or((0.0, error), |cos_tilt| rounded(cos_tilt.to_f64())))
}

impl ProvenCounts {
    /// Proves and counts the outcomes of `tosses` of any bodies.
    ///
    /// # Errors
    /// [`Error::Launch`] for the first toss that has no outcome.
    pub fn of(tosses: impl IntoIterator<Item = Toss>) -> Result<Self, Error> {
        let mut counts = Self::default();
        for (index, toss) in tosses.into_iter().enumerate() {
            counts.add(certify(&toss).map_err(|source| Error::of_launch(index, &toss, source))?);
        }
        Ok(counts)
    }
}

/// The outcome that cos θ proves, if it has a sign.
fn outcome<N: Elementary>(toss: &Toss, vertical: &[Ball<N>; 3], time: &Ball<N>) -> Option<Outcome> {
    let cos_tilt = cos_tilt_in_ball(toss, vertical, time)?;
    match Outcome::of(cos_tilt.midpoint().to_f64(), cos_tilt.radius()) {
        Outcome::Undecided => None,
        decided => cos_tilt.has_sign().then_some(decided),
    }
}

/// A ball with cos θ; `None` if the numbers have too few digits.
fn cos_tilt_in_ball<N: Elementary>(toss: &Toss, vertical: &[Ball<N>; 3], time: &Ball<N>) -> Option<Ball<N>> {
    let (rate, _) = toss.launch.given_rate();
    let curve = Curve::new(&toss.body, &scaled(&rate, time))?;
    // A large phase is left to its check. In f64 nothing would be decided by it.
    let turned = curve.rates().map(|rate| (rate * time.clone()).to_f64().abs());
    if time.digits() == 53 && !turned.iter().all(|phase| *phase < LARGEST_PHASE_IN_F64) {
        return None;
    }
    Some(cos_tilt(&curve.turn(time), vertical))
}

/// The outcome in f64, for phases whose rounding leaves digits.
fn by_f64(toss: &Toss) -> Option<Outcome> {
    let (time, vertical) = in_double_double(&toss.launch)?;
    outcome(toss, &vertical.each_ref().map(rounded), &rounded(&time))
}

fn by_double_double(toss: &Toss) -> Option<Outcome> {
    let (time, vertical) = in_double_double(&toss.launch)?;
    outcome(toss, &vertical, &time)
}

/// The outcome in this number of digits, for rates of any ratio.
fn by_digits(toss: &Toss, digits: usize) -> Option<Outcome> {
    cos_tilt_in_digits(toss, digits).map(|cos_tilt| Outcome::of(cos_tilt.sign(), 0.0))
}

/// A ball with cos θ in this number of digits, if it has a sign.
fn cos_tilt_in_digits(toss: &Toss, digits: usize) -> Option<WideBall> {
    let (time, vertical) = in_digits(&toss.launch, digits);
    let curve = Curve::new(&toss.body, &scaled(&toss.launch.given_rate().0, &time))?;
    Some(cos_tilt(&curve.turn(&time), &vertical)).filter(WideBall::has_sign)
}

#[cfg(test)]
mod tests {
    use dynamics::{AngleUnit, Attitude, Body, Launch, TimeOfFlight};
    use numerics::DoubleDouble;
    use numerics::big::exactly;

    use super::*;

    /// Tosses of four bodies, from horizontal and tilted, with phases of up to some thousand rad.
    fn tosses() -> impl Iterator<Item = Toss> {
        let bodies = [[1.0, 2.0, 2.5], [2.5, 1.0, 2.0], [1.0, 1.001, 2.0], [1.0, 2.0, 2.25]];
        (0..2000).map(move |index| {
            let part = |square: f64| (f64::from(index) * square.sqrt()).fract();
            let rate = [2.0, 3.0, 5.0].map(|square| 120.0 * part(square) - 60.0);
            let time = [0.5, 0.7, 40.0][index as usize % 3] * part(7.0);
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
            let launch =
                if index % 2 == 0 { launch } else { launch.with_attitude(Attitude::about_x(3.0 * part(11.0))) };
            Toss { body: Body::from_moments(bodies[index as usize % 4]).unwrap(), launch }
        })
    }

    /// A thousandth of the radius would not do, and the radius is so small that f64 decides nearly all.
    #[test]
    fn balls_of_f64_contain_those_of_double_double_and_decide_nearly_all_outcomes() {
        let (mut decided, mut largest) = (0, 0.0_f64);
        for toss in tosses() {
            let (time, vertical) = in_double_double(&toss.launch).unwrap();
            let fine = cos_tilt_in_ball(&toss, &vertical, &time).unwrap();
            let Some(rough) = cos_tilt_in_ball(&toss, &vertical.each_ref().map(rounded), &rounded(&time)) else {
                continue;
            };
            let off = (fine.midpoint().hi() - rough.midpoint()).abs();
            assert!(off <= rough.radius() + fine.radius(), "{toss:?}: {off:e} {rough:?}");
            largest = largest.max(off / rough.radius());
            decided += u32::from(by_f64(&toss).is_some());
        }
        assert!(decided > 1990 && largest > 1e-3, "{decided} {largest:e}");
    }

    /// Rates in degrees are proven in many digits, in which the axes of a tensor have to be found to nearly as many.
    #[test]
    fn tensors_at_rates_in_degrees_are_decided_wherever_cos_tilt_is_clear() {
        for index in 0..200 {
            let part = |square: f64| (f64::from(index + 1) * square.sqrt()).fract() - 0.5;
            let [xy, xz, yz] = [part(2.0), part(3.0), part(5.0)].map(|part| 0.6 * part);
            let body = Body::from_inertia([2.0, 2.2, 2.4, xy, xz, yz]).unwrap();
            let rate = [part(7.0), part(11.0), part(13.0)].map(|part| 3e3 * part);
            let degree = AngleUnit::Turns(numerics::Unit::ratio(1, 360).unwrap());
            let launch = Launch::in_unit(rate, degree, TimeOfFlight::Given(0.7)).unwrap();
            let toss = Toss { body, launch };
            let cos_tilt = ExactMotion::new(&toss).cos_tilt(0.7).unwrap();
            assert_eq!(certify(&toss).unwrap().outcome(), Outcome::of(cos_tilt, 1e-12), "{toss:?}: {cos_tilt}");
        }
    }

    /// The time has a division and the factor of the unit, the vertical a division.
    #[test]
    fn balls_of_many_digits_contain_the_numbers_of_more() {
        for toss in tosses().take(100) {
            let degree = AngleUnit::Turns(numerics::Unit::ratio(1, 360).unwrap());
            let thrown = TimeOfFlight::Ballistic { speed: 1.0 + toss.launch.flight_time(), gravity: 9.81 };
            let launch = Launch::in_unit([1.0, 2.0, 3.0], degree, thrown).unwrap();
            let toss = Toss { launch: launch.with_attitude(toss.launch.attitude()), ..toss };
            let ((time, vertical), (finer_time, finer)) = (in_digits(&toss.launch, 256), in_digits(&toss.launch, 448));
            for (ball, fine) in vertical.iter().chain([&time]).zip(finer.iter().chain([&finer_time])) {
                let off = (fine.midpoint() - ball.midpoint()).to_f64().value().abs();
                assert!(off <= ball.error(), "{toss:?}: {off:e}, radius {:e}", ball.error());
            }
        }
    }

    #[test]
    fn counts_are_of_each_toss_and_the_first_without_an_outcome_is_named() {
        let few: Vec<Toss> = tosses().take(40).collect();
        let counts = ProvenCounts::of(few.iter().copied()).unwrap();
        let heads = few.iter().filter(|toss| certify(toss).unwrap().outcome() == Outcome::Heads).count() as u64;
        assert!((5..35).contains(&heads));
        assert_eq!((counts.heads(), counts.tails(), counts.total()), (heads, 40 - heads, 40));
        let turning = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(1e17)).unwrap();
        let endless = Toss { launch: turning, ..few[0] };
        let failed = ProvenCounts::of([few[0], few[1], endless, few[2], endless]).unwrap_err();
        assert!(matches!(failed, Error::Launch { index: 2, .. }), "{failed}");
    }

    /// Both radii and the midpoint's second part count, and so does the rounding of their sum.
    #[test]
    fn a_rounded_ball_contains_the_finer_one() {
        for index in 1..2000 {
            let part = |square: f64| (f64::from(index) * square.sqrt()).fract();
            let fine = DoubleDouble::from(part(2.0)) + DoubleDouble::from(1e-16 * (part(3.0) - 0.5));
            let radius = part(5.0) * [1e-16, 1e-17, 1e-33][index as usize % 3];
            let found = rounded(&Ball::new(fine, radius));
            let farthest = DoubleDouble::from(fine.lo().abs()) + DoubleDouble::from(radius);
            assert!(*found.midpoint() == fine.hi() && (DoubleDouble::from(found.radius()) - farthest).hi() >= 0.0);
            assert!(found.radius() <= (1.0 + 4.0 * f64::EPSILON) * farthest.hi());
        }
    }

    /// Some launches are off by up to 3e-16.
    #[test]
    fn cos_tilt_is_within_its_error_at_the_largest_phases() {
        for index in 1..=60 {
            let part = |square: f64| (f64::from(index) * square.sqrt()).fract() - 0.5;
            let rate = [2.0, 3.0, 5.0].map(|square| 160.0 * part(square));
            let toss = |time| {
                let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(0.3).unwrap();
                Toss { body: Body::from_moments([1.0, 2.0, 3.0]).unwrap(), launch }
            };
            let turned = ExactMotion::new(&toss(1.0)).phase(1.0).unwrap();
            for (phase, most) in [(0.99e14, COS_TILT_ERROR), (8.5e15, ERROR_AT_LARGE_PHASES)] {
                let toss = toss(phase / turned);
                let (cos_tilt, error) = cos_tilt_with_error(&toss).unwrap();
                let exact = cos_tilt_in_digits(&toss, 256).unwrap().to_big();
                let off = (exactly(cos_tilt) - exact).to_f64().value().abs();
                assert!(off <= error && error == most, "{toss:?}: {off:e} {error:e}");
            }
        }
    }

    /// From 1e12 rad on f64 is not tried: the phase of a body that always shows heads would not be checked then.
    #[test]
    fn flights_of_large_phases_are_decided_in_double_double() {
        let spinning = |time: f64| Toss {
            body: Body::from_moments([1.0, 1.2, 2.0]).unwrap(),
            launch: Launch::new([0.01, 0.01, 1.9], TimeOfFlight::Given(time)).unwrap(),
        };
        let certified = |time: f64| certify(&spinning(time)).map(|found| (found.outcome(), found.stage()));
        assert_eq!(certified(1e11), Ok((Outcome::Heads, Stage::F64)));
        // A rate of more than 1 rad/s, so that the time alone is below 1e12.
        for time in [0.8e12, 1e13, 1e15] {
            let (exact_time, vertical) = in_double_double(&spinning(time).launch).unwrap();
            let rough = vertical.each_ref().map(rounded);
            assert!(cos_tilt_in_ball(&spinning(time), &rough, &rounded(&exact_time)).is_none(), "{time:e}");
            assert!(cos_tilt_in_ball(&spinning(time), &vertical, &exact_time).is_some(), "{time:e}");
            assert_eq!(certified(time), Ok((Outcome::Heads, Stage::DoubleDouble)), "{time:e}");
        }
        assert!(matches!(certified(1e17), Err(SolveError::PhaseTooLarge { .. })));
    }

    /// The radii of the time and of the vertical are those that the roundings need, and no more.
    #[test]
    fn balls_of_the_inputs_have_the_radii_of_their_roundings() {
        for toss in tosses().skip(1).take(20) {
            let (time, vertical) = in_double_double(&toss.launch).unwrap();
            assert_eq!(time.radius(), 2f64.powi(-97) * time.midpoint().hi());
            assert!(vertical.iter().all(|part| part.radius() == 2f64.powi(-67)));
            let (time, vertical) = in_digits(&toss.launch, 256);
            let time_in_roundings = time.error() / (2f64.powi(-240) * Elementary::to_f64(time.midpoint()));
            // Those of the time of flight and of the unit, and of their product.
            assert!((2.0..2.01).contains(&time_in_roundings), "{time_in_roundings}");
            // What is 0 is so exactly.
            let [zeros, parts]: [Vec<&WideBall>; 2] =
                [true, false].map(|is_zero| vertical.iter().filter(|part| (part.sign() == 0.0) == is_zero).collect());
            assert!(zeros.iter().all(|part| part.error() == 0.0) && !parts.is_empty());
            assert!(parts.iter().all(|part| (1.0..1.001).contains(&(part.error() * 2f64.powi(240)))));
        }
    }

    /// Else the radii, which are of a vertical of length 1, would be too small or too large.
    #[test]
    fn the_vertical_of_a_quaternion_of_any_norm_has_length_1() {
        let attitude = Attitude::from_components([3e9, 1e9, -2e9, 0.5e9]).unwrap();
        let launch = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(1.0)).unwrap().with_attitude(attitude);
        let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch };
        let (_, vertical) = in_digits(&toss.launch, 256);
        let squares: f64 = vertical.iter().map(|part| part.midpoint().to_f64().value().powi(2)).sum();
        assert!((squares - 1.0).abs() < 1e-12, "{squares}");
    }

    /// Of components that differ by any factor, the outcome is that of the motion without the smallest where that one does
    /// not grow. Next to the middle axis it grows by 1e250 in 200 s; then the motion is that of 1536 digits without bounds.
    #[test]
    fn no_ratio_of_rates_leaves_an_outcome_undecided() {
        for exponent in [-20, -140, -200, -300, -320] {
            let tiny = 10f64.powi(exponent);
            for (rate, still) in [
                ([tiny, 5.0, 0.0], [0.0, 5.0, 0.0]),
                ([tiny, 5.0, -tiny], [0.0, 5.0, 0.0]),
                ([3.0, 5.0, tiny], [3.0, 5.0, 0.0]),
                ([tiny, 5.0, 2.0], [0.0, 5.0, 2.0]),
                ([3.0, tiny, 2.0], [3.0, 0.0, 2.0]),
                ([5.0, tiny, tiny], [5.0, 0.0, 0.0]),
                ([-tiny, tiny, 5.0], [0.0, 0.0, 5.0]),
                ([tiny, 0.0, 5.0], [0.0, 0.0, 5.0]),
                ([tiny * tiny, tiny, 5.0], [0.0, 0.0, 5.0]),
                ([tiny, 5e-324, 1e300], [0.0, 0.0, 1e300]),
            ] {
                for (moments, tilt) in [([1.0, 2.0, 3.0], 0.3), ([3.0, 1.0, 2.0], 1.2), ([2.0, 3.0, 1.5], 2.0)] {
                    let time = if still[2] > 1e200 { 1e-300 } else { 1.3 };
                    let toss = |rate: [f64; 3]| {
                        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
                        let launch = launch.with_attitude(Attitude::about_x(tilt));
                        Toss { body: Body::from_moments(moments).unwrap(), launch }
                    };
                    let [found, expected] = [toss(rate), toss(still)].map(|toss| certify(&toss).unwrap());
                    assert!(
                        found.is_proven() && found.outcome() == expected.outcome(),
                        "{rate:?} {moments:?}: {found:?}"
                    );
                    let [one, other] =
                        [toss(rate), toss(still)].map(|toss| ExactMotion::new(&toss).cos_tilt(time).unwrap());
                    assert!((one - other).abs() < 1e-15, "{rate:?} {moments:?}: {one} {other}");
                }
            }
        }
        for (rate, time) in [([1e-140, 5.0, 0.0], 200.0), ([1e-200, 5.0, -1e-201], 200.0), ([1e-200, 5.0, 0.0], 1000.0)]
        {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(0.3).unwrap();
            let toss = Toss { body: Body::from_moments([1.0, 2.0, 3.0]).unwrap(), launch };
            let (found, cos_tilt) = (certify(&toss).unwrap(), ExactMotion::new(&toss).cos_tilt(time).unwrap());
            assert!(found.is_proven() && found.outcome() == Outcome::of(cos_tilt, 1e-15), "{rate:?} {cos_tilt}");
        }
    }

    /// A plate that rests on its edge: no ball proves that cos θ is 0.
    #[test]
    fn an_undecided_outcome_of_a_body_is_not_called_proven() {
        let quarter = dynamics::AngleUnit::Turns(numerics::Unit::ONE).times(0.25);
        let launch = Launch::new([0.0; 3], TimeOfFlight::Given(0.7)).unwrap().with_tilt(quarter).unwrap();
        let toss = Toss { body: Body::from_moments([1.0, 2.0, 3.0]).unwrap(), launch };
        let certificate = certify(&toss).unwrap();
        assert_eq!((certificate.outcome(), certificate.is_proven()), (Outcome::Undecided, false));
        let toss = Toss { launch: launch.with_tilt(1.0).unwrap(), ..toss };
        assert!(certify(&toss).unwrap().is_proven());
    }

    /// After π/2 rad to the nearest f64 cos θ is 6.1e-17. At rest, from a quaternion near (1, 1, 0, 0) it is z²/(2 + z²), which
    /// some of these round to the very bound.
    #[test]
    fn the_error_of_a_small_cos_tilt_is_below_it() {
        let quarter = std::f64::consts::FRAC_PI_2;
        for moments in [[1.0, 1.0, 2.0], [1.0, 2.0, 2.5]] {
            let body = Body::from_moments(moments).unwrap();
            let launch = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(quarter)).unwrap();
            let cos_tilt = quarter.cos();
            assert_eq!(
                cos_tilt_with_error(&Toss { body, launch }),
                Ok((cos_tilt, f64::EPSILON * cos_tilt)),
                "{moments:?}"
            );
        }
        let (body, mut met) = (Body::from_moments([1.0, 2.0, 2.5]).unwrap(), 0);
        let mut z = (2.0 * COS_TILT_ERROR).sqrt() * (1.0 - 4e-15);
        for _ in 0..40 {
            z = z.next_up();
            let launch = Launch::new([0.0; 3], TimeOfFlight::Given(1.0)).unwrap();
            let toss =
                Toss { body, launch: launch.with_attitude(Attitude::from_components([1.0, 1.0, 0.0, z]).unwrap()) };
            let (cos_tilt, error) = cos_tilt_with_error(&toss).unwrap();
            assert!(error < cos_tilt, "{z:e}: {cos_tilt:e} {error:e}");
            met += u32::from(ExactMotion::new(&toss).cos_tilt(1.0) == Ok(COS_TILT_ERROR));
        }
        assert!(met > 0);
    }
}
