//! `cargo bench` times the problems of the work-precision record with every solver at its default settings. They are
//! the problems that the charts draw, so that both can be compared.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use toss::{Registry, Settings};
use verify::measure::work_precision::problems;

fn solvers(criterion: &mut Criterion) {
    for problem in problems::all().expect("the problems") {
        let mut group = criterion.benchmark_group(&problem.name);
        group.sample_size(20);
        for entry in Registry::standard().entries() {
            let solver = entry.solver(&Settings::default()).expect("a solver of ours");
            group.bench_function(entry.name(), |bencher| {
                bencher.iter(|| {
                    for toss in &problem.tosses {
                        let _ = black_box(solver.land(black_box(toss)));
                    }
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, solvers);
criterion_main!(benches);
