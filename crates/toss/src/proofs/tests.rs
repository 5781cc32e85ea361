//! Tests of plans with a proof.

use dynamics::catalogue::named_body;
use dynamics::{Attitude, Body, Coin, Launch, SolveError, StepControl, TimeOfFlight};
use exact::ExactMotion;

use super::*;
use crate::scene::Scene;

/// Numbers in [0, 1), the same in every run (S. Vigna, splitmix64).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    pub(crate) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

/// A toss of a coin, a racket or a brick, of up to some hundred radians.
pub(crate) fn toss(numbers: &mut Numbers) -> Toss {
    let body = match (3.0 * numbers.next()) as usize {
        0 => Coin::from_moments(1.0, numbers.between(0.0, 2.0)).unwrap().into(),
        1 => named_body("racket").unwrap(),
        _ => Body::from_moments([13.0, 10.0, 5.0]).unwrap(),
    };
    let rate = [0; 3].map(|_| numbers.between(-30.0, 30.0));
    let time = TimeOfFlight::Given(10f64.powf(numbers.between(-2.0, 1.0)));
    Toss { body, launch: Launch::new(rate, time).unwrap().with_tilt(numbers.between(-3.0, 3.0)).unwrap() }
}

/// Whether `want` is proven to within `accuracy` at a tolerance.
fn serves(want: &Want, accuracy: f64, tolerance: f64) -> bool {
    let Ok(Answer::Enclosed(found)) = run(Stepping::adaptive(TAYLOR, tolerance).unwrap(), want) else {
        panic!("{want:?} at {tolerance:e}")
    };
    question(want).unwrap().1(&found) <= accuracy
}

#[test]
fn planned_flights_prove_what_was_asked_for_at_the_coarsest_tolerance_that_does() {
    let (mut numbers, mut found, mut refused) = (Numbers(1), 0, 0);
    for index in 0..1000 {
        let (toss, accuracy) = (toss(&mut numbers), 10f64.powf(-numbers.between(1.0, 14.0)));
        let want = if index % 2 == 0 { Want::Tilt(toss) } else { Want::Attitude(toss) };
        let scene = Scene::new(want, accuracy).proven();
        let choice = match scene.plan() {
            Ok(decision) => decision.choice,
            Err(error) => {
                assert!(matches!(&error, Error::Input(InputError::OutOfRange { field: "accuracy", .. })), "{error}");
                assert!(TOLERANCES.iter().all(|tolerance| !serves(&scene.want, accuracy, *tolerance)));
                refused += 1;
                continue;
            }
        };
        let How::Proof(stepping) = &choice.how else { panic!("{choice:?}") };
        let Answer::Enclosed(answer) = choice.run(&scene).unwrap() else { panic!("{choice:?}") };
        let motion = ExactMotion::new(&toss);
        let time = toss.launch.time_of_flight();
        let (bound, error) = if index % 2 == 0 {
            (answer.error_bound(), (answer.cos_tilt() - motion.cos_tilt(time).unwrap()).abs())
        } else {
            let attitude: Attitude = motion.state(time).unwrap().attitude;
            (answer.angle_bound(), answer.landing().state.attitude.angle_to(&attitude))
        };
        assert!(error <= bound && bound <= accuracy, "{error:e}, {bound:e}, {accuracy:e}: {toss:?}");
        assert_eq!((bound, scene.solve().unwrap()), (choice.expected_error, Answer::Enclosed(answer)));
        let StepControl::Tolerance(tolerance) = stepping.control() else { panic!("{stepping:?}") };
        let coarser = TOLERANCES.iter().rev().find(|coarser| **coarser > tolerance);
        assert!(coarser.is_none_or(|coarser| !serves(&scene.want, accuracy, *coarser)), "{tolerance:e}: {toss:?}");
        assert!(choice.expected_cost_ns > 0.0);
        found += 1;
    }
    assert!(found > 800 && refused > 20, "{found} planned, {refused} refused");
}

#[test]
fn what_a_plan_cannot_prove_is_refused_with_a_sentence() {
    let toss = toss(&mut Numbers(2));
    let refusal = |scene: Scene| match scene.plan().unwrap_err() {
        Error::Input(InputError::OutsideModel { field: "prove", why }) => why,
        other => panic!("{other}"),
    };
    for (want, names) in
        [(Want::Outcome(toss), "QuaternionSolver::certify"), (Want::Trace { toss, points: 5 }, "trace_enclosed")]
    {
        assert!(refusal(Scene::new(want, 1e-6).proven()).contains(names));
    }
    let by = |solver: &str, scheme| {
        let mut scene = Scene::new(Want::Tilt(toss), 1e-6).by(solver, scheme);
        scene.by.as_mut().unwrap().prove = true;
        scene
    };
    for scene in [by("gamma", None), by("quaternion", Some("dop853"))] {
        assert!(refusal(scene).contains("scheme taylor"));
    }
    assert!(matches!(by("exact", None).plan(), Err(Error::Input(InputError::OutsideModel { .. }))));
    assert!(matches!(by("magic", None).plan(), Err(Error::Input(InputError::UnknownName { .. }))));
    let far = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(1e17)).unwrap();
    let far = Want::Tilt(Toss { launch: far, ..toss });
    assert!(matches!(Scene::new(far, 1e-6).proven().plan(), Err(Error::Solve(SolveError::PhaseTooLarge { .. }))));
}
