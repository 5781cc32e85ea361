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
    let momentum = [x.clone(), y.clone(), k * z];
    let across = x.clone() * x + y.clone() * y;
    let squared = across.clone() + momentum[2].clone() * momentum[2].clone();
    let size = squared.sqrt();
    let [sin, cos] = (size.clone() * time.clone()).sine_and_cosine();
    let [mean, cosine, sine] = terms(vertical, momentum, across);
    (mean + cosine * cos + sine * size * sin) / squared
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
