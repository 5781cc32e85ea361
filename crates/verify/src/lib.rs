//! The verification suite: cases × solvers × checks → rows → one verdict.
//!
//! ```text
//! subject (solver × method) ─┐
//! survey (random launches) ──┼→ check → measurement ─┬→ judge → row → table, report.json, junit.xml
//! reference (256 bits, files)┘                bound ─┘
//! ```
//!
//! A check only measures. What is allowed stands in `validation/bounds.toml`, the judge compares, and the reports render
//! rows; none of them knows the others.

pub mod adversary;
pub mod atlas;
pub mod bench;
pub mod bounds;
pub mod case;
pub mod check;
pub mod checks;
pub mod context;
pub mod convergence;
pub mod drift;
pub mod effort;
pub mod judge;
pub mod ledger;
pub mod long_flights;
pub mod measurement;
pub mod planner;
pub mod record;
pub mod reference;
pub mod reference_data;
pub mod reference_probability;
pub mod report;
pub mod run;
pub mod search;
mod slope;
pub mod subject;
pub mod survey;
pub mod tables;
pub mod work_precision;

pub use check::{Basis, Check};
pub use checks::CHECKS;
pub use context::{Context, Records};
pub use effort::Effort;
pub use judge::{Row, Status, judge};
pub use measurement::{Measurement, Worst};
