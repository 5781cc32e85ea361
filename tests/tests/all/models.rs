//! Checks which model the planner chooses. Whether its answers are as accurate as it says is for the checks of the suite
//! whose names begin with `plan-`.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use blackbox::{config, tosses};
use proptest::prelude::*;
use sampling::{Axis, Found, Sampler, Space};
use toss::planner::{How, MODELS, Model};
use toss::{Answer, Body, Choice, Coin, Error, Registry, Scene, Settings, Solver, Stage, Toss, Want};

/// The error of cos θ that the integrator of a choice estimates itself.
fn error_estimate(choice: &Choice, toss: &Toss) -> f64 {
    let How::Integrator(entry, stepping) = &choice.how else { panic!("{choice:?} is no integrator") };
    let solver = entry.solver(&Settings { stepping: *stepping, ..Settings::default() }).expect("an offered scheme");
    solver.tilt(toss).expect("it has landed").error.expect("a solver of ours estimates its error")
}

proptest! {
    #![proptest_config(config())]

    /// The models passed over are those before the choice in the table, and `solve` answers as the chosen model does.
    #[test]
    fn a_plan_takes_the_first_model_that_serves(toss in tosses(), decade in 1..15_i32) {
        for want in [Want::Outcome(toss), Want::Tilt(toss), Want::Attitude(toss), Want::Trace { toss, points: 3 }] {
            let scene = Scene::new(want, 10f64.powi(-decade));
            let decision = scene.plan().unwrap();
            prop_assert!(matches!(decision.choice.how, How::ClosedForm));
            prop_assert!(decision.choice.expected_error <= scene.accuracy);
            let before: Vec<&Model> = MODELS.iter().take_while(|model| *model != decision.choice.model).collect();
            let passed_over: Vec<&Model> = decision.passed_over.iter().map(|(candidate, _)| candidate.model).collect();
            prop_assert_eq!(before, passed_over);
            prop_assert_eq!(scene.solve().unwrap(), decision.choice.run(&scene).unwrap());
        }
    }
}

#[test]
fn each_question_has_the_cheapest_model_that_is_accurate_enough() {
    let paper: Toss = toml::from_str("[launch]\nrate = [1.0, 1.0, 2.5]\nspeed = 3").unwrap();
    for (scene, model) in [
        (Scene::new(Want::Outcome(paper), 1e-9), "outcome"),
        (Scene::new(Want::Tilt(paper), 1e-9), "tilt"),
        (Scene::new(Want::Tilt(paper), 3e-16), "tilt-exact"),
        (Scene::new(Want::Attitude(paper), 1e-9), "attitude"),
        (Scene::new(Want::Trace { toss: paper, points: 50 }, 1e-9), "trace"),
        (Scene::new(Want::Attitude(paper), 1e-9).by("quaternion", None), "integrator"),
    ] {
        assert_eq!(scene.plan().unwrap().choice.model.name, model, "{scene:?}");
    }
}

#[test]
fn a_proven_outcome_names_the_stage_that_decided() {
    let toss = |rate: &str| -> Toss { toml::from_str(&format!("[launch]\nrate = {rate}\nspeed = 3")).unwrap() };
    let of = |rate: &str| Scene::new(Want::Outcome(toss(rate)), 1e-9).solve().unwrap();
    let Answer::Outcome(verdict) = of("[20.0, 3.0, 1.0]") else { panic!("an outcome was asked for") };
    assert_eq!(verdict.stage(), Some(Stage::F64));
}

#[test]
fn an_integrator_decides_outcomes_down_to_the_accuracy() {
    for rate in ["[1.0, 1.0, 2.5]", "[20.0, 3.0, 1.0]", "[50.0, 40.0, 30.0]"] {
        let toss: Toss = toml::from_str(&format!("[launch]\nrate = {rate}\nspeed = 3")).unwrap();
        for accuracy in [1e-3, 1e-6, 1e-9] {
            let scene = Scene::new(Want::Outcome(toss), accuracy).by("quaternion", None);
            let estimate = error_estimate(&scene.plan().unwrap().choice, &toss);
            // A tolerance of the plan is a tenth of the next coarser one.
            assert!((0.05..=1.0).contains(&(estimate / accuracy)), "{rate} {accuracy:e}: {estimate:e}");
        }
    }
}

#[test]
fn a_probability_is_planned_and_sampled_to_its_accuracy() {
    let space = sampling::named_space("paper-fig4").unwrap();
    for accuracy in [1e-1, 1e-2, 1e-3, 1e-6] {
        let scene = Scene::new(Want::Probability(space), accuracy);
        for (candidate, offer) in scene.candidates(Registry::standard()).unwrap() {
            let Ok(choice) = offer else { continue };
            assert!(choice.expected_error <= accuracy, "{candidate} to {accuracy:e}: {:e}", choice.expected_error);
        }
    }
    // A sample whose interval is too wide is doubled until it is narrow enough.
    let fine = Scene::new(Want::Probability(space), 1e-4);
    for (candidate, offer) in Scene::new(Want::Probability(space), 0.1).candidates(Registry::standard()).unwrap() {
        let Ok(choice) = offer else { continue };
        if choice.model.name != "share-sobol" {
            continue;
        }
        let Answer::Probability(found) = choice.run(&fine).unwrap() else { panic!("a probability was asked for") };
        assert!(found.half_width().is_some_and(|reached| reached <= 1e-4), "{candidate}: {found:?}");
        assert!((found.probability - 0.661_452).abs() < 3e-4);
    }
}

/// The space of the paper's coin with rates from 1 to 60 rad/s on each axis and speeds from 3 to 5 m/s.
fn box_of_four() -> Space {
    let boxed = Space::builder(Coin::PAPER).rate_x(1.0..=60.0).rate_y(1.0..=60.0).rate_z(1.0..=60.0);
    boxed.speed(3.0..=5.0).build().expect("valid ranges")
}

/// Why a plan of the probability of `space` passes the enclosure over.
fn enclosure_is_passed_over(space: Space, accuracy: f64) -> String {
    let decision = Scene::new(Want::Probability(space), accuracy).plan().expect("a plan");
    let mut passed_over = decision.passed_over.iter();
    passed_over.find(|(candidate, _)| candidate.model.name == "share-enclosure").expect("a reason").1.to_string()
}

#[test]
fn an_enclosure_is_planned_where_it_is_cheaper_and_its_answer_is_proven() {
    let fig4 = sampling::named_space("paper-fig4").unwrap();
    let still = Space::builder(Coin::PAPER).rate_x(1.0..=60.0).rate_y(5.0).rate_z(1.0..=60.0).speed(4.0);
    for (space, accuracy, chosen) in [
        (fig4, 1e-2, "share-sobol"),
        (fig4, 1e-8, "share-enclosure"),
        (box_of_four(), 1e-5, "share-sobol"),
        (still.build().unwrap(), 1e-4, "share-enclosure"),
    ] {
        let scene = Scene::new(Want::Probability(space), accuracy);
        let planned = scene.plan().unwrap().choice;
        assert_eq!(planned.model.name, chosen);
        assert_eq!(planned.is_certified(), chosen == "share-enclosure");
        let Answer::Probability(found) = scene.solve().unwrap() else { panic!("a probability was asked for") };
        assert_eq!(found.plan.method().name(), planned.method().unwrap());
        assert!(found.half_width().unwrap() <= accuracy, "{found:?}");
        assert_eq!(found.interval_kind == sampling::IntervalKind::Proven, planned.is_certified());
    }
}

#[test]
fn an_enclosure_is_passed_over_with_its_reason() {
    assert_eq!(
        enclosure_is_passed_over(sampling::named_space("paper-fig4").unwrap(), 1e-2),
        "serves, but takes 120.9 µs"
    );
    let body = box_of_four().with_body(Body::from_moments([1.0, 1.1, 1.9]).unwrap()).unwrap();
    assert_eq!(enclosure_is_passed_over(body, 1e-2), "is for coins, with I1 = I2");
    let normal = Space::builder(Coin::PAPER).rate_x(1.0..=60.0).rate_y(5.0).rate_z(1.0).speed(Axis::normal(4.0, 0.1));
    let why = enclosure_is_passed_over(normal.build().unwrap(), 1e-4);
    assert!(
        why.ends_with("enclosure takes a range of speeds or a single one; exact-speed takes a normal distribution"),
        "{why}"
    );
}

/// Spaces that show tails in a narrow part of themselves alone, between all nodes of a rule: for a spin near 0, or for some
/// gravities. Their probabilities are those of the closed form, integrated with 50 digits between its kinks.
#[test]
fn a_plan_finds_the_narrow_part_of_a_space_that_lands_tails() {
    let quarter = dynamics::catalogue::named_coin("us-quarter").unwrap();
    let spin = Space::builder(quarter).rate_x(5.0).rate_y(0.0).rate_z(-75.0..=82.0).speed(3.0..=5.0);
    let gravity = Space::builder(Coin::PAPER).rate_x(34.534_110_732_396_435).rate_y(0.0).rate_z(68.827_547_700_763_86);
    let gravity = gravity.speed(Axis::normal(4.0, 1e-3)).gravity(9.0..=10.0);
    for (space, accuracy, probability) in
        [(spin.build().unwrap(), 1e-5, 0.986_527_176_1), (gravity.build().unwrap(), 1e-4, 0.944_802_114)]
    {
        let scene = Scene::new(Want::Probability(space), accuracy);
        let Answer::Probability(found) = scene.solve().unwrap() else { panic!("a probability was asked for") };
        assert!(found.interval.unwrap().contains(probability), "{found:?}, not {probability}");
        assert!(found.half_width().unwrap() <= accuracy, "{found:?}");
    }
}

#[test]
fn a_plan_that_takes_more_launches_than_planned_says_which_were_tried() {
    let space = Space::builder(Coin::PAPER).rate_x(20.0).rate_y(1.0).rate_z(0.0..=90.0).speed(3.0..=3.01);
    let space = space.build().unwrap();
    let scene = Scene::new(Want::Probability(space), 1e-2);
    let Answer::Probability(found) = scene.solve().unwrap() else { panic!("a probability was asked for") };
    assert_eq!((scene.plan().unwrap().choice.points, found.points), (Some(256), 1024));
    assert_eq!(found.plan.points(&space), Ok(found.points));
}

#[test]
fn a_model_whose_rounding_exceeds_the_accuracy_gives_way_to_one_that_serves() {
    // Flights of 10^14 rad: a share of speeds is rounded by more than 1e-3, while an outcome is proven.
    let far = Space::builder(Coin::PAPER).rate_x(20.0).rate_y(5.0).rate_z(3.0).tilt(0.0..=1.0);
    let scene = Scene::new(Want::Probability(far.speed(1e14..=1.000_000_000_000_1e14).build().unwrap()), 1e-3);
    let planned = scene.plan().unwrap().choice;
    assert_eq!(planned.model.name, "share-sobol");
    assert!(matches!(planned.run(&scene), Err(Error::NotReached { .. })));
    let Answer::Probability(found) = scene.solve().unwrap() else { panic!("a probability was asked for") };
    assert_eq!(found.plan.method().name(), "sobol");
    assert!(found.half_width().is_some_and(|reached| reached <= 1e-3), "{found:?}");
}

#[test]
fn an_enclosure_gives_way_and_is_the_answer_where_nothing_else_serves() {
    let figure = || Scene::new(Want::Probability(sampling::named_space("paper-fig4").unwrap()), 1e-7);
    let answer = |scene: &Scene, sampler: &Sampler<'_>| {
        let Answer::Probability(found) = scene.solve_with(sampler).unwrap() else {
            panic!("a probability was asked for")
        };
        (found.plan.method().name(), found)
    };
    assert_eq!(figure().plan().unwrap().choice.model.name, "share-enclosure");
    // A space that takes many more cells than most gives way after the time that sampling is expected to take.
    let dear = Space::builder(Coin::PAPER).rate_x(28.0..=50.0).rate_y(6.0..=39.0).rate_z(24.0).tilt(0.8).speed(2.6);
    let dear = Scene::new(Want::Probability(dear.build().unwrap()), 1.7e-3);
    assert_eq!(dear.plan().unwrap().choice.model.name, "share-enclosure");
    assert_eq!(answer(&dear, &Sampler::exact()).0, "sobol");
    // By too few cells, an enclosure is too wide.
    let few = Sampler::exact().within(40);
    let (model, sampled) = answer(&figure(), &few);
    assert_eq!((model, sampled.is_wider_than_asked()), ("exact-speed", false));
    // Somebody who ends the sampling has the enclosure.
    let done = AtomicU64::new(0);
    let (count, is_late) = (|more| _ = done.fetch_add(more, Relaxed), || done.load(Relaxed) > 1000);
    let (model, proven) = answer(&figure(), &few.clone().on_progress(&count).until(&is_late));
    assert_eq!((model, proven.is_wider_than_asked()), ("enclosure", true));
    assert!(proven.interval.unwrap().contains(sampled.probability) && proven.half_width() > Some(1e-7));
    assert_eq!(proven.found, Found::Enclosed { is_spent: true });
    // No sample reaches this accuracy: an enclosure takes what cells it needs, and if it misses, too, it is the answer.
    let finest = Scene { accuracy: 1e-13, ..figure() };
    let (model, found) = answer(&finest, &Sampler::exact());
    assert!(model == "enclosure" && found.half_width().unwrap() <= 1e-13, "{found:?}");
    assert_eq!(answer(&finest, &few).1.interval, proven.interval);
}
