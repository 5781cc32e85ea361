//! Tests of the trait: default methods, pointers, and bodies.

use std::sync::atomic::{AtomicU32, Ordering};

use nalgebra::Vector3;

use super::*;
use crate::attitude::Attitude;
use crate::body::Body;
use crate::checked::Checked;
use crate::coin::Coin;
use crate::launch::Launch;
use crate::time_of_flight::TimeOfFlight;

/// A solver with this error estimate, whose coins land as they were launched.
struct Still(Option<f64>);

impl Solver for Still {
    fn name(&self) -> &str {
        "still"
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
        Ok(Propagation::new(state, Work::default()))
    }

    fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
        Ok(self.0)
    }
}

fn toss(tilt: f64) -> Toss {
    let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
    Toss { coin: Coin::DISC, launch: launch.with_tilt(tilt).unwrap() }
}

#[test]
fn a_landing_keeps_what_it_is_given() {
    let landing = Still(None).propagate(&toss(1.0)).unwrap();
    assert_eq!((landing.norm_error, landing.cos_tilt), (0.0, landing.state.attitude.cos_tilt()));
    let given = landing.with_norm_error(1e-9).with_cos_tilt(0.25);
    assert_eq!((given.norm_error, given.cos_tilt), (1e-9, 0.25));
    let [one, two] = [(1, 2, 3), (10, 20, 30)].map(|(rhs_calls, accepted_steps, rejected_steps)| Work {
        rhs_calls,
        accepted_steps,
        rejected_steps,
    });
    assert_eq!(one + two, Work { rhs_calls: 11, accepted_steps: 22, rejected_steps: 33 });
}

#[test]
fn an_outcome_is_undecided_within_the_error_estimate() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for error in [0.0, 1e-3] {
        let solver = Still(Some(error));
        for (tilt, outcome) in [(0.3, Outcome::Heads), (3.0, Outcome::Tails), (quarter - 2.0 * error, Outcome::Heads)] {
            assert_eq!(solver.cos_tilt(&toss(tilt)), Ok(Attitude::about_x(tilt).cos_tilt()));
            assert_eq!(solver.outcome(&toss(tilt)), Ok(outcome));
        }
        let near = solver.outcome(&toss(quarter - 0.5 * error)).unwrap();
        assert_eq!(near == Outcome::Heads, error == 0.0);
    }
    assert_eq!(Still(None).outcome(&toss(0.3)), Ok(Outcome::Undecided));
}

#[test]
fn by_default_many_tosses_are_solved_one_by_one_also_through_pointers() {
    let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, 3.0], [1.0, 1.5]];
    let tosses = Tosses::new(Coin::DISC, Attitude::about_x(0.3), 9.81, [&x, &y, &z], &speed).unwrap();
    let expected = [Attitude::about_x(0.3).cos_tilt(); 2];
    let still: Arc<dyn Solver> = Arc::new(Still(Some(0.5)));
    let solvers: [Box<dyn Solver>; 3] = [Box::new(Still(Some(0.5))), Box::new(&Still(Some(0.5))), Box::new(still)];
    for solver in solvers {
        let mut found = [f64::NAN; 2];
        solver.cos_tilts(&tosses, &mut found).unwrap();
        assert_eq!(found, expected);
        assert_eq!((solver.name(), solver.stepping()), ("still", None));
        assert_eq!(solver.error_estimate(&toss(0.3)), Ok(Some(0.5)));
        assert_eq!(solver.outcome(&toss(0.3)), Ok(Outcome::Heads));
    }
}

/// Counts the flights of the solver within.
struct Counted(Still, AtomicU32);

impl Solver for Counted {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.propagate(toss)
    }

    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        self.0.error_estimate(toss)
    }
}

#[test]
fn every_question_about_a_toss_takes_one_flight_also_through_pointers_and_the_guard() {
    let [zeros, rates, speeds] = [[0.0; 3], [2.0; 3], [1.0; 3]];
    let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 9.81, [&zeros, &zeros, &rates], &speeds).unwrap();
    let counted = Arc::new(Counted(Still(Some(0.5)), AtomicU32::new(0)));
    let checked: Box<dyn Solver> = Box::new(Checked::new(Arc::clone(&counted)));
    for solver in [&*checked, &counted, &*counted] {
        let flights = |ask: &dyn Fn()| {
            counted.1.store(0, Ordering::Relaxed);
            ask();
            counted.1.load(Ordering::Relaxed)
        };
        assert_eq!(flights(&|| _ = solver.propagate(&toss(0.3)).unwrap()), 1);
        assert_eq!(flights(&|| _ = solver.cos_tilt(&toss(0.3)).unwrap()), 1);
        assert_eq!(flights(&|| _ = solver.outcome(&toss(0.3)).unwrap()), 1);
        assert_eq!(flights(&|| _ = solver.outcome_at(&toss(0.3), 1.0).unwrap()), 0);
        assert_eq!(flights(&|| solver.cos_tilts(&tosses, &mut [0.0; 3]).unwrap()), 3);
    }
}

#[test]
fn a_solver_for_coins_solves_bodies_that_are_coins_and_refuses_others() {
    let rigid = |moments| RigidToss { body: Body::from_moments(moments).unwrap(), launch: toss(0.3).launch };
    let still: Arc<dyn Solver> = Arc::new(Still(Some(0.5)));
    let (coin, brick) = (rigid([1.0, 1.0, 2.0]), rigid([1.0, 1.5, 2.0]));
    for solver in [Box::new(Still(Some(0.5))) as Box<dyn Solver>, Box::new(Checked::new(still))] {
        assert_eq!(solver.propagate_rigid(&coin), solver.propagate(&toss(0.3)));
        assert_eq!(solver.cos_tilt_rigid(&coin), Ok(Attitude::about_x(0.3).cos_tilt()));
        assert_eq!(solver.error_estimate_rigid(&coin), Ok(Some(0.5)));
        assert_eq!(solver.outcome_rigid(&coin), Ok(Outcome::Heads));
        let refused =
            SolveError::NotSymmetric { solver: "still".to_owned(), why: "it has no method for other rigid bodies" };
        assert_eq!(solver.propagate_rigid(&brick), Err(refused.clone()));
        assert_eq!(solver.cos_tilt_rigid(&brick), Err(refused.clone()));
        assert_eq!(solver.error_estimate_rigid(&brick), Err(refused.clone()));
        assert_eq!(solver.outcome_rigid(&brick), Err(refused));
    }
}

#[test]
fn an_invalid_toss_of_many_is_an_error_with_its_index() {
    let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, f64::NAN], [1.0, 1.5]];
    let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
    let error = Still(None).cos_tilts(&tosses, &mut [0.0; 2]).unwrap_err();
    assert_eq!((error.kind(), error.field()), ("input", Some("rate z [rad/s]")));
    assert!(error.to_string().starts_with("launch 1: rate z"), "{error}");
}
