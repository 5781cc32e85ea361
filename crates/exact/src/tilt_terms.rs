//! cos θ as three terms in f64, without a division: what decides an outcome, and what shares of heads are made of.
//!
//! With m the vertical seen from the body at launch, for a quaternion q of any norm, and L = (ωx, ωy, k ωz):
//!
//! ```text
//! |q|² |L|² cos θ = A + B cos φ + C sin φ,   φ = |L| t
//! A = (m·L) Lz,   B = mz (Lx² + Ly²) - (mx Lx + my Ly) Lz,   C = (mx Ly - my Lx) |L|
//! ```

use dynamics::Toss;
use nalgebra::Vector3;
use numerics::scale::power_of_two_scale;
use numerics::{Number, UNIT_ROUNDOFF};

use crate::heads::HeadsPhases;

/// Error of `mean`, `cosine` and `sine`, in parts of `size`. With u the [unit roundoff](UNIT_ROUNDOFF), N = |q|² and Ω² = Lx² + Ly²,
/// each line from the lines before it and one rounding of its own (squares of u are in the rounding up of the last):
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

/// Relative error of the phase: 4u of |L|, u of the time, u of their product.
pub const PHASE_ERROR: f64 = 6.0 * UNIT_ROUNDOFF;

/// Precessions slower than its square root count as none, in the unit of rates; squares above it keep their digits.
pub(crate) const SLOWEST_SQUARED: f64 = 1e-200;

/// A, B and C/|L| in any kind of number, for the vertical m seen from the body, the momentum L, and Lx² + Ly².
#[inline(always)]
pub(crate) fn terms<N: Number>([m_x, m_y, m_z]: [N; 3], [x, y, z]: [N; 3], across_squared: N) -> [N; 3] {
    let level = m_x.clone().times_plus(x.clone(), m_y.clone() * y.clone());
    let mean = m_z.clone().times_plus(z.clone(), level.clone()) * z.clone();
    let cosine = m_z.times_plus(across_squared, -(level * z));
    [mean, cosine, m_x.times_plus(y, -(m_y * x))]
}

/// The terms of cos θ of a toss.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiltTerms {
    /// A.
    pub mean: f64,
    /// B.
    pub cosine: f64,
    /// C.
    pub sine: f64,
    /// |q|² |L|², in the square of the unit of rates.
    pub size: f64,
    /// |L| = ωL and |q|, the rate of the spin, in the unit of rates.
    rates: [f64; 2],
    /// Unit of rates (rad/s), a power of two.
    unit: f64,
}

impl TiltTerms {
    /// The terms of a toss.
    #[inline]
    pub fn new(toss: &Toss) -> Self {
        let rate = toss.launch.rate();
        let unit = power_of_two_scale(rate.amax());
        let momentum = Vector3::new(rate.x / unit, rate.y / unit, toss.coin.inertia_ratio() * (rate.z / unit));
        let squared = (momentum.x * momentum.x + momentum.y * momentum.y) + momentum.z * momentum.z;
        Self::of_momentum(toss, &momentum, squared, squared.sqrt(), unit)
    }

    /// The terms of a toss whose `momentum` (BF) is known in a `unit` (rad/s) with its square and size.
    #[inline]
    pub(crate) fn of_momentum(toss: &Toss, momentum: &Vector3<f64>, squared: f64, size: f64, unit: f64) -> Self {
        let (x, y, z) = (momentum.x, momentum.y, momentum.z);
        let across = x * x + y * y;
        let (vertical, norm) = toss.launch.attitude().vertical();
        let spin = ((toss.coin.inertia_ratio() - 1.0) * (toss.launch.rate().z / unit)).abs();
        if squared < SLOWEST_SQUARED {
            // At rest. Or precessing so slowly next to the spin, whose rate is above ½ then, that the spin's phase is too
            // large (2^53) when that of the precession is still below 1e-83.
            return Self { mean: vertical[2], cosine: 0.0, sine: 0.0, size: norm, rates: [0.0, spin], unit };
        }
        let [mean, cosine, sine] = terms(vertical, [x, y, z], across);
        Self { mean, cosine, sine: sine * size, size: norm * squared, rates: [size, spin], unit }
    }

    /// ωL t and |q| t (rad) for a `time` (s).
    #[inline]
    pub fn phases(&self, time: f64) -> [f64; 2] {
        let time = self.unit * time;
        // A motion without a rate has phase 0 at any time, also where the product would be 0 · ∞.
        self.rates.map(|rate| if rate == 0.0 { 0.0 } else { rate * time })
    }

    /// `size` cos θ at a phase ωL t (rad).
    #[inline]
    pub fn height(&self, phase: f64) -> f64 {
        let (sin, cos) = phase.sin_cos();
        self.mean + (self.cosine * cos + self.sine * sin)
    }

    /// The phases at which the motion shows heads.
    pub fn heads(&self) -> HeadsPhases {
        HeadsPhases::new([self.mean, self.cosine, self.sine].map(|term| term / self.size), TERM_ERROR + UNIT_ROUNDOFF)
    }
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
            let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
            let terms = TiltTerms::new(&Toss { coin: Coin::from_moments(1.0, 0.0).unwrap(), launch });
            assert_eq!((terms.phases(1.0)[0], terms.heads().half_width), (0.0, half_width), "{rate:?} {tilt}");
            assert!((terms.height(0.0) / terms.size - tilt.cos()).abs() < 1e-15);
        }
    }

    #[test]
    fn errors_are_those_of_the_derivation() {
        assert_eq!([TERM_ERROR, PHASE_ERROR], [12.0, 6.0].map(|units: f64| units * f64::exp2(-53.0)));
    }

    #[test]
    fn phases_are_those_of_precession_and_spin() {
        let terms = |k: f64, rate: [f64; 3]| {
            let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(1.0)).unwrap();
            TiltTerms::new(&Toss { coin: Coin::from_moments(1.0, k).unwrap(), launch })
        };
        assert_eq!(terms(0.5, [30.0, 0.0, -80.0]).phases(2.0), [100.0, 80.0]);
        assert_eq!(terms(1.5, [0.0; 3]).phases(f64::INFINITY), [0.0, 0.0]);
        // The slowest precession that counts, next to a spin.
        assert_eq!(terms(0.0, [1e-100, 0.0, 1.0]).phases(1e100), [1.0, 1e100]);
        assert_eq!(terms(0.0, [0.99e-100, 0.0, 1.0]).phases(1e100), [0.0, 1e100]);
    }

    #[test]
    fn heads_are_shown_up_to_the_errors_of_the_terms() {
        let launch =
            Launch::new(Vector3::new(3.0, 1.0, 0.5), TimeOfFlight::Given(1.0)).unwrap().with_tilt(0.3).unwrap();
        let terms = TiltTerms::new(&Toss { coin: Coin::PAPER, launch });
        let cos_tilt = [terms.mean, terms.cosine, terms.sine].map(|term| term / terms.size);
        assert_eq!(terms.heads(), HeadsPhases::new(cos_tilt, 13.0 * UNIT_ROUNDOFF));
    }
}
