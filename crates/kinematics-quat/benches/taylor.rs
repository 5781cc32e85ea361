//! Benchmark of Taylor series, in SIMD lanes and one flight at a time, and of DOP853, at the same largest error of
//! 4e-12 rad. Compare the ratios of the times, which depend less on the machine; each time is that of all launches.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dynamics::{Coin, Formulation, Launch, Scheme, Solver, Stepping, TimeOfFlight, Toss, Vector3};
use kinematics_quat::{QuaternionSolver, TAYLOR};
use numerics::lanes::SimdLevel;

/// Tolerances at which the largest error over the launches is about the same.
const TAYLOR_TOLERANCE: f64 = 1e-10;
const DOP853_TOLERANCE: f64 = 1e-12;

/// Launches with rates from 1 to 60 rad/s and speeds from 3 to 5 m/s, spread evenly like multiples of irrational
/// numbers.
fn tosses() -> Vec<Toss> {
    let part = |n: u32, step: f64| (f64::from(n) * step).fract();
    let toss = |n: u32| {
        let rate =
            Vector3::new(part(n, 0.618_034), part(n, 0.414_214), part(n, 0.732_051)).map(|part| 1.0 + 59.0 * part);
        let thrown = TimeOfFlight::Ballistic { speed: 3.0 + 2.0 * part(n, 0.236_068), gravity: 9.81 };
        Toss::new(Coin::PAPER, Launch::new(rate, thrown).expect("a valid launch"))
    };
    (0..1000).map(toss).collect()
}

fn solver(scheme: Scheme, tolerance: f64) -> QuaternionSolver {
    QuaternionSolver::new(Stepping::adaptive(scheme, tolerance).expect("a valid tolerance"), Formulation::default())
}

fn launches(criterion: &mut Criterion) {
    let tosses = tosses();
    let (taylor, dop853) = (solver(TAYLOR, TAYLOR_TOLERANCE), solver(Scheme::DOP853, DOP853_TOLERANCE));
    let mut group = criterion.benchmark_group("quaternion, 1000 launches");
    group.throughput(Throughput::Elements(tosses.len() as u64));
    for level in SimdLevel::all() {
        let name = format!("taylor in lanes, {}", level.name());
        group.bench_function(name, |bencher| bencher.iter(|| taylor.land_all(black_box(&tosses), level)));
    }
    for tolerance in [TAYLOR_TOLERANCE, 1e-12] {
        let (solver, level) = (solver(TAYLOR, tolerance), SimdLevel::widest());
        for (name, number) in [("plain", 0), ("proven", 1), ("outcomes proven", 2)] {
            group.bench_function(format!("taylor in lanes, {tolerance:e}, {name}"), |bencher| {
                bencher.iter(|| match number {
                    0 => solver.land_all(black_box(&tosses), level).len(),
                    1 => solver.certify_all(black_box(&tosses), level).len(),
                    _ => solver.prove_outcomes(black_box(&tosses), level).len(),
                });
            });
        }
    }
    for (name, solver) in [("taylor", taylor), ("dop853", dop853)] {
        let fly = || black_box(&tosses).iter().filter(|toss| solver.land(toss).is_ok()).count();
        group.bench_function(name, |bencher| bencher.iter(fly));
    }
    group.finish();
}

criterion_group!(benches, launches);
criterion_main!(benches);
