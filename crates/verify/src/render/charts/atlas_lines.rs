//! Draws error and work against the distance from each hazard, with one panel for each hazard and one line for each solver and
//! formulation. A line is by the first scheme of its solver; the other schemes do the same with more work.

use chart::{Axis, ChartError, LINE_WIDTH, Marker, PURPLE, Series, log_log, svg};

use super::palette::Palette;
use super::{legend, legend_height};
use crate::measure::atlas::hazards::{HAZARDS, Hazard};
use crate::measure::atlas::{Atlas, Spot};

/// Where the distance 0 is drawn.
const ZERO: f64 = 1e-18;

/// The number that is drawn of each spot.
type Quantity = fn(&Spot) -> Option<f64>;

/// The chart of the attitude's error, with the effect of one rounding of the launch.
pub(super) fn errors(atlas: &Atlas, palette: &Palette<'_>) -> Result<String, ChartError> {
    let quantity: Quantity = |spot| spot.run.err_attitude;
    Lines { atlas, palette, quantity, with_rounding: true }.svg("error of the attitude [rad]", 1e-18..1e3)
}

/// The chart of the calls of the right-hand side.
pub(super) fn work(atlas: &Atlas, palette: &Palette<'_>) -> Result<String, ChartError> {
    let quantity: Quantity = |spot| spot.run.rhs_calls.filter(|calls| *calls > 0).map(|calls| calls as f64);
    Lines { atlas, palette, quantity, with_rounding: false }.svg("calls of the right-hand side", 1e1..1e7)
}

/// What is drawn.
struct Lines<'a> {
    atlas: &'a Atlas,
    palette: &'a Palette<'a>,
    quantity: Quantity,
    with_rounding: bool,
}

impl Lines<'_> {
    fn svg(&self, label: &str, range: std::ops::Range<f64>) -> Result<String, ChartError> {
        let rows = HAZARDS.len().div_ceil(2);
        let foot = legend_height(self.of(&HAZARDS[0]).len());
        let height = 540 * u32::try_from(rows).unwrap_or(1) + foot;
        let y = Axis::logarithmic(label, range);
        svg((2000, height), |root| {
            let (body, foot) = root.split_vertically(height - foot);
            for (hazard, panel) in HAZARDS.iter().zip(body.split_evenly((rows, 2))) {
                let title = format!("{}  {}", hazard.id, hazard.name);
                log_log(&panel, &title, (&distance_axis(hazard), &y), &self.of(hazard), 40)?;
            }
            legend(&foot, &self.of(&HAZARDS[0]))
        })
    }

    /// The lines of a panel.
    fn of(&self, hazard: &Hazard) -> Vec<Series> {
        let rounding = self.with_rounding.then(|| self.rounding(hazard));
        let mut lines: Vec<Series> = rounding.into_iter().collect();
        for (subject, colour, dashed, marker) in self.palette.contestants() {
            let (mut points, mut failures) = (Vec::new(), Vec::new());
            for spot in self.atlas.series(hazard.id, &subject) {
                match (self.quantity)(spot) {
                    Some(value) => points.push((at(spot), value)),
                    None if spot.run.failure.is_some() => failures.push(at(spot)),
                    None => {}
                }
            }
            lines.push(Series { label: subject, colour, width: LINE_WIDTH, dashed, marker, points, failures });
        }
        lines
    }

    /// The effect of one rounding of the launch, which is the same for all contestants.
    fn rounding(&self, hazard: &Hazard) -> Series {
        let first = self.atlas.subjects().first().copied().unwrap_or_default();
        let spots = self.atlas.series(hazard.id, first);
        Series {
            label: "one rounding of the launch".to_owned(),
            colour: PURPLE,
            width: LINE_WIDTH,
            dashed: true,
            marker: Marker::None,
            points: spots.filter_map(|spot| Some((at(spot), spot.conditioning?.rounding()))).collect(),
            failures: Vec::new(),
        }
    }
}

fn distance_axis(hazard: &Hazard) -> Axis {
    let nearest = hazard.distances.iter().copied().fold(1.0, f64::min);
    let start = if nearest == 0.0 { ZERO } else { nearest };
    let axis = Axis::logarithmic(hazard.distance, start..1.0);
    if nearest == 0.0 { axis.starting_at_zero() } else { axis }
}

fn at(spot: &Spot) -> f64 {
    spot.distance.max(ZERO)
}
