//! Tosses for downstream code: everything that describes a toss, the solvers, and the trace of a flight.
//!
//! ```
//! use toss::{Coin, ExactSolver, Launch, Solver, TimeOfFlight, Toss, Vector3};
//!
//! // The paper's cheated toss: ω = (1, 1, 2.5) rad/s, thrown up at 3 m/s.
//! let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! let launch = Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)?;
//! let toss = Toss { coin: Coin::PAPER, launch };
//! assert_eq!(ExactSolver.outcome(&toss)?.name(), "heads");
//!
//! // The same flight by a solver that is chosen at run time.
//! let solver = (toss::named_solver("gamma")?.build)(&toss::Settings::default());
//! assert!((solver.cos_tilt(&toss)? - 0.665_661_286_601_930_7).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod choice;
pub mod fitted;
mod integrator_plan;
pub mod model;
pub mod plan;
pub mod registry;
pub mod scene;
pub mod solve;
pub mod space_plan;
pub mod trace;

pub use choice::{Choice, Decision};
pub use dynamics::*;
pub use kinematics_euler::{EulerAnglesSolver, GammaSolver};
pub use kinematics_quat::{QuaternionSolver, QuaternionSystem};
pub use model::Model;
pub use registry::{SOLVERS, named_solver};
pub use scene::{Integrator, Scene, SceneError, Want};
pub use solve::{Answer, Solution};
pub use trace::{TracePoint, trace};

/// The README's Rust is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
