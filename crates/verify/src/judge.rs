//! The one place that judges: measurement against bound.

use serde::Serialize;

use crate::bounds::Bounds;
use crate::check::{Basis, Check};
use crate::measurement::Measurement;

/// A bound this many times above what was measured hides bugs, and is reported.
const LOOSE: f64 = 10.0;

/// What the judge says of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Within its bound.
    Pass,
    /// Within its bound, which is ten times above what was measured, or more.
    PassLoose,
    /// Above its bound.
    Fail,
    /// Nobody said what is allowed.
    NoBound,
    /// A bound for something that was not measured.
    NotMeasured,
}

impl Status {
    /// Whether the row passes.
    pub fn passes(self) -> bool {
        matches!(self, Self::Pass | Self::PassLoose)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::PassLoose => "pass, loose bound",
            Self::Fail => "FAIL",
            Self::NoBound => "FAIL, no bound",
            Self::NotMeasured => "FAIL, not measured",
        }
    }
}

/// A measurement, judged; everything that a report renders.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The check.
    pub check: String,
    /// Its claim.
    pub claim: String,
    /// What the claim rests on.
    pub basis: Option<Basis>,
    /// Who was measured.
    pub subject: String,
    /// Unit of `measured` and `bound`.
    pub unit: String,
    /// The largest deviation; `None` if the subject failed.
    pub measured: Option<f64>,
    /// What is allowed.
    pub bound: Option<f64>,
    /// `bound / measured`; `None` where either is missing or zero.
    pub margin: Option<f64>,
    /// The verdict.
    pub status: Status,
    /// Cases tried.
    pub cases: u64,
    /// The worst case's input, with hex floats.
    pub worst_input: Option<String>,
    /// Why the subject failed, if it did.
    pub failure: Option<String>,
    /// A command that repeats the worst case.
    pub replay: Option<String>,
}

/// Judges the measurements of `check`.
pub fn judge(check: &Check, measurements: Vec<Measurement>, bounds: &Bounds) -> Vec<Row> {
    measurements.into_iter().map(|measurement| row(check, measurement, bounds)).collect()
}

fn row(check: &Check, measurement: Measurement, bounds: &Bounds) -> Row {
    let Measurement { subject, measured, cases, worst } = measurement;
    let bound = bounds.get(check.id, &subject);
    let status = match bound {
        None => Status::NoBound,
        Some(bound) if measured <= bound && bound >= LOOSE * measured && bound > 0.0 => Status::PassLoose,
        Some(bound) if measured <= bound => Status::Pass,
        Some(_) => Status::Fail,
    };
    Row {
        check: check.id.to_owned(),
        claim: check.claim.to_owned(),
        basis: Some(check.basis),
        unit: check.unit.to_owned(),
        measured: measured.is_finite().then_some(measured),
        bound,
        margin: bound.map(|bound| bound / measured).filter(|margin| margin.is_finite() && *margin > 0.0),
        status,
        cases,
        worst_input: worst.as_ref().map(|worst| worst.input.clone()),
        failure: worst.as_ref().and_then(|worst| worst.failure.clone()),
        replay: worst.map(|worst| worst.replay),
        subject,
    }
}

/// A failing row for every bound that no row of a complete run used: its check or its subject is gone.
pub fn unused_bounds(rows: &[Row], bounds: &Bounds) -> Vec<Row> {
    bounds
        .pairs()
        .filter(|(check, subject)| !rows.iter().any(|row| row.check == *check && row.subject == *subject))
        .map(|(check, subject)| Row {
            check: check.to_owned(),
            claim: "every bound is used".to_owned(),
            basis: None,
            subject: subject.to_owned(),
            unit: String::new(),
            measured: None,
            bound: bounds.get(check, subject),
            margin: None,
            status: Status::NotMeasured,
            cases: 0,
            worst_input: None,
            failure: None,
            replay: None,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHECK: Check = Check { id: "c", claim: "", basis: Basis::Invariant, unit: "1", measure: |_| Ok(Vec::new()) };

    fn status(measured: f64, bounds: &str) -> Status {
        let bounds = Bounds::parse(bounds).unwrap();
        let measurement = Measurement::figure("c", "s", measured, 1, String::new());
        judge(&CHECK, vec![measurement], &bounds)[0].status
    }

    #[test]
    fn a_row_passes_only_within_its_bound() {
        let bounds = "[c]\nreason = 'r'\nallowed = { s = 1e-9 }";
        assert_eq!(status(1e-9, bounds), Status::Pass);
        assert_eq!(status(1.0001e-9, bounds), Status::Fail);
        assert_eq!(status(1e-11, bounds), Status::PassLoose);
        assert_eq!(status(f64::INFINITY, bounds), Status::Fail);
        assert_eq!(status(f64::NAN, bounds), Status::Fail);
        assert_eq!(status(0.0, "[c]\nreason = 'r'\nallowed = { s = 0.0 }"), Status::Pass);
    }

    #[test]
    fn a_subject_without_a_bound_fails() {
        assert_eq!(status(0.0, "[c]\nreason = 'r'\nallowed = { other = 1e-9 }"), Status::NoBound);
        assert_eq!(status(0.0, ""), Status::NoBound);
    }

    #[test]
    fn a_bound_without_a_reason_or_a_row_is_refused() {
        assert!(Bounds::parse("[c]\nreason = ' '\nallowed = { s = 1 }").is_err());
        assert!(Bounds::parse("[c]\nreason = 'r'\nallowed = { s = nan }").is_err());
        assert!(Bounds::parse("[c]\nreason = 'r'\nallowed = { s = -1.0 }").is_err());
        let bounds = Bounds::parse("[c]\nreason = 'r'\nallowed = { s = 1.0 }").unwrap();
        assert_eq!(unused_bounds(&[], &bounds)[0].status, Status::NotMeasured);
        let rows = judge(&CHECK, vec![Measurement::figure("c", "s", 0.5, 1, String::new())], &bounds);
        assert!(unused_bounds(&rows, &bounds).is_empty());
    }
}
