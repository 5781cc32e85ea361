//! This module compares what solvers answer with references and measures how large the deviations are. It contains no
//! limits: the module `judge` decides what is allowed, so that no check can pass by a limit of its own.
//!
//! | what | where |
//! |---|---|
//! | what is measured: a solver with its settings; the text of a toss; both together; how a worst case is repeated | [`subject`], `case`, [`run`], [`replay`] |
//! | the judge: the reference of every toss, each computed once, and numbers from outside the workspace | [`mod@reference`], [`exact_landings`], `outside` |
//! | claims, and how the trials of a subject become one measurement | [`check`], [`checks`], [`trial`] |
//! | data that several checks share, and how many cases are tried | [`context`], [`effort`] |
//! | tosses: random ones and of last bits, bodies by families, those of an adversary, flights at the finest tolerances | `tosses`, `families`, `adversary`, `hostile` |
//! | flights of every solver: on random launches, and near the places where methods fail | [`survey`], [`atlas`] |
//! | error by step and by work; drift of conserved quantities | `convergence`, [`work_precision`], `drift` |
//! | launches of every kind, and what a wrong solver most likely does, by its answers to them | `any_launch`, [`diagnosis`] |
//! | the accuracy of the planner | `planner` |
//! | probabilities of the named spaces | [`tables`] |

mod adversary;
pub(crate) mod any_launch;
pub mod atlas;
pub mod case;
pub mod check;
pub mod checks;
pub mod context;
pub(crate) mod convergence;
pub mod diagnosis;
mod drift;
pub mod effort;
pub mod exact_landings;
mod families;
mod hostile;
mod outside;
pub(crate) mod planner;
pub mod reference;
pub mod replay;
pub mod run;
pub mod subject;
pub mod survey;
pub mod tables;
mod tosses;
pub mod trial;
pub mod work_precision;
