//! Judging: what was measured against what is allowed, and against what was accepted before.
//!
//! | what | where |
//! |---|---|
//! | a measurement against its bound, or against the solver's own claim | [`row`] |
//! | `validation/bounds.toml` | [`bounds`] |
//! | the regression baseline, `validation/baseline` | [`baseline`] |
//! | dated records, `validation/record` | [`record`] |

pub mod baseline;
pub mod bounds;
pub mod record;
pub mod row;

pub use row::{Row, Status, judge, unused_bounds};
