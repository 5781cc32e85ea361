//! Renders the rows as JUnit XML, which continuous integration reads: one test suite for each check, one test case for each
//! subject.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use crate::judge::Row;

/// Renders `rows`.
///
/// # Errors
/// If the XML can't be written, which plain rows never cause.
pub fn xml(rows: &[Row]) -> anyhow::Result<String> {
    let mut report = Report::new("unfair-toss");
    for block in rows.chunk_by(|a, b| a.check == b.check) {
        let mut suite = TestSuite::new(block[0].check.as_str());
        suite.add_test_cases(block.iter().map(test_case));
        report.add_test_suite(suite);
    }
    Ok(report.to_string()?)
}

fn test_case(row: &Row) -> TestCase {
    let status = if row.status.passes() {
        TestCaseStatus::success()
    } else {
        let mut failure = TestCaseStatus::non_success(NonSuccessKind::Failure);
        failure.set_message(format!("{}: measured {:?}, allowed {:?}", row.status.name(), row.measured, row.bound));
        let detail = [&row.failure, &row.worst_input, &row.replay];
        failure.set_description(detail.into_iter().flatten().cloned().collect::<Vec<_>>().join("\n"));
        failure
    };
    let mut case = TestCase::new(row.subject.as_str(), status);
    case.set_classname(row.check.as_str());
    case
}
