//! Error and work against the distance from each hazard, by DOP853: a panel a hazard, a line a contestant.

use chart::{Axis, BLUE, ChartError, GREEN, LINE_WIDTH, Marker, PURPLE, Series, VERMILION, legend, log_log, svg};
use plotters::prelude::*;

use crate::atlas::hazards::{HAZARDS, Hazard};
use crate::atlas::{Atlas, Spot};

/// Where the distance 0 is drawn.
const ZERO: f64 = 1e-18;

/// Height of the legend (pixels).
const LEGEND: u32 = 170;

/// What is drawn of each spot.
type Quantity = fn(&Spot) -> Option<f64>;

/// The contestants that are drawn: the other methods do as DOP853 does, only with more work.
const LINES: [(&str, RGBColor, bool, Marker); 8] = [
    ("gamma/dop853/raw", VERMILION, true, Marker::Ring),
    ("euler/dop853/raw", BLUE, true, Marker::Ring),
    ("gamma/dop853/vertical", VERMILION, true, Marker::Triangle),
    ("euler/dop853/vertical", BLUE, true, Marker::Triangle),
    ("gamma/dop853", VERMILION, false, Marker::Disc),
    ("euler/dop853", BLUE, false, Marker::Disc),
    ("quaternion/dop853", GREEN, false, Marker::Disc),
    ("exact", BLACK, false, Marker::Disc),
];

/// The attitude's error, with what one rounding of the inputs does.
pub(super) fn errors(atlas: &Atlas) -> Result<String, ChartError> {
    let rounding = ("one rounding of the launch", PURPLE, (|spot| Some(spot.conditioning?.rounding())) as Quantity);
    panels(atlas, "error of the attitude [rad]", 1e-18..1e3, |spot| spot.run.err_attitude, Some(rounding))
}

/// Calls of the right-hand side.
pub(super) fn work(atlas: &Atlas) -> Result<String, ChartError> {
    let calls: Quantity = |spot| spot.run.rhs_calls.filter(|calls| *calls > 0).map(|calls| calls as f64);
    panels(atlas, "calls of the right-hand side", 1e1..1e7, calls, None)
}

fn panels(
    atlas: &Atlas,
    label: &str,
    range: std::ops::Range<f64>,
    quantity: Quantity,
    background: Option<(&str, RGBColor, Quantity)>,
) -> Result<String, ChartError> {
    let rows = HAZARDS.len().div_ceil(2);
    let height = 540 * u32::try_from(rows).unwrap_or(1) + LEGEND;
    let y = Axis::positive(label, range);
    svg((2000, height), |root| {
        let (body, foot) = root.split_vertically(height - LEGEND);
        for (hazard, panel) in HAZARDS.iter().zip(body.split_evenly((rows, 2))) {
            let x = distance_axis(hazard);
            let title = format!("{}  {}", hazard.id, hazard.name);
            log_log(&panel, &title, (&x, &y), &lines(atlas, hazard, quantity, background), 40)?;
        }
        legend(&foot, &lines(atlas, &HAZARDS[0], quantity, background), 4, 480)
    })
}

fn distance_axis(hazard: &Hazard) -> Axis {
    let nearest = hazard.distances.iter().copied().fold(1.0, f64::min);
    let start = if nearest == 0.0 { ZERO } else { nearest };
    Axis { label: hazard.distance.to_owned(), range: start..1.0, starts_at_zero: nearest == 0.0 }
}

fn lines(
    atlas: &Atlas,
    hazard: &Hazard,
    quantity: Quantity,
    background: Option<(&str, RGBColor, Quantity)>,
) -> Vec<Series> {
    let mut lines = Vec::new();
    if let Some((label, colour, quantity)) = background {
        let spots = atlas.series(hazard.id, "exact");
        let points = spots.filter_map(|spot| Some((at(spot), quantity(spot)?))).collect();
        lines.push(Series {
            label: label.to_owned(),
            colour,
            width: LINE_WIDTH,
            dashed: true,
            marker: Marker::None,
            points,
            failures: Vec::new(),
        });
    }
    for (subject, colour, dashed, marker) in LINES {
        let (mut points, mut failures) = (Vec::new(), Vec::new());
        for spot in atlas.series(hazard.id, subject) {
            match quantity(spot) {
                Some(value) => points.push((at(spot), value)),
                None if spot.run.failure.is_some() => failures.push(at(spot)),
                None => {}
            }
        }
        lines.push(Series { label: subject.to_owned(), colour, width: LINE_WIDTH, dashed, marker, points, failures });
    }
    lines
}

fn at(spot: &Spot) -> f64 {
    spot.distance.max(ZERO)
}
