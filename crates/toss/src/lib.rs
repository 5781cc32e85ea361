//! This crate computes the free flight of a tossed coin: how it lands, how it moves, and how probable heads is. It is
//! the one crate of the workspace that you need to depend on, because it re-exports what the others offer.
//!
//! A coin has the moments of inertia I1 = I2 about its diameters and I3 = k I1 about its normal. If it leaves the hand
//! flat with the body rate ω, it precesses about its angular momentum at the rate ωL = √(ωx² + ωy² + (k ωz)²). The angle
//! ψ between the normal and the angular momentum is constant, with cos ψ = k ωz/ωL. At the time t the angle θ between
//! the normal and the vertical is given by
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
//! speed would have to grow by 3.4 m/s to flip it, or ωx by 1.5 rad/s. Read on at [`Toss`], [`Coin`] (real coins are in
//! the [`catalogue`]), [`certify`] and [`margin()`].
//!
//! ```
//! use toss::{Coin, ExactSolver, Launch, Registry, Settings, Solver, TimeOfFlight, Toss, certify, margin};
//!
//! let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
//! assert_eq!(certify(&toss)?.outcome().name(), "heads");
//! assert_eq!(format!("{:.8}", ExactSolver.tilt(&toss)?.cos_tilt), "0.66566129");
//! let nearest = margin(&toss)?;
//! assert_eq!(nearest.speed.map(|change| format!("{change:+.4} m/s")).as_deref(), Some("+3.4123 m/s"));
//! assert_eq!(nearest.rate[0].map(|change| format!("{change:+.4} rad/s")).as_deref(), Some("+1.4587 rad/s"));
//!
//! // The same flight, solved by an integrator that is chosen at run time.
//! let gamma = Registry::standard().named("gamma")?.solver(&Settings::default())?;
//! assert!((gamma.tilt(&toss)?.cos_tilt - ExactSolver.tilt(&toss)?.cos_tilt).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A trace
//! Any solver can follow a flight at equally spaced times. Read on at [`trace()`] and [`Registry`]. To solve many
//! tosses at once, see [`Batch`].
//!
//! ```
//! # use toss::{Coin, ExactSolver, Launch, TimeOfFlight, Toss};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
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
//! # Any rigid body
//! A [`Body`] is a coin, or any other rigid body by its three moments or its inertia tensor; the [`catalogue`] has some by
//! name. A [`Toss`] is its toss, which solvers, traces, spaces and scenes take. This racket is thrown flat and turns
//! twice about its middle axis, and then its other face is up.
//!
//! ```
//! use toss::{Body, Launch, TimeOfFlight, Toss, certify};
//!
//! let body: Body = "racket".parse()?;
//! let toss = Toss { body, launch: Launch::new([0.12, 12.0, 0.0], TimeOfFlight::Given(1.0472))? };
//! assert_eq!(certify(&toss)?.outcome().name(), "tails");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A plan
//! You don't need a trajectory to know the outcome. A [`Scene`] says what is wanted and how accurately, and the planner
//! takes the cheapest model that gives it. Read on at [`Want`], [`planner`] and [`Scene::plan`].
//!
//! ```
//! use toss::{Answer, Scene, Want};
//! # use toss::{Coin, Launch, TimeOfFlight, Toss};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
//!
//! let outcome = Scene::new(Want::Outcome(toss), 1e-9).solve()?;
//! assert!(matches!(outcome, Answer::Outcome(verdict) if verdict.is_proven()));
//! let tilt = Scene::new(Want::Tilt(toss), 1e-9);
//! assert_eq!(tilt.plan()?.choice.model.name, "tilt");
//! assert!(matches!(tilt.solve()?, Answer::Tilt(cos_tilt) if (cos_tilt - 0.665_661_287).abs() < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Choose a solver
//! There are four ways, from the one that is decided earliest to the one that is decided latest.
//!
//! *By type*, when the program is compiled. A function that is generic over [`Solver`] takes any of them, and one of your own.
//!
//! ```
//! use toss::{ExactSolver, Formulation, QuaternionSolver, Scheme, SolveError, Solver, Stepping};
//! # use toss::{Coin, Launch, TimeOfFlight, Toss};
//!
//! fn lands_heads(solver: &impl Solver, toss: &Toss) -> Result<bool, SolveError> {
//!     Ok(solver.tilt(toss)?.cos_tilt > 0.0)
//! }
//!
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! let toss = Toss::new("us-quarter".parse::<Coin>()?, Launch::new([1.0, 1.0, 2.5], thrown)?);
//! let quaternion = QuaternionSolver::new(Stepping::adaptive(Scheme::DOP853, 1e-9)?, Formulation::default());
//! assert_eq!((lands_heads(&ExactSolver, &toss)?, lands_heads(&quaternion, &toss)?), (true, true));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *By name*, while it runs. The [`Registry`] knows which schemes a solver has.
//!
//! ```
//! use toss::{Registry, Settings};
//! # use toss::{Coin, Launch, TimeOfFlight, Toss};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
//!
//! let settings = Settings { stepping: "dopri5 tolerance=1e-9".parse()?, ..Settings::default() };
//! let backend = Registry::standard().backend("euler", &settings)?;
//! assert_eq!(backend.outcome(&toss)?.to_string(), "heads");
//! let refused = Registry::standard().named("magic").unwrap_err().to_string();
//! assert_eq!(refused, "solver = 'magic' is unknown; known: exact, gamma, euler, quaternion");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *By a configuration file*, with the feature `serde`: a [`SolverConfig`], of TOML or any other format of serde. What is left
//! out is the solver's default; what is misspelt, contradicts itself or would have no effect is refused.
//!
//! ```
//! use serde::Deserialize;
//! use toss::{Registry, SolverConfig, Toss};
//!
//! #[derive(Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Configuration {
//!     solver: SolverConfig,
//!     toss: Toss,
//! }
//!
//! let text = r#"
//!     [solver]
//!     name = "quaternion"
//!     scheme = "dop853"
//!     tolerance = 1e-9
//!
//!     [toss]
//!     coin = "us-quarter"
//!     launch = { rate = ["38rev/s", 0, "5rev/s"], speed = "2.4m/s", tilt = "15deg" }
//! "#;
//! let Configuration { solver, toss } = toml::from_str(text)?;
//! let backend = Registry::standard().configured(&solver)?;
//! assert_eq!(backend.outcome(&toss)?.to_string(), "tails");
//!
//! let refused = |text: &str| toml::from_str::<Configuration>(text).map(|_| ()).unwrap_err().message().to_owned();
//! assert!(refused(&text.replace("tolerance", "tolerence")).starts_with("unknown field `tolerence`"));
//! assert!(refused(&text.replace("1e-9", "2")).starts_with("tolerance = 2.0 is outside its valid range"));
//! let own = SolverConfig::new("exact").with_tolerance(1e-9)?;
//! assert!(Registry::standard().configured(&own).unwrap_err().to_string().starts_with("tolerance = '1e-9' has no effect"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *By plan*: a [`Scene`] states an accuracy, and the planner finds the integrator, its scheme and its tolerance.
//!
//! ```
//! use toss::planner::How;
//! use toss::{Scene, Want};
//! # use toss::{Coin, Launch, TimeOfFlight, Toss};
//! # let thrown = TimeOfFlight::Ballistic { speed: 3.0, gravity: 9.81 };
//! # let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], thrown)?);
//!
//! let choice = Scene::new(Want::Attitude(toss), 1e-6).by("quaternion", None).plan()?.choice;
//! let How::Integrator(solver, stepping) = &choice.how else { panic!("an integrator was asked for") };
//! assert_eq!((solver.name(), stepping.scheme().name()), ("quaternion", "taylor"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Vectors
//! Functions that take a vector take `[f64; 3]` as well as [`Vector3`], and `<[f64; 3]>::from` makes an array of a vector, so
//! that your version of nalgebra does not matter. Ours is re-exported as [`nalgebra`].
//!
//! ```
//! use toss::{Attitude, Launch, State, TimeOfFlight};
//!
//! let state = State::new(Attitude::about_x(0.5), [1.0, 1.0, 2.5]);
//! let [_, y, z] = state.attitude.normal().into();
//! assert_eq!((y, z), (-0.5_f64.sin(), 0.5_f64.cos()));
//! let launch = Launch::from_state(&state, TimeOfFlight::Given(0.6))?;
//! assert_eq!(<[f64; 3]>::from(launch.rate()), [1.0, 1.0, 2.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//! Both are on by default, and each can be left out. Whoever wants less than this crate depends on `exact` (the exact motion
//! with its proofs and batches) or `sampling` (probabilities by the exact motion) directly.
//!
//! | feature | what it adds |
//! |---|---|
//! | `serde` | solver settings, tosses, scenes, spaces, plans and tallies as plain data; reports of answers; spaces of launches by name or from a file |
//! | `rayon` | samples on all threads |
//!
//! The folder `examples` answers further questions, such as which launches are fair and how much people's coins wobble.

mod answer;
mod choice;
pub mod defaults;
mod integrators;
mod model;
mod plan;
mod proofs;
mod reason;
mod registry;
#[cfg(feature = "serde")]
pub mod report;
mod rounding;
mod samples;
mod scene;
pub mod trace;

/// Numbers with their units, and what their conversion rounds.
pub mod quantity {
    pub use crate::rounding::{BodyRounding, Rounding};
    pub use dynamics::{Dimension, Quantity, Unit};
}

/// How the planner decides: what each model offers to a [`Scene`], and why it is passed over.
pub mod planner {
    pub use crate::choice::{Candidate, Decision, How, Offer};
    pub use crate::model::{MODELS, Model};
    pub use crate::reason::{Nanoseconds, Reason};
    pub use crate::scene::{Integrator, WantKind};
}

/// Our integrators as types, what their proofs say, and what a solver from elsewhere may need.
pub mod solvers {
    pub use dynamics::{Checked, ForeignError};
    pub use kinematics_euler::{EulerAnglesSolver, GammaSolver};
    pub use kinematics_quat::{IntegratedCounts, Proving};
}

// The coin, its launch and its flight.
pub use dynamics::catalogue;
pub use dynamics::{
    Attitude, Body, Coin, CoinToss, EulerAngles, Launch, Outcome, Stage, State, TimeOfFlight, Toss, Tosses, Vector3,
    nalgebra,
};
pub use trace::{TracePoint, trace};

// Solvers: to choose one, or to write your own.
pub use dynamics::{
    Formulation, FreeRotation, Landing, Scheme, Settings, Solver, SolverConfig, SolverEntry, StepControl, Stepping,
    Tilt, Work,
};
pub use kinematics_quat::{IntegratedCertificate, QuaternionSolver, TAYLOR};
pub use registry::{Backend, Registry};

// The exact motion, and what follows from it.
pub use exact::{
    Batch, Certificate, CoinMotion, ExactMotion, ExactSolver, Margin, STAGES, Sensitivity, certify,
    level_speeds_of_heads, margin, speeds_of_heads,
};
pub use numerics::lanes::SimdLevel;

// Probabilities over many launches.
pub use sampling;

// Questions, and the models that answer them.
pub use answer::{Answer, Verdict};
pub use choice::Choice;
pub use scene::{Scene, Want};

// Errors.
pub use dynamics::{Error, InputError, SolveError};
