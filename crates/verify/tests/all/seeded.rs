//! These tests give the suite solvers that are not in its tables of limits. Faults are seeded into one, one each, and every
//! one of them must be caught by checks that name the place; it is the exact motion, so that a row that fails does so by
//! the fault alone. Others must be judged by their own error estimates (their claims), and none, however broken, may end
//! the run.

mod faults;

use std::sync::LazyLock;

use faults::{FAULTS, FLIPPED, Fault, Foreign, SILENCE, fly, turned};
use toss::{
    Attitude, Formulation, Landing, QuaternionSolver, Registry, Scheme, SolveError, Solver, SolverEntry, StepControl,
    Stepping, Toss,
};
use verify::judge::limits::Limits;
use verify::{CHECKS, Check, Context, Effort, Judges, Measurement, Row, Status, judge};

/// Solvers without a fault, and such whose answers are none.
const OTHERS: [Fault; 6] = [
    ("honest", |toss| fly(*toss), &[]),
    ("rough", |toss| Ok(turned(fly(*toss)?, Attitude::about_x(9e-4))), &[]),
    ("silent", |toss| fly(*toss), &[]),
    ("nan", |toss| fly(*toss).map(|landing| landing.with_cos_tilt(f64::NAN)), &[]),
    ("claims-nan", |toss| fly(*toss), &[]),
    ("panics", |_| panic!("{PANIC}"), &[]),
];

/// The message of the panics that these tests cause.
const PANIC: &str = "out of order";

/// A quaternion solver with a scheme that no other solver has.
struct Stepper(Stepping);

/// The scheme of [`Stepper`].
const OWN: Scheme = Scheme::new("own", None).adaptive();

impl Solver for Stepper {
    fn name(&self) -> &str {
        "stepper"
    }
    fn stepping(&self) -> Option<Stepping> {
        Some(self.0)
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let StepControl::Tolerance(tolerance) = self.0.control() else { panic!("it takes no steps of a given length") };
        let stepping = Stepping::adaptive(Scheme::DOP853, tolerance).expect("a valid tolerance");
        let toss = Toss::from(toss.of_coin(self.name(), "it is made for coins")?);
        let landing = QuaternionSolver::new(stepping, Formulation::default()).land(&toss)?;
        Ok(landing.with_error(self.0.error_estimate(&toss)?))
    }
}

/// The solvers of the library that fly beside the foreign ones: without steps, and with them.
const OURS: [&str; 2] = ["exact", "gamma"];

fn registry() -> Vec<SolverEntry> {
    let foreign = |&(name, fly, _): &Fault| SolverEntry::new(name, "", move |_| Box::new(Foreign { name, fly }));
    let mut all: Vec<SolverEntry> = FAULTS.iter().chain(&OTHERS).map(foreign).collect();
    all.push(SolverEntry::new("stepper", "", |settings| Box::new(Stepper(settings.stepping))).with_schemes(&[OWN]));
    all.push(SolverEntry::new("unmade", "", |_| panic!("{PANIC}")));
    all.extend(Registry::standard().only(&OURS).expect("solvers of ours").entries().iter().cloned());
    all
}

/// What was measured of all these solvers by every check that judges solvers; a check of flights forever is left out,
/// which takes long and adds nothing.
static MEASURED: LazyLock<Vec<(&'static Check, Vec<Measurement>)>> = LazyLock::new(|| {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if info.payload().downcast_ref::<String>().is_none_or(|message| message != PANIC) {
            loud(info);
        }
    }));
    let context = Context::new(&registry(), Effort::Quick).expect("the reference numbers");
    let checks = CHECKS.iter().filter(|check| check.judges == Judges::Solver && check.id != "cheated-heads-forever");
    checks.map(|check| (check, check.measure(&context).expect("rows, whatever happens"))).collect()
});

/// The rows of the solver called `name`, judged with `limits`.
fn rows(name: &str, limits: &Limits) -> Vec<Row> {
    let judged = MEASURED.iter().flat_map(|(check, measured)| judge(check, measured.clone(), limits));
    judged.filter(|row| row.subject.split('/').next() == Some(name)).collect()
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
    for (name, _, checks) in FAULTS {
        let failing = failing(name, &no_limits());
        println!("{name}: {}", failing.join(", "));
        missed.extend(checks.iter().filter(|check| !failing.iter().any(|id| id == *check)).map(|check| (name, check)));
    }
    assert!(missed.is_empty(), "not caught: {missed:?}");
}

#[test]
fn solvers_without_a_fault_pass_by_their_claims() {
    for name in ["honest", "rough", "stepper"] {
        let rows = rows(name, &no_limits());
        assert!(rows.len() >= 18, "{name}: {} rows", rows.len());
        for row in &rows {
            assert!(matches!(row.status, Status::PassByClaim | Status::NotJudged), "{name}: {row:?}");
        }
        for check in ["random-cos-tilt", "random-attitude", "atlas-answers", SILENCE, "first-flip"] {
            assert!(rows.iter().any(|row| row.check == check && row.status == Status::PassByClaim), "{name}: {check}");
        }
    }
    let slopes = rows("stepper", &no_limits());
    assert!(slopes.iter().any(|row| row.check == "tolerance-proportion" && row.status == Status::NotJudged));
}

#[test]
fn the_librarys_solvers_pass_by_their_limits_beside_foreign_ones() {
    for ours in OURS {
        let rows = rows(ours, &Limits::of_this_workspace().expect("the limits"));
        assert!(rows.iter().all(|row| matches!(row.status, Status::Pass | Status::PassLoose)), "{rows:#?}");
    }
}

#[test]
fn a_registry_with_two_solvers_of_one_name_or_the_name_that_charts_use_is_refused() {
    for (name, says) in [("gamma", "two solvers called 'gamma'"), ("unfair-toss", "'unfair-toss' is what charts call")]
    {
        let registry = [registry(), vec![SolverEntry::new(name, "", |_| panic!("{PANIC}"))]].concat();
        let error = Context::new(&registry, Effort::Quick).err().expect("an error").to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn a_solver_that_claims_no_error_fails_where_an_error_is_judged() {
    // A refusal is no error, so that their number is judged without a claim.
    let mut rows = rows("silent", &no_limits());
    rows.retain(|row| row.check != "adversarial-refusals");
    assert!(rows.iter().all(|row| matches!(row.status, Status::NoClaim | Status::NotJudged)), "{rows:#?}");
    for check in ["random-cos-tilt", "fig4-same-counts"] {
        assert!(rows.iter().any(|row| row.check == check && row.status == Status::NoClaim), "{check}");
    }
    let adversarial = rows.iter().find(|row| row.check == "adversarial-silence").expect("a row");
    let why = adversarial.failure.as_deref().unwrap_or_default();
    assert!(why.ends_with("it claims no error, or one above 1e-2") && adversarial.worst_input.is_some(), "{why}");
}

#[test]
fn panics_and_nan_become_failing_rows_that_say_why() {
    for (name, why) in [
        ("nan", "answered cos θ = NaN"),
        ("claims-nan", "claims an error of NaN"),
        ("panics", "panicked: out of order"),
        ("unmade", "making it panicked"),
    ] {
        let rows = rows(name, &no_limits());
        let row = rows.iter().find(|row| row.check == "random-cos-tilt").expect("a row");
        assert_eq!(row.status, Status::FailByClaim, "{name}");
        assert!(row.failure.as_ref().is_some_and(|failure| failure.contains(why)), "{name}: {row:?}");
        let passing: Vec<&str> = rows.iter().filter(|row| row.status.passes()).map(|row| row.check.as_str()).collect();
        // These checks allow errors, because an error is not a wrong answer.
        let without_an_answer = ["atlas-answers", SILENCE, "adversarial-refusals"];
        assert!(passing.iter().all(|check| without_an_answer.contains(check)), "{name}: {passing:?}");
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
