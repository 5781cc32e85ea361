//! This file solves the paper's cheated toss for times of flight of up to 10⁴ s, far longer than any coin flies, and
//! measures error and drift. The errors of integrators grow with time, and this shows how fast.

use rayon::prelude::*;
use serde::Serialize;
use toss::{Coin, InputError, Launch, SolveError, SolverEntry, Stepping, TimeOfFlight, Toss};

use crate::measure::drift;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::{Subject, by_kind, subjects};

/// Step of schemes without a tolerance (s); the default of 1e-3 s would need too many steps.
const STEP: f64 = 1e-2;

/// Times of flight (s), two in each decade.
const TIMES: [f64; 9] = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4];

/// One subject after one time of flight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LongFlight {
    /// The subject's name.
    pub subject: String,
    /// Time of flight (s).
    pub time: f64,
    /// Error and drift at landing, or why the solver failed.
    #[serde(flatten)]
    pub found: Result<Drift, String>,
}

/// Error and drift at landing; relative drifts are relative to the value at launch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Drift {
    /// Angle to the exact attitude (rad).
    pub err_attitude: f64,
    /// The attitude error that the solver's error estimate allows (rad); `None` if it has no estimate.
    pub allowed: Option<f64>,
    /// Drift of the kinetic energy, relative.
    pub energy: f64,
    /// Drift of S as a vector in the transport frame, relative.
    pub momentum_vector: f64,
    /// Norm error of an integrated quaternion.
    pub norm_error: f64,
}

/// All subjects at all times.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct LongFlights(pub Vec<LongFlight>);

impl LongFlights {
    /// Solves all flights with every solver of `registry`, each integrator by every scheme.
    pub fn new(registry: &[SolverEntry]) -> anyhow::Result<Self> {
        let subjects = subjects(registry, |scheme| by_kind(scheme, Stepping::DEFAULT_TOLERANCE, STEP))?;
        let flights: Vec<(&Subject, f64)> =
            subjects.iter().flat_map(|subject| TIMES.map(|time| (subject, time))).collect();
        let fly = |(subject, time): (&Subject, f64)| -> Result<LongFlight, InputError> {
            let toss = Toss::new(Coin::PAPER, Launch::new([1.0, 1.0, 2.5], TimeOfFlight::Given(time))?);
            let found = Drift::new(subject, &toss).map_err(|error| error.to_string());
            Ok(LongFlight { subject: subject.name.clone(), time, found })
        };
        Ok(Self(flights.into_par_iter().with_max_len(1).map(fly).collect::<Result<_, _>>()?))
    }

    /// The names of the subjects, in the order of the registry.
    pub fn subjects(&self) -> impl Iterator<Item = &str> {
        self.0.chunk_by(|a, b| a.subject == b.subject).map(|flights| flights[0].subject.as_str())
    }

    /// The flights of `subject`: time of flight (s) and what was found.
    pub fn of<'a>(&'a self, subject: &'a str) -> impl Iterator<Item = (f64, &'a Result<Drift, String>)> {
        self.0.iter().filter(move |flight| flight.subject == subject).map(|flight| (flight.time, &flight.found))
    }
}

impl Drift {
    fn new(subject: &Subject, toss: &Toss) -> Result<Self, SolveError> {
        let landing = subject.solver.land(toss)?;
        Ok(Self {
            err_attitude: Reference::of(toss)?.attitude_error(&landing.state.attitude),
            allowed: Allowance::new(subject, toss, landing.error).map(|allowance| allowance.attitude),
            energy: drift::energy(toss, &landing.state),
            momentum_vector: drift::momentum_vector(toss, &landing.state),
            norm_error: landing.norm_error,
        })
    }
}
