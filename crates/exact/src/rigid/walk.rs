//! The search for flips along one input of a toss, by balls that contain whole intervals of it.

use dynamics::time_of_flight::ExactTime;
use dynamics::{Outcome, RigidToss};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary};

use super::certified::rounded;
use super::cos_tilt;
use super::curve::Curve;

/// Width of the interval that a flip is known to lie in, in parts of its distance; also the shortest step.
const RESOLUTION: f64 = 2.5e-13;

/// The steps that a search may take: some tenths of a second.
pub(super) const MOST_STEPS: u32 = 100_000;

/// |cos θ| below which a step is tried in double-double if f64 does not decide it.
const SMALL: f64 = 1e-6;

/// An input of a toss.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Input {
    /// A component of the rate (BF, rad/s).
    Rate(usize),
    /// The time of flight (s).
    Time,
}

/// The tosses that differ from one in a single input.
pub(super) struct Line<'a> {
    toss: &'a RigidToss,
    input: Input,
    vertical: [Ball<DoubleDouble>; 3],
    time: ExactTime,
    /// The motion, where the input does not change it.
    rough: Option<Curve<Ball<f64>>>,
    fine: Option<Curve<Ball<DoubleDouble>>>,
}

impl<'a> Line<'a> {
    pub(super) fn new(toss: &'a RigidToss, input: Input) -> Self {
        // The vertical to 2^-67.
        const VERTICAL: f64 = 6.776_263_578_034_403e-21;
        let vertical = toss.launch.attitude().exact_vertical().map(|part| Ball::new(part, VERTICAL));
        let time = toss.launch.time_of_flight().into();
        let mut line = Self { toss, input, vertical, time, rough: None, fine: None };
        if input == Input::Time {
            line.rough = line.curve(0.0, 0.0, &0.0);
            line.fine = line.curve(0.0, 0.0, &DoubleDouble::ZERO);
        }
        line
    }

    /// Exponent of the unit of the rates, a power of two near the largest.
    fn exponent(&self, change: f64) -> i32 {
        let moved = if let Input::Rate(_) = self.input { change.abs() } else { 0.0 };
        mantissa_and_exponent(power_of_two_scale(self.toss.launch.rate().amax().max(moved))).1
    }

    /// The motion for a ball of changes.
    fn curve<N: Elementary>(&self, change: f64, radius: f64, like: &N) -> Option<Curve<Ball<N>>> {
        let exponent = self.exponent(change);
        let number = |value: f64| Ball::new(like.like(value), 0.0).times_power_of_two(-exponent);
        // A rate that was not given in rad/s has a second part, and an error of 16 u²; a tiny one has lost digits.
        let mut rates = self.toss.launch.exact_rate().map(|part| match [part.hi(), part.lo()] {
            [0.0, _] => Ball::new(like.like(0.0), 0.0),
            [leading, 0.0] => number(leading),
            [leading, rest] => {
                let relative = 2f64.powi(if leading.abs() < 1e-250 { -50 } else { -101 });
                let error = number(leading).to_f64().abs() * relative;
                (number(leading) + number(rest)).widened(error)
            }
        });
        if let Input::Rate(axis) = self.input {
            let width = radius * 2f64.powi(-exponent);
            rates[axis] = (rates[axis].clone() + number(change)).widened(width);
        }
        Curve::new(&self.toss.body, &rates)
    }

    /// cos θ for all changes within `radius` of `change`, by the motion `fixed` if the input does not change it.
    fn height<N: Elementary>(
        &self,
        [change, radius]: [f64; 2],
        vertical: &[Ball<N>; 3],
        fixed: Option<&Curve<Ball<N>>>,
    ) -> Option<Ball<N>> {
        let like = vertical[0].midpoint();
        let exponent = self.exponent(change);
        // 2^-97 of the time is its own error.
        let time = Ball::new(like.like_big(&self.time.mantissa().to_big()), 0.0);
        let time = time.times_power_of_two(self.time.exponent() + exponent);
        let own = time.to_f64() * (2.0 * f64::EPSILON * f64::from(u8::from(like.digits() == 53)) + 2f64.powi(-97));
        let time = time.widened(own);
        let (turn, moved);
        match (self.input, fixed) {
            (Input::Time, Some(curve)) => {
                let change = Ball::new(like.like(change), radius).times_power_of_two(exponent);
                moved = time + change;
                turn = curve.turn(&moved);
            }
            (Input::Time, None) => return None,
            (Input::Rate(_), _) => turn = self.curve(change, radius, like)?.turn(&time),
        }
        Some(cos_tilt(&turn, vertical))
    }

    /// The sign of cos θ at all changes within `radius` of `change`: 0 if it is not proven.
    fn sign(&self, change: f64, radius: f64) -> f64 {
        let vertical = self.vertical.each_ref().map(rounded);
        let rough = self.height([change, radius], &vertical, self.rough.as_ref());
        if let Some(rough) = rough {
            if rough.has_sign() {
                return rough.sign();
            }
            // A ball that is much wider than that of one toss is not helped by more digits.
            if rough.midpoint().abs() > SMALL {
                return 0.0;
            }
        }
        match self.height([change, radius], &self.vertical, self.fine.as_ref()) {
            Some(fine) if fine.has_sign() => fine.sign(),
            _ => 0.0,
        }
    }

    /// The outcome of the toss with this change.
    pub(super) fn outcome_at(&self, change: f64) -> Outcome {
        Outcome::of(self.sign(change, 0.0), 0.0)
    }
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// At a flip, at this distance.
    Flip(f64),
    /// At the limit.
    Limit,
    /// For want of steps or digits, at this distance.
    Spent(f64),
}

/// A search in one direction.
pub(super) struct Walk<'a> {
    line: &'a Line<'a>,
    sign: f64,
    sense: f64,
    /// Where the walk begins, as a change of the input.
    origin: f64,
    distance: f64,
    step: f64,
    limit: f64,
    /// What is added to the distance before the resolution is taken of it.
    offset: f64,
    steps: u32,
}

impl<'a> Walk<'a> {
    /// From the toss of the line, which lands with `outcome`, up to `limit`.
    pub(super) fn new(line: &'a Line<'a>, outcome: Outcome, sense: f64, limit: f64, offset: f64) -> Self {
        let sign = match outcome {
            Outcome::Heads => 1.0,
            Outcome::Tails => -1.0,
            Outcome::Undecided => 0.0,
        };
        Self { line, sign, sense, origin: 0.0, distance: 0.0, step: limit / 64.0, limit, offset, steps: 0 }
    }

    /// The same walk from another change of the input.
    pub(super) fn starting_at(self, origin: f64) -> Self {
        Self { origin, ..self }
    }

    /// Goes on to the next flip. The distances that it returns are from the toss of the line.
    pub(super) fn next_flip(&mut self) -> End {
        while self.distance < self.limit {
            self.steps += 1;
            if self.steps > MOST_STEPS || self.sign == 0.0 || self.step < f64::MIN_POSITIVE {
                return End::Spent(self.origin + self.distance);
            }
            let step = self.step.min(self.limit - self.distance);
            let middle = self.origin + self.sense * (self.distance + 0.5 * step);
            // The middle is rounded, and so are both ends.
            let radius = 0.5 * step + 2.0 * f64::EPSILON * (middle.abs() + step);
            if self.line.sign(middle, radius) == self.sign {
                self.distance += step;
                self.step = 1.5 * step;
                continue;
            }
            let shortest = RESOLUTION * (self.offset + self.distance);
            self.step = 0.5 * step;
            if step <= shortest {
                self.distance += step;
                self.step = step;
                let sign = self.line.sign(self.origin + self.sense * self.distance, 0.0);
                if sign == -self.sign {
                    self.sign = sign;
                    return End::Flip(self.origin + self.distance);
                }
            }
        }
        End::Limit
    }
}
