//! Renders the report as JUnit XML, which continuous integration reads: a test suite for each check with a test case
//! for each row, and a suite with a failing case for each row that became worse than the baseline, so that the file
//! fails whenever the run does.

use std::time::Duration;

use quick_junit::{NonSuccessKind, Property, Report as Junit, TestCase, TestCaseStatus, TestSuite};

use super::words::{by_check, comparison, reserve, verdict};
use super::{Report, diagnosis, words};
use crate::judge::Row;
use crate::judge::baseline::Move;
use crate::measure::diagnosis::Diagnosis;
use crate::measure::trial::Judges;
use crate::shown::shown;

/// Name of the suite of what became worse.
const WORSE: &str = "worse than the baseline";

pub(crate) fn xml(report: &Report) -> anyhow::Result<String> {
    let mut junit = Junit::new("unfair-toss");
    for rows in by_check(&report.rows) {
        let mut suite = TestSuite::new(rows[0].check.as_str());
        let timing = report.checks.iter().find(|timing| timing.check == rows[0].check);
        if let Some(time) = timing.and_then(|timing| Duration::try_from_secs_f64(timing.t_wall_s).ok()) {
            suite.set_time(time);
        }
        suite.add_test_cases(rows.iter().map(|row| test_case(row, &report.diagnoses)));
        junit.add_test_suite(suite);
    }
    let worse = report.worse();
    if !worse.is_empty() {
        let mut suite = TestSuite::new(WORSE);
        suite.add_test_cases(worse.into_iter().map(|moved| worse_case(moved, &report.rows)));
        junit.add_test_suite(suite);
    }
    // XML has no place for some characters, however they are written. The rows of a suite have none of them.
    let seen = |line: &str| line.split('\n').map(shown).collect::<Vec<_>>().join("\n");
    Ok(seen(&junit.to_string()?))
}

fn test_case(row: &Row, diagnoses: &[Diagnosis]) -> TestCase {
    let status = if row.status.passes() {
        TestCaseStatus::success()
    } else {
        let message = format!("{}: {} ({})", verdict(row), comparison(row), reserve(row));
        let of_row = |found: &&Diagnosis| found.subject == row.subject && row.judges == Some(Judges::Solver);
        let cause = diagnoses.iter().find(of_row).map(diagnosis::sentence);
        let detail = [&row.failure, &cause, &row.worst_input, &row.replay];
        failure(message, &detail.into_iter().flatten().map(String::as_str).collect::<Vec<_>>())
    };
    let mut case = TestCase::new(row.subject.as_str(), status);
    case.set_classname(row.check.as_str());
    let shown = |value: Option<f64>| value.map(|value| format!("{value:?}"));
    let numbers = [("measured", shown(row.measured)), ("limit", shown(row.limit)), ("unit", Some(row.unit.clone()))];
    let judges = ("judges", row.judges.map(|judges| judges.name().to_owned()));
    case.add_properties(
        numbers.into_iter().chain([judges]).filter_map(|(name, value)| Some(Property::new(name, value?))),
    );
    case
}

fn worse_case(moved: &Move, rows: &[Row]) -> TestCase {
    let replay = words::replay(moved, rows);
    let mut case = TestCase::new(
        format!("{}: {}", moved.subject, moved.what),
        failure(format!("worse than the baseline: {}", words::change(moved)), &[&replay]),
    );
    case.set_classname(format!("{WORSE}.{}", moved.check));
    let shown = |value: Option<f64>| value.map(|value| format!("{value:?}"));
    let numbers = [("measured", shown(moved.now)), ("accepted", shown(moved.before))];
    case.add_properties(numbers.into_iter().filter_map(|(name, value)| Some(Property::new(name, value?))));
    case
}

fn failure(message: String, detail: &[&str]) -> TestCaseStatus {
    let mut failure = TestCaseStatus::non_success(NonSuccessKind::Failure);
    failure.set_message(message);
    failure.set_description(detail.join("\n"));
    failure
}
