//! Tests of the trait: default methods, pointers, and bodies.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use nalgebra::Vector3;

use super::*;
use crate::attitude::Attitude;
use crate::body::Body;
use crate::checked::Checked;
use crate::coin::Coin;
use crate::columns::Tosses;
use crate::launch::Launch;
use crate::time_of_flight::TimeOfFlight;

/// A solver with this error estimate, whose bodies land as they were launched. It counts its flights.
struct Still(Option<f64>, AtomicU32);

impl Solver for Still {
    fn name(&self) -> &str {
        "still"
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        self.1.fetch_add(1, Ordering::Relaxed);
        let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
        Ok(Landing::new(state, Work::default()).with_error(self.0))
    }
}

fn still(error: Option<f64>) -> Still {
    Still(error, AtomicU32::new(0))
}

fn toss(tilt: f64) -> Toss {
    let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
    Toss::new(Coin::DISC, launch.with_tilt(tilt).unwrap())
}

#[test]
fn an_outcome_is_undecided_within_the_error_estimate() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for error in [0.0, 1e-3] {
        let solver = still(Some(error));
        for (tilt, outcome) in [(0.3, Outcome::Heads), (3.0, Outcome::Tails), (quarter - 2.0 * error, Outcome::Heads)] {
            let found = solver.tilt(&toss(tilt)).unwrap();
            assert_eq!(found, Tilt { cos_tilt: Attitude::about_x(tilt).cos_tilt(), error: Some(error) });
            assert_eq!((found.outcome(), solver.land(&toss(tilt)).unwrap().outcome()), (outcome, outcome));
        }
        let near = solver.tilt(&toss(quarter - 0.5 * error)).unwrap().outcome();
        assert_eq!(near == Outcome::Heads, error == 0.0);
    }
    assert_eq!(still(None).tilt(&toss(0.3)).map(Tilt::outcome), Ok(Outcome::Undecided));
}

#[test]
fn every_question_takes_one_flight_also_through_pointers_and_the_guard() {
    let counted = Arc::new(still(Some(0.5)));
    let checked: Box<dyn Solver> = Box::new(Checked::new(Arc::clone(&counted)));
    let expected = Tilt { cos_tilt: Attitude::about_x(0.3).cos_tilt(), error: Some(0.5) };
    let solvers: [&dyn Solver; 5] = [&counted, &*counted, &checked, &*checked, &&counted];
    for solver in solvers {
        let flights = |ask: &dyn Fn()| {
            counted.1.store(0, Ordering::Relaxed);
            ask();
            counted.1.load(Ordering::Relaxed)
        };
        assert_eq!((solver.name(), solver.stepping()), ("still", None));
        assert_eq!(flights(&|| assert_eq!(solver.land(&toss(0.3)).unwrap().tilt(), expected)), 1);
        assert_eq!(flights(&|| assert_eq!(solver.tilt(&toss(0.3)), Ok(expected))), 1);
        let mut found = [Tilt { cos_tilt: f64::NAN, error: None }; 3];
        let count = counted.1.load(Ordering::Relaxed);
        solver.tilts(&[toss(0.3); 3], &mut found).unwrap();
        assert_eq!((found, counted.1.load(Ordering::Relaxed) - count), ([expected; 3], 3));
    }
}

#[test]
fn a_solver_for_coins_refuses_other_bodies_in_one_line() {
    struct OfCoins;
    impl Solver for OfCoins {
        fn name(&self) -> &str {
            "of coins"
        }
        fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
            let toss = toss.of_coin(self.name(), "it has no method for other rigid bodies")?;
            still(Some(toss.coin.inertia_ratio())).land(&toss.into())
        }
    }
    let rigid = |moments| Toss::new(Body::from_moments(moments).unwrap(), toss(0.3).launch);
    assert_eq!(OfCoins.tilt(&rigid([1.0, 1.0, 2.0])).unwrap().error, Some(2.0));
    let refused =
        SolveError::NotSymmetric { solver: "of coins".to_owned(), why: "it has no method for other rigid bodies" };
    assert_eq!(OfCoins.land(&rigid([1.0, 1.5, 2.0])), Err(refused));
}

#[test]
fn an_invalid_toss_of_many_is_an_error_with_its_index() {
    let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, f64::NAN], [1.0, 1.5]];
    let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
    let error = tosses.each().unwrap_err();
    assert_eq!((error.kind(), error.field()), ("input", Some("rate z [rad/s]")));
    assert!(error.to_string().starts_with("launch 1: rate z"), "{error}");
}
