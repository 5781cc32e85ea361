//! These tests compare solvers that are slightly worse than the library's with the library's baseline. The baseline
//! must catch each loss of accuracy or work, also where it stays within the limits. A fault in the equations must exceed
//! the limits.

use dynamics::Flight;
use dynamics::integrate::OdeSystem;
use kinematics_quat::QuaternionSystem;
use nalgebra::SVector;
use toss::{
    ExactSolver, Formulation, Landing, QuaternionSolver, Settings, SolveError, Solver, SolverEntry, State, StepControl,
    Stepping, Toss,
};
use verify::judge::baseline::{Baseline, Direction, Move};
use verify::judge::limits::Limits;
use verify::{CHECKS, Context, Effort, judge};

/// The checks that these tests run.
const CHECKED: [&str; 5] =
    ["reference-cos-tilt", "random-cos-tilt", "random-attitude", "invariant-projection", "work-precision"];

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

/// What is worse with the solver that `build` makes than with the library's, and the rows that fail.
fn slips(build: fn(&Settings) -> Box<dyn Solver>) -> (Vec<Move>, Vec<String>) {
    let (baseline, failing) =
        measure(|settings| Box::new(QuaternionSolver::new(settings.stepping, settings.formulation)));
    assert_eq!(failing, [""; 0]);
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
    let (loose, failing) = slips(|settings| with_tolerance_times(10.0, settings));
    for check in ["work-precision/cheated", "work-precision/ensemble", "work-precision/long"] {
        assert_worse(&loose, check, "error");
    }
    assert!(failing.contains(&"random-attitude / quaternion/dop853".to_owned()), "{failing:?}");
    let (tight, failing) = slips(|settings| with_tolerance_times(0.1, settings));
    assert_worse(&tight, "work-precision/ensemble", "calls");
    assert_eq!(failing, [""; 0], "more calls alone exceed no limit");
}

/// A change of the derivatives of the quaternion's equations, given the state and the derivatives.
type Change = fn(&SVector<f64, 6>, SVector<f64, 6>) -> SVector<f64, 6>;

/// The quaternion's equations with such a change.
struct Changed(QuaternionSystem, Change);

impl OdeSystem<6> for Changed {
    fn derivative(&self, y: &SVector<f64, 6>) -> SVector<f64, 6> {
        self.1(y, self.0.derivative(y))
    }
}

struct ChangedSolver(Stepping, Change);

impl Solver for ChangedSolver {
    fn name(&self) -> &str {
        "quaternion"
    }
    fn stepping(&self) -> Option<Stepping> {
        Some(self.0)
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let error = self.0.error_estimate(toss)?;
        let flight = Flight::new(toss)?;
        let toss = toss.of_coin(self.name(), "it is made for coins")?;
        let system = Changed(QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z), self.1);
        let start = SVector::from([1.0, 0.0, 0.0, 0.0, flight.rate.x, flight.rate.y]);
        let (end, work) = flight.integrate(&system, start, &self.0)?;
        let turn = toss::Attitude::from_components([end[0], end[1], end[2], end[3]]).expect("a finite state");
        let state =
            State { attitude: toss.launch.attitude() * turn, rate: flight.rate_at([end[4], end[5], flight.rate.z]) };
        Ok(Landing::new(state, work).with_error(error))
    }
}

#[test]
fn a_state_perturbed_by_a_part_in_1e12_is_detected_as_error_of_its_solver() {
    // It grows by that part in each radian, which is about one step.
    let (worse, _) = slips(|settings| Box::new(ChangedSolver(settings.stepping, |y, slope| slope + y * 1e-12)));
    assert_worse(&worse, "work-precision/ensemble", "error");
    assert_worse(&worse, "work-precision/long", "error");
    assert!(worse.iter().all(|moved| moved.what == "error"), "{worse:?}");
}

#[test]
fn a_quaternion_that_is_not_normalised_at_landing_fails() {
    let (_, failing) = slips(|settings| Box::new(QuaternionSolver::new(settings.stepping, Formulation::RAW)));
    for method in ["dop853", "dopri5", "rk4"] {
        assert!(failing.contains(&format!("invariant-projection / quaternion/{method}")), "{failing:?}");
    }
}
