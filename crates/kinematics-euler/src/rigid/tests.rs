//! Tests of the three angles of any rigid body against the exact motion, in both frames, and of their singular points.

use std::f64::consts::PI;

use dynamics::{Body, Launch, Scheme, Solver, TimeOfFlight};
use exact::ExactMotion;

use super::*;
use crate::{EulerAnglesSolver, GammaSolver};

fn stepping() -> Stepping {
    Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap()
}

fn solver(formulation: Formulation) -> EulerAnglesSolver {
    EulerAnglesSolver::new(stepping(), formulation)
}

fn tosses(time: f64) -> Vec<Toss> {
    let moments = [
        [1.0, 2.0, 2.5],
        [2.5, 1.0, 2.0],
        [2.0, 2.5, 1.0],
        [2.0, 1.0, 2.5],
        [1.0, 2.0, 3.0],
        [1.0, 1.001, 1.002],
        [0.0, 1.0, 1.0],
    ];
    let mut bodies: Vec<Body> = moments.map(|moments| Body::from_moments(moments).unwrap()).into();
    bodies.push(Body::from_tensor([[2.0, 0.3, -0.1], [0.3, 2.2, 0.25], [-0.1, 0.25, 1.4]]).unwrap());
    let rates = [
        [1.0, 2.0, -3.0],
        [-3.0, 0.2, 0.1],
        [0.1, 0.0, 4.0],
        [0.0, 0.0, -2.0],
        [0.0, 3.0, 0.0],
        [2.0, -1.5, 0.0],
        [0.0; 3],
    ];
    let each = |body: &Body| {
        let body = *body;
        rates.into_iter().map(move |rate| Toss { body, launch: Launch::new(rate, TimeOfFlight::Given(time)).unwrap() })
    };
    bodies.iter().flat_map(each).collect()
}

fn errors(toss: &Toss, formulation: Formulation) -> Result<(f64, f64), SolveError> {
    let landing = solver(formulation).land(toss)?.state;
    let exact = ExactMotion::new(toss).state(toss.launch.time_of_flight())?;
    Ok((exact.attitude.angle_to(&landing.attitude), (exact.rate - landing.rate).norm()))
}

#[test]
fn along_the_momentum_no_launch_is_singular() {
    for toss in tosses(3.0) {
        for tilt in [0.0, 1.0, PI] {
            let toss = Toss { launch: toss.launch.with_tilt(tilt).unwrap(), ..toss };
            let (attitude, rate) = errors(&toss, Formulation::MOMENTUM).unwrap();
            let allowed = stepping().error_estimate(&toss).unwrap().unwrap_or(1.0);
            assert!(attitude < allowed && rate < 10.0 * allowed, "{toss:?}: {attitude:e}, {rate:e}, {allowed:e}");
        }
    }
}

/// All but α hardly changes here, and a scheme that takes steps of any length notices none of its errors.
#[test]
fn a_turn_about_one_axis_is_as_accurate_as_the_tolerance_asks() {
    let body = Body::from_moments([0.906, 0.9073, 1.491]).unwrap();
    let launch = Launch::new([27.9, -0.22, 0.0], TimeOfFlight::Given(0.75)).unwrap();
    let toss = Toss { body, launch };
    let exact = ExactMotion::new(&toss).state(launch.time_of_flight()).unwrap().attitude;
    for scheme in [Scheme::DOP853, Scheme::DOPRI5] {
        for tolerance in [1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
            let stepping = Stepping::adaptive(scheme, tolerance).unwrap();
            let landing = EulerAnglesSolver::new(stepping, Formulation::MOMENTUM).land(&toss).unwrap();
            let error = exact.angle_to(&landing.state.attitude);
            assert!(error < 10.0 * tolerance, "{scheme}, {tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn in_the_vertical_frame_a_launch_may_start_at_a_pole() {
    for toss in tosses(0.3) {
        for tilt in [0.0, 0.9, PI] {
            let toss = Toss { launch: toss.launch.with_tilt(tilt).unwrap(), ..toss };
            match errors(&toss, Formulation::VERTICAL) {
                Ok((attitude, rate)) => assert!(attitude < 2e-10 && rate < 2e-10, "{toss:?}: {attitude:e}, {rate:e}"),
                // A tensor whose rate is along n for one moment, and a rod without momentum at a pole of its frame.
                Err(error) => {
                    let along_n = toss.launch.rate().xy() == Vector3::<f64>::zeros().xy();
                    assert!(
                        along_n && toss.body.moments().is_none() && error.kind() == "singular",
                        "{toss:?}: {error}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_return_to_the_vertical_is_an_error_with_its_time() {
    let launch = Launch::new([3.0, 0.0, 0.0], TimeOfFlight::Given(2.0)).unwrap().with_tilt(0.5).unwrap();
    let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch };
    let fixed = Stepping::fixed(Scheme::RK4, 1e-3).unwrap();
    let error = EulerAnglesSolver::new(fixed, Formulation::VERTICAL).land(&toss).unwrap_err();
    let SolveError::Singular { point: Singularity::NormalAlongAxis, time } = error else { panic!("{error}") };
    assert!((time - (PI - 0.5) / 3.0).abs() < 2e-3, "{time}");
}

#[test]
fn equations_for_coins_refuse_other_bodies_and_say_why() {
    let toss = tosses(1.0)[0];
    let gamma: Vec<Box<dyn Solver>> = Formulation::ALL
        .map(|formulation| Box::new(GammaSolver::new(stepping(), formulation)) as Box<dyn Solver>)
        .into();
    let raw: Box<dyn Solver> = Box::new(solver(Formulation::RAW));
    for solver in gamma.into_iter().chain([raw]) {
        let error = solver.land(&toss).unwrap_err();
        let SolveError::NotSymmetric { solver: name, why } = error else { panic!("{error}") };
        assert!(name == solver.name() && why.contains("I1 = I2 and a constant ωz"), "{name}: {why}");
    }
}
