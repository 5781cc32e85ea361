//! Draws the errors of the committed records over time, with one line for each subject, so that one sees what became better or
//! worse.

use chart::{Axis, ChartError, EndLabel, end_labels, frame, pixel, svg};
use plotters::prelude::*;

use crate::judge::record::Record;
use crate::render::history::FOLLOWED;

use super::palette::Palette;

const SIZE: (u32, u32) = (2000, 900);
const TITLE: &str = "Largest error of the attitude from random launches, by record: lower is better";
/// Room for the labels beside the lines (pixels).
const RIGHT: u32 = 300;

/// The chart as SVG; `records` are not empty.
pub(super) fn history(records: &[Record], palette: &Palette<'_>) -> Result<String, ChartError> {
    let last = records.len().saturating_sub(1);
    let x = Axis::named(records.iter().map(|record| record.host.date.clone()).collect());
    let y = Axis::logarithmic("error [rad]", 1e-17..1e-7);
    svg(SIZE, |root| {
        let mut chart = frame(root, TITLE, (&x, &y), RIGHT)?;
        let mut labels = Vec::new();
        for subject in records[last].accuracy.subjects(FOLLOWED) {
            let colour = palette.colour(subject);
            let points: Vec<(f64, f64)> = records
                .iter()
                .enumerate()
                .filter_map(|(at, record)| Some((at as f64, y.position(record.accuracy.error(FOLLOWED, subject)?))))
                .collect();
            chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(4)))?;
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 7, colour.filled())))?;
            if let Some(end) = points.last() {
                let y = pixel(root, &chart, *end).1;
                labels.push(EndLabel { y, text: subject.to_owned(), colour });
            }
        }
        end_labels(root, chart.plotting_area().get_pixel_range().0.end + 16, labels)
    })
}
