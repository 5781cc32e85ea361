//! cos θ along a line of turns in as many digits as it takes, for margins near an edge, near a touch or of a large phase.
//!
//! The formula is that of [`height`](super::height), the inputs are those of the toss without a rounding.

use dynamics::CoinToss;
use numerics::big::{Big, exactly};
use numerics::{Elementary, UNIT_ROUNDOFF};

use super::height::{Height, Landing, functions_of_phase};
use crate::multiprecision::{flight_time, momentum};

/// Digits to begin with, and after which a height counts as 0. The smallest height that is not 0 and that inputs in f64 can
/// give has some 2^-2200.
const DIGITS: usize = 192;
const MOST_DIGITS: usize = 3072;

/// Of these digits at most 80 are lost: the phase is up to 2^53, and there are some fifty operations.
const LOST_DIGITS: usize = 80;

/// f and f' of a toss whose turn is `change` (rad) further on the line of the rate `axis`.
pub(super) fn height_in_digits(toss: &CoinToss, axis: usize, change: f64) -> Height {
    decided(|digits| height_and_slope(landing(toss, axis, change, vertical(toss, digits), digits), digits))
}

/// cos θ of a toss, and what it becomes after a quarter of a turn of the launch about the lab's x axis.
pub(super) fn tilted_heights(toss: &CoinToss) -> [Height; 2] {
    let of = |vertical: fn(&CoinToss, usize) -> [Big; 3]| {
        decided(|digits| height_and_slope(landing(toss, 0, 0.0, vertical(toss, digits), digits), digits))
    };
    [of(vertical), of(quarter_turned_vertical)]
}

/// A value and a slope in so many digits that the value is not 0, or in the most.
fn decided(of_digits: impl Fn(usize) -> [Big; 2]) -> Height {
    let mut digits = DIGITS;
    loop {
        let [value, slope] = of_digits(digits);
        let bound = Big::ONE >> (digits - LOST_DIGITS).cast_signed();
        let [size, threshold] = [value.magnitude(), bound.clone() << 60];
        if size > threshold || digits >= MOST_DIGITS {
            let sign = if size > threshold { Elementary::sign(&value) } else { 0.0 };
            let [value, slope, bound] = [value, slope, bound].map(|number| number.to_f64().value());
            // Below the range of f64 the sign is kept.
            let value = if value == 0.0 { sign * f64::from_bits(1) } else { value };
            let rounding = |value: f64| 2.0 * UNIT_ROUNDOFF * value.abs();
            return Height { value, slope, error: bound + rounding(value), slope_error: 2.0 * bound + rounding(slope) };
        }
        digits *= 2;
    }
}

/// The landing `change` (rad) further on the line of the rate `axis`, in `digits` binary digits.
fn landing(toss: &CoinToss, axis: usize, change: f64, vertical: [Big; 3], digits: usize) -> Landing<Big> {
    let big = |value: f64| exactly(value).with_precision(digits).value();
    let time = flight_time(toss, digits);
    let mut turn = momentum(toss, digits).map(|part| part * &time);
    turn[axis] += big(change);
    let mut direction = [0.0; 3].map(big);
    direction[axis] = big(1.0);
    let along = turn[axis].clone();
    Landing { vertical, turn, direction, along }
}

/// f and f' at a landing.
fn height_and_slope(landing: Landing<Big>, digits: usize) -> [Big; 2] {
    let [x, y, z] = &landing.turn;
    let phase = (x * x + y * y + z * z).sqrt();
    let functions = functions_of_phase(&phase, phase.sin_cos(), |value| exactly(value).with_precision(digits).value());
    landing.height_and_slope(functions)
}

/// The vertical seen from the body, of size 1.
fn vertical(toss: &CoinToss, digits: usize) -> [Big; 3] {
    normalised(toss.launch.attitude().vertical_in_digits(digits), digits)
}

/// The vertical seen from the body after a quarter of a turn about the lab's x axis.
fn quarter_turned_vertical(toss: &CoinToss, digits: usize) -> [Big; 3] {
    normalised(toss.launch.attitude().quarter_turned_vertical_in_digits(digits), digits)
}

fn normalised((vertical, norm): ([Big; 3], Big), digits: usize) -> [Big; 3] {
    let round = |value: Big| value.with_precision(digits).value();
    let norm = round(norm);
    vertical.map(|part| round(part) / &norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn height(value: f64, shift: isize) -> (Height, usize) {
        let most = std::cell::Cell::new(0);
        let found = decided(|digits| {
            most.set(digits);
            let big = |value: f64| exactly(value).with_precision(digits).value();
            [big(value) >> shift, big(-3.0)]
        });
        (found, most.get())
    }

    #[test]
    fn a_height_takes_the_digits_that_tell_it_from_0_and_keeps_its_sign() {
        for sign in [1.0, -1.0] {
            let (Height { value, slope, error, slope_error }, digits) = height(0.5 * sign, 0);
            assert_eq!((value, slope, digits), (0.5 * sign, -3.0, DIGITS));
            let bound = f64::exp2(80.0 - 192.0);
            assert_eq!((error, slope_error), (UNIT_ROUNDOFF + bound, 6.0 * UNIT_ROUNDOFF + 2.0 * bound));
            // 140 digits are lost or asked for beyond those of the value.
            assert_eq!([51, 53, 240, 250, 1390].map(|shift| height(sign, shift).1), [192, 384, 384, 768, 1536]);
            let (tiny, _) = height(sign, 1400);
            assert_eq!(tiny.value, sign * f64::from_bits(1));
            let (nothing, digits) = height(sign, 5000);
            assert_eq!((nothing.value, digits), (0.0, MOST_DIGITS));
        }
    }
}
