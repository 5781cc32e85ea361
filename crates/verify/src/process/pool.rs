//! The processes of one program, as many as threads ask at once, and the judgement when the program is given up: a run
//! of the suite has thousands of launches, and has to end although each of them could cost a time-out.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::Limits;
use super::child::Process;
use super::protocol::Reply;
use crate::clock;

/// A program that hangs or dies on some launches is asked on, until it has lost so many times the limit of an answer.
const LOSSES: u32 = 6;

/// The processes of a program.
pub(super) struct Pool {
    command: String,
    limits: Limits,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// The processes that wait for a question.
    idle: Vec<Process>,
    /// Whether its answers have the field `error`; `None` before the first answer.
    gives_errors: Option<bool>,
    /// How long the first process took for its first answer.
    start: Option<Duration>,
    /// Time spent on answers, and on what was none.
    answering: Duration,
    lost: Duration,
    given_up: Option<String>,
}

impl Pool {
    pub(super) fn new(command: &str, limits: Limits) -> Self {
        Self { command: command.to_owned(), limits, state: Mutex::default() }
    }

    /// What the program answers to a question.
    pub(super) fn ask(&self, question: &str) -> Reply {
        let (idle, start) = {
            let mut state = self.state();
            if let Some(why) = &state.given_up {
                return Err(why.clone());
            }
            (state.idle.pop(), state.start)
        };
        // A process that replaces one that hung would else be given the time to load its libraries for each launch on
        // which it hangs.
        let longest = LOSSES * self.limits.answer;
        let start = start.map_or(longest, |took| longest.min(self.limits.answer + 3 * took));
        let (asked, took): (Result<_, String>, _) = clock::timed(|| {
            let mut process = idle.map_or_else(|| Process::start(&self.command), Ok)?;
            let answer = process.ask(question, start, &self.limits)?;
            Ok((process, answer))
        });
        let mut state = self.state();
        match asked {
            Ok((process, answer)) => state.take(process, answer, took, &self.limits),
            Err(fault) => Err(state.note(fault, took, &self.limits)),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// Keeps a process for the next question, and returns its answer.
    fn take(&mut self, process: Process, answer: Reply, took: Duration, limits: &Limits) -> Reply {
        if let Ok(landing) = &answer {
            let gives_error = landing.error.is_some();
            if *self.gives_errors.get_or_insert(gives_error) != gives_error {
                return Err("gives an error with some of its answers and none with others".to_owned());
            }
        }
        self.start.get_or_insert(took);
        self.answering += took;
        if self.answering > limits.total {
            self.give_up(&format!("took more than {} s for all its answers", limits.total.as_secs_f64()));
        } else {
            self.idle.push(process);
        }
        answer
    }

    /// Notes that a process did not answer, and returns what it did.
    fn note(&mut self, fault: String, took: Duration, limits: &Limits) -> String {
        self.lost += took;
        if self.answering == Duration::ZERO || self.lost > LOSSES * limits.answer {
            self.give_up(&fault);
        }
        fault
    }

    fn give_up(&mut self, why: &str) {
        self.idle.clear();
        self.given_up.get_or_insert_with(|| format!("is no longer asked: it {why}"));
    }
}
