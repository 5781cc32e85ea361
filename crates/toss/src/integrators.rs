//! Finds the tolerance and the cost of every integrator and scheme for the flights of a scene. The planner takes the
//! cheapest of these offers when a scene asks for an integrator, as a cross-check of the exact motion.
//!
//! The table of measured errors suggests the coarsest tolerance with an error within the accuracy. No table knows the
//! error on every toss, so that the cheapest offer is tried if the scene asks for an integrator: it flies the toss at that
//! tolerance and is compared with the exact motion. Where it is off by more, the table is asked for as much less. An
//! integrator has the same bits each time, so that the answer of the plan is as accurate as the trial was.
//!
//! There are two special cases. For an outcome it is the coarsest tolerance with an
//! [error estimate](Stepping::error_estimate) within the accuracy. A trace is flown in n legs, and each leg passes its
//! errors of the attitude and of the rate on to the next, so each leg may err by accuracy/(2 n).

use dynamics::{Error, InputError, Scheme, Settings, Solver, SolverEntry, Stepping, TimeOfFlight, Toss};
use exact::motion::COS_TILT_ERROR;
use exact::{ExactMotion, ExactSolver};

use crate::answer::{Answer, Verdict};
use crate::choice::{Candidate, Choice, How, Offer};
use crate::fitted::{FITTED, Fitted, IntegratorFit, Setting, Turn};
use crate::model::{Kind, MODELS, Model};
use crate::reason::Reason;
use crate::registry::Registry;
use crate::samples::no_integrator_for_a_space;
use crate::scene::{Integrator, Want};
use crate::trace::trace;

/// The flights that an integrator makes for a scene, one after the other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flights {
    /// The toss that is flown.
    pub(crate) toss: Toss,
    /// How far they turn, all together.
    pub(crate) turn: Turn,
    /// What is computed from them.
    pub(crate) aim: Aim,
    /// The largest error that is allowed at the end of any of them.
    pub(crate) accuracy: f64,
}

/// What is computed from the flights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Aim {
    /// An outcome, which is decided where |cos θ| exceeds the accuracy.
    Outcome,
    /// cos θ.
    Tilt,
    /// An attitude.
    Attitude,
    /// A trace with this number of legs, each of which starts where the one before ended.
    Trace(usize),
}

/// The offers of the integrator and the scheme that are asked for. Without a scheme these are all adaptive schemes of
/// the integrator, of which the cheapest has been tried, and without an integrator all adaptive schemes of the registry by
/// the table alone.
///
/// # Errors
/// [`InputError`] for an unknown name, for the exact solver, for a scheme that the integrator does not offer or that
/// takes no tolerance, and for an integrator that has not been measured.
pub(crate) fn integrators(
    registry: &Registry,
    by: Option<&Integrator>,
    flights: Flights,
) -> Result<Vec<(Candidate, Offer)>, InputError> {
    let entries = match by {
        None => registry.entries(),
        Some(by) => std::slice::from_ref(integrator(registry, &by.solver)?),
    };
    let mut offers = Vec::new();
    for entry in entries.iter().filter(|entry| entry.integrates()) {
        let schemes = match by.and_then(|by| by.scheme.as_deref()) {
            None => entry.schemes().iter().copied().filter(|scheme| scheme.is_adaptive()).collect(),
            Some(asked) => {
                let scheme = entry.scheme(asked)?;
                Stepping::adaptive(scheme, Stepping::DEFAULT_TOLERANCE)?;
                vec![scheme]
            }
        };
        offers.extend(schemes.into_iter().map(|scheme| flights.by(registry, entry, scheme)));
    }
    if by.is_some() {
        flights.try_cheapest(registry, &mut offers);
    }
    match by {
        Some(by) if offers.iter().all(|(_, offer)| matches!(offer, Err(Reason::NotMeasured))) => Err(unmeasured(by)),
        _ => Ok(offers),
    }
}

fn unmeasured(by: &Integrator) -> InputError {
    let expected = "an integrator whose errors and costs were measured into the planner's table";
    InputError::Malformed { field: "solver", value: by.solver.clone(), expected }
}

fn integrator<'a>(registry: &'a Registry, name: &str) -> Result<&'a SolverEntry, InputError> {
    let entry = registry.named(name)?;
    let expected = "an integrator; the exact motion is what is used where none is asked for";
    let malformed = || InputError::Malformed { field: "solver", value: name.to_owned(), expected };
    entry.integrates().then_some(entry).ok_or_else(malformed)
}

/// The row of the integrators in [`MODELS`].
pub(crate) fn model() -> &'static Model {
    MODELS.iter().find(|model| matches!(model.kind, Kind::Integrator)).expect("a row of the table")
}

/// The answer to `want` by an integrator.
///
/// # Errors
/// The error of the solver; [`InputError`] for a space.
pub(crate) fn integrated(entry: &SolverEntry, stepping: Stepping, want: &Want) -> Result<Answer, Error> {
    let solver = entry.solver(&Settings { stepping, ..Settings::default() })?;
    Ok(match want {
        Want::Outcome(toss) => Answer::Outcome(Verdict::Estimated(solver.outcome_rigid(toss)?)),
        Want::Tilt(toss) => Answer::Tilt(solver.cos_tilt_rigid(toss)?),
        Want::Attitude(toss) => Answer::Attitude(solver.propagate_rigid(toss)?.state),
        Want::Trace { toss, points } => Answer::Trace(trace(solver.as_ref(), toss, *points)?),
        Want::Probability(_) => return Err(no_integrator_for_a_space().into()),
    })
}

impl Flights {
    /// The offer of a scheme of an integrator by the table; none if it has not been measured.
    fn by(&self, registry: &Registry, entry: &SolverEntry, scheme: Scheme) -> (Candidate, Offer) {
        let candidate = Candidate { model: model(), integrator: Some((entry.name().to_owned(), scheme)) };
        let offer = match registry.fit(entry.name(), scheme.name()) {
            None => Err(Reason::NotMeasured),
            Some((fitted, fit)) => self.fitted(fitted, &Measured { entry, scheme, fit }),
        };
        (candidate, offer)
    }

    /// Tries the cheapest of the offers, and so on until the cheapest one has been tried. The others would be dearer, whatever
    /// their trial said.
    fn try_cheapest(&self, registry: &Registry, offers: &mut [(Candidate, Offer)]) {
        let mut tried = vec![false; offers.len()];
        loop {
            let cost =
                |index: &usize| offers[*index].1.as_ref().map_or(f64::INFINITY, |choice| choice.expected_cost_ns);
            let cheapest = (0..offers.len()).min_by(|a, b| cost(a).total_cmp(&cost(b)));
            let Some(index) = cheapest.filter(|index| !tried[*index]) else { return };
            if let Ok(choice) = &offers[index].1 {
                offers[index].1 = self.tried(registry, choice);
            }
            tried[index] = true;
        }
    }

    /// The `choice` by the table, with a tolerance at which the error on the toss itself is within the accuracy.
    fn tried(&self, registry: &Registry, choice: &Choice) -> Offer {
        let How::Integrator(entry, stepping) = &choice.how else { return Ok(choice.clone()) };
        let scheme = stepping.scheme();
        let Some((fitted, fit)) = registry.fit(entry.name(), scheme.name()) else { return Ok(choice.clone()) };
        let mut choice = choice.clone();
        // How many times as large as in the table errors are on this toss, at least 1.
        let mut factor = 1.0_f64;
        loop {
            // An outcome is decided by the error estimate. What an integrator refuses has no error: it says why when it is
            // run.
            let Some(error) = self.error(&choice) else { return Ok(choice) };
            if error <= self.accuracy {
                let expected_error = (factor * choice.expected_error).max(error);
                return Ok(Choice { expected_error, ..choice });
            }
            factor = (2.0 * factor).max(2.0 * error / choice.expected_error);
            let asked = Self { accuracy: self.accuracy / factor, ..*self };
            choice = asked
                .fitted(fitted, &Measured { entry, scheme, fit })
                .map_err(|_| Reason::TooRough { expected_error: error })?;
        }
    }

    /// The error of `choice` on the toss against the exact motion, with what that may be off by itself: of cos θ or of
    /// the attitude (rad), the largest one of a trace. `None` for an outcome, and where the integrator returns an error.
    fn error(&self, choice: &Choice) -> Option<f64> {
        let How::Integrator(entry, stepping) = &choice.how else { return None };
        let solver = entry.solver(&Settings { stepping: *stepping, ..Settings::default() }).ok()?;
        match self.aim {
            Aim::Outcome => None,
            Aim::Tilt => {
                let exact = ExactSolver.cos_tilt(&self.toss).ok()?;
                Some((solver.cos_tilt(&self.toss).ok()? - exact).abs() + COS_TILT_ERROR)
            }
            Aim::Attitude => {
                let exact = ExactMotion::new(&self.toss).state(self.toss.launch.time_of_flight()).ok()?;
                let found = solver.propagate(&self.toss).ok()?.state.attitude;
                Some(exact.attitude.angle_to(&found) + Self::rounding("attitude"))
            }
            Aim::Trace(legs) => {
                let motion = ExactMotion::new(&self.toss);
                trace(solver.as_ref(), self.toss, legs + 1).ok()?.iter().try_fold(0.0, |largest: f64, point| {
                    let exact = motion.state(TimeOfFlight::Given(point.time)).ok()?;
                    Some(largest.max(exact.attitude.angle_to(&point.attitude) + Self::rounding("trace")))
                })
            }
        }
    }

    /// The largest error of an attitude of the exact motion (rad), as measured for this closed form, and of the angle to
    /// it.
    fn rounding(model: &str) -> f64 {
        FITTED.closed(model).map_or(0.0, |fit| fit.error) + 4.0 * f64::EPSILON
    }

    /// The offer by the table alone.
    fn fitted(&self, fitted: &Fitted, by: &Measured<'_>) -> Offer {
        match self.aim {
            Aim::Outcome => self.decided(fitted, by),
            Aim::Tilt => self.flown(fitted, by, true),
            Aim::Attitude => self.flown(fitted, by, false),
            Aim::Trace(legs) => self.traced(fitted, by, legs),
        }
    }

    /// The offer for an outcome. Its tolerance makes the [error estimate](Stepping::error_estimate) about the accuracy
    /// and no more, so that a decided outcome is right if the estimate is.
    fn decided(&self, fitted: &Fitted, by: &Measured<'_>) -> Offer {
        // Truncation alone; the estimate adds rounding, which is small where a tolerance is not near ε.
        let mut tolerance = (self.accuracy / (100.0 * (1.0 + self.turn.phase))).min(Self::ROUGHEST);
        let mut smallest = f64::INFINITY;
        while let Ok(stepping) = Stepping::adaptive(by.scheme, tolerance) {
            let estimate = stepping.error_estimate(&self.toss).unwrap_or(f64::INFINITY);
            if estimate <= self.accuracy {
                return Ok(by.choice(stepping, 0.0, fitted.cost_ns(by.fit, &self.turn, tolerance)));
            }
            smallest = smallest.min(estimate);
            tolerance *= 0.9;
        }
        let finest = || Stepping::adaptive(by.scheme, f64::EPSILON).ok()?.error_estimate(&self.toss).ok();
        Err(Reason::TooRough { expected_error: smallest.min(finest().unwrap_or(f64::INFINITY)) })
    }

    /// The coarsest tolerance of the table; no coarser one is used.
    const ROUGHEST: f64 = 1e-3;

    fn flown(&self, fitted: &Fitted, by: &Measured<'_>, of_tilt: bool) -> Offer {
        let too_rough = |expected_error: f64| Reason::TooRough { expected_error };
        let Setting { tolerance, error, cost_ns } =
            fitted.setting(by.fit, of_tilt, &self.turn, self.accuracy).map_err(too_rough)?;
        let stepping = Stepping::adaptive(by.scheme, tolerance).map_err(|_| too_rough(error))?;
        Ok(by.choice(stepping, error, cost_ns))
    }

    /// The offer for a trace. Each leg passes two errors on to the next: that of the attitude, and that of the rate,
    /// which adds about as much again to the attitude.
    fn traced(&self, fitted: &Fitted, by: &Measured<'_>, legs: usize) -> Offer {
        #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
        let legs = legs as f64;
        let handed_on = 2.0 * legs;
        let turn = Turn { phase: self.turn.phase / legs, ..self.turn };
        let leg = Self { turn, aim: Aim::Attitude, accuracy: self.accuracy / handed_on, ..*self };
        // What a trace adds to the cost of a landing, for each point; there is one more point than legs.
        let cost_of = |model: &str| FITTED.closed(model).map_or(0.0, |fit| fit.cost_ns);
        let tracing_ns = cost_of("trace") - cost_of("attitude");
        match leg.fitted(fitted, by) {
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

/// A scheme of an integrator, with its measured errors and costs.
struct Measured<'a> {
    entry: &'a SolverEntry,
    scheme: Scheme,
    fit: &'a IntegratorFit,
}

impl Measured<'_> {
    fn choice(&self, stepping: Stepping, expected_error: f64, expected_cost_ns: f64) -> Choice {
        Choice { model: model(), how: How::Integrator(self.entry.clone(), stepping), expected_error, expected_cost_ns }
    }
}
