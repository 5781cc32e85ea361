//! The integrator of the flight as a quaternion, Q' = ½ Q ⊗ (0, ω), where Q is the attitude and ω the body rate. Unlike
//! the Euler angles, the quaternion has no singular attitude, so that no launch needs a special case.
//!
//! What is integrated is the quaternion P that leads from the attitude Q0 at launch to the attitude Q = Q0 ⊗ P. It
//! starts at 1 for every toss, so that neither the error nor the work depends on how the coin is held at launch.
//!
//! The state is (P, ωx, ωy). The body rate is integrated along with the attitude, by Euler's equations (1) of the
//! paper; their closed-form solution is never used. Rates are dimensionless, as in a [`Flight`](dynamics::Flight).
//!
//! The Runge-Kutta schemes are those of `dynamics::integrate`. Taylor series are in this crate, because they need the
//! recurrences of the coefficients in addition to the right-hand side: `taylor/coin.rs` computes one step, `plan.rs` chooses
//! its length, and `lockstep.rs` runs the flights. Flights by them bound their own error: see `prove`.
//!
//! Any other rigid body has three rates that change, about its principal axes (`taylor/rigid.rs`). The formulations mean the
//! same for it: in [`Formulation::RAW`](dynamics::Formulation::RAW) the quaternion is not projected.

mod landed;
mod prove;
mod solver;
mod system;
mod taylor;

pub use crate::prove::certificate::IntegratedCertificate;
pub use crate::prove::counts::{IntegratedCounts, Proving};
pub use crate::solver::{QuaternionSolver, TAYLOR};
pub use crate::system::QuaternionSystem;
