//! This file proves the outcome of the toss of any rigid body: the closed form is evaluated in [`Ball`](numerics::Ball)s, which contain
//! the true numbers, first in f64, then in double-double and then in more and more digits, until cos θ has a sign.
//!
//! The numbers as given are the moments or the tensor, the rates in their unit, the attitude, and the time or the
//! speed, gravity and drop. They are exact, or balls contain them.

use dynamics::{Error, Outcome, SolveError, Stage, State, Toss};
use numerics::Elementary;

use super::climb::{Landed, Question, climb};
use super::{TO_F64, TurnAndRate, cos_tilt, state, turned_at_launch, turned_state};
use crate::certificate::{Certificate, ProvenCounts};
use crate::certified::{self, certify_coin};
use crate::motion::COS_TILT_ERROR;

/// Proves the outcome of a toss.
///
/// Where the body does not move, exact arithmetic decides, and an outcome that is undecided is a tie. Else one is undecided, without a
/// proof, if cos θ is 0 as far as 12 288 digits can tell. Fails with [`SolveError::PhaseTooLarge`] for a phase above
/// 2^53 rad.
pub fn certify(toss: &Toss) -> Result<Certificate, SolveError> {
    if let Some(toss) = toss.coin() {
        return certify_coin(&toss);
    }
    turned_at_launch(toss, toss.launch.time_of_flight().into())?;
    if let Some(sign) = sign_at_rest(toss) {
        return Ok(Certificate::new(Outcome::of(sign, 0.0), Stage::MoreDigits));
    }
    let found = climb(toss, None, Stage::F64, &Sign);
    Ok(found.map_or_else(Certificate::without_proof, |(outcome, stage)| Certificate::new(outcome, stage)))
}

/// The sign of cos θ, by exact arithmetic, of a body that does not turn; `None` of one that does.
fn sign_at_rest(toss: &Toss) -> Option<f64> {
    let turns = toss.launch.rate().amax() > 0.0 && toss.launch.time_of_flight().is_positive();
    // Digits do not matter to the sign: what is 0 is 0 in any number of them.
    (!turns).then(|| Elementary::sign(&toss.launch.attitude().vertical_in_digits(64).0[2]))
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
pub(crate) fn cos_tilt_with_error(toss: &Toss) -> Result<(f64, f64), SolveError> {
    // By reference: moved out, the toss would be copied twice.
    if let Some(toss) = &toss.coin() {
        return certified::cos_tilt(toss).map(|cos_tilt| match cos_tilt.abs() > COS_TILT_ERROR {
            true => (cos_tilt, COS_TILT_ERROR),
            false => with_rounding(cos_tilt),
        });
    }
    let time = toss.launch.time_of_flight();
    turned_at_launch(toss, time.into())?;
    if sign_at_rest(toss) == Some(0.0) {
        return Ok((0.0, 0.0));
    }
    if let Some((cos_tilt, _)) = climb(toss, None, Stage::DoubleDouble, &Rounded) {
        return Ok(with_rounding(cos_tilt));
    }
    // That the digits ran out says nothing of the size of cos θ, but a ball about 0 does.
    let is_near_0 = climb(toss, None, Stage::DoubleDouble, &Near0).is_some();
    if is_near_0 { Ok((0.0, COS_TILT_ERROR)) } else { Err(SolveError::NotFinite { time: time.seconds() }) }
}

/// A cos θ that is rounded from more digits, with a bound of its error.
fn with_rounding(cos_tilt: f64) -> (f64, f64) {
    (cos_tilt, COS_TILT_ERROR.min(f64::EPSILON * cos_tilt.abs()))
}

/// The state at landing of a body that is not a coin, and what [`cos_tilt_with_error`] has of it, from one motion where that is possible.
pub(crate) fn landed(toss: &Toss) -> Result<(State, (f64, f64)), SolveError> {
    let time = toss.launch.time_of_flight().into();
    turned_at_launch(toss, time)?;
    if sign_at_rest(toss) != Some(0.0) {
        let both = (TurnAndRate { within: TO_F64 }, Rounded);
        if let Some(((turned, cos_tilt), _)) = climb(toss, None, Stage::DoubleDouble, &both) {
            return Ok((turned_state(toss, turned), with_rounding(cos_tilt)));
        }
    }
    Ok((state(toss, time, Stage::DoubleDouble, TO_F64)?, cos_tilt_with_error(toss)?))
}

impl ProvenCounts {
    /// Proves and counts the outcomes of `tosses` of any bodies. Fails with [`Error::Launch`] for the first toss that
    /// has no outcome.
    pub fn of(tosses: impl IntoIterator<Item = Toss>) -> Result<Self, Error> {
        let mut counts = Self::default();
        for (index, toss) in tosses.into_iter().enumerate() {
            counts.add(certify(&toss).map_err(|source| Error::of_launch(index, &toss, source))?);
        }
        Ok(counts)
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Body, Launch, TimeOfFlight};
    use numerics::big::exactly;
    use numerics::{Ball, DoubleDouble, WideBall};

    use super::*;
    use crate::given::{in_digits, in_double_double, rounded};
    use crate::rigid::ExactMotion;
    use crate::rigid::given::Given;
    use crate::rigid::special::Special;

    /// cos θ in the numbers of what is given.
    fn cos_tilt_in<N: Elementary>(toss: &Toss, given: &Given<N>) -> Option<N> {
        Some(cos_tilt(&given.turn(Special::at_sight(toss))?, &given.vertical))
    }

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
            let given = Given::in_double_double(&toss, None);
            let fine = cos_tilt_in(&toss, &given).unwrap();
            let Some(rough) = cos_tilt_in(&toss, &given.map(rounded)) else { continue };
            let off = (fine.midpoint().hi() - rough.midpoint()).abs();
            assert!(off <= rough.radius() + fine.radius(), "{toss:?}: {off:e} {rough:?}");
            largest = largest.max(off / rough.radius());
            decided += u32::from(rough.has_sign());
        }
        assert!(decided > 1990 && largest > 1e-3, "{decided} {largest:e}");
    }

    /// The time has a division and the factor of the unit, the vertical a division.
    #[test]
    fn balls_of_many_digits_contain_the_numbers_of_more() {
        for toss in tosses().take(100) {
            let degree = numerics::Unit::DEGREE;
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
            for phase in [0.99e14, 8.5e15] {
                let toss = toss(phase / turned);
                let (cos_tilt, error) = cos_tilt_with_error(&toss).unwrap();
                let exact = cos_tilt_in(&toss, &Given::<WideBall>::in_digits(&toss, None, 384)).unwrap().to_big();
                let off = (exactly(cos_tilt) - exact).to_f64().value().abs();
                assert!(off <= error && error <= COS_TILT_ERROR, "{toss:?}: {off:e} {error:e}");
            }
        }
    }

    /// A doubling takes two to three binary digits.
    #[test]
    fn flights_of_large_phases_take_more_digits() {
        let spinning = |time: f64| Toss {
            body: Body::from_moments([1.0, 1.2, 2.0]).unwrap(),
            launch: Launch::new([0.01, 0.01, 1.9], TimeOfFlight::Given(time)).unwrap(),
        };
        let certified = |time: f64| certify(&spinning(time)).map(|found| (found.outcome(), found.stage()));
        for (time, stage) in [(1e4, Stage::F64), (1e9, Stage::DoubleDouble), (1e15, Stage::MoreDigits)] {
            assert_eq!(certified(time), Ok((Outcome::Heads, stage)), "{time:e}");
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

    /// Of components that differ by any factor, the outcome is that of the motion without the smallest where that one does
    /// not grow. Next to the middle axis it grows by 1e250 in 200 s.
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
