//! Tests of the errors: their kinds, fields and messages.

use std::fmt;

use super::*;

const AT: f64 = 0.5;

/// Every error with its kind, a part of its message, and its time after a first leg of 2 s.
fn errors() -> [(SolveError, &'static str, &'static str, Option<f64>); 11] {
    let singular = |point| SolveError::Singular { point, time: AT };
    [
        (SolveError::PhaseTooLarge { phase: 1e17 }, "phase_too_large", "1e17 rad, is above 2^53", None),
        (singular(Singularity::NormalAlongAxis), "singular", "(sin β = 0) at t = 0.5 s", Some(2.5)),
        (singular(Singularity::PrecessionTooSlow), "singular", "(α' = 0) at t = 0.5 s", Some(2.5)),
        (SolveError::NotOffered { scheme: "taylor" }, "not_offered", "does not offer the scheme taylor", None),
        (
            SolveError::Misbehaved { solver: "own".to_owned(), fault: Fault::Claim(-1.0) },
            "misbehaved",
            "solver 'own' claims an error of -1",
            None,
        ),
        (SolveError::failed("own", fmt::Error), "failed", "solver 'own' failed: an error occurred when", None),
        (
            SolveError::NotSymmetric { solver: "own".to_owned(), why: "it supposes a constant ωz" },
            "not_symmetric",
            "solver 'own' is for bodies with I1 = I2 only: it supposes",
            None,
        ),
        (
            SolveError::NotProven { solver: "own".to_owned(), why: "it only estimates" },
            "not_proven",
            "solver 'own' proves nothing: it only estimates",
            None,
        ),
        (
            SolveError::StepLimit { time: AT, limit: 7 },
            "step_limit",
            "more than 7 steps needed, stopped at t = 0.5 s",
            Some(2.5),
        ),
        (SolveError::StepSizeUnderflow { time: AT }, "step_size_underflow", "at t = 0.5 s", Some(2.5)),
        (SolveError::NotFinite { time: AT }, "not_finite", "is not finite at t = 0.5 s", Some(2.5)),
    ]
}

#[test]
fn an_error_has_a_kind_says_what_happened_and_counts_its_time_from_launch() {
    for (error, kind, message, later) in errors() {
        assert_eq!(error.kind(), kind);
        assert!(error.to_string().contains(message), "{error}");
        let moved = match error.clone().later(2.0) {
            SolveError::Singular { time, .. }
            | SolveError::StepLimit { time, .. }
            | SolveError::StepSizeUnderflow { time }
            | SolveError::NotFinite { time } => Some(time),
            same => {
                assert_eq!(same, error);
                None
            }
        };
        assert_eq!(moved, later, "{error}");
    }
}

#[test]
fn a_flight_that_never_began_stopped_nowhere() {
    let never = SolveError::StepLimit { time: 0.0, limit: 7 };
    assert_eq!(never.to_string(), "more than 7 steps needed");
}

#[test]
fn input_outside_its_range_is_refused_with_its_field() {
    assert_eq!(require("speed [m/s]", 3.0, ">= 0", true), Ok(3.0));
    for (value, holds) in [(-1.0, false), (f64::NAN, true), (f64::INFINITY, true)] {
        let error = require("speed [m/s]", value, ">= 0", holds).unwrap_err();
        assert_eq!(error.field(), "speed [m/s]");
        assert!(error.to_string().ends_with("is outside its valid range: >= 0"), "{error}");
    }
    let error = find_named("coin", "thaler", &["cent", "euro"], |name| name).unwrap_err();
    assert_eq!((error.field(), error.to_string()), ("coin", "coin = 'thaler' is unknown; known: cent, euro".into()));
    assert_eq!(find_named("coin", "euro", &["cent", "euro"], |name| name), Ok(&"euro"));
}
