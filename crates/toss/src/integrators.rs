//! Finds the tolerance of every integrator and scheme for a scene that asks for an integrator, as a cross-check of the exact
//! motion. The plan flies: from coarse to fine it takes the first tolerance at which the answer is within the accuracy of
//! the exact motion.
//!
//! An integrator has the same bits each time, so that the answer of the plan is as accurate as the flight of the plan was.
//! An outcome needs more than a small error, because the integrator decides it by its own error estimate: this has to be
//! within the accuracy, too.

use dynamics::{
    Attitude, Error, InputError, Scheme, Settings, SolveError, Solver, SolverEntry, Stepping, TimeOfFlight, Toss,
};
use exact::ExactSolver;
use exact::motion::COS_TILT_ERROR;

use crate::answer::{Answer, Verdict};
use crate::choice::{Candidate, Choice, How, Offer};
use crate::model::{Kind, MODELS, Model, Of};
use crate::reason::Reason;
use crate::registry::Registry;
use crate::samples::no_integrator_for_a_space;
use crate::scene::{Integrator, Scene, Want};
use crate::trace::{attitudes, trace};

/// The tolerances, from coarse to fine, of which a plan takes one.
pub(crate) const TOLERANCES: [f64; 14] =
    [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, f64::EPSILON];

/// The largest error of an attitude of the exact motion (rad), 1.13e-15 as [measured](crate::model), with the rounding of
/// the angle to it, 4 ε.
const ATTITUDE_ERROR: f64 = 1.13e-15 + 4.0 * f64::EPSILON;

/// What a point of a trace costs beside its flight (ns): its Euler angles, and those of the exact motion. It was measured
/// as the costs of the [models](crate::model) were.
const POINT_NS: f64 = 799.0;

/// What a flight costs without its calls of the right-hand side, and what each call costs (ns), of a coin or of another
/// body. `cargo bench --package toss --bench costs` measures them; those of coins were taken as the costs of the
/// [models](crate::model) were. An integrator from elsewhere is taken to cost as much as the dearest of ours.
pub(crate) fn costs(solver: &str, scheme: Scheme, of: Of) -> [f64; 2] {
    match (of, solver, scheme.name()) {
        (Of::Coins, "gamma", "dop853") => [362.0, 39.7],
        (Of::Coins, "gamma", "dopri5") => [308.0, 59.8],
        (Of::Coins, "euler", "dop853") => [298.0, 44.0],
        (Of::Coins, "euler", "dopri5") => [285.0, 53.6],
        (Of::Coins, "quaternion", "dop853") => [200.0, 17.5],
        (Of::Coins, "quaternion", "dopri5") => [166.0, 23.9],
        (Of::Coins, "quaternion", "taylor") => [170.0, 6.61],
        (Of::Coins, ..) => [362.0, 59.8],
        (Of::Others, "euler", "dop853") => [750.0, 46.9],
        (Of::Others, "quaternion", "dop853") => [443.0, 18.1],
        (Of::Others, "quaternion", "dopri5") => [592.0, 22.2],
        (Of::Others, "quaternion", "taylor") => [339.0, 37.4],
        (Of::Others, ..) => [654.0, 50.5],
    }
}

/// The offers of the integrator and the scheme that are asked for. Without a scheme these are all adaptive schemes of
/// the integrator, and without an integrator all adaptive schemes of the registry.
///
/// # Errors
/// [`InputError`] for an unknown name, for the exact solver, and for a scheme that the integrator does not offer or that
/// takes no tolerance; [`Error::Solve`] if the toss has no exact motion.
pub(crate) fn integrators(
    registry: &Registry,
    by: Option<&Integrator>,
    scene: &Scene,
) -> Result<Vec<(Candidate, Offer)>, Error> {
    let entries = match by {
        None => registry.entries(),
        Some(by) => std::slice::from_ref(integrator(registry, &by.solver)?),
    };
    let mut contestants = Vec::new();
    for entry in entries.iter().filter(|entry| entry.integrates()) {
        match by.and_then(|by| by.scheme.as_deref()) {
            None => contestants.extend(entry.schemes().iter().filter(|by| by.is_adaptive()).map(|by| (entry, *by))),
            Some(asked) => {
                let scheme = entry.scheme(asked)?;
                Stepping::adaptive(scheme, Stepping::DEFAULT_TOLERANCE)?;
                contestants.push((entry, scheme));
            }
        }
    }
    let exact = reference(&scene.want)?;
    Ok(contestants.into_iter().map(|(entry, scheme)| offered(scene, &exact, entry, scheme)).collect())
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
    let solver = solver(entry, stepping)?;
    Ok(match want {
        Want::Outcome(toss) => Answer::Outcome(Verdict::Estimated(solver.tilt(toss)?.outcome())),
        want => values(solver.as_ref(), want)?,
    })
}

fn solver(entry: &SolverEntry, stepping: Stepping) -> Result<Box<dyn Solver>, InputError> {
    entry.solver(&Settings { stepping, ..Settings::default() })
}

/// What the answers of integrators are compared with.
enum Reference {
    /// The answer of the exact motion.
    Answer(Answer),
    /// The attitudes of its trace.
    Trace(Vec<Attitude>),
}

fn reference(want: &Want) -> Result<Reference, Error> {
    Ok(match want {
        Want::Trace { toss, points } => {
            Reference::Trace(attitudes(&ExactSolver, toss, *points)?.collect::<Result<_, _>>()?)
        }
        want => Reference::Answer(values(&ExactSolver, want)?),
    })
}

/// The answer of `solver` to `want`; to an outcome, cos θ.
fn values(solver: &dyn Solver, want: &Want) -> Result<Answer, Error> {
    Ok(match want {
        Want::Outcome(toss) | Want::Tilt(toss) => Answer::Tilt(solver.tilt(toss)?.cos_tilt),
        Want::Attitude(toss) => Answer::Attitude(solver.land(toss)?.state),
        Want::Trace { toss, points } => Answer::Trace(trace(solver, toss, *points)?),
        Want::Probability(_) => return Err(no_integrator_for_a_space().into()),
    })
}

/// The offer of a scheme of an integrator: the coarsest tolerance that serves, or the reason why none does.
fn offered(scene: &Scene, exact: &Reference, entry: &SolverEntry, scheme: Scheme) -> (Candidate, Offer) {
    let candidate = Candidate { model: model(), integrator: Some((entry.name().to_owned(), scheme)) };
    let mut smallest = f64::INFINITY;
    let mut failed = None;
    for tolerance in TOLERANCES {
        match flown(scene, exact, entry, scheme, tolerance) {
            Ok(Ok(choice)) => return (candidate, Ok(choice)),
            Ok(Err(error)) => smallest = smallest.min(error),
            Err(error) => {
                // A finer tolerance needs still more steps.
                let is_last = matches!(error, Error::Solve(SolveError::StepLimit { .. }));
                failed = Some(error);
                if is_last {
                    break;
                }
            }
        }
    }
    let reason = match failed {
        _ if smallest.is_finite() => Reason::TooRough { expected_error: smallest },
        Some(error) => Reason::Fails(error),
        None => Reason::TellsNoError,
    };
    (candidate, Err(reason))
}

/// The choice of one of the tolerances, or the error of its flight if that is larger than the accuracy.
fn flown(
    scene: &Scene,
    exact: &Reference,
    entry: &SolverEntry,
    scheme: Scheme,
    tolerance: f64,
) -> Result<Result<Choice, f64>, Error> {
    let stepping = Stepping::adaptive(scheme, tolerance)?;
    let solver = solver(entry, stepping)?;
    let mut error = distance(solver.as_ref(), &scene.want, exact)?;
    if let Want::Outcome(toss) = &scene.want {
        error = error.max(solver.tilt(toss)?.error.unwrap_or(f64::INFINITY));
    }
    if error > scene.accuracy {
        return Ok(Err(error));
    }
    let expected_error = if matches!(scene.want, Want::Outcome(_)) { 0.0 } else { error };
    let of = scene.want.toss().map_or(Of::Coins, |toss| Of::body(&toss.body));
    let expected_cost_ns = cost_ns(solver.as_ref(), costs(entry.name(), scheme, of), &scene.want)?;
    let how = How::Integrator(entry.clone(), stepping);
    Ok(Ok(Choice { model: model(), how, expected_error, expected_cost_ns, points: None }))
}

/// How far the answer of `solver` is from that of the exact motion, of cos θ or of the attitude (rad), with what the latter may be
/// off by itself. Of a trace it is the largest one of its points.
fn distance(solver: &dyn Solver, want: &Want, exact: &Reference) -> Result<f64, Error> {
    Ok(match (want, exact) {
        (Want::Trace { toss, points }, Reference::Trace(exact)) => {
            let mut largest = 0.0_f64;
            for (found, exact) in attitudes(solver, toss, *points)?.zip(exact) {
                largest = largest.max(found?.angle_to(exact));
            }
            largest + ATTITUDE_ERROR
        }
        (want, Reference::Answer(exact)) => match (values(solver, want)?, exact) {
            (Answer::Tilt(found), Answer::Tilt(exact)) => (found - exact).abs() + COS_TILT_ERROR,
            (Answer::Attitude(found), Answer::Attitude(exact)) => {
                found.attitude.angle_to(&exact.attitude) + ATTITUDE_ERROR
            }
            _ => f64::INFINITY,
        },
        _ => f64::INFINITY,
    })
}

/// The cost (ns) of the answer of `solver` by the calls that it counts. Each leg of a trace is taken to need as many as the
/// first.
fn cost_ns(solver: &dyn Solver, [flight_ns, call_ns]: [f64; 2], want: &Want) -> Result<f64, Error> {
    let Some(toss) = want.toss() else { return Err(no_integrator_for_a_space().into()) };
    #[expect(clippy::cast_precision_loss, reason = "calls of a flight are fewer than 2^53")]
    let flight =
        |toss: &Toss| -> Result<f64, Error> { Ok(flight_ns + call_ns * solver.land(toss)?.work.rhs_calls as f64) };
    let Want::Trace { points, .. } = want else { return flight(toss) };
    #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
    let points = *points as f64;
    let time = TimeOfFlight::Given(toss.launch.flight_time() / (points - 1.0));
    let leg = Toss { launch: toss.launch.with_time_of_flight(time)?, ..*toss };
    Ok(flight(&leg)? * (points - 1.0) + POINT_NS * points)
}

#[cfg(test)]
mod tests;
