//! The error of each method of sampling against the number of launches.

use chart::{BLUE, ChartError, EndLabel, GREEN, GREY, PURPLE, SIZE, TEXT, VERMILION, end_labels, svg};
use plotters::prelude::*;
use serde::Serialize;

const COLOURS: [RGBColor; 5] = [VERMILION, BLUE, GREEN, BLACK, PURPLE];

/// What errors are measured from, and how far it may be off itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reference {
    pub(crate) probability: f64,
    pub(crate) error: f64,
}

/// The error of a method by a number of launches.
#[derive(Debug, Serialize)]
pub(crate) struct ErrorLine {
    pub(crate) method: &'static str,
    pub(crate) launches: u64,
    pub(crate) rms_error: f64,
    pub(crate) replicates: usize,
    pub(crate) reference: f64,
    pub(crate) reference_error: f64,
}

/// The chart as SVG, of errors above 0.
pub(crate) fn errors(lines: &[ErrorLine], reference: &Reference) -> Result<String, ChartError> {
    let [(fewest, most), (smallest, largest)] = spans(lines).ok_or(ChartError("every error is 0".to_owned()))?;
    svg(SIZE, |root| {
        let mut chart = ChartBuilder::on(root)
            .margin(24)
            .margin_right(420)
            .caption("error of P(heads), root mean square over seeds", TEXT)
            .x_label_area_size(84)
            .y_label_area_size(132)
            .build_cartesian_2d((fewest..1.1 * most).log_scale(), (0.5 * smallest..2.0 * largest).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_desc("launches n")
            .y_desc("error")
            // Numbers between the powers of ten would run into each other.
            .x_label_formatter(&|n: &f64| if n.log10().fract() == 0.0 { format!("{n:.0}") } else { String::new() })
            .y_label_formatter(&|error: &f64| format!("{error:.0e}"))
            .label_style(TEXT)
            .axis_desc_style(TEXT)
            .draw()?;
        let mut labels: Vec<EndLabel> = Vec::new();
        if reference.error > 0.5 * smallest {
            let floor = [(fewest, reference.error), (1.1 * most, reference.error)];
            chart.draw_series(LineSeries::new(floor, GREY.stroke_width(2)))?;
            let y = chart.plotting_area().map_coordinate(&floor[1]).1;
            labels.push(EndLabel { y, text: "error of the reference".to_owned(), colour: GREY });
        }
        for (series, colour) in lines.chunk_by(|a, b| a.method == b.method).zip(COLOURS) {
            let points: Vec<(f64, f64)> = drawn(series).collect();
            chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(4)))?;
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 7, colour.filled())))?;
            if let Some(end) = points.last() {
                let y = chart.plotting_area().map_coordinate(end).1;
                labels.push(EndLabel { y, text: series[0].method.to_owned(), colour });
            }
        }
        end_labels(root, chart.plotting_area().get_pixel_range().0.end + 12, labels)
    })
}

/// Launches and errors above 0.
fn drawn(lines: &[ErrorLine]) -> impl Iterator<Item = (f64, f64)> {
    lines.iter().filter(|line| line.rms_error > 0.0).map(|line| (line.launches as f64, line.rms_error))
}

/// The least and the largest of the launches and of the errors that are drawn; `None` if none is.
fn spans(lines: &[ErrorLine]) -> Option<[(f64, f64); 2]> {
    let span = |of: fn((f64, f64)) -> f64| {
        drawn(lines).map(of).fold((f64::INFINITY, 0.0_f64), |(lo, hi), value| (lo.min(value), hi.max(value)))
    };
    drawn(lines).next().map(|_| [span(|(launches, _)| launches), span(|(_, error)| error)])
}
