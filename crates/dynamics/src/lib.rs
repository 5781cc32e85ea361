//! The free flight of a tossed coin.
//!
//! A coin of principal moments I1 = I2 and I3 leaves a hand with the body rate ω and flies for the time T, free of
//! torque and drag. The source of the equations is the paper "Modeling the unfair toss of an unbiased coin"; numbers
//! in parentheses are the paper's.
//!
//! The data flows one way, a file for each step:
//!
//! | step | file |
//! |---|---|
//! | geometry → moments of inertia | [`coin`], [`catalogue`] |
//! | coin + body rate + attitude + time of flight; as plain data | [`launch`], [`mod@time_of_flight`], [`state`], [`data`] |
//! | Euler's equations and what they conserve | [`body_rate`] |
//! | attitude: quaternion and Euler angles | [`attitude`], [`euler_angles`] |
//! | the exact motion, to the last bit | [`exact`], [`double_double`] |
//! | cos θ in f64, when it shows heads, how far the other outcome is | [`tilt_terms`], [`heads`], [`mod@margin`] |
//! | derivatives of the landing by the launch | [`sensitivity`] |
//! | cheaper forms: without a motion, of Keller's coin, in compensated f64 | [`mod@certain`], [`keller`], [`compensated`] |
//! | many tosses at once; numbers in vectors | [`batch`], [`lanes`] |
//! | outcomes, and their proofs | [`outcome`], [`certified`] |
//! | what a solver is; the exact one; how the others step | [`solver`], [`exact_solver`], [`method`], [`flight`], [`integrate`] |
//! | what can go wrong | [`error`] |
//!
//! # Frames
//! - LF, the laboratory frame: z up.
//! - TF, the transport frame: LF carried along with the centre of mass. A free coin turns in it as if at rest.
//! - BF, the body frame: z along the coin's normal n, the head's side.
//!
//! All quantities are f64 in SI units. There is no random number, no clock and no input or output in this crate.

pub mod attitude;
pub mod batch;
pub mod body_rate;
pub mod catalogue;
pub mod certain;
pub mod certified;
pub mod coin;
pub mod compensated;
pub mod data;
pub mod double_double;
pub mod error;
pub mod euler_angles;
pub mod exact;
pub mod exact_solver;
pub mod flight;
pub mod heads;
pub mod integrate;
pub mod keller;
pub mod lanes;
pub mod launch;
pub mod margin;
pub mod method;
pub mod outcome;
pub mod scale;
pub mod sensitivity;
pub mod solver;
pub mod state;
pub mod tilt_terms;
pub mod time_of_flight;

pub use attitude::Attitude;
pub use certain::certain;
pub use certified::{Certificate, certify};
pub use coin::Coin;
pub use compensated::{compensated_cos_tilt, compensated_landing};
pub use error::{InputError, Singularity, SolveError};
pub use euler_angles::EulerAngles;
pub use exact::ExactMotion;
pub use exact_solver::ExactSolver;
pub use flight::Flight;
pub use heads::HeadsPhases;
pub use launch::{Launch, Toss};
pub use margin::{Margin, margin, speeds_of_heads};
pub use method::{Method, Scheme, StepControl};
pub use nalgebra::Vector3;
pub use outcome::{Outcome, Stage, Verdict};
pub use sensitivity::Sensitivity;
pub use solver::{Formulation, Propagation, Settings, Solver, SolverEntry, Work};
pub use state::State;
pub use tilt_terms::TiltTerms;
pub use time_of_flight::TimeOfFlight;
