//! This file computes the exact motion of any rigid body: attitude, body rate and cos θ at any time after launch. A
//! coin whose relief makes I1 ≠ I2, a book or a satellite moves by elliptic functions, and by nothing simpler.
//!
//! | what | file |
//! |---|---|
//! | the closed form, by doubling a point of an elliptic curve; functions of the inertia tensor | `doubling`, `tensor` |
//! | spins, symmetric bodies and the separatrix, by elementary functions | `special` |
//! | the numbers as given, and the ladder of more and more digits | `given`, `climb` |
//! | outcomes with a proof | [`certify`] |
//! | derivatives | [`Sensitivity`](crate::Sensitivity) |
//! | the nearest flips, and the speeds that land heads | [`margin`](fn@crate::margin), [`speeds_of_heads`](crate::speeds_of_heads), over the intervals of `line` |
//! | Euler angles, continuous from launch on | [`RigidAngles`] |
//!
//! Every number is taken from balls, which contain the true one, and rounded once: of the attitude and the rate they are small enough for
//! f64, or more digits are taken.

mod angles;
mod certified;
mod climb;
mod doubling;
mod given;
pub(crate) mod line;
mod quaternion;
mod sensitivity;
mod special;
mod tensor;

use dynamics::phase::require_phase;
use dynamics::time_of_flight::ExactTime;
use dynamics::{Attitude, SolveError, Stage, State, Toss, Vector3};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{DoubleDouble, Elementary};

pub use angles::RigidAngles;
pub use certified::certify;
pub(crate) use certified::{cos_tilt_with_error, landed};
pub use special::Regime;

use crate::motion::CoinMotion;
use climb::{Landed, Question, climb};
use quaternion::{Quaternion, norm_squared};

/// Largest error of a turn (as a unit quaternion) and of a rate (in parts of it) that are rounded to f64.
const TO_F64: f64 = 3.469_446_951_953_614e-18; // 2^-58

/// The motion of a rigid body after its launch.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactMotion {
    toss: Toss,
    /// That of a coin, which has a closed form of its own.
    coin: Option<Box<CoinMotion>>,
}

impl ExactMotion {
    /// The motion of a toss. One of a body with I1 = I2 is that of [`CoinMotion`], to the last bit.
    pub fn new(toss: &Toss) -> Self {
        Self { toss: *toss, coin: toss.coin().map(|toss| Box::new(CoinMotion::new(&toss))) }
    }

    /// The kind of motion.
    pub fn regime(&self) -> Regime {
        if self.coin.is_some() { Regime::Uniform } else { Regime::of(&self.toss) }
    }

    /// How far the body turns in `time` (s) after launch (rad): a coin about its angular momentum, another body as far as |ω| at
    /// launch takes it.
    pub fn phase(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        match &self.coin {
            Some(motion) => motion.phase(time),
            None => turned_at_launch(&self.toss, time.into()),
        }
    }

    /// cos θ, `time` (s) after launch, with θ the angle between n and the vertical. Fails with
    /// [`SolveError::PhaseTooLarge`]; [`SolveError::NotFinite`] if the last number of digits is too few.
    pub fn cos_tilt(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        if let Some(motion) = &self.coin {
            return motion.cos_tilt(time);
        }
        let (turn, _) = turn_and_rate(&self.toss, time.into(), Stage::DoubleDouble, TO_F64)?;
        Ok(cos_tilt(&turn, &self.toss.launch.attitude().exact_vertical()).hi().clamp(-1.0, 1.0))
    }

    /// Attitude and body rate, `time` (s) after launch.
    pub fn state(&self, time: impl Into<ExactTime>) -> Result<State, SolveError> {
        match &self.coin {
            Some(motion) => motion.state(time),
            None => state(&self.toss, time.into(), Stage::DoubleDouble, TO_F64),
        }
    }
}

/// Attitude and body rate of a body that is not a coin, `time` after launch, from the `first` stage on that has both within so
/// much.
pub(crate) fn state(toss: &Toss, time: ExactTime, first: Stage, within: f64) -> Result<State, SolveError> {
    turn_and_rate(toss, time, first, within).map(|turned| turned_state(toss, turned))
}

/// The state of a body after a turn, with its rate (BF, rad/s).
fn turned_state(toss: &Toss, (turn, rate): TurnedTo) -> State {
    // Its norm is 1.
    let turn = Attitude::from_components(turn.map(DoubleDouble::hi)).unwrap_or(Attitude::IDENTITY);
    State { attitude: toss.launch.attitude() * turn, rate: Vector3::from(rate) }
}

/// The angle (rad) that |ω| at launch makes of `time`.
pub(crate) fn turned_at_launch(toss: &Toss, time: ExactTime) -> Result<f64, SolveError> {
    let rate = toss.launch.rate();
    let (_, exponent) = mantissa_and_exponent(power_of_two_scale(rate.amax()));
    let size = (rate / power_of_two_scale(rate.amax())).norm();
    require_phase((time.mantissa().hi() * size).times_power_of_two(exponent + time.exponent()))
}

/// The turn of a body that is not a coin, a unit quaternion, and its rate (BF, rad/s) after `time`, within so much
/// of what they are: the rate in parts of the rate at launch. Fails with [`SolveError::PhaseTooLarge`];
/// [`SolveError::NotFinite`] if the last number of digits is too few.
fn turn_and_rate(toss: &Toss, time: ExactTime, first: Stage, within: f64) -> Result<TurnedTo, SolveError> {
    turned_at_launch(toss, time)?;
    let found = climb(toss, Some(time), first, &TurnAndRate { within });
    let seconds = time.mantissa().times_power_of_two(time.exponent()).hi();
    found.map(|(answer, _)| answer).ok_or(SolveError::NotFinite { time: seconds })
}

/// A turn since launch, a unit quaternion, and the body rate (BF, rad/s) after it.
type TurnedTo = (Quaternion<DoubleDouble>, [f64; 3]);

/// The turn and the rate, within so much.
struct TurnAndRate {
    within: f64,
}

impl Question for TurnAndRate {
    type Answer = TurnedTo;

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

/// cos θ of a body that has turned by `turn` (of any norm) since launch, with the `vertical` in BF at launch.
fn cos_tilt<N: Elementary>(turn: &Quaternion<N>, vertical: &[N; 3]) -> N {
    let [x, y, z] = quaternion::turned_normal(turn);
    let [up_x, up_y, up_z] = vertical.clone();
    (x * up_x + y * up_y + z * up_z) / norm_squared(turn)
}

#[cfg(test)]
mod tests;
