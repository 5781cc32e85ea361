//! Draws errors: against the step, with the order that each line shows beside that which theory gives;
//! and of the committed records over time, so that one sees what became better or worse.

use chart::{Axis, ChartError, EndLabel, Series, end_labels, lines, svg};

use super::palette::Palette;
use crate::judge::record::Record;
use crate::measure::convergence::Convergence;
use crate::render::text::FOLLOWED;

/// Where the labels begin (pixels from the top).
const ORDER_TOP: i32 = 80;

/// Room for labels beside the lines (pixels), and where they begin (from the left) in charts of this width.
const ORDER_RIGHT: u32 = 420;
const HISTORY_RIGHT: u32 = 300;
const WIDTH: u32 = 2000;
const ORDER_LABELS: i32 = (WIDTH - ORDER_RIGHT + 20).cast_signed();
const HISTORY_LABELS: i32 = (WIDTH - HISTORY_RIGHT + 16).cast_signed();

pub(super) fn order(all: &[Convergence], palette: &Palette<'_>) -> Result<String, ChartError> {
    let of_subject = |found: &Convergence| {
        let observed = found.observed.map_or_else(|| "none".to_owned(), |order| format!("{order:.2}"));
        let label = format!("{}: {observed} of {}", found.subject, found.order);
        palette.line(&found.subject, &label, found.points.clone(), Vec::new())
    };
    let drawn: Vec<Series> = all.iter().map(of_subject).collect();
    let (x, y) = (Axis::logarithmic("step [s]", 1.0..1e-4), Axis::logarithmic("error of the state", 1e-12..10.0));
    svg((WIDTH, 1000), |root| {
        let title = "Fixed steps: error, and the order observed of that expected";
        let labels = lines(root, title, (&x, &y), &drawn, ORDER_RIGHT)?;
        // The lines end next to each other at the lower edge, so their names stand in a column from the top.
        let from_the_top = labels.into_iter().map(|label| EndLabel { y: ORDER_TOP, ..label }).collect();
        end_labels(root, ORDER_LABELS, from_the_top)
    })
}

/// The chart as SVG; `records` are not empty.
pub(crate) fn history(records: &[Record], palette: &Palette<'_>) -> Result<String, ChartError> {
    let x = Axis::named(records.iter().map(|record| record.host.date.clone()).collect());
    let y = Axis::logarithmic("error [rad]", 1e-17..1e-7);
    let line = |subject: &str| {
        let error = |(at, record): (usize, &Record)| Some((at as f64, record.accuracy.error(FOLLOWED, subject)?));
        palette.line(subject, subject, records.iter().enumerate().filter_map(error).collect(), Vec::new())
    };
    let drawn: Vec<Series> =
        records.last().into_iter().flat_map(|last| last.accuracy.subjects(FOLLOWED)).map(line).collect();
    svg((WIDTH, 900), |root| {
        let title = "Largest error of the attitude from random launches, by record: lower is better";
        let labels = lines(root, title, (&x, &y), &drawn, HISTORY_RIGHT)?;
        end_labels(root, HISTORY_LABELS, labels)
    })
}
