//! Measures what a toss costs in a batch of a million, on one thread, for the benchmark of the Python package. Its
//! argument is a file of launches, which a script of Python writes: rates about x, y and z in rad/s and speeds in m/s,
//! column by column, in f64 of this machine. Without a file it makes launches of its own.

use std::hint::black_box;
use std::time::{Duration, Instant};

use toss::{Attitude, Batch, Coin, Outcome, Tosses};

const REPEATS: u32 = 15;

/// A million launches with rates of up to 40 rad/s on each axis and speeds of up to 5 m/s, from Weyl's sequence.
fn made() -> Vec<f64> {
    let column = |irrational: f64, low: f64, high: f64| {
        (0..1_000_000).map(move |index| low + (high - low) * (f64::from(index) * irrational).fract())
    };
    let rates = [2f64.sqrt(), 3f64.sqrt(), 5f64.sqrt()].map(|root| column(root, -40.0, 40.0));
    rates.into_iter().flatten().chain(column(7f64.sqrt(), 0.0, 5.0)).collect()
}

fn read(path: &str) -> Vec<f64> {
    let bytes = std::fs::read(path).expect("a file of launches");
    bytes.chunks_exact(8).map(|number| f64::from_ne_bytes(number.try_into().expect("8 bytes"))).collect()
}

/// Prints the shortest time of `work` in ns a toss.
fn measure(name: &str, tosses: usize, mut work: impl FnMut()) {
    let mut shortest = Duration::MAX;
    for _ in 0..REPEATS {
        let start = Instant::now();
        work();
        shortest = shortest.min(start.elapsed());
    }
    println!("{name} {:.4}", shortest.as_secs_f64() * 1e9 / tosses as f64);
}

fn main() {
    // Cargo passes options of its own, such as `--bench`.
    let file = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let numbers = file.map_or_else(made, |path| read(&path));
    let length = numbers.len() / 4;
    let [x, y, z, speeds] = std::array::from_fn(|column| &numbers[column * length..(column + 1) * length]);
    let tosses = || Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [x, y, z], speeds).expect("valid columns");
    let (mut heights, mut outcomes) = (vec![0.0; length], vec![Outcome::Undecided; length]);
    measure("cos_tilt", length, || Batch::new(tosses()).cos_tilts(black_box(&mut heights)).expect("valid launches"));
    measure("outcome", length, || Batch::new(tosses()).outcomes(black_box(&mut outcomes)).expect("valid launches"));
    measure("count", length, || {
        black_box(Batch::new(tosses()).count().expect("valid launches"));
    });
}
