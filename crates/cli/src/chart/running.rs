//! Draws the running probability of methods A (a grid) and B (random launches) against the number of launches, which is the
//! paper's Fig. 4.

use chart::{Axis, BLUE, ChartError, EndLabel, SIZE, VERMILION, end_labels, frame, svg};
use plotters::prelude::*;

const GRID: RGBColor = VERMILION;
const RANDOM: RGBColor = BLUE;

/// The chart as SVG, whose title ends with what the launches are `of`. There is at least one step. Each is a number of launches,
/// the share of heads among so many launches of the grid (A), the share among so many random launches (B), and the ends of B's
/// interval.
pub(crate) fn running(of: &str, steps: &[[f64; 5]]) -> Result<String, ChartError> {
    let &[launches, last_grid, last_random, ..] = steps.last().ok_or(ChartError("no steps".to_owned()))?;
    let values = || steps.iter().flat_map(|step| [step[1], step[2]]);
    let (lowest, highest) = values().fold((1.0_f64, 0.0_f64), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let margin = 0.05 * (highest - lowest).max(0.02);
    svg(SIZE, |root| {
        let (lower, upper) = (lowest - margin, highest + margin);
        let (x, y) = (Axis::linear("launches n", 0.0..launches), Axis::linear("P(heads)", lower..upper));
        let mut chart = frame(root, &format!("P(heads) of the first n launches{of}"), (&x, &y), 320)?;
        let column = |column: usize| steps.iter().map(move |step| (step[0], step[column]));
        let outline: Vec<(f64, f64)> =
            column(3).chain(column(4).rev()).map(|(n, p)| (n, p.clamp(lower, upper))).collect();
        chart.draw_series([Polygon::new(outline, RANDOM.mix(0.2).filled())])?;
        chart.draw_series(LineSeries::new(column(1), GRID.stroke_width(4)))?;
        chart.draw_series(LineSeries::new(column(2), RANDOM.stroke_width(4)))?;
        let at = |p: f64| chart.plotting_area().map_coordinate(&(launches, p)).1;
        // Above the end of the lines, which meet.
        let label = |p: f64, text: String, colour: RGBColor| EndLabel { y: at(p) - 60, text, colour };
        let grid = label(last_grid, format!("A, grid: {last_grid:.4}"), GRID);
        let random = label(last_random, format!("B, random: {last_random:.4}"), RANDOM);
        let labels = vec![grid, random, label(last_random, "with its 95 % interval".to_owned(), RANDOM)];
        end_labels(root, chart.plotting_area().get_pixel_range().0.end + 12, labels)
    })
}
