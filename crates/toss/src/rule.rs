//! Plans the model that computes a probability by quadrature. Its number of shares follows from how rough the space is and from
//! the accuracy, by a power law that was fitted to random spaces. The rule itself goes on until its error estimate is within
//! the accuracy, so that the power law decides what a plan costs, and not how accurate its answer is.

use sampling::quadrature::{require_smooth, roughness};
use sampling::{Coordinate, Plan, Space};

use crate::choice::{Choice, How, Offer};
use crate::fitted::FITTED;
use crate::model::Model;
use crate::reason::Reason;

/// The largest number of shares that is planned. The rule gives up at a few times as many.
const MOST_SHARES: f64 = (1_u64 << 22) as f64;

/// The offer of `model`, quadrature, to a space.
pub(crate) fn offer(model: &'static Model, space: &Space, accuracy: f64) -> Offer {
    if let Some(reason) = refusal(space) {
        return Err(reason);
    }
    // A phase beyond 2^53 rad has as many kinks.
    let rough = roughness(space).map_err(|_| Reason::TooManyKinks)?;
    let fit = FITTED.quadrature(&rough).ok_or(Reason::NotMeasured)?;
    if accuracy < fit.finest {
        return Err(Reason::TooRough { expected_error: fit.finest });
    }
    let shares = fit.shares(rough.parts, accuracy.min(1.0));
    if shares > MOST_SHARES {
        return Err(Reason::TooManyKinks);
    }
    let how = How::Sampling(Plan::Quadrature { accuracy });
    // The rule goes on until its error estimate is within the accuracy, so this is the error to expect at most.
    Ok(Choice { model, how, expected_error: accuracy, expected_cost_ns: fit.share_ns * shares })
}

/// The reason why quadrature does not serve for the space, if there is one.
fn refusal(space: &Space) -> Option<Reason> {
    if space.drop().is_some() {
        return Some(Reason::HasDrop);
    }
    if space.axis(Coordinate::Speed).value().is_some() {
        return Some(Reason::SpeedIsFixed);
    }
    match sampling::quadrature::coordinates(space) {
        0 => Some(Reason::NoRule("the speed alone is free")),
        1 | 2 => require_smooth(space).err().map(|_| Reason::NoRule("needs wider ranges")),
        _ => Some(Reason::NoRule("more than two coordinates beside the speed are free")),
    }
}
