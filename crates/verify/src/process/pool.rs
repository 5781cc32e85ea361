//! The processes of one program, as many as threads ask at once, and the judgement when the program is given up: a run
//! of the suite has thousands of launches, and has to end although each of them could cost a time-out.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::Serialize;

use super::Limits;
use super::child::{Answered, Fault, Process, STARTS};
use super::protocol::{Reply, numbered};
use crate::clock;
use crate::measure::diagnosis::GIVEN_UP;

/// A program that hangs or dies on some launches is asked on, until it has lost so many times the limit of an answer.
const LOSSES: u32 = 6;

/// An impatient pool waits for an answer this part of its limit, but not less than [`LEAST`].
const IMPATIENT: u32 = 20;

const LEAST: Duration = Duration::from_millis(100);

#[derive(Debug)]
pub(super) struct Pool {
    command: String,
    limits: Limits,
    /// Whether answers may take as long as their limit, and a program is given up that often hangs.
    is_patient: bool,
    state: Mutex<State>,
}

/// What became of the questions to a program.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// How many processes were started.
    pub starts: u64,
    /// The launches that it was asked for.
    pub questions: u64,
    /// Those without an answer.
    pub without_answer: u64,
}

/// A question as a process got it, and what it wrote.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    pub(super) question: String,
    /// `None` if it wrote none.
    pub(super) line: Option<String>,
    pub(super) reply: Reply,
    /// Whether it took too long.
    pub(super) is_late: bool,
}

#[derive(Debug, Default)]
struct State {
    idle: Vec<Process>,
    /// Whether its answers have the field `error`; `None` before the first answer.
    gives_errors: Option<bool>,
    /// Whether an answer said that it takes bodies.
    takes_bodies: bool,
    /// How long the first process took for its first answer.
    start: Option<Duration>,
    /// Time spent on answers, and on what was none.
    answering: Duration,
    lost: Duration,
    given_up: Option<String>,
    tally: Tally,
}

impl Pool {
    pub(super) fn new(command: &str, limits: Limits) -> Self {
        Self { command: command.to_owned(), limits, is_patient: true, state: Mutex::default() }
    }

    /// Other processes of the same program, to find out on which questions it hangs.
    pub(super) fn impatient(&self) -> Self {
        Self { is_patient: false, ..Self::new(&self.command, self.limits) }
    }

    /// What the program answers to a question. One that takes too long is asked once more of another process, because
    /// the machine may have been busy; unless there never was an answer.
    pub(super) fn ask(&self, question: &str) -> Exchange {
        let mut exchange = self.once(question);
        if exchange.is_late && self.gives_errors().is_some() {
            let again = self.once(question);
            exchange = if again.reply.is_ok() { again } else { exchange };
        }
        let mut state = self.state();
        state.tally.questions += 1;
        state.tally.without_answer += u64::from(exchange.reply.is_err());
        exchange
    }

    /// What became of the questions so far.
    pub(super) fn tally(&self) -> Tally {
        self.state().tally
    }

    /// Whether its answers have the field `error`; `None` before the first answer.
    pub(super) fn gives_errors(&self) -> Option<bool> {
        self.state().gives_errors
    }

    /// Whether an answer said that it takes bodies.
    pub(super) fn takes_bodies(&self) -> bool {
        self.state().takes_bodies
    }

    /// What one process answers.
    fn once(&self, question: &str) -> Exchange {
        let (idle, start) = {
            let mut state = self.state();
            if let Some(why) = &state.given_up {
                let reply = Err(why.clone());
                return Exchange { question: numbered(1, question), line: None, reply, is_late: false };
            }
            let idle = state.idle.pop();
            state.tally.starts += u64::from(idle.is_none());
            (idle, state.start)
        };
        // A process that replaces one that hung would else be given the time to load its libraries for each launch on
        // which it hangs.
        let (longest, mut limits) = (STARTS * self.limits.answer, self.limits);
        if !self.is_patient {
            limits.answer = limits.answer.min(LEAST.max(limits.answer / IMPATIENT));
        }
        let start = start.map_or(longest, |took| longest.min(limits.answer + 3 * took));
        let question = numbered(idle.as_ref().map_or(1, Process::next), question);
        let (asked, took): (Result<_, Fault>, _) = clock::timed(|| {
            let mut process = idle.map_or_else(|| Process::start(&self.command), Ok)?;
            let (_, columns) = question.split_once(',').unwrap_or_default();
            let answer = process.ask(columns, start, &limits)?;
            Ok((process, answer))
        });
        let mut state = self.state();
        match asked {
            Ok((process, Answered { reply, line })) => {
                let reply = state.take(process, reply, took, &self.limits);
                Exchange { question, line: Some(line), reply, is_late: false }
            }
            Err(Fault { words, line, is_late }) => {
                let words = match is_late && !self.is_patient {
                    true => format!("it answers nothing within {} s", limits.answer.as_secs_f64()),
                    false => words,
                };
                state.lost += took;
                let is_hopeless = self.is_patient && state.lost > LOSSES * self.limits.answer;
                if is_hopeless || state.answering == Duration::ZERO {
                    state.give_up(&words);
                }
                Exchange { question, line, reply: Err(words), is_late }
            }
        }
    }

    /// Whether it is asked no more.
    pub(super) fn is_given_up(&self) -> bool {
        self.state().given_up.is_some()
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
            self.takes_bodies |= landing.takes_bodies;
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

    fn give_up(&mut self, why: &str) {
        self.idle.clear();
        self.given_up.get_or_insert_with(|| format!("{GIVEN_UP}{why}"));
    }
}
