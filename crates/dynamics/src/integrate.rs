//! Integrates an autonomous system y' = f(y) by a Runge-Kutta method of the crate `ode_solvers`, from a start to an end
//! state. All integrators run through this one function, which works around three faults of `ode_solvers` 0.6.2:
//!
//! - Its DOP853 has wrong nodes for systems that depend on time. The trait [`OdeSystem`] therefore has no time.
//! - Its dense output can end in a wrong point. Only the accepted steps are recorded, therefore.
//! - Its RK4 runs past the end of the interval by part of a step, and returns `Ok` with NaN. Steps therefore divide the
//!   interval evenly, and every result is checked to be finite.

use std::cell::Cell;

use nalgebra::SVector;
use ode_solvers::dop_shared::{IntegrationError, OutputType, SolverResult, System};
use ode_solvers::{Dop853, Dopri5, Rk4};

use crate::error::{Singularity, SolveError};
use crate::scheme::Scheme;
use crate::solver::Work;
pub use crate::stepping::STEP_LIMIT;
use crate::stepping::{StepControl, Stepping, step_count};

/// An autonomous system of N first-order equations.
pub trait OdeSystem<const N: usize> {
    /// The largest angle (rad) through which a [`Flight`](crate::Flight) of this system may turn in one step of an
    /// adaptive scheme. A system needs it if its derivative hardly changes in some flights: steps then grow until the
    /// scheme is unstable, and amplifies errors. [`integrate`] does not know how far a flight turns, and has no limit.
    const LARGEST_TURN: f64 = f64::INFINITY;

    /// y' at y.
    fn derivative(&self, y: &SVector<f64, N>) -> SVector<f64, N>;

    /// The singular point that the step from `before` to `after` met, if any. The integration then stops with an error.
    fn singularity(&self, _before: &SVector<f64, N>, _after: &SVector<f64, N>) -> Option<Singularity> {
        None
    }
}

/// The schemes of `ode_solvers`.
#[derive(Debug, Clone, Copy)]
enum RungeKutta {
    Dop853,
    Dopri5,
    Rk4,
}

impl RungeKutta {
    fn of(scheme: Scheme) -> Result<Self, SolveError> {
        match scheme {
            Scheme::DOP853 => Ok(Self::Dop853),
            Scheme::DOPRI5 => Ok(Self::Dopri5),
            Scheme::RK4 => Ok(Self::Rk4),
            other => Err(SolveError::NotOffered { scheme: other.name() }),
        }
    }
}

/// Integrates `system` from `start` over `duration` ≥ 0 (s), and returns the end state and the work.
///
/// The derivatives of `system` are taken with respect to the dimensionless time `scale` × t, where `scale` is a power
/// of two (rad/s); see [`power_of_two_scale`](numerics::scale::power_of_two_scale). Fails with [`SolveError`] with the
/// time (s) at which the integration stopped; [`SolveError::NotOffered`] for a scheme that is not in
/// [`Scheme::RUNGE_KUTTA`].
pub fn integrate<const N: usize>(
    system: &impl OdeSystem<N>,
    start: SVector<f64, N>,
    duration: f64,
    scale: f64,
    stepping: &Stepping,
) -> Result<(SVector<f64, N>, Work), SolveError> {
    integrate_within(system, start, Span { duration, scale, longest: f64::INFINITY }, stepping)
}

/// The time of an integration: `duration` (s), the dimensionless time `scale` × t, and its `longest` step for an
/// adaptive scheme.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    pub(crate) duration: f64,
    pub(crate) scale: f64,
    pub(crate) longest: f64,
}

/// [`integrate`] with a longest step.
pub(crate) fn integrate_within<const N: usize>(
    system: &impl OdeSystem<N>,
    start: SVector<f64, N>,
    span: Span,
    stepping: &Stepping,
) -> Result<(SVector<f64, N>, Work), SolveError> {
    let (run, work) = run(system, start, span, stepping)?;
    Ok((run.get().1.last().copied().unwrap_or(start), work))
}

/// The accepted steps of `ode_solvers`.
type AcceptedSteps<const N: usize> = SolverResult<f64, SVector<f64, N>>;

fn run<const N: usize>(
    system: &impl OdeSystem<N>,
    start: SVector<f64, N>,
    Span { duration, scale, longest }: Span,
    stepping: &Stepping,
) -> Result<(AcceptedSteps<N>, Work), SolveError> {
    let scheme = RungeKutta::of(stepping.scheme())?;
    let end = duration * scale;
    if end == 0.0 {
        return Ok((SolverResult::new(vec![0.0], vec![start]), Work::default()));
    }
    let steps = Steps::new(stepping.control(), duration, end, longest)?;
    let calls = Cell::new(0);
    let met = Cell::new(None);
    let counted = Counted { system, calls: &calls, met: &met, last: start };
    let run = step_through(counted, start, end, scheme, &steps).map_err(|error| in_seconds(&error, scale))?;
    if let Some((point, time)) = met.get() {
        return Err(SolveError::Singular { point, time: time / scale });
    }
    let (times, states) = run.get();
    if !states.last().is_some_and(|last| last.iter().all(|part| part.is_finite())) {
        return Err(SolveError::NotFinite { time: duration });
    }
    let work = work(calls.get(), times.len() as u64 - 1, scheme);
    Ok((run, work))
}

/// The tolerance and the step sizes in dimensionless time, as the steppers of `ode_solvers` take them.
struct Steps {
    tolerance: f64,
    /// The first step; 0 lets the stepper choose.
    first: f64,
    largest: f64,
}

impl Steps {
    fn new(control: StepControl, duration: f64, end: f64, longest: f64) -> Result<Self, SolveError> {
        match control {
            StepControl::Tolerance(tolerance) => Ok(Self { tolerance, first: 0.0, largest: end.min(longest) }),
            StepControl::Step(step) => {
                let count = step_count(duration, step)?;
                // With a tolerance that no error exceeds, an adaptive scheme keeps to its largest step. It is no larger
                // than 1e60 so that the square of its inverse does not underflow.
                Ok(Self { tolerance: 1e60, first: end / count, largest: end / count })
            }
        }
    }
}

/// Runs an adaptive stepper of `ode_solvers` with the controller settings of its own default constructor.
macro_rules! run_adaptive {
    ($stepper:ident, $system:expr, $start:expr, $end:expr, $steps:expr, beta: $beta:expr, factors: $smallest:expr, $largest:expr) => {{
        const SAFETY: f64 = 0.9;
        // The stiffness test is never made. No toss is stiff, but where the state hardly changes, rounding errors can
        // make the test report stiffness.
        const STIFFNESS_TEST_EVERY: u32 = u32::MAX;
        let &Steps { tolerance, first, largest } = $steps;
        let mut stepper = $stepper::from_param(
            $system,
            0.0,
            $end,
            0.0,
            $start,
            tolerance,
            tolerance,
            SAFETY,
            $beta,
            $smallest,
            $largest,
            largest,
            first,
            STEP_LIMIT,
            STIFFNESS_TEST_EVERY,
            OutputType::Sparse,
        );
        stepper.integrate()?;
        Ok(stepper.into())
    }};
}

fn step_through<const N: usize, S: OdeSystem<N>>(
    system: Counted<'_, N, S>,
    start: SVector<f64, N>,
    end: f64,
    scheme: RungeKutta,
    steps: &Steps,
) -> Result<AcceptedSteps<N>, IntegrationError> {
    match scheme {
        RungeKutta::Dop853 => run_adaptive!(Dop853, system, start, end, steps, beta: 0.0, factors: 0.333, 6.0),
        RungeKutta::Dopri5 => run_adaptive!(Dopri5, system, start, end, steps, beta: 0.04, factors: 0.2, 10.0),
        RungeKutta::Rk4 => {
            // The stepper takes ⌈end/step⌉ steps. An end that is half a step earlier keeps rounding from adding one.
            let mut stepper = Rk4::new(system, 0.0, start, end - 0.5 * steps.first, steps.first);
            stepper.integrate()?;
            Ok(stepper.into())
        }
    }
}

/// Adapts a system to the interface of `ode_solvers`. It counts the calls, and looks for a singular point after each
/// step.
struct Counted<'a, const N: usize, S> {
    system: &'a S,
    calls: &'a Cell<u64>,
    met: &'a Cell<Option<(Singularity, f64)>>,
    last: SVector<f64, N>,
}

impl<const N: usize, S: OdeSystem<N>> System<f64, SVector<f64, N>> for Counted<'_, N, S> {
    fn system(&self, _time: f64, y: &SVector<f64, N>, dy: &mut SVector<f64, N>) {
        self.calls.set(self.calls.get() + 1);
        *dy = self.system.derivative(y);
    }

    fn solout(&mut self, time: f64, y: &SVector<f64, N>, _dy: &SVector<f64, N>) -> bool {
        self.met.set(self.system.singularity(&self.last, y).map(|point| (point, time)));
        self.last = *y;
        self.met.get().is_some()
    }
}

/// The work of a run, derived from its number of calls, because `ode_solvers` does not count the rejections before the
/// first accepted step. A run begins with at most three extra calls. A step takes more, so that the integer division
/// drops them.
fn work(rhs_calls: u64, accepted_steps: u64, scheme: RungeKutta) -> Work {
    let tried_steps = match scheme {
        // A tried step takes 11 calls, and one more if it is accepted.
        RungeKutta::Dop853 => (rhs_calls - accepted_steps) / 11,
        RungeKutta::Dopri5 => rhs_calls / 6,
        RungeKutta::Rk4 => rhs_calls / 4,
    };
    Work { rhs_calls, accepted_steps, rejected_steps: tried_steps - accepted_steps }
}

fn in_seconds(error: &IntegrationError, scale: f64) -> SolveError {
    match *error {
        IntegrationError::MaxNumStepReached { x, .. } => SolveError::StepLimit { time: x / scale, limit: STEP_LIMIT },
        IntegrationError::StepSizeUnderflow { x } | IntegrationError::StiffnessDetected { x } => {
            SolveError::StepSizeUnderflow { time: x / scale }
        }
    }
}

#[cfg(test)]
mod tests;
