//! This module computes P(heads) by quadrature, where that is better than sampling: over one or two coordinates beside the
//! speed. The share over all speeds is known in [closed form](crate::exact_speed), and is a smooth function of the other
//! coordinates between kinks that can be located. Errors therefore fall much faster with the number of shares than those of
//! any sample, and the result has an error estimate instead of a confidence interval.
//!
//! A space with a single speed is refused, because its outcomes jump from heads to tails. So is one with three or more other
//! coordinates, where Sobol points are cheaper; except that ωx and ωy count as one for launches from horizontal
//! (`rest.rs`).

mod kronrod;
mod line;
mod nest;
mod order;
mod rest;

use dynamics::error::require;
use dynamics::{Error, InputError};

use crate::coordinate::Coordinate;
use crate::estimate::Estimate;
use crate::plan::ONLY_COINS;
use crate::space::Space;
use nest::Nest;
use order::ordered;
use rest::rest_of;

/// The largest number of coordinates beside the speed, if ωx and ωy of launches from horizontal count as one.
const MOST_COORDINATES: usize = 2;

/// Rounding error of a mean: that of the densities, weights and sums.
const SUM_ERROR: f64 = 64.0 * f64::EPSILON;

/// Whether quadrature serves for `space`.
///
/// # Errors
/// [`InputError::OutsideModel`] if it does not.
pub fn require_smooth(space: &Space) -> Result<(), InputError> {
    if space.coin().is_none() {
        return Err(ONLY_COINS);
    }
    let refused = |field, why| Err(InputError::OutsideModel { field, why });
    if space.drop().is_some() {
        return refused(
            "drop [m]",
            "quadrature needs a landing at the height of the launch; other methods take a drop",
        );
    }
    if space.axis(Coordinate::Speed).value().is_some() {
        return refused(
            Coordinate::Speed.field(),
            "quadrature needs a range of speeds: with a single speed, outcomes jump from heads to tails",
        );
    }
    let rest = rest_of(space);
    if let Some(narrow) = rest.iter().find(|rest| !rest.is_resolved()) {
        let why = "quadrature needs a range wider than 1e-9 of its values; other methods take a narrower one";
        return refused(narrow.of.field(), why);
    }
    if rest.len() > MOST_COORDINATES {
        return refused(
            "method",
            "quadrature takes at most two coordinates beside the speed (of launches from horizontal, uniform rates x and y \
             count as one); with more, exact-speed is cheaper",
        );
    }
    Ok(())
}

/// The number of coordinates that quadrature integrates over in `space`, the speed not included.
pub fn coordinates(space: &Space) -> usize {
    rest_of(space).len()
}

/// Estimates P(heads) of `space` to `accuracy`.
pub(crate) fn estimate(space: &Space, accuracy: f64) -> Result<Estimate, Error> {
    require("accuracy", accuracy, "finite and > 0", accuracy > 0.0)?;
    require_smooth(space)?;
    let coin = space.coin().ok_or(ONLY_COINS)?;
    let rest = ordered(space, coin, rest_of(space))?;
    let found = Nest::new(space, coin, rest, accuracy).mean()?;
    let rounding_error = found.rounding_error + SUM_ERROR;
    let reached = found.rule_error + rounding_error;
    if found.value.is_finite() && reached <= accuracy {
        return Ok(Estimate::of_quadrature(found.value, [found.rule_error, rounding_error], found.shares));
    }
    // Nothing that is not a number gets into a result: 1 says that nothing is known.
    let reached = if reached.is_finite() { reached } else { 1.0 };
    Err(Error::NotReached { points: found.shares, reached, accuracy })
}

#[cfg(test)]
mod tests;
