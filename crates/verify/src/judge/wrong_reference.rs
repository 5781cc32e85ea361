//! Tests that no check is judged by what it judges: with a wrong reference, every check fails whose basis it is.

use super::judge;
use super::limits::Limits;
use crate::measure::check::{Basis, Fold, Measure};
use crate::{CHECKS, Context, Effort, Row};

/// The checks that a wrong motion leaves as they are, and why.
const OF_ITS_OWN: [(&str, &str); 3] = [
    ("cos-tilt-terms", "at launch nothing has moved"),
    ("integrated-tightness", "it fails if errors are too small beside their bounds, not if they are large"),
    ("hard-integrated-undecided", "it counts proofs, whatever they prove"),
];

/// In a process of its own, whose reference flies a thousandth longer, every check of single tosses fails but those whose
/// basis is no reference: what is judged isn't judged by itself.
#[test]
fn every_check_of_tosses_fails_by_a_wrong_reference() {
    let test = "judge::wrong_reference::with_a_wrong_reference_no_check_passes";
    let mut itself = std::process::Command::new(std::env::current_exe().unwrap());
    let found = itself.args(["--exact", test, "--ignored"]).env("VERIFY_TEST_WRONG_TIME", "1.001").output().unwrap();
    let text = String::from_utf8_lossy(&found.stdout);
    assert!(found.status.success() && text.contains("1 passed"), "{text}");
}

#[test]
#[ignore = "in a process of its own"]
fn with_a_wrong_reference_no_check_passes() {
    fn is_of_tosses(measure: &Measure) -> bool {
        match measure {
            Measure::Tosses(..) | Measure::Landings { .. } => true,
            Measure::Both(parts) => parts.iter().any(is_of_tosses),
            Measure::Own(_) => false,
        }
    }
    let limits = Limits::of_this_workspace().unwrap();
    let registry = toss::Registry::standard();
    let context = Context::new(registry.entries(), Effort::Sample).unwrap();
    let judged = |basis: Basis| matches!(basis, Basis::ClosedForm | Basis::PublishedFigure);
    let checks = CHECKS.iter().filter(|check| is_of_tosses(&check.measure) && judged(check.basis));
    let (mut number, mut passing) = (0, Vec::new());
    for check in checks.filter(|check| !OF_ITS_OWN.iter().any(|(id, _)| *id == check.id)) {
        number += 1;
        let rows = judge(check, check.measure(&context).unwrap(), &limits);
        let counts = matches!(check.measure, Measure::Tosses(_, Fold::Count)) || check.ceiling == 0.0;
        let passes = |row: &Row| row.status.passes();
        // Few of the tosses that are counted land near enough to an edge.
        if if counts { rows.iter().all(passes) } else { rows.iter().any(passes) } {
            passing.extend(rows.iter().filter(|row| passes(row)).map(|row| format!("{} / {}", row.check, row.subject)));
        }
    }
    assert!(number > 20 && passing.is_empty(), "{number} checks; passing: {passing:#?}");
}
