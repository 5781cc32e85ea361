//! Scenes, the questions to the planner, as JSON and as TOML.

use toss::{Answer, Error, ExactSolver, Scene, Solver, State, Tilt, Toss, TracePoint, Want};

/// The most points of a trace that are computed here.
const FEW_POINTS: usize = 1000;

/// A scene reads back as itself; its plan is a typed error or expects a finite error and time; and its answer is finite.
/// Outcome and cos θ of a toss agree.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Some(scene) = crate::read::<Scene>(text) else { return };
    crate::assert_round_trip(&scene);
    if let Want::Probability(space) = &scene.want {
        crate::space::check_space(space);
    }
    match scene.plan() {
        Ok(decision) => {
            let choice = &decision.choice;
            assert!(choice.expected_error.is_finite() && choice.expected_error >= 0.0, "{choice:?}");
            assert!(choice.expected_cost_ns.is_finite() && choice.expected_cost_ns >= 0.0, "{choice:?}");
        }
        Err(error) => {
            crate::assert_said(&error);
            assert!(!matches!(error, Error::Launch { .. }), "a plan solves no launch: {error}");
        }
    }
    // Integrators may take a million steps, and sampled spaces minutes.
    let is_quick = scene.by.is_none()
        && match &scene.want {
            Want::Probability(_) => false,
            Want::Trace { points, .. } => *points <= FEW_POINTS,
            _ => true,
        };
    if is_quick {
        check_answer(&scene);
        if let Some(toss) = scene.want.toss() {
            check_outcome(toss);
        }
    }
}

fn check_answer(scene: &Scene) {
    let answer = match scene.solve() {
        Ok(answer) => answer,
        Err(error) => return crate::assert_said(&error),
    };
    assert!(numbers(&answer).into_iter().all(f64::is_finite), "an answer that is not finite: {answer:?}");
    if let Answer::Trace(points) = &answer {
        assert!(points.windows(2).all(|pair| pair[0].time <= pair[1].time), "times descend");
        assert!(points.iter().all(|point| (-1.0..=1.0).contains(&point.cos_tilt)), "cos θ beyond 1");
    }
}

/// The numbers of an answer about one toss.
fn numbers(answer: &Answer) -> Vec<f64> {
    let state = |State { attitude, rate }: &State| [&attitude.components(), rate.as_slice()].concat();
    match answer {
        Answer::Outcome(_) | Answer::Probability(_) => Vec::new(),
        Answer::Tilt(cos_tilt) => vec![*cos_tilt],
        Answer::Attitude(landing) => state(landing),
        Answer::Enclosed(found) => {
            let bounds = [found.cos_tilt(), found.error_bound(), found.attitude_error_bound()];
            [&bounds[..], &state(&found.landing().state)].concat()
        }
        Answer::Trace(points) => points.iter().flat_map(of_point).collect(),
    }
}

fn of_point(&TracePoint { time, attitude, angles, normal, face, cos_tilt }: &TracePoint) -> Vec<f64> {
    let angles = [time, cos_tilt, angles.alpha, angles.beta, angles.gamma];
    [&angles[..], &attitude.components(), normal.as_slice(), face.as_slice()].concat()
}

/// The proven outcome is the sign of cos θ, and an error of one is an error of the other.
fn check_outcome(toss: &Toss) {
    let solve = |want| Scene::new(want, 1e-15).solve();
    let outcome = solve(Want::Outcome(*toss));
    let Ok(Tilt { cos_tilt, .. }) = ExactSolver.tilt(toss) else {
        assert!(outcome.is_err(), "{toss:?} has an outcome and no cos θ");
        return;
    };
    let Ok(Answer::Outcome(verdict)) = outcome else { panic!("{toss:?} has cos θ = {cos_tilt} and no outcome") };
    assert!(verdict.is_proven(), "{toss:?}");
    assert_eq!(verdict.outcome().name(), crate::program::name_by_sign(cos_tilt), "{toss:?}: {cos_tilt}");
}
