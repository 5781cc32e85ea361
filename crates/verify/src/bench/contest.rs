//! A contest times contestants: ways to solve many tosses. They are timed in turn, many times over, so that a change of
//! the machine's speed does not favour one of them.

use std::time::Duration;

use super::reference::Reference;
use crate::clock;

/// A way to solve tosses, to be timed.
pub(super) struct Contest<'a> {
    pub(super) group: &'static str,
    pub(super) name: String,
    /// Its largest error, if it was measured.
    pub(super) error: Option<f64>,
    /// Number of tosses that a run solves.
    pub(super) tosses: usize,
    pub(super) run: Box<dyn FnMut() + 'a>,
}

/// The shortest times of a toss (ns): of the reference and of each contestant.
pub(super) struct Times {
    pub(super) reference: f64,
    pub(super) contests: Vec<f64>,
}

/// Times all contestants in turn, many times over. Without a process of the reference the first contestant takes its
/// place.
pub(super) fn race(contests: &mut [Contest<'_>], mut reference: Option<&mut Reference>) -> anyhow::Result<Times> {
    const ROUNDS: usize = 40;
    let mut times = Times { reference: f64::INFINITY, contests: vec![f64::INFINITY; contests.len()] };
    for _ in 0..ROUNDS {
        for (contest, shortest) in contests.iter_mut().zip(&mut times.contests) {
            *shortest = shortest.min(contest.nanoseconds());
            // The processor's clock rate may change during a race, so the reference is timed beside each contestant.
            if let Some(reference) = &mut reference {
                times.reference = times.reference.min(reference.nanoseconds()?);
            }
        }
    }
    if reference.is_none() {
        times.reference = times.contests[0];
    }
    Ok(times)
}

impl Contest<'_> {
    /// The shortest time of a toss (ns) over the runs that fit into a short time.
    fn nanoseconds(&mut self) -> f64 {
        const BUDGET: Duration = Duration::from_micros(500);
        let times = clock::times(&mut self.run, |_, spent| spent < BUDGET);
        clock::nanoseconds(times[0]) / self.tosses as f64
    }
}
