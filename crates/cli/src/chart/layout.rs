//! What the panels of a flight share: colours, room and times.

use plotters::style::RGBColor;
use toss::TracePoint;

/// What is drawn of n.
pub(super) const NORMAL: RGBColor = chart::BLUE;
/// What is drawn of the vector in the face.
pub(super) const FACE: RGBColor = chart::VERMILION;

/// Room for the numbers of the upright axes (pixels).
pub(super) const NUMBERS: u32 = 112;

/// The times that are drawn (s), with room for half a coin at either end.
pub(super) fn times(flight: &[TracePoint]) -> std::ops::Range<f64> {
    let end = flight.last().map_or(0.0, |point| point.time).max(f64::MIN_POSITIVE);
    -0.06 * end..1.06 * end
}
