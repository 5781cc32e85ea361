//! The flight integrated in Euler angles z-x-z: as the three angles (5), and as the γ-ODE (10).
//!
//! Both follow the same angles from the same initial conditions, as their [`Formulation`](dynamics::Formulation) has it; the file
//! `initial.rs` derives them, with the regular limit at sin β = 0, and `raw.rs` has both systems without any guard. Both
//! carry ωx and ωy by Euler's equations (1) in their state, never by the closed-form solution.

pub mod angles;
pub mod gamma;
mod initial;
mod raw;

pub use angles::EulerAnglesSolver;
pub use gamma::GammaSolver;
