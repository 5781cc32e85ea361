//! [`EulerAnglesSolver`], which integrates the three Euler angles α, β, γ by the paper's kinematics (5). It needs no
//! derivation beyond (5), and so is the plainest of the integrators to compare the γ-ODE with.
//!
//! Solved for the derivatives, (5) reads
//!
//! ```text
//! α' = D / sin β,   β' = ωx cos γ - ωy sin γ,   γ' = ωz - α' cos β,      D = ωx sin γ + ωy cos γ
//! ```
//!
//! Here ω = (ωx, ωy, ωz) is the body rate. At sin β = 0 the equation for α' reads 0/0. A flight may start there, with
//! the limit α' cos β = k ωz / 2, where k is the inertia ratio I3/I1. A return to sin β = 0 is a typed error in the
//! vertical frame. In the momentum frame β is constant, so that no flight gets there.
//!
//! Any other rigid body has angles of its own (`rigid.rs`), except in [`Formulation::RAW`]: the paper's equations assume
//! a coin.

use std::f64::consts::PI;

use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use dynamics::{
    Body, CoinToss, EulerAngles, Flight, Formulation, Landing, Scheme, Settings, Singularity, SolveError, Solver,
    SolverEntry, Stepping, Toss,
};
use nalgebra::SVector;

use crate::initial::InitialConditions;
use crate::passes::Passes;
use crate::raw::RawAngles;
use crate::rigid;

/// Why the paper's equations solve coins alone.
const RAW_IS_FOR_COINS: &str = "the paper's equations suppose I1 = I2 and a constant ωz";

/// The solver that integrates the three Euler angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerAnglesSolver {
    stepping: Stepping,
    formulation: Formulation,
}

impl EulerAnglesSolver {
    /// The solver's name in the registry.
    pub const NAME: &'static str = "euler";

    /// The solver's entry for the registry.
    pub fn entry() -> SolverEntry {
        let build =
            |settings: &Settings| -> Box<dyn Solver> { Box::new(Self::new(settings.stepping, settings.formulation)) };
        SolverEntry::new(Self::NAME, "the three Euler angles (5)", build)
            .with_schemes(&Scheme::RUNGE_KUTTA)
            .with_formulations(&Formulation::ALL)
            .with_color([0, 114, 178])
    }

    /// A solver that integrates the equations of `formulation` with `stepping`.
    pub fn new(stepping: Stepping, formulation: Formulation) -> Self {
        Self { stepping, formulation }
    }
}

impl Solver for EulerAnglesSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let (landing, passes) = match toss.body {
            Body::Rigid(_) if self.formulation.is_guarded() => rigid::land(toss, &self.stepping, self.formulation)?,
            _ => self.land_coin(&toss.of_coin(Self::NAME, RAW_IS_FOR_COINS)?)?,
        };
        let growth = passes.growth(self.formulation);
        let estimate = self.stepping.error_estimate(toss)?.map(|estimate| growth * estimate);
        let tells_nothing = |estimate: f64| estimate >= 1.0 && matches!(toss.body, Body::Rigid(_));
        Ok(landing.with_error(estimate.filter(|estimate| !tells_nothing(*estimate))))
    }
}

impl EulerAnglesSolver {
    fn land_coin(&self, toss: &CoinToss) -> Result<(Landing, Passes), SolveError> {
        let flight = Flight::new(&Toss::from(*toss))?;
        let start = InitialConditions::new(toss, &flight.rate, self.formulation);
        let (k, rate_z) = (toss.coin.inertia_ratio(), flight.rate.z);
        let EulerAngles { alpha, beta, gamma } = start.angles;
        let first = SVector::from([alpha, beta, gamma, flight.rate.x, flight.rate.y]);
        let system = AnglesSystem::new(k, rate_z);
        let (end, work) = if self.formulation.is_guarded() {
            flight.integrate(&system, first, &self.stepping)?
        } else {
            flight.integrate(&RawAngles::new(k, rate_z), first, &self.stepping)?
        };
        let angles = EulerAngles { alpha: end[0], beta: end[1], gamma: end[2] };
        Ok((start.landing(&flight, &angles, [end[3], end[4]], work)?, system.kinematics.passes))
    }
}

/// The guarded kinematics (5) of the angles from any axis of any body.
pub(crate) struct Kinematics {
    /// The limit of u = α' cos β at sin β = 0; k ωz / 2 for a coin.
    limit_of_u: f64,
    pub(crate) passes: Passes,
}

impl Kinematics {
    pub(crate) fn new(limit_of_u: f64) -> Self {
        Self { limit_of_u, passes: Passes::none() }
    }

    /// α', β' and γ' at these angles and rates.
    #[inline(always)]
    pub(crate) fn rates(&self, beta: f64, gamma: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let ((sin_beta, cos_beta), (sin_gamma, cos_gamma)) = (beta.sin_cos(), gamma.sin_cos());
        let precession = if beta == 0.0 || beta.abs() == PI {
            // α' = u/cos β, and cos β = ±1 is its own inverse.
            cos_beta * self.limit_of_u
        } else {
            (x * sin_gamma + y * cos_gamma) / sin_beta
        };
        [precession, x * cos_gamma - y * sin_gamma, z - precession * cos_beta]
    }

    /// The singular point of a step between two states that begin with α and β.
    pub(crate) fn singularity<const N: usize>(
        &self,
        before: &SVector<f64, N>,
        after: &SVector<f64, N>,
    ) -> Option<Singularity> {
        self.passes.turned(after[0] - before[0]);
        let [was, is] = [before, after].map(|state| state[1].sin());
        let started_there = was.abs() < f64::EPSILON;
        (!started_there && was * is <= 0.0).then_some(Singularity::NormalAlongAxis)
    }
}

/// The guarded system over the state (α, β, γ, ωx, ωy).
struct AnglesSystem {
    /// ωz.
    rate_z: f64,
    /// q = (k - 1) ωz, the rate at which (ωx, ωy) turns in the body frame.
    q: f64,
    kinematics: Kinematics,
}

impl AnglesSystem {
    fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        let (q, limit_of_u) = (body_precession_rate(inertia_ratio, rate_z), 0.5 * inertia_ratio * rate_z);
        Self { rate_z, q, kinematics: Kinematics::new(limit_of_u) }
    }
}

impl OdeSystem<5> for AnglesSystem {
    fn derivative(&self, y: &SVector<f64, 5>) -> SVector<f64, 5> {
        let &[_, beta, gamma, rate_x, rate_y] = &y.data.0[0];
        let [alpha_dot, beta_dot, gamma_dot] = self.kinematics.rates(beta, gamma, [rate_x, rate_y, self.rate_z]);
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(self.q, rate_x, rate_y);
        SVector::from([alpha_dot, beta_dot, gamma_dot, rate_x_dot, rate_y_dot])
    }

    fn singularity(&self, before: &SVector<f64, 5>, after: &SVector<f64, 5>) -> Option<Singularity> {
        self.kinematics.singularity(before, after)
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Vector3};
    use exact::CoinMotion;

    use super::*;

    #[test]
    fn at_both_poles_the_derivatives_have_their_finite_limits() {
        for beta in [0.0, PI] {
            let system = AnglesSystem::new(0.5, 2.5);
            let derivative = system.derivative(&SVector::from([0.0, beta, 0.0, 3.0, 0.0]));
            assert_eq!(derivative[1], 3.0, "β' = Ω");
            assert_eq!(derivative[2], 2.5 - 0.5 * 0.5 * 2.5, "γ' = ωz - k ωz / 2");
        }
    }

    #[test]
    fn a_fixed_step_across_the_pole_is_an_error_with_its_time() {
        let launch = Launch::new(Vector3::new(9.0, 4.0, 3.0), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss::new(Coin::PAPER, launch);
        let first_return = 2.0 * PI / CoinMotion::new(&toss.coin().unwrap()).precession_rate();
        let stepping = Stepping::fixed(dynamics::Scheme::RK4, 1e-3).unwrap();
        let error = EulerAnglesSolver::new(stepping, Formulation::VERTICAL).land(&toss).unwrap_err();
        let SolveError::Singular { point: Singularity::NormalAlongAxis, time } = error else { panic!("{error}") };
        assert!((time - first_return).abs() < 5e-3, "{time}, not {first_return}");
    }

    #[test]
    fn a_step_across_or_onto_a_pole_is_singular_unless_it_starts_there() {
        let system = AnglesSystem::new(0.5, 1.0);
        let met = |was: f64, is: f64| {
            let [before, after] = [was, is].map(|beta| SVector::from([0.0, beta, 0.0, 1.0, 0.0]));
            system.singularity(&before, &after)
        };
        let pole = Some(Singularity::NormalAlongAxis);
        for (was, is) in
            [(0.02, -0.01), (0.01, -0.02), (-0.01, 0.02), (0.1, 0.0), (3.0, 3.2), (3.2, 3.0), (f64::EPSILON, -0.1)]
        {
            assert_eq!(met(was, is), pole, "{was} to {is}");
        }
        for (was, is) in [(0.02, 0.01), (-0.02, -0.01), (0.0, -0.1), (1e-17, -0.1), (PI, 3.2)] {
            assert_eq!(met(was, is), None, "{was} to {is}");
        }
    }
}
