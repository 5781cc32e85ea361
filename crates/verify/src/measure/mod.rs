//! This module compares what solvers answer with references and measures how large the deviations are. It contains no
//! bounds: the module `judge` decides what is allowed, so that no check can pass by a limit of its own.
//!
//! | what | where |
//! |---|---|
//! | what is measured: a solver with its settings; a toss, of a coin or of any body; both together; how it is repeated | [`subject`], [`case`], [`any_case`], [`run`], [`replay`] |
//! | the 256-bit reference, and numbers from outside the workspace | [`mod@reference`] |
//! | claims and how they are measured | [`check`], [`checks`], [`measurement`] |
//! | data that several checks share, and how many cases are tried | [`context`], [`effort`] |
//! | the forms in which a time of flight is given | [`throws`] |
//! | flights: random, adversarial, long, both at the finest tolerances, and near the places where methods fail | [`survey`], `random_flights`, [`adversary`], [`search`], [`long_flights`], `hostile`, [`atlas`]; of any body [`bodies`], `rigid_errors` |
//! | error by step and by work; drift of conserved quantities | [`convergence`], [`work_precision`], [`drift`] |
//! | the accuracy of the planner | [`planner`] |
//! | probabilities of the named spaces | [`tables`] |

pub mod adversary;
pub mod any_case;
pub mod atlas;
pub mod bodies;
pub mod case;
pub mod check;
pub mod checks;
pub mod context;
pub mod convergence;
pub mod drift;
pub mod effort;
mod hard_cases;
mod hostile;
pub mod long_flights;
pub mod measurement;
pub mod planner;
mod random_flights;
pub mod reference;
pub mod replay;
mod rigid_errors;
pub mod run;
pub mod search;
pub mod subject;
pub mod survey;
pub mod tables;
pub mod throws;
pub mod work_precision;
