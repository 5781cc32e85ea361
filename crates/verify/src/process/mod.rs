//! A solver that is a program of its own, in any language: it reads launches on its standard input and writes attitudes
//! to its standard output. Integrators in Python, C++, Julia or MATLAB so come under the same checks as those in Rust.
//!
//! `protocol` has the lines that are exchanged, `child` one running process with its limits of time and memory, `pool`
//! the processes of one program and when it is given up. `docs/your-solver.md` is the page for its author.

mod child;
mod pool;
mod protocol;

use std::sync::Arc;
use std::time::Duration;

use dynamics::body_rate::rate_by_momentum;
use dynamics::error::{Reason, require};
use dynamics::{Fault, Flight, ForeignError};
use toss::{
    Attitude, CoinToss, InputError, Landing, Scheme, SolveError, Solver, SolverEntry, State, StepControl, Stepping,
    Toss, Work,
};

use pool::Pool;
pub use protocol::HEADER;
use protocol::Landed;

/// The scheme of a program that takes a tolerance.
pub const OWN: Scheme = Scheme::new("own", None).adaptive();

/// The least and the largest norm of a quaternion that is taken for one of norm 1 with the error of an integration.
const NORMS: std::ops::RangeInclusive<f64> = 0.9..=1.1;

/// A program that computes where a toss lands, as a command line of the shell.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    command: String,
    summary: String,
    claim: Option<f64>,
    limits: Limits,
}

/// How long a program may take and how much memory it may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// For an answer. The first answer of a process, which may have to load its libraries, has six times as long; one
    /// that replaces a process may take three times as long as that took to start.
    pub answer: Duration,
    /// For all answers, added up over the processes that run at once.
    pub total: Duration,
    /// Resident memory of a process with its children, in bytes. It is looked at on Linux only, ten times a second.
    pub memory: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { answer: Duration::from_secs(10), total: Duration::from_secs(1800), memory: 2 << 30 }
    }
}

impl Program {
    /// The program that the shell starts by `command`. It integrates with the tolerance that it is asked for, and is
    /// judged by the [error estimate](Stepping::error_estimate) of that tolerance, or by an error that it gives with
    /// its answers.
    pub fn new(command: impl Into<String>) -> Self {
        let command = command.into();
        Self { summary: format!("the program `{command}`"), command, claim: None, limits: Limits::default() }
    }

    /// The same program, which is judged by this error of cos θ at any toss, and asked for no other tolerance.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if the claim is not above 0 and below 1.
    pub fn with_claim(self, claim: f64) -> Result<Self, InputError> {
        let claim = require("claim", claim, "0 < claim < 1", claim > 0.0 && claim < 1.0)?;
        Ok(Self { claim: Some(claim), ..self })
    }

    /// The same program, about which its entry says this in one line; without it, its command line.
    #[must_use]
    pub fn with_summary(self, summary: impl Into<String>) -> Self {
        Self { summary: summary.into(), ..self }
    }

    /// The same program within other limits.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// The program as an entry called `name`. Its processes are started when they are asked first, one for each thread
    /// that asks, and are ended with the entry and all its solvers.
    pub fn entry(&self, name: &'static str) -> SolverEntry {
        let pool = Arc::new(Pool::new(&self.command, self.limits));
        let claim = self.claim;
        let entry = SolverEntry::new(name, self.summary.clone(), move |settings| {
            Box::new(ByProgram { name, pool: Arc::clone(&pool), stepping: settings.stepping, claim })
        });
        if claim.is_some() { entry } else { entry.with_schemes(&[OWN]) }
    }
}

/// The solver that asks a program.
struct ByProgram {
    name: &'static str,
    pool: Arc<Pool>,
    stepping: Stepping,
    claim: Option<f64>,
}

impl ByProgram {
    fn ask(&self, toss: &CoinToss) -> Result<Landed, SolveError> {
        let flight = Flight::new(&Toss::from(*toss))?;
        let tolerance = match (self.claim, self.stepping.control()) {
            (Some(claim), _) => claim,
            (None, StepControl::Tolerance(tolerance)) => flight.tightened(tolerance),
            (None, StepControl::Step(_)) => {
                return Err(SolveError::NotOffered { scheme: self.stepping.scheme().name() });
            }
        };
        let failed = |words| {
            let source = Reason::from(ForeignError::from(words));
            SolveError::Failed { solver: self.name.to_owned(), source }
        };
        self.pool.ask(&protocol::question(toss, &flight, tolerance)).map_err(failed)
    }

    fn misbehaved(&self, field: &'static str, value: f64) -> SolveError {
        SolveError::Misbehaved { solver: self.name.to_owned(), fault: Fault::Answer { field, value } }
    }
}

impl Solver for ByProgram {
    fn name(&self) -> &str {
        self.name
    }

    fn stepping(&self) -> Option<Stepping> {
        self.claim.is_none().then_some(self.stepping)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let coin = toss.of_coin(self.name, "the protocol of programs has two moments")?;
        let Landed { quaternion, calls, error } = self.ask(&coin)?;
        let norm = nalgebra::Vector4::from(quaternion).norm();
        if !NORMS.contains(&norm) {
            return Err(self.misbehaved("the norm of the quaternion", norm));
        }
        let attitude = Attitude::from_components(quaternion).map_err(|_| self.misbehaved("the norm", norm))?;
        let state = State { attitude, rate: rate_by_momentum(&coin, &attitude) };
        let work = Work { rhs_calls: calls, ..Work::default() };
        let error = match self.claim.or(error) {
            None => self.stepping.error_estimate(toss)?,
            claim => claim,
        };
        Ok(Landing::new(state, work).with_norm_error((norm - 1.0).abs()).with_error(error))
    }
}
