//! The running probability of methods A and B against the number of launches.

use chart::{BLUE, ChartError, SIZE, TEXT, VERMILION, svg};
use plotters::prelude::*;
use serde::Serialize;

const GRID: RGBColor = VERMILION;
const RANDOM: RGBColor = BLUE;

/// The share of heads among the first launches: of the grid in its order (A), and at random with its interval (B).
#[derive(Debug, Serialize)]
pub(crate) struct Step {
    pub(crate) launches: u64,
    pub(crate) grid: f64,
    pub(crate) random: f64,
    pub(crate) random_lo: f64,
    pub(crate) random_hi: f64,
}

/// The chart as SVG; `steps` are not empty.
pub(crate) fn convergence(steps: &[Step]) -> Result<String, ChartError> {
    let last = steps.last().expect("a series has its end");
    let values = || steps.iter().flat_map(|step| [step.grid, step.random]);
    let (lowest, highest) = values().fold((1.0_f64, 0.0_f64), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let margin = 0.05 * (highest - lowest).max(0.02);
    svg(SIZE, |root| {
        let mut chart = ChartBuilder::on(root)
            .margin(24)
            .margin_right(320)
            .caption("P(heads) of the first n launches", TEXT)
            .x_label_area_size(84)
            .y_label_area_size(132)
            .build_cartesian_2d(0.0..last.launches as f64, lowest - margin..highest + margin)?;
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
        let band = |end: fn(&Step) -> f64| steps.iter().map(move |step| (step.launches as f64, end(step)));
        let (lower, upper) = (lowest - margin, highest + margin);
        let outline: Vec<(f64, f64)> = band(|step| step.random_lo)
            .chain(band(|step| step.random_hi).rev())
            .map(|(n, p)| (n, p.clamp(lower, upper)))
            .collect();
        chart.draw_series([Polygon::new(outline, RANDOM.mix(0.2).filled())])?;
        let line = |of: fn(&Step) -> f64| steps.iter().map(move |step| (step.launches as f64, of(step)));
        chart.draw_series(LineSeries::new(line(|step| step.grid), GRID.stroke_width(4)))?;
        chart.draw_series(LineSeries::new(line(|step| step.random), RANDOM.stroke_width(4)))?;
        // Direct labels beside the ends of the lines, apart from each other.
        let right = chart.plotting_area().get_pixel_range().0.end;
        let at = |p: f64| chart.plotting_area().map_coordinate(&(last.launches as f64, p)).1;
        let (grid, random) = (at(last.grid), at(last.random));
        let mut labels = [
            (grid, vec![format!("A, grid: {:.4}", last.grid)], GRID),
            (random, vec![format!("B, random: {:.4}", last.random), "with its 95 % interval".to_owned()], RANDOM),
        ];
        labels.sort_by_key(|(y, ..)| *y);
        let mut lowest = 0;
        for (y, text, colour) in labels {
            for (line, text) in (0..).zip(text) {
                lowest = (y - 60 + 36 * line).max(lowest + 36);
                root.draw(&Text::new(text, (right + 12, lowest), TEXT.into_font().color(&colour)))?;
            }
        }
        Ok(())
    })
}
