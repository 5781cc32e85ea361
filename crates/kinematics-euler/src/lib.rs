//! The flight integrated in Euler angles z-x-z: as the three angles (5), and as the γ-ODE (10).
//!
//! Both follow the same angles from the same start, in the frame that [`Frame`](dynamics::Frame) names; the file
//! `start.rs` derives it, with the regular limit at sin β = 0. Both carry ωx and ωy by Euler's equations (1) in their state, never by the
//! closed-form solution.

pub mod angles;
pub mod gamma;
mod start;

pub use angles::EulerAnglesSolver;
pub use gamma::GammaSolver;
