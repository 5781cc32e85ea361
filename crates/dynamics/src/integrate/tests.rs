//! Tests of the integration driver on small systems with known solutions: every method has to reach the end, count its
//! calls, and report the time of an error in seconds. The faults of `ode_solvers` would show here first.

use nalgebra::{Vector1, Vector2};

use super::*;
use crate::scheme::Scheme;

/// y' = i y as a real system: the state turns by the angle t.
struct Circle;
impl OdeSystem<2> for Circle {
    fn derivative(&self, y: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(-y.y, y.x)
    }
}

/// y' = y², which from y = 1 grows beyond every bound as t approaches 1.
struct Explosion;
impl OdeSystem<1> for Explosion {
    fn derivative(&self, y: &Vector1<f64>) -> Vector1<f64> {
        Vector1::new(y.x * y.x)
    }
}

fn methods() -> [Stepping; 5] {
    [
        Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap(),
        Stepping::adaptive(Scheme::DOPRI5, 1e-12).unwrap(),
        Stepping::fixed(Scheme::RK4, 1e-3).unwrap(),
        Stepping::fixed(Scheme::DOP853, 0.1).unwrap(),
        Stepping::fixed(Scheme::DOPRI5, 3e-3).unwrap(),
    ]
}

#[test]
fn every_method_ends_exactly_at_the_end_of_the_interval() {
    // 2.0005 s is not a multiple of any step.
    for method in methods() {
        let (end, work) = integrate(&Circle, Vector2::x(), 2.0005, 1.0, &method).unwrap();
        let error = (end - Vector2::new(2.0005_f64.cos(), 2.0005_f64.sin())).norm();
        assert!(error < 1e-11, "{method:?}: {error:e}");
        assert!(work.accepted_steps > 0);
    }
}

#[test]
fn calls_are_counted_exactly() {
    let per_tried_step = [12, 6, 4, 12, 6];
    for (method, per_step) in methods().iter().zip(per_tried_step) {
        let (_, work) = integrate(&Circle, Vector2::x(), 2.0, 1.0, method).unwrap();
        let tried = work.accepted_steps + work.rejected_steps;
        let setup = work.rhs_calls + if per_step == 12 { work.rejected_steps } else { 0 } - per_step * tried;
        let expected = match method.control() {
            _ if method.scheme() == Scheme::RK4 => 0,
            StepControl::Tolerance(_) => 3,
            StepControl::Step(_) => 1,
        };
        assert_eq!(setup, expected, "{method:?}: {work:?}");
    }
}

#[test]
fn a_fixed_step_is_kept_by_every_scheme() {
    for scheme in Scheme::RUNGE_KUTTA {
        for steps in 1..200_u32 {
            let method = Stepping::fixed(scheme, 3.0 / f64::from(steps)).unwrap();
            let (_, work) = integrate(&Circle, Vector2::x(), 3.0, 1.0, &method).unwrap();
            assert_eq!((work.accepted_steps, work.rejected_steps), (steps.into(), 0), "{scheme:?}");
        }
    }
}

#[test]
fn a_system_that_explodes_is_an_error_for_every_method() {
    for method in methods() {
        let result = integrate(&Explosion, Vector1::new(1.0), 1.5, 1.0, &method);
        assert!(
            matches!(result, Err(SolveError::NotFinite { .. } | SolveError::StepSizeUnderflow { .. })),
            "{method:?}: {result:?}"
        );
    }
}

#[test]
fn refuses_a_scheme_that_is_no_runge_kutta_scheme() {
    let method = Stepping::adaptive(Scheme::new("taylor", None).adaptive(), 1e-9).unwrap();
    let refused = Err(SolveError::NotOffered { scheme: "taylor" });
    assert_eq!(integrate(&Circle, Vector2::x(), 1.0, 1.0, &method), refused);
}

/// The circle, with a singular point at every crossing of the axis x = 0.
struct Watched;

impl OdeSystem<2> for Watched {
    fn derivative(&self, y: &Vector2<f64>) -> Vector2<f64> {
        Circle.derivative(y)
    }

    fn singularity(&self, before: &Vector2<f64>, after: &Vector2<f64>) -> Option<Singularity> {
        (before.x * after.x < 0.0).then_some(Singularity::PrecessionTooSlow)
    }
}

#[test]
fn the_first_singular_point_ends_the_run_with_its_time_in_seconds() {
    let method = Stepping::fixed(Scheme::RK4, 1e-3).unwrap();
    let error = integrate(&Watched, Vector2::x(), 2.0, 4.0, &method).unwrap_err();
    let SolveError::Singular { point: Singularity::PrecessionTooSlow, time } = error else { panic!("{error}") };
    let quarter = std::f64::consts::FRAC_PI_2 / 4.0;
    assert!(quarter <= time && time <= quarter + 1e-3, "{time}");
}

#[test]
fn errors_report_the_time_in_seconds() {
    let method = Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap();
    let error = integrate(&Explosion, Vector1::new(1.0), 1.5, 4.0, &method).unwrap_err();
    let SolveError::StepSizeUnderflow { time } = error else { panic!("{error}") };
    assert!((time - 0.25).abs() < 1e-6, "{time}");
    // The conversion alone is tested, because a run of a million steps would take long.
    let too_many = IntegrationError::MaxNumStepReached { x: 10.0, n_step: STEP_LIMIT };
    assert_eq!(in_seconds(&too_many, 4.0), SolveError::StepLimit { time: 2.5, limit: STEP_LIMIT });
}
