//! The exact motion of a free coin, and all that follows from it.
//!
//! | what | file |
//! |---|---|
//! | the motion: rates, attitude, cos θ, Euler angles, to the last bits | [`motion`] |
//! | cos θ as three terms in f64; the phases that show heads | [`tilt_terms`], [`heads`] |
//! | how far the other outcome is: the nearest flip by each input alone | [`mod@margin`] |
//! | derivatives of the landing by the launch | [`sensitivity`] |
//! | cheaper forms: without trigonometry, of Keller's coin, in compensated f64 | `trig_free`, `keller`, [`compensated`] |
//! | proven outcomes | [`certified`], [`certificate`] |
//! | many tosses at once, in registers | [`batch`] |
//! | the motion as a solver | [`solver`] |
//!
//! Symbols and frames are those of the crate [`dynamics`]. No integrator can use what is here: Cargo knows no way from
//! theirs to this crate.

pub mod batch;
pub mod certificate;
pub mod certified;
pub mod compensated;
pub mod heads;
mod keller;
pub mod margin;
pub mod motion;
mod polar;
pub mod sensitivity;
pub mod solver;
pub mod tilt_terms;
mod trig_free;

pub use batch::Batch;
pub use certificate::{Certificate, ProvenCounts, Stage};
pub use certified::certify;
pub use compensated::{compensated_cos_tilt, compensated_landing};
pub use heads::HeadsPhases;
pub use margin::{Margin, margin, speeds_of_heads};
pub use motion::ExactMotion;
pub use sensitivity::Sensitivity;
pub use solver::ExactSolver;
pub use tilt_terms::TiltTerms;
