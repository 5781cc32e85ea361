//! Times of the motion of a rigid body: a launch with its first time, a further time, and the proof of an outcome.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dynamics::{Body, Launch, TimeOfFlight, Toss, Vector3};
use exact::{ExactMotion, certify};

fn toss(rate: [f64; 3]) -> Toss {
    let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(0.6)).expect("a valid launch");
    Toss { body: Body::from_moments([1.0, 2.0, 2.25]).expect("a valid body"), launch }
}

/// How to make the motion of a toss.
type Motion = fn(&Toss) -> ExactMotion;

fn rigid(criterion: &mut Criterion) {
    for (name, rate) in [("series", [0.2, 0.5, 2.0]), ("gaussians", [7.5001, 10.0, 10.0])] {
        let toss = toss(rate);
        let motions: [(&str, Motion); 2] =
            [("double-double", ExactMotion::new), ("compensated", ExactMotion::compensated)];
        for (kind, of) in motions {
            let (name, motion) = (format!("{name}, {kind}"), of(&toss));
            criterion.bench_function(&format!("{name}: launch"), |bencher| bencher.iter(|| of(black_box(&toss))));
            criterion
                .bench_function(&format!("{name}: cos θ"), |bencher| bencher.iter(|| motion.cos_tilt(black_box(0.6))));
            criterion
                .bench_function(&format!("{name}: state"), |bencher| bencher.iter(|| motion.state(black_box(0.6))));
        }
        criterion.bench_function(&format!("{name}: proof"), |bencher| bencher.iter(|| certify(black_box(&toss))));
    }
}

criterion_group!(benches, rigid);
criterion_main!(benches);
