//! Integrators beside the exact motion: where each lands, what it costs, and how its error grows along the flight.

use serde::{Deserialize, Serialize};
use toss::quantity::Dimension;
use toss::report::{self, Comparison};
use toss::{Error, ExactSolver, Formulation, Registry, Solver, SolverConfig, StepControl, TimeOfFlight, Toss};

use crate::thrown::{Thrown, malformed};

/// Right-hand sides that a curve of errors may cost. It has fewer points where a flight is dear.
const MOST_CALLS: u64 = 3_000_000;

/// A solver with its settings, as texts.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Chosen {
    solver: String,
    scheme: Option<String>,
    tolerance: Option<String>,
    step: Option<String>,
    formulation: Option<String>,
}

/// The error along the flight: at each time, that of a flight of this length.
#[derive(Debug, Serialize)]
pub(crate) struct Growth {
    time: Vec<f64>,
    cos_tilt_error: Vec<Option<f64>>,
    attitude_error: Vec<Option<f64>>,
    rhs_calls: Vec<Option<u64>>,
    /// The first failure along the flight, in words.
    failure: Option<String>,
}

impl Chosen {
    fn config(&self) -> Result<SolverConfig, Error> {
        let mut config = SolverConfig::new(self.solver.clone());
        if let Some(scheme) = &self.scheme {
            config = config.with_scheme(scheme.clone());
        }
        if let Some(text) = &self.tolerance {
            config = config.with_tolerance(tolerance(text)?)?;
        }
        if let Some(text) = &self.step {
            config = config.with_step(Dimension::Time.read("step [s]", text)?)?;
        }
        if let Some(name) = &self.formulation {
            config = config.with_formulation(Formulation::named(name)?);
        }
        Ok(config)
    }
}

fn tolerance(text: &str) -> Result<f64, Error> {
    text.trim().parse().map_err(|_| malformed("tolerance", text, "a number such as 1e-9").into())
}

/// Where the chosen solver lands, beside the exact motion.
pub(crate) fn landing(thrown: &Thrown, chosen: &Chosen) -> Result<Comparison, Error> {
    compared(&thrown.toss, &chosen.config()?)
}

fn compared(toss: &Toss, config: &SolverConfig) -> Result<Comparison, Error> {
    Ok(Comparison::new(Registry::standard(), config, toss, &ExactSolver.land(toss)?)?)
}

/// Flies the toss `times` times, for a clock outside.
pub(crate) fn repeat(thrown: &Thrown, chosen: &Chosen, times: u32) -> Result<u32, Error> {
    let backend = Registry::standard().configured(&chosen.config()?)?;
    let flights = (0..times).map(|_| backend.solver().land(&thrown.toss).is_ok());
    Ok(flights.map(u32::from).sum())
}

/// Every solver with each of its schemes, and of those with formulations the one called `formulation`.
pub(crate) fn candidates(typed_tolerance: &str, typed_step: &str, formulation: &str) -> Result<Vec<Chosen>, Error> {
    let (tolerance, step) = (tolerance(typed_tolerance)?, Dimension::Time.read("step [s]", typed_step)?);
    let wanted = Formulation::named(formulation)?;
    let chosen = |config: &SolverConfig| Chosen {
        solver: config.name().to_owned(),
        scheme: config.scheme().map(str::to_owned),
        tolerance: matches!(config.control(), Some(StepControl::Tolerance(_))).then(|| typed_tolerance.to_owned()),
        step: matches!(config.control(), Some(StepControl::Step(_))).then(|| typed_step.to_owned()),
        formulation: config.formulation().map(|formulation| formulation.name().to_owned()),
    };
    Ok(report::candidates(Registry::standard(), tolerance, step, Some(wanted))?.iter().map(chosen).collect())
}

/// The error of the chosen solver at up to `points` times along the flight.
pub(crate) fn growth(thrown: &Thrown, chosen: &Chosen, points: u32) -> Result<Growth, Error> {
    let config = chosen.config()?;
    let whole = compared(&thrown.toss, &config)?;
    // A flight that fails may have cost as many steps as are allowed.
    let calls = whole.rhs_calls.unwrap_or(if whole.failure.is_some() { MOST_CALLS / 40 } else { 1 });
    let points = u64::from(points).min(2 * MOST_CALLS / calls.max(1)).max(1);
    let mut growth = Growth {
        time: vec![],
        cos_tilt_error: vec![],
        attitude_error: vec![],
        rhs_calls: vec![],
        failure: whole.failure.as_ref().map(|failed| failed.message.clone()),
    };
    let flight_time = thrown.toss.launch.flight_time();
    for index in 1..points {
        let time = flight_time * (index as f64 / points as f64);
        growth.push(time, compared(&until(&thrown.toss, time)?, &config)?);
    }
    growth.push(flight_time, whole);
    Ok(growth)
}

impl Growth {
    fn push(&mut self, time: f64, landing: Comparison) {
        self.time.push(time);
        self.cos_tilt_error.push(landing.cos_tilt_error);
        self.attitude_error.push(landing.attitude_error);
        self.rhs_calls.push(landing.rhs_calls);
        if self.failure.is_none() {
            self.failure = landing.failure.map(|failed| failed.message);
        }
    }
}

/// The same toss, caught `time` (s) after its launch.
fn until(toss: &Toss, time: f64) -> Result<Toss, Error> {
    let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(time))?;
    Ok(Toss { launch, ..*toss })
}
