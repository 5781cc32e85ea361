//! This module compares what solvers answer with references and measures how large the deviations are. It contains no
//! bounds: the module `judge` decides what is allowed, so that no check can pass by a limit of its own.
//!
//! | what | where |
//! |---|---|
//! | what is measured: a solver with its settings; a toss; both together | [`subject`], [`case`], [`run`] |
//! | the 256-bit reference, and numbers from outside the workspace | [`mod@reference`] |
//! | claims and how they are measured | [`check`], [`checks`], [`measurement`] |
//! | data that several checks share, and how many cases are tried | [`context`], [`effort`] |
//! | flights: random, adversarial, long, and near the places where methods fail | [`survey`], [`adversary`], [`search`], [`long_flights`], [`atlas`] |
//! | error by step and by work; drift of conserved quantities | [`convergence`], [`work_precision`], [`drift`] |
//! | the planner's table, and its accuracy and cost | [`planner`] |
//! | probabilities of the named spaces | [`tables`] |

pub mod adversary;
pub mod atlas;
pub mod case;
pub mod check;
pub mod checks;
pub mod context;
pub mod convergence;
pub mod drift;
pub mod effort;
pub mod long_flights;
pub mod measurement;
pub mod planner;
pub mod reference;
pub mod run;
pub mod search;
mod slope;
pub mod subject;
pub mod survey;
pub mod tables;
pub mod work_precision;
