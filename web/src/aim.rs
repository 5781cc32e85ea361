//! The launch whose angular momentum S points elsewhere and is as large, for a person who drags S.

use serde::Serialize;
use toss::{Error, InputError, Vector3};

use crate::thrown::Thrown;

#[derive(Debug, Serialize)]
pub(crate) struct Aimed {
    /// The body rate (BF, rad/s).
    rate: [f64; 3],
}

/// The body rate with which S has the `direction` (LF, of any length but 0) and its present size.
pub(crate) fn aim(thrown: &Thrown, direction: [f64; 3]) -> Result<Aimed, Error> {
    let toss = &thrown.toss;
    let refused = |value: String, expected| InputError::Malformed { field: "direction of S", value, expected };
    let length = Vector3::from(direction).norm();
    if !(length > 0.0 && length.is_finite()) {
        return Err(refused(format!("{direction:?}"), "three finite numbers, not all 0").into());
    }
    let moments = toss.body.moments().filter(|moments| moments.iter().all(|moment| *moment > 0.0));
    let moments = moments.ok_or_else(|| refused(format!("{direction:?}"), "a body with three moments above 0"))?;
    let size = toss.body.angular_momentum(&toss.launch.rate()).norm();
    let in_body = toss.launch.attitude().lab_to_body(&(Vector3::from(direction) / length));
    Ok(Aimed { rate: [0, 1, 2].map(|axis| size * in_body[axis] / moments[axis]) })
}
