//! Plans and runs the models that give the probability of a space of launches. The number N of launches of a sample follows
//! from the error e N^-p that the table of [models](crate::model) states: it is N = (e/accuracy)^(1/p). This error was measured
//! on other spaces, so an estimate whose interval turns out wider than the accuracy is repeated with twice as many launches. An
//! enclosure that takes as long as the next model is expected to take gives way to it.

use dynamics::{Error, InputError};
use sampling::enclosure::{coordinates, largest_phase, require_accuracy, require_enclosable};
use sampling::plan::SCRAMBLES;
use sampling::{Estimate, Found, Plan, Rest, Sampler, Scrambled, Space};

use crate::answer::Answer;
use crate::choice::{Candidate, Choice, How, Offer};
use crate::model::{CELLS, Cells, Fit, Kind, MODELS, Model, Of, USUAL_PHASE};
use crate::reason::Reason;
use crate::scene::{Scene, Want};

/// The seed of all planned samples. Any other number would serve as well.
const SEED: u64 = 1;

/// The largest number of launches that is planned.
const MOST_LAUNCHES: u64 = 1 << 36;

/// The offers of the models that sample the space of a scene, in the order of [`MODELS`]; none if it has a toss
/// instead.
///
/// # Errors
/// [`InputError`] if an integrator is asked for: these models use the exact motion.
pub(crate) fn samples(scene: &Scene) -> Result<Vec<(Candidate, Offer)>, InputError> {
    if scene.by.is_some() {
        return Err(no_integrator_for_a_space());
    }
    let Want::Probability(space) = &scene.want else { return Ok(Vec::new()) };
    let of = Of::body(space.body());
    let offer = |model: &'static Model| match model.kind {
        Kind::Sample { .. } if model.of == Of::Others && of == Of::Coins => None,
        Kind::Sample { refuses, plan, fit } => {
            let only_coins = (model.of != of).then_some(Reason::OnlyCoins);
            let refused = only_coins.or_else(|| refuses(space)).map(Err);
            Some((model.into(), refused.unwrap_or_else(|| offer(model, plan, fit, (space, scene.accuracy)))))
        }
        Kind::Enclosure if of == Of::Others => Some((model.into(), Err(Reason::OnlyCoins))),
        Kind::Enclosure => {
            let offer = enclosure(model, space, scene.accuracy);
            Some((model.into(), offer.map_err(|error| Reason::Fails(error.into()))))
        }
        _ => None,
    };
    Ok(MODELS.iter().filter_map(offer).collect())
}

/// The error for a scene that wants a probability by an integrator.
pub(crate) fn no_integrator_for_a_space() -> InputError {
    InputError::OutsideModel {
        field: "by",
        why: "probabilities are planned with the exact motion; `sampling::Sampler::by` takes an integrator",
    }
}

fn offer(
    model: &'static Model,
    plan: fn(u64, u64) -> Plan,
    fit: Option<Fit>,
    (space, accuracy): (&Space, f64),
) -> Offer {
    let of = |points, expected_error, expected_cost_ns| {
        let plan = plan(points, SEED);
        Ok(Choice {
            model,
            how: How::Sampling(plan),
            expected_error,
            expected_cost_ns,
            points: plan.points(space).ok(),
        })
    };
    match fit {
        None => Err(Reason::TellsNoError),
        Some(Fit::Rounding { error, .. }) if error > accuracy => Err(Reason::TooRough { expected_error: error }),
        Some(Fit::Rounding { error, cost_ns }) => of(1, error, cost_ns),
        Some(Fit::Launches { error, power, cost_ns, launch_ns }) => {
            let points = points_for([error, power], plan, accuracy)?;
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            let launches = points as f64;
            of(points, error * launches.powf(-power), cost_ns + launch_ns * launches)
        }
    }
}

/// The offer of an enclosure, whose error is proven to be at most `accuracy`.
///
/// # Errors
/// [`InputError`] for a space that has no enclosure, and for an accuracy that roundings do not allow.
fn enclosure(model: &'static Model, space: &Space, accuracy: f64) -> Result<Choice, InputError> {
    require_enclosable(space)?;
    let how = How::Sampling(Plan::Enclosure { accuracy: require_accuracy(accuracy)? });
    let [cells, cell_ns] = cells(space, accuracy);
    Ok(Choice { model, how, expected_error: accuracy, expected_cost_ns: cells * cell_ns, points: None })
}

/// The number of cells that an enclosure of `space` is expected to take, and the cost of each (ns).
fn cells(space: &Space, accuracy: f64) -> [f64; 2] {
    let Cells { first, power, by_phase, cell_ns } = CELLS[coordinates(space).min(CELLS.len() - 1)];
    let phase = (largest_phase(space) / USUAL_PHASE).max(0.2);
    [(first * accuracy.powf(-power) * phase.powf(by_phase)).max(1.0), cell_ns]
}

/// The number of launches for which the expected error equals the accuracy, rounded up to a power of two for scrambled
/// points.
fn points_for([error, power]: [f64; 2], plan: fn(u64, u64) -> Plan, accuracy: f64) -> Result<u64, Reason> {
    #[expect(clippy::cast_precision_loss, reason = "a power of two")]
    let most = MOST_LAUNCHES as f64;
    let needed = (error / accuracy).powf(1.0 / power).max(1.0);
    if needed > most {
        return Err(Reason::TooRough { expected_error: error * most.powf(-power) });
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 2^36")]
    let needed = needed.ceil() as u64;
    let is_independent = matches!(plan(needed, SEED), Plan::Random { .. });
    Ok(if is_independent { needed } else { needed.next_power_of_two().max(SCRAMBLES * 2) })
}

/// Runs a plan that was [offered](samples). An enclosure may take the time that the `next` model is expected to take.
pub(crate) fn run(
    sampler: &Sampler<'_>,
    space: &Space,
    plan: Plan,
    (accuracy, next): (f64, Option<&Choice>),
) -> Result<Estimate, Error> {
    match (plan, next) {
        (Plan::Enclosure { .. }, Some(next)) => {
            let [_, cell_ns] = cells(space, accuracy);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
            let most_cells = (next.expected_cost_ns / cell_ns) as u64;
            Ok(sampler.clone().within(most_cells.max(1)).estimate(space, plan)?)
        }
        _ => sampled(sampler, space, plan, accuracy),
    }
}

/// Runs `plan` by `sampler`, with twice the launches again and again as long as the half-width of the interval exceeds the
/// accuracy. When it is time to end, the last estimate is the answer.
fn sampled(sampler: &Sampler<'_>, space: &Space, plan: Plan, accuracy: f64) -> Result<Estimate, Error> {
    let found = sampler.estimate(space, plan)?;
    let rounding_error = if let Found::Shares { rounding_error } = found.found { rounding_error } else { 0.0 };
    match (found.half_width(), refined(plan)) {
        (Some(reached), Some(more)) if reached > accuracy && !sampler.is_over() => {
            if found.points >= MOST_LAUNCHES || rounding_error > accuracy {
                return Err(Error::NotReached { launches: found.points, reached, accuracy });
            }
            match sampled(sampler, space, more, accuracy) {
                Err(Error::Ended) => Ok(found),
                refined => refined,
            }
        }
        _ => Ok(found),
    }
}

/// The plan with twice the launches; `None` for a plan that cannot be refined.
fn refined(plan: Plan) -> Option<Plan> {
    let twice = |scrambled: Scrambled| Scrambled { points: 2 * scrambled.points, ..scrambled };
    match plan {
        Plan::Random { points, seed } => Some(Plan::Random { points: 2 * points, seed }),
        Plan::Sobol(scrambled) => Some(Plan::Sobol(twice(scrambled))),
        Plan::ExactSpeed(Rest::Sobol(scrambled)) => Some(Plan::ExactSpeed(Rest::Sobol(twice(scrambled)))),
        Plan::Enclosure { .. } | Plan::Grid | Plan::ExactSpeed(Rest::Grid) => None,
    }
}

/// Whether a model turned out not to reach the accuracy of a space.
pub(crate) fn is_missed(found: &Result<Answer, Error>) -> bool {
    match found {
        Ok(Answer::Probability(found)) => found.is_wider_than_asked(),
        Err(Error::NotReached { launches, .. }) => *launches < MOST_LAUNCHES,
        _ => false,
    }
}
