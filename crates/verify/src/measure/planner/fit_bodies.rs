//! This file measures the models for bodies that are no coins, as [`fit_closed`](super::fit_closed) and
//! [`fit_sampling`](super::fit_sampling) measure those for coins: on random bodies, tosses and spaces.

use dynamics::{Body, RigidToss};
use rand::RngExt;
use sampling::Space;
use toss::fitted::ClosedFit;
use toss::{Answer, How, InputError, Launch, MODELS, Scene, TimeOfFlight, Want};

use super::clock::nanoseconds;
use super::figures::SEED;
use super::fit_closed::{Flown, closed_form};
use super::scenes::{self, served, stream};
use crate::measure::reference::rigid::RigidReference;

/// A body with random moments, the largest of which is about x, y or z.
fn body(index: u64) -> Result<Body, InputError> {
    let mut rng = stream(SEED, index);
    let [one, two] = [rng.random_range(0.05..1.0), rng.random_range(0.05..1.0)];
    let (sum, difference): (f64, f64) = (one + two, one - two);
    let mut moments = [one, two, rng.random_range(difference.abs()..sum)];
    moments.rotate_left(rng.random_range(0..3));
    Body::from_moments(moments)
}

/// A toss of a random body with the launch of a random toss of a coin, but for a given time, as the reference wants it.
fn toss(index: u64) -> Result<RigidToss, InputError> {
    let launch = scenes::toss(SEED, index)?.toss.launch;
    let time = TimeOfFlight::Given(launch.flight_time());
    let launch = Launch::new(launch.rate(), time)?.with_attitude(launch.attitude());
    Ok(RigidToss { body: body(index)?, launch })
}

/// Space number `index`, with the launches of a space of coins.
pub(super) fn space(index: u64) -> Result<Space, InputError> {
    Ok(scenes::space(SEED, index)?.with_body(body(index)?))
}

/// The models in closed form.
pub(super) fn closed_forms() -> anyhow::Result<Vec<ClosedFit>> {
    const TOSSES: u64 = 400;
    let mut flown = Vec::new();
    for toss in (0..TOSSES).map(toss) {
        let toss = toss?;
        if !RigidReference::solves(&toss) {
            continue;
        }
        for want in [Want::Outcome(toss), Want::Tilt(toss), Want::Attitude(toss), Want::Trace { toss, points: 5 }] {
            let scene = Scene::new(want, f64::MAX);
            for choice in served(&scene)?.into_iter().filter(|choice| matches!(choice.how, How::ClosedForm)) {
                let error = error(&toss, &choice.run(&scene)?)?;
                let points = if matches!(scene.want, Want::Trace { .. }) { 5.0 } else { 1.0 };
                let cost_ns = nanoseconds(|| choice.run(&scene)) / points;
                flown.push(Flown { model: choice.model, error, cost_ns });
            }
        }
    }
    let of = |model| closed_form(model, flown.iter().filter(move |flown| flown.model == model));
    Ok(MODELS.iter().filter(|model| model.is_closed_form() && model.is_for_other_bodies()).map(of).collect())
}

/// The error of an answer against the 256-bit reference, as in [`Truth`](super::delivered::Truth).
fn error(toss: &RigidToss, answer: &Answer) -> Result<f64, InputError> {
    let at = |time: f64| -> Result<Option<RigidReference>, InputError> {
        let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time))?;
        Ok(RigidReference::new(&RigidToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss }))
    };
    let Some(landing) = at(toss.launch.flight_time())? else { return Ok(f64::INFINITY) };
    Ok(match answer {
        Answer::Outcome(verdict) if verdict.outcome() == landing.outcome() => 0.0,
        Answer::Tilt(cos_tilt) => landing.cos_tilt_error(*cos_tilt),
        Answer::Attitude(state) => landing.attitude_error(&state.attitude),
        Answer::Trace(points) => {
            let mut largest = 0.0_f64;
            for point in points {
                let exact = at(point.time)?;
                largest = largest.max(exact.map_or(f64::INFINITY, |exact| exact.attitude_error(&point.attitude)));
            }
            largest
        }
        Answer::Outcome(_) | Answer::Probability(_) | Answer::Enclosed(_) => f64::INFINITY,
    })
}
