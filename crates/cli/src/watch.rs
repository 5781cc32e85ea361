//! What watches over a command that may take long: it shows how far the work is, and ends it at Ctrl-C or when its time is up.
//! What is known by then is the answer.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Once, OnceLock};
use std::thread::Builder;
use std::time::{Duration, Instant};

use clap::{ArgMatches, Command};
use dynamics::error::require;
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use sampling::Sampler;
use toss::Error;
use toss::quantity::Dimension;

use crate::failure::Failure;
use crate::quantity;

/// The option for the time that a command may take.
#[derive(Debug, clap::Args)]
pub(crate) struct BudgetArgs {
    /// End after this time with what is known by then, as at Ctrl-C
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Time))]
    seconds: Option<f64>,
}

/// Why a command ended before its work was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ended {
    /// By Ctrl-C.
    Interrupted,
    /// By `--seconds`.
    Seconds,
}

impl Ended {
    /// Its name in JSON.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Interrupted => "interrupted",
            Self::Seconds => "seconds",
        }
    }

    pub(crate) fn in_words(self) -> &'static str {
        match self {
            Self::Interrupted => "interrupted",
            Self::Seconds => "out of time, by --seconds",
        }
    }

    /// The exit code if nothing is known: that of a program that Ctrl-C ended, or that of one without an answer.
    pub(crate) fn exit_code(self) -> u8 {
        match self {
            Self::Interrupted => 130,
            Self::Seconds => 1,
        }
    }
}

/// Whether Ctrl-C was pressed.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether work goes on that ends itself after Ctrl-C.
static AT_WORK: AtomicBool = AtomicBool::new(false);

/// Work that does not end within this time is ended without an answer.
const PATIENCE: Duration = Duration::from_millis(700);

/// The watch over one command.
#[derive(Debug)]
pub(crate) struct Watch {
    deadline: Option<Instant>,
    bar: ProgressBar,
    ended: OnceLock<Ended>,
}

impl Watch {
    /// The watch over the command with these options. One that has `--seconds` may take long, so that Ctrl-C ends its work, and
    /// not the program at once.
    ///
    /// # Errors
    /// For a time that is not above 0.
    pub(crate) fn over(described: Option<(&Command, &ArgMatches)>) -> Result<Self, Failure> {
        static LISTENING: Once = Once::new();
        let is_long = |(command, _): &(&Command, _)| command.get_arguments().any(|option| option.get_id() == "seconds");
        let long = described.filter(is_long);
        let seconds = long.and_then(|(_, given)| given.get_one::<f64>("seconds").copied());
        if let Some(seconds) = seconds {
            require("seconds", seconds, "> 0", seconds > 0.0)?;
        }
        if long.is_some() {
            // What runs in the background and ignores Ctrl-C goes on ignoring it. Where no thread can listen for Ctrl-C, it
            // ends the program.
            LISTENING.call_once(|| _ = starts_threads().then(|| ctrlc::try_set_handler(interrupt)));
            AT_WORK.store(true, Ordering::SeqCst);
        }
        let allowed = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let deadline = allowed.and_then(|allowed| Instant::now().checked_add(allowed));
        Ok(Self { deadline, bar: ProgressBar::hidden(), ended: OnceLock::new() })
    }

    /// Shows on standard error, if that is a terminal, how many of `number` `things` are done, from now on.
    pub(crate) fn show(&self, number: Option<u64>, things: &'static str) {
        if std::io::stderr().is_terminal() {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.bar.set_style(style(number.is_some()));
            self.bar.set_message(things);
            number.into_iter().for_each(|number| self.bar.set_length(number));
            if starts_threads() {
                self.bar.enable_steady_tick(Duration::from_millis(100));
            }
        }
    }

    /// As [`Watch::show`], unless rows are printed on the same terminal.
    pub(crate) fn show_beside_rows(&self, number: Option<u64>, things: &'static str) {
        if !std::io::stdout().is_terminal() {
            self.show(number, things);
        }
    }

    /// Other words for the things that are counted.
    pub(crate) fn say(&self, words: String) {
        self.bar.set_message(words);
    }

    /// Counts `more` things as done.
    pub(crate) fn count(&self, more: u64) {
        self.bar.inc(more);
    }

    /// Whether it is time to end.
    pub(crate) fn is_over(&self) -> bool {
        let interrupted = INTERRUPTED.load(Ordering::Relaxed).then_some(Ended::Interrupted);
        let late = || self.deadline.is_some_and(|deadline| Instant::now() >= deadline).then_some(Ended::Seconds);
        let now = self.ended().or(interrupted).or_else(late);
        now.is_some_and(|now| {
            self.ended.get_or_init(|| now);
            true
        })
    }

    /// Why the work ended early, if it was told to.
    pub(crate) fn ended(&self) -> Option<Ended> {
        self.ended.get().copied()
    }

    /// What `sampler` answers to `question` under this watch.
    pub(crate) fn ask<T>(&self, sampler: Sampler<'_>, question: impl FnOnce(&Sampler<'_>) -> T) -> T {
        let (progress, stop) = (|more| self.count(more), || self.is_over());
        question(&sampler.on_progress(&progress).until(&stop))
    }

    /// The result of a `job` that cannot be told to end, on a thread of its own, which is left alone when it is time to end. Where
    /// no thread can start, it is done here, to its end.
    ///
    /// # Errors
    /// [`Error::Ended`] then.
    pub(crate) fn aside<T: Send + 'static>(&self, job: impl FnOnce() -> T + Send + 'static) -> Result<T, Error> {
        const LOOK: Duration = Duration::from_millis(50);
        if !starts_threads() {
            return Ok(job());
        }
        let (done, result) = channel();
        std::thread::spawn(move || _ = done.send(job()));
        loop {
            match result.recv_timeout(LOOK) {
                Ok(result) => return Ok(result),
                Err(RecvTimeoutError::Timeout) if !self.is_over() => {}
                Err(_) => return Err(Error::Ended),
            }
        }
    }

    /// No work is left but to print the answer.
    pub(crate) fn finish(&self) {
        AT_WORK.store(false, Ordering::SeqCst);
        self.bar.finish_and_clear();
    }
}

/// Whether the system starts a thread beside this one.
fn starts_threads() -> bool {
    Builder::new().spawn(|| ()).is_ok_and(|thread| thread.join().is_ok())
}

/// Ctrl-C asks the work to end, and ends the program if there is none, if it is pressed again, or if the work does not end.
fn interrupt() {
    let is_pressed_again = INTERRUPTED.swap(true, Ordering::SeqCst);
    if AT_WORK.load(Ordering::SeqCst) && !is_pressed_again {
        std::thread::sleep(PATIENCE);
    }
    if is_pressed_again || AT_WORK.load(Ordering::SeqCst) {
        // Standard error may be closed.
        let _ = writeln!(std::io::stderr(), "\nerror: interrupted before there was an answer");
        std::process::exit(Ended::Interrupted.exit_code().into());
    }
}

/// Of a number of things that is known before, the rate and the time left, too.
fn style(is_number_known: bool) -> ProgressStyle {
    let rate = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        // An error of the terminal is ignored: the bar is not part of the answer.
        let _ = write!(out, "{}/s", HumanCount(state.per_sec() as u64));
    };
    let template = if is_number_known {
        "{bar:40} {human_pos}/{human_len} {msg}, {rate}, {eta} left"
    } else {
        "{spinner} {human_pos} {msg}, {elapsed}"
    };
    ProgressStyle::with_template(template).expect("the template is valid").with_key("rate", rate)
}
