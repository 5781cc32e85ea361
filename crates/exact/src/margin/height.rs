//! cos θ of a landing by the turn that leads to it, and the slope of cos θ along a line of turns.
//!
//! The margin of an input follows cos θ along the line on which that input alone moves the turn. With Φ = (ωx, ωy, k ωz) T,
//! φ = |Φ|, m the vertical seen from the body at launch and e the unit vector along the line:
//!
//! ```text
//! f(u) = m·exp([Φ + u e]×) ẑ = mz cos φ + S a + V b      S = sin φ/φ, V = (1 - cos φ)/φ²
//!                                                        a = mx Φy - my Φx, b = Φz (m·Φ)
//! f'(u) = (Φ·e)(P a + R b - mz S) + S a' + V b'          P = (cos φ - S)/φ², R = (S - 2V)/φ²
//! |f⁽ⁿ⁾(u)| ≤ 1                                          for every n
//! ```
//!
//! The last line is the bound on which the search rests. The n-th derivative of exp(X + u E) is n! times the integral of
//! exp(s0 X) E exp(s1 X) … E exp(sn X) over all si ≥ 0 whose sum is 1. That simplex has the volume 1/n!, the exponentials
//! are rotations, and |E| = 1.

use std::ops::Div;

use numerics::Number;

/// cos θ and its slope along a line of turns, each with a bound of its error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Height {
    pub(super) value: f64,
    pub(super) slope: f64,
    pub(super) error: f64,
    pub(super) slope_error: f64,
}

/// A landing on a line of turns, in any kind of number.
pub(super) struct Landing<N> {
    /// m, the vertical seen from the body at launch.
    pub(super) vertical: [N; 3],
    /// Φ (rad).
    pub(super) turn: [N; 3],
    /// e, of size 1.
    pub(super) direction: [N; 3],
    /// Φ·e (rad).
    pub(super) along: N,
}

impl<N: Number> Landing<N> {
    /// f and f', by the functions cos φ, S, V, P and R of the phase.
    pub(super) fn height_and_slope(self, [cos, s, v, p, r]: [N; 5]) -> [N; 2] {
        let ([m_x, m_y, m_z], [x, y, z], [e_x, e_y, e_z]) = (self.vertical, self.turn, self.direction);
        let across = m_x.clone() * y.clone() - m_y.clone() * x.clone();
        let across_slope = m_x.clone() * e_y.clone() - m_y.clone() * e_x.clone();
        let level = m_x.clone() * x + m_y.clone() * y + m_z.clone() * z.clone();
        let level_slope = m_x * e_x + m_y * e_y + m_z.clone() * e_z.clone();
        let tilted = z.clone() * level.clone();
        let tilted_slope = e_z * level + z * level_slope;
        let by_phase = p * across.clone() + r * tilted.clone() - m_z.clone() * s.clone();
        let height = m_z * cos + s.clone() * across + v.clone() * tilted;
        [height, self.along * by_phase + s * across_slope + v * tilted_slope]
    }
}

/// cos φ, S, V, P and R of a `phase` (rad) ≥ 0 with this sine and cosine; `number` makes a number of an f64.
pub(super) fn functions_of_phase<N>(phase: &N, (sin, cos): (N, N), number: impl Fn(f64) -> N) -> [N; 5]
where
    N: Number + Div<Output = N> + PartialOrd,
{
    // Their limits. What they leave out is φ², relative to 1, in S and V; P and R count times φ² and more.
    const SMALL: f64 = 1e-100;
    if *phase < number(SMALL) {
        return [1.0, 1.0, 0.5, 0.0, 0.0].map(number);
    }
    let squared = phase.clone() * phase.clone();
    let one = || number(1.0);
    let s = sin / phase.clone();
    // The form that does not cancel.
    let v = if cos > number(0.0) {
        s.clone() * s.clone() / (one() + cos.clone())
    } else {
        (one() - cos.clone()) / squared.clone()
    };
    let p = (cos.clone() - s.clone()) / squared.clone();
    let r = (s.clone() - v.clone() - v.clone()) / squared;
    [cos, s, v, p, r]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against their series.
    #[test]
    fn functions_of_a_small_phase_lose_no_digit_to_a_difference() {
        for phase in [0.0, 1e-110, 1e-99, 1e-30, 1e-7, 1e-5, 1e-3, 0.01] {
            let x = phase * phase;
            let [cos, s, v, ..] = functions_of_phase(&phase, f64::sin_cos(phase), |number| number);
            let expected = [
                1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0)),
                1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0)),
                0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0)),
            ];
            for (found, expected) in [cos, s, v].into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{phase:e}: {found} {expected}");
            }
        }
    }
}
