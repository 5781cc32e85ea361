//! This crate computes the free flight of a tossed coin: how it lands, how it moves, and how probable heads is. It is
//! the one crate of the workspace that you need to depend on, because it re-exports what the others offer.
//!
//! A coin has the moments of inertia I1 = I2 about its diameters and I3 = k I1 about its normal. If it
//! leaves the hand flat with the body rate ω, it precesses about its angular momentum at the rate
//! ωL = √(ωx² + ωy² + (k ωz)²). The angle ψ between the normal and the angular momentum is constant, with
//! cos ψ = k ωz/ωL. At the time t the angle θ between the normal and the vertical is given by
//!
//! ```text
//! cos θ(t) = cos²ψ + sin²ψ cos(ωL t)
//! ```
//!
//! A coin thrown up at the speed v0 is caught at t = 2 v0/g, where g is gravity. It lands heads if cos θ > 0. A coin
//! with ψ < 45° or ψ > 135° therefore shows heads at every time.
//!
//! All quantities are f64 in SI units. "The paper" is "Modeling the unfair toss of an unbiased coin".
//!
//! # A toss
//! This is the paper's cheated toss, with ω = (1, 1, 2.5) rad/s and a speed of 3 m/s. Its outcome is proven, and the
//! speed would have to grow by 3.4 m/s to flip it, or ωx by 1.5 rad/s. Read on at [`Toss`], [`Coin`] (real coins are in the [`catalogue`]),
//! [`certify`] and [`margin()`].
//!
//! ```
//! use toss::{Coin, ExactSolver, Launch, Registry, Settings, Solver, TimeOfFlight, Toss, Vector3, certify, margin};
//!
//! let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! let toss = Toss { coin: Coin::PAPER, launch: Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)? };
//! assert_eq!(certify(&toss)?.outcome().name(), "heads");
//! assert_eq!(format!("{:.8}", ExactSolver.cos_tilt(&toss)?), "0.66566129");
//! let nearest = margin(&toss)?;
//! assert_eq!(nearest.speed.map(|change| format!("{change:+.4} m/s")).as_deref(), Some("+3.4123 m/s"));
//! assert_eq!(nearest.rate[0].map(|change| format!("{change:+.4} rad/s")).as_deref(), Some("+1.4587 rad/s"));
//!
//! // The same flight, solved by an integrator that is chosen at run time.
//! let gamma = Registry::standard().named("gamma")?.solver(&Settings::default())?;
//! assert!((gamma.cos_tilt(&toss)? - ExactSolver.cos_tilt(&toss)?).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A trace
//! Any solver can follow a flight at equally spaced times. Read on at [`trace()`] and [`Registry`]. To solve many
//! tosses at once, see [`Batch`].
//!
//! ```
//! # use toss::{Coin, ExactSolver, Launch, TimeOfFlight, Toss, Vector3};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss { coin: Coin::PAPER, launch: Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)? };
//! let flight = toss::trace(&ExactSolver, &toss, 4)?;
//! let shown: Vec<String> = flight.iter().map(|point| format!("{:.2} s {:.3}", point.time, point.cos_tilt)).collect();
//! assert_eq!(shown, ["0.00 s 1.000", "0.20 s 0.959", "0.41 s 0.842", "0.61 s 0.666"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A probability
//! Real launches vary. Here a US quarter is thrown at 3 to 5 m/s; it tumbles at 20 to 60 rad/s and spins at 5 to 15
//! rad/s. The speed is integrated in closed form and the rates are sampled. Read on at [`sampling`]: a
//! [`Space`](sampling::Space) describes the launches, and a [`Plan`](sampling::Plan) chooses which of them are tried.
//!
//! ```
//! use toss::catalogue::named_coin;
//! use toss::sampling::{Plan, Rest, Sampler, Scrambled, Space};
//!
//! let space = Space::builder(named_coin("us-quarter")?)
//!     .rate_x(20.0..=60.0)
//!     .rate_y(0.0)
//!     .rate_z(5.0..=15.0)
//!     .speed(3.0..=5.0)
//!     .build()?;
//! let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 14, 1)));
//! let found = Sampler::exact().estimate(&space, plan)?;
//! let interval = found.interval.ok_or("eight scrambles have an interval")?;
//! let found = format!("{:.4}, within {:.4} to {:.4}", found.probability, interval.lo, interval.hi);
//! assert_eq!(found, "0.6247, within 0.6246 to 0.6248");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A plan
//! You don't need a trajectory to know the outcome. A [`Scene`] says what is wanted and how accurately, and the planner
//! takes the cheapest model that gives it. Read on at [`Want`], [`MODELS`] and [`Scene::plan`].
//!
//! ```
//! use toss::{Answer, Scene, Want};
//! # use toss::{Coin, Launch, TimeOfFlight, Toss, Vector3};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss { coin: Coin::PAPER, launch: Launch::new(Vector3::new(1.0, 1.0, 2.5), thrown)? };
//!
//! let outcome = Scene::new(Want::Outcome(toss), 1e-9).solve()?;
//! assert!(matches!(outcome.answer, Answer::Outcome(verdict) if verdict.is_proven()));
//! let tilt = Scene::new(Want::Tilt(toss), 1e-9);
//! assert_eq!(tilt.plan()?.choice.model.name, "tilt");
//! assert!(matches!(tilt.solve()?.answer, Answer::Tilt(cos_tilt) if (cos_tilt - 0.665_661_287).abs() < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The crate's folder `examples` answers further questions: which launches are fair, how to launch for a wanted
//! probability, how much people's coins wobble.

mod answer;
mod choice;
pub mod fitted;
mod integrators;
mod model;
mod plan;
mod reason;
mod registry;
mod samples;
mod scene;
mod trace;

// The coin, its launch and its flight.
pub use dynamics::catalogue;
pub use dynamics::{
    Angle, AngleUnit, Attitude, Coin, Dimension, EulerAngles, Launch, Outcome, Quantity, State, TimeOfFlight, Toss,
    Tosses, Unit, Vector3,
};

// Solvers: to choose one, or to write your own.
pub use dynamics::{
    Checked, Formulation, Propagation, Scheme, Settings, Solver, SolverEntry, StepControl, Stepping, Work,
};
pub use kinematics_euler::{EulerAnglesSolver, GammaSolver};
pub use kinematics_quat::{QuaternionSolver, TAYLOR};
pub use registry::{Backend, Registry};

// The exact motion, and what follows from it.
pub use exact::{
    Batch, Certificate, ExactMotion, ExactSolver, Margin, Sensitivity, Stage, certify, margin, speeds_of_heads,
    thrown_speeds_of_heads,
};
pub use numerics::lanes::SimdLevel;

// Probabilities over many launches.
pub use sampling;

// Questions, and the models that answer them.
pub use answer::{Answer, Verdict};
pub use choice::{Candidate, Choice, Decision, How, Offer};
pub use model::{MODELS, Model};
pub use plan::Solution;
pub use reason::{Nanoseconds, Reason};
pub use scene::{Integrator, Scene, Want, WantKind};
pub use trace::{MOST_POINTS, TracePoint, trace, trace_every};

// Errors.
pub use dynamics::{Error, InputError, SolveError};
