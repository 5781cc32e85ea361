//! How far a landing with a proven bound is off, by the 256-bit reference or by the exact motion, as a part of its bound.

use dynamics::phase::RoughPhases;
use toss::{CoinToss, ExactSolver, IntegratedCertificate, Landing, QuaternionSolver, SolveError, Solver};

use super::judged;
use crate::measure::measurement::Deviation;
use crate::measure::reference::Reference;

/// Refuses flights of more than the phase 1e5 rad, which would take minutes and are in none of the sets.
pub(super) fn require_short(toss: &CoinToss) -> Result<(), SolveError> {
    let phase = RoughPhases::new(toss).largest()?;
    let error =
        || SolveError::failed(QuaternionSolver::NAME, std::io::Error::other("flights above 1e5 rad are not flown"));
    (phase <= 1e5).then_some(()).ok_or_else(error)
}

/// The larger one of the errors of cos θ and of the attitude, divided by their bounds.
pub(super) fn share(solver: &QuaternionSolver, toss: &CoinToss) -> Deviation {
    share_by_reference(&solver.enclose(&(*toss).into())?, toss)
}

pub(super) fn share_by_reference(found: &IntegratedCertificate, toss: &CoinToss) -> Deviation {
    let reference = Reference::new(toss);
    let of_cos_tilt = reference.cos_tilt_error(found.cos_tilt()) / found.error_bound();
    Ok(of_cos_tilt.max(distance(found, &reference) / found.attitude_error_bound()))
}

/// The same by the exact motion, if it can judge the flight.
pub(super) fn share_by_exact_motion(found: &IntegratedCertificate, toss: &CoinToss) -> Option<f64> {
    let exact = ExactSolver.land(&(*toss).into()).ok()?;
    judged::by_exact_motion(errors(found, &exact), bounds_of(found))
}

/// The errors against the exact motion, of cos θ and of the attitude.
pub(super) fn errors(found: &IntegratedCertificate, exact: &Landing) -> [f64; 2] {
    let distance = 0.5 * found.landing().state.attitude.angle_to(&exact.state.attitude);
    [(found.cos_tilt() - exact.cos_tilt).abs(), distance]
}

/// The bounds of cos θ and of the attitude.
pub(super) fn bounds_of(found: &IntegratedCertificate) -> [f64; 2] {
    [found.error_bound(), found.attitude_error_bound()]
}

/// The distance of the quaternions, which is half the angle between the attitudes, or less.
pub(super) fn distance(found: &IntegratedCertificate, reference: &Reference) -> f64 {
    0.5 * reference.attitude_error(&found.landing().state.attitude)
}
