//! A solver that is slightly worse than the library's is compared with the library's baseline, which must catch each loss
//! of accuracy or work, also where it stays within the limits.

use toss::{ExactSolver, QuaternionSolver, Settings, Solver, SolverEntry, StepControl, Stepping};
use verify::judge::baseline::{Baseline, Direction, Move};
use verify::judge::limits::Limits;
use verify::{CHECKS, Context, Effort, judge};

/// The checks that these tests run.
const CHECKED: [&str; 4] = ["reference-cos-tilt", "random-cos-tilt", "random-attitude", "work-precision"];

/// Runs the checks on the exact motion and on a quaternion solver that `build` makes. Returns the baseline of that run
/// and the rows that fail.
fn measure(build: fn(&Settings) -> Box<dyn Solver>) -> (Baseline, Vec<String>) {
    let limits = Limits::of_this_workspace().expect("the limits");
    let quaternion = QuaternionSolver::entry();
    let copy = SolverEntry::new(QuaternionSolver::NAME, "", build)
        .with_schemes(quaternion.schemes())
        .with_formulations(quaternion.formulations());
    let registry = [ExactSolver::entry(), copy];
    let context = Context::new(&registry, Effort::Quick).expect("the reference numbers");
    let mut rows = Vec::new();
    for check in CHECKS.iter().filter(|check| CHECKED.contains(&check.id)) {
        rows.extend(judge(check, check.measure(&context).expect("a measurement"), &limits));
    }
    let failing = rows.iter().filter(|row| !row.status.passes()).map(|row| format!("{} / {}", row.check, row.subject));
    (Baseline::of(&rows, context.sweep.found()), failing.collect())
}

/// What is worse with the solver that `build` makes than in `baseline`, and the rows that fail.
fn slips(baseline: &Baseline, build: fn(&Settings) -> Box<dyn Solver>) -> (Vec<Move>, Vec<String>) {
    let (found, failing) = measure(build);
    let worse = |moved: &Move| moved.direction == Direction::Worse;
    (baseline.moves(&found, false).into_iter().filter(worse).collect(), failing)
}

#[track_caller]
fn assert_worse(moves: &[Move], check: &str, what: &str) {
    let found =
        moves.iter().any(|moved| moved.check == check && moved.what == what && moved.subject == "quaternion/dop853");
    assert!(found, "{check} is not worse; worse: {moves:?}");
    assert!(moves.iter().all(|moved| moved.subject.starts_with("quaternion")), "only the quaternion was changed");
}

/// The library's quaternion solver with its tolerance multiplied by `factor`.
fn with_tolerance_times(factor: f64, settings: &Settings) -> Box<dyn Solver> {
    let stepping = match settings.stepping.control() {
        StepControl::Tolerance(tolerance) => {
            Stepping::adaptive(settings.stepping.scheme(), tolerance * factor).unwrap_or(settings.stepping)
        }
        StepControl::Step(_) => settings.stepping,
    };
    Box::new(QuaternionSolver::new(stepping, settings.formulation))
}

#[test]
fn a_tolerance_ten_times_too_loose_or_too_tight_is_detected() {
    let (ours, failing) = measure(|settings| with_tolerance_times(1.0, settings));
    assert_eq!(failing, [""; 0]);
    let (loose, failing) = slips(&ours, |settings| with_tolerance_times(10.0, settings));
    for check in ["work-precision/cheated", "work-precision/ensemble", "work-precision/long"] {
        assert_worse(&loose, check, "error");
    }
    assert!(failing.contains(&"random-attitude / quaternion/dop853".to_owned()), "{failing:?}");
    let (tight, failing) = slips(&ours, |settings| with_tolerance_times(0.1, settings));
    assert_worse(&tight, "work-precision/ensemble", "calls");
    assert_eq!(failing, [""; 0], "more calls alone exceed no limit");
}
