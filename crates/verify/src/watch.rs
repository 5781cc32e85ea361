//! Runs checks one after the other on a thread of their own and watches them, so that a check that panics, cannot measure or never ends
//! becomes a failing row instead of the end of the report.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use crate::judge::Judge;
use crate::judge::time::{Timing, limit_s};
use crate::measure::check::message;
use crate::{Check, Context, Measurement, Row};

/// How often the watch looks at the time of the check that runs.
const LOOK: Duration = Duration::from_millis(100);

/// Stack of the thread of the checks, as that of a main thread.
const STACK: usize = 8 << 20;

/// Ticks in a second of the times in `/proc`, on every architecture of Linux.
const TICKS_PER_S: f64 = 100.0;

/// How a check ended.
#[derive(Debug)]
pub enum End {
    /// With its measurements.
    Measured(Vec<Measurement>),
    /// Without measurements, for a reason that is in words. If it did not end at all, the checks after it were not run.
    Failed(String),
}

impl End {
    /// The rows of `check`, which took the time `timing`: one for each measurement and, if it took too long or failed, a
    /// failing one.
    pub fn rows(self, check: &Check, timing: &Timing, judge: Judge<'_>) -> Vec<Row> {
        let again = Some(judge.command(check, None));
        let of_time = |row: Row| Row { replay: again.clone(), ..row };
        match self {
            Self::Measured(measured) => {
                judge.rows(check, measured).into_iter().chain(timing.row().map(of_time)).collect()
            }
            Self::Failed(why) => vec![of_time(timing.failing(&why))],
        }
    }
}

/// What the thread of the checks sends after each.
type Sent = std::thread::Result<anyhow::Result<Vec<Measurement>>>;

/// Runs `checks` with all time limits multiplied by `factor`. `start` is called before each, `end` after it; it may end the
/// run.
///
/// A check that is hopeless is left behind: its thread goes on until the program ends, and no check comes after it.
pub fn run(
    checks: &[&'static Check],
    context: &Arc<Context>,
    factor: f64,
    mut start: impl FnMut(&Check),
    mut end: impl FnMut(&Check, Timing, End) -> anyhow::Result<ControlFlow<()>>,
) -> anyhow::Result<()> {
    let ((sender, receiver), (begin, begins)) = (channel(), channel());
    let (mine, of_thread) = (Arc::clone(context), checks.to_vec());
    std::thread::Builder::new().stack_size(STACK).spawn(move || measure(&of_thread, &mine, &begins, &sender))?;
    for (index, check) in checks.iter().enumerate() {
        start(check);
        let clock = Clock::start(check, context, factor);
        // An error means that the thread has ended, and then no result comes, either.
        let _ = begin.send(());
        let result = loop {
            match receiver.recv_timeout(LOOK) {
                Ok(result) => break Some(result),
                Err(RecvTimeoutError::Timeout) if !clock.timing().is_hopeless() => {}
                Err(_) => break None,
            }
        };
        let timing = clock.timing();
        let is_hopeless = result.is_none();
        let found = match result {
            Some(Ok(Ok(measured))) => End::Measured(measured),
            Some(Ok(Err(error))) => End::Failed(format!("could not measure: {error}")),
            Some(Err(panic)) => End::Failed(format!("panicked: {}", message(&*panic))),
            None => {
                let (left, taken) = (checks.len() - index - 1, timing.t_wall_s);
                End::Failed(format!("did not end within {taken:.0} s; the {left} checks after it were not run"))
            }
        };
        if end(check, timing, found)?.is_break() || is_hopeless {
            break;
        }
    }
    Ok(())
}

/// Measures `checks`, each when it is told to begin, until nobody receives the results.
fn measure(checks: &[&'static Check], context: &Context, begins: &Receiver<()>, sender: &Sender<Sent>) {
    for (check, ()) in checks.iter().zip(begins) {
        let result = catch_unwind(AssertUnwindSafe(|| check.measure(context)));
        if sender.send(result).is_err() {
            return;
        }
    }
}

/// Measures the time of a check from its start.
struct Clock {
    check: &'static str,
    started: Instant,
    processor_s: Option<f64>,
    limit_s: f64,
}

impl Clock {
    fn start(check: &Check, context: &Context, factor: f64) -> Self {
        let limit_s = limit_s(check.id, context.effort, factor);
        Self { check: check.id, started: Instant::now(), processor_s: processor_s(), limit_s }
    }

    fn timing(&self) -> Timing {
        let since = |start: f64| Some(processor_s()? - start);
        Timing {
            check: self.check.to_owned(),
            t_wall_s: self.started.elapsed().as_secs_f64(),
            t_processor_s: self.processor_s.and_then(since),
            limit_s: self.limit_s,
        }
    }
}

/// The time that the processor has spent on this program so far (s), by all threads; `None` where there is no `/proc`.
fn processor_s() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program comes second, in parentheses, and may itself contain spaces and parentheses. The times of
    // the program and of the system for it are the 14th and 15th field of proc(5), the 12th and 13th after the name.
    let mut fields = text.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS_PER_S)
}
