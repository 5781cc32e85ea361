//! Tests of proofs by integration.

use dynamics::{Body, Coin, Formulation, Launch, Scheme, Stepping, TimeOfFlight, Unit};
use exact::certify;
use nalgebra::Vector3;

use super::rigid_tests::shares;
use super::*;

pub(super) fn solver(tolerance: f64) -> QuaternionSolver {
    QuaternionSolver::new(Stepping::adaptive(Scheme::TAYLOR, tolerance).unwrap(), Formulation::default())
}

/// Numbers in [0, 1) from a linear congruential generator.
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2f64.powi(53)
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

/// A random toss whose phase is about this large.
pub(super) fn random(numbers: &mut Numbers, phase: f64) -> Toss {
    let coin = Coin::from_moments(1.0, numbers.between(0.0, 2.0)).unwrap();
    let rate = Vector3::from_fn(|_, _| numbers.between(-1.0, 1.0));
    let time = TimeOfFlight::Ballistic { speed: phase * numbers.between(0.5, 1.0), gravity: numbers.between(1.0, 3.0) };
    let launch = Launch::new(rate, time).unwrap().with_tilt(numbers.between(-3.0, 3.0)).unwrap();
    Toss::new(coin, launch)
}

/// A tilt leaves one part of the vertical seen from the coin 0, other attitudes do not.
#[test]
fn from_any_attitude_the_height_is_that_of_the_exact_motion_in_every_arithmetic() {
    let (numbers, solver) = (&mut Numbers(11), solver(1e-9));
    for phase in [1.0, 30.0, 300.0].into_iter().cycle().take(60) {
        let attitude = Attitude::from_components([0; 4].map(|_| numbers.between(-1.0, 1.0))).unwrap();
        let toss = random(numbers, phase);
        let toss = Toss { launch: toss.launch.with_attitude(attitude), ..toss };
        let coin = toss.coin().unwrap();
        let exact = exact::certified::cos_tilt(&coin).unwrap();
        let flown = solver.certify(&toss).unwrap();
        let fine = digits::in_double_double(&coin).unwrap();
        let finest = digits::in_digits(&coin, 192).unwrap();
        for (found, bound) in [
            (flown.cos_tilt(), flown.error_bound()),
            (fine.cos_tilt, fine.cos_bound),
            (finest.cos_tilt, finest.cos_bound),
        ] {
            assert!((found - exact).abs() <= bound + 4.0 * UNIT_ROUNDOFF && bound < 1e-6, "{toss:?}: {found} {exact}");
        }
        // One rounding of cos θ is most of the bound in more digits, and those of the launch are of the attitude's.
        for landing in [fine, finest] {
            let stated = by_digits(&coin, landing, Stage::MoreDigits).unwrap();
            assert!(
                (1.0..1.02).contains(&(landing.cos_bound / (UNIT_ROUNDOFF * landing.cos_tilt.abs()))),
                "{landing:?}"
            );
            assert!((1.0..1.01).contains(&(stated.attitude_error_bound() / OF_ATTITUDE)), "{stated:?}");
            let calls = u64::from(landing.steps) * landing.order as u64;
            assert_eq!((stated.work().rhs_calls, stated.work().accepted_steps), (calls, u64::from(landing.steps)));
        }
        let turn = [0; 4].map(|_| numbers.between(-3.0, 3.0));
        let turned = Attitude::from_components(turn).unwrap().body_to_lab(&Vector3::z());
        let ([a, b, c], size) = attitude.vertical();
        let height = (a * turned.x + b * turned.y + c * turned.z) / size;
        assert!((cos_tilt(attitude, turn) - height).abs() < 1e-15, "{attitude:?} {turn:?}");
    }
}

#[test]
fn a_flight_of_no_time_has_the_roundings_of_its_launch_alone() {
    let quarter = Unit::TURN.times(0.25);
    let launch = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(0.0)).unwrap();
    let [right, three] = [launch.with_tilt(quarter).unwrap(), launch.with_tilt(-3.0).unwrap()];
    for (launch, tilt) in [(launch, 0.0), (right, 0.5 * std::f64::consts::PI), (three, 3.0)] {
        for body in [Coin::PAPER.into(), Body::from_moments([1.0, 2.0, 2.5]).unwrap()] {
            let found = solver(1e-9).enclose(&Toss { body, launch }).unwrap();
            let bounds = [found.error_bound(), found.attitude_error_bound()].map(|bound| bound / UNIT_ROUNDOFF);
            approx::assert_relative_eq!(bounds[0], 20.0, max_relative = 1e-12);
            approx::assert_relative_eq!(bounds[1], 24.0 + tilt, max_relative = 1e-12);
        }
    }
}

/// A toss whose cos θ at landing is about `margin`, after ten turns and a quarter.
fn near_edge(margin: f64) -> Toss {
    let ten_turns = 20.0 * std::f64::consts::PI / 1.61_f64.sqrt();
    let (mut early, mut late) = (ten_turns, ten_turns + 2.0);
    let toss = |time| {
        let launch = Launch::new([1.0, 0.5, 0.3], TimeOfFlight::Given(time)).unwrap();
        CoinToss { coin: Coin::DISC, launch }
    };
    for _ in 0..200 {
        let middle = f64::midpoint(early, late);
        let heads = exact::certified::cos_tilt(&toss(middle)).unwrap() > 0.0;
        if heads { early = middle } else { late = middle }
    }
    toss(early - margin).into()
}

#[test]
fn undecided_outcomes_are_decided_by_the_next_integration() {
    for (margin, stage) in [
        (1e-2, Stage::F64),
        (1e-11, Stage::Finest),
        (1e-14, Stage::DoubleDouble),
        (0.0, Stage::DoubleDouble),
        (-1e-14, Stage::DoubleDouble),
    ] {
        let toss = near_edge(margin);
        let found = solver(1e-5).certify(&toss).unwrap();
        assert_eq!(found.stage(), stage, "{margin}: {found:?}");
        assert_eq!(found.outcome(), certify(&toss).unwrap().outcome(), "{margin}");
        assert!(found.cos_tilt().abs() > found.error_bound());
        assert!(shares(&found, &toss).into_iter().all(|share| share <= 1.0), "{margin}");
        let first = solver(1e-5).enclose(&toss).unwrap().work().accepted_steps;
        assert_eq!(found.work().accepted_steps > first, stage != Stage::F64);
    }
}

#[test]
fn more_digits_decide_what_double_double_does_not_and_leave_ties() {
    let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    let toss = |rate: [f64; 3], time| {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss::new(Coin::DISC, launch.with_attitude(edge))
    };
    let solver = solver(1e-10);
    for rate in [1e-40, -1e-40] {
        // The coin is on its edge but for a turn of 1e-40 rad.
        let toss = toss([rate, 7.0, 0.0], 1.0);
        let found = solver.certify(&toss).unwrap();
        assert_eq!((found.stage(), found.outcome()), (Stage::MoreDigits, certify(&toss).unwrap().outcome()));
        assert_ne!(found.outcome(), Outcome::Undecided);
    }
    for tie in [toss([0.0, 7.0, 0.0], 1.0), toss([0.0; 3], 1.0), toss([1.0, 2.0, 3.0], 0.0)] {
        let found = solver.certify(&tie).unwrap();
        assert_eq!((found.outcome(), certify(&tie).unwrap().outcome()), (Outcome::Undecided, Outcome::Undecided));
        assert!(found.error_bound() < 1e-200);
    }
}

#[test]
fn what_proves_nothing_refuses_to() {
    let toss = random(&mut Numbers(1), 1.0);
    let book = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), ..toss };
    for (scheme, formulation, why) in [
        (Scheme::TAYLOR, Formulation::RAW, "division by the norm"),
        (Scheme::DOP853, Formulation::RAW, "division by the norm"),
        (Scheme::DOP853, Formulation::MOMENTUM, "only the scheme taylor"),
    ] {
        let solver = QuaternionSolver::new(Stepping::adaptive(scheme, 1e-9).unwrap(), formulation);
        let refused = solver.certify(&toss).unwrap_err();
        assert!(matches!(refused, SolveError::NotProven { .. }) && refused.to_string().contains(why), "{refused}");
        assert_eq!(solver.enclose(&toss).unwrap_err(), refused);
        assert_eq!(solver.enclose(&book).unwrap_err(), refused);
        assert_eq!(solver.decide(&[toss, book], SimdLevel::widest()), [Err(refused.clone()), Err(refused)]);
    }
    let too_long = Toss { launch: Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1e17)).unwrap(), ..toss };
    assert!(matches!(solver(1e-9).certify(&too_long), Err(SolveError::PhaseTooLarge { .. })));
}
