//! This file computes the exact motion of a free coin at any time after launch: attitude, body rate, cos θ and Euler
//! angles. It evaluates the closed form in double-double arithmetic, so that the results are right to the last bits
//! after any number of turns.
//!
//! Let k = I3/I1 and, at launch, S be the angular momentum, ωL = |S|/I1 = √(ωx² + ωy² + (k ωz)²), ŝ = (ωx, ωy, k ωz)/ωL
//! and q = (k - 1) ωz. Then
//!
//! ```text
//! Q(t)    = Q0 ⊗ exp(½ ωL t ŝ) ⊗ exp(-½ q t ẑ)           precession about the fixed S, then spin about n
//! ω(t)    = (ωx, ωy) turned by q t, ωz                    (2)-(4)
//! cos θ(t) = a + b cos(ωL t) + c sin(ωL t)
//! ```
//!
//! where a = (m·ŝ)(ŝ·ẑ), b = m·ẑ - a and c = m·(ŝ × ẑ), with m the vertical in the body frame (BF) at launch. Numbers
//! in parentheses are the paper's equations. From horizontal cos θ = cos²ψ + sin²ψ cos(ωL t), with ψ the angle between
//! the coin's normal n and S.
//!
//! All rates are divided by a power of two near the largest of them, and times are multiplied by it. This is exact. It
//! keeps squares from over- and underflow, and scaling ω by a power of two and t by its inverse changes no bit of the
//! results. ωL and q, the phases ωL t and q t, and a, b, c are [`DoubleDouble`]. The remaining errors are the rounding
//! of sine, cosine and the result: cos θ is right to 2.3e-16 and the attitude to 1e-15 rad for every phase up to 1e14 rad.
//! Beyond it, double-double adds an error of cos θ of up to 90 u² of the phase, 1e-14 at the limit of 2^53 rad; of some
//! thousand launches there, none was off by more than 3.2e-16 in all.

use dynamics::phase::require_phase;
use dynamics::time_of_flight::ExactTime;
use dynamics::{Attitude, CoinToss, EulerAngles, SolveError, State};
use nalgebra::Vector3;
use numerics::DoubleDouble;
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};

use crate::heads::HeadsPhases;
use crate::polar::{continuous_polar, flat, half_turns};
use crate::tilt_terms::terms;

/// Error of [`CoinMotion::cos_tilt`] for phases up to 1e14 rad, provided that std's sine and cosine are right to 0.6 ulp.
pub const COS_TILT_ERROR: f64 = 2.3e-16;

/// Phase (rad) up to which the errors of double-double, some tens of u² of the phase, are small next to [`COS_TILT_ERROR`].
pub(crate) const LARGEST_PHASE_IN_DOUBLE_DOUBLE: f64 = 1e14;

/// The closed-form motion that follows a launch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoinMotion {
    launch: State,
    /// Exponent of the power of two (rad/s) that is the unit of the rates below.
    exponent: i32,
    /// Direction of S at launch (BF).
    momentum_direction: Vector3<f64>,
    /// ωL, in that unit.
    precession_rate: DoubleDouble,
    /// q = (k - 1) ωz, in that unit.
    spin_rate: DoubleDouble,
    /// a, b, c of cos θ = a + b cos(ωL t) + c sin(ωL t).
    tilt: [DoubleDouble; 3],
}

impl CoinMotion {
    /// The motion of a toss.
    pub fn new(toss: &CoinToss) -> Self {
        let (rate, attitude) = (toss.launch.rate(), toss.launch.attitude());
        let k = toss.coin.exact_inertia_ratio();
        let (scaled, scale) = scaled_rate(toss);
        let (direction, precession_rate) = unit_momentum(scaled, k);
        let [s_x, s_y, s_z] = direction;
        Self {
            launch: State { attitude, rate },
            exponent: mantissa_and_exponent(scale).1,
            momentum_direction: Vector3::new(s_x.hi(), s_y.hi(), s_z.hi()),
            precession_rate,
            spin_rate: spin(k - 1.0.into(), scaled[2]),
            tilt: terms(attitude.exact_vertical(), direction, s_x * s_x + s_y * s_y),
        }
    }

    /// ωL = |S|/I1, the rate of the precession about S (rad/s); infinite if it leaves the range of f64.
    pub fn precession_rate(&self) -> f64 {
        self.precession_rate.times_power_of_two(self.exponent).hi()
    }

    /// The time (s) in which ωL t grows by `phase` (rad); not finite if it leaves the range of f64.
    pub(crate) fn time_of(&self, phase: f64) -> f64 {
        (DoubleDouble::from(phase) / self.precession_rate).times_power_of_two(-self.exponent).hi()
    }

    /// ψ, the angle between n and S (rad), from 0 to π: half the opening of the cone that n describes about S.
    pub fn cone_angle(&self) -> f64 {
        let s = &self.momentum_direction;
        s.x.hypot(s.y).atan2(s.z)
    }

    /// φ, the angle between S and the vertical (rad), from 0 to π.
    pub fn momentum_tilt(&self) -> f64 {
        let s = self.launch.attitude.body_to_lab(&self.momentum_direction);
        s.x.hypot(s.y).atan2(s.z)
    }

    /// The larger of the phases ωL t and |q| t (rad), which is how far the motion turns in `time` (s).
    pub fn phase(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        self.phases(time).map(|(precession, spin)| precession.hi().max(spin.hi().abs()))
    }

    /// The phases of precession and spin, ωL t and q t (rad), `time` (s) after launch.
    pub fn phases(&self, time: impl Into<ExactTime>) -> Result<(DoubleDouble, DoubleDouble), SolveError> {
        let time = time.into();
        let turned = |rate: DoubleDouble| (rate * time.mantissa()).times_power_of_two(self.exponent + time.exponent());
        let (precession, spin) = (turned(self.precession_rate), turned(self.spin_rate));
        let largest = precession.hi().max(spin.hi().abs());
        require_phase(largest).map(|_| (precession, spin))
    }

    /// cos θ, `time` (s) after launch. It costs one sine and one cosine.
    pub fn cos_tilt(&self, time: impl Into<ExactTime>) -> Result<f64, SolveError> {
        self.cos_tilt_parts(time).map(|(cos_tilt, _)| cos_tilt.hi().clamp(-1.0, 1.0))
    }

    /// cos θ before it is rounded, and the phase ωL t (rad), in double-double.
    pub fn cos_tilt_parts(&self, time: impl Into<ExactTime>) -> Result<(DoubleDouble, DoubleDouble), SolveError> {
        let phase = self.phases(time)?.0;
        let (sin, cos) = phase.sin_cos();
        let [a, b, c] = self.tilt;
        Ok((a + b * cos + c * sin, phase))
    }

    /// Attitude and body rate, `time` (s) after launch.
    pub fn state(&self, time: impl Into<ExactTime>) -> Result<State, SolveError> {
        let (phase, spin) = self.phases(time)?;
        let precession = Attitude::about_unit_axis(&self.momentum_direction, (phase * 0.5).rounded_sin_cos());
        let spun = Attitude::about_unit_axis(&Vector3::z(), (-spin * 0.5).rounded_sin_cos());
        let ((sin, cos), rate) = (spin.rounded_sin_cos(), self.launch.rate);
        Ok(State {
            attitude: self.launch.attitude * precession * spun,
            rate: Vector3::new(rate.x * cos - rate.y * sin, rate.x * sin + rate.y * cos, rate.z),
        })
    }

    /// Euler angles, `time` (s) after launch. They are continuous from launch on, also where sin β = 0.
    ///
    /// If a motion passes sin β = 0 exactly, as after every horizontal launch, α and γ stay continuous and β goes on to
    /// negative values. At a horizontal launch α(0) = -γ(0) = atan2(ωy, ωx), the limit for t → 0.
    pub fn euler_angles(&self, time: impl Into<ExactTime>) -> Result<EulerAngles, SolveError> {
        let (phase, spin) = self.phases(time)?;
        let half_phase = phase * 0.5;
        // Precession alone gives cos(x) Q0 + sin(x) Q0 ⊗ (0, ŝ), x = ½ ωL t. Spin changes γ alone, by -q t.
        let start = self.launch.attitude;
        let [w0, x0, y0, z0] = start.components();
        let [w1, x1, y1, z1] = (start * Attitude::half_turn(&self.momentum_direction)).components();
        let half_sum = continuous_polar([w0, z0], [w1, z1], half_phase);
        let half_difference = continuous_polar([x0, y0], [x1, y1], half_phase);
        let half_beta = match (flat([w0, z0], [w1, z1]), flat([x0, y0], [x1, y1])) {
            // n turns end over end through the vertical: both radii change sign, and β goes on past π.
            (Some((_, [c0, c1])), Some((_, [s0, s1]))) => continuous_polar([c0, s0], [c1, s1], half_phase).argument(),
            _ => half_difference.radius.atan2(half_sum.radius),
        };
        let alpha = half_turns(half_sum.half_turns + half_difference.half_turns)
            + (half_sum.base + half_difference.base).into();
        let gamma = half_turns(half_sum.half_turns - half_difference.half_turns)
            + (half_sum.base - half_difference.base).into()
            - spin;
        Ok(EulerAngles { alpha: alpha.hi(), beta: 2.0 * half_beta, gamma: gamma.hi() })
    }

    /// The phases ωL t at which the motion shows heads.
    pub fn heads(&self) -> HeadsPhases {
        HeadsPhases::new(self.tilt.map(DoubleDouble::hi), COS_TILT_ERROR)
    }

    /// The first time after launch at which the coin changes its face (s); `None` if it never does.
    pub fn first_flip(&self) -> Option<f64> {
        Some(self.heads().first_flip()? / self.precession_rate()).filter(|time| time.is_finite())
    }
}

/// The rate of a toss (BF) as it was given, in a unit near its largest component: the second number (rad/s), a power of two.
fn scaled_rate(toss: &CoinToss) -> ([DoubleDouble; 3], f64) {
    let scale = power_of_two_scale(toss.launch.rate().amax());
    (toss.launch.exact_rate().map(|part| part.in_unit(scale)), scale)
}

/// The product of a `ratio` with the rate z. A rate that was given in rad/s is an f64, whose product takes fewer steps.
fn spin(ratio: DoubleDouble, z: DoubleDouble) -> DoubleDouble {
    if z.lo() == 0.0 { ratio * z.hi() } else { ratio * z }
}

/// ŝ and ωL for a rate (BF) in a unit that is near its largest component.
fn unit_momentum([x, y, z]: [DoubleDouble; 3], k: DoubleDouble) -> ([DoubleDouble; 3], DoubleDouble) {
    let spin = spin(k, z);
    // S has a unit of its own: next to the spin of a rod it may be so small that its square underflows.
    let unit = power_of_two_scale(x.hi().abs().max(y.hi().abs()).max(spin.hi().abs()));
    let (_, unit_exponent) = mantissa_and_exponent(unit);
    let momentum = [x, y, spin].map(|part| part.in_unit(unit));
    let [x_squared, y_squared, z_squared] = momentum.map(|part| part * part);
    let norm = (x_squared + y_squared + z_squared).sqrt();
    let direction =
        if norm.hi() > 0.0 { momentum.map(|part| part / norm) } else { [0.0, 0.0, 1.0].map(DoubleDouble::from) };
    (direction, norm.times_power_of_two(unit_exponent))
}

#[cfg(test)]
mod tests;
