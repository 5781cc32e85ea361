//! The ground truth: the motion of any rigid body by Taylor series, in the frame and by the numbers in which it was given.
//!
//! It integrates Euler's equations and the attitude,
//!
//! ```text
//! J ω' = Jω × ω,    Q' = ½ Q (0, ω),
//! ```
//!
//! with ω in units of |ω| at launch, so that the time is an angle and no rate is too slow or too fast. The first equation
//! is ωi' = Σ Bijk ωj ωk. J⁻¹ appears in the coefficients B alone, which come from the exact elements of J, so that a thin
//! body costs no digits. There are no principal axes, no elliptic functions and no case for equal moments.
//!
//! # Its error
//! Numbers have 290 binary digits behind the point. What is given is rounded to 256 digits. A step leaves out less than
//! 2^-220. No coupling of a body is above 1 and |ω| grows to √2 at most, so that an error grows by exp(√2 t) at most, over
//! a phase t. Up to 40 rad, which is a factor of 2^82, the error is therefore below 2^-120. A longer flight is flown again,
//! with another order and with all that is not 0 changed by as much as its rounding: the two landings say how far the
//! error has grown. Energy and momentum have to stay within 2^-200 on every flight.
//!
//! [`fly`] gives no landing where its error is above [`LARGEST_ERROR`].

use std::sync::LazyLock;

use dynamics::Toss;

use super::fixed::{DIGITS, Fixed, Sum};
use super::{Big, PRECISION, big, exactly, rotated, to_f64};

/// The longest flight (rad).
pub(super) const LONGEST: f64 = 1000.0;

/// The longest flight (rad) whose error has a bound without a second flight.
const SHORT: f64 = 40.0;

/// The largest error of a landing, 2^-110.
pub(super) const LARGEST_ERROR: f64 = 7.703_719_777_548_943e-34;

/// The error of a [`SHORT`] flight, 2^-120.
const ERROR_OF_SHORT: f64 = 7.523_163_845_262_64e-37;

/// How far energy and momentum may drift in units of those at launch, 2^-200.
const LARGEST_DRIFT: f64 = 6.223_015_277_861_142e-61;

/// The orders of the two flights.
const ORDERS: [usize; 2] = [72, 64];

/// What a step may leave out, 2^-220.
const LEFT_OUT: f64 = 5.934_729_841_099_873e-67;

/// The longest step (rad).
const LONGEST_STEP: f64 = 1.0;

pub(super) struct Flown {
    /// The turn since launch, as a unit quaternion from the body at landing to the body at launch.
    pub(super) turn: [Big; 4],
    /// ω at landing (rad/s).
    pub(super) rate: [Big; 3],
    /// Bound of the error of each component of the turn, and of the rate in units of |ω| at launch.
    pub(super) error: f64,
}

/// The landing of a body with this inertia `tensor`, in any unit, at this `rate` (rad/s) after this `time` (s). `None`
/// where a landing can't be vouched for.
pub(super) fn fly(tensor: &[[Big; 3]; 3], rate: &[Big; 3], time: &Big) -> Option<Flown> {
    let size = rate.iter().fold(big(0.0), |sum, part| sum + part * part).sqrt();
    let identity = || [1.0, 0.0, 0.0, 0.0].map(big);
    if size == Big::ZERO || *time == Big::ZERO {
        return Some(Flown { turn: identity(), rate: rate.clone(), error: 0.0 });
    }
    let (unit, phase) = (rate.each_ref().map(|part| part / &size), &size * time);
    let length = to_f64(&phase);
    if length > LONGEST {
        return None;
    }
    let motion = Motion::new(tensor)?;
    let landed = |unit: &[Big; 3], phase: &Big, order: usize| -> Option<State> {
        let [x, y, z] = unit.each_ref().map(Fixed::new);
        let landed = motion.flown([x?, y?, z?], Fixed::new(phase)?, order);
        (drift(tensor, unit, &landed) < LARGEST_DRIFT).then_some(landed)
    };
    let first = landed(&unit, &phase, ORDERS[0])?;
    let error = if length <= SHORT {
        ERROR_OF_SHORT
    } else {
        let second = landed(&unit.each_ref().map(disturbed), &disturbed(&phase), ORDERS[1])?;
        16.0 * first.distance(&second)
    };
    let State { rate, turn } = first;
    let rate = rate.map(|part| part * &size);
    (error < LARGEST_ERROR).then(|| Flown { turn: super::normalised(turn), rate, error })
}

/// A number that is not 0, changed by more than its rounding to 256 digits and to those of [`Fixed`].
fn disturbed(value: &Big) -> Big {
    let last = (big(1.0) >> (DIGITS.cast_signed() - 2)) + (value.clone() >> (PRECISION.cast_signed() - 6));
    if *value == Big::ZERO { value.clone() } else { value + last }
}

/// The larger one of the drifts of energy and momentum, in units of those of a body that turns as fast about its largest
/// axis.
fn drift(tensor: &[[Big; 3]; 3], launched: &[Big; 3], State { rate, turn }: &State) -> f64 {
    let momentum = |rate: &[Big; 3]| {
        tensor.each_ref().map(|row| row.iter().zip(rate).fold(big(0.0), |sum, (element, part)| sum + element * part))
    };
    let energy =
        |rate: &[Big; 3]| rate.iter().zip(momentum(rate)).fold(big(0.0), |sum, (part, other)| sum + part * other);
    let size = tensor.iter().flatten().map(|element| to_f64(element).abs()).fold(0.0, f64::max);
    let of_energy = energy(rate) - energy(launched);
    let turned = rotated(turn, &momentum(rate));
    let of_momentum = turned.iter().zip(momentum(launched)).map(|(now, before)| now - before);
    of_momentum.chain([of_energy]).map(|drift| to_f64(&(drift / big(size))).abs()).fold(0.0, f64::max)
}

/// A body in motion: ω in units of that at launch, and the turn since launch.
struct State {
    rate: [Big; 3],
    turn: [Big; 4],
}

impl State {
    fn distance(&self, other: &Self) -> f64 {
        let off = |(a, b): (&Big, &Big)| to_f64(&(a - b)).abs();
        let (rates, turns) = (self.rate.iter().zip(&other.rate), self.turn.iter().zip(&other.turn));
        rates.chain(turns).map(off).fold(0.0, f64::max)
    }
}

/// The products of two components of ω on which ω' depends.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// Euler's equations: the coefficient of each of the [`PAIRS`] in ω1', ω2' and ω3'.
struct Motion([[Fixed; 6]; 3]);

impl Motion {
    fn new(tensor: &[[Big; 3]; 3]) -> Option<Self> {
        let cofactors = cofactors(tensor);
        let determinant = dot(&solid(tensor)[0], &cofactors[0]).with_precision(PRECISION).value();
        let torques = torques(tensor);
        let mut coefficients = [[Fixed::ZERO; 6]; 3];
        for (row, by_axis) in coefficients.iter_mut().zip(&cofactors) {
            for (pair, coefficient) in row.iter_mut().enumerate() {
                let above = dot(by_axis, &torques.each_ref().map(|torque| torque[pair].clone()));
                *coefficient = Fixed::new(&(above.with_precision(PRECISION).value() / &determinant))?;
            }
        }
        Some(Self(coefficients))
    }

    /// Flies for `phase` (rad) from `rate`, by series of `order`.
    fn flown(&self, mut rate: [Fixed; 3], phase: Fixed, order: usize) -> State {
        let mut turn = [Fixed::ONE, Fixed::ZERO, Fixed::ZERO, Fixed::ZERO];
        let (mut left, mut planned) = (phase, 0.25);
        while left != Fixed::ZERO {
            let span = if left.size() <= planned { left } else { Fixed::of_few_digits(planned) };
            let series = Series::new(self, rate, turn, span, order);
            let reach = series.reach();
            let part = Fixed::of_few_digits(reach.min(1.0));
            (rate, turn) = (series.rate.each_ref().map(|s| at(s, &part)), series.turn.each_ref().map(|s| at(s, &part)));
            left = if reach >= 1.0 { left.plus(span.minus()) } else { left.plus(span.times(part).minus()) };
            planned = (0.97 * reach * span.size()).clamp(0.01, LONGEST_STEP);
        }
        State { rate: rate.map(Fixed::to_big), turn: turn.map(Fixed::to_big) }
    }
}

/// The tensor with the moment of a rod about its own axis as 1 instead of 0. No torque acts about that axis, because
/// the other two moments are equal, so that any number will do.
fn solid(tensor: &[[Big; 3]; 3]) -> [[Big; 3]; 3] {
    let mut solid = tensor.clone();
    (0..3).filter(|axis| tensor[*axis][*axis] == Big::ZERO).for_each(|axis| solid[axis][axis] = exactly(1.0));
    solid
}

fn dot(a: &[Big; 3], b: &[Big; 3]) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// J⁻¹ times its determinant.
fn cofactors(tensor: &[[Big; 3]; 3]) -> [[Big; 3]; 3] {
    let t = solid(tensor);
    let next = |axis: usize| ((axis + 1) % 3, (axis + 2) % 3);
    [0, 1, 2].map(|row| {
        [0, 1, 2].map(|column| {
            let ((a, b), (c, d)) = (next(row), next(column));
            &t[a][c] * &t[b][d] - &t[a][d] * &t[b][c]
        })
    })
}

/// The coefficients of each of the [`PAIRS`] in the components of Jω × ω.
fn torques(tensor: &[[Big; 3]; 3]) -> [[Big; 6]; 3] {
    let place = |a: usize, b: usize| PAIRS.iter().position(|pair| *pair == [a.min(b), a.max(b)]).unwrap_or(0);
    [0, 1, 2].map(|axis| {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut torque = [0.0; 6].map(exactly);
        for index in 0..3 {
            torque[place(index, b)] += &tensor[a][index];
            torque[place(index, a)] -= &tensor[b][index];
        }
        torque
    })
}

/// 1, 1/2, 1/3, ..., by which coefficients are multiplied where a series is integrated.
static INVERSES: LazyLock<Vec<Fixed>> = LazyLock::new(|| {
    let inverse = |number: usize| Fixed::new(&(big(1.0) / big(number as f64))).unwrap_or(Fixed::ONE);
    (1..=ORDERS[0]).map(inverse).collect()
});

/// The coefficients of a step, multiplied by powers of its length.
struct Series {
    rate: [Vec<Fixed>; 3],
    turn: [Vec<Fixed>; 4],
}

impl Series {
    fn new(motion: &Motion, rate: [Fixed; 3], turn: [Fixed; 4], span: Fixed, order: usize) -> Self {
        let half = span.times(Fixed::of_few_digits(0.5));
        let motion = motion.0.map(|row| row.map(|coefficient| coefficient.times(span)));
        let mut series = Self { rate: rate.map(|part| vec![part]), turn: turn.map(|part| vec![part]) };
        let mut halves = rate.map(|part| vec![part.times(half)]);
        for index in 0..order {
            let products = PAIRS.map(|[a, b]| product_of(&series.rate[a], &series.rate[b], a == b));
            let turned = turned(&series.turn, &halves);
            let part_of = INVERSES[index];
            for axis in 0..3 {
                let mut sum = Sum::default();
                motion[axis].iter().zip(&products).for_each(|(coefficient, product)| sum.add(coefficient, product));
                let part = sum.rounded().times(part_of);
                series.rate[axis].push(part);
                halves[axis].push(part.times(half));
            }
            series.turn.iter_mut().zip(turned).for_each(|(parts, part)| parts.push(part.times(part_of)));
        }
        series
    }

    /// The part of the step up to which the series leaves out less than [`LEFT_OUT`], judged by its last two terms.
    fn reach(&self) -> f64 {
        let order = self.rate[0].len() - 1;
        let reach = |index: usize| {
            let largest = self.rate.iter().chain(&self.turn).map(|parts| parts[index].size()).fold(0.0, f64::max);
            (LEFT_OUT / largest).powf(1.0 / index as f64)
        };
        reach(order - 1).min(reach(order))
    }
}

/// The last coefficient of a product of two series, which end at the same index.
fn product_of(a: &[Fixed], b: &[Fixed], are_same: bool) -> Fixed {
    let mut sum = Sum::default();
    if !are_same {
        a.iter().zip(b.iter().rev()).for_each(|(one, other)| sum.add(one, other));
        return sum.rounded();
    }
    let half = a.len() / 2;
    a[..half].iter().zip(b.iter().rev()).for_each(|(one, other)| sum.add(one, other));
    let twice = sum.rounded().twice();
    if a.len().is_multiple_of(2) { twice } else { twice.plus(a[half].times(a[half])) }
}

/// The last coefficient of Q (0, ω).
fn turned([w, x, y, z]: &[Vec<Fixed>; 4], rate: &[Vec<Fixed>; 3]) -> [Fixed; 4] {
    /// A component of the quaternion, and the axis of the rate that it is multiplied by.
    type Term<'a> = (&'a [Fixed], usize);
    let sum = |added: &[Term<'_>], subtracted: &[Term<'_>]| {
        let mut sum = Sum::default();
        for (parts, axis) in added {
            parts.iter().zip(rate[*axis].iter().rev()).for_each(|(one, other)| sum.add(one, other));
        }
        let mut less = Sum::default();
        for (parts, axis) in subtracted {
            parts.iter().zip(rate[*axis].iter().rev()).for_each(|(one, other)| less.add(one, other));
        }
        sum.subtract(&less);
        sum.rounded()
    };
    [
        sum(&[], &[(x, 0), (y, 1), (z, 2)]),
        sum(&[(w, 0), (y, 2)], &[(z, 1)]),
        sum(&[(w, 1), (z, 0)], &[(x, 2)]),
        sum(&[(w, 2), (x, 1)], &[(y, 0)]),
    ]
}

fn at(series: &[Fixed], part: &Fixed) -> Fixed {
    series.iter().rev().fold(Fixed::ZERO, |sum, coefficient| sum.times(*part).plus(*coefficient))
}

/// The tensor of `toss` as it was given, in any unit: of a coin in units of I1.
pub(super) fn tensor(toss: &Toss) -> [[Big; 3]; 3] {
    let Some(coin) = toss.coin() else { return toss.body.tensor().map(|row| row.map(exactly)) };
    let ratio = super::inertia_ratio(&coin.coin).with_precision(0).value();
    let mut tensor = [[0.0; 3]; 3].map(|row| row.map(exactly));
    [tensor[0][0], tensor[1][1], tensor[2][2]] = [exactly(1.0), exactly(1.0), ratio];
    tensor
}

#[cfg(test)]
mod tests;
