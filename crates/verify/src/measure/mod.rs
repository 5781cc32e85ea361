//! Measuring: checks, and what they measure with. Nothing here knows a bound.
//!
//! | what | where |
//! |---|---|
//! | what is measured: a solver with its settings; a toss; both together | [`subject`], [`case`], [`run`] |
//! | the exact motion in 256 bits, and numbers from outside | [`mod@reference`] |
//! | claims and how they are measured | [`check`], [`checks`], [`measurement`] |
//! | what several checks share, computed once, and how much is tried | [`context`], [`effort`] |
//! | flights: random ones, adversarial ones, long ones, those near where methods fail | [`survey`], [`adversary`], [`search`], [`long_flights`], [`atlas`] |
//! | error by step and by work; drift of what is conserved | [`convergence`], [`work_precision`], [`drift`] |
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
