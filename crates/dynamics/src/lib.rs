//! The coin, its launch and its motion in free flight, and the trait of the solvers that compute where it lands. All
//! integrators and the exact motion build on these types, so that they solve the same problem.
//!
//! A coin of principal moments I1 = I2 and I3 leaves a hand with the body rate ω and flies for the time T, free of
//! torque and drag. The equations are those of the paper "Modeling the unfair toss of an unbiased coin". A number in
//! parentheses, like (5), is an equation of the paper.
//!
//! | what | module |
//! |---|---|
//! | the coin's moments of inertia, from its geometry or by its name | [`coin`], [`catalogue`] |
//! | any rigid body, by its moments or its inertia tensor, and its toss | [`body`], [`toss`] |
//! | the toss: coin, body rate, attitude and time of flight | [`launch`], [`mod@time_of_flight`], [`state`] |
//! | a toss as somebody gives it, as plain data in a file, many tosses as columns of numbers | [`thrown`], [`data`], [`columns`] |
//! | Euler's equations and what they conserve; how far a motion turns | [`body_rate`], [`phase`] |
//! | the attitude as a quaternion and as Euler angles | [`attitude`], [`euler_angles`] |
//! | heads or tails, and numbers of them | [`outcome`], [`counts`] |
//! | the solver trait, the check of a solver's answers, solvers by name | [`solver`], [`checked`], [`entry`], [`config`] |
//! | how integrators step | [`scheme`], [`stepping`], [`formulation`], [`flight`], [`integrate`] |
//! | a function or a stepper from elsewhere as a solver | [`adapter`], [`free_rotation`] |
//! | errors | [`error`], [`failure`] |
//!
//! # Frames
//! - LF, the laboratory frame: its z axis points up.
//! - TF, the transport frame: LF carried along with the centre of mass. Seen from it, the coin turns but does not fall.
//! - BF, the body frame: fixed in the coin, its z axis along the coin's normal n on the side of heads.
//!
//! # Symbols
//! | symbol | meaning |
//! |---|---|
//! | I1 = I2, I3 | principal moments of inertia, I3 about n (kg m²) |
//! | k | inertia ratio I3/I1, from 0 (rod) to 2 (flat disc) |
//! | ω = (ωx, ωy, ωz) | body rate (BF, rad/s); ωz is the spin |
//! | Ω | √(ωx² + ωy²) (rad/s) |
//! | S | angular momentum (kg m²/s) |
//! | ωL | \|S\|/I1, rate of the precession about S (rad/s) |
//! | q | (k - 1) ωz, rate at which (ωx, ωy) turns in BF (rad/s) |
//! | ψ | cone angle, between n and S (rad) |
//! | θ | tilt, between n and the vertical; heads for cos θ > 0 |
//! | α, β, γ | Euler angles z-x-z: precession, nutation, spin (rad) |
//! | Q = (w, x, y, z) | attitude, the unit quaternion that leads from BF to LF |
//! | T, v0, g, h | time of flight (s), speed (m/s), gravity (m/s²), drop (m) |
//!
//! All quantities are f64 in SI units. This crate uses no random numbers, no clock, no input and no output. It does not
//! contain the closed form of the motion either, which is in the crate `exact`: integrators do not
//! depend on that crate, and so cannot use the solution that they are compared with.
//!
//! # Features
//! Both are on by default. `integrators` has the Runge-Kutta driver ([`integrate`]). `serde` reads and writes coins, launches,
//! choices of solvers and outcomes as plain data ([`data`]).

pub mod adapter;
pub mod attitude;
pub mod body;
pub mod body_rate;
pub mod catalogue;
pub mod checked;
pub mod coin;
pub mod columns;
pub mod config;
pub mod counts;
pub mod data;
pub mod entry;
pub mod error;
pub mod euler_angles;
pub mod failure;
pub mod flight;
pub mod formulation;
pub mod free_rotation;
#[cfg(feature = "integrators")]
pub mod integrate;
pub mod launch;
mod look_alike;
pub mod outcome;
pub mod phase;
pub mod precession;
pub mod quantity;
pub mod scheme;
pub mod solver;
pub mod state;
pub mod stepping;
pub mod thrown;
pub mod time_of_flight;
pub mod toss;

pub use adapter::ForeignError;
pub use attitude::Attitude;
pub use body::{Body, ModelBody, PrincipalAxes, RigidBody};
pub use checked::Checked;
pub use coin::Coin;
pub use columns::Tosses;
pub use config::SolverConfig;
pub use counts::{Counts, Stage};
pub use entry::{Settings, SolverEntry};
pub use error::{Fault, InputError, Singularity, SolveError};
pub use euler_angles::EulerAngles;
pub use failure::Error;
pub use flight::Flight;
pub use formulation::{Formulation, Frame};
pub use free_rotation::FreeRotation;
pub use launch::Launch;
pub use nalgebra::{self, Vector3};
pub use numerics::{Quantity, Unit};
pub use outcome::Outcome;
pub use phase::Phases;
pub use precession::rate_of_precession;
pub use quantity::Dimension;
pub use scheme::Scheme;
pub use solver::{Landing, Solver, Tilt, Work};
pub use state::State;
pub use stepping::{StepControl, Stepping};
pub use thrown::Thrown;
pub use time_of_flight::TimeOfFlight;
pub use toss::{CoinToss, Toss};
