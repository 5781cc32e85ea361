//! [`State`], the attitude Q and the body rate ω of a coin at one time. It is what a solver returns at landing, and
//! enough to continue the flight as a new launch.

use nalgebra::Vector3;

use crate::attitude::Attitude;

/// Attitude and body rate at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Attitude, from BF (body frame) to LF (laboratory frame).
    pub attitude: Attitude,
    /// Body rate ω (BF, rad/s).
    pub rate: Vector3<f64>,
}

impl State {
    /// The state with this attitude and body rate ω (BF, rad/s), as a vector or as an array.
    pub fn new(attitude: Attitude, rate: impl Into<Vector3<f64>>) -> Self {
        Self { attitude, rate: rate.into() }
    }
}
