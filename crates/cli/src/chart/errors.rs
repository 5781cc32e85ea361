//! Draws the error of each method of sampling against the number of launches, so that one sees how fast each converges.

use chart::{Axis, BLUE, ChartError, EndLabel, GREEN, GREY, PURPLE, SIZE, VERMILION, end_labels, frame, pixel, svg};
use plotters::prelude::*;
use sampling::{ErrorLine, Errors};

const COLOURS: [RGBColor; 5] = [VERMILION, BLUE, GREEN, BLACK, PURPLE];

/// The chart as SVG, of errors above 0. Its title says `of` what they are.
pub(crate) fn errors(Errors { lines, reference_error, .. }: &Errors, of: &str) -> Result<String, ChartError> {
    let [(fewest, most), (smallest, largest)] = spans(lines).ok_or(ChartError("every error is 0".to_owned()))?;
    svg(SIZE, |root| {
        let (x, y) = (
            Axis::logarithmic("launches n", fewest..most),
            Axis::logarithmic("error, root mean square over seeds", smallest..largest),
        );
        let mut chart = frame(root, &format!("Error of P(heads), {of}"), (&x, &y), 420)?;
        let mut labels: Vec<EndLabel> = Vec::new();
        if *reference_error > smallest {
            let floor = [fewest, most].map(|launches| (x.position(launches), y.position(*reference_error)));
            chart.draw_series(LineSeries::new(floor, GREY.stroke_width(2)))?;
            let y = pixel(root, &chart, floor[1]).1;
            labels.push(EndLabel { y, text: "error of the reference".to_owned(), colour: GREY });
        }
        for (series, colour) in lines.chunk_by(|a, b| a.method == b.method).zip(COLOURS) {
            let points: Vec<(f64, f64)> =
                drawn(series).map(|(launches, error)| (x.position(launches), y.position(error))).collect();
            chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(4)))?;
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 7, colour.filled())))?;
            if let Some(end) = points.last() {
                let y = pixel(root, &chart, *end).1;
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
