//! These tests seed faults into a foreign solver, one each, and see every one of them caught by checks that name the
//! place. The solver is the exact motion, so that a row that fails does so by the fault alone.

mod faults;

use std::sync::LazyLock;

use faults::{FAULTS, FLIPPED, Fault, Foreign, HONEST, SILENCE, fly, turned};
use toss::{Attitude, SolverEntry};
use verify::judge::limits::Limits;
use verify::{CHECKS, Check, Context, Effort, Judges, Measurement, Row, judge};

/// What was measured of the faulty solvers and of two without a fault, by every check that judges solvers; a check of
/// flights forever is left out, which takes long and adds nothing.
static MEASURED: LazyLock<Vec<(&'static Check, Vec<Measurement>)>> = LazyLock::new(|| {
    let honest: [Fault; 2] = [
        ("honest", HONEST, |toss| fly(*toss), &[]),
        ("rough", 2e-3, |toss| Ok(turned(fly(*toss)?, Attitude::about_x(9e-4))), &[]),
    ];
    let entry =
        |&(name, claim, fly, _): &Fault| SolverEntry::new(name, "", move |_| Box::new(Foreign { name, claim, fly }));
    let registry: Vec<SolverEntry> = FAULTS.iter().chain(&honest).map(entry).collect();
    let context = Context::new(&registry, Effort::Quick).expect("the reference numbers");
    let left_out = ["cheated-heads-forever", "cross-method-attitude"];
    let checks = CHECKS.iter().filter(|check| check.judges == Judges::Solver && !left_out.contains(&check.id));
    checks.map(|check| (check, check.measure(&context).expect("rows, whatever happens"))).collect()
});

/// The rows of the solver called `name`, judged with `limits`.
fn rows(name: &str, limits: &Limits) -> Vec<Row> {
    let judged = MEASURED.iter().flat_map(|(check, measured)| judge(check, measured.clone(), limits));
    judged.filter(|row| row.subject == name).collect()
}

/// The ids of the checks that `name` fails, judged with `limits`.
fn failing(name: &str, limits: &Limits) -> Vec<String> {
    rows(name, limits).into_iter().filter(|row| !row.status.passes()).map(|row| row.check).collect()
}

fn no_limits() -> Limits {
    Limits::parse("").expect("an empty table")
}

#[test]
fn each_seeded_fault_is_caught_by_the_checks_that_name_its_place() {
    let mut missed = Vec::new();
    for (name, _, _, checks) in FAULTS {
        let failing = failing(name, &no_limits());
        println!("{name}: {}", failing.join(", "));
        missed.extend(checks.iter().filter(|check| !failing.iter().any(|id| id == *check)).map(|check| (name, check)));
    }
    assert!(missed.is_empty(), "not caught: {missed:?}");
}

#[test]
fn solvers_without_a_fault_pass_by_their_claims() {
    for name in ["honest", "rough"] {
        assert!(rows(name, &no_limits()).len() >= 18, "{name}");
        assert_eq!(failing(name, &no_limits()), [""; 0], "{name}");
    }
}

#[test]
fn right_answers_with_an_excessive_claim_fail_by_the_claim_alone() {
    assert_eq!(failing("claims-a-thousand-times", &no_limits()), ["claims-measured"]);
}

/// The table that gives `name` the largest limit that every check accepts, as a file could.
fn most_generous(name: &str) -> Limits {
    let line = |check: &Check| format!("[{}]\nreason = 'r'\nallowed = {{ {name} = {:?} }}\n", check.id, check.ceiling);
    let text: String = MEASURED.iter().map(|(check, _)| line(check)).collect();
    Limits::parse(&text).expect("limits at their ceilings")
}

#[test]
fn no_table_of_limits_makes_a_flipped_solver_pass() {
    for name in ["flipped", "claims-2-and-is-flipped"] {
        let failing = failing(name, &most_generous(name));
        // Where nothing is claimed, no answer is wrong against its claim.
        for check in FLIPPED.iter().filter(|check| name == "flipped" || **check != SILENCE) {
            assert!(failing.iter().any(|id| id == check), "{name}: {check} does not fail; failing: {failing:?}");
        }
        let refused = Limits::parse(&format!("[random-attitude]\nreason = 'r'\nallowed = {{ {name} = 4.0 }}"));
        let error = refused.expect_err("a limit above the ceiling").to_string();
        assert!(error.contains("[random-attitude]") && error.contains(name) && error.contains("0.01"), "{error}");
    }
    assert_eq!(failing("rough", &most_generous("rough")), [""; 0]);
}
