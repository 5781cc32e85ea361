//! What passes, and what is refused.

use super::*;
use crate::measure::check::Measure;
use crate::measure::replay::Replay;
use crate::measure::trial::Worst;

const CHECK: Check = Check::of_solvers("c", Measure::Own(|_| Ok(Vec::new()))).up_to(1e-3, "1");

fn figure(measured: f64) -> Measurement {
    Measurement::figure("s", measured, 1, String::new())
}

fn status(measurement: Measurement, limits: &str) -> Status {
    judge(&CHECK, vec![measurement], &Limits::parse(limits).unwrap())[0].status
}

#[test]
fn a_row_passes_only_within_its_limit() {
    let limits = "[c]\nreason = 'r'\nallowed = { s = 1e-9 }";
    assert_eq!(status(figure(1e-9), limits), Status::Pass);
    assert_eq!(status(figure(1.0001e-9), limits), Status::Fail);
    assert_eq!(status(figure(1e-11), limits), Status::PassLoose);
    assert_eq!(status(figure(f64::INFINITY), limits), Status::Fail);
    assert_eq!(status(figure(f64::NAN), limits), Status::Fail);
    assert_eq!(status(figure(0.0), "[c]\nreason = 'r'\nallowed = { s = 0.0 }"), Status::Pass);
}

#[test]
fn without_a_limit_a_solver_is_judged_by_its_own_claim_and_all_else_fails() {
    for limits in ["", "[c]\nreason = 'r'\nallowed = { other = 1e-9 }"] {
        assert_eq!(status(figure(0.0), limits), Status::NoLimit);
        for (measured, expected) in [
            (1e-9, Status::PassByClaim),
            (1e-12, Status::PassByClaim),
            (1.0001e-9, Status::FailByClaim),
            (f64::NAN, Status::FailByClaim),
        ] {
            assert_eq!(status(figure(measured).claiming(Some(1e-9)), limits), expected);
        }
        assert_eq!(status(figure(0.0).claiming(None), limits), Status::NoClaim);
        assert_eq!(status(figure(f64::NAN).without_claim(), limits), Status::NotJudged);
    }
}

#[test]
fn a_row_judges_what_its_check_does_unless_its_measurement_says_otherwise() {
    let rows = judge(&CHECK, vec![figure(0.0), figure(0.0).of_the_library()], &Limits::parse("").unwrap());
    assert_eq!(rows[0].judges, Some(Judges::Solver));
    assert_eq!(rows[1].judges, Some(Judges::Library));
}

#[test]
fn a_limit_takes_precedence_over_the_solvers_claim() {
    let limits = "[c]\nreason = 'r'\nallowed = { s = 1e-9 }";
    assert_eq!(status(figure(1e-8).claiming(Some(1.0)), limits), Status::Fail);
    assert_eq!(status(figure(1e-9).claiming(Some(1e-12)), limits), Status::Pass);
    assert_eq!(status(figure(1e-9).claiming(None), limits), Status::Pass);
    assert_eq!(status(figure(1e-8).without_claim(), limits), Status::Fail);
}

#[test]
fn two_rows_of_one_name_are_refused_with_the_origin_of_both() {
    let limits = Limits::parse("").unwrap();
    let named = |subject: &str, toss: &str| {
        let replay = Replay { input: toss.to_owned(), settings: String::new(), row: None };
        let worst = Some(Worst { input: String::new(), failure: None, replay: Some(replay) });
        Measurement { subject: subject.to_owned(), worst, ..figure(1.0) }
    };
    let rows = judge(&CHECK, vec![named("a", "1"), named("b", "2"), named("a", "3")], &limits);
    assert!(require_distinct(&rows[..2]).is_ok());
    let error = require_distinct(&rows).unwrap_err().to_string();
    assert_eq!(
        error,
        "two rows are called 'c / a': one from `cargo xtask verify --replay \"1\"`, the other from `cargo xtask verify \
         --replay \"3\"`"
    );
}

#[test]
fn a_limit_without_a_reason_or_a_row_is_refused() {
    assert!(Limits::parse("[c]\nreason = ' '\nallowed = { s = 1 }").is_err());
    assert!(Limits::parse("[c]\nreason = 'r'\nallowed = { s = nan }").is_err());
    assert!(Limits::parse("[c]\nreason = 'r'\nallowed = { s = -1.0 }").is_err());
    let limits = Limits::parse("[c]\nreason = 'r'\nallowed = { s = 1.0 }").unwrap();
    assert_eq!(unused_limits(&[], &limits, |_, _| true)[0].status, Status::NotMeasured);
    let rows = judge(&CHECK, vec![figure(0.5)], &limits);
    assert!(unused_limits(&rows, &limits, |_, _| true).is_empty());
    assert!(unused_limits(&[], &limits, |_, _| false).is_empty());
}

#[test]
fn no_limit_and_no_claim_allows_more_than_the_ceiling() {
    for (measured, claimed, expected) in
        [(1e-3, 2.0, Status::PassByClaim), (1.001e-3, 2.0, Status::FailByClaim), (1.001e-3, 1e-3, Status::FailByClaim)]
    {
        assert_eq!(status(figure(measured).claiming(Some(claimed)), ""), expected);
    }
    // A larger deviation than that of the claim's worst case.
    let beside = Measurement { measured: 0.5, ..figure(1e-9).claiming(Some(1e-8)) };
    assert_eq!(status(beside, ""), Status::FailByClaim);
    let limits = "[c]\nreason = 'r'\nallowed = { s = 1.0 }";
    assert_eq!(status(figure(0.5), limits), Status::Fail, "a table that knows nothing of the check");
}

#[test]
fn a_limit_above_the_ceiling_of_its_check_is_refused() {
    let table = |limit: f64| format!("[random-cos-tilt]\nreason = 'r'\nallowed = {{ mine = {limit} }}");
    assert!(Limits::parse(&table(1e-3)).is_ok());
    let error = Limits::parse(&table(1.1e-3)).unwrap_err().to_string();
    assert_eq!(error, "[random-cos-tilt] mine = 0.0011: no limit of this check may be above 0.001, its ceiling");
}
