//! This crate computes the exact motion of a free coin or another rigid body by its closed form, and what follows from it: outcomes with a
//! proof, sensitivities, margins and fast batches. It is a crate of its own so that no integrator can use the closed
//! form against which it is judged.
//!
//! | what | file |
//! |---|---|
//! | rates, attitude, cos θ and Euler angles at any time, to the last bits | [`motion`] |
//! | cos θ as three terms in f64; the phases that show heads | [`tilt_terms`], [`heads`] |
//! | how far the other outcome is: the nearest flip by each input alone; the search for flips | [`mod@margin`], `flips` |
//! | the speeds that land heads, for a landing at any height | [`speeds`] |
//! | derivatives of the landing with respect to the launch | [`sensitivity`] |
//! | a cheaper form, in compensated f64 | [`compensated`] |
//! | outcomes with a proof, also in as many digits as it takes; the numbers as given; the types that carry the proof | [`certified`], `multiprecision`, `given`, [`certificate`] |
//! | the motion of any rigid body, and its outcomes with a proof | [`rigid`] |
//! | many tosses at once, in SIMD registers, of coins and other bodies | [`batch`] |
//! | the exact motion as a [`Solver`](dynamics::Solver) | [`solver`] |
//!
//! Symbols and frames are those of the crate [`dynamics`]: BF is the body frame, LF the laboratory frame. The crates of
//! the integrators do not depend on this crate.

pub mod batch;
pub mod certificate;
pub mod certified;
pub mod compensated;
mod flips;
mod given;
pub mod heads;
pub mod margin;
pub mod motion;
mod multiprecision;
mod polar;
pub mod rigid;
pub mod sensitivity;
pub mod solver;
pub mod speeds;
pub mod tilt_terms;

pub use batch::{Batch, BodyFilter};
pub use certificate::{Certificate, ProvenCounts, STAGES};
pub use compensated::{compensated_cos_tilt, compensated_landing};
pub use heads::HeadsPhases;
pub use margin::{Margin, margin};
pub use motion::CoinMotion;
pub use rigid::{ExactMotion, RigidAngles, certify};
pub use sensitivity::Sensitivity;
pub use solver::ExactSolver;
pub use speeds::{level_speeds_of_heads, speeds_of_heads};
pub use tilt_terms::TiltTerms;
