//! Plans an integration that proves how far cos θ or an attitude can be off. The plan flies, as that of any integrator
//! does, and takes the coarsest of the same tolerances whose proven bound is within the accuracy.

use dynamics::{Error, Formulation, InputError, Stepping, Toss};
use kinematics_quat::{IntegratedCertificate, QuaternionSolver, TAYLOR};

use crate::answer::Answer;
use crate::choice::{Choice, Decision, How};
use crate::integrators::{TOLERANCES, model};
use crate::registry::Registry;
use crate::scene::{Integrator, Want};

/// What a flight with its bound costs without its calls, and what each call costs (ns), of a coin and of another body, whose
/// bound is computed step by step. `cargo bench --package toss --bench costs` measures them.
const COSTS: [[f64; 2]; 2] = [[1746.0, 8.5], [868.0, 81.4]];

/// Why something has no plan with a proof.
fn refused(why: &'static str) -> InputError {
    InputError::OutsideModel { field: "prove", why }
}

/// The toss of `want` and what its bound is of, if a plan can prove it.
fn question(want: &Want) -> Result<(&Toss, Of), InputError> {
    match want {
        Want::Tilt(toss) => Ok((toss, IntegratedCertificate::error_bound)),
        Want::Attitude(toss) => Ok((toss, IntegratedCertificate::angle_bound)),
        Want::Outcome(_) => Err(refused(
            "a plan proves cos θ or an attitude by integration; an outcome is proven by `QuaternionSolver::certify`, or \
             the command toss with --prove, at whatever tolerance it takes",
        )),
        Want::Trace { .. } => Err(refused(
            "a plan proves cos θ or an attitude by integration; the points of a flight are proven by `trace_enclosed`, or \
             the command trace with --prove, at a tolerance of your choice",
        )),
        Want::Probability(_) => Err(refused(
            "a plan proves cos θ or an attitude by integration; the outcomes of a space are proven by `Proving`, or the \
             command probability with --prove",
        )),
    }
}

/// The proven bound that the accuracy is compared with.
type Of = fn(&IntegratedCertificate) -> f64;

/// The choice of `by`, which is asked for a proof.
///
/// # Errors
/// [`InputError`] for another integrator or scheme than the one that proves, for what is not cos θ or an attitude, and
/// for an accuracy below the bound at the finest tolerance; [`Error::Solve`] as the solver's.
pub(crate) fn plan(registry: &Registry, by: &Integrator, want: &Want, accuracy: f64) -> Result<Decision, Error> {
    let entry = registry.named(&by.solver)?;
    let scheme = by.scheme.as_deref().map_or(Ok(TAYLOR), |name| entry.scheme(name))?;
    if entry.name() != QuaternionSolver::NAME || scheme != TAYLOR {
        return Err(refused("a plan with a proof takes the solver quaternion with the scheme taylor").into());
    }
    let (toss, bound) = question(want)?;
    let [cost_ns, call_ns] = COSTS[usize::from(toss.coin().is_none())];
    for tolerance in TOLERANCES {
        let stepping = Stepping::adaptive(scheme, tolerance)?;
        let found = QuaternionSolver::new(stepping, Formulation::default()).enclose(toss)?;
        if bound(&found) <= accuracy {
            #[expect(clippy::cast_precision_loss, reason = "calls of a flight are fewer than 2^53")]
            let expected_cost_ns = cost_ns + call_ns * found.work().rhs_calls as f64;
            let (how, expected_error) = (How::Proof(stepping), bound(&found));
            let choice = Choice { model: model(), how, expected_error, expected_cost_ns, points: None };
            return Ok(Decision { choice, passed_over: Vec::new() });
        }
    }
    let valid = "at least the bound that an integration at the finest tolerance proves for this flight";
    Err(InputError::OutOfRange { field: "accuracy", value: accuracy, valid }.into())
}

/// The landing with its proven bounds at the tolerance of `stepping`.
pub(crate) fn run(stepping: Stepping, want: &Want) -> Result<Answer, Error> {
    let (toss, _) = question(want)?;
    let solver = QuaternionSolver::new(stepping, Formulation::default());
    Ok(Answer::Enclosed(Box::new(solver.enclose(toss)?)))
}

#[cfg(test)]
pub(crate) mod tests;
