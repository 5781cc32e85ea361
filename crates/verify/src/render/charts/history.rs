//! The errors of the committed records over time: one line per subject.

use chart::{ChartError, EndLabel, GREY, TEXT, end_labels, svg};
use plotters::prelude::*;

use crate::judge::record::Record;
use crate::render::history::FOLLOWED;

use super::palette::Palette;

const SIZE: (u32, u32) = (2000, 900);
/// Room for labels beside the lines (pixels).
const RIGHT: u32 = 300;

/// The chart as SVG; `records` are not empty.
pub(super) fn history(records: &[Record], palette: &Palette<'_>) -> Result<String, ChartError> {
    let last = records.len().saturating_sub(1);
    svg(SIZE, |root| {
        let mut chart = ChartBuilder::on(root)
            .margin(24)
            .margin_right(RIGHT)
            .caption("largest error of the attitude from random launches, by record", TEXT)
            .x_label_area_size(84)
            .y_label_area_size(132)
            .build_cartesian_2d(-0.5..last as f64 + 0.5, (1e-17..1e-7).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_labels(2 * records.len() + 1)
            .x_label_formatter(&|position: &f64| date(records, *position))
            .y_label_formatter(&|error: &f64| format!("{error:.0e}"))
            .y_desc("error [rad]")
            .label_style(TEXT)
            .axis_desc_style(TEXT)
            .draw()?;
        let mut labels = Vec::new();
        for subject in records[last].accuracy.subjects(FOLLOWED) {
            let colour = palette.colour(subject);
            let points: Vec<(f64, f64)> = records
                .iter()
                .enumerate()
                .filter_map(|(at, record)| Some((at as f64, record.accuracy.error(FOLLOWED, subject)?.max(1e-17))))
                .collect();
            chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(4)))?;
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 7, colour.filled())))?;
            if let Some(end) = points.last() {
                let y = chart.plotting_area().map_coordinate(end).1;
                labels.push(EndLabel { y, text: subject.to_owned(), colour });
            }
        }
        root.draw(&Text::new("lower is better", (180, 80), TEXT.into_font().color(&GREY)))?;
        end_labels(root, chart.plotting_area().get_pixel_range().0.end + 16, labels)
    })
}

/// The date of the record at a position of the axis, which is nothing between two records.
fn date(records: &[Record], position: f64) -> String {
    let at = |index: usize| (position - index as f64).abs() < 1e-6;
    records
        .iter()
        .enumerate()
        .find(|(index, _)| at(*index))
        .map_or_else(String::new, |(_, record)| record.host.date.clone())
}
