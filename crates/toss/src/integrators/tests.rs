//! Tests of plans by an integrator.

use dynamics::{Attitude, Coin, Landing, Launch, State, StepControl, Vector3, Work};
use kinematics_quat::QuaternionSolver;

use super::*;
use crate::proofs::tests::{Numbers, toss};

/// The tolerance of a choice.
fn tolerance(choice: &Choice) -> f64 {
    match &choice.how {
        How::Integrator(_, stepping) => match stepping.control() {
            StepControl::Tolerance(tolerance) => tolerance,
            StepControl::Step(_) => panic!("{choice:?}"),
        },
        _ => panic!("{choice:?}"),
    }
}

/// The error of an answer against the exact motion. The angle φ between attitudes is measured in another way than by the plan:
/// the images of three axes are off by |Δ|² = 8 sin²(φ/2) together.
fn error(answer: &Answer, toss: &Toss) -> f64 {
    let motion = exact::ExactMotion::new(toss);
    let angle = |time: TimeOfFlight, attitude: &Attitude| {
        let exact = motion.state(time).unwrap().attitude;
        let off = |axis| (exact.body_to_lab(&axis) - attitude.body_to_lab(&axis)).norm_squared();
        let off = off(Vector3::x()) + off(Vector3::y()) + off(Vector3::z());
        2.0 * (off / 8.0).sqrt().asin()
    };
    match answer {
        Answer::Tilt(cos_tilt) => (cos_tilt - motion.cos_tilt(toss.launch.time_of_flight()).unwrap()).abs(),
        Answer::Attitude(state) => angle(toss.launch.time_of_flight(), &state.attitude),
        Answer::Trace(points) => {
            let angles = points.iter().map(|point| angle(TimeOfFlight::Given(point.time), &point.attitude));
            angles.fold(0.0, f64::max)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn planned_flights_of_any_body_keep_their_accuracy_at_the_coarsest_tolerance_that_does() {
    let (mut numbers, mut found, mut refused) = (Numbers(3), 0, 0);
    for index in 0..600 {
        let (toss, accuracy) = (toss(&mut numbers), 10f64.powf(-numbers.between(1.0, 15.0)));
        let want = match index % 3 {
            0 => Want::Tilt(toss),
            1 => Want::Attitude(toss),
            _ => Want::Trace { toss, points: 4 },
        };
        let (solver, scheme) =
            [("euler", "dop853"), ("quaternion", "dopri5"), ("quaternion", "taylor")][(3.0 * numbers.next()) as usize];
        let is_for_gamma = solver == "euler" && toss.body.coin().is_some() && index % 2 == 0;
        let solver = if is_for_gamma { "gamma" } else { solver };
        let scene = Scene::new(want, accuracy).by(solver, Some(scheme));
        let choice = match scene.plan() {
            Ok(decision) => decision.choice,
            Err(error) => {
                assert!(matches!(&error, Error::Input(InputError::OutOfRange { field: "accuracy", .. })), "{error}");
                assert!(accuracy < 1e-8, "{accuracy:e}: {toss:?}");
                refused += 1;
                continue;
            }
        };
        let off = error(&choice.run(&scene).unwrap(), &toss);
        assert!(off <= choice.expected_error && choice.expected_error <= accuracy, "{off:e} {accuracy:e}: {toss:?}");
        let How::Integrator(entry, stepping) = &choice.how else { panic!("{choice:?}") };
        // The next coarser tolerance is off by more, or by so little less that the error of the exact motion counts.
        if let Some(coarser) = TOLERANCES.iter().rev().find(|coarser| **coarser > tolerance(&choice)) {
            let stepping = Stepping::adaptive(stepping.scheme(), *coarser).unwrap();
            let off = integrated(entry, stepping, &scene.want).map_or(f64::INFINITY, |answer| error(&answer, &toss));
            assert!(off > accuracy - 2.0 * ATTITUDE_ERROR, "{coarser:e}: {off:e} {accuracy:e}: {toss:?}");
        }
        assert!(choice.expected_cost_ns > 0.0);
        found += 1;
    }
    assert!(found > 450 && refused > 10, "{found} planned, {refused} refused");
}

/// The quaternion, turned about x by an angle too far. It claims to have no error, and refuses a toss about z.
struct Off(QuaternionSolver, f64);

impl Solver for Off {
    fn name(&self) -> &'static str {
        "off"
    }
    fn stepping(&self) -> Option<Stepping> {
        self.0.stepping()
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let toss = toss.of_coin(self.name(), "it is for coins alone")?;
        if toss.launch.rate().x == 0.0 {
            return Err(SolveError::NotFinite { time: 0.5 });
        }
        let State { attitude, rate } = self.0.land(&toss.into())?.state;
        let ([w, x, y, z], (sin, cos)) = (attitude.components(), (0.5 * self.1).sin_cos());
        let turned = [cos * w - sin * x, cos * x + sin * w, cos * y - sin * z, cos * z + sin * y];
        let turned = Attitude::from_components(turned).unwrap();
        Ok(Landing::new(State::new(turned, rate), Work::default()).with_error(0.0))
    }
}

/// A registry with the solver `off`.
fn registry(angle: f64) -> Registry {
    let entry = SolverEntry::new("off", "a quaternion that is off", move |settings| {
        Box::new(Off(QuaternionSolver::new(settings.stepping, settings.formulation), angle))
    });
    Registry::standard().with(entry.with_schemes(&[Scheme::DOP853])).unwrap()
}

fn thrown(rate: [f64; 3]) -> Toss {
    Toss::new(Coin::PAPER, Launch::new(rate, TimeOfFlight::Given(0.6)).unwrap())
}

/// The error estimate is 0, so that the error against the exact motion alone refuses what is off.
#[test]
fn an_integrator_from_elsewhere_is_planned_down_to_its_error_and_no_further() {
    let (toss, registry) = (thrown([9.0, 1.0, 2.5]), registry(1e-4));
    for want in [Want::Outcome(toss), Want::Tilt(toss), Want::Attitude(toss), Want::Trace { toss, points: 3 }] {
        let choice = Scene::new(want.clone(), 1e-2).by("off", None).plan_with(&registry).unwrap().choice;
        assert!(tolerance(&choice) <= 1e-3 && choice.expected_error < 1e-2 && choice.expected_cost_ns > 0.0);
        let scene = Scene::new(want, 1e-6).by("off", None);
        assert_eq!(scene.plan_with(&registry).unwrap_err().field(), Some("accuracy"));
        let offers = scene.candidates(&registry).unwrap();
        let of_off = offers.iter().find(|(candidate, _)| candidate.to_string() == "off/dop853");
        // A trace turns it at each of its points.
        let Some((_, Err(Reason::TooRough { expected_error }))) = of_off else { panic!("{of_off:?}") };
        assert!((1e-5..=3.1e-4).contains(expected_error), "{expected_error:e}");
        assert!(offers.iter().any(|(candidate, offer)| candidate.to_string() == "quaternion/taylor" && offer.is_ok()));
    }
}

#[test]
fn what_an_integrator_does_not_solve_is_refused_with_its_own_error() {
    let refused = |scene: Scene| scene.plan_with(&registry(0.0)).unwrap_err();
    let about_z = Scene::new(Want::Tilt(thrown([0.0, 0.0, 5.0])), 1e-3);
    assert_eq!(refused(about_z.clone().by("off", None)), SolveError::NotFinite { time: 0.5 }.into());
    let offers = about_z.candidates(&registry(0.0)).unwrap();
    assert!(offers.iter().any(|(_, offer)| matches!(offer, Err(Reason::Fails(Error::Solve(_))))));
    let racket = Toss { body: "racket".parse().unwrap(), ..thrown([1.0, 12.0, 2.5]) };
    for solver in ["gamma", "off"] {
        let error = refused(Scene::new(Want::Attitude(racket), 1e-3).by(solver, None));
        assert!(matches!(error, Error::Solve(SolveError::NotSymmetric { .. })), "{error}");
    }
    let far = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(1e17)).unwrap();
    let far = Scene::new(Want::Tilt(Toss { launch: far, ..racket }), 1e-3).by("euler", None);
    assert!(matches!(refused(far), Error::Solve(SolveError::PhaseTooLarge { .. })));
}

/// The series of a body have three rates that change, and so each of their calls costs several times that of a coin's. A
/// plan that took the two for the same chose series where DOP853 takes half the time.
#[test]
fn series_of_a_body_are_dearer_than_those_of_a_coin() {
    let racket = dynamics::catalogue::named_body("racket").unwrap();
    for (body, cheapest) in [(racket, "quaternion/dop853"), (Coin::PAPER.into(), "quaternion/taylor")] {
        let toss = Toss { body, ..thrown([9.0, 1.0, 2.5]) };
        let scene = Scene::new(Want::Tilt(toss), 1e-6).by("quaternion", None);
        let offers = scene.candidates(Registry::standard()).unwrap();
        let cost = |(candidate, offer): &(Candidate, Offer)| {
            let choice = offer.as_ref().ok().filter(|choice| matches!(choice.how, How::Integrator(..)))?;
            Some((choice.expected_cost_ns, candidate.to_string()))
        };
        let least = offers.iter().filter_map(cost).min_by(|(a, _), (b, _)| a.total_cmp(b)).unwrap();
        assert_eq!(least.1, cheapest, "{offers:?}");
    }
}
