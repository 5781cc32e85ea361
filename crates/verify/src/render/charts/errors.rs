//! Draws errors: against the step, with the order that each line shows beside that which theory gives;
//! and of the committed records over time, so that one sees what became better or worse.

use chart::{Axis, ChartError, EndLabel, Series, end_labels, frame, log_log, pixel, svg};
use plotters::prelude::*;

use super::palette::Palette;
use crate::judge::record::Record;
use crate::measure::convergence::Convergence;
use crate::render::text::FOLLOWED;

/// Where the labels begin (pixels from the top).
const ORDER_TOP: i32 = 80;

/// Room for labels beside the lines (pixels).
const ORDER_RIGHT: u32 = 420;

pub(super) fn order(all: &[Convergence], palette: &Palette<'_>) -> Result<String, ChartError> {
    let of_subject = |found: &Convergence| {
        let observed = found.observed.map_or_else(|| "none".to_owned(), |order| format!("{order:.2}"));
        let label = format!("{}: {observed} of {}", found.subject, found.order);
        palette.line(&found.subject, label, found.points.clone(), Vec::new())
    };
    let lines: Vec<Series> = all.iter().map(of_subject).collect();
    let (x, y) = (Axis::logarithmic("step [s]", 1.0..1e-4), Axis::logarithmic("error of the state", 1e-12..10.0));
    svg((2000, 1000), |root| {
        let labels = log_log(
            root,
            "Fixed steps: error, and the order observed of that expected",
            (&x, &y),
            &lines,
            ORDER_RIGHT,
        )?;
        // The lines end next to each other at the lower edge, so their names stand in a column from the top.
        let from_the_top = labels.into_iter().map(|label| EndLabel { y: ORDER_TOP, ..label }).collect();
        end_labels(root, 2000 - i32::try_from(ORDER_RIGHT).unwrap_or(0) + 20, from_the_top)
    })
}

const HISTORY_SIZE: (u32, u32) = (2000, 900);
const HISTORY_TITLE: &str = "Largest error of the attitude from random launches, by record: lower is better";
/// Room for the labels beside the lines (pixels).
const HISTORY_RIGHT: u32 = 300;

/// The chart as SVG; `records` are not empty.
pub(crate) fn history(records: &[Record], palette: &Palette<'_>) -> Result<String, ChartError> {
    let last = records.len().saturating_sub(1);
    let x = Axis::named(records.iter().map(|record| record.host.date.clone()).collect());
    let y = Axis::logarithmic("error [rad]", 1e-17..1e-7);
    svg(HISTORY_SIZE, |root| {
        let mut chart = frame(root, HISTORY_TITLE, (&x, &y), HISTORY_RIGHT)?;
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
