//! Measures how long work takes. Times are the only numbers of a run that differ from one run to the next.

use std::time::{Duration, Instant};

/// How long `work` takes, time after time: `goes_on` says whether to do it again, given how often it was done and the
/// time since the beginning. The times are sorted, the shortest first. `work` is done once at least.
pub fn times(mut work: impl FnMut(), goes_on: impl Fn(usize, Duration) -> bool) -> Vec<Duration> {
    let start = Instant::now();
    let mut times = Vec::new();
    while times.is_empty() || goes_on(times.len(), start.elapsed()) {
        let begin = Instant::now();
        work();
        times.push(begin.elapsed());
    }
    times.sort_unstable();
    times
}

/// What `work` returns, and how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let begin = Instant::now();
    (work(), begin.elapsed())
}

/// A time in nanoseconds.
pub fn nanoseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e9
}
