//! Measures what it costs to plan a scene, and what `Scene::solve` adds to a direct call of the solver. A planner is of
//! use only if it costs less than it saves; the ratio of the last two results is what it adds to an outcome.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use toss::{Coin, ExactSolver, Launch, Outcome, Scene, Solver, TimeOfFlight, Toss, Want};

/// 1000 tosses with rates of up to 60 rad/s on each axis and speeds of 3 to 5 m/s, from Weyl's sequence.
fn tosses() -> Vec<Toss> {
    let part = |index: u32, irrational: f64| (f64::from(index) * irrational).fract();
    let toss = |index| {
        let rate = [2f64.sqrt(), 3f64.sqrt(), 5f64.sqrt()].map(|root| 120.0 * part(index, root) - 60.0);
        let thrown = TimeOfFlight::thrown(3.0 + 2.0 * part(index, 7f64.sqrt()), 9.81, None);
        Toss::new(Coin::PAPER, Launch::new(rate, thrown).expect("a valid launch"))
    };
    (0..1000).map(toss).collect()
}

/// Makes a scene from a toss.
type Make = fn(Toss) -> Scene;

fn plans(criterion: &mut Criterion) {
    let tosses = tosses();
    let mut group = criterion.benchmark_group("plans of 1000 scenes");
    let kinds: [(&str, Make); 5] = [
        ("outcome", |toss| Scene::new(Want::Outcome(toss), 1e-9)),
        ("tilt", |toss| Scene::new(Want::Tilt(toss), 1e-9)),
        ("attitude", |toss| Scene::new(Want::Attitude(toss), 1e-9)),
        ("trace", |toss| Scene::new(Want::Trace { toss, points: 100 }, 1e-9)),
        ("attitude by an integrator", |toss| Scene::new(Want::Attitude(toss), 1e-9).by("quaternion", None)),
    ];
    for (kind, scene) in kinds {
        let scenes: Vec<Scene> = tosses.iter().copied().map(scene).collect();
        let cost = |scene: &Scene| scene.plan().expect("a plan").choice.expected_cost_ns;
        group.bench_function(kind, |bencher| {
            bencher.iter(|| scenes.iter().map(|scene| cost(black_box(scene))).sum::<f64>());
        });
    }
    let space = sampling::named_space("paper-fig4").expect("a named space");
    let scene = Scene::new(Want::Probability(space), 1e-3);
    group.bench_function("probability, one scene", |bencher| bencher.iter(|| black_box(&scene).plan()));
    group.finish();
}

fn outcomes(criterion: &mut Criterion) {
    let tosses = tosses();
    let scenes: Vec<Scene> = tosses.iter().map(|toss| Scene::new(Want::Outcome(*toss), 1e-9)).collect();
    let mut group = criterion.benchmark_group("outcomes of 1000 tosses");
    group.bench_function("Scene::solve", |bencher| {
        let heads = |scene: &Scene| {
            let answer = black_box(scene).solve().expect("small phases");
            matches!(answer, toss::Answer::Outcome(verdict) if verdict.outcome() == Outcome::Heads)
        };
        bencher.iter(|| scenes.iter().filter(|scene| heads(scene)).count());
    });
    group.bench_function("ExactSolver::tilt", |bencher| {
        let outcome = |toss: &Toss| ExactSolver.tilt(black_box(toss)).expect("small phases").outcome();
        let heads = |toss: &Toss| outcome(toss) == Outcome::Heads;
        bencher.iter(|| tosses.iter().filter(|toss| heads(toss)).count());
    });
    group.finish();
}

criterion_group!(benches, plans, outcomes);
criterion_main!(benches);
