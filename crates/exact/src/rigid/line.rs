//! cos θ of the tosses that differ from one in a single input: over an interval of changes, and of a single change, in stages
//! of more and more digits.
//!
//! A coin has the three terms of its cos θ, another body its turn. Both are taken over Taylor models, which keep how cos θ
//! depends on the change, so that the interval may be far wider than that of a ball.

use std::cell::OnceCell;

use dynamics::time_of_flight::ExactTime;
use dynamics::{Outcome, Toss};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, TaylorModel, WideBall};

use super::cos_tilt;
use super::given::Given;
use super::quaternion::Quaternion;
use super::special::Special;
use crate::flips::Enclosure;
use crate::given::{Vertical, inertia_ratio, right_to_roundings, rounded};
use crate::tilt_terms::{scaled_cos_tilt, sign_at_any_phase};

/// Digits of the stages after f64 and double-double. The last is for coins alone: of such inputs as f64 has, their smallest
/// cos θ that is not 0 is some 2^-2200.
const DIGITS: [usize; 4] = [256, 448, 960, 3072];

/// The work of an evaluation in each stage, roughly in units of 2 µs.
const WORK: [u32; 1 + DIGITS.len()] = [30, 240, 6000, 1000, 2000];
const WORK_OF_COIN: [u32; 2 + DIGITS.len()] = [1, 15, 600, 1000, 3000, 20_000];

/// An input of a toss.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Input {
    /// A component of the rate (BF, rad/s).
    Rate(usize),
    /// The time of flight (s).
    Time,
}

/// The tosses that differ from one in a single input.
pub(crate) struct Line<'a> {
    toss: &'a Toss,
    input: Input,
    vertical: Vertical,
    /// The special motion that all these tosses have, of a body that is not a coin.
    special: Option<Special>,
    /// Changes of a rate are in units of 2^`change_exponent` rad/s.
    change_exponent: i32,
    rough: Stage<Ball<f64>>,
    fine: Stage<Ball<DoubleDouble>>,
    /// Those of more digits, made when they are needed.
    many: [OnceCell<Stage<WideBall>>; DIGITS.len()],
}

/// What was given, in numbers of one kind.
struct Stage<N> {
    given: Given<N>,
    /// I3/I1 of a coin.
    ratio: Option<N>,
}

impl<'a> Line<'a> {
    pub(crate) fn new(toss: &'a Toss, input: Input) -> Self {
        Self::along(Vertical::Own, toss, input)
    }

    /// The line of a toss whose launch is turned by a quarter of a turn about the lab's x axis.
    pub(crate) fn quarter_turned(toss: &'a Toss) -> Self {
        Self::along(Vertical::QuarterTurned, toss, Input::Time)
    }

    fn along(vertical: Vertical, toss: &'a Toss, input: Input) -> Self {
        let coin = toss.coin();
        let special = if coin.is_some() { None } else { special(toss, input) };
        let given = Given::in_double_double(toss, None).seen_along(vertical.in_double_double(&toss.launch.attitude()));
        let fine = Stage { given, ratio: coin.map(|toss| inertia_ratio(&toss.coin)) };
        let rough = Stage { given: fine.given.map(rounded), ratio: fine.ratio.as_ref().map(rounded) };
        let exponent = ExactTime::from(toss.launch.time_of_flight()).exponent();
        let change_exponent = if input == Input::Time { 0 } else { -exponent };
        Self { toss, input, vertical, special, change_exponent, rough, fine, many: Default::default() }
    }

    /// Changes of the input are in units of 2 to this power: those of a rate in turns of the launch, up to a factor.
    pub(crate) fn change_exponent(&self) -> i32 {
        self.change_exponent
    }

    /// The work of an evaluation in each stage.
    pub(crate) fn work(&self) -> &'static [u32] {
        if self.is_of_coins() { &WORK_OF_COIN } else { &WORK }
    }

    /// The stages that are worth their work over an interval. The others tell the outcome of a toss.
    pub(crate) fn interval_stages(&self) -> usize {
        if self.is_of_coins() { WORK_OF_COIN.len() } else { 3 }
    }

    fn is_of_coins(&self) -> bool {
        self.fine.ratio.is_some()
    }

    /// cos θ, or a positive multiple of it, at all changes within `radius` of `change`, in a stage.
    pub(crate) fn enclosure(&self, stage: usize, change: f64, radius: f64) -> Enclosure {
        let interval = [change, radius];
        match stage {
            0 => self.enclosure_in(&self.rough, interval),
            1 => self.enclosure_in(&self.fine, interval),
            _ => {
                let (digits, made) = (DIGITS[stage - 2], &self.many[stage - 2]);
                self.enclosure_in(made.get_or_init(|| self.in_digits(digits)), interval)
            }
        }
    }

    /// The error of the narrowest interval at a change, which is that of rounding. A Taylor model by doubling has more of it than
    /// a toss, so that the model is asked.
    pub(crate) fn rounding(&self, stage: usize, change: f64) -> f64 {
        let radius = if self.is_of_coins() { 0.0 } else { f64::MIN_POSITIVE };
        self.enclosure(stage, change, radius).error()
    }

    /// The sign of cos θ for this change, 0 if no stage decides it. `work` is added to.
    pub(crate) fn sign_at(&self, change: f64, work: &mut u32) -> f64 {
        let sign = |(stage, of_stage): (usize, &u32)| {
            *work += of_stage;
            self.enclosure(stage, change, 0.0).sign()
        };
        self.work().iter().enumerate().map(sign).find(|sign| *sign != 0.0).unwrap_or(0.0)
    }

    /// The outcome of the toss with this change.
    pub(crate) fn outcome_at(&self, change: f64) -> Outcome {
        Outcome::of(self.sign_at(change, &mut 0), 0.0)
    }

    fn in_digits(&self, digits: usize) -> Stage<WideBall> {
        let given = Given::in_digits(self.toss, None, digits);
        let ratio = self.toss.coin().map(|toss| toss.coin.inertia_ratio_in_digits(digits));
        Stage {
            given: given.seen_along(self.vertical.in_digits(&self.toss.launch.attitude(), digits)),
            ratio: ratio.map(|ratio| right_to_roundings(ratio, digits)),
        }
    }

    /// cos θ, or a positive multiple of it, over an interval of changes.
    fn enclosure_in<N: Elementary>(&self, stage: &Stage<N>, [change, radius]: [f64; 2]) -> Enclosure {
        let moved = self.moved(&stage.given, change);
        if radius == 0.0 {
            let toss = Stage { given: moved, ratio: stage.ratio.clone() };
            let turn = |given: &Given<N>| given.turn(self.special);
            return toss.landed(turn).map_or(Enclosure::OF_ANYTHING, |ball| Enclosure::of_ball(&ball));
        }
        let constant = |part: &N| TaylorModel::constant(part.clone());
        let models = Stage { given: self.models(&moved, radius), ratio: stage.ratio.as_ref().map(constant) };
        if let Some(sign) = models.sign_at_any_time() {
            return Enclosure::of_sign(sign);
        }
        let turn = |given: &Given<TaylorModel<N>>| given.turn_over_interval(self.special);
        models.landed(turn).map_or(Enclosure::OF_ANYTHING, |model| Enclosure::of_model(&model))
    }

    /// What is given of all changes within `radius`, as Taylor models: the motion forgets how a ball depends on the change.
    fn models<N: Elementary>(&self, given: &Given<N>, radius: f64) -> Given<TaylorModel<N>> {
        let mut models = given.map(|part| TaylorModel::constant(part.clone()));
        match self.input {
            Input::Rate(axis) => {
                models.rate[axis] = TaylorModel::variable(given.rate[axis].clone(), self.change_of_rate(given, radius));
            }
            Input::Time => {
                let width = given.time_in_unit(&given.time.like(radius));
                models.time = TaylorModel::variable(given.time.clone(), width);
            }
        }
        models
    }

    /// What is given of the toss with this change, in a unit near the largest rate.
    fn moved<N: Elementary>(&self, given: &Given<N>, change: f64) -> Given<N> {
        let mut moved = given.clone();
        match self.input {
            Input::Rate(axis) => {
                let largest = self.toss.launch.rate().amax().max(change.abs().times_power_of_two(self.change_exponent));
                moved = moved.with_exponent(mantissa_and_exponent(power_of_two_scale(largest)).1);
                moved.rate[axis] = moved.rate[axis].clone() + self.change_of_rate(&moved, change);
            }
            Input::Time => moved.time = moved.time.clone() + moved.time_in_unit(&given.time.like(change)),
        }
        moved
    }

    /// A change of a rate in the unit of the rates that are `given`.
    fn change_of_rate<N: Elementary>(&self, given: &Given<N>, change: f64) -> N {
        given.time.like(change).times_power_of_two(self.change_exponent - given.exponent) / given.unit.clone()
    }
}

/// The special motion of a toss that is kept when the input changes.
fn special(toss: &Toss, input: Input) -> Option<Special> {
    let Input::Rate(axis) = input else { return Special::at_sight(toss).or_else(|| Special::of(toss)) };
    let (rate, _) = toss.launch.given_rate();
    let spins_about = |axis: usize| (0..3).all(|other| other == axis || rate[other] == 0.0);
    Special::at_sight(toss).filter(|special| match special {
        Special::Symmetric(_) => true,
        Special::Spin => toss.body.moments().is_some() && spins_about(axis),
        Special::Separatrix => false,
    })
}

impl<N: Elementary> Stage<N> {
    /// (ωx, ωy, k ωz) of a coin.
    fn momentum(&self) -> Option<[N; 3]> {
        let [x, y, z] = self.given.rate.clone();
        Some([x, y, self.ratio.clone()? * z])
    }

    /// The sign of cos θ of a coin whose normal stays above or below the horizontal for ever.
    fn sign_at_any_time(&self) -> Option<f64> {
        sign_at_any_phase(&self.momentum()?, &self.given.vertical)
    }

    /// cos θ, or a positive multiple of it; of a body that is not a coin by its `turn`.
    fn landed(&self, turn: impl Fn(&Given<N>) -> Option<Quaternion<N>>) -> Option<N> {
        let Some(momentum) = self.momentum() else {
            return turn(&self.given).map(|turn| cos_tilt(&turn, &self.given.vertical));
        };
        // Far from the smallest f64, in which the bounds of a Taylor model end.
        let exponent = if self.given.time.digits() > DoubleDouble::ZERO.digits() { 600 } else { 0 };
        let vertical = self.given.vertical.clone().map(|part| part.times_power_of_two(exponent));
        Some(scaled_cos_tilt(&momentum, &self.given.time, vertical))
    }
}

#[cfg(test)]
mod tests;
