//! A solver that is a program of its own, in any language: it reads launches on its standard input and writes attitudes
//! to its standard output. Integrators in Python, C++, Julia or MATLAB so come under the same checks as those in Rust.
//!
//! `protocol` has the lines that are exchanged, `child` one running process with its limits of time and memory, `pool`
//! the processes of one program and when it is given up. `docs/your-solver.md` is the page for its author.

mod child;
mod pool;
mod protocol;

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

use dynamics::error::{Reason, require};
use dynamics::{Fault, Flight, ForeignError, Phases};
use toss::{Attitude, InputError, Landing, Scheme, SolveError, Solver, SolverEntry, StepControl, Stepping, Toss, Work};

use crate::measure::diagnosis::{Asked, NORMS, cos_tilt_as_answered};
use crate::measure::exact_landings::ExactLandings;
use crate::measure::run::Allowance;
use crate::shown::shown;
use pool::{Exchange, Pool};
use protocol::Landed;

pub use pool::Tally;
pub use protocol::HEADER;
pub(crate) use protocol::Question;

/// The scheme of a program that takes a tolerance.
pub const OWN: Scheme = Scheme::new("own", None).adaptive();

/// A program that computes where a toss lands.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// The command line of the shell that starts it.
    pub command: String,
    /// What its entry says of it, in one line.
    pub summary: String,
    /// By what it is judged, in place of the tolerance; it is asked for no other tolerance than the number of the claim.
    pub claim: Option<Claim>,
    /// Whether it is asked for bodies with three moments, too. Else it is if one of its answers has the field `bodies=yes`.
    pub takes_bodies: bool,
    /// How long it may take and how much memory it may use.
    pub limits: Limits,
}

/// An error of cos θ that a program claims for all tosses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    error: f64,
    is_per_radian: bool,
}

impl Claim {
    /// The same error at any toss.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not above 0 and below 1.
    pub fn flat(error: f64) -> Result<Self, InputError> {
        let error = require("claim", error, "0 < claim < 1", error > 0.0 && error < 1.0)?;
        Ok(Self { error, is_per_radian: false })
    }

    /// The error that is claimed for `toss`; at most 2, as any answer at all is within.
    fn of(&self, toss: &Toss) -> Result<f64, SolveError> {
        let Phases { largest, growth } = Phases::new(toss)?;
        Ok(if self.is_per_radian { (self.error * (1.0 + largest) * growth).min(2.0) } else { self.error })
    }
}

/// As the option `--claim` takes it.
impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:e}{}", self.error, if self.is_per_radian { "/rad" } else { "" })
    }
}

/// Reads `1e-9`, the same error at any toss, and `1e-12/rad`, one for each radian.
impl FromStr for Claim {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.strip_suffix("/rad").unwrap_or(text);
        let error = number.parse().ok().and_then(|error| Self::flat(error).ok());
        let claim =
            error.ok_or("expected an error above 0 and below 1, as in 1e-9, or one a radian, as in 1e-12/rad")?;
        Ok(Self { is_per_radian: number != text, ..claim })
    }
}

/// How long a program may take and how much memory it may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// For an answer. The first answer of a process, which may have to load its libraries, has six times as long; one
    /// that replaces a process may take three times as long as that took to start.
    pub answer: Duration,
    /// For all answers, added up over the processes that run at once.
    pub total: Duration,
    /// Resident memory of a process with its children, in bytes. It is looked at on Linux only: after the first answer,
    /// and ten times a second.
    pub memory: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { answer: Duration::from_secs(10), total: Duration::from_secs(1800), memory: 2 << 30 }
    }
}

impl Program {
    /// The program that the shell starts by `command`. It integrates with the tolerance that it is asked for, and is
    /// judged by the error that this tolerance [permits](Stepping::error_estimate), or by an error that it gives with
    /// its answers.
    pub fn new(command: impl Into<String>) -> Self {
        let command = command.into();
        let summary = format!("the program `{}`", shown(&command));
        Self { command, summary, claim: None, takes_bodies: false, limits: Limits::default() }
    }

    /// The program as an entry called `name`. Its processes are started when they are asked first, one for each thread
    /// that asks, and are ended with the entry and all its solvers.
    pub fn entry(&self, name: &'static str) -> SolverEntry {
        self.running(name).entry()
    }

    /// The program as a solver called `name`, which can also be asked what it was told and what it answered.
    pub(crate) fn running(&self, name: &'static str) -> Running {
        Running { name, program: self.clone(), pool: Arc::new(Pool::new(&self.command, self.limits)) }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Running {
    name: &'static str,
    program: Program,
    pool: Arc<Pool>,
}

impl Running {
    pub(crate) fn entry(&self) -> SolverEntry {
        let (running, is_claimed) = (self.clone(), self.program.claim.is_some());
        let entry = SolverEntry::new(self.name, self.program.summary.clone(), move |settings| {
            Box::new(ByProgram { running: running.clone(), stepping: settings.stepping })
        });
        if is_claimed { entry } else { entry.with_schemes(&[OWN]) }
    }

    /// The same program in other processes, which are soon ended where it hangs, so that many questions show on which it does.
    pub(crate) fn impatient(&self) -> Self {
        Self { pool: Arc::new(self.pool.impatient()), ..self.clone() }
    }

    pub(crate) fn is_given_up(&self) -> bool {
        self.pool.is_given_up()
    }

    /// What became of the questions so far.
    pub(crate) fn tally(&self) -> Tally {
        self.pool.tally()
    }

    /// What the program answers to `toss` at a tolerance, with its question as it got it, and what it is allowed.
    pub(crate) fn asked(&self, toss: &Toss, tolerance: f64, known: &ExactLandings) -> Option<Asked> {
        let stepping = Stepping::adaptive(OWN, tolerance).ok()?;
        let solver = ByProgram { running: self.clone(), stepping };
        if toss.coin().is_none() && !solver.takes_bodies() {
            return None;
        }
        let exact = known.of(toss)?;
        let (question, exchange) = solver.exchange(toss).ok()?;
        let answered = exchange.reply.as_ref().ok();
        let allowed = match answered {
            Some(landed) => Allowance::by_estimate(solver.error(toss, &question, landed).ok()??),
            None => Allowance::by_estimate(0.0),
        };
        let answer = exchange.reply.and_then(|landed| match landed.quaternion {
            finite if finite.iter().all(|part| part.is_finite()) => Ok(question.in_body(finite)),
            _ => Err("answered a quaternion that is not finite".to_owned()),
        });
        let as_got = format!("{HEADER}\n{}", exchange.question);
        Some(Asked::new(toss, as_got, &question, exchange.line, answer, allowed, exact).late(exchange.is_late))
    }
}

struct ByProgram {
    running: Running,
    stepping: Stepping,
}

impl ByProgram {
    fn exchange(&self, toss: &Toss) -> Result<(Question, Exchange), SolveError> {
        let tolerance = match (self.running.program.claim, self.stepping.control()) {
            (Some(claim), _) => claim.error,
            (None, StepControl::Tolerance(tolerance)) => Flight::new(toss)?.tightened(tolerance),
            (None, StepControl::Step(_)) => {
                return Err(SolveError::NotOffered { scheme: self.stepping.scheme().name() });
            }
        };
        let question = Question::new(toss, tolerance);
        let exchange = self.running.pool.ask(&question.line());
        Ok((question, exchange))
    }

    /// The error of cos θ that is claimed, or else the one that the tolerance permits.
    fn error(&self, toss: &Toss, question: &Question, landed: &Landed) -> Result<Option<f64>, SolveError> {
        let claimed = self.running.program.claim.map(|claim| claim.of(toss)).transpose()?;
        let Some(error) = claimed.or(landed.error) else { return self.stepping.error_estimate(toss) };
        if !question.is_rounded() {
            return Ok(Some(error));
        }
        // The program can't know how far its question was from the body that was meant.
        let Phases { largest, growth } = Phases::new(toss)?;
        Ok(Some((error + 8.0 * f64::EPSILON * (1.0 + largest) * growth).min(2.0)))
    }

    fn misbehaved(&self, field: &'static str, value: f64) -> SolveError {
        SolveError::Misbehaved { solver: self.name().to_owned(), fault: Fault::Answer { field, value } }
    }

    fn takes_bodies(&self) -> bool {
        let Running { program, pool, .. } = &self.running;
        if program.takes_bodies || pool.takes_bodies() {
            return true;
        }
        // Before the first answer nothing is known of it.
        pool.gives_errors().is_none() && {
            pool.ask(FIRST);
            pool.takes_bodies()
        }
    }
}

/// A question whose answer is known: a coin that does not turn.
const FIRST: &str = "1.0,0.5,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1e-10,1.0";

impl Solver for ByProgram {
    fn name(&self) -> &str {
        self.running.name
    }

    fn stepping(&self) -> Option<Stepping> {
        self.running.program.claim.is_none().then_some(self.stepping)
    }

    fn estimates_its_error(&self) -> bool {
        self.running.program.claim.is_some() || self.running.pool.gives_errors() != Some(false)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        if toss.coin().is_none() && !self.takes_bodies() {
            return Err(SolveError::NotSymmetric {
                solver: self.name().to_owned(),
                why: "without --bodies, a program is asked for coins alone",
            });
        }
        let (question, exchange) = self.exchange(toss)?;
        let failed = |words| {
            let source = Reason::from(ForeignError::from(words));
            SolveError::Failed { solver: self.name().to_owned(), source }
        };
        let landed = exchange.reply.map_err(failed)?;
        let norm = nalgebra::Vector4::from(landed.quaternion).norm();
        if !NORMS.contains(&norm) {
            return Err(self.misbehaved("the norm of the quaternion", norm));
        }
        let quaternion = question.in_body(landed.quaternion);
        let attitude = Attitude::from_components(quaternion);
        let attitude = attitude.map_err(|_| self.misbehaved("the norm", norm))?;
        let state = question.state(toss, attitude, landed.rate);
        let work = Work { rhs_calls: landed.calls, ..Work::default() };
        let error = self.error(toss, &question, &landed)?;
        let landing = Landing::new(state, work).with_cos_tilt(cos_tilt_as_answered(quaternion));
        Ok(landing.with_norm_error((norm - 1.0).abs()).with_error(error))
    }
}
