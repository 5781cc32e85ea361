//! Integrators beside the exact motion: where each lands, what it costs, and how its error grows along the flight.

use serde::{Deserialize, Serialize};
use toss::{Backend, Error, ExactSolver, Formulation, Registry, Solver, SolverConfig, TimeOfFlight, Toss};

use crate::known::scheme_of;
use crate::thrown::{Thrown, malformed};

/// Right-hand sides that a curve of errors may cost. It has fewer points where a flight is dear.
const MOST_CALLS: u64 = 3_000_000;

/// A solver with its settings, as texts.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    solver: String,
    scheme: Option<String>,
    tolerance: Option<String>,
    step: Option<String>,
    formulation: Option<String>,
}

/// Where a solver lands, beside the exact motion.
#[derive(Debug, Serialize)]
pub(crate) struct Landing {
    cos_tilt: Option<f64>,
    cos_tilt_error: Option<f64>,
    /// The angle between the two attitudes (rad).
    attitude_error: Option<f64>,
    outcome: Option<&'static str>,
    rhs_calls: Option<u64>,
    accepted_steps: Option<u64>,
    rejected_steps: Option<u64>,
    failure: Option<String>,
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
    fn backend(&self) -> Result<Backend, Error> {
        let mut config = SolverConfig::new(self.solver.clone());
        if let Some(scheme) = &self.scheme {
            config = config.with_scheme(scheme.clone());
        }
        if let Some(text) = &self.tolerance {
            config = config.with_tolerance(tolerance(text)?)?;
        }
        if let Some(text) = &self.step {
            config = config.with_step(toss::quantity::Dimension::Time.read("step [s]", text)?)?;
        }
        if let Some(name) = &self.formulation {
            config = config.with_formulation(Formulation::named(name)?);
        }
        Ok(Registry::standard().configured(&config)?)
    }
}

fn tolerance(text: &str) -> Result<f64, Error> {
    text.trim().parse().map_err(|_| malformed("tolerance", text, "a number such as 1e-9").into())
}

/// Where the chosen solver lands.
pub(crate) fn landing(thrown: &Thrown, chosen: &Chosen) -> Result<Landing, Error> {
    Ok(Landing::of(&thrown.toss, &chosen.backend()?))
}

/// Flies the toss `times` times, for a clock outside.
pub(crate) fn repeat(thrown: &Thrown, chosen: &Chosen, times: u32) -> Result<u32, Error> {
    let backend = chosen.backend()?;
    let flights = (0..times).map(|_| backend.solver().land(&thrown.toss).is_ok());
    Ok(flights.map(u32::from).sum())
}

/// Every solver with each of its schemes, and of those with formulations the one called `formulation`.
pub(crate) fn candidates(tolerance: &str, step: &str, formulation: &str) -> Result<Vec<Chosen>, Error> {
    let wanted = Formulation::named(formulation)?;
    let mut all = Vec::new();
    for entry in Registry::standard().entries() {
        let chosen = |scheme: Option<&str>, formulation: Option<Formulation>| Chosen {
            solver: entry.name().to_owned(),
            scheme: scheme.map(str::to_owned),
            tolerance: scheme.filter(|name| scheme_of(name)).map(|_| tolerance.to_owned()),
            step: scheme.filter(|name| !scheme_of(name)).map(|_| step.to_owned()),
            formulation: formulation.map(|formulation| formulation.name().to_owned()),
        };
        if !entry.integrates() {
            all.push(chosen(None, None));
        }
        let own = entry.formulations().contains(&wanted).then_some(wanted);
        if own.is_some() || entry.formulations().is_empty() {
            all.extend(entry.schemes().iter().map(|scheme| chosen(Some(scheme.name()), own)));
        }
    }
    Ok(all)
}

impl Landing {
    fn of(toss: &Toss, backend: &Backend) -> Self {
        match Self::answered(toss, backend) {
            Ok(landing) => landing,
            Err(error) => Self { failure: Some(error.to_string()), ..Self::empty() },
        }
    }

    fn answered(toss: &Toss, backend: &Backend) -> Result<Self, Error> {
        let landed = backend.solver().land(toss)?;
        let answer = Self { cos_tilt: Some(landed.cos_tilt), outcome: Some(landed.outcome().name()), ..Self::empty() };
        if backend.solver().name() == ExactSolver::NAME {
            return Ok(answer);
        }
        let exact = ExactSolver.land(toss)?;
        Ok(Self {
            cos_tilt_error: Some((landed.cos_tilt - exact.cos_tilt).abs()),
            attitude_error: Some(landed.state.attitude.angle_to(&exact.state.attitude)),
            rhs_calls: Some(landed.work.rhs_calls),
            accepted_steps: Some(landed.work.accepted_steps),
            rejected_steps: Some(landed.work.rejected_steps),
            ..answer
        })
    }

    fn empty() -> Self {
        Self {
            cos_tilt: None,
            cos_tilt_error: None,
            attitude_error: None,
            outcome: None,
            rhs_calls: None,
            accepted_steps: None,
            rejected_steps: None,
            failure: None,
        }
    }
}

/// The error of the chosen solver at up to `points` times along the flight.
pub(crate) fn growth(thrown: &Thrown, chosen: &Chosen, points: u32) -> Result<Growth, Error> {
    let backend = chosen.backend()?;
    let whole = Landing::of(&thrown.toss, &backend);
    // A flight that fails may have cost as many steps as are allowed.
    let calls = whole.rhs_calls.unwrap_or(if whole.failure.is_some() { MOST_CALLS / 40 } else { 1 });
    let points = u64::from(points).min(2 * MOST_CALLS / calls.max(1)).max(1);
    let mut growth = Growth {
        time: vec![],
        cos_tilt_error: vec![],
        attitude_error: vec![],
        rhs_calls: vec![],
        failure: whole.failure.clone(),
    };
    let flight_time = thrown.toss.launch.flight_time();
    for index in 1..points {
        let time = flight_time * (index as f64 / points as f64);
        growth.push(time, Landing::of(&until(&thrown.toss, time)?, &backend));
    }
    growth.push(flight_time, whole);
    Ok(growth)
}

impl Growth {
    fn push(&mut self, time: f64, landing: Landing) {
        self.time.push(time);
        self.cos_tilt_error.push(landing.cos_tilt_error);
        self.attitude_error.push(landing.attitude_error);
        self.rhs_calls.push(landing.rhs_calls);
        if self.failure.is_none() {
            self.failure = landing.failure;
        }
    }
}

/// The same toss, caught `time` (s) after its launch.
fn until(toss: &Toss, time: f64) -> Result<Toss, Error> {
    let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(time))?;
    Ok(Toss { launch, ..*toss })
}
