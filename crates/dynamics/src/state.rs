//! The state of a flying coin: attitude Q and body rate ω.

use nalgebra::Vector3;

use crate::attitude::Attitude;

/// Attitude and body rate at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Attitude (body to LF).
    pub attitude: Attitude,
    /// Body rate ω (BF, rad/s).
    pub rate: Vector3<f64>,
}
