//! cos θ of the tosses that differ from one in a single input: over an interval of changes, and of a single change, in stages
//! of more and more digits.
//!
//! A ball that contains the whole interval gives a ball that contains cos θ. A Taylor model keeps how it depends on the
//! change as well, so that the interval may be far wider.

use std::cell::OnceCell;

use dynamics::{AngleUnit, Outcome, Toss};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, TaylorModel, WideBall};

use super::curve::Curve;
use super::tensor_toss::tensor;
use super::{cos_tilt, doubling};
use crate::flips::Enclosure;
use crate::given::{Vertical, inertia_ratio, right_to_25_u2, right_to_roundings, rounded, time_in_digits};
use crate::tilt_terms::{scaled_cos_tilt, sign_at_any_phase};

/// Digits of the stages after f64 and double-double. The last is for coins alone: of such inputs as f64 has, their smallest
/// cos θ that is not 0 is some 2^-2200.
const DIGITS: [usize; 4] = [256, 448, 960, 3072];

/// The work of an evaluation in each stage, roughly in units of 2 µs.
const WORK: [u32; 1 + DIGITS.len()] = [1, 8, 200, 400, 1000];
const WORK_OF_COIN: [u32; 2 + DIGITS.len()] = [1, 15, 600, 1000, 3000, 20_000];

/// How much more work a Taylor model by doubling is, of a body that was given by a tensor.
const WORK_OF_TENSOR: [u32; WORK.len()] = [30, 240, 6000, 12_000, 30_000];

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
    kind: Kind,
    input: Input,
    vertical: Vertical,
    rough: Stage<Ball<f64>>,
    fine: Stage<Ball<DoubleDouble>>,
    /// Those of more digits, made when they are needed.
    many: [OnceCell<Stage<WideBall>>; DIGITS.len()],
}

/// What the motion of a body is computed by.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// The three terms of cos θ, by Taylor models.
    Coin,
    /// Elliptic functions about the principal axes, by balls.
    Moments,
    /// Doubling in the frame of the tensor, by Taylor models.
    Tensor,
}

/// What a line is evaluated with in one kind of ball.
struct Stage<B> {
    /// The vertical seen from the body at launch.
    vertical: [B; 3],
    /// The time of flight is `mantissa` 2^`exponent` s.
    mantissa: B,
    exponent: i32,
    /// Changes of a rate are in units of 2^`change_exponent` rad/s.
    change_exponent: i32,
    /// The unit of the rates as they were given (rad/s).
    unit: B,
    /// I3/I1 of a coin.
    ratio: Option<B>,
    /// The motion, where the input does not change it.
    fixed: Option<Curve<B>>,
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
        let kind = match toss.coin() {
            Some(_) => Kind::Coin,
            None if toss.body.moments().is_none() => Kind::Tensor,
            None => Kind::Moments,
        };
        let time: dynamics::time_of_flight::ExactTime = toss.launch.time_of_flight().into();
        let mantissa = right_to_25_u2(time.mantissa());
        let unit = match toss.launch.given_rate().1 {
            AngleUnit::RADIAN => mantissa.like(1.0),
            unit => mantissa.like_big(&unit.in_digits(160)),
        };
        let ratio = toss.coin().map(|toss| inertia_ratio(&toss.coin));
        let in_double_double = vertical.in_double_double(&toss.launch.attitude());
        let (exponent, change_exponent) = (time.exponent(), if input == Input::Time { 0 } else { -time.exponent() });
        let fine = Stage { vertical: in_double_double, mantissa, exponent, change_exponent, unit, ratio, fixed: None };
        let rough = Stage {
            vertical: fine.vertical.each_ref().map(rounded),
            mantissa: rounded(&fine.mantissa),
            exponent,
            change_exponent,
            unit: rounded(&fine.unit),
            ratio: fine.ratio.as_ref().map(rounded),
            fixed: None,
        };
        let (rough, fine) = (rough.with_curve(toss, input), fine.with_curve(toss, input));
        Self { toss, kind, input, vertical, rough, fine, many: Default::default() }
    }

    /// Changes of the input are in units of 2 to this power: those of a rate in turns of the launch, up to a factor.
    pub(crate) fn change_exponent(&self) -> i32 {
        self.fine.change_exponent
    }

    /// The work of an evaluation in each stage.
    pub(crate) fn work(&self) -> &'static [u32] {
        match self.kind {
            Kind::Coin => &WORK_OF_COIN,
            Kind::Moments => &WORK,
            Kind::Tensor => &WORK_OF_TENSOR,
        }
    }

    /// cos θ, or a positive multiple of it, at all changes within `radius` of `change`, in a stage.
    pub(crate) fn enclosure(&self, stage: usize, change: f64, radius: f64) -> Enclosure {
        let interval = [change, radius];
        match stage {
            0 => self.rough.enclosure(self, interval),
            1 => self.fine.enclosure(self, interval),
            // More digits tell the outcome of a toss; over an interval of tosses, double-double has enough.
            _ if self.kind == Kind::Tensor && radius > 0.0 => Enclosure::OF_ANYTHING,
            _ => {
                let (digits, made) = (DIGITS[stage - 2], &self.many[stage - 2]);
                made.get_or_init(|| Stage::in_digits(self, digits)).enclosure(self, interval)
            }
        }
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
}

impl<B: Elementary> Stage<B> {
    /// The same stage with the motion, where the input does not change it.
    fn with_curve(mut self, toss: &Toss, input: Input) -> Self {
        if input == Input::Time && toss.body.moments().is_some() && self.ratio.is_none() {
            self.fixed = self.curve(toss, input, 0.0, 0.0);
        }
        self
    }

    /// cos θ, or a positive multiple of it, over an interval of changes.
    fn enclosure(&self, line: &Line<'_>, interval: [f64; 2]) -> Enclosure {
        let of_ball = |ball: Option<B>| ball.map_or(Enclosure::OF_ANYTHING, |ball| Enclosure::of_ball(&ball));
        let (toss, input) = (line.toss, line.input);
        match line.kind {
            Kind::Moments => of_ball(self.height(toss, input, interval)),
            _ if interval[1] == 0.0 => of_ball(self.given(toss, input, interval, |part, _| part).landed(toss)),
            _ => {
                let given = self.given(toss, input, interval, TaylorModel::variable);
                if let Some(sign) = given.sign_at_any_time() {
                    return Enclosure::of_sign(sign);
                }
                given.landed(toss).map_or(Enclosure::OF_ANYTHING, |model| Enclosure::of_model(&model))
            }
        }
    }

    /// The motion for a ball of changes.
    fn curve(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> Option<Curve<B>> {
        Curve::new(&toss.body, &self.rates(toss, input, change, radius))
    }

    /// The rates (BF) for a ball of changes, in a unit near the largest.
    fn rates(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> [B; 3] {
        let exponent = self.unit_exponent(toss, input, change);
        let number = |value: f64| self.mantissa.like(value).times_power_of_two(-exponent);
        let (rate, unit) = toss.launch.given_rate();
        let of_unit =
            |value: f64| if unit == AngleUnit::RADIAN { number(value) } else { number(value) * self.unit.clone() };
        let mut rates = [0, 1, 2].map(|axis: usize| of_unit(rate[axis]));
        if let Input::Rate(axis) = input {
            let in_unit = |value: f64| self.mantissa.like(value).times_power_of_two(self.change_exponent - exponent);
            rates[axis] = (rates[axis].clone() + in_unit(change)).widened(in_unit(radius).to_f64());
        }
        rates
    }

    /// What was given, in numbers that `number` makes of a value and of how far the change takes it: a Taylor model, because
    /// the motion forgets how a ball depends on the change.
    fn given<N: Elementary>(
        &self,
        toss: &Toss,
        input: Input,
        [change, radius]: [f64; 2],
        number: fn(B, B) -> N,
    ) -> Given<N> {
        let exponent = self.unit_exponent(toss, input, change);
        let part = |value: f64, exponent: i32| self.mantissa.like(value).times_power_of_two(exponent);
        let fixed = |value: B| number(value.clone(), value.like(0.0));
        let values = self.rates(toss, input, change, 0.0);
        let mut rate = values.clone().map(fixed);
        let mut time = self.mantissa.times_power_of_two(self.exponent + exponent);
        let mut width = part(0.0, 0);
        match input {
            Input::Rate(axis) => {
                rate[axis] = number(values[axis].clone(), part(radius, self.change_exponent - exponent));
            }
            Input::Time => (time, width) = (time + part(change, exponent), part(radius, exponent)),
        }
        let ratio = self.ratio.clone().map(fixed);
        Given { rate, time: number(time, width), vertical: self.vertical.clone().map(fixed), ratio }
    }

    /// Exponent of the unit of the rates, a power of two near the largest.
    fn unit_exponent(&self, toss: &Toss, input: Input, change: f64) -> i32 {
        let changed = matches!(input, Input::Rate(_)).then(|| change.abs().times_power_of_two(self.change_exponent));
        mantissa_and_exponent(power_of_two_scale(toss.launch.rate().amax().max(changed.unwrap_or(0.0)))).1
    }

    /// cos θ for all changes within `radius` of `change`.
    fn height(&self, toss: &Toss, input: Input, [change, radius]: [f64; 2]) -> Option<B> {
        let exponent = self.unit_exponent(toss, input, change);
        let time = self.mantissa.times_power_of_two(self.exponent + exponent);
        let turn = if input == Input::Time {
            let change = time.like(change).widened(radius).times_power_of_two(exponent);
            self.fixed.as_ref()?.turn(&(time + change))
        } else {
            self.curve(toss, input, change, radius)?.turn(&time)
        };
        Some(cos_tilt(&turn, &self.vertical))
    }
}

impl Stage<WideBall> {
    fn in_digits(line: &Line<'_>, digits: usize) -> Self {
        let toss = line.toss;
        let ratio = toss.coin().map(|toss| right_to_roundings(toss.coin.inertia_ratio_in_digits(digits), digits));
        let stage = Self {
            vertical: line.vertical.in_digits(&toss.launch.attitude(), digits),
            mantissa: time_in_digits(&toss.launch, digits),
            exponent: 0,
            change_exponent: line.fine.change_exponent,
            unit: right_to_roundings(toss.launch.given_rate().1.in_digits(digits), digits),
            ratio,
            fixed: None,
        };
        stage.with_curve(toss, line.input)
    }
}

/// What was given of a toss and a change of it, in numbers of one kind.
struct Given<N> {
    /// ω (BF), in a unit near the largest component.
    rate: [N; 3],
    /// In the inverse of that unit.
    time: N,
    /// The vertical seen from the body at launch (BF).
    vertical: [N; 3],
    /// I3/I1 of a coin.
    ratio: Option<N>,
}

impl<N: Elementary> Given<N> {
    /// (ωx, ωy, k ωz) of a coin.
    fn momentum(&self) -> Option<[N; 3]> {
        let [x, y, z] = self.rate.clone();
        Some([x, y, self.ratio.clone()? * z])
    }

    /// The sign of cos θ of a coin whose normal stays above or below the horizontal for ever.
    fn sign_at_any_time(&self) -> Option<f64> {
        sign_at_any_phase(&self.momentum()?, &self.vertical)
    }

    /// cos θ, or a positive multiple of it.
    fn landed(self, toss: &Toss) -> Option<N> {
        if let Some(momentum) = self.momentum() {
            // Far from the smallest f64, in which the bounds of a Taylor model end.
            let exponent = if self.time.digits() > DoubleDouble::ZERO.digits() { 600 } else { 0 };
            let vertical = self.vertical.map(|part| part.times_power_of_two(exponent));
            return Some(scaled_cos_tilt(&momentum, &self.time, vertical));
        }
        let turn = doubling::Curve::new(tensor(toss, &self.time), self.rate).turn(&self.time)?;
        Some(cos_tilt(&turn, &self.vertical))
    }
}

#[cfg(test)]
mod tests;
