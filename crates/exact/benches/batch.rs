//! This benchmark measures what a toss costs in a batch, at every SIMD level of the machine. It shows what wider
//! registers gain.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dynamics::{Attitude, Coin, Outcome, Tosses};
use exact::Batch;
use numerics::lanes::SimdLevel;

const TOSSES: usize = 4096;

fn column(from: f64, length: f64, square: f64) -> Vec<f64> {
    (0..TOSSES).map(|index| from + length * (index as f64 * square.sqrt()).fract()).collect()
}

fn batches(criterion: &mut Criterion) {
    let ([x, y, z], speeds) = ([2.0, 3.0, 5.0].map(|square| column(1.0, 59.0, square)), column(3.0, 2.0, 7.0));
    let (mut numbers, mut outcomes) = (vec![0.0; TOSSES], vec![Outcome::Undecided; TOSSES]);
    let mut quaternions = [(); 4].map(|()| vec![0.0; TOSSES]);
    for (start, attitude) in [("horizontal", Attitude::IDENTITY), ("tilted", Attitude::about_x(0.7))] {
        let mut group = criterion.benchmark_group(format!("4096 tosses, {start}"));
        group.throughput(Throughput::Elements(TOSSES as u64));
        for level in SimdLevel::all() {
            let tosses = Tosses::new(Coin::PAPER, attitude, 9.81, [&x, &y, &z], &speeds).expect("valid");
            let batch = Batch::new(tosses).on(level);
            let name = |what: &str| format!("{what}, {}", level.name());
            group.bench_function(name("cos θ"), |bencher| bencher.iter(|| batch.cos_tilts(black_box(&mut numbers))));
            group.bench_function(name("outcomes"), |bencher| bencher.iter(|| batch.outcomes(black_box(&mut outcomes))));
            group.bench_function(name("outcomes, counted"), |bencher| bencher.iter(|| batch.count()));
            group.bench_function(name("attitudes"), |bencher| {
                bencher.iter(|| batch.attitudes(black_box(&mut quaternions).each_mut().map(Vec::as_mut_slice)));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, batches);
criterion_main!(benches);
