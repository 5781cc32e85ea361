//! This file computes the exact motion of any rigid body: attitude, body rate and cos θ at any time after launch. A
//! coin whose relief makes I1 ≠ I2, a book or a satellite moves by elliptic functions, and by nothing simpler.
//!
//! # The motion
//! Let the principal axes be 1, 2, 3, m = I ω the angular momentum in the body frame (BF), G = |m|, T the kinetic
//! energy and α_ij = (I_j - I_i)/(I_i I_j). The sign of
//!
//! ```text
//! E = I3 (I3 - I2) ω3² - I1 (I2 - I1) ω1² = G² - 2 T I2
//! ```
//!
//! tells which axis m circles in BF: that of the largest moment for E > 0, that of the smallest for E < 0, after which
//! the axes are relabelled (1, 2, 3) → (3, -2, 1). Two axes are reversed if m3 < 0. Then, with no difference that
//! cancels,
//!
//! ```text
//! P1 = α12 m2² + α13 m3²,   P3 = α13 m1² + α23 m2²,   λ = ±√(P1 α23)                      the sign of α13
//! k² = α12 P3/(α23 P1),     k'² = |α13 E|/(I2 |α23 P1|)
//! m ~ (b1 cn u, b2 sn u, b3 dn u),   u = λt + u0,   b1 : b2 = √|α23| : √|α13|              C. G. J. Jacobi 1849
//! c = F(atan √(α23/α12) | k'²),      v = K' - c = F(atan √(P1/P3) | k'²),   x = πu/(2K)
//! ```
//!
//! and the attitude R, relative to axes whose third is along m, is the quaternion w + iz = A, x + iy = B of
//!
//! ```text
//! A : B = e^(iΩt/2) (θ4(z | q²) : θ1(z | q²)),    z = x - iπc/(2K),    q = exp(-πK'/K)
//! Ω = G/I3 + G α13 (P3/P1) J/K,  or  G/I1 + G |α13| Π/K  for α13 < 0, where no part of a sum cancels another
//! J = cel(k', p, 0, 1),  Π = cel(k', p, 1, 1),  p = α13 G²/P1   (complete_first_and_third)
//! Q(t) = Q0 p⁻¹ R(0)⁻¹ R(t) p,      p from BF to the relabelled axes
//! ```
//!
//! For q > 0.2 Jacobi's imaginary transformation turns θ4 and θ1 into Gaussians
//! ([`GaussianPair`](numerics::elliptic::GaussianPair)). On the separatrix, E = 0, two of them are left. A body with
//! two equal moments, or one that turns about a principal axis, needs no elliptic function.
//!
//! # Digits
//! Next to the separatrix the period is -ln |E|, and rounding E would lose every digit after some turns: it is computed
//! exactly. All constants of a launch and everything of a time are double-double, so that phases of 1e9 rad keep twenty
//! digits after the point, and results are rounded once. A few launches need more digits, and their constants are
//! rounded from those: tensors next to the separatrix, and launches whose components differ by more than 2^200.
//!
//! [`RigidAngles`] are the Euler angles, continuous from launch on.
//!
//! [`ExactMotion::compensated`] is three to seven times as fast: its phases are in double-double, all else is in f64.
//!
//! [`certify`] proves outcomes by the same formulas in [`Ball`](numerics::Ball), numbers that carry a bound of
//! every rounding.

mod angles;
mod certified;
mod constants;
mod curve;
mod doubling;
mod form;
pub(crate) mod line;
mod phases;
mod quaternion;
mod regime;
mod sensitivity;
mod tensor;
mod tensor_toss;

use dynamics::phase::require_phase;
use dynamics::time_of_flight::ExactTime;
use dynamics::{AngleUnit, Attitude, SolveError, State, Toss, Vector3};
use numerics::big::exactly;
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{DoubleDouble, Elementary, WideBall};

pub use angles::RigidAngles;
pub use certified::certify;
pub(crate) use certified::cos_tilt_with_error;
use curve::Curve;
pub use regime::Regime;

use crate::given::{components_are_close, scaled};
use crate::motion::CoinMotion;
use quaternion::{Quaternion, norm_squared};
use tensor_toss::{Landed, Question, climb_from_double_double};

/// Digits of the constants of a launch where double-double has too few.
const MANY_DIGITS: usize = 1536;

/// The motion of a rigid body after its launch.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactMotion {
    launch: State,
    kind: Kind,
}

/// How the motion is computed.
#[derive(Debug, Clone, PartialEq)]
enum Kind {
    /// By the closed form for coins.
    Coin(Box<CoinMotion>),
    /// By elliptic functions about the principal axes, of a body given by its moments.
    Rigid(RigidMotion),
    /// By doubling in the frame of the tensor, of a body given by one.
    Tensor(Box<Toss>),
}

/// Largest error of a turn (as a unit quaternion) and of a rate (in parts of it) that are rounded to f64.
const TO_F64: f64 = 3.469_446_951_953_614e-18; // 2^-58

/// The motion of a body that is not a coin, as its turn since launch.
#[derive(Debug, Clone, PartialEq)]
struct RigidMotion {
    curve: Sums,
    /// The unit of the rates (rad/s) is 2^`exponent` times `unit`, the factor of an angle's unit.
    exponent: i32,
    unit: DoubleDouble,
}

/// The motion of a body that is not a coin, its phases in double-double.
#[derive(Debug, Clone, PartialEq)]
enum Sums {
    /// And the functions of the phases in f64.
    F64(Box<Curve<DoubleDouble, f64>>),
    /// And all else, too.
    DoubleDouble(Box<Curve<DoubleDouble>>),
}

impl ExactMotion {
    /// The motion of a toss. One of a body with I1 = I2 is that of [`CoinMotion`], to the last bit.
    pub fn new(toss: &Toss) -> Self {
        Self::by(toss, RigidMotion::in_double_double)
    }

    /// The same motion for many launches or times: a launch takes a third of the time, a further time a seventh. Only
    /// the phases are in double-double, all else is in f64. Errors were at most 2.2e-15 rad of the attitude and 1.5e-15 of
    /// cos θ over 122 500 tosses with phases to 1e9 rad.
    ///
    /// Next to the separatrix, and for rates that differ by more than 2^200, all is in double-double as by
    /// [`ExactMotion::new`].
    pub fn compensated(toss: &Toss) -> Self {
        Self::by(toss, RigidMotion::compensated)
    }

    fn by(toss: &Toss, rigid: impl Fn(&Toss) -> RigidMotion) -> Self {
        let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
        let kind = match toss.coin() {
            Some(toss) => Kind::Coin(Box::new(CoinMotion::new(&toss))),
            None if toss.body.moments().is_none() => Kind::Tensor(Box::new(*toss)),
            None => Kind::Rigid(rigid(toss)),
        };
        Self { launch, kind }
    }

    /// The kind of motion.
    pub fn regime(&self) -> Regime {
        match &self.kind {
            Kind::Coin(_) => Regime::Uniform,
            Kind::Rigid(motion) => match &motion.curve {
                Sums::F64(curve) => curve.regime(),
                Sums::DoubleDouble(curve) => curve.regime(),
            },
            Kind::Tensor(toss) => tensor_toss::regime(toss),
        }
    }

    /// The larger of two phases (rad), `time` (s) after launch: how far the body has turned about its angular momentum,
    /// and how far the angular momentum has turned in the body. Of a body given by a tensor it is the angle that |ω| at
    /// launch makes of the time.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] if it is above 2^53.
    pub fn phase(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        match &self.kind {
            Kind::Coin(motion) => motion.phase(time),
            Kind::Rigid(motion) => motion.own_time(time.into()).map(|(_, phase)| phase),
            Kind::Tensor(toss) => turned_at_launch(toss, time.into()),
        }
    }

    /// cos θ, `time` (s) after launch, with θ the angle between n and the vertical.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn cos_tilt(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        let vertical = self.launch.attitude.exact_vertical();
        let motion = match &self.kind {
            Kind::Coin(motion) => return motion.cos_tilt(time),
            Kind::Rigid(motion) => motion,
            Kind::Tensor(toss) => {
                let (turn, _) = turn_and_rate(toss, time.into(), TO_F64)?;
                return Ok(cos_tilt(&turn, &vertical).hi().clamp(-1.0, 1.0));
            }
        };
        let (time, _) = motion.own_time(time.into())?;
        let cos_tilt = match &motion.curve {
            Sums::F64(curve) => cos_tilt(&curve.turn(&time), &vertical.map(DoubleDouble::hi)),
            Sums::DoubleDouble(curve) => cos_tilt(&curve.turn(&time), &vertical).hi(),
        };
        Ok(cos_tilt.clamp(-1.0, 1.0))
    }

    /// Attitude and body rate, `time` (s) after launch.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn state(&self, time: impl Into<ExactTime>) -> Result<State, SolveError> {
        let (turn, rate) = match &self.kind {
            Kind::Coin(motion) => return motion.state(time),
            Kind::Rigid(motion) => motion.turn_and_rate(time.into())?,
            Kind::Tensor(toss) => {
                let (turn, rate) = turn_and_rate(toss, time.into(), TO_F64)?;
                (turn.map(DoubleDouble::hi), rate)
            }
        };
        // Its norm is not 0, for A and B never vanish together.
        let turn = Attitude::from_components(turn).unwrap_or(Attitude::IDENTITY);
        Ok(State { attitude: self.launch.attitude * turn, rate: Vector3::from(rate) })
    }

    /// The time in the unit of the curve, and the unit of the rates (rad/s); of a body without a curve, both as they are.
    fn time_and_unit(&self, time: ExactTime) -> Result<(DoubleDouble, f64), SolveError> {
        match &self.kind {
            Kind::Coin(_) | Kind::Tensor(_) => Ok((time.mantissa().times_power_of_two(time.exponent()), 1.0)),
            Kind::Rigid(motion) => {
                let (own, _) = motion.own_time(time)?;
                Ok((own, motion.unit.times_power_of_two(motion.exponent).hi()))
            }
        }
    }
}

impl RigidMotion {
    fn in_double_double(toss: &Toss) -> Self {
        Self::by(toss, Sums::DoubleDouble(Box::new(curve_in_double_double(toss, toss.launch.given_rate().0))))
    }

    fn compensated(toss: &Toss) -> Self {
        let (rate, _) = toss.launch.given_rate();
        let rounded = if components_are_close(&rate) {
            Curve::new(&toss.body, &scaled(&rate, &DoubleDouble::ZERO))
        } else {
            None
        };
        match rounded.filter(|curve| !curve.is_close_to_separatrix()) {
            Some(curve) => Self::by(toss, Sums::F64(Box::new(curve))),
            None => Self::in_double_double(toss),
        }
    }

    /// The motion of the body of a toss by a curve for its rate as given.
    fn by(toss: &Toss, curve: Sums) -> Self {
        let (rate, unit) = toss.launch.given_rate();
        let unit = if unit == AngleUnit::RADIAN { 1.0.into() } else { DoubleDouble::nearest(&unit.in_digits(160)) };
        let (_, exponent) = mantissa_and_exponent(power_of_two_scale(rate.amax()));
        Self { curve, exponent, unit }
    }

    /// The turn (of any norm) from the body at launch to the body at `time`, and the body rate (rad/s).
    fn turn_and_rate(&self, time: ExactTime) -> Result<([f64; 4], [f64; 3]), SolveError> {
        let (time, _) = self.own_time(time)?;
        let (turn, rate) = match &self.curve {
            Sums::F64(curve) => {
                let (turn, rate) = curve.turn_and_rate(&time);
                (turn, rate.map(DoubleDouble::from))
            }
            Sums::DoubleDouble(curve) => {
                let (turn, rate) = curve.turn_and_rate(&time);
                (turn.map(DoubleDouble::hi), rate)
            }
        };
        Ok((turn, rate.map(|part| (part * self.unit).times_power_of_two(self.exponent).hi())))
    }

    /// The time in the unit of the curve, and the larger phase (rad).
    fn own_time(&self, time: ExactTime) -> Result<(DoubleDouble, f64), SolveError> {
        let rates = match &self.curve {
            Sums::F64(curve) => curve.rates(),
            Sums::DoubleDouble(curve) => curve.rates(),
        };
        let (mantissa, exponent) = (time.mantissa() * self.unit, self.exponent + time.exponent());
        let turned = |rate: DoubleDouble| (rate * mantissa).times_power_of_two(exponent).hi().abs();
        let phase = require_phase(rates.into_iter().map(turned).fold(0.0, larger))?;
        // Of a body at rest the phase is 0 at any time, also at one that is infinite in its unit.
        let still = rates.iter().all(|rate| rate.hi() == 0.0);
        Ok((if still { DoubleDouble::ZERO } else { mantissa.times_power_of_two(exponent) }, phase))
    }
}

/// The angle (rad) that |ω| at launch makes of `time`.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`] if it is above 2^53.
fn turned_at_launch(toss: &Toss, time: ExactTime) -> Result<f64, SolveError> {
    let rate = toss.launch.rate();
    let (_, exponent) = mantissa_and_exponent(power_of_two_scale(rate.amax()));
    let size = (rate / power_of_two_scale(rate.amax())).norm();
    require_phase((time.mantissa().hi() * size).times_power_of_two(exponent + time.exponent()))
}

/// The turn of a body that was given by a tensor, a unit quaternion, and its rate (BF, rad/s) after `time`, within so much
/// of what they are: the rate in parts of the rate at launch.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`]; [`SolveError::NotFinite`] if the last number of digits is too few.
fn turn_and_rate(
    toss: &Toss,
    time: ExactTime,
    within: f64,
) -> Result<(Quaternion<DoubleDouble>, [f64; 3]), SolveError> {
    turned_at_launch(toss, time)?;
    let found = climb_from_double_double(toss, Some(time), &TurnAndRate { within });
    let seconds = time.mantissa().times_power_of_two(time.exponent()).hi();
    found.map(|(answer, _)| answer).ok_or(SolveError::NotFinite { time: seconds })
}

/// The turn and the rate, within so much.
struct TurnAndRate {
    within: f64,
}

impl Question for TurnAndRate {
    type Answer = (Quaternion<DoubleDouble>, [f64; 3]);

    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<Self::Answer> {
        let size = norm_squared(&landed.turn).sqrt();
        let turn = landed.turn.each_ref().map(|part| part.clone() / size.clone());
        let rate = landed.rate();
        let is_known = |part: &N| part.error() <= self.within;
        let given = &landed.given;
        let in_rad =
            |part: &N| (part.clone() * given.unit.clone()).to_double_double().times_power_of_two(given.exponent).hi();
        (turn.iter().all(is_known) && rate.iter().all(is_known))
            .then(|| (turn.each_ref().map(N::to_double_double), rate.each_ref().map(in_rad)))
    }
}

/// The larger number; NaN if one of them is.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// cos θ of a body that has turned by `turn` (of any norm) since launch, with the `vertical` in BF at launch.
fn cos_tilt<N: Elementary>(turn: &Quaternion<N>, vertical: &[N; 3]) -> N {
    let [x, y, z] = quaternion::turned_normal(turn);
    let [up_x, up_y, up_z] = vertical.clone();
    (x * up_x + y * up_y + z * up_z) / norm_squared(turn)
}

/// A number of many digits, exactly 0.
fn in_many_digits() -> WideBall {
    let zero = exactly(0.0).with_precision(MANY_DIGITS).value();
    WideBall::new(zero.clone(), &zero)
}

/// The curve in double-double, from more digits if these are too few.
fn curve_in_double_double(toss: &Toss, rate: Vector3<f64>) -> Curve<DoubleDouble> {
    let close =
        if components_are_close(&rate) { Curve::new(&toss.body, &scaled(&rate, &DoubleDouble::ZERO)) } else { None };
    close.unwrap_or_else(|| {
        let curve: Option<Curve<WideBall>> = Curve::new(&toss.body, &scaled(&rate, &in_many_digits()));
        // With so many digits a launch has a regime: what decides it is exact.
        curve.map(|curve| curve.to_double_double()).unwrap_or_else(|| unreachable!("a regime"))
    })
}

#[cfg(test)]
mod tests;
