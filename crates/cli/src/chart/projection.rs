//! The projection of the charts of a flight: orthographic, from above.

use toss::Vector3;

/// Where the eye is: azimuth and elevation (rad). A coin with ωx = ωy, as in the paper's figures, tips over across the line of
/// sight and a little away from the eye, so that the side that is up is seen when it lands.
const EYE: (f64, f64) = (2.55, 0.45);

/// A vector as the eye sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// To the right.
    pub(super) right: f64,
    /// Upwards.
    pub(super) up: f64,
    /// Towards the eye; negative on the far side.
    pub(super) near: f64,
}

/// `v` (LF) as the eye sees it.
pub(super) fn project(v: &Vector3<f64>) -> Seen {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (EYE.0.sin_cos(), EYE.1.sin_cos());
    let (right, away) = (v.x * cos_a + v.y * sin_a, -v.x * sin_a + v.y * cos_a);
    Seen { right, up: v.z * cos_e + away * sin_e, near: v.z * sin_e - away * cos_e }
}

/// Radius of a coin (pixels).
const RADIUS: f64 = 36.0;

/// Where the end of `vector` (LF, in radii) from `centre` is seen (pixels).
#[expect(clippy::cast_possible_truncation, reason = "within the canvas")]
pub(super) fn end_of(centre: (i32, i32), vector: &Vector3<f64>) -> (i32, i32) {
    let seen = project(vector);
    (centre.0 + (RADIUS * seen.right).round() as i32, centre.1 - (RADIUS * seen.up).round() as i32)
}
