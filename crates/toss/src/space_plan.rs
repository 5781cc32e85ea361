//! Which way to sample a space, and with how many launches: N = (e/accuracy)^(1/p) for a tabulated error of e N^-p.

use dynamics::InputError;
use sampling::plan::SCRAMBLES;
use sampling::{Coordinate, Plan, Rest, Scrambled, Space};

use crate::choice::{Candidate, Choice, How, Offer, Reason};
use crate::fitted::FITTED;
use crate::model::Model;
use crate::scene::{Scene, Want};

/// Seed of what is sampled; any other would do.
const SEED: u64 = 1;

/// More launches than this are not planned.
const MOST_LAUNCHES: f64 = 68_719_476_736.0; // 2^36

/// The ways to sample the space of a scene, in the order of the ladder; none for another scene.
///
/// # Errors
/// [`InputError`] where an integrator is asked for: outcomes are proven, and shares follow from the exact motion.
pub(crate) fn candidates(scene: &Scene) -> Result<impl Iterator<Item = (Candidate, Offer)>, InputError> {
    if scene.by.is_some() {
        return Err(no_integrator_for_a_space());
    }
    let space = if let Want::Probability(space) = scene.want { Some(space) } else { None };
    let models = [Model::Share, Model::ShareSobol, Model::Sobol, Model::Grid, Model::Random];
    let accuracy = scene.accuracy;
    let ask = move |space: Space| models.into_iter().map(move |model| (model.into(), offer(model, &space, accuracy)));
    Ok(space.into_iter().flat_map(ask))
}

/// The error of an integrator that is asked for a probability.
pub(crate) fn no_integrator_for_a_space() -> InputError {
    InputError::OutsideModel {
        field: "by",
        why: "probabilities are planned with the exact motion; `sampling::estimate` takes an integrator",
    }
}

fn offer(model: Model, space: &Space, accuracy: f64) -> Offer {
    let speed_is_free = space.free().any(|of| of == Coordinate::Speed);
    let rest_is_free = space.free().any(|of| of != Coordinate::Speed);
    match model {
        Model::Share if rest_is_free => Err(Reason::MoreIsFree),
        Model::Share => share(accuracy),
        Model::ShareSobol if !speed_is_free => Err(Reason::SpeedIsFixed),
        Model::Grid => Err(Reason::TellsNoError),
        _ => sampled(model, accuracy),
    }
}

/// One share, exact to rounding.
fn share(accuracy: f64) -> Offer {
    let fit = FITTED.closed(Model::Share);
    if fit.error > accuracy {
        return Err(Reason::TooRough { expected_error: fit.error });
    }
    Ok(Choice {
        model: Model::Share,
        how: How::Sampling(Plan::ExactSpeed(Rest::Grid)),
        expected_error: fit.error,
        expected_cost_ns: fit.cost_ns,
    })
}

/// As many launches as the fitted error needs.
fn sampled(model: Model, accuracy: f64) -> Offer {
    let fit = FITTED.sampling(model);
    let needed = (fit.error / accuracy).powf(1.0 / fit.power).max(1.0);
    if needed > MOST_LAUNCHES {
        return Err(Reason::TooRough { expected_error: fit.error * MOST_LAUNCHES.powf(-fit.power) });
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 2^36")]
    let needed = needed.ceil() as u64;
    let points = if model == Model::Random { needed } else { needed.next_power_of_two().max(SCRAMBLES * 2) };
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let launches = points as f64;
    Ok(Choice {
        model,
        how: How::Sampling(plan(model, points, SEED)),
        expected_error: fit.error * launches.powf(-fit.power),
        expected_cost_ns: fit.cost_ns + fit.launch_ns * launches,
    })
}

/// The plan of a way to sample, with so many launches and this seed; any other model is taken for random launches.
pub fn plan(model: Model, points: u64, seed: u64) -> Plan {
    match model {
        Model::ShareSobol => Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, seed))),
        Model::Sobol => Plan::Sobol(Scrambled::new(points, seed)),
        _ => Plan::Random { points, seed },
    }
}
