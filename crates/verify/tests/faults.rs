//! These tests check the suite itself: each hands it a solver with a known fault, and the suite must fail. A suite that
//! passes everything would otherwise not be noticed.
//!
//! The γ-ODE and the quaternion are written again here, each with a parameter for the fault. Without their faults these
//! copies pass, so a failure is due to the fault alone.

use dynamics::Flight;
use dynamics::integrate::OdeSystem;
use nalgebra::SVector;
use toss::{
    Attitude, Coin, CoinToss, EulerAngles, ExactSolver, Formulation, Landing, QuaternionSolver, Scheme, Settings,
    SolveError, Solver, SolverEntry, State, Stepping, Toss, Vector3, Work,
};
use verify::judge::limits::Limits;
use verify::{CHECKS, Context, Effort, Judges, Row, judge};

/// A solver of the γ-ODE, equations (10) and (11) of the paper, with the frame's z axis along the angular momentum S.
/// The coefficient C has the right sign for `sign_of_c` = 1.
struct GammaCopy {
    stepping: Stepping,
    sign_of_c: f64,
}

struct GammaCopySystem {
    rate_z: f64,
    q: f64,
    sign_of_c: f64,
}

impl GammaCopySystem {
    /// The terms D = ωx sin γ + ωy cos γ, u = ωz - γ' and β' of the equations.
    fn terms(&self, y: &SVector<f64, 5>) -> (f64, f64, f64) {
        let (sin, cos) = y[0].sin_cos();
        (y[3] * sin + y[4] * cos, self.rate_z - y[1], y[3] * cos - y[4] * sin)
    }
}

impl OdeSystem<5> for GammaCopySystem {
    fn derivative(&self, y: &SVector<f64, 5>) -> SVector<f64, 5> {
        let (d, u, beta_rate) = self.terms(y);
        let (a, b) = ((3.0 * self.rate_z - self.q) * beta_rate / d, -2.0 * beta_rate / d);
        let c = -self.sign_of_c * (self.rate_z * (self.rate_z - self.q) + d * d) * beta_rate / d;
        let acceleration = if beta_rate == 0.0 { 0.0 } else { -(a * y[1] + b * y[1] * y[1] + c) };
        SVector::from([y[1], acceleration, d.hypot(u), -self.q * y[4], self.q * y[3]])
    }
}

impl Solver for GammaCopy {
    fn name(&self) -> &str {
        "gamma"
    }
    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let landing = self.land_coin(&toss.of_coin(self.name(), "it is made for coins")?)?;
        Ok(landing.with_error(self.stepping.error_estimate(toss)?))
    }
}

impl GammaCopy {
    fn land_coin(&self, toss: &CoinToss) -> Result<Landing, SolveError> {
        let flight = Flight::new(toss)?;
        let rate = flight.rate;
        let k = toss.coin.inertia_ratio();
        // If S points against the coin's normal n, the flight is solved as seen from the other face, so that α' > 0.
        if k * rate.z < 0.0 {
            return self.seen_from_the_other_face(toss);
        }
        let system = GammaCopySystem { rate_z: rate.z, q: (k - 1.0) * rate.z, sign_of_c: self.sign_of_c };
        let start =
            EulerAngles { alpha: 0.0, beta: rate.x.hypot(rate.y).atan2(k * rate.z), gamma: rate.x.atan2(rate.y) };
        let first = SVector::from([start.gamma, (1.0 - k) * rate.z, 0.0, rate.x, rate.y]);
        let (end, work) = flight.integrate(&system, first, &self.stepping)?;
        let (d, u, _) = system.terms(&end);
        let beta = if d == 0.0 && u == 0.0 { 0.0 } else { d.atan2(u) };
        let angles = EulerAngles { alpha: end[2], beta, gamma: end[0] };
        let attitude = toss.launch.attitude() * start.attitude().inverse() * angles.attitude();
        Ok(Landing::new(State { attitude, rate: flight.rate_at(end[3], end[4]) }, work))
    }

    fn seen_from_the_other_face(&self, toss: &CoinToss) -> Result<Landing, SolveError> {
        let mirror = Vector3::new(1.0, -1.0, -1.0);
        let half_turn = Attitude::from_components([0.0, 1.0, 0.0, 0.0]).expect("a unit quaternion");
        let turned =
            State { attitude: toss.launch.attitude() * half_turn, rate: toss.launch.rate().component_mul(&mirror) };
        let launch = toss::Launch::from_state(&turned, toss.launch.time_of_flight()).expect("a launch");
        let landing = self.land_coin(&CoinToss { launch, ..*toss })?;
        let state =
            State { attitude: landing.state.attitude * half_turn, rate: landing.state.rate.component_mul(&mirror) };
        Ok(Landing::new(state, landing.work))
    }
}

/// A solver of the quaternion's equation Q' = `half` Q ⊗ (0, ω), which is right for `half` = ½.
struct QuaternionCopy {
    stepping: Stepping,
    half: f64,
}

struct QuaternionCopySystem {
    rate_z: f64,
    q: f64,
    half: f64,
}

impl OdeSystem<6> for QuaternionCopySystem {
    fn derivative(&self, y: &SVector<f64, 6>) -> SVector<f64, 6> {
        let (a, b, c) = (self.half * y[4], self.half * y[5], self.half * self.rate_z);
        SVector::from([
            -(y[1] * a + y[2] * b + y[3] * c),
            y[0] * a + y[2] * c - y[3] * b,
            y[0] * b + y[3] * a - y[1] * c,
            y[0] * c + y[1] * b - y[2] * a,
            -self.q * y[5],
            self.q * y[4],
        ])
    }
}

impl Solver for QuaternionCopy {
    fn name(&self) -> &str {
        "quaternion"
    }
    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }
    // The copy is of the flights of coins; other bodies fly by the library's solver.
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let error = self.stepping.error_estimate(toss)?;
        let Some(toss) = toss.coin() else {
            return QuaternionSolver::new(self.stepping, Formulation::default()).land(toss);
        };
        let flight = Flight::new(&toss)?;
        let rate = flight.rate;
        let q = (toss.coin.inertia_ratio() - 1.0) * rate.z;
        let system = QuaternionCopySystem { rate_z: rate.z, q, half: self.half };
        let first = SVector::from([1.0, 0.0, 0.0, 0.0, rate.x, rate.y]);
        let (end, work) = flight.integrate(&system, first, &self.stepping)?;
        let turn = Attitude::from_components([end[0], end[1], end[2], end[3]]).expect("a finite state");
        let state = State { attitude: toss.launch.attitude() * turn, rate: flight.rate_at(end[4], end[5]) };
        let norm_error = (end.fixed_rows::<4>(0).norm() - 1.0).abs();
        Ok(Landing::new(state, work).with_norm_error(norm_error).with_error(error))
    }
}

/// A correct solver that is given the coin with I1 and I3 swapped.
struct Swapped<S>(S);

impl<S: Solver> Solver for Swapped<S> {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn stepping(&self) -> Option<Stepping> {
        self.0.stepping()
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let coin = toss.of_coin(self.name(), "it is made for coins")?.coin;
        let error = self.0.tilt(toss)?.error;
        match Coin::from_moments(coin.i3(), coin.i1()) {
            Ok(coin) => Ok(self.0.land(&Toss::new(coin, toss.launch))?.with_error(error)),
            // Some coins have no valid twin with swapped moments. For them any wrong answer will do.
            Err(_) => {
                let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
                Ok(Landing::new(state, Work::default()).with_error(error))
            }
        }
    }
}

fn entry(name: &'static str, integrates: bool, build: fn(&Settings) -> Box<dyn Solver>) -> SolverEntry {
    let entry = SolverEntry::new(name, "", build);
    if integrates {
        entry.with_schemes(&Scheme::RUNGE_KUTTA).with_formulations(&[Formulation::MOMENTUM])
    } else {
        entry
    }
}

/// The rows that fail with `solver` beside the exact motion, under the checks that judge solvers. Four of them are left
/// out: two need the vertical frame and two the refusals of singular flights, which the copies do not have.
fn failing_rows(solver: SolverEntry) -> Vec<Row> {
    const LEFT_OUT: [&str; 4] =
        ["vertical-frame-to-first-return", "convergence-order", "adversarial-silence", "adversarial-refusals"];
    let limits = Limits::of_this_workspace().expect("the limits");
    let registry = if solver.integrates() { vec![ExactSolver::entry(), solver] } else { vec![solver] };
    let context = Context::new(&registry, Effort::Quick).expect("the reference numbers");
    CHECKS
        .iter()
        .filter(|check| check.judges == Judges::Solver && !LEFT_OUT.contains(&check.id))
        .flat_map(|check| judge(check, check.measure(&context).expect("a measurement"), &limits))
        .filter(|row| !row.status.passes())
        .collect()
}

/// Fails unless `solver` fails under each of the checks `by`, in rows that judge a solver and not the library.
#[track_caller]
fn assert_caught(solver: SolverEntry, by: &[&str]) {
    let failing = failing_rows(solver);
    for check in by {
        assert!(failing.iter().any(|row| row.check == *check), "{check} does not fail; failing: {failing:?}");
    }
    let blamed: Vec<&Row> = failing.iter().filter(|row| row.judges != Some(Judges::Solver)).collect();
    assert!(blamed.is_empty(), "a solver's fault fails a row of the library: {blamed:?}");
}

#[test]
fn the_copies_pass_without_their_faults() {
    let gamma = entry("gamma", true, |s| Box::new(GammaCopy { stepping: s.stepping, sign_of_c: 1.0 }));
    assert_eq!(failing_rows(gamma), []);
    let quaternion = entry("quaternion", true, |s| Box::new(QuaternionCopy { stepping: s.stepping, half: 0.5 }));
    assert_eq!(failing_rows(quaternion), []);
}

#[test]
fn a_wrong_sign_of_the_gamma_odes_coefficient_c_is_caught() {
    let faulty = entry("gamma", true, |s| Box::new(GammaCopy { stepping: s.stepping, sign_of_c: -1.0 }));
    assert_caught(faulty, &["reference-cos-tilt", "random-attitude", "cross-method-attitude", "fig4-same-counts"]);
}

#[test]
fn a_missing_factor_of_one_half_in_the_quaternions_equation_is_caught() {
    let faulty = entry("quaternion", true, |s| Box::new(QuaternionCopy { stepping: s.stepping, half: 1.0 }));
    let invariant = "invariant-momentum-vector";
    assert_caught(faulty, &["reference-cos-tilt", "random-attitude", invariant, "tails-in-flight", "first-flip"]);
}

#[test]
fn swapped_moments_are_caught_in_an_integrator_and_in_the_exact_motion() {
    let faulty = entry("quaternion", true, |s| Box::new(Swapped(QuaternionSolver::new(s.stepping, s.formulation))));
    assert_caught(faulty, &["reference-cos-tilt", "random-attitude", "invariant-momentum-vector", "first-flip"]);
    let exact = entry("exact", false, |_| Box::new(Swapped(ExactSolver)));
    assert_caught(exact, &["reference-cos-tilt", "random-attitude", "invariant-momentum-vector", "first-flip"]);
}
