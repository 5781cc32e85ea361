//! The forms that the motion of a rigid body takes, with their constants.

use numerics::elliptic::{GaussianPair, ThetaPair};

/// The part of the motion that is periodic in the body.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form<N, M = N> {
    /// The turn about the fixed `direction` (BF at launch), then the spin at the rate -2 `half_spin` about the axis
    /// `about`.
    Uniform { direction: [M; 3], half_spin: N, about: usize, rate: [M; 3] },
    /// By Fourier series: half-periods of the angular momentum in the unit of time, and at launch.
    Series { pair: ThetaPair<M>, frequency: N, launch: N },
    /// By Gaussians; `turn` is the angle c' of the phase that a half-period takes.
    Gaussian { pair: GaussianPair<M>, turn: M, frequency: N, launch: N },
    /// λ, e^u at launch, and (cos c, sin c).
    Separatrix { rate: N, launch: M, angle: [M; 2] },
}
