//! The paragraph on patterns that faults make.

use super::*;
use crate::judge::{Row, Status};
use crate::render::tests::{library, row};

/// The rows of a small suite, of which those fail that `fails` selects.
fn rows(fails: impl Fn(&str, &str) -> bool) -> Vec<Row> {
    let mut rows = Vec::new();
    for check in ["random-attitude", "reference-cos-tilt", "invariant-energy"] {
        for subject in ["exact", "gamma/dop853", "gamma/rk4", "euler/dop853", "euler/rk4"] {
            rows.push(row(check, subject, if fails(check, subject) { 2.0 } else { 0.5 }, 1.0));
        }
    }
    for (check, subject) in
        [("batch-outcomes", "random"), ("batch-attitude", "corners"), ("sampling-errors", "grid/2^14")]
    {
        rows.push(library(check, subject, if fails(check, subject) { 2.0 } else { 0.5 }, 1.0));
    }
    rows
}

#[test]
fn names_what_fails_and_what_passes() {
    let text = of_rows(&rows(|_, subject| subject.contains('/') && !subject.contains('^')));
    assert_eq!(
        text,
        "Fails: euler, gamma, by every scheme, in all 3 solver checks. Passes: exact, 3 checks of the library."
    );
}

#[test]
fn names_one_solver_one_scheme_and_the_checks() {
    let text = of_rows(&rows(|check, subject| check == "invariant-energy" && subject.starts_with("gamma")));
    assert!(text.starts_with("Fails: gamma, by every scheme, in one check (invariant-energy). Passes: euler, exact"));
    let text = of_rows(&rows(|check, subject| check != "invariant-energy" && subject.ends_with("/rk4")));
    assert!(text.starts_with(
        "Fails: euler, gamma, by rk4, in 2 of 3 solver checks (random-attitude, reference-cos-tilt). \
         Passes: exact, 3 checks of the library."
    ));
    let text = of_rows(&rows(|_, subject| !subject.contains('^') && subject != "random" && subject != "corners"));
    assert!(text.starts_with("Fails: all solvers, by every scheme, in all 3 solver checks. Passes: "), "{text}");
}

#[test]
fn names_the_part_of_the_library_that_fails() {
    let text = of_rows(&rows(|check, _| check == "batch-outcomes"));
    assert_eq!(text, "Fails: the library, in batch-outcomes. Passes: euler, exact, gamma, 2 checks of the library.");
}

#[test]
fn an_impostor_called_exact_is_not_taken_for_the_library() {
    let mut found = rows(|_, subject| subject == "exact");
    found.push(library("exact-speed-share", "exact", 0.0, 1.0));
    let text = of_rows(&found);
    assert!(text.starts_with("Fails: exact, in all 3 solver checks. Passes: euler, gamma, 4 checks"));
}

#[test]
fn says_which_formulation_fails_and_which_limits_were_not_measured() {
    let mut found = rows(|_, _| false);
    assert_eq!(of_rows(&found), "All 18 rows pass: euler, exact, gamma and 3 checks of the library.");
    found.push(row("atlas-answers", "gamma/dop853/vertical", 2.0, 1.0));
    assert!(of_rows(&found).contains("gamma, by dop853, in the formulation vertical, in one check"), "{found:?}");
    let unused = Row { judges: None, status: Status::NotMeasured, measured: None, ..row("gone", "gamma", 1.0, 1.0) };
    assert!(of_rows(&[unused]).starts_with("Fails: not measured in time or not at all: gone."));
}
