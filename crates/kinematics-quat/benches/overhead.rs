//! Benchmark of the overhead of [`QuaternionSolver`] over the stepper DOP853 of `ode_solvers` alone, with the same
//! right-hand side, start, tolerance and flight. Compare the ratio of the two times, which depends less on the machine
//! than either.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dynamics::integrate::OdeSystem;
use dynamics::{Coin, CoinToss, Formulation, Launch, Scheme, Solver, Stepping, TimeOfFlight, Toss, Vector3};
use kinematics_quat::{QuaternionSolver, QuaternionSystem};
use nalgebra::SVector;
use numerics::scale::power_of_two_scale;
use ode_solvers::Dop853;
use ode_solvers::dop_shared::{OutputType, System};

const TOLERANCE: f64 = 1e-9;

#[derive(Clone, Copy)]
struct Bare(QuaternionSystem);

impl System<f64, SVector<f64, 6>> for Bare {
    fn system(&self, _time: f64, y: &SVector<f64, 6>, dy: &mut SVector<f64, 6>) {
        *dy = self.0.derivative(y);
    }
}

fn toss() -> CoinToss {
    let thrown = TimeOfFlight::Ballistic { speed: 4.0, gravity: 9.81 };
    let launch = Launch::new(Vector3::new(23.0, -31.0, 17.0), thrown).expect("a valid launch");
    CoinToss { coin: Coin::PAPER, launch }
}

/// The end state by the stepper alone, with its default settings except sparse output, which the solver uses too.
fn bare(toss: &CoinToss) -> SVector<f64, 6> {
    let scale = power_of_two_scale(toss.launch.rate().amax());
    let rate = toss.launch.rate() / scale;
    let system = Bare(QuaternionSystem::new(toss.coin.inertia_ratio(), rate.z));
    let start = SVector::from([1.0, 0.0, 0.0, 0.0, rate.x, rate.y]);
    let mut stepper = Dop853::new(system, 0.0, toss.launch.flight_time() * scale, 0.0, start, TOLERANCE, TOLERANCE);
    stepper.set_output(OutputType::Sparse);
    stepper.integrate().expect("a regular system");
    *stepper.y_out().last().expect("the start at least")
}

fn overhead(criterion: &mut Criterion) {
    let (coin, toss) = (toss(), Toss::from(toss()));
    let solver = QuaternionSolver::new(
        Stepping::adaptive(Scheme::DOP853, TOLERANCE).expect("a valid tolerance"),
        Formulation::default(),
    );
    let mut group = criterion.benchmark_group("quaternion at 1e-9");
    group.bench_function("solver", |bencher| bencher.iter(|| solver.land(black_box(&toss))));
    group.bench_function("bare DOP853", |bencher| bencher.iter(|| bare(black_box(&coin))));
    group.finish();
}

criterion_group!(benches, overhead);
criterion_main!(benches);
