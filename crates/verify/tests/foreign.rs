//! These tests give the suite solvers that are not in its tables of limits. Each must be judged by its own error
//! estimate (its claim), and none, however broken, may end the run.

use std::sync::LazyLock;

use toss::{
    Attitude, ExactSolver, Formulation, Landing, QuaternionSolver, Registry, Scheme, SolveError, Solver, SolverEntry,
    State, StepControl, Stepping, Toss,
};
use verify::judge::limits::Limits;
use verify::{CHECKS, Context, Effort, Judges, Row, Status, judge};

/// The exact motion under another name, with a claim of its own and an answer that is altered by `change`.
struct Foreign {
    name: &'static str,
    claim: Option<f64>,
    change: fn(Landing) -> Landing,
}

impl Solver for Foreign {
    fn name(&self) -> &str {
        self.name
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let toss = toss.of_coin(self.name, "it is made for coins")?;
        ExactSolver.land(&toss.into()).map(self.change).map(|landing| landing.with_error(self.claim))
    }
}

fn closed_form(name: &'static str, claim: Option<f64>, change: fn(Landing) -> Landing) -> SolverEntry {
    SolverEntry::new(name, "", move |_| Box::new(Foreign { name, claim, change }))
}

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

/// The landing with its attitude turned by 1 mrad, and cos θ accordingly.
fn turned(landing: Landing) -> Landing {
    let State { attitude, rate } = landing.state;
    Landing::new(State { attitude: Attitude::about_x(1e-3) * attitude, rate }, landing.work)
}

/// The message of the panics that these tests cause.
const PANIC: &str = "out of order";

fn foreigners() -> Vec<SolverEntry> {
    vec![
        closed_form("good", Some(1e-15), |landing| landing),
        SolverEntry::new("stepper", "", |settings| Box::new(Stepper(settings.stepping))).with_schemes(&[OWN]),
        closed_form("rough", Some(2e-3), turned),
        closed_form("overconfident", Some(1e-9), turned),
        closed_form("negated", Some(1e-9), |landing| landing.with_cos_tilt(-landing.cos_tilt)),
        closed_form("silent", None, |landing| landing),
        closed_form("nan", Some(1e-9), |landing| landing.with_cos_tilt(f64::NAN)),
        closed_form("claims-nan", Some(f64::NAN), |landing| landing),
        closed_form("panics", Some(1e-9), |_| panic!("{PANIC}")),
        SolverEntry::new("unmade", "", |_| panic!("{PANIC}")),
    ]
}

/// The solvers of the library that fly beside the foreign ones: without steps, and with them. The suite itself judges all.
const OURS: [&str; 2] = ["exact", "gamma"];

/// The rows of [`OURS`] together with all the foreign solvers, from every check that judges solvers.
static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if info.payload().downcast_ref::<String>().is_none_or(|message| message != PANIC) {
            loud(info);
        }
    }));
    let limits = Limits::of_this_workspace().expect("the limits");
    let mut registry = Registry::standard().entries().to_vec();
    registry.retain(|entry| OURS.contains(&entry.name()));
    registry.extend(foreigners());
    let context = Context::new(&registry, Effort::Quick).expect("the reference numbers");
    let checks = CHECKS.iter().filter(|check| check.judges == Judges::Solver);
    checks.flat_map(|check| judge(check, check.measure(&context).expect("rows, whatever happens"), &limits)).collect()
});

/// The rows of the solver called `name`. A comparison of two solvers, `a ~ b`, counts as a row of b alone.
fn rows_of(name: &str) -> Vec<&'static Row> {
    let is_of = |subject: &str| subject.split('/').next() == Some(name);
    ROWS.iter().filter(|row| row.subject.split(" ~ ").last().is_some_and(is_of)).collect()
}

/// The ids of the checks under which `name` has one of `statuses`.
fn checks_with(name: &str, statuses: &[Status]) -> Vec<&'static str> {
    rows_of(name).into_iter().filter(|row| statuses.contains(&row.status)).map(|row| row.check.as_str()).collect()
}

fn failing(name: &str) -> Vec<&'static str> {
    rows_of(name).into_iter().filter(|row| !row.status.passes()).map(|row| row.check.as_str()).collect()
}

#[test]
fn a_registry_with_two_solvers_of_one_name_is_refused() {
    let impostor = closed_form("gamma", Some(1e-9), |landing| landing);
    let registry = [Registry::standard().entries(), &[impostor]].concat();
    let error = Context::new(&registry, Effort::Quick).err().expect("an error").to_string();
    assert!(error.contains("two solvers called 'gamma'"), "{error}");
}

#[test]
fn the_librarys_solvers_pass_by_their_limits_beside_foreign_ones() {
    for ours in OURS {
        assert_eq!(failing(ours), [""; 0], "{ours}");
        assert_eq!(checks_with(ours, &[Status::PassByClaim, Status::NotJudged]), [""; 0], "{ours}");
    }
}

#[test]
fn a_solver_within_its_claim_passes_without_a_limit_as_passing_by_claim() {
    for name in ["good", "stepper", "rough"] {
        let rows = rows_of(name);
        assert!(rows.len() > 18, "{name}: {} rows", rows.len());
        let beside_others = |row: &&&Row| row.subject.contains(" ~ ");
        for row in rows.iter().filter(|row| !beside_others(row)) {
            assert!(matches!(row.status, Status::PassByClaim | Status::NotJudged), "{name}: {row:?}");
        }
        for check in ["random-cos-tilt", "random-attitude", "atlas-answers", "adversarial-silence", "first-flip"] {
            assert!(checks_with(name, &[Status::PassByClaim]).contains(&check), "{name}: {check}");
        }
    }
    assert!(checks_with("stepper", &[Status::NotJudged]).contains(&"tolerance-proportion"));
}

#[test]
fn a_solver_that_is_wrong_fails_whatever_it_claims() {
    for (name, checks) in [
        (
            "negated",
            ["random-cos-tilt", "atlas-answers", "adversarial-silence", "cheated-heads-in-flight", "fig4-same-counts"]
                .as_slice(),
        ),
        ("overconfident", &["random-attitude", "atlas-answers", "adversarial-silence", "invariant-momentum-vector"]),
    ] {
        let failing = checks_with(name, &[Status::FailByClaim]);
        for check in checks {
            assert!(failing.contains(check), "{name}: {check} does not fail; failing: {failing:?}");
        }
    }
}

#[test]
fn a_solver_that_claims_no_error_fails_where_an_error_is_judged() {
    // A refusal is no error, so that their number is judged without a claim.
    let rows: Vec<&Row> = rows_of("silent").into_iter().filter(|row| row.check != "adversarial-refusals").collect();
    assert!(rows.iter().all(|row| matches!(row.status, Status::NoClaim | Status::NotJudged)), "{rows:#?}");
    assert!(checks_with("silent", &[Status::NoClaim]).contains(&"random-cos-tilt"));
    assert!(checks_with("silent", &[Status::NoClaim]).contains(&"fig4-same-counts"));
}

#[test]
fn panics_and_nan_become_failing_rows_that_say_why() {
    for (name, why) in [
        ("nan", "answered cos θ = NaN"),
        ("claims-nan", "claims an error of NaN"),
        ("panics", "panicked: out of order"),
        ("unmade", "making it panicked"),
    ] {
        let rows = rows_of(name);
        let row = rows.iter().find(|row| row.check == "random-cos-tilt").expect("a row");
        assert_eq!(row.status, Status::FailByClaim, "{name}");
        assert!(row.failure.as_ref().is_some_and(|failure| failure.contains(why)), "{name}: {row:?}");
        let passing: Vec<&str> = rows.iter().filter(|row| row.status.passes()).map(|row| row.check.as_str()).collect();
        // These checks allow errors, because an error is not a wrong answer.
        let without_an_answer = ["atlas-answers", "adversarial-silence", "adversarial-refusals"];
        assert!(passing.iter().all(|check| without_an_answer.contains(check)), "{name}: {passing:?}");
    }
}
