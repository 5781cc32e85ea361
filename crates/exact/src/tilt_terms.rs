//! This file writes cos θ as three terms in f64, all multiplied by the same positive scale. They decide most outcomes
//! and give the shares of heads over a range of speeds; the scale saves the divisions, which the sign of cos θ does not
//! need.
//!
//! Let Q be the attitude quaternion at launch (of any norm), m the vertical in the body frame (BF) at launch times
//! |Q|², and L = (ωx, ωy, k ωz) the angular momentum divided by I1. Then
//!
//! ```text
//! |Q|² |L|² cos θ = A + B cos φ + C sin φ,   φ = |L| t
//! A = (m·L) Lz,   B = mz (Lx² + Ly²) - (mx Lx + my Ly) Lz,   C = (mx Ly - my Lx) |L|
//! ```
//!
//! Below, Ω² = Lx² + Ly². The rate of the spin is q = (k - 1) ωz.

use dynamics::CoinToss;
use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;
use numerics::{Elementary, Number, UNIT_ROUNDOFF};

use crate::given::scaled;
use crate::heads::HeadsPhases;

/// Error of `mean`, `cosine` and `sine`, in units of `size`.
///
/// With u the [unit roundoff](UNIT_ROUNDOFF), N = |Q|² and Ω² = Lx² + Ly², each line follows from the lines before it
/// and a rounding of its own. The largest, 11.8u, is rounded up to cover the squares of u.
///
/// ```text
/// Lz = k ωz             2u |Lz|           two rounded operations
/// mx, my                2u N each         two products, one difference, |ac| + |bd| ≤ N/2
/// mz                    3u N              four squares, three sums
/// Ω²                    2u Ω²             two squares, one sum
/// mx Lx + my Ly         4.9u N Ω          2u for the operations, √8 u from m
/// mz Lz                 6u N |Lz|
/// m·L                   8.8u N |L|        √(4.9² + 6²) by Cauchy and Schwarz, and u for the sum
/// A                     11.8u N |L||Lz|
/// B                     10.9u N Ω |L|     √(6² + 7.9²) for mz Ω² and (mx Lx + my Ly) Lz, and u for the difference
/// |L|² and |L|          6u and 4u relative
/// C                     9.9u N Ω |L|
/// ```
pub const TERM_ERROR: f64 = 12.0 * UNIT_ROUNDOFF;

/// Relative error of the phases: 4u from |L|, u from the time, u from their product.
pub const PHASE_ERROR: f64 = 6.0 * UNIT_ROUNDOFF;

/// Smallest |L|², in the square of the unit of rates, that counts as a precession. Squares above it keep all their
/// digits.
pub(crate) const SLOWEST_SQUARED: f64 = 1e-200;

/// A, B and C/|L| in any kind of number, from the vertical m in BF, the momentum L, and Lx² + Ly².
#[inline(always)]
pub(crate) fn terms<N: Number>([m_x, m_y, m_z]: [N; 3], [x, y, z]: [N; 3], across_squared: N) -> [N; 3] {
    let level = m_x.clone().times_plus(x.clone(), m_y.clone() * y.clone());
    let mean = m_z.clone().times_plus(z.clone(), level.clone()) * z.clone();
    let cosine = m_z.times_plus(across_squared, -(level * z));
    [mean, cosine, m_x.times_plus(y, -(m_y * x))]
}

/// The three terms of cos θ of a toss, with their scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiltTerms {
    /// A, the term that does not depend on the phase.
    pub mean: f64,
    /// B, the factor of cos φ.
    pub cosine: f64,
    /// C, the factor of sin φ.
    pub sine: f64,
    /// |Q|² |L|², the scale of the terms, in the square of the unit of rates.
    pub size: f64,
    /// Rates of precession, |L| = ωL, and of spin, |q|, in the unit of rates.
    rates: [f64; 2],
    /// Unit of rates (rad/s), a power of two.
    unit: f64,
}

impl TiltTerms {
    /// Computes the terms of a toss.
    #[inline]
    pub fn new(toss: &CoinToss) -> Self {
        let rate = toss.launch.rate();
        let unit = power_of_two_scale(rate.amax());
        let momentum = Vector3::new(rate.x / unit, rate.y / unit, toss.coin.inertia_ratio() * (rate.z / unit));
        let squared = (momentum.x * momentum.x + momentum.y * momentum.y) + momentum.z * momentum.z;
        Self::of_momentum(toss, &momentum, squared, squared.sqrt(), unit)
    }

    /// The terms of a toss from its `momentum` L (BF), |L|² and |L|, all measured in the `unit` (rad/s).
    #[inline]
    pub(crate) fn of_momentum(toss: &CoinToss, momentum: &Vector3<f64>, squared: f64, size: f64, unit: f64) -> Self {
        let (x, y, z) = (momentum.x, momentum.y, momentum.z);
        let across = x * x + y * y;
        let (vertical, norm) = toss.launch.attitude().vertical();
        let spin = ((toss.coin.inertia_ratio() - 1.0) * (toss.launch.rate().z / unit)).abs();
        if squared < SLOWEST_SQUARED {
            // The coin is at rest, or its precession is slower than 1e-100 with a spin faster than ½ (in the unit of
            // rates). By the time the spin's phase is too large (2^53), that of the precession is still below 1e-83.
            return Self { mean: vertical[2], cosine: 0.0, sine: 0.0, size: norm, rates: [0.0, spin], unit };
        }
        let [mean, cosine, sine] = terms(vertical, [x, y, z], across);
        Self { mean, cosine, sine: sine * size, size: norm * squared, rates: [size, spin], unit }
    }

    /// ωL t and |q| t (rad) for a `time` (s).
    #[inline]
    pub fn phases(&self, time: f64) -> [f64; 2] {
        let time = self.unit * time;
        // A rate of 0 gives phase 0 at any time, also where the product would be 0 · ∞.
        self.rates.map(|rate| if rate == 0.0 { 0.0 } else { rate * time })
    }

    /// `size` cos θ at a phase ωL t (rad).
    #[inline]
    pub fn height(&self, phase: f64) -> f64 {
        let (sin, cos) = phase.sin_cos();
        self.mean + (self.cosine * cos + self.sine * sin)
    }

    /// The phases ωL t at which the motion shows heads.
    pub fn heads(&self) -> HeadsPhases {
        HeadsPhases::new([self.mean, self.cosine, self.sine].map(|term| term / self.size), TERM_ERROR + UNIT_ROUNDOFF)
    }
}

/// cos θ in any kind of number, from the time in the unit of [`scaled`] rates, the vertical (BF) at launch, and k.
pub(crate) fn cos_tilt_in<N: Elementary>(toss: &CoinToss, time: &N, vertical: [N; 3], k: N) -> N {
    let (rate, _) = toss.launch.given_rate();
    if rate.x == 0.0 && rate.y == 0.0 {
        let [.., m_z] = vertical;
        return m_z;
    }
    let [x, y, z] = scaled(&rate, time);
    let [height, squared] = height_and_scale(&[x, y, k * z], time, vertical);
    height / squared
}

/// |L|² cos θ, and |L|², in any kind of number, from the momentum L, the time in the inverse of its unit, and the vertical
/// (BF) at launch.
fn height_and_scale<N: Elementary>([x, y, z]: &[N; 3], time: &N, vertical: [N; 3]) -> [N; 2] {
    let across = x.clone() * x.clone() + y.clone() * y.clone();
    let squared = across.clone() + z.clone() * z.clone();
    let size = squared.sqrt();
    let [sin, cos] = (size.clone() * time.clone()).sine_and_cosine();
    let [mean, cosine, sine] = terms(vertical, [x.clone(), y.clone(), z.clone()], across);
    [mean + cosine * cos + sine * size * sin, squared]
}

/// cos θ times a positive number, as [`cos_tilt_in`]; also over an interval in which L vanishes. There it is by power series:
/// with Φ = L T, φ = |Φ|,
///
/// ```text
/// cos θ = mz (1 - φ² V) + S (mx Φy - my Φx) + V Φz (m·Φ)        S = sin φ/φ, V = (1 - cos φ)/φ²
/// ```
pub(crate) fn scaled_cos_tilt<N: Elementary>(momentum: &[N; 3], time: &N, vertical: [N; 3]) -> N {
    let [x, y, z] = momentum.each_ref().map(|part| part.clone() * time.clone());
    let squared = x.clone() * x.clone() + y.clone() * y.clone() + z.clone() * z.clone();
    let Some([s, v]) = small_phase(&squared) else {
        let [height, _] = height_and_scale(momentum, time, vertical);
        return height;
    };
    let [m_x, m_y, m_z] = vertical;
    let across = m_x.clone() * y.clone() - m_y.clone() * x.clone();
    let level = m_x * x + m_y * y + m_z.clone() * z.clone();
    m_z.clone() + s * across + v * (z * level - m_z * squared)
}

/// S and V of a φ² of at most 4; `None` if it may be larger.
///
/// From the term of φ²ᵏ on, they differ from their series by at most 2 φ²ᵏ/(2k + 1)!.
fn small_phase<N: Elementary>(squared: &N) -> Option<[N; 2]> {
    let most = Some(squared.bound()).filter(|most| *most <= 4.0)?;
    // -log2 of what is left out.
    let (mut count, mut left) = (0.0_f64, -1.0);
    let of_square = f64::log2(most).max(-1000.0);
    while left < f64::from(squared.digits()) + 10.0 {
        count += 1.0;
        left += (2.0 * count * (2.0 * count + 1.0)).log2() - of_square;
    }
    let rest = squared.like(0.0).widened(1.0).times_power_of_two(-left.floor().min(1e6) as i32);
    let sum = |first: f64| {
        let mut sum = squared.like(1.0);
        let mut order = count - 1.0;
        while order > 0.0 {
            let divisor = (2.0 * order + first - 1.0) * (2.0 * order + first);
            sum = squared.like(1.0) - squared.clone() * sum / squared.like(divisor);
            order -= 1.0;
        }
        sum / squared.like(first) + rest.clone()
    };
    Some([sum(1.0), sum(2.0)])
}

/// The sign of cos θ if it is the same at every phase: the cone of n does not reach the horizontal, where A² > B² + C², which
/// is (m·L)² > Lx² + Ly².
pub(crate) fn sign_at_any_phase<N: Elementary>([x, y, z]: &[N; 3], vertical: &[N; 3]) -> Option<f64> {
    let [m_x, m_y, m_z] = vertical.clone();
    let level = m_x * x.clone() + m_y * y.clone() + m_z * z.clone();
    let beyond = level.clone() * level.clone() - (x.clone() * x.clone() + y.clone() * y.clone());
    let known_sign = |number: &N| if number.has_known_sign() { number.sign() } else { 0.0 };
    Some(known_sign(&level) * known_sign(z)).filter(|sign| *sign != 0.0 && known_sign(&beyond) > 0.0)
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;

    #[test]
    fn a_coin_that_does_not_precess_keeps_its_face() {
        for (rate, tilt, half_width) in
            [([0.0; 3], 0.3, std::f64::consts::PI), ([0.0; 3], 2.0, 0.0), ([1e-160, 0.0, 1.0], 2.0, 0.0)]
        {
            let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
            let terms = TiltTerms::new(&CoinToss { coin: Coin::from_moments(1.0, 0.0).unwrap(), launch });
            assert_eq!((terms.phases(1.0)[0], terms.heads().half_width), (0.0, half_width), "{rate:?} {tilt}");
            assert!((terms.height(0.0) / terms.size - tilt.cos()).abs() < 1e-15);
        }
    }

    /// Over intervals of a rate, next to a turn of 0, where the series is taken, and far from it.
    #[test]
    fn cos_tilt_over_an_interval_contains_those_of_its_numbers() {
        use numerics::{Ball, DoubleDouble, TaylorModel};
        let vertical = [0.36, -0.48, 0.8];
        for ([x, y, z], axis) in [([0.1, -0.2, 0.3], 0), ([0.0; 3], 1), ([0.0; 3], 2), ([7.0, -2.0, 30.0], 2)] {
            for (middle, width) in [(0.0, 1e-9), (0.05, 0.3), (-0.3, 0.5), (0.4, 0.01)] {
                let at = |change: f64| {
                    let number = |value: f64| Ball::new(DoubleDouble::from(value), 0.0);
                    let mut momentum = [x, y, z].map(number);
                    momentum[axis] =
                        momentum[axis] + number(middle) + Ball::new(DoubleDouble::product(width, change), 0.0);
                    scaled_cos_tilt(&momentum, &number(1.0), vertical.map(number))
                };
                let number = |value: f64| TaylorModel::constant(Ball::new(value, 0.0));
                let mut momentum = [x, y, z].map(number);
                let moved = TaylorModel::variable(Ball::new(middle, 0.0), Ball::new(width, 0.0));
                momentum[axis] = momentum[axis].clone() + moved;
                let (polynomial, error) = scaled_cos_tilt(&momentum, &number(1.0), vertical.map(number)).polynomial();
                // Of a multiple of cos θ.
                let size = 1.0 + x * x + y * y + z * z;
                assert!(error < (1e-13 + 40.0 * width.powi(5)) * size, "{x} {axis} {middle} {width}: {error:e}");
                for step in -10..=10 {
                    let change = f64::from(step) / 10.0;
                    let value = polynomial.iter().rev().fold(0.0, |sum, coefficient| sum * change + coefficient);
                    let off = (at(change).midpoint().hi() - value).abs();
                    assert!(
                        off <= error + 1e-13 * value.abs(),
                        "{x} {axis} {middle} {width} {change}: {off:e} {error:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_small_phase_has_the_sine_and_cosine_of_its_size() {
        use numerics::{Ball, DoubleDouble};
        for phase in [1e-30, 1e-3, 0.7, 1.99] {
            let number = DoubleDouble::product(phase, phase);
            let [s, v] = small_phase(&Ball::new(number, 0.0)).unwrap();
            let (sin, cos) = DoubleDouble::from(phase).exact_sin_cos();
            let sine = s * Ball::new(phase.into(), 0.0) - Ball::new(sin, 0.0);
            let cosine = Ball::new(DoubleDouble::from(1.0) - cos, 0.0) - v * Ball::new(number, 0.0);
            for off in [sine, cosine] {
                assert!(off.midpoint().hi().abs() < 1e-29 && off.radius() < 1e-28, "{phase}: {off:?}");
            }
        }
        assert_eq!(small_phase(&Ball::new(4.0, 0.1)), None);
    }

    /// Against the least and the greatest cos θ over a turn, A ± √(B² + C²).
    #[test]
    fn a_sign_at_any_phase_is_that_of_a_cone_above_or_below_the_horizontal() {
        let mut counts = [0; 3];
        for index in 1..2000 {
            let part = |root: f64| 2.0 * (f64::from(index) * root.sqrt()).fract() - 1.0;
            let [momentum, vertical] = [[2.0, 3.0, 5.0], [7.0, 11.0, 13.0]].map(|roots| roots.map(part));
            let norm = vertical.iter().map(|part| part * part).sum::<f64>().sqrt();
            let vertical = vertical.map(|part| part / norm);
            let ball = |numbers: [f64; 3]| numbers.map(|part| numerics::Ball::new(part, 1e-9));
            let [mean, cosine, sine] = {
                let [x, y, z] = momentum;
                let [mean, cosine, sine] = terms(vertical, momentum, x * x + y * y);
                [mean, cosine, sine * (x * x + y * y + z * z).sqrt()]
            };
            let amplitude = cosine.hypot(sine);
            let expected = if mean.abs() > amplitude { Some(mean.signum()) } else { None };
            let found = sign_at_any_phase(&ball(momentum), &ball(vertical));
            assert!(found == expected || (mean.abs() - amplitude).abs() < 1e-6, "{momentum:?} {vertical:?}: {found:?}");
            counts[found.map_or(0, |sign| if sign > 0.0 { 1 } else { 2 })] += 1;
        }
        assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
    }

    #[test]
    fn errors_are_those_of_the_derivation() {
        assert_eq!([TERM_ERROR, PHASE_ERROR], [12.0, 6.0].map(|units: f64| units * f64::exp2(-53.0)));
    }

    #[test]
    fn phases_are_rates_of_precession_and_spin_times_the_time() {
        let terms = |k: f64, rate: [f64; 3]| {
            let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap();
            TiltTerms::new(&CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch })
        };
        assert_eq!(terms(0.5, [30.0, 0.0, -80.0]).phases(2.0), [100.0, 80.0]);
        assert_eq!(terms(1.5, [0.0; 3]).phases(f64::INFINITY), [0.0, 0.0]);
        // The slowest precession that counts beside a spin, and a slower one.
        assert_eq!(terms(0.0, [1e-100, 0.0, 1.0]).phases(1e100), [1.0, 1e100]);
        assert_eq!(terms(0.0, [0.99e-100, 0.0, 1.0]).phases(1e100), [0.0, 1e100]);
    }

    #[test]
    fn heads_have_the_errors_of_the_terms() {
        let launch =
            Launch::new(Vector3::new(3.0, 1.0, 0.5), TimeOfFlight::Given(1.0)).unwrap().with_tilt(0.3).unwrap();
        let terms = TiltTerms::new(&CoinToss { coin: Coin::PAPER, launch });
        let cos_tilt = [terms.mean, terms.cosine, terms.sine].map(|term| term / terms.size);
        assert_eq!(terms.heads(), HeadsPhases::new(cos_tilt, 13.0 * UNIT_ROUNDOFF));
    }
}
