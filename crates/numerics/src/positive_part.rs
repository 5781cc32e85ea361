//! Means over a box of the positive part of a linear function, to the power 0, ½ or 1.
//!
//! Let ℓ(t) = c + Σ s_i t_i over the box -1 ≤ t_i ≤ 1 in n variables, with s_i > 0. Integrating a power of max(0, ℓ) by one
//! variable raises the power by one, so that the mean is a sum over the 2^n corners v:
//!
//! ```text
//! mean of max(0, ℓ)^p = Σ_v ± max(0, ℓ(v))^(p + n) / ((p + 1) … (p + n) Π 2 s_i)      + where an even number of v_i is -1
//! ```
//!
//! The sum cancels where a slope is small compared with the others. Such a variable is left out, and c moves by its slope.

use crate::ball::Ball;
use crate::double_double::DoubleDouble;
use crate::elementary::Elementary;
use crate::jet::MOST_VARIABLES;

/// A slope below this part of the largest is left out: n of them cancel 40 of the 98 digits that are right.
const SMALL_SLOPE: f64 = 9.536_743_164_062_5e-7; // 2^-20

/// The power of a positive part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Power {
    /// 1 where the function is positive, 0 elsewhere.
    Zero,
    /// The square root.
    Half,
    /// The positive part itself.
    One,
}

/// The smallest and the largest mean, over the box -1 ≤ t_i ≤ 1, of the positive part to `power` of a function that is nowhere
/// further than `off` ≥ 0 from the linear one with these coefficients. For [`Power::One`], `off` may be the mean of the distance.
///
/// At most [`MOST_VARIABLES`] slopes are allowed.
pub fn mean(constant: f64, slopes: &[f64], off: f64, power: Power) -> [f64; 2] {
    let largest = slopes.iter().fold(0.0_f64, |largest, slope| largest.max(slope.abs()));
    let (mut kept, mut number, mut off) = ([0.0; MOST_VARIABLES], 0, off);
    for slope in slopes.iter().map(|slope| slope.abs()) {
        if slope > SMALL_SLOPE * largest {
            kept[number] = slope;
            number += 1;
        } else {
            off = (off + slope) * (1.0 + f64::EPSILON);
        }
    }
    let shifted = |shift: f64| of_linear(exactly(constant) + exactly(shift), &kept[..number], power);
    // The positive part does not fall as the function rises, and rises no faster than it.
    let (lowest, highest, off) = match power {
        Power::One => (shifted(0.0), shifted(0.0), off),
        Power::Half | Power::Zero => (shifted(-off), shifted(off), 0.0),
    };
    let [lo, hi] = [lower_end(&lowest) - off, upper_end(&highest) + off];
    // Nothing is known if a part left the range of f64.
    if lo.is_finite() && hi.is_finite() { [lo.next_down().max(0.0), hi.next_up()] } else { [0.0, f64::INFINITY] }
}

fn lower_end(number: &Ball<DoubleDouble>) -> f64 {
    (number.midpoint().hi() - number.midpoint().lo().abs() - number.radius()).next_down().next_down()
}

fn upper_end(number: &Ball<DoubleDouble>) -> f64 {
    (number.midpoint().hi() + number.midpoint().lo().abs() + number.radius()).next_up().next_up()
}

fn exactly(value: f64) -> Ball<DoubleDouble> {
    Ball::new(value.into(), 0.0)
}

fn of_linear(constant: Ball<DoubleDouble>, slopes: &[f64], power: Power) -> Ball<DoubleDouble> {
    let first = match power {
        Power::Zero => 0.0,
        Power::Half => 0.5,
        Power::One => 1.0,
    };
    let (mut sum, mut divisor) = (exactly(0.0), exactly(1.0));
    for (index, slope) in (1..).zip(slopes) {
        divisor = divisor * exactly(first + f64::from(index)) * exactly(2.0 * slope);
    }
    for corner in 0..1_u32 << slopes.len() {
        let sign = |index: usize| if corner >> index & 1 == 1 { -1.0 } else { 1.0 };
        let at = slopes.iter().enumerate().fold(constant, |at, (index, slope)| at + exactly(sign(index) * slope));
        let part = positive(at, slopes.len(), power);
        sum = if corner.count_ones() % 2 == 0 { sum + part } else { sum - part };
    }
    sum / divisor
}

/// max(0, `number`) to `power` + `more`.
fn positive(number: Ball<DoubleDouble>, more: usize, power: Power) -> Ball<DoubleDouble> {
    if number.has_known_sign() && number.sign() <= 0.0 {
        return exactly(0.0);
    }
    // Around 0 it is at least 0 and at most its upper end.
    let half = 0.5 * upper_end(&number);
    let part = if number.has_sign() { number } else { Ball::new(half.into(), half) };
    let first = match power {
        Power::Zero if !number.has_sign() && more == 0 => return Ball::new(DoubleDouble::from(0.5), 0.5),
        Power::Zero => exactly(1.0),
        Power::Half => part.sqrt(),
        Power::One => part,
    };
    (0..more).fold(first, |product, _| product * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the midpoint rule.
    fn counted(constant: f64, slopes: [f64; 3], power: Power) -> f64 {
        const POINTS: i32 = 100;
        let at = |index: i32| (2.0 * f64::from(index) + 1.0) / f64::from(POINTS) - 1.0;
        let mut sum = 0.0;
        for number in 0..POINTS.pow(3) {
            let point = [number % POINTS, number / POINTS % POINTS, number / POINTS / POINTS].map(at);
            let value = constant + slopes.iter().zip(point).map(|(slope, t)| slope * t).sum::<f64>();
            sum += match power {
                Power::Zero => f64::from(value > 0.0),
                Power::Half => value.max(0.0).sqrt(),
                Power::One => value.max(0.0),
            };
        }
        sum / f64::from(POINTS.pow(3))
    }

    #[test]
    fn means_are_those_over_many_points() {
        for (constant, slopes) in [
            (0.1, [1.0, 0.5, -0.25]),
            (-0.7, [0.3, -0.9, 0.2]),
            (5.0, [1.0, 1.0, 1.0]),
            (-5.0, [1.0, 1.0, 1.0]),
            (0.0, [2.0, 0.0, 0.0]),
            (0.3, [0.0, 1e-9, -1.0]),
            (-0.2, [0.0, 0.0, 0.0]),
            (0.2, [0.0, 0.0, 0.0]),
        ] {
            for (power, error) in [(Power::Zero, 0.011), (Power::Half, 1e-3), (Power::One, 1e-3)] {
                let [lo, hi] = mean(constant, &slopes, 0.0, power);
                let expected = counted(constant, slopes, power);
                assert!(lo <= hi && hi - lo < 1e-8 * (1.0 + hi), "{constant} {slopes:?} {power:?}: {lo} {hi}");
                assert!((lo - expected).abs() < error, "{constant} {slopes:?} {power:?}: {lo}, not {expected}");
            }
        }
    }

    /// In closed form: of t over -1 to 1, and of a sum of two.
    #[test]
    fn means_are_exact() {
        for (constant, slopes, power, expected) in [
            (0.0, &[1.0][..], Power::One, 0.25),
            (0.0, &[1.0], Power::Half, 1.0 / 3.0),
            (0.5, &[-1.0], Power::Zero, 0.75),
            (0.0, &[1.0, 1.0], Power::One, 1.0 / 3.0),
            (2.0, &[1.0, 0.5], Power::One, 2.0),
        ] {
            let [lo, hi] = mean(constant, slopes, 0.0, power);
            assert!(lo <= expected && expected <= hi && hi - lo < 1e-14, "{constant} {slopes:?} {power:?}: {lo} {hi}");
        }
    }

    /// A function that is off by so much everywhere is within.
    #[test]
    fn what_is_off_the_linear_function_widens_the_mean() {
        let slopes = [0.4, 0.3, 0.2];
        for power in [Power::Zero, Power::Half, Power::One] {
            let [lo, hi] = mean(0.1, &slopes, 0.05, power);
            for shift in [-0.05, 0.0, 0.05] {
                let [least, most] = mean(0.1 + shift, &slopes, 0.0, power);
                assert!(lo <= most && least <= hi, "{power:?} {shift}");
            }
            assert!(hi - lo < 0.3);
        }
        let [lo, hi] = mean(0.0, &[], 0.0, Power::Zero);
        assert!(lo == 0.0 && hi < 1e-300);
        assert_eq!(mean(f64::MAX, &[f64::MAX], 0.0, Power::One), [0.0, f64::INFINITY]);
        // A slope that is left out moves the function.
        let [lo, hi] = mean(0.0, &[1.0, 1e-8], 0.0, Power::One);
        assert!(hi - lo >= 1e-8 && hi - lo < 4e-8);
    }
}
