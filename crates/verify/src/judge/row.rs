//! This file turns measurements into rows, each with a verdict: it is the only place that decides whether something
//! passes. A measurement is compared with its bound or, if it has none, with what the solver's own error estimate
//! allows (its claim), so solvers from outside can be judged too.

use serde::Serialize;

use super::bounds::Bounds;
use crate::measure::check::{Basis, Check};
use crate::measure::measurement::{Claim, Measurement, Worst};

/// A bound that is this many times above what was measured or more is reported as loose, because it would hide bugs.
const LOOSE: f64 = 10.0;

/// The verdict on a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Within its bound.
    Pass,
    /// Within its bound, but the bound is ten times what was measured or more.
    PassLoose,
    /// It has no bound, and is within the error that the solver claims.
    PassByClaim,
    /// It has no bound, and it is not an error, so no error estimate applies.
    NotJudged,
    /// Above its bound.
    Fail,
    /// It has no bound, and is above the error that the solver claims.
    FailByClaim,
    /// It has no bound, and the solver claims no error.
    NoClaim,
    /// It has no bound, and does not belong to a solver.
    NoBound,
    /// There is a bound for it, but it was not measured.
    NotMeasured,
}

impl Status {
    /// Whether the row passes.
    pub fn passes(self) -> bool {
        matches!(self, Self::Pass | Self::PassLoose | Self::PassByClaim | Self::NotJudged)
    }

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::PassLoose => "pass, loose bound",
            Self::PassByClaim => "pass, by its own claim",
            Self::NotJudged => "not judged: no bound",
            Self::Fail => "FAIL",
            Self::FailByClaim => "FAIL, above its own claim",
            Self::NoClaim => "FAIL, claims no error",
            Self::NoBound => "FAIL, no bound",
            Self::NotMeasured => "FAIL, not measured",
        }
    }
}

/// A judged measurement, with everything that a report shows of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The id of the check.
    pub check: String,
    /// The claim of the check.
    pub claim: String,
    /// The kind of evidence for the claim.
    pub basis: Option<Basis>,
    /// The subject that was measured.
    pub subject: String,
    /// Unit of `measured` and `bound`.
    pub unit: String,
    /// The deviation that was judged; `None` if the subject failed.
    pub measured: Option<f64>,
    /// The deviation that is allowed, by the bound or by the solver's claim.
    pub bound: Option<f64>,
    /// `bound / measured`; `None` where either is missing or zero.
    pub margin: Option<f64>,
    /// The verdict.
    pub status: Status,
    /// Number of cases that were tried.
    pub cases: u64,
    /// The input of the worst case, as hex floats or in words.
    pub worst_input: Option<String>,
    /// Why the subject failed on the worst case, if it did.
    pub failure: Option<String>,
    /// A command that repeats the worst case.
    pub replay: Option<String>,
}

/// Judges the measurements of `check`.
pub fn judge(check: &Check, measurements: Vec<Measurement>, bounds: &Bounds) -> Vec<Row> {
    measurements.into_iter().map(|measurement| row(check, measurement, bounds)).collect()
}

/// The value that was judged, what it was compared with, and the result.
struct Verdict {
    measured: f64,
    allowed: Option<f64>,
    worst: Option<Worst>,
    status: Status,
}

impl Verdict {
    fn new(measured: f64, worst: Option<Worst>, claim: Claim, bound: Option<f64>) -> Self {
        let without_limit = |status| Self { measured, allowed: None, worst: worst.clone(), status };
        match (bound, claim) {
            (Some(bound), _) => Self { measured, allowed: Some(bound), worst, status: by_bound(measured, bound) },
            (None, Claim::Allows { measured, allowed, worst }) => {
                let status = if measured <= allowed { Status::PassByClaim } else { Status::FailByClaim };
                Self { measured, allowed: Some(allowed), worst, status }
            }
            (None, Claim::Silent) => without_limit(Status::NotJudged),
            (None, Claim::NoEstimate) => without_limit(Status::NoClaim),
            (None, Claim::NoSolver) => without_limit(Status::NoBound),
        }
    }
}

fn by_bound(measured: f64, bound: f64) -> Status {
    match measured <= bound {
        true if bound >= LOOSE * measured && bound > 0.0 => Status::PassLoose,
        true => Status::Pass,
        false => Status::Fail,
    }
}

fn row(check: &Check, measurement: Measurement, bounds: &Bounds) -> Row {
    let Measurement { subject, measured, cases, worst, claim } = measurement;
    let Verdict { measured, allowed, worst, status } =
        Verdict::new(measured, worst, claim, bounds.get(check.id, &subject));
    Row {
        check: check.id.to_owned(),
        claim: check.claim.to_owned(),
        basis: Some(check.basis),
        unit: check.unit.to_owned(),
        measured: measured.is_finite().then_some(measured),
        bound: allowed,
        margin: allowed.map(|allowed| allowed / measured).filter(|margin| margin.is_finite() && *margin > 0.0),
        status,
        cases,
        worst_input: worst.as_ref().map(|worst| worst.input.clone()),
        failure: worst.as_ref().and_then(|worst| worst.failure.clone()),
        replay: worst.map(|worst| worst.replay),
        subject,
    }
}

/// A failing row for every bound that no row of a complete run used, because its check or its subject no longer exists.
pub fn unused_bounds(rows: &[Row], bounds: &Bounds) -> Vec<Row> {
    bounds
        .pairs()
        .filter(|(check, subject)| !rows.iter().any(|row| row.check == *check && row.subject == *subject))
        .map(|(check, subject)| Row {
            check: check.to_owned(),
            claim: "Every bound belongs to something that was measured; a bound for anything else fails.".to_owned(),
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

    fn figure(measured: f64) -> Measurement {
        Measurement::figure("c", "s", measured, 1, String::new())
    }

    fn status(measurement: Measurement, bounds: &str) -> Status {
        judge(&CHECK, vec![measurement], &Bounds::parse(bounds).unwrap())[0].status
    }

    #[test]
    fn a_row_passes_only_within_its_bound() {
        let bounds = "[c]\nreason = 'r'\nallowed = { s = 1e-9 }";
        assert_eq!(status(figure(1e-9), bounds), Status::Pass);
        assert_eq!(status(figure(1.0001e-9), bounds), Status::Fail);
        assert_eq!(status(figure(1e-11), bounds), Status::PassLoose);
        assert_eq!(status(figure(f64::INFINITY), bounds), Status::Fail);
        assert_eq!(status(figure(f64::NAN), bounds), Status::Fail);
        assert_eq!(status(figure(0.0), "[c]\nreason = 'r'\nallowed = { s = 0.0 }"), Status::Pass);
    }

    #[test]
    fn without_a_bound_a_solver_is_judged_by_its_own_claim_and_all_else_fails() {
        for bounds in ["", "[c]\nreason = 'r'\nallowed = { other = 1e-9 }"] {
            assert_eq!(status(figure(0.0), bounds), Status::NoBound);
            for (measured, expected) in [
                (1e-9, Status::PassByClaim),
                (1e-12, Status::PassByClaim),
                (1.0001e-9, Status::FailByClaim),
                (f64::NAN, Status::FailByClaim),
            ] {
                assert_eq!(status(figure(measured).claiming(Some(1e-9)), bounds), expected);
            }
            assert_eq!(status(figure(0.0).claiming(None), bounds), Status::NoClaim);
            assert_eq!(status(figure(f64::NAN).without_claim(), bounds), Status::NotJudged);
        }
    }

    #[test]
    fn a_bound_takes_precedence_over_the_solvers_claim() {
        let bounds = "[c]\nreason = 'r'\nallowed = { s = 1e-9 }";
        assert_eq!(status(figure(1e-8).claiming(Some(1.0)), bounds), Status::Fail);
        assert_eq!(status(figure(1e-9).claiming(Some(1e-12)), bounds), Status::Pass);
        assert_eq!(status(figure(1e-9).claiming(None), bounds), Status::Pass);
        assert_eq!(status(figure(1e-8).without_claim(), bounds), Status::Fail);
    }

    #[test]
    fn a_bound_without_a_reason_or_a_row_is_refused() {
        assert!(Bounds::parse("[c]\nreason = ' '\nallowed = { s = 1 }").is_err());
        assert!(Bounds::parse("[c]\nreason = 'r'\nallowed = { s = nan }").is_err());
        assert!(Bounds::parse("[c]\nreason = 'r'\nallowed = { s = -1.0 }").is_err());
        let bounds = Bounds::parse("[c]\nreason = 'r'\nallowed = { s = 1.0 }").unwrap();
        assert_eq!(unused_bounds(&[], &bounds)[0].status, Status::NotMeasured);
        let rows = judge(&CHECK, vec![figure(0.5)], &bounds);
        assert!(unused_bounds(&rows, &bounds).is_empty());
    }
}
