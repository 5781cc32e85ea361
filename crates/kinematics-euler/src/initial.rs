//! Where the angles start: the frame they are taken in, and their values at launch.
//!
//! In the kinematics (5) write D = ωx sin γ + ωy cos γ = α' sin β and u = ωz - γ' = α' cos β. Angles taken in the frame
//! F describe the attitude `Q = F ⊗ z(α) x(β) z(γ)`.
//!
//! - [`Formulation::MOMENTUM`]: F's z axis is along s S, where the sign s is that of k ωz, so that n is on its side:
//!   β ≤ π/2, and a small sin β keeps its digits. Then β is constant, α' = s ωL and γ' = -q for the whole flight, with
//!   γ(0) = atan2(s ωx, s ωy), α(0) = 0. S is known at launch; that it stays is conservation of angular momentum, and
//!   the integration shows whether it does.
//! - [`Formulation::VERTICAL`]: F = 1. At sin β = 0 the motion has the regular limit u = k ωz / 2 and
//!   γ(0) = atan2(-ωy, ωx), where D = 0.
//! - [`Formulation::RAW`]: F = 1 and no limit: 0/0 at sin β = 0.

use std::f64::consts::PI;

use dynamics::{
    Attitude, EulerAngles, Flight, Formulation, Frame, Propagation, SolveError, State, Toss, Vector3, Work,
};

/// A launch whose sin ½β or cos ½β is below this is taken as vertical: the attitude differs by less than rounding.
const VERTICAL: f64 = f64::EPSILON;

/// The angles at launch and the frame they are taken in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InitialConditions {
    /// The frame F, as the turn from LF to it.
    pub(crate) frame: Attitude,
    /// Angles at launch.
    pub(crate) angles: EulerAngles,
    /// α' at launch, in the unit of `rate`.
    pub(crate) precession: f64,
    /// u = α' cos β at launch, in the unit of `rate`.
    pub(crate) u: f64,
}

impl InitialConditions {
    /// `rate`: the body rate at launch (BF) in any unit.
    pub(crate) fn new(toss: &Toss, rate: &Vector3<f64>, formulation: Formulation) -> Self {
        let momentum_z = toss.coin.inertia_ratio() * rate.z;
        let attitude = toss.launch.attitude();
        match (formulation.is_guarded(), formulation.frame()) {
            (true, Frame::Momentum) => Self::along_momentum(attitude, rate, momentum_z),
            (true, Frame::Vertical) => Self::vertical(attitude, rate, momentum_z),
            (false, _) => Self::from_kinematics(EulerAngles::principal(&attitude), rate),
        }
    }

    /// The landing at `angles` with the transverse rates `rate_x`, `rate_y` in the flight's unit.
    pub(crate) fn landing(
        &self,
        flight: &Flight,
        angles: &EulerAngles,
        [rate_x, rate_y]: [f64; 2],
        work: Work,
    ) -> Result<Propagation, SolveError> {
        // D = u = 0 leaves no β.
        if !angles.beta.is_finite() {
            return Err(flight.not_finite());
        }
        let state = State { attitude: self.frame * angles.attitude(), rate: flight.rate_at(rate_x, rate_y) };
        Ok(Propagation::new(state, work))
    }

    /// Whether n is along the frame's axis and stays there: a pure spin, or no motion.
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
        let [w, x, y, z] = launch.components();
        let (sin_half_beta, cos_half_beta) = (x.hypot(y), w.hypot(z));
        if sin_half_beta.min(cos_half_beta) > VERTICAL {
            return Self::from_kinematics(angles, rate);
        }
        let u = 0.5 * momentum_z;
        let gamma = (-rate.y).atan2(rate.x);
        let (angles, precession) = if cos_half_beta > sin_half_beta {
            (EulerAngles { alpha: angles.alpha + angles.gamma - gamma, beta: 0.0, gamma }, u)
        } else {
            (EulerAngles { alpha: angles.alpha - angles.gamma + gamma, beta: PI, gamma }, -u)
        };
        Self { frame: Attitude::IDENTITY, angles, precession, u }
    }

    /// By (5), which has no answer at sin β = 0.
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
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(1.0)).unwrap().with_attitude(attitude);
        InitialConditions::new(&Toss { coin: Coin::PAPER, launch }, &Vector3::from(rate), formulation)
    }

    #[test]
    fn a_level_momentum_counts_as_up() {
        for (rate_z, up) in [(0.0, true), (1e-300, true), (-1e-300, false)] {
            assert_eq!(start([1.0, 2.0, rate_z], [1.0, 0.0, 0.0, 0.0], Formulation::MOMENTUM).precession > 0.0, up);
        }
    }

    #[test]
    fn up_to_a_rounding_from_the_pole_a_launch_is_taken_as_vertical() {
        for (half_beta, vertical) in [(VERTICAL, true), (2.0 * VERTICAL, false)] {
            for components in [[1.0, half_beta, 0.0, 0.0], [half_beta, 1.0, 0.0, 0.0]] {
                let found = start([1.0, 2.0, 3.0], components, Formulation::VERTICAL);
                assert_eq!(found.u == 0.5 * 0.5 * 3.0, vertical, "{components:?}: {found:?}");
            }
        }
    }
}
