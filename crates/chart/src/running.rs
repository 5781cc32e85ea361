//! The running probability of methods A and B against the number of launches.

use plotters::prelude::*;

use crate::{BLUE, ChartError, EndLabel, SIZE, TEXT, VERMILION, end_labels, svg};

const GRID: RGBColor = VERMILION;
const RANDOM: RGBColor = BLUE;

/// The chart as SVG. Each of `steps`, of which there is at least one, is a number of launches, the share of heads among so
/// many of the grid (A) and at random (B), and the ends of B's interval.
///
/// # Errors
/// [`ChartError`] if it can't be drawn.
pub fn running(steps: &[[f64; 5]]) -> Result<String, ChartError> {
    let &[launches, last_grid, last_random, ..] = steps.last().ok_or(ChartError("no steps".to_owned()))?;
    let values = || steps.iter().flat_map(|step| [step[1], step[2]]);
    let (lowest, highest) = values().fold((1.0_f64, 0.0_f64), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let margin = 0.05 * (highest - lowest).max(0.02);
    svg(SIZE, |root| {
        let mut chart = ChartBuilder::on(root)
            .margin(24)
            .margin_right(320)
            .caption("P(heads) of the first n launches", TEXT)
            .x_label_area_size(84)
            .y_label_area_size(132)
            .build_cartesian_2d(0.0..launches, lowest - margin..highest + margin)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_desc("launches n")
            .y_desc("P(heads)")
            .x_label_formatter(&|n: &f64| format!("{n:.0}"))
            .y_label_formatter(&|p: &f64| format!("{p:.3}"))
            .label_style(TEXT)
            .axis_desc_style(TEXT)
            .draw()?;
        let column = |column: usize| steps.iter().map(move |step| (step[0], step[column]));
        let (lower, upper) = (lowest - margin, highest + margin);
        let outline: Vec<(f64, f64)> =
            column(3).chain(column(4).rev()).map(|(n, p)| (n, p.clamp(lower, upper))).collect();
        chart.draw_series([Polygon::new(outline, RANDOM.mix(0.2).filled())])?;
        chart.draw_series(LineSeries::new(column(1), GRID.stroke_width(4)))?;
        chart.draw_series(LineSeries::new(column(2), RANDOM.stroke_width(4)))?;
        let at = |p: f64| chart.plotting_area().map_coordinate(&(launches, p)).1;
        // Above the end of the line, where the axis has no number.
        let label = |p: f64, text: String, colour: RGBColor| EndLabel { y: at(p) - 60, text, colour };
        let grid = label(last_grid, format!("A, grid: {last_grid:.4}"), GRID);
        let random = label(last_random, format!("B, random: {last_random:.4}"), RANDOM);
        let labels = vec![grid, random, label(last_random, "with its 95 % interval".to_owned(), RANDOM)];
        end_labels(root, chart.plotting_area().get_pixel_range().0.end + 12, labels)
    })
}
