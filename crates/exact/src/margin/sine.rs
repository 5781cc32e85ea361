//! Sine and cosine in double-double, for margins that need more digits than those of f64.
//!
//! [`DoubleDouble::sin_cos`] is right to the digits of the f64 that it mostly ends as. A margin near the edge is a difference
//! that takes away half of those. Here the phase, less quarter turns, is divided by 8; two series and three doublings,
//! sin 2x = 2 sin x (1 - v) and v(2x) = 2 sin² x with v = 1 - cos x, leave errors below 200 u² relative to 1, u = 2^-53.

use std::f64::consts::FRAC_2_PI;

use numerics::DoubleDouble;

/// π/2 as a sum.
const QUARTER_TURN: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_183_3e-33];

/// The terms of each series after the first: the next is below 2^-110 for x ≤ π/32.
const TERMS: i32 = 8;

/// Sine and cosine of a `phase` from 0 to 2^53 (rad).
pub(super) fn sine_and_cosine(phase: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let quarters = (phase.hi() * FRAC_2_PI).round();
    let rest = QUARTER_TURN.iter().fold(phase, |rest, part| rest - DoubleDouble::product(quarters, *part));
    let one = DoubleDouble::from(1.0);
    let x = rest.times_power_of_two(-3);
    let square = x * x;
    // 1 - x²/(first (first + 1)) (1 - x²/((first + 2) (first + 3)) (…)).
    let series = |first: i32| {
        (0..TERMS).rev().fold(one, |sum, term| {
            let factor = first + 2 * term;
            one - square * sum / f64::from(factor * (factor + 1)).into()
        })
    };
    let (mut sine, mut versine) = (x * series(2), square.half() * series(3));
    for _ in 0..3 {
        (sine, versine) = ((sine * (one - versine)).times_power_of_two(1), (sine * sine).times_power_of_two(1));
    }
    let cosine = one - versine;
    match quarters.rem_euclid(4.0) {
        0.0 => (sine, cosine),
        1.0 => (cosine, -sine),
        2.0 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

#[cfg(test)]
mod tests {
    use numerics::big::exactly;

    use super::*;

    #[test]
    fn sines_and_cosines_are_right_to_200_squares_of_the_roundoff() {
        let exact = |number: DoubleDouble| exactly(number.hi()) + exactly(number.lo());
        for index in 0..2000 {
            let part = (f64::from(index) * 2f64.sqrt()).fract();
            let size = f64::exp2(f64::from(index % 55) - 2.0);
            let phase = DoubleDouble::from(part * size) + DoubleDouble::from(0.3 * size * f64::EPSILON * part);
            let (sine, cosine) = sine_and_cosine(phase);
            let (exact_sine, exact_cosine) = exact(phase).with_precision(300).value().sin_cos();
            // Of a phase that is not that of a f64, the reduction keeps 5 u² of the phase.
            let bound = exactly((200.0 + 5.0 * phase.hi()) * f64::exp2(-106.0));
            for (found, expected) in [(sine, exact_sine), (cosine, exact_cosine)] {
                let error = exact(found) - expected;
                assert!(error < bound && -error < bound.clone(), "{phase:?}: {found:?}");
            }
        }
    }
}
