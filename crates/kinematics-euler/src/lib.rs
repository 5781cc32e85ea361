//! Two integrators of the flight in Euler angles z-x-z, α (precession), β (nutation) and γ (spin): one solves the three
//! angles (5), the other the γ-ODE (10), the paper's own equation. They exist to compare the paper's equations with the
//! exact motion.
//!
//! Numbers in parentheses are equations of the paper "Modeling the unfair toss of an unbiased coin"; symbols are those
//! of [`dynamics`]. Both integrators start from the same initial conditions (`initial.rs`), which follow from the
//! [`Formulation`](dynamics::Formulation) and include the regular limit at sin β = 0. Both systems without any guard,
//! exactly as the paper prints them, are in `raw.rs`. The states include ωx and ωy, integrated by Euler's equations
//! (1); the closed-form solution is never used. The three angles of any other rigid body, with three rates, are in
//! `rigid.rs`; the γ-ODE refuses such a body.

pub mod angles;
pub mod gamma;
mod initial;
mod passes;
mod raw;
mod rigid;

pub use angles::EulerAnglesSolver;
pub use gamma::GammaSolver;
