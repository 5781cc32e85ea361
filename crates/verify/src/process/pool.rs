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

#[derive(Debug)]
pub(super) struct Pool {
    command: String,
    limits: Limits,
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
}

/// A question that took too long, and whether there was an answer to another one before.
struct Late {
    exchange: Box<Exchange>,
    has_answered: bool,
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
        Self { command: command.to_owned(), limits, state: Mutex::default() }
    }

    /// What the program answers to a question. One that takes too long is asked once more of another process, because
    /// the machine may have been busy; unless there never was an answer.
    pub(super) fn ask(&self, question: &str) -> Exchange {
        let exchange = match self.once(question) {
            Ok(exchange) => exchange,
            Err(Late { exchange, has_answered: false }) => *exchange,
            Err(late) => self.once(question).unwrap_or(*late.exchange),
        };
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

    /// What one process answers; an error if it takes too long.
    fn once(&self, question: &str) -> Result<Exchange, Late> {
        let (idle, start) = {
            let mut state = self.state();
            if let Some(why) = &state.given_up {
                let reply = Err(why.clone());
                return Ok(Exchange { question: numbered(1, question), line: None, reply });
            }
            let idle = state.idle.pop();
            state.tally.starts += u64::from(idle.is_none());
            (idle, state.start)
        };
        // A process that replaces one that hung would else be given the time to load its libraries for each launch on
        // which it hangs.
        let longest = STARTS * self.limits.answer;
        let start = start.map_or(longest, |took| longest.min(self.limits.answer + 3 * took));
        let question = numbered(idle.as_ref().map_or(1, Process::next), question);
        let (asked, took): (Result<_, Fault>, _) = clock::timed(|| {
            let mut process = idle.map_or_else(|| Process::start(&self.command), Ok)?;
            let (_, columns) = question.split_once(',').unwrap_or_default();
            let answer = process.ask(columns, start, &self.limits)?;
            Ok((process, answer))
        });
        let mut state = self.state();
        match asked {
            Ok((process, Answered { reply, line })) => {
                let reply = state.take(process, reply, took, &self.limits);
                Ok(Exchange { question, line: Some(line), reply })
            }
            Err(Fault { words, line, is_late }) => {
                let has_answered = state.answering > Duration::ZERO;
                let exchange = Exchange { question, line, reply: Err(state.note(words, took, &self.limits)) };
                if is_late { Err(Late { exchange: Box::new(exchange), has_answered }) } else { Ok(exchange) }
            }
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
        self.given_up.get_or_insert_with(|| format!("{GIVEN_UP}{why}"));
    }
}
