//! Which integrator, method and tolerance.

use dynamics::{InputError, Method, Scheme, SolverEntry};

use crate::fitted::{FITTED, Fitted, IntegratorFit, Turn};
use crate::model::Model;
use crate::plan::{Candidate, Choice, How, Reason, Verdict};
use crate::registry::{SOLVERS, named_solver};
use crate::scene::Integrator;

/// The flights that an integrator has to make, one after the other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flights {
    /// How far they turn in all.
    pub(crate) turn: Turn,
    /// The error that is allowed at the end of any of them.
    pub(crate) accuracy: f64,
    /// Whether it is that of cos θ; else of the attitude (rad).
    pub(crate) of_tilt: bool,
    /// Their number: a trace goes on from point to point.
    pub(crate) legs: usize,
}

/// Every adaptive method of the integrator that was asked for, or of all.
///
/// # Errors
/// [`InputError`] for a name that is unknown, the exact solver, and a method without an error estimate.
pub(crate) fn integrators(
    by: Option<&Integrator>,
    flights: Flights,
) -> Result<impl Iterator<Item = (Candidate, Verdict)>, InputError> {
    let entries = match by {
        None => SOLVERS,
        Some(by) => std::slice::from_ref(integrator(&by.solver)?),
    };
    let asked = by.and_then(|by| by.method);
    if let Some(scheme) = asked {
        Method::adaptive(scheme, Method::DEFAULT_TOLERANCE)?;
    }
    let methods = move |entry: &'static SolverEntry| {
        let schemes = Scheme::ALL.into_iter().filter(move |scheme| asked.is_none_or(|asked| asked == *scheme));
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
    /// Each leg of a trace hands its errors on to the next: that of the attitude, and that of the rate, which turns into as much
    /// again.
    fn by(&self, fitted: &Fitted, entry: &'static SolverEntry, fit: &IntegratorFit) -> Verdict {
        #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
        let legs = self.legs as f64;
        let handed_on = if self.legs == 1 { 1.0 } else { 2.0 * legs };
        let leg = Turn { phase: self.turn.phase / legs, ..self.turn };
        let too_rough = |error: f64| Reason::TooRough { expected_error: error * handed_on };
        let setting = fitted.setting(fit, self.of_tilt, &leg, self.accuracy / handed_on).map_err(too_rough)?;
        let method = Method::adaptive(fit.method, setting.tolerance).map_err(|_| too_rough(setting.error))?;
        // A trace has its own cost for each point.
        let tracing_ns = fitted.closed(Model::Trace).cost_ns - fitted.closed(Model::Attitude).cost_ns;
        let leg_ns = setting.cost_ns + if self.legs == 1 { 0.0 } else { tracing_ns };
        Ok(Choice {
            model: Model::Integrator,
            how: How::Integrator(entry, method),
            expected_error: setting.error * handed_on,
            expected_cost_ns: leg_ns * legs,
        })
    }
}
