//! The verification suite measures every solver of a tossed coin against independent references, compares the errors
//! with limits, and reports the result. It is a crate of its own, so no solver can use the code that judges it.
//!
//! A check is a claim and how it is measured; a subject is a solver with its settings; a row is one subject under one
//! check, with its verdict.
//!
//! ```text
//! measure                                            judge                   render
//! subject (solver × scheme) ──┐
//! survey (random launches) ───┼→ check → measurement ─┬→ row, status ─┬→ text, HTML, JSON, JUnit, charts
//! reference (256 bits, files)─┘       limit or claim ─┘      baseline ┘
//! ```
//!
//! Data flows in one direction. [`measure`] compares the answers of solvers with references and contains no limits.
//! [`mod@judge`] compares measurements with limits or, for a solver without limits, with its own error estimate, and
//! with the regression baseline. [`render`] shows rows. `bench` measures what a toss costs.
//!
//! A [`Suite`] does all of this for the solvers of a registry, and [`main()`] is its program: a crate elsewhere judges a
//! solver of its own by `verify::main(Suite::new(registry))`.

mod bench;
pub mod clock;
mod commands;
pub mod files;
pub mod host;
pub mod judge;
pub mod measure;
pub mod process;
pub mod render;
mod shown;
mod slope;
pub mod suite;
mod table;
pub mod watch;

pub use commands::main;
pub use judge::{LeftOut, Row, Status, judge};
pub use measure::check::{Basis, Check, Judges, Measure};
pub use measure::checks::CHECKS;
pub use measure::context::Context;
pub use measure::effort::Effort;
pub use measure::trial::{Measurement, Worst};
pub use render::report::{Report, Verdict};
pub use suite::Suite;
