//! The initial conditions of both integrators: the frame in which the Euler angles α, β, γ are taken, and their values
//! at launch. They are derived once, because a launch from horizontal is a singular point of the vertical frame.
//!
//! In the kinematics (5) write D = ωx sin γ + ωy cos γ = α' sin β and u = ωz - γ' = α' cos β, where ω is the body rate.
//! Angles taken in the frame F describe the attitude `Q = F ⊗ z(α) x(β) z(γ)`. Further, n is the coin's normal, S the
//! angular momentum, k = I3/I1, ωL = |S|/I1 and q = (k - 1) ωz.
//!
//! - [`Formulation::MOMENTUM`]: the z axis of F is along s S, where s = ±1 is the sign of k ωz. This side of S is the
//!   side of n, so that β ≤ π/2, and a small sin β keeps its digits. The angles start at γ(0) = atan2(s ωx, s ωy) and
//!   α(0) = 0. In the exact motion β is constant, α' = s ωL and γ' = -q. F is computed at launch and assumed to stay
//!   fixed, as it does if angular momentum is conserved; the integrated motion shows whether it is.
//! - [`Formulation::VERTICAL`]: F = 1. At sin β = 0 the motion has the regular limit u = k ωz / 2 and
//!   γ(0) = atan2(-ωy, ωx), where D = 0.
//! - [`Formulation::RAW`]: F = 1, and (5) as it is, which reads 0/0 at sin β = 0.

use std::f64::consts::PI;

use dynamics::{
    Attitude, CoinToss, EulerAngles, Flight, Formulation, Frame, Landing, SolveError, State, Vector3, Work,
};

/// A launch with sin ½β or cos ½β at most this is taken as vertical (β = 0 or β = π), which changes its attitude by
/// at most 2 ε = 4.4e-16 rad.
const VERTICAL: f64 = f64::EPSILON;

/// How n is along the vertical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pole {
    /// β = 0.
    Upright,
    /// β = π.
    Inverted,
}

impl Pole {
    /// That of a launch within [`VERTICAL`] of one.
    pub(crate) fn of(launched: &Attitude) -> Option<Self> {
        let [w, x, y, z] = launched.components();
        let (sin_half_beta, cos_half_beta) = (x.hypot(y), w.hypot(z));
        let pole = if cos_half_beta > sin_half_beta { Self::Upright } else { Self::Inverted };
        (sin_half_beta.min(cos_half_beta) <= VERTICAL).then_some(pole)
    }

    /// The angles of the same attitude as the `principal` ones, with this γ.
    pub(crate) fn angles(self, principal: &EulerAngles, gamma: f64) -> EulerAngles {
        match self {
            Self::Upright => EulerAngles { alpha: principal.alpha + principal.gamma - gamma, beta: 0.0, gamma },
            Self::Inverted => EulerAngles { alpha: principal.alpha - principal.gamma + gamma, beta: PI, gamma },
        }
    }
}

/// The frame of the angles, and their values and rates at launch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InitialConditions {
    /// The frame F, as the turn from LF (the laboratory frame) to it.
    pub(crate) frame: Attitude,
    /// The angles at launch (rad).
    pub(crate) angles: EulerAngles,
    /// α' at launch, in the unit of the rates.
    pub(crate) precession: f64,
    /// u = α' cos β at launch, in the unit of the rates.
    pub(crate) u: f64,
}

impl InitialConditions {
    /// The initial conditions of `toss`, whose body rate at launch is `rate` (BF, the body frame) in any unit.
    pub(crate) fn new(toss: &CoinToss, rate: &Vector3<f64>, formulation: Formulation) -> Self {
        let momentum_z = toss.coin.inertia_ratio() * rate.z;
        let attitude = toss.launch.attitude();
        match (formulation.is_guarded(), formulation.frame()) {
            (true, Frame::Momentum) => Self::along_momentum(attitude, rate, momentum_z),
            (true, Frame::Vertical) => Self::vertical(attitude, rate, momentum_z),
            (false, _) => Self::from_kinematics(EulerAngles::principal(&attitude), rate),
        }
    }

    /// The landing of `flight` at `angles`, with the transverse rates ωx and ωy in the flight's unit.
    pub(crate) fn landing(
        &self,
        flight: &Flight,
        angles: &EulerAngles,
        [rate_x, rate_y]: [f64; 2],
        work: Work,
    ) -> Result<Landing, SolveError> {
        // β is NaN if the raw γ-ODE ends at D = u = 0.
        if !angles.beta.is_finite() {
            return Err(flight.not_finite());
        }
        let state =
            State { attitude: self.frame * angles.attitude(), rate: flight.rate_at([rate_x, rate_y, flight.rate.z]) };
        Ok(Landing::new(state, work))
    }

    /// Whether n is along the frame's z axis and stays there, as in pure spin or at rest.
    pub(crate) fn rests_at_the_pole(&self, rate: &Vector3<f64>) -> bool {
        self.angles.beta == 0.0 && rate.x == 0.0 && rate.y == 0.0
    }

    fn along_momentum(launch: Attitude, rate: &Vector3<f64>, momentum_z: f64) -> Self {
        let sense = if momentum_z < 0.0 { -1.0 } else { 1.0 };
        let transverse = rate.x.hypot(rate.y);
        let (beta, gamma) = (transverse.atan2(momentum_z.abs()), (sense * rate.x).atan2(sense * rate.y));
        let angles = EulerAngles { alpha: 0.0, beta, gamma };
        let precession = sense * transverse.hypot(momentum_z);
        Self { frame: launch * angles.attitude().inverse(), angles, precession, u: momentum_z }
    }

    fn vertical(launch: Attitude, rate: &Vector3<f64>, momentum_z: f64) -> Self {
        let angles = EulerAngles::principal(&launch);
        let Some(pole) = Pole::of(&launch) else { return Self::from_kinematics(angles, rate) };
        let u = 0.5 * momentum_z;
        let angles = pole.angles(&angles, (-rate.y).atan2(rate.x));
        let precession = if pole == Pole::Upright { u } else { -u };
        Self { frame: Attitude::IDENTITY, angles, precession, u }
    }

    /// The rates by (5), which are not finite at sin β = 0.
    fn from_kinematics(angles: EulerAngles, rate: &Vector3<f64>) -> Self {
        let (sin_gamma, cos_gamma) = angles.gamma.sin_cos();
        let precession = (rate.x * sin_gamma + rate.y * cos_gamma) / angles.beta.sin();
        Self { frame: Attitude::IDENTITY, angles, precession, u: precession * angles.beta.cos() }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight};

    use super::*;

    fn start(rate: [f64; 3], components: [f64; 4], formulation: Formulation) -> InitialConditions {
        let attitude = Attitude::from_components(components).unwrap();
        let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_attitude(attitude);
        InitialConditions::new(&CoinToss { coin: Coin::PAPER, launch }, &Vector3::from(rate), formulation)
    }

    #[test]
    fn a_level_momentum_counts_as_up() {
        for (rate_z, up) in [(0.0, true), (1e-300, true), (-1e-300, false)] {
            assert_eq!(start([1.0, 2.0, rate_z], [1.0, 0.0, 0.0, 0.0], Formulation::MOMENTUM).precession > 0.0, up);
        }
    }

    #[test]
    fn a_launch_within_rounding_of_the_pole_is_taken_as_vertical() {
        for (half_beta, vertical) in [(VERTICAL, true), (2.0 * VERTICAL, false)] {
            for components in [[1.0, half_beta, 0.0, 0.0], [half_beta, 1.0, 0.0, 0.0]] {
                let found = start([1.0, 2.0, 3.0], components, Formulation::VERTICAL);
                assert_eq!(found.u == 0.5 * 0.5 * 3.0, vertical, "{components:?}: {found:?}");
            }
        }
    }
}
