//! The paper's two systems, (5) and (9)-(11), exactly as it prints them, without guards at their singular points. They
//! show where the printed equations fail, and should not be relied on: an answer may be wrong without an error.

use dynamics::EulerAngles;
use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use nalgebra::SVector;

/// The constants of both right-hand sides: ωz, and q = (k - 1) ωz with the inertia ratio k.
struct Spin {
    rate_z: f64,
    q: f64,
}

impl Spin {
    fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        Self { rate_z, q: body_precession_rate(inertia_ratio, rate_z) }
    }
}

/// The system (5) over the state (α, β, γ, ωx, ωy). It reads 0/0 at sin β = 0.
pub(crate) struct RawAngles(Spin);

impl RawAngles {
    pub(crate) fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        Self(Spin::new(inertia_ratio, rate_z))
    }
}

impl OdeSystem<5> for RawAngles {
    fn derivative(&self, y: &SVector<f64, 5>) -> SVector<f64, 5> {
        let &[_, beta, gamma, rate_x, rate_y] = &y.data.0[0];
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        let precession = (rate_x * sin_gamma + rate_y * cos_gamma) / beta.sin();
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(self.0.q, rate_x, rate_y);
        let nutation = rate_x * cos_gamma - rate_y * sin_gamma;
        SVector::from([precession, nutation, self.0.rate_z - precession * beta.cos(), rate_x_dot, rate_y_dot])
    }
}

/// The system (10) and (11) over the state (γ, γ', α, ωx, ωy), with β from tan β = D/u (9) and α' = u/cos β. It reads
/// 0/0 at D = 0, and the arc tangent loses the quadrant of β. The numerators of (11) are printed as sums of products; here
/// they have β' as a factor, which is the same number.
pub(crate) struct RawGamma(Spin);

impl RawGamma {
    pub(crate) fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        Self(Spin::new(inertia_ratio, rate_z))
    }

    /// The angles at the state `y`, with β between -π/2 and π/2.
    pub(crate) fn angles(&self, y: &SVector<f64, 5>) -> EulerAngles {
        let &[gamma, gamma_rate, alpha, rate_x, rate_y] = &y.data.0[0];
        let (sin, cos) = gamma.sin_cos();
        let beta = ((rate_x * sin + rate_y * cos) / (self.0.rate_z - gamma_rate)).atan();
        EulerAngles { alpha, beta, gamma }
    }
}

impl OdeSystem<5> for RawGamma {
    fn derivative(&self, y: &SVector<f64, 5>) -> SVector<f64, 5> {
        let &[gamma, gamma_rate, _, rate_x, rate_y] = &y.data.0[0];
        let Spin { rate_z, q } = self.0;
        let (sin, cos) = gamma.sin_cos();
        let (d, beta_rate) = (rate_x * sin + rate_y * cos, rate_x * cos - rate_y * sin);
        let a = (3.0 * rate_z - q) * beta_rate / d;
        let b = -2.0 * beta_rate / d;
        let c = -(rate_z * (rate_z - q) + d * d) * beta_rate / d;
        let precession = (rate_z - gamma_rate) / self.angles(y).beta.cos();
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(q, rate_x, rate_y);
        let gamma_acceleration = -(a * gamma_rate + b * gamma_rate * gamma_rate + c);
        SVector::from([gamma_rate, gamma_acceleration, precession, rate_x_dot, rate_y_dot])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (11) with the terms of the paper, which has ωx' and ωy', and sin 3γ and cos 2γ in C.
    #[test]
    fn the_printed_sums_of_eq_11_have_the_factors_of_the_code() {
        for (k, rate_z) in [(0.5, 2.5), (1.98, -0.7), (1.0, 3.0), (0.0, 1.1)] {
            for [gamma, gamma_rate, x, y] in [[0.3, 1.7, 1.0, 1.0], [-2.0, -0.4, 2.0, -1.5], [2.9, 0.2, -0.6, 1.3]] {
                let system = RawGamma::new(k, rate_z);
                let found = system.derivative(&SVector::from([gamma, gamma_rate, 0.0, x, y]))[1];
                let (x_dot, y_dot) = transverse_acceleration(system.0.q, x, y);
                let ((sin, cos), z): ((f64, f64), f64) = (f64::sin_cos(gamma), rate_z);
                let a = (3.0 * z * x - y_dot) * cos - (3.0 * z * y + x_dot) * sin;
                let b = 2.0 * (y * sin - x * cos);
                let c = -x.powi(3) * cos * sin.powi(2)
                    + 0.25 * (sin - 3.0 * f64::sin(3.0 * gamma)) * x * x * y
                    + 0.5 * x * cos * (-2.0 * z * z + (1.0 - 3.0 * f64::cos(2.0 * gamma)) * y * y)
                    + (z * z * y + y.powi(3) * cos.powi(2) + z * x_dot) * sin
                    + z * y_dot * cos;
                let expected = -(a * gamma_rate + b * gamma_rate * gamma_rate + c) / (x * sin + y * cos);
                assert!((found - expected).abs() < 1e-13 * (1.0 + expected.abs()), "k {k}: {found}, not {expected}");
            }
        }
    }

    /// From D = α' sin β and u = α' cos β follows D' u - D u' = α'² β' = (D² + u²) β'. With u' = -γ'' this gives γ''
    /// without (10), to compare with.
    #[test]
    fn the_gamma_equation_is_the_kinematics_differentiated() {
        for (k, rate_z) in [(0.5, 2.5), (1.98, -0.7), (1.0, 3.0), (0.0, 1.1)] {
            for [gamma, gamma_rate, rate_x, rate_y] in
                [[0.3, 1.7, 1.0, 1.0], [-2.0, -0.4, 2.0, -1.5], [2.9, 0.2, -0.6, 1.3]]
            {
                let system = RawGamma::new(k, rate_z);
                let found = system.derivative(&SVector::from([gamma, gamma_rate, 0.0, rate_x, rate_y]))[1];
                let (sin, cos): (f64, f64) = gamma.sin_cos();
                let (d, u) = (rate_x * sin + rate_y * cos, rate_z - gamma_rate);
                let beta_rate = rate_x * cos - rate_y * sin;
                let (rate_x_dot, rate_y_dot) = transverse_acceleration(system.0.q, rate_x, rate_y);
                let d_dot = rate_x_dot * sin + rate_y_dot * cos + gamma_rate * beta_rate;
                let expected = (beta_rate * (d * d + u * u) - u * d_dot) / d;
                assert!((found - expected).abs() < 1e-13 * (1.0 + expected.abs()), "k {k}: {found}, not {expected}");
            }
        }
    }
}
