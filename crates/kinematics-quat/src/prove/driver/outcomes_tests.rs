//! Tests of outcomes alone, which coarse flights decide first.

use dynamics::{Attitude, Body, Coin, Formulation, Launch, Scheme, Stepping, Tilt, TimeOfFlight};

use super::tests::solver;
use super::*;

/// Tosses of about this phase; every second one lands about as near to the edge as coarse flights are off.
fn tosses(phase: f64) -> Vec<Toss> {
    let toss = |index: u32| {
        let part = |square: f64| (f64::from(index) * square.sqrt()).fract();
        let coin = Coin::from_moments(1.0, 2.0 * part(2.0)).unwrap();
        let at = |time| {
            let launch = Launch::new([part(3.0) + 0.1, part(5.0), part(7.0)], TimeOfFlight::Given(time)).unwrap();
            CoinToss { coin, launch: launch.with_tilt(3.0 * part(11.0)).unwrap() }
        };
        let cos_tilt = |time| exact::certified::cos_tilt(&at(time)).unwrap();
        let (mut before, mut after) = (phase * (0.5 + 0.5 * part(13.0)), phase * 1.5);
        let first = cos_tilt(before) > 0.0;
        if index.is_multiple_of(2) || (cos_tilt(after) > 0.0) == first {
            return at(before).into();
        }
        while after - before > 10f64.powf(-9.0 * part(17.0)) {
            let middle = f64::midpoint(before, after);
            if (cos_tilt(middle) > 0.0) == first { before = middle } else { after = middle }
        }
        at(before).into()
    };
    (0..400).map(toss).collect()
}

fn outcomes(solver: &QuaternionSolver, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Outcome, SolveError>> {
    solver.decide(tosses, level).into_iter().map(|found| found.map(|found| found.outcome)).collect()
}

#[test]
fn outcomes_are_those_of_the_certificates_at_every_simd_level() {
    let solver = solver(1e-10);
    for phase in [30.0, 300.0, 3000.0] {
        let tosses = tosses(phase);
        let expected: Vec<_> = tosses.iter().map(|toss| solver.certify(toss).map(|found| found.outcome())).collect();
        for level in SimdLevel::all() {
            assert_eq!(outcomes(&solver, &tosses, level), expected, "{}", level.name());
        }
        let decided = solver.proven(&tosses, SimdLevel::widest(), &[Stage::Coarse]);
        let is_open = |found: &&Certified| found.as_ref().unwrap().outcome == Outcome::Undecided;
        let open = decided.iter().filter(is_open).count();
        assert!((5..200).contains(&open), "phase {phase}: coarse flights leave {open} of 400 open");
    }
}

/// A body that is as near to its edge as the last digit tells, whose certificate has a cos θ within its bound.
#[test]
fn an_undecided_body_has_no_cos_tilt() {
    let nearly = Attitude::from_components([1.0, 1.0 + f64::EPSILON, 0.0, 0.0]).unwrap();
    let launch = Launch::new([0.0, 7.0, 0.0], TimeOfFlight::Given(0.3)).unwrap().with_attitude(nearly);
    let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch };
    let certificate = solver(1e-9).certify(&toss).unwrap();
    assert!(certificate.outcome() == Outcome::Undecided && certificate.cos_tilt() != 0.0, "{certificate:?}");
    let decided = solver(1e-9).decide(&[toss], SimdLevel::for_one_lane()).remove(0).unwrap();
    assert_eq!((decided.outcome, decided.tilt()), (Outcome::Undecided, Tilt { cos_tilt: 0.0, error: Some(2.0) }));
}

#[test]
fn ties_stay_undecided_and_errors_are_those_of_the_certificates() {
    let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    let launch = |time| Launch::new([0.0, 7.0, 0.0], TimeOfFlight::Given(time)).unwrap().with_attitude(edge);
    let tosses = [1.0, 0.0, 1e17].map(|time| Toss::new(Coin::DISC, launch(time)));
    let found = outcomes(&solver(1e-9), &tosses, SimdLevel::widest());
    assert_eq!(found[..2], [Ok(Outcome::Undecided), Ok(Outcome::Undecided)]);
    assert!(matches!(found[2], Err(SolveError::PhaseTooLarge { .. })));
    let heads = Toss::new(Coin::DISC, Launch::new([0.5, 0.25, 9.0], TimeOfFlight::Given(1.0)).unwrap());
    // A solver that is as coarse as a coarse flight needs no other one.
    let decided = solver(COARSE).decide(&[heads], SimdLevel::widest()).remove(0).unwrap();
    assert_eq!((decided.outcome, decided.stage), (Outcome::Heads, Stage::F64));
    // A solver that proves nothing has no outcome of a coarse flight either.
    let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
    for stepping in [Stepping::DEFAULT, taylor] {
        let raw = QuaternionSolver::new(stepping, Formulation::RAW);
        for refused in raw.decide(&[tosses[0], heads], SimdLevel::widest()) {
            assert!(matches!(refused, Err(SolveError::NotProven { .. })), "{refused:?}");
        }
    }
    assert_eq!(outcomes(&solver(1e-2), &tosses[..1], SimdLevel::widest()), [Ok(Outcome::Undecided)]);
}
