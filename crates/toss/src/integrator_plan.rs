//! Which integrator, method and tolerance: the cheapest whose tabulated error stays within the accuracy.
//!
//! An outcome needs 100 × tolerance × (1 + phase) ≤ accuracy; a trace of n legs has errors of the attitude and of the
//! rate handed on, so that each leg may err by accuracy/(2 n).

use dynamics::{InputError, Method, SolverEntry};

use crate::choice::{Candidate, Choice, How, Offer, Reason};
use crate::fitted::{FITTED, Fitted, IntegratorFit, Setting, Turn};
use crate::model::Model;
use crate::registry::{SOLVERS, named_solver};
use crate::scene::Integrator;

/// The flights that an integrator has to make, one after the other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flights {
    /// How far they turn in all.
    pub(crate) turn: Turn,
    /// What they are for.
    pub(crate) aim: Aim,
    /// The error that is allowed at the end of any of them.
    pub(crate) accuracy: f64,
}

/// What flights are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Aim {
    /// An outcome, decided where |cos θ| exceeds the accuracy.
    Outcome,
    /// cos θ.
    Tilt,
    /// An attitude.
    Attitude,
    /// As many attitudes, one after the other.
    Trace(usize),
}

/// Every adaptive method of the integrator that was asked for, or of all.
///
/// # Errors
/// [`InputError`] for a name that is unknown, the exact solver, and a method that the integrator does not offer or that
/// has no error estimate.
pub(crate) fn integrators(
    by: Option<&Integrator>,
    flights: Flights,
) -> Result<impl Iterator<Item = (Candidate, Offer)>, InputError> {
    let entries = match by {
        None => SOLVERS,
        Some(by) => std::slice::from_ref(integrator(&by.solver)?),
    };
    let asked = by.and_then(|by| by.method);
    if let Some(scheme) = asked {
        entries.iter().try_for_each(|entry| entry.require_scheme(scheme))?;
        Method::adaptive(scheme, Method::DEFAULT_TOLERANCE)?;
    }
    let methods = move |entry: &'static SolverEntry| {
        let schemes = entry.schemes.iter().copied().filter(move |scheme| asked.is_none_or(|asked| asked == *scheme));
        schemes.filter_map(move |scheme| {
            let fit = FITTED.integrator(entry.name, scheme)?;
            let candidate = Candidate { model: Model::Integrator, integrator: Some((entry.name, scheme)) };
            Some((candidate, flights.by(&FITTED, entry, fit)))
        })
    };
    Ok(entries.iter().filter(|entry| entry.integrates()).flat_map(methods))
}

fn integrator(name: &str) -> Result<&'static SolverEntry, InputError> {
    let entry = named_solver(name)?;
    let expected = "an integrator; the exact motion is what is used where none is asked for";
    let malformed = || InputError::Malformed { field: "solver", value: name.to_owned(), expected };
    entry.integrates().then_some(entry).ok_or_else(malformed)
}

impl Flights {
    fn by(&self, fitted: &Fitted, entry: &'static SolverEntry, fit: &IntegratorFit) -> Offer {
        match self.aim {
            Aim::Outcome => self.decided(fitted, entry, fit),
            Aim::Tilt => self.flown(fitted, entry, fit, true),
            Aim::Attitude => self.flown(fitted, entry, fit, false),
            Aim::Trace(legs) => self.traced(fitted, entry, fit, legs),
        }
    }

    /// With the tolerance at which the solver answers for the accuracy, see [`Method::resolution`]: a decided outcome
    /// is right.
    fn decided(&self, fitted: &Fitted, entry: &'static SolverEntry, fit: &IntegratorFit) -> Offer {
        let tolerance = (self.accuracy / (100.0 * (1.0 + self.turn.phase))).min(Self::ROUGHEST);
        let answered_for =
            |tolerance: f64| Reason::TooRough { expected_error: 100.0 * tolerance * (1.0 + self.turn.phase) };
        let method = Method::adaptive(fit.method, tolerance).map_err(|_| answered_for(f64::EPSILON))?;
        Ok(choice(entry, method, 0.0, fitted.cost_ns(fit, &self.turn, tolerance)))
    }

    /// Tolerances are not rougher than those of the record.
    const ROUGHEST: f64 = 1e-3;

    fn flown(&self, fitted: &Fitted, entry: &'static SolverEntry, fit: &IntegratorFit, of_tilt: bool) -> Offer {
        let too_rough = |expected_error: f64| Reason::TooRough { expected_error };
        let Setting { tolerance, error, cost_ns } =
            fitted.setting(fit, of_tilt, &self.turn, self.accuracy).map_err(too_rough)?;
        let method = Method::adaptive(fit.method, tolerance).map_err(|_| too_rough(error))?;
        Ok(choice(entry, method, error, cost_ns))
    }

    /// Each leg hands its errors on to the next: that of the attitude, and that of the rate, which turns into as much
    /// again.
    fn traced(&self, fitted: &Fitted, entry: &'static SolverEntry, fit: &IntegratorFit, legs: usize) -> Offer {
        #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
        let legs = legs as f64;
        let handed_on = 2.0 * legs;
        let turn = Turn { phase: self.turn.phase / legs, ..self.turn };
        let leg = Self { turn, aim: Aim::Attitude, accuracy: self.accuracy / handed_on };
        // A trace has its own cost for each point, of which there is one more than legs.
        let tracing_ns = fitted.closed(Model::Trace).cost_ns - fitted.closed(Model::Attitude).cost_ns;
        match leg.by(fitted, entry, fit) {
            Ok(leg) => Ok(Choice {
                expected_error: leg.expected_error * handed_on,
                expected_cost_ns: leg.expected_cost_ns * legs + tracing_ns * (legs + 1.0),
                ..leg
            }),
            Err(Reason::TooRough { expected_error }) => {
                Err(Reason::TooRough { expected_error: expected_error * handed_on })
            }
            Err(other) => Err(other),
        }
    }
}

fn choice(entry: &'static SolverEntry, method: Method, expected_error: f64, expected_cost_ns: f64) -> Choice {
    Choice { model: Model::Integrator, how: How::Integrator(entry, method), expected_error, expected_cost_ns }
}
