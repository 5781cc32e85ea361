//! This module decides what passes: it compares what was measured with what is allowed, and with what was accepted
//! before. It is the only place with limits, and it measures nothing itself, so that limits cannot be adjusted where a
//! check is written.
//!
//! | what | where |
//! |---|---|
//! | compares a measurement with its limit, or with the solver's own error estimate | [`row`] |
//! | reads tables of limits, and proposes some for rows that have none | [`limits`] |
//! | compares a run with the regression baseline, the folder `baseline` | [`baseline`] |
//! | compares the time of each check with its limit | [`time`] |
//! | keeps what was measured of a run that may be interrupted | [`kept`] |
//! | reads and writes dated records, the folder `record` | [`record`] |

pub mod baseline;
pub mod kept;
pub mod limits;
pub mod record;
pub mod row;
pub mod time;
#[cfg(test)]
mod wrong_reference;

pub use row::{Judge, LeftOut, Row, Status, judge, require_distinct, unused_limits};

#[cfg(test)]
pub(crate) mod tests {
    use super::{Row, Status};
    use crate::measure::check::{Basis, Judges};

    /// A row about a solver in rad, which passes if `measured` is at most `limit`.
    pub(crate) fn row(check: &str, subject: &str, measured: f64, limit: f64) -> Row {
        Row {
            check: check.to_owned(),
            claim: "It is small.".to_owned(),
            basis: Some(Basis::ClosedForm),
            judges: Some(Judges::Solver),
            subject: subject.to_owned(),
            unit: "rad".to_owned(),
            measured: Some(measured),
            limit: Some(limit),
            reserve: Some(limit / measured).filter(|reserve| reserve.is_finite() && *reserve > 0.0),
            status: if measured <= limit { Status::Pass } else { Status::Fail },
            cases: 7,
            worst_input: Some("i1=0x1.0p+0".to_owned()),
            replay: Some(format!("fly 'i1=0x1.0p+0' by {subject}")),
            largest: Some(measured),
            ..Row::default()
        }
    }
}
