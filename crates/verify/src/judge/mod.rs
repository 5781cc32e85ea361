//! This module decides what passes: it compares what was measured with what is allowed, and with what was accepted
//! before. It is the only place with bounds, and it measures nothing itself, so that limits cannot be adjusted where a
//! check is written.
//!
//! | what | where |
//! |---|---|
//! | compares a measurement with its bound, or with the solver's own error estimate | [`row`] |
//! | reads `validation/bounds.toml` | [`bounds`] |
//! | compares a run with the regression baseline, `validation/baseline` | [`baseline`] |
//! | reads and writes dated records, `validation/record` | [`record`] |

pub mod baseline;
pub mod bounds;
pub mod record;
pub mod row;

pub use row::{Row, Status, judge, unused_bounds};
