//! This benchmark measures the overhead of sampling, on one thread. Two ratios show it:
//! - `fig4 grid / exact` to `fig4 grid / sine and cosine`: the cost of a launch by the exact motion in units of that of
//!   its sine and cosine;
//! - `quaternion / estimate` to `quaternion / bare loop`: the cost of launches by an integrator, with and without
//!   sampling.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dynamics::{CoinToss, Formulation, Solver, Stepping, Toss};
use exact::CoinMotion;
use kinematics_quat::QuaternionSolver;
use sampling::{Found, Plan, Sampler, Space, named_space, random_tosses};

fn heads(space: &Space, plan: Plan, sampler: &Sampler<'_>) -> u64 {
    match sampler.estimate(space, plan).expect("valid launches").found {
        Found::Counts(counts) => counts.heads(),
        Found::Shares { .. } => 0,
    }
}

fn fig4(criterion: &mut Criterion) {
    let space = named_space("paper-fig4").expect("it exists");
    // Phases of launches from the same space, because the cost of a sine depends on their range.
    let phase = |toss: &CoinToss| CoinMotion::new(toss).phases(toss.launch.flight_time()).expect("small").0.hi();
    let phases: Vec<f64> =
        random_tosses(&space, 1, 0..250_000).iter().filter_map(Toss::coin).map(|toss| phase(&toss)).collect();
    let mut group = criterion.benchmark_group("fig4 grid");
    group.sample_size(20);
    group.bench_function("exact", |bencher| bencher.iter(|| heads(black_box(&space), Plan::Grid, &Sampler::exact())));
    group.bench_function("sine and cosine", |bencher| {
        bencher.iter(|| phases.iter().map(|phase| black_box(*phase).sin_cos()).fold(0.0, |sum, (s, c)| sum + s + c));
    });
    group.finish();
}

fn quaternion(criterion: &mut Criterion) {
    let space = named_space("paper-fig4").and_then(|space| space.with_grid_of(400)).expect("it exists");
    let solver = QuaternionSolver::new(Stepping::DEFAULT, Formulation::default());
    let plan = Plan::Random { points: 400, seed: 1 };
    let tosses = random_tosses(&space, 1, 0..400);
    let mut group = criterion.benchmark_group("quaternion");
    group.sample_size(50);
    group.bench_function("estimate", |bencher| bencher.iter(|| heads(black_box(&space), plan, &Sampler::by(&solver))));
    group.bench_function("bare loop", |bencher| {
        bencher.iter(|| tosses.iter().filter(|toss| solver.tilt(black_box(toss)).is_ok()).count());
    });
    group.finish();
}

/// Runs on one thread, so that times are proportional to the work.
fn on_one_thread(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    pool.expect("nothing has started a pool yet");
    fig4(criterion);
    quaternion(criterion);
}

criterion_group!(benches, on_one_thread);
criterion_main!(benches);
