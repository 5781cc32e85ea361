//! This file measures the time of a call in nanoseconds. A single call is shorter than the clock can resolve, so
//! calls are timed in batches.

use std::time::{Duration, Instant};

/// The shortest time of a call of `work` (ns), from batches of calls that last at least 20 µs each. The fastest batch
/// counts, so that a disturbance of some of them does not matter. `work` must return its result, or the compiler might
/// leave the work out.
pub fn nanoseconds<T>(mut work: impl FnMut() -> T) -> f64 {
    const BATCH: Duration = Duration::from_micros(20);
    const BATCHES: usize = 7;
    let mut time = |calls: u32| {
        let begin = Instant::now();
        for _ in 0..calls {
            std::hint::black_box(work());
        }
        begin.elapsed()
    };
    let mut calls = 1;
    let mut first = time(calls);
    while first < BATCH {
        calls *= 2;
        first = time(calls);
    }
    // A call that takes long is timed only once more.
    let batches = if first > 50 * BATCH { 1 } else { BATCHES };
    let fastest = (0..batches).map(|_| time(calls)).fold(first, Duration::min);
    fastest.as_secs_f64() * 1e9 / f64::from(calls)
}

/// The median of `values`; NaN if there are none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
