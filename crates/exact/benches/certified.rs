//! This benchmark measures what a proof costs. It compares proven outcomes of random launches with outcomes by the sign
//! of the same f64 alone: the ratio of these two is the price of the proof. Three more lines give the time of cos θ
//! and of the whole state to the last bits, and of the margins by all inputs.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dynamics::{Coin, Launch, Outcome, Solver, TimeOfFlight, Toss};
use exact::{ExactMotion, ExactSolver, STAGES, TiltTerms, certify, margin};

/// Launches with rates of 1 to 60 rad/s about each axis and speeds of 3 to 5 m/s, from Weyl's sequence.
fn tosses() -> Vec<Toss> {
    let part = |index: u32, irrational: f64| (f64::from(index) * irrational).fract();
    let toss = |index| {
        let rate = [2f64.sqrt(), 3f64.sqrt(), 5f64.sqrt()].map(|root| 1.0 + 59.0 * part(index, root));
        let thrown = TimeOfFlight::Ballistic { speed: 3.0 + 2.0 * part(index, 7f64.sqrt()), gravity: 9.81 };
        Toss::new(Coin::PAPER, Launch::new(rate, thrown).expect("a valid launch"))
    };
    (0..10_000).map(toss).collect()
}

/// The outcome by the sign of the f64 terms, without an error bound.
fn plain(toss: &Toss) -> Outcome {
    let terms = TiltTerms::new(&toss.coin().expect("a coin"));
    let [phase, _] = terms.phases(toss.launch.flight_time());
    Outcome::of(terms.height(phase), 0.0)
}

fn outcomes(criterion: &mut Criterion) {
    let tosses = tosses();
    let heads = |outcome: fn(&Toss) -> Outcome| tosses.iter().filter(|toss| outcome(toss) == Outcome::Heads).count();
    assert_eq!(heads(plain), heads(|toss| certify(toss).expect("small phases").outcome()));
    let by = |stage| tosses.iter().filter(|toss| certify(toss).is_ok_and(|found| found.stage() == stage)).count();
    println!("decided by stage: {:?}", STAGES.map(by));
    let mut group = criterion.benchmark_group("10 000 tosses");
    group.bench_function("certified outcome", |bencher| {
        bencher.iter(|| heads(|toss| certify(black_box(toss)).expect("small phases").outcome()));
    });
    group.bench_function("plain f64 outcome", |bencher| bencher.iter(|| heads(|toss| plain(black_box(toss)))));
    group.bench_function("cos θ to the last bit", |bencher| {
        bencher.iter(|| {
            tosses
                .iter()
                .filter_map(|toss| ExactSolver.tilt(black_box(toss)).ok())
                .map(|tilt| tilt.cos_tilt)
                .sum::<f64>()
        });
    });
    group.bench_function("state to the last bits", |bencher| {
        let state = |toss: &Toss| ExactMotion::new(toss).state(toss.launch.time_of_flight()).ok();
        bencher.iter(|| tosses.iter().filter_map(|toss| state(black_box(toss))).map(|state| state.rate.x).sum::<f64>());
    });
    group.bench_function("margins by all inputs", |bencher| {
        let tilts = || tosses.iter().filter_map(|toss| margin(black_box(toss)).ok()?.tilt);
        bencher.iter(|| tilts().sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, outcomes);
criterion_main!(benches);
