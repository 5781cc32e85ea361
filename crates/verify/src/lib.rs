//! The verification suite: cases × solvers × checks → rows → one verdict.
//!
//! ```text
//! measure                                            judge                   render
//! subject (solver × scheme) ──┐
//! survey (random launches) ───┼→ check → measurement ─┬→ row, status ─┬→ text, HTML, JSON, JUnit, charts
//! reference (256 bits, files)─┘       bound or claim ─┘      baseline ┘
//! ```
//!
//! Data flows in one direction. [`measure`] compares what solvers answer with references and knows no bound; [`mod@judge`]
//! compares measurements with `validation/bounds.toml`, or with the error that a solver claims for itself, and with the
//! regression baseline; [`render`] shows rows. [`mod@bench`] measures what a toss costs.

pub mod bench;
pub mod files;
pub mod host;
pub mod judge;
pub mod measure;
pub mod render;

pub use judge::{Row, Status, judge};
pub use measure::check::{Basis, Check};
pub use measure::checks::CHECKS;
pub use measure::context::{Context, Records};
pub use measure::effort::Effort;
pub use measure::measurement::{Measurement, Worst};
